#!/bin/sh
# mirror.sh [-security]: prints the mirror that apt's sources name for this machine's Debian, or for its security updates, as those of
# Debian's other suites are there, too.
# Exit status 1, with the reason on stderr, where they name none.
# shellcheck disable=SC1091
codename=$(. /etc/os-release && echo "${VERSION_CODENAME:-unknown}")${1:-}
# other vendors' repositories may have a suite of that name; without lists apt knows no origin yet
mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Origin: Debian' "Codename: $codename" 'Component: main' 2> /dev/null | head -n 1)
[ -n "$mirror" ] || mirror=$(apt-get --print-uris update 2> /dev/null |
    sed -n "s,^'\(.*\)/dists/$codename/InRelease'.*,\1,p" | head -n 1)
mirror=${mirror%/}
[ -n "$mirror" ] || { echo "apt's sources name no mirror of $codename" >&2 && exit 1; }
echo "$mirror"

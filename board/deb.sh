#!/bin/sh
# deb.sh: source and binary packages of the last commit into $O/deb/SUITE. Of this machine's Debian and
# architecture they are built here; SUITE=trixie and ARCH=arm64 (cross-built) in a root of Debian's
# packages, which is made once and kept in the user's cache (root=); that needs mmdebstrap, and root. IN_ROOT=1: all of them there,
# so that nothing of this machine is in them.
set -eu
umask 022
: "${O:=build}" "${VERSION:?}"
here=$(cd "$(dirname "$0")" && pwd)
# shellcheck disable=SC1091
codename=$(. /etc/os-release && echo "${VERSION_CODENAME:-unknown}")
own=$(dpkg --print-architecture)
suite=${SUITE:-$codename} arch=${ARCH:-$own}
case $suite in
bookworm) release=12 ;;
trixie) release=13 ;;
*) echo "deb.sh: SUITE is bookworm or trixie, not $suite" >&2 && exit 2 ;;
esac
version=$VERSION-1~deb$release
out=$(mkdir -p "$O/deb/$suite" && cd "$O/deb/$suite" && pwd)
source=$out/gnomon-$VERSION

# CHANGELOG.md as Debian writes it: "## VERSION - DATE", then items "- TEXT"
# At midnight: times of files after that are cut to it, and so the same in each build.
changelog() {
    awk '/^## / { n++; if (n > 1) print "end"; print "head", $2, $4; open = 1; next }
         open && /^- / { print "item", substr($0, 3); next }
         open && /^  [^ ]/ { print "more", substr($0, 3) }
         END { if (n) print "end" }' "$here/CHANGELOG.md" |
        while read -r kind text; do
            case $kind in
            head)
                date=${text#* } first=${text% *}
                echo "gnomon ($first-1~deb$release) $suite; urgency=medium"
                echo
                ;;
            item) echo "$text" | fold -s -w 74 | sed 's/ *$//; 1s/^/  * /; 2,$s/^/    /' ;;
            more) echo "$text" | fold -s -w 74 | sed 's/ *$//; s/^/    /' ;;
            end)
                echo
                echo " -- $(sed -n 's/^Maintainer: //p' "$here/debian/control")  $(LC_ALL=C date -u -R -d "$date 00:00 UTC")"
                echo
                ;;
            esac
        done | sed '$d'
}

# the source as it was committed, with debian/ where its tools look for it
rm -rf "$source" && rm -f "$out"/gnomon*
cp "$O/gnomon-$VERSION.tar.gz" "$out/gnomon_$VERSION.orig.tar.gz"
tar -x -z -C "$out" -f "$out/gnomon_$VERSION.orig.tar.gz"
cp -r "$here/debian" "$source/debian"
[ "$suite" != bookworm ] || rm "$source/debian/gnomon.lintian-overrides" # its lintian does not know the tag
changelog > "$source/debian/changelog"
found=$(sed -n '1s/.*(\(.*\)).*/\1/p' "$source/debian/changelog")
[ "$found" = "$version" ] || { echo "deb.sh: CHANGELOG.md begins with $found, and the Makefile's version is $version" >&2 && exit 1; }

if [ "$suite-$arch${IN_ROOT:-}" = "$codename-$own" ]; then
    (cd "$source" && env -u O -u VERSION dpkg-buildpackage -us -uc -tc) > "$out/log" 2>&1 ||
        { tail -n 30 "$out/log" >&2 && echo "deb.sh: dpkg-buildpackage failed: $out/log" >&2 && exit 1; }
else
    (cd "$out" && dpkg-source -b "${source##*/}" > /dev/null)
    "$here/deb-root.sh" "$suite" "$arch" "$source" > "$out/log" 2>&1 ||
        { tail -n 30 "$out/log" >&2 && echo "deb.sh: the build for $arch of $suite failed: $out/log" >&2 && exit 1; }
fi
rm -rf "$source"
ls "$out"/*.deb "$out"/*.dsc

#!/bin/sh
# service-root.sh: the disk of a virtual machine with systemd, of Debian SUITE (this machine's without it), made once by mmdebstrap
# and kept in the user's cache (an image of ext4); prints its name. gnomon is not installed in it: the test does that, without a network, so what the
# packages in build/deb/SUITE need has been downloaded. Exit status 77, with the reason on stderr, where it cannot be had.
set -eu
: "${O:=build}"
# shellcheck disable=SC1091
codename=$(. /etc/os-release && echo "${VERSION_CODENAME:-unknown}")
suite=${SUITE:-$codename}
store=${XDG_CACHE_HOME:-$HOME/.cache}/gnomon/board
skip() {
    echo "board: $*" >&2
    exit 77
}
[ "$(id -u)" = 0 ] || skip 'only root can make the root of a machine with systemd'
for tool in mmdebstrap mke2fs; do command -v $tool > /dev/null || skip "needs $tool: make deps"; done
debs=$(find "$O/deb/$suite" -name 'gnomon*_amd64.deb' ! -name '*dbgsym*' 2> /dev/null)
[ -n "$debs" ] || skip "no packages in $O/deb/$suite: SUITE=$suite make deb"

# shellcheck disable=SC2086
needs=$(for deb in $debs; do dpkg-deb -f $deb Depends Recommends; done | sha256sum | cut -c 1-8)
root=$store/service-$suite-$(sha256sum < "$0" | cut -c 1-12)-$needs
mkdir -p "$store"
exec 9> "$store/service.lock" && flock 9 # tests that run beside each other want the same one
if [ ! -e "$root/.made" ]; then
    mirror=$(sh "$(dirname "$0")/../../board/mirror.sh") || skip 'no packages to make a root of'
    echo "board: making the root of $suite with systemd, once" >&2
    rm -rf "$root"
    mmdebstrap --mode=root --variant=minbase --skip=cleanup/apt --quiet \
        --include=systemd-sysv,udev,dbus,kmod,mawk,busybox-static,procps,kbd,ca-certificates,sudo,dosfstools \
        "$suite" "$root" "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $mirror $suite main" \
        > "$store/service.log" 2>&1 || { tail -n 5 "$store/service.log" >&2 && skip "mmdebstrap failed for $suite"; }
    mkdir "$root/root/debs"
    # shellcheck disable=SC2086
    cp $debs "$root/root/debs"
    # dpkg here is not that of the machine's boot: only downloads
    chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive sh -c \
        'apt-get -q -y --download-only install /root/debs/*.deb' > "$store/service.log" 2>&1 < /dev/null ||
        { tail -n 5 "$store/service.log" >&2 && skip "apt-get failed in $suite"; }
    rm -rf "$root/root/debs"
    touch "$root/.made"
fi
if [ ! -e "$root.img" ]; then
    rm -f "$root.new"
    mke2fs -q -t ext4 -d "$root" "$root.new" 4G > /dev/null || skip "mke2fs failed for $root"
    mv "$root.new" "$root.img"
fi
touch "$root" "$root.img"
echo "$root.img"

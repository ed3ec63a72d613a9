#!/bin/sh
# deb-root.sh SUITE ARCHITECTURE SOURCE: builds the packages of SOURCE, an unpacked source package, in a
# root of that Debian's packages, and puts them beside it. The root is this machine's architecture's;
# others are cross-built. It is made once, in ~/.cache/gnomon/deb, and brought up to date by apt.
set -eu
suite=$1 arch=$2 source=$3
own=$(dpkg --print-architecture)
store=${XDG_CACHE_HOME:-$HOME/.cache}/gnomon/deb
root=$store/$suite-$arch
[ "$(id -u)" = 0 ] || { echo "deb-root.sh: only root can build for $arch of $suite" >&2 && exit 1; }
for tool in mmdebstrap chroot; do
    command -v "$tool" > /dev/null || { echo "deb-root.sh: needs $tool" >&2 && exit 1; }
done

mirror=$(sh "$(dirname "$0")/mirror.sh")
cross='' architectures=$own
[ "$arch" = "$own" ] || { cross=crossbuild-essential-$arch architectures=$own,$arch; }
if [ ! -e "$root/.made" ]; then
    rm -rf "$root" && mkdir -p "$store"
    mmdebstrap --mode=root --variant=buildd --architectures="$architectures" \
        --include="debhelper,fakeroot${cross:+,$cross}" --skip=cleanup/apt \
        "$suite" "$root" "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $mirror $suite main"
    touch "$root/.made"
fi

rm -rf "$root/build" && mkdir "$root/build"
cp -r "$source" "$root/build/gnomon"
inside() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/nonexistent LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive "$@"; }
for pause in 3 9 0; do
    inside apt-get -q -y --no-install-recommends -a "$arch" build-dep /build/gnomon && break
    [ "$pause" != 0 ] || exit 1
    sleep "$pause" && inside apt-get -q update || true
done
inside sh -c "cd /build/gnomon && DEB_BUILD_OPTIONS='parallel=$(nproc)${cross:+ nocheck}' dpkg-buildpackage -us -uc -b -a$arch ${cross:+-Pcross,nocheck}"
cp "$root"/build/gnomon*_"$arch".* "$(dirname "$source")"
rm -rf "$root/build"

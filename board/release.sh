#!/bin/sh
# release.sh: what a release consists of, in $O/gnomon-VERSION: the source of the last commit, packages of Debian SUITES for ARCHES
# (deb.sh), cards to flash (image/build.sh), the changes of this version, and SHA256SUMS. The same commit gives the same packages, wherever
# and by whomever it is built; cards have Debian's packages of the day as well.
#   SUITES, ARCHES  both Debians, amd64 and arm64; fewer for a try
#   IMAGES          the cards, SUITE-KIND-ARCH; of another architecture than this machine's they need qemu-user-static. None: IMAGES=
#   TAG             the tag of the release, if there is one: it has to be v and the version
set -eu
umask 022
: "${O:=build}" "${VERSION:?}"
images=${IMAGES-bookworm-pi4-arm64 bookworm-efi-arm64 bookworm-efi-amd64}
here=$(cd "$(dirname "$0")" && pwd)
out=$O/gnomon-$VERSION

refuse() {
    echo "release.sh: $*" >&2
    exit 1
}
[ "${TAG:-v$VERSION}" = "v$VERSION" ] || refuse "the tag is $TAG, and the version of the Makefile $VERSION"
notes=$(awk -v version="$VERSION" '/^## / { open = $2 == version; next } open' "$here/CHANGELOG.md")
[ -n "$notes" ] || refuse "CHANGELOG.md says nothing of $VERSION"

rm -rf "$out" && mkdir -p "$out"
for suite in ${SUITES:-bookworm trixie}; do
    for arch in ${ARCHES:-amd64 arm64}; do
        echo "packages of $suite for $arch"
        IN_ROOT=1 SUITE=$suite ARCH=$arch sh "$here/deb.sh" > /dev/null
        cp "$O/deb/$suite"/*.deb "$O/deb/$suite"/*.dsc "$O/deb/$suite"/*.debian.tar.* "$out/"
        for image in $images; do
            case $image in "$suite"-*-"$arch") ;; *) continue ;; esac
            echo "card $image"
            kind=${image#*-} kind=${kind%-*}
            KIND=$kind ARCH=$arch SUITE=$suite sh "$here/image/build.sh" > /dev/null
            # one thread: its bytes do not depend on how many processors there are
            xz -T1 -c "$O/gnomon-$VERSION-$kind-$arch.img" > "$out/gnomon-$VERSION-$kind-$arch.img.xz"
            rm "$O/gnomon-$VERSION-$kind-$arch.img"
        done
    done
done
cp "$O/gnomon-$VERSION.tar.gz" "$out/gnomon_$VERSION.orig.tar.gz"
echo "$notes" > "$out/NOTES.md"
(cd "$out" && LC_ALL=C sha256sum -- * > ../SHA256SUMS && mv ../SHA256SUMS .)
ls "$out"

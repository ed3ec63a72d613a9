#!/bin/sh
# deps.sh SET..: installs the Debian packages of the sets that are missing. Says nothing when none is.
# build, run, test, board and board-arm64 (virtual machines), gpus (the compilers of those that are not
# here), deb and deb-test (packages, and what examines them), image and image-test (cards, and machines that start them) are for this
# machine; cross is what building for CROSS=aarch64-linux-gnu adds.
set -eu

libraries='libc6-dev libjansson-dev libpng-dev zlib1g-dev libturbojpeg0-dev libinih-dev libgpiod-dev libegl-dev libgles-dev
    libcglm-dev libdrm-dev libgbm-dev'
build="gcc make pkgconf $libraries"
run='libegl1 libgles2 libegl-mesa0 libgl1-mesa-dri libgbm1 libdrm2'
test_libraries='libcmocka-dev libx11-dev'
test="clang clang-format clang-tidy lld groff-base xvfb $test_libraries"
# for gnomon-import and its sandbox, a window, texts on the picture, textures, meshes
optional_build='libassimp-dev libseccomp-dev libglfw3-dev libfreetype-dev libraqm-dev libwebp-dev libzstd-dev libmeshoptimizer-dev libdraco-dev'
optional_compiler=g++ # with libdraco, of gnomon-import
optional_run='fonts-dejavu-core libraqm0' # for those texts
repository='apt-utils gpg gpg-agent'
optional_test="libosmesa6-dev $repository" # not in every Debian
# a terminal that scripts can type in; where the sun stands; texts in twelve scripts, and a second opinion of them
optional_test_own='tmux python3-ephem fonts-noto-core fonts-noto-cjk fonts-symbola pango1.0-tools'
# fetches libraries for tests/angle, which are for a PC alone; node brings its own where it is not Debian's
[ "$(uname -m)" != x86_64 ] || command -v npm > /dev/null || optional_npm=npm
# without them the tests in virtual machines are skipped; those run on a PC alone
optional_board='qemu-system-x86 busybox-static kmod cpio xz-utils linux-source linux-headers-amd64
    kmscube kbd libdrm-tests gpiod'
optional_board_arm64='qemu-system-arm gcc-aarch64-linux-gnu'
optional_gpus='gcc-aarch64-linux-gnu'
deb='build-essential dpkg-dev debhelper libassimp-dev libseccomp-dev libglfw3-dev libfreetype-dev libraqm-dev libosmesa6-dev git'
deb_test='lintian desktop-file-utils appstream systemd'
optional_deb='mmdebstrap' # for roots of another Debian or architecture, and to install in
# cards to flash, those of another architecture, too; machines that start them
optional_image='mmdebstrap dosfstools mtools fdisk xz-utils qemu-user-static binfmt-support arch-test'
optional_image_test='qemu-system-x86 qemu-system-arm ovmf qemu-efi-aarch64 xxd'

command -v dpkg-query > /dev/null || exit 0 # not Debian: the Makefile says what pkg-config does not find

own=$(dpkg --print-architecture)
# a package's name stands for this machine's architecture, name:arm64 for that one
missing() {
    dpkg-query -W -f='${db:Status-Abbrev} ${Package}:${Architecture}\n' "$@" 2> /dev/null |
        awk -v all="$*" -v own=":$own" '
            $1 == "ii" { have[$2] = 1; sub(own "$|:all$", "", $2); have[$2] = 1 }
            END { n = split(all, p, " "); for (i = 1; i <= n; i++) if (!(p[i] in have)) printf " %s", p[i] }'
}

architecture_of() {
    case $1 in
    aarch64-linux-gnu) echo arm64 ;;
    arm-linux-gnueabihf) echo armhf ;;
    riscv64-linux-gnu) echo riscv64 ;;
    x86_64-linux-gnu) echo amd64 ;;
    *) echo "deps.sh: CROSS=$1 is unknown here; for example aarch64-linux-gnu" >&2 && return 2 ;;
    esac
}

# the packages $2.. of the architecture $1
foreign() {
    architecture=$1
    shift
    for package in "$@"; do printf ' %s:%s' "$package" "$architecture"; done
}

wanted='' extra='' added=''
for set in "$@"; do
    case $set in
    build) wanted="$wanted $build" extra="$extra $optional_build $optional_compiler" ;;
    run) wanted="$wanted $run" extra="$extra $optional_run" ;;
    test) wanted="$wanted $test" extra="$extra $optional_test ${optional_npm:-} $optional_test_own" ;;
    board) [ "$own" != amd64 ] || extra="$extra $optional_board" ;;
    board-arm64) [ "$own" != amd64 ] || extra="$extra $optional_board_arm64" ;;
    deb) wanted="$wanted $deb" extra="$extra $optional_deb $repository" ;;
    deb-test) wanted="$wanted $deb_test" ;;
    image) extra="$extra $optional_image" ;;
    image-test) extra="$extra $optional_image_test" ;;
    gpus) [ "$own" != amd64 ] || extra="$extra $optional_gpus" ;;
    cross)
        added=$(architecture_of "${CROSS:-}")
        compiler=gcc-$(echo "$CROSS" | tr _ -)
        wanted="$wanted $compiler $(foreign "$added" $libraries $test_libraries)"
        extra="$extra g++-$(echo "$CROSS" | tr _ -) $(foreign "$added" $optional_build $optional_test)"
        ;;
    *) echo "deps.sh: unknown set of packages: $set" >&2 && exit 2 ;;
    esac
done

needed=$(missing $wanted)
# what could not be had once is not asked for again: the stamp remembers
stamp=${O:-build}/deps-optional${added:+-$added}
wished=${extra:+$(missing $extra)} extra=''
for package in $wished; do
    grep -qsxF "$package" "$stamp" || extra="$extra $package"
done
[ -n "$needed$extra" ] || exit 0

as_root=''
if [ "$(id -u)" != 0 ]; then
    as_root='sudo'
    if ! command -v sudo > /dev/null || { [ ! -t 0 ] && ! sudo -n true 2> /dev/null; }; then
        [ -n "$needed" ] || exit 0
        first=${added:+"dpkg --add-architecture $added && apt-get update && "}
        echo "gnomon needs packages and cannot install them itself; as root: ${first}apt-get install$needed" >&2
        exit 1
    fi
fi

echo "installing:$needed$extra" >&2
export DEBIAN_FRONTEND=noninteractive
log=$(mktemp)
trap 'rm -f "$log"' EXIT
# Three tries: a mirror may be busy, or change while it is read. What it does not have it will not have.
apt() {
    for pause in 3 9 0; do
        $as_root apt-get -q -y -o Dpkg::Use-Pty=0 "$@" < /dev/null > "$log" 2>&1 && return
        ! grep -qE 'Unable to locate|no installation candidate' "$log" || return
        sleep "$pause"
    done
    return 1
}
[ -z "$added" ] || $as_root dpkg --add-architecture "$added"
apt update || true # a list that is old may do
if [ -n "$needed" ] && ! apt install --no-install-recommends $needed; then
    tail -n 5 "$log" >&2
    echo "gnomon needs packages that apt-get could not install:$needed" >&2
    exit 1
fi
for package in $extra; do
    apt install --no-install-recommends "$package" && continue
    echo "without $package: $(grep -m 1 '^E: ' "$log" || echo 'apt-get has none')" >&2
    mkdir -p "$(dirname "$stamp")" && echo "$package" >> "$stamp"
done

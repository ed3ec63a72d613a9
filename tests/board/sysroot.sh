#!/bin/sh
# sysroot.sh [ARCHITECTURE [PACKAGE..]]: a folder with what gnomon needs of that Debian architecture
# (this machine's), to build against and to be a virtual machine's root, made once and kept in the
# user's cache; prints its name. With packages: downloads those into the folder we are in instead, and
# nothing that they depend on. SUITE=trixie: of that Debian, and not of this machine's. This machine's
# own packages stay as they are: apt works on a state of its own, with the machine's sources, or for
# another suite with its mirror. Exit status 77, with the reason on stderr, where they cannot be had.
#   FOR=gpus   not a machine's root, but that of tests/gpus: Mesa's drivers for GPUs that are not here
set -eu
architecture=${1:-$(dpkg --print-architecture 2> /dev/null || true)}
[ $# = 0 ] || shift
# shellcheck disable=SC1091
codename=$(. /etc/os-release && echo "${VERSION_CODENAME:-unknown}")
store=${XDG_CACHE_HOME:-$HOME/.cache}/gnomon/board
suite=${SUITE:-$codename}
[ "${FOR:-}" != gpus ] || suite=trixie # the first with mesa-drm-shim; the budgets are its Mesa's
root=$store/${FOR:-root}-$architecture-$suite-$(sha256sum < "$0" | cut -c 1-12)
state=$store/apt-${FOR:-}${FOR:+-}$architecture-$suite

build='libc6-dev libjansson-dev libpng-dev zlib1g-dev libturbojpeg0-dev libinih-dev libgpiod-dev libegl-dev libgles-dev
    libcglm-dev libdrm-dev libgbm-dev libudev-dev libcmocka-dev'
run='bash coreutils findutils grep mawk sed diffutils util-linux kbd kmscube libegl1 libgles2
    libegl-mesa0 libgl1-mesa-dri busybox-static'
[ "${FOR:-}" != gpus ] || run='libegl1 libgles2 libegl-mesa0 libgl1-mesa-dri mesa-drm-shim'

skip() {
    echo "board: $*" >&2
    exit 77
}
for tool in apt-get dpkg-deb; do
    command -v "$tool" > /dev/null || skip "needs $tool: this works on Debian alone"
done
if [ $# = 0 ] && [ -e "$root" ]; then
    touch "$root"
    echo "$root"
    exit 0
fi

mkdir -p "$state/lists/partial" "$state/cache/archives/partial"
: > "$state/status"
cat > "$state/apt.conf" << END
APT::Architecture "$architecture";
APT::Architectures { "$architecture"; };
APT::Sandbox::User "root";
Dir::State "$state";
Dir::State::status "$state/status";
Dir::Cache "$state/cache";
END
if [ "$suite" != "$codename" ]; then
    mirror=$(sh "$(dirname "$0")/../../board/mirror.sh") || skip "nothing of $suite to be had"
    keys=/usr/share/keyrings/debian-archive-keyring.gpg
    echo "deb [signed-by=$keys] $mirror $suite main" > "$state/sources.list"
    cat >> "$state/apt.conf" << END
Dir::Etc::SourceList "$state/sources.list";
Dir::Etc::SourceParts "-";
END
fi
log=$state/log
# Three tries: a mirror may be busy, or change while it is read.
apt() {
    for try in 1 2 3; do
        APT_CONFIG=$state/apt.conf apt-get -q -y "$@" > "$log" 2>&1 < /dev/null && return
        sleep "$((try * 3))"
    done
    tail -n 5 "$log" >&2
    skip "apt-get $1 failed for $suite on $architecture"
}

[ -n "$(find "$state/updated" -mmin -600 2> /dev/null)" ] || { apt update && touch "$state/updated"; }
if [ $# != 0 ]; then
    for package in "$@"; do
        case $package in
        # the newest kernel that the name without a version stands for
        linux-*-newest)
            name=${package%-newest}-$architecture
            package=$(APT_CONFIG=$state/apt.conf apt-cache depends "$name" |
                awk '/Depends: linux-[a-z]*-[0-9]/ { print $2; exit }')
            [ -n "$package" ] || skip "$name is not known"
            ;;
        esac
        apt download "$package"
    done
    exit 0
fi

echo "board: unpacking the $architecture packages of Debian's $suite, once" >&2
# shellcheck disable=SC2086
apt install --download-only --no-install-recommends $build $run
work=$(mktemp -d "$store/new.XXXXXX")
trap 'rm -rf "$work"' EXIT
# what the packages' own scripts would do, which cannot run here
for folder in bin sbin lib lib64; do
    mkdir -p "$work/usr/$folder"
    ln -s "usr/$folder" "$work/$folder"
done
for package in "$state"/cache/archives/*.deb; do
    dpkg-deb --fsys-tarfile "$package" |
        tar -x -C "$work" --keep-directory-symlink --no-same-owner --exclude='./usr/share/doc/*' \
            --exclude='./usr/share/man/*' --exclude='./usr/share/locale/*' --exclude='./dev/*'
done
[ ! -e "$work/usr/bin/mawk" ] || ln -sf mawk "$work/usr/bin/awk"
rm -rf "$state/cache/archives"
chmod 755 "$work"
touch "$work" # or it is as old as some package's folder, and goes with what nobody has used for long
mv "$work" "$root"
echo "$root"

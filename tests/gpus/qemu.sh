#!/bin/sh
# qemu.sh: prints the program that runs arm64 programs here. It comes out of Debian's package, which is
# unpacked and never installed, so that no binfmt handler is registered; kept in the user's cache.
# Exit status 77, with the reason on stderr, where it cannot be had.
set -eu
store=${XDG_CACHE_HOME:-$HOME/.cache}/gnomon/board
# shellcheck disable=SC1091
codename=$(. /etc/os-release && echo "${VERSION_CODENAME:-unknown}")
qemu=$store/qemu-user-$codename/qemu-aarch64

skip() {
    echo "gpus: $*" >&2
    exit 77
}
if [ -x "$qemu" ]; then
    touch "$(dirname "$qemu")"
    echo "$qemu"
    exit 0
fi
for tool in apt-get dpkg-deb; do
    command -v "$tool" > /dev/null || skip "needs $tool: this works on Debian alone"
done
mkdir -p "$store"
work=$(mktemp -d "$store/new.XXXXXX")
trap 'rm -rf "$work"' EXIT

# Three tries: a mirror may be busy.
download() {
    for try in 1 2 3; do
        (cd "$work" && apt-get -q download "$1") > "$work/log" 2>&1 && return
        ! grep -qE 'Unable to locate|no installation candidate' "$work/log" || return
        sleep "$((try * 3))"
    done
    return 1
}
# The package whose programs are static: the latter from trixie on, where the former is empty.
mkdir "$work/done"
for name in qemu-user-static qemu-user; do
    download "$name" || continue
    mkdir "$work/$name"
    dpkg-deb --fsys-tarfile "$work/$name"_*.deb |
        tar -x -C "$work/$name" --wildcards './usr/bin/qemu-aarch64*' 2> /dev/null || continue
    found=$(find "$work/$name/usr/bin" -type f -name 'qemu-aarch64*' ! -name '*_be*' 2> /dev/null | head -n 1)
    [ -z "$found" ] || { mv "$found" "$work/done/qemu-aarch64" && break; }
done
[ -x "$work/done/qemu-aarch64" ] || { tail -n 2 "$work/log" >&2 && skip 'apt-get has no qemu-user'; }
mv "$work/done" "$(dirname "$qemu")" 2> /dev/null || [ -x "$qemu" ] || skip "cannot write $qemu"
echo "$qemu"

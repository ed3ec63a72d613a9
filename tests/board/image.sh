#!/bin/bash
# make image KIND=efi (make check-image) in QEMU's machine with UEFI: it starts, and a picture stands; the data partition grows; while it
# stands nothing is written but to that; a model that mtools copies into its folder is there after the next start; a broken one is not,
# and the reason is on the card; wrong lines of board.ini are named there; after cuts of power at random moments (TIMES=, 3) a picture stands.
#   IMAGE=FILE  ARCH=amd64|arm64  STILL=SECONDS without writing (60)
# The image is copied first. Pictures stay in OUT.
set -eu
: "${O:=build}" "${VERSION:?}"
arch=${ARCH:-amd64} image=${IMAGE:-$O/gnomon-$VERSION-efi-${ARCH:-amd64}.img} out=${OUT:-$O/image-$arch} bad=0
case $arch in
amd64) qemu=(qemu-system-x86_64 -machine q35 -cpu qemu64 -bios /usr/share/ovmf/OVMF.fd) ;;
arm64) qemu=(qemu-system-aarch64 -machine virt -cpu cortex-a72 -bios /usr/share/qemu-efi-aarch64/QEMU_EFI.fd) ;;
*) echo "no machine for $arch" && exit 77 ;;
esac
for tool in "${qemu[0]}" mcopy sfdisk; do command -v "$tool" > /dev/null || { echo "needs $tool" && exit 77; }; done
[ -e "${qemu[-1]}" ] || { echo "needs ${qemu[-1]}: apt-get install ovmf qemu-efi-aarch64" && exit 77; }
[ -e "$image" ] || { echo "needs $image: make image KIND=efi ARCH=$arch" && exit 77; }
mkdir -p "$out"
card=$out/card.img
export MTOOLS_SKIP_CHECK=1
fat() { "$1" -i "$card@@1M" "${@:2}"; }

complain() {
    echo "FAIL: $*"
    bad=1
}
machine='' hz=$(getconf CLK_TCK)
switch_on() {
    rm -f "$out"/monitor.*
    mkfifo "$out/monitor.in" "$out/monitor.out"
    "${qemu[@]}" -accel tcg,thread=multi -smp 2 -m 1024 -nodefaults -display none -drive "file=$card,format=raw,if=virtio,cache=unsafe" \
        -device virtio-gpu-pci,xres=640,yres=480 -monitor "pipe:$out/monitor" -serial "file:$out/serial" -nic none > "$out/qemu.log" 2>&1 &
    machine=$!
    cat "$out/monitor.out" > "$out/monitor.log" &
    exec 3> "$out/monitor.in"
    began=$SECONDS
}
switch_off() {
    { kill -9 "$machine" && wait "$machine"; } 2> /dev/null || true
    exec 3>&-
}
trap 'switch_off; rm -f "$out"/monitor.* "$card"' EXIT
tell() { echo "$1" >&3 && sleep "${2:-1}"; }
# a picture of the scenes here has many colours; texts of a firmware or a console have few
picture() {
    tell "screendump $1.ppm" 2
    [ -s "$1.ppm" ] && [ "$(tail -c +16 "$1.ppm" | xxd -p -c 3 | sort -u | wc -l)" -gt 1000 ]
}
# differ A B: most of their bytes do; what a clip moves are fewer
differ() { [ "$(cmp -l "$out/$1.ppm" "$out/$2.ppm" | wc -l)" -gt 460000 ]; }
cpu_s() { read -ra stat < "/proc/$machine/stat" && echo $(((stat[13] + stat[14]) / hz)); }
# wait_for_picture NAME: processor seconds of the machine are what count, since the host may be busy
wait_for_picture() {
    while kill -0 "$machine" 2> /dev/null && [ "$(cpu_s)" -lt 900 ]; do
        ! picture "$out/$1" || { echo "$1: a picture after $((SECONDS - began)) s, $(cpu_s) s of the processor" && return; }
        sleep 3
    done
    complain "$1: no picture; $(tail -n 3 "$out/qemu.log")"
}
written() {
    : > "$out/monitor.log"
    tell 'info blockstats' 2
    tr -d '\r' < "$out/monitor.log" | sed -n 's/.*wr_bytes=\([0-9]*\).*/\1/p' | tail -n 1
}
mapfile -t starts < <(sfdisk --json "$image" | sed -n 's/.*"start": *\([0-9]*\).*/\1/p') # in sectors of 512 bytes
root_mb=$((starts[1] / 2048)) data_mb=$((starts[2] / 2048))
root_bytes() { sha256sum < <(dd if="$card" bs=1M skip=$root_mb count=$((data_mb - root_mb)) status=none); }
bytes_before_data() { sha256sum < <(dd if="$card" bs=1M count=$data_mb status=none); }
# the data partition, which a start repairs if power was cut
data_is_whole() {
    dd if="$card" of="$out/data.ext4" bs=1M skip=$data_mb conv=sparse status=none
    e2fsck -n "$out/data.ext4" > "$out/e2fsck" 2>&1
    local status=$?
    [ "$status" != 0 ] || debugfs -R 'ls lib' "$out/data.ext4" 2> /dev/null | grep -q content || status=1
    rm "$out/data.ext4"
    return $status
}

# ---- the first start, and what is written -----------------------------------------------------------------
cp --sparse=always "$image" "$card" && truncate -s 6G "$card"
before=$(root_bytes)
switch_on
wait_for_picture first
sleep 20
from=$(written) standing=$(bytes_before_data)
sleep "${STILL:-60}"
echo "written in ${STILL:-60} s: $(($(written) - from)) bytes"
[ "$standing" = "$(bytes_before_data)" ] || complain 'what is not the data partition was written to while a picture stood'
switch_off
[ "$before" = "$(root_bytes)" ] || complain 'the root was written to'
grown_mb=$(($(sfdisk --json "$card" | sed -n 's/.*"size": *\([0-9]*\).*/\1/p' | tail -n 1) / 2048))
[ "$grown_mb" -gt 2000 ] || complain "the data partition has $grown_mb MB of a card of 6 GB"
echo "the data partition has $grown_mb MB"

# ---- new content, broken content, board.ini ----------------------------------------------------------------
# seen NAME TEXT: a picture, and a report on the card that has the text; content is taken over while the old one is shown
seen() {
    fat mdel ::gnomon/gnomon-status.txt 2> /dev/null || true
    switch_on
    wait_for_picture "$1"
    until fat mtype ::gnomon/gnomon-status.txt > "$out/$1.txt" 2> /dev/null && grep -qF "$2" "$out/$1.txt"; do
        [ "$(cpu_s)" -lt 900 ] || { complain "$1: no report of $2 on the card: $(cat "$out/$1.txt")" && break; }
        sleep 5
    done
    picture "$out/$1" || complain "$1: no picture at the end"
    switch_off
}
fat mdel ::gnomon/scene.glb
fat mcopy assets/bench/yard.glb ::gnomon/new.glb
printf 'timezone = Europe/Nowhere\r\ncolour = red\r\nwifi = there\r\npassword = short\r\nssh_key = none\r\n' > "$out/board.ini"
fat mcopy -o "$out/board.ini" ::board.ini
seen new 'was taken over'
fat mtype ::board-problem.txt > "$out/problem.txt" 2> /dev/null || complain 'no board-problem.txt'
for text in Europe/Nowhere 'colour = red' '8 to 63' 'no public key'; do
    grep -qF "$text" "$out/problem.txt" || complain "board-problem.txt does not say $text"
done
head -c 300 assets/bench/yard.glb > "$out/broken.glb"
fat mdel ::gnomon/new.glb
fat mcopy "$out/broken.glb" ::gnomon/broken.glb
fat mcopy -o board/image/board.ini ::board.ini
seen broken 'NOT taken over'
differ first broken || complain 'the new model is not shown at the next start'
! fat mtype ::board-problem.txt > /dev/null 2>&1 || complain 'board-problem.txt stays although all is right'

# ---- power cut ---------------------------------------------------------------------------------------------
fat mdel ::gnomon/broken.glb
fat mcopy assets/sundial.glb ::gnomon/scene.glb
stood=0
for try in $(seq "${TIMES:-3}"); do
    switch_on
    at_s=$((20 + RANDOM % 160))
    [ $at_s -lt 80 ] || { wait_for_picture "start-$try" && stood=$((stood + 1)); } # the others are cut while they start
    while kill -0 "$machine" 2> /dev/null && [ "$(cpu_s)" -lt "$at_s" ]; do sleep 1; done
    switch_off
done
switch_on
wait_for_picture "after-$try-cuts"
echo "$try cuts of power, before $stood of them a picture stood"
tell system_powerdown 60
switch_off
data_is_whole || complain "the data partition after the cuts: $(cat "$out/e2fsck")"
[ "$before" = "$(root_bytes)" ] || complain 'the root was written to'
[ "$bad" != 0 ] || echo 'image: all as it should be'
exit $bad

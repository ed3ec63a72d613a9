#!/bin/bash
# run.sh FILE.guest: boots a virtual machine with the real kernel, runs the file in it, compares the
# pictures that it asked for with what `gnomon render` draws here, and ends with 0, 77 (skipped, the
# reason is the last line) or 1. It is the interpreter that a .guest file names, so such a file is a
# test and is run like one; a file with a comment `# tests: NAME..` is those, one after the other. The machine sees this one's root read-only, and writes into a folder of
# BUILD alone.
#   GN_FULL=1     the long form, for the test to look at
#   GNOMON, BUILD the program, and the folder for files that come and go (build/release)
#   ARCH          amd64 or arm64: what the machine is
#   SUITE         a Debian whose programs and libraries are in the machine, and gnomon is built for: trixie
#   HOST_BUILD    where gnomon and the tools for this machine are, when BUILD is for another one
#   KEEP=1        leave shots and logs when all is well, too
#   GUEST_ENV     "NAME=VALUE ..", for the test
set -u
here=tests/board # tests run in the top folder
# Seconds without a sign of life in which it had a third of them on a processor, or three times as many: the machine's
# kernel hangs. Once it may, since it is not what is tested.
stands_still=180
gnomon=${GNOMON:-build/release/gnomon} build=${BUILD:-build/release} host=${HOST_BUILD:-${BUILD:-build/release}}
arch=${ARCH:-amd64} script=$1 test=$(basename "$1" .guest)
began=$EPOCHREALTIME

skip() {
    echo "$*"
    exit 77
}

[ "$(uname -m)" = x86_64 ] || { echo 'not applicable: the machine is emulated on a PC' && exit 0; }
case $arch in
amd64) qemu="qemu-system-x86_64" ;;
arm64) qemu="qemu-system-aarch64" ;;
*) skip "no machine for $arch" ;;
esac
for tool in "$qemu" cpio; do command -v "$tool" > /dev/null || skip "needs $tool: make deps"; done

reason=$(mktemp)
parts=$(SUITE='' "$here/machine.sh" "$arch" 2> "$reason") # the kernel is this machine's
status=$?
cat "$reason"
rm -f "$reason"
[ "$status" = 0 ] || exit "$status"
root=/ systemd='' kernel=$parts/vmlinuz
if grep -q '^# systemd: yes' "$script"; then
    systemd=gnomon.systemd
    reason=$(mktemp)
    root=$(O=$(dirname "$build") "$here/service-root.sh" 2> "$reason")
    status=$?
    cat "$reason"
    rm -f "$reason"
    [ "$status" = 0 ] || exit "$status"
elif [ "$arch${SUITE:-}" != amd64 ]; then
    root=$("$here/sysroot.sh" "$arch") || exit
fi
[ -n "$systemd" ] || kernel=$("$here/kernel.sh" "$parts") || exit # beside what systemd takes to start it would be little

[ -x "$gnomon" ] || { echo "$gnomon is not built" && exit 1; }
out=$(realpath -m "$build/board/$test")
rm -rf "$out"
mkdir -p "$out/bin"
cp "$gnomon" "$out/bin/gnomon"
cp "$build/tests/firstflip.so" "$build/tests/keyboard" "$build/tests/touchscreen" "$build/tests/television" "$(dirname "$build")/selftest/lattice.glb" "$out/bin/" || exit 1
cp "$here/guest.sh" "$out/guest.sh"
if [ -n "$systemd" ]; then
    mkdir "$out/debs"
    cp board/wall.md "$out/"
    # shellcheck disable=SC1091
    cp "$(dirname "$build")/deb/${SUITE:-$(. /etc/os-release && echo "$VERSION_CODENAME")}"/gnomon{,-import}_*_amd64.deb "$out/debs/" || exit 1
fi
shared=$(sed -n 's/^# shared: //p' "$script") # of ../shared, where there is one
if [ -n "$shared" ] && [ -d "${GNOMON_SHARED:-../shared}/$shared" ]; then
    mkdir "$out/shared" && cp -R "${GNOMON_SHARED:-../shared}/$shared" "$out/shared/" && chmod -R u+w "$out/shared"
elif [ -n "$shared" ]; then
    skip "no ${GNOMON_SHARED:-../shared}/$shared"
fi
cp "$script" "$out/test.sh" || exit 1
needs() { grep -E '^# (heads|kernel|systemd):' "$1"; }
read -ra members < <(sed -n 's/^# tests: //p' "$script")
for member in "${members[@]}"; do
    [ "$(needs "$here/$member.guest")" = "$(needs "$script")" ] || { echo "$member needs another machine" && exit 1; }
    mkdir -p "$out/tests/$member" && cp "$here/$member.guest" "$out/tests/$member/test.sh" || exit 1
done
heads=$(sed -n 's/^# heads: \([12]\)$/\1/p' "$script")
heads=${heads:-1}
limit_in() { sed -n "s/^# $1: \([0-9]*\) s.*/\1/p" "$script"; }
limit=$([ -z "${GN_FULL:-}" ] || limit_in 'limit in full')
limit=${limit:-$(limit_in limit)}
limit=${limit:-300}
[ "$arch" = amd64 ] || limit=$((2 * limit)) # emulated, the other architecture is slower
for setting in HOST_OUT="$out" LIMIT="$limit" GN_FULL="${GN_FULL:-}" HEADS="$heads" MEMBERS="${members[*]}" ${GUEST_ENV:-}; do
    printf 'export %s=%q\n' "${setting%%=*}" "${setting#*=}"
done > "$out/env"

# Emulated, Mesa takes most of a minute to compile the programs: what it kept the last time is given
# to it again, as one file: of hundreds each would be asked for over 9p. Its names for them hold Mesa's version, the program's text
# and this processor's.
shaders=${XDG_CACHE_HOME:-$HOME/.cache}/gnomon/board/shaders-$arch${SUITE:+-$SUITE}
mkdir -p "$shaders" "$out/cache"
find "$shaders" -type f -mtime +30 -delete
tar -C "$shaders" -cf "$out/cache.tar" .

mkdir "$out/initrd.d"
cp -R "$parts/initrd.d/." "$out/initrd.d/"
install -m 755 "$here/init.sh" "$out/initrd.d/init"
(cd "$out/initrd.d" && find . | cpio --quiet -o -H newc -R 0:0) > "$out/initrd" || exit 1
rm -r "$out/initrd.d"

# The sockets' names may have 107 bytes, a folder of build/ may have more.
sockets=$(mktemp -d)
trap 'rm -rf "$sockets"' EXIT

# The machine's clock is its own: four nanoseconds an instruction, so that a second in it is one however busy the host is: nor do
# the watchdogs of a service bite earlier there. Such a machine has one processor.
clock=(-smp 1 -accel "tcg,thread=single" -icount shift=2)

# shellcheck disable=SC2054
machine=(-nodefaults -no-user-config -no-reboot -m 2048 "${clock[@]}" -display none)
case $arch in
# Not the largest processor: with 256-bit vectors Mesa draws five times slower, since each is emulated.
# And a busy host may not give it the ten ticks that the kernel wants to see before it trusts its timer.
amd64) machine+=(-machine pc -cpu qemu64) console='ttyS0 no_timer_check' ;;
arm64) machine+=(-machine virt -cpu cortex-a72) console=ttyAMA0 ;;
esac
# shellcheck disable=SC2054
machine+=(
    -kernel "$kernel" -initrd "$out/initrd"
    -append "console=$console quiet panic=-1 mitigations=off cryptomgr.notests audit=0 vt.global_cursor_default=0 $systemd $(sed -n 's/^# kernel: //p' "$script") ${KERNEL_ARGS:-}"
    -serial "file:$out/console" -nic none
    -fsdev "local,id=out,path=$out,security_model=none"
    -device virtio-9p-pci,fsdev=out,mount_tag=out
    -object rng-random,id=entropy,filename=/dev/urandom -device virtio-rng-pci,rng=entropy
    -device "virtio-gpu-pci,id=gpu0,max_outputs=$heads,xres=640,yres=480"
    # the test itself works the machine: its monitor and its viewer are ports in the machine
    -chardev "socket,id=monitor,path=$sockets/qmp,server=on,wait=off" -mon chardev=monitor,mode=control
    -device virtio-serial-pci
    -chardev "socket,id=qmp,path=$sockets/qmp" -device virtserialport,chardev=qmp,name=qmp
)
# shellcheck disable=SC2054
if [ -n "$systemd" ]; then
    truncate -s 64M "$out/stick1.img" "$out/stick2.img"
    machine+=(-drive "file=$root,format=raw,if=virtio,snapshot=on" -device qemu-xhci,id=usb
        -blockdev "driver=file,node-name=stick1,filename=$out/stick1.img"
        -blockdev "driver=file,node-name=stick2,filename=$out/stick2.img")
else
    machine+=(-fsdev "local,id=root,path=$root,security_model=none,readonly=on,multidevs=remap"
        -device virtio-9p-pci,fsdev=root,mount_tag=root)
fi
for head in $(seq "$heads"); do
    # shellcheck disable=SC2054
    machine+=(
        -vnc "unix:$sockets/vnc$head,id=vnc$head,display=gpu0,head=$((head - 1))"
        -chardev "socket,id=viewer$head,path=$sockets/vnc$head,reconnect=1"
        -device "virtserialport,chardev=viewer$head,name=vnc$head"
    )
done
# Warnings that are none: the viewers connect to QEMU itself, which listens a moment later.
timeout --kill-after=5 "$limit" "$qemu" "${machine[@]}" > "$out/qemu.log" 2>&1 < /dev/null &
process=$!
: > "$out/pulse"
cpu_s() { # of QEMU, up to now
    local qemu stat
    read -r qemu _ < "/proc/$process/task/$process/children"
    read -ra stat < "/proc/$qemu/stat"
    echo $(((stat[13] + stat[14]) / $(getconf CLK_TCK)))
}
watch_pulse() {
    local sign='' last_sign='' last_cpu=0 silence
    while sleep 5; do
        sign=$(stat -c %Y "$out/pulse")
        [ "$sign" = "$last_sign" ] || { last_sign=$sign && last_cpu=$(cpu_s); }
        silence=$(($(date +%s) - sign))
        [ "$silence" -lt $((3 * stands_still)) ] || break
        [ "$silence" -lt "$stands_still" ] || [ $((3 * ($(cpu_s) - last_cpu))) -lt "$stands_still" ] || break
    done
    : > "$out/stood-still" && kill "$process"
}
watch_pulse > /dev/null &
watch=$!
wait "$process"
status=$?
kill "$watch" 2> /dev/null
cat "$out/log" 2> /dev/null
if [ -e "$out/stood-still" ]; then
    echo "the machine stood still for $stands_still s or more; the end of its console:"
    tail -n 15 "$out/console"
    [ -n "${AGAIN:-}" ] || { echo 'once more:' && rm -rf "$sockets" && AGAIN=1 exec "$0" "$script"; }
fi
cp -Rn "$out/cache/." "$shaders/"
rm -r "$out/cache" "$out/cache.tar"
bad=0
complain() {
    echo "FAIL: $*"
    bad=1
}
if [ -e "$out/stood-still" ]; then
    complain 'the machine stood still, again'
elif [ "$status" = 124 ]; then
    complain "the machine was not done after $limit s"
elif [ ! -e "$out/rc" ]; then
    complain "the machine ended (status $status) before the test did"
    tail -n 15 "$out/qemu.log" "$out/console"
elif [ "$(cat "$out/rc")" = 77 ]; then
    exit 77
elif [ "$(cat "$out/rc")" != 0 ]; then
    bad=1
fi

# 1/255 in 99.9 % of the pixels: two machines round alike, but for the last bit of a processor's vectors
compare() { # FOLDER TURN NAME ARGUMENT..
    local shot=$1/$3 turn=$2
    shift 3
    case " $* " in *" --msaa "*) ;; *) set -- --msaa 0 "$@" ;; esac # as a screen without a GPU has it
    if ! "$host/gnomon" render --backend egl -o "$shot-expected.png" "$@"; then
        complain "gnomon render $*"
    elif ! "$host/tests/tool_compare" --turn "$turn" "$shot.png" "$shot-expected.png"; then
        complain "$shot.png is not what gnomon render $* draws"
    fi
}
for folder in "$out" "${members[@]/#/$out/tests/}"; do
    while read -r turn name arguments; do
        # shellcheck disable=SC2086
        compare "$folder" "$turn" "$name" ${arguments//\/tmp\//$out/bin/} # in the machine, it is /tmp
    done < <(cat "$folder/compare" 2> /dev/null)
done

echo "$test: $(echo "$EPOCHREALTIME $began" | awk '{ printf "%.1f", $1 - $2 }') s"
[ "$bad" = 0 ] || echo "what is left of it: $out"
[ "$bad" != 0 ] || [ -n "${KEEP:-}" ] || rm -rf "$out"
exit "$bad"

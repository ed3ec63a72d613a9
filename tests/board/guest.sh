# Runs inside the machine as root: the words that test scripts are written in, then /out/test.sh.
# /out is a folder of the host's; /out/env says what the host chose (GNOMON, GN_FULL, ..).
# shellcheck shell=bash disable=SC1091,SC2154
set -u
export LANG=C.UTF-8 XDG_CACHE_HOME=/tmp/cache XDG_CONFIG_HOME=/tmp/config XDG_RUNTIME_DIR=/run
. /out/env
cd /tmp || exit 1
bad=0
# A process more costs an emulated processor as much as twenty milliseconds' work of the shell: what is asked again and again is
# asked without one.
mkfifo /run/silence
exec {silence}<> /run/silence
sleep() { [ "$1" = 0 ] || read -r -t "$1" -u "$silence" || :; } # nobody writes there

say() {
    echo "$(now) $*"
}
now() { # milliseconds since power-on; look_at_clock: into $now
    look_at_clock
    echo "$now"
}
look_at_clock() {
    read -r now _ < /proc/uptime
    now=${now/./}0
}
fail() {
    say "FAIL: $*"
    bad=1
}
require() {
    "$@" || fail "$*"
}

# The host hears from here that the machine lives, and ends one that does not (run.sh). A machine that lives and whose time is over
# says what it waits for.
pulse() {
    until [ "$(now)" -gt $(((LIMIT - 30) * 1000)) ]; do
        now > /run/out/pulse
        sleep 5
    done
    say 'not done; what there is, and where the kernel keeps it:'
    /run/busybox ps -o pid,stat,args | grep -v ' \['
    for task in /proc/[0-9]*; do
        grep -q '^State:.D' "$task/status" 2> /dev/null && echo "$(cat "$task/comm"):" && cat "$task/stack"
    done
    /run/busybox dmesg | tail -n 30
    while sleep 5; do now > /run/out/pulse; done
}

# within SECONDS COMMAND..: true as soon as the command is
within() {
    local until now
    look_at_clock
    until=$((now + $1 * 1000))
    shift
    until "$@"; do
        look_at_clock
        [ "$now" -lt "$until" ] || return 1
        sleep 0.1
    done
}

# ---- the screen --------------------------------------------------------------------------------
port() { # NAME: the device of this virtio-serial port
    local file
    for file in /sys/class/virtio-ports/*/name; do
        [ "$(cat "$file")" != "$1" ] || { file=${file%/name} && echo "/dev/${file##*/}" && return; }
    done
    return 1
}

# qmp JSON: tells the machine's monitor, and waits for its answer (events pass by)
qmp() {
    local line
    printf '%s\n' "$1" >&"$monitor"
    while IFS= read -r -t 30 line <&"$monitor"; do
        case $line in
        *'"return"'*) return 0 ;;
        *'"error"'*) say "qmp: $line" && return 1 ;;
        esac
    done
    say "qmp: no answer to $1"
    return 1
}

# shot NAME [HEAD]: what the screen shows, into NAME.png. QEMU writes on the host's side, and counts
# heads from 0.
shot() {
    qmp '{"execute":"screendump","arguments":{"filename":"'"$HOST_OUT/$1.png"'","format":"png","device":"gpu0","head":'"$((${2:-1} - 1))"'}}'
}

same_picture() {
    shot "$1" "${3:-1}" && cmp -s "/out/$1.png" "/out/$2.png"
}
other_picture() {
    shot "$1" && ! cmp -s "/out/$1.png" "/out/$2.png"
}

# shows NAME WxH: a new shot, and whether the screen is of this size (a PNG says so in bytes 16 to 23)
shows() {
    shot "$1" || return
    # shellcheck disable=SC2046
    set -- "$2" $(od -An -t u1 -j 16 -N 8 "/out/$1.png")
    [ "$1" = $(($4 * 256 + $5))x$(($8 * 256 + $9)) ]
}

# same_as_render NAME WxH: after the machine has ended, the host compares NAME.png with what `gnomon
# render` draws there. TURN says how many degrees clockwise the display is turned.
same_as_render() {
    echo "${TURN:-0} $1 --size $2 $like $scene" >> /out/compare
}

# desktop WIDTH HEIGHT [HEAD]: the monitor of head 1 or 2 is of this size now, 0 0: none. The
# machine's VNC servers listen at ports here; this is RFB's message SetDesktopSize (RFC 6143 and the
# extension 251), with one screen.
viewers=()
desktop() {
    local size
    printf -v size '\\x%02x\\x%02x\\x%02x\\x%02x' $(($1 >> 8)) $(($1 & 255)) $(($2 >> 8)) $(($2 & 255))
    printf '%b' "\xfb\x00$size\x01\x00\x00\x00\x00\x00\x00\x00\x00\x00$size\x00\x00\x00\x00" >&"${viewers[${3:-1}]}"
}

# open_viewer HEAD PORT: the handshake is version, no security, a shared session, one encoding
# (ExtendedDesktopSize)
open_viewer() {
    local viewer
    exec {viewer}<> "$2"
    viewers[$1]=$viewer
    cat <&"$viewer" > /dev/null &
    disown
    printf 'RFB 003.008\n\x01\x01\x02\x00\x00\x01\xff\xff\xfe\xcc' >&"$viewer"
}

# The kernel tells whoever listens that something about the monitor has changed. Looking for oneself
# (the status in sysfs) would say nothing: it is as old as the last program's question.
hotplugs() {
    grep -c HOTPLUG=1 /out/uevents
}
more_hotplugs() {
    [ "$(hotplugs)" -gt "$1" ]
}
announced() { # WIDTH HEIGHT [HEAD]
    local before
    before=$(hotplugs)
    desktop "$@"
    within 30 more_hotplugs "$before" || fail "the kernel says nothing about a monitor of $1x$2"
}
# A monitor that is already so is no news.
plugged=(0 640x480 0x0)
plug() { # WxH [HEAD]
    [ "${plugged[${2:-1}]}" = "$1" ] || announced "${1%x*}" "${1#*x}" "${2:-1}"
    plugged[${2:-1}]=$1
}
unplug() { plug 0x0 "${1:-1}"; } # [HEAD]

# ---- the card ----------------------------------------------------------------------------------
gpu_device() {
    grep -l 0x1050 /sys/bus/pci/devices/*/device | sed 's,/device$,,;s,.*/,,'
}
gpu() { # bind or unbind
    gpu_device > "/sys/bus/pci/drivers/virtio-pci/$1" || fail "gpu $1"
}
load() { # vkms, gpio, keys or cec: modules that are not loaded at the start
    local module
    while read -r module; do
        /run/busybox insmod "/run/modules/$module" 2> /dev/null
    done < "/run/modules/$1.order"
}
card_of() { # gpu or vkms: /dev/dri/cardN. Some kernels put the card below the virtio device, others do not.
    local folder device
    device=$([ "$1" = gpu ] && gpu_device || echo "$1")
    for folder in /sys/class/drm/card[0-9] /sys/class/drm/card[0-9][0-9]; do
        [[ $(readlink -f "$folder/device")/ != */"$device"/* ]] || { echo "/dev/dri/${folder##*/}" && return; }
    done
    return 1
}

# ---- buttons -----------------------------------------------------------------------------------
# buttons N..: a chip with the header's lines, of which GPIOn get their names; all are released
buttons() {
    local chip=/sys/kernel/config/gpio-sim/header line
    load gpio
    grep -q configfs /proc/mounts || /run/busybox mount -t configfs none /sys/kernel/config
    mkdir -p "$chip/bank0"
    echo 54 > "$chip/bank0/num_lines"
    echo pinctrl-bcm2835 > "$chip/bank0/label"
    for line in "$@"; do
        mkdir "$chip/bank0/line$line"
        echo "GPIO$line" > "$chip/bank0/line$line/name"
    done
    echo 1 > "$chip/live"
    simulated=/sys/devices/platform/$(cat "$chip/dev_name")/$(cat "$chip/bank0/chip_name")
    for line in "$@"; do echo pull-up > "$simulated/sim_gpio$line/pull"; done
}
# press LINE [SECONDS]: a short press by default. The kernel drops edges that come in bursts, so
# none is shorter than 20 ms. bouncing LINE down|up: the contact opens and closes for 5 ms, in steps
# of one (an emulated processor takes longer), and then is as it shall be. bounced_press LINE [SECONDS]:
# a press that begins and ends so. False: a busy host took its time in the middle of a bounce, so that it
# was none, but presses of their own.
press() {
    echo pull-down > "$simulated/sim_gpio$1/pull"
    sleep "${2:-0.05}"
    echo pull-up > "$simulated/sim_gpio$1/pull"
    sleep 0.05
}
bouncing() {
    local pull=$simulated/sim_gpio$1/pull to=pull-$2 from="pull-up" i last step longest=0
    [ "$2" = down ] || from="pull-down"
    last=${EPOCHREALTIME/./}
    for i in "$to" "$from" "$to" "$from" "$to"; do
        echo "$i" > "$pull"
        step=$((${EPOCHREALTIME/./} - last))
        last=$((last + step))
        [ "$step" -le "$longest" ] || longest=$step
        pause_1ms
    done
    [ "$longest" -lt 15000 ] # microseconds; gnomon takes 20 ms for a rest
}
pause_1ms() { # at work: a processor at rest sleeps as long as the host likes
    local until=$((${EPOCHREALTIME/./} + 1000))
    while [ "${EPOCHREALTIME/./}" -lt "$until" ]; do :; done
}
bounced_press() {
    local good=0
    bouncing "$1" down || good=1
    sleep "${2:-0.1}"
    bouncing "$1" up || good=1
    sleep 0.05
    return $good
}
# no_buttons: the chip is gone, whoever uses it; buttons makes it again, perhaps under another number
no_buttons() {
    local chip=/sys/kernel/config/gpio-sim/header line
    echo 0 > "$chip/live"
    for line in "$chip"/bank0/line*; do rmdir "$line"; done
    rmdir "$chip/bank0" "$chip"
}
# kiosk TECHNIQUE..: kiosk.ini, with a mode of each, and without captions, since render has none. Pressed,
# GPIO17 and GPIO22 are next, the latter when held for 3 s prev; so is GPIO27 (without a pull-up, which a
# simulated line takes for a release).
kiosk() {
    local technique
    printf '[kiosk]\ncaptions = no\n'
    for technique in "$@"; do printf '[mode "%s"]\nshadow = %s\n' "$technique" "$technique"; done
    printf '[button "next"]\nline = GPIO17\npress = next\n'
    printf '[button "hold"]\nline = GPIO22\npress = next\nhold = prev\nhold_ms = 3000\n'
    printf '[button "prev"]\nline = GPIO27\nbias = none\npress = prev\n'
} > kiosk.ini
# changes SECONDS: reads on in the log of `show -v` to the next change of the mode, which is $mode then
changes() {
    local line tries=$(($1 * 200 + 1))
    [ "$heard" = "$log" ] || { heard=$log && exec {words}< "$log"; }
    while [ $((tries--)) -gt 0 ]; do
        while IFS= read -r -u "$words" line; do
            [[ $line != 'mode '* ]] || { mode=${line#mode } && mode=${mode%%,*} && return; }
        done
        read -r -t 0.005 -u "$silence"
    done
    return 1
}
heard=''
# seen: every change that came of a button has its frame on its way to the screen
seen() {
    [ "$(grep -E '^(mode|seen) ' "$log" | tail -n 1 | cut -c 1-4)" = seen ]
}

# ---- the program -------------------------------------------------------------------------------
# start COMMAND..: in the background, its words in /out/PROGRAM.log; $! and $program are its process.
# Its stdin is a keyboard that nobody touches, since at the end of stdin some programs go; or TTY.
start() {
    log=/out/${LOG_NAME:-${1##*/}}.log
    "$@" >> "$log" 2>&1 < "${TTY:-/run/silence}" &
    program=$!
}
# timed COMMAND..: start, and NAME.flip gets the milliseconds from exec to its first picture
timed() {
    local ns
    ns=$(date +%s%N) # the clock runs as evenly as the monotonic one
    LD_PRELOAD=/tmp/firstflip.so FIRST_FLIP=/out/${1##*/}.flip START_NS=$ns start "$@"
}
# show ARGUMENT..: gnomon on this machine's screen, a still picture; like is what `gnomon render` must be
# told for the same. The scene is one that an emulated processor can draw: 3 programs and a light, where
# the default scene (scene='') has 10 and two. One technique is one mode: no others are made ahead. Its maps are small, but where
# the size that the program itself takes is on trial: so large ones are most of what an emulated processor does until its first flip.
plain='--no-animation --msaa 0' quick="$plain --map 256" scene=/tmp/lattice.glb
like="$quick --shadow pcf"
show() {
    rm -f /out/gnomon.flip
    # shellcheck disable=SC2086
    timed gnomon show --backend kms $like "$@" $scene
}
# cube: how long kmscube takes, which lights the screen before it draws
cube() {
    rm -f /out/kmscube.flip
    timed kmscube -D "$(card_of gpu)"
    within 100 more_than_one /out/kmscube.flip || fail 'kmscube shows nothing'
    say "kmscube: first flip after $(head -n 1 /out/kmscube.flip) ms, its cube after $(sed -n 2p /out/kmscube.flip)"
    kill -9 "$program"
    wait "$program" 2> /dev/null
}
more_than_one() { [ -e "$1" ] && [ "$(wc -l < "$1")" -gt 1 ]; } # line
# flips: waits for gnomon's first flip; shown NAME: and then for a screen that stands still
flips() {
    within 300 flipped_or_gone
    [ -s /out/gnomon.flip ] || { fail "nothing on the screen: $(tail -n 3 "$log")" && return 1; }
    say "gnomon: first flip after $(head -n 1 /out/gnomon.flip) ms"
}
shown() { flips && still "$@"; } # NAME [HEAD]
flipped_or_gone() {
    [ -s /out/gnomon.flip ] || gone
}
still() {
    shot "$1-before" "${2:-1}" && sleep 0.3
    within 30 stands "$@" || fail "$1: the picture does not stand still"
    rm -f "/out/$1-before.png"
}
stands() {
    shot "$1" "${2:-1}" && cmp -s "/out/$1.png" "/out/$1-before.png" && return
    mv "/out/$1.png" "/out/$1-before.png" && sleep 0.3 && return 1
}
# back NAME FIRST WHEN [HEAD]: the picture FIRST is there again
back() {
    local begun
    begun=$(now)
    within 90 same_picture "$1" "$2" "${4:-1}" || { fail "no picture again $3: $(tail -n 3 "$log")" && return 1; }
    say "picture again $3: $(($(now) - begun)) ms"
}
alive() {
    kill -0 "$program" 2> /dev/null
}
# ended_with STATUS SECONDS: waits for the program's end
ended_with() {
    local status
    within "$2" gone || { fail "still alive after $2 s" && kill -9 "$program"; }
    wait "$program"
    status=$?
    [ "$status" = "$1" ] || fail "exit status $status, not $1: $(tail -n 3 "$log")"
}
# a child that has ended stays as a zombie until it is waited for
gone() {
    local stat
    ! alive || { read -r stat < "/proc/$program/stat" && [[ $stat == *') Z '* ]]; } 2> /dev/null
}
stop() { kill -TERM "$program" && ended_with 0 "${1:-60}"; } # it ends within a frame, and a frame may take long
said() {
    grep -q -e "$1" "$log"
}
# status: what `gnomon ctl status` says, once it answers: a frame of an emulated processor may take longer than ctl waits
status() {
    within 60 answers || fail "no status: $(cat /tmp/status.err)"
    cat /tmp/status
}
answers() { gnomon ctl status > /tmp/status 2> /tmp/status.err; }
cpu_ms() { # of the program: user and system time, ticks of 10 ms
    local stat
    read -r stat < "/proc/$program/stat"
    # shellcheck disable=SC2086
    set -- ${stat##*) }
    echo $(((${12} + ${13}) * 10))
}
# a second in which it does nothing
idle() {
    local before
    before=$(cpu_ms) && sleep 1
    [ "$(cpu_ms)" = "$before" ]
}
io_of() {
    awk -v key="$1:" '$1 == key { print $2 }' "/proc/$program/io"
}
mapped_kib() {
    awk '$1 == "VmSize:" { print $2 }' "/proc/$program/status"
}
heap_bytes() { cat "$HEAP_USE"; } # at its last picture; HEAP_USE is exported before the start
descriptors() {
    find "/proc/$program/fd" -mindepth 1 | wc -l
}

# ---- the test ----------------------------------------------------------------------------------
# Of several each has a folder of its own as /out, and a shell of its own; what it leaves is taken away.
run_members() {
    local member
    for member in $MEMBERS; do
        /run/busybox mount --bind "/run/out/tests/$member" /out
        : > /out/uevents
        say "==== $member"
        (
            bad=0 HOST_OUT=$HOST_OUT/tests/$member
            . /out/test.sh
            exit "$bad"
        ) || bad=1
        clear_away
        /run/busybox umount -l /out
    done
}
clear_away() {
    local programs
    programs=$(/run/busybox pidof gnomon kmscube modetest keyboard touchscreen television) && /run/busybox kill -9 $programs
    [ ! -e /sys/kernel/config/gpio-sim/header ] || no_buttons
    /run/busybox umount /sys/class/thermal 2> /dev/null
    rm -rf /tmp/*.ini /tmp/config /tmp/glass /tmp/keys
    chvt 1
    desktop 640 480
    sleep 1
}

mkdir -p /run/out && /run/busybox mount --bind /out /run/out || bad=1 # or the host hears no pulse
mkdir -p /tmp/cache && /run/busybox tar -xf /out/cache.tar -C /tmp/cache && : > /tmp/unpacked && cp /out/bin/* /tmp/ && PATH=/tmp:$PATH
exec {monitor}<> "$(port qmp)"
qmp '{"execute":"qmp_capabilities"}' || bad=1
: > /out/uevents
# shellcheck disable=SC2016
/run/busybox uevent /run/busybox sh -c 'echo "$ACTION $SUBSYSTEM $DEVNAME ${HOTPLUG:+HOTPLUG=1}" >> /out/uevents' &
disown
open_viewer 1 "$(port vnc1)"
[ "$HEADS" = 1 ] || open_viewer 2 "$(port vnc2)"
pulse &
disown
desktop 640 480 # as it is: the first 0 0 would be no change to QEMU, which takes it for the unset size
say 'the machine is up'
if [ -n "$MEMBERS" ]; then run_members; else . /out/test.sh; fi
say "done, $([ "$bad" = 0 ] && echo passed || echo failed)"
/run/busybox dmesg > /out/dmesg
# what Mesa has compiled in the meantime
(cd /tmp/cache && find . -type f -newer /tmp/unpacked -print0 | /run/busybox xargs -0 -r cp --parents -t /out/cache)
echo "$bad" > /out/rc

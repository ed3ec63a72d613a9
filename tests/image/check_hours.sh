#!/bin/bash
# [schedule] of a kiosk that runs: off outside of its hours by either way, lit by a command
# for a while, on while the clock is not believed, and what the status says of it.
set -u
gnomon=$(realpath "${GNOMON:-build/release/gnomon}")
folder=$(mktemp -d)
kiosk=''
trap '[ -z "$kiosk" ] || kill -KILL "$kiosk" 2> /dev/null; rm -rf "$folder"' EXIT
export XDG_CONFIG_HOME="$folder/none"
bad=0
cd "$folder" || exit 1

complain() {
    echo "FAIL: $*"
    bad=1
}
ctl() { timeout 90 "$gnomon" ctl --socket "$folder/ctl" "$@"; }
# says TEXT: the status does, within a while
says() {
    for _ in $(seq 150); do
        ctl status > status 2> err && grep -qF "$1" status && return
        sleep 0.1
    done
    complain "no \"$1\": $(grep -E '^(schedule|blanked|screen|problem|config)' status; cat err)"
}
# start LINE..: with those lines in [schedule]; the hours of which are not now
start() {
    printf '%s\n' '[render]' 'shadow = none' '[schedule]' "on = $(date -d '+2 hours' +%H:%M)-$(date -d '+3 hours' +%H:%M)" \
        "$@" > kiosk.ini
    "$gnomon" show -c kiosk.ini --backend egl --size 64x36 --socket "$folder/ctl" > kiosk.out 2> kiosk.err &
    kiosk=$!
}
stop() {
    ctl quit > /dev/null
    wait "$kiosk" || complain "it ends with $?: $(cat kiosk.err)"
    kiosk=''
}

start 'clock = trusted' 'wake = 2'
says 'schedule.on: no'
grep -q '^schedule.clock: yes' status || complain 'a trusted clock is not set'
next=$(sed -n 's/^schedule.next: //p' status)
[ "$next" -gt "$(date +%s)" ] && [ "$next" -le $(($(date +%s) + 7200)) ] || complain "it switches at $next"
# is_dark NAME: a screenshot, of that name, is a picture that says that the screen is off
is_dark() { ctl screenshot "$1.png" 2> err | grep -q '^dark: the screen is off, outside of the hours'; }
is_dark dark || complain "a dark screen: $(cat err)"
ctl blank off > /dev/null
! is_dark lit || complain "it does not wake: $(cat err)"
cmp -s dark.png lit.png && complain 'a dark screen shows the picture'
for _ in $(seq 100); do
    is_dark again && break
    sleep 0.1
done
cmp -s dark.png again.png || complain 'it stays awake'
sed -i 's/^on = .*/on = 00:00-24:00/' kiosk.ini
ctl reload > /dev/null
says 'schedule.on: yes'
! is_dark day || complain "not on in its hours: $(cat err)"
ctl blank on > /dev/null
ctl screenshot blanked.png | grep -q '^dark: the screen is switched off by blank' || complain 'a blanked screen'
stop

start 'clock = trusted' 'off = black' 'wake = 1'
says 'schedule.on: no'
grep -q '^screen.lit: yes' status || complain 'black is switched off'
stop

sed -i 's/clock = trusted/clock = sometimes/' kiosk.ini
timeout 60 "$gnomon" show --check kiosk.ini > out 2> err && complain 'a wrong clock is taken'
grep -q 'kiosk.ini:5: clock: "sometimes" is not one of checked, trusted' err || complain "$(cat err)"
printf '%s\n' '[schedule]' 'on = mon-fri 8-20' > kiosk.ini
timeout 60 "$gnomon" show --check kiosk.ini > out 2> err && complain 'wrong hours are taken'
grep -q 'kiosk.ini:2: on: "mon-fri 8-20" is not always, or hours as' err || complain "$(cat err)"
exit $bad

#!/bin/bash
# [schedule] of a kiosk that runs: off outside of its hours by either way, lit by a command
# for a while, on while the clock is not believed, darker in its hours, and what the status says of it.
. tests/kiosk.sh
compare=$(realpath "${BUILD:-build/release}/tests/tool_compare")
cd "$folder" || exit 1

# start LINE..: with those lines in [schedule]; the hours of which are not now
start() {
    printf '%s\n' '[render]' 'shadow = none' '[schedule]' "on = $(date -d '+2 hours' +%H:%M)-$(date -d '+3 hours' +%H:%M)" \
        "$@" > kiosk.ini
    show -c kiosk.ini
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

start 'clock = trusted' 'off = cec' 'cec_device = /dev/null'
says 'television.wanted: standby'
says 'television.waits: /dev/null is not a CEC adapter.*'
ctl blank off > /dev/null
says 'television.wanted: on'
stop
timeout 60 "$gnomon" show --check kiosk.ini --here > out 2> err && complain 'a file is taken for a CEC adapter'
grep -q 'kiosk.ini:6: off: /dev/null is not a CEC adapter' err || complain "$(cat err)"

# darker: a white scene is as one of .3 of its light, and white again after those hours
colour white 1,1,1
colour grey 0.3,0.3,0.3
# shows PICTURE: within a while
shows() {
    for _ in $(seq 100); do
        ctl screenshot now.png > /dev/null 2>&1 && "$compare" now.png "$1.png" > out 2>&1 && return
        sleep 0.1
    done
    complain "it is not $1: $(cat out)"
}
dims() { # HOURS
    printf '%s\n' '[scene]' 'file = white.gltf' '[render]' 'shadow = none' '[kiosk]' 'captions = no' '[schedule]' \
        "dim = $1" 'clock = trusted' > kiosk.ini
}
dims 00:00-24:00
show -c kiosk.ini
says 'schedule.dim: yes'
shows grey
dims "$(date -d '+2 hours' +%H:%M)-$(date -d '+3 hours' +%H:%M)"
ctl reload > /dev/null
says 'schedule.dim: no'
shows white
sed -i 's/clock = trusted/dim_to = 2/' kiosk.ini
ctl reload > /dev/null 2> err && complain 'more light than there is'
stop

printf '%s\n' '[schedule]' 'clock = sometimes' > kiosk.ini
timeout 60 "$gnomon" show --check kiosk.ini > out 2> err && complain 'a wrong clock is taken'
grep -q 'kiosk.ini:2: clock: "sometimes" is not one of checked, trusted' err || complain "$(cat err)"
printf '%s\n' '[schedule]' 'dim = always' > kiosk.ini
timeout 60 "$gnomon" show --check kiosk.ini > out 2> err && complain 'always dim is taken, which means never'
grep -q 'kiosk.ini:2: dim: "always" is not never, or hours as' err || complain "$(cat err)"
printf '%s\n' '[schedule]' 'on = mon-fri 8-20' > kiosk.ini
timeout 60 "$gnomon" show --check kiosk.ini > out 2> err && complain 'wrong hours are taken'
grep -q 'kiosk.ini:2: on: "mon-fri 8-20" is not always, or hours as' err || complain "$(cat err)"
exit $bad

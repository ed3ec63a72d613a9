#!/bin/bash
# gnomon ctl and a running kiosk, unseen: every command, what it says when it cannot, the socket's
# file, screenshots, reload with a bad file, --check.
. tests/kiosk.sh
compare=$(realpath "${BUILD:-build/release}/tests/tool_compare")
cp assets/bench/yard.glb "$folder/sundial.glb"
cp assets/lessons/solids.glb "$folder/other.glb"
cd "$folder" || exit 1

# expect STATUS TEXT WORD..: ctl ends with that status and says the text, on stdout if that is 0
expect() {
    local status=$1 text=$2 got
    shift 2
    ctl "$@" > out 2> err
    got=$?
    while grep -q 'too many requests; try again' err; do # twenty a second, and this machine is fast
        sleep .2
        ctl "$@" > out 2> err
        got=$?
    done
    [ "$got" = "$status" ] || complain "ctl $*: status $got, not $status: $(cat out err)"
    if [ "$status" = 0 ]; then
        grep -qF -- "$text" out || complain "ctl $*: no \"$text\" in: $(cat out)"
        [ ! -s err ] || complain "ctl $*: $(cat err)"
    else
        [ "$(wc -l < err)" = 1 ] || complain "ctl $*: not one line: $(cat err)"
        grep -qF -- "$text" err || complain "ctl $*: no \"$text\" in: $(cat err)"
    fi
}

# start ARGUMENT..: a kiosk, until it answers
start() {
    show --size 160x90 "$@"
    for _ in $(seq 600); do
        ctl status > /dev/null 2>&1 && return
        kill -0 "$kiosk" 2> /dev/null || break
        sleep 0.1
    done
    complain "no kiosk: $(cat kiosk.err)"
    exit 1
}

# stop: by ctl; status 0, and the socket is gone
stop() {
    expect 0 done quit
    wait "$kiosk"
    local got=$?
    kiosk=''
    [ "$got" = 0 ] || complain "the kiosk ends with $got: $(cat kiosk.err)"
    [ ! -e ctl ] && [ ! -e ctl.lock ] || complain "a kiosk leaves $(echo ctl*)"
}

# what was asked for is on the screen once its programs are made
settle() {
    for _ in $(seq 300); do
        ctl status | grep -q '^waits: no' && return
        sleep 0.1
    done
    complain "it waits for ever: $(ctl status)"
}

cat > kiosk.ini << 'END'
[scene]
file = sundial.glb
no_animation = yes
[render]
shadow = pcf
[mode "Plain"]
shadow = hard
[mode "Top"]
camera = Top
[mode "Dial"]
camera = Dial
shadow = none
[button "next"]
keys = space
press = next
[kiosk]
captions = no
END

# ---- no kiosk -----------------------------------------------------------------------------------
expect 1 "no kiosk answers at $folder/ctl; is gnomon show running?" status
expect 2 'unknown command "stauts"; did you mean status?' stauts
expect 2 'expected KEY VALUE' set shadow
expect 2 'no command; expected one of next, prev, mode NAME'
timeout 90 "$gnomon" ctl status > out 2> err
[ $? = 1 ] && grep -q 'no kiosk answers at /run/gnomon/ctl' err || complain "the usual place: $(cat err)"

# ---- commands -----------------------------------------------------------------------------------
start -c kiosk.ini
[ "$(stat -c '%a %F' ctl)" = '660 socket' ] || complain "the socket: $(stat -c '%a %F' ctl)"
expect 0 'mode: Plain' status
expect 0 'modes: Plain, Top, Dial' status
expect 0 "config.path: kiosk.ini" status
expect 0 'mode: Top' next
expect 0 'mode: Dial' next
expect 0 'mode: Plain' next
expect 0 'mode: Dial' prev
expect 0 'mode: Top' mode Top
expect 2 'no mode "Nosuch"; expected "Plain", "Top", "Dial"' mode Nosuch
expect 0 'paused: yes' pause
expect 0 'paused: no' pause
expect 0 'blanked: yes' blank
expect 0 'mode: Plain' mode Plain # lights the screen, too
expect 0 'blanked: no' status
expect 0 'scene: sundial.glb' next-scene
expect 0 'camera: 1' next-camera
expect 0 'camera: 2' next-camera
expect 0 'camera: 0' next-camera
expect 0 'plays: gull' play gull
expect 0 'plays: hoop' play 0
expect 0 'plays: hoop' pause on
expect 0 'plays: hoop' next-camera
expect 0 'paused: no' pause off
expect 2 "no animation named 'nosuch'; available: 0 'hoop', 1 'gull'" play nosuch
expect 0 'camera: 2' next-camera
expect 0 'camera: 0' next-camera
expect 0 'info: yes' info
expect 0 'info: no' info
for _ in 1 2; do expect 0 'blanked: yes' blank on; done
expect 0 'info: yes' info on
expect 0 'blanked: yes' pause off
for _ in 1 2; do expect 0 'blanked: no' blank off; done
expect 0 'info: no' info off
expect 2 '"of" is not on or off' blank of
expect 2 'unexpected argument "now"' blank on now
ctl status --json > out || complain 'status --json'
for key in version uptime_s mode modes scene screen frames fps paused blanked config memory_mb control input; do
    grep -q "\"$key\":" out || complain "status --json has no $key"
done

# ---- set ----------------------------------------------------------------------------------------
expect 0 'value: none' set shadow none
expect 0 'value: none' get shadow
expect 0 'mode: Top' next
expect 0 'value: none' get shadow # stronger than the mode
expect 0 'from: set shadow' get shadow
expect 0 'value: -1.5' set exposure -1.5
expect 0 'value: auto' set exposure auto
expect 0 'value: agx' set tone agx
expect 0 'value: #0a0b0c' set background '#0A0B0C'
settle
expect 0 'value: transparent' set background transparent
settle
expect 0 'value: none' set tone none
expect 0 'value: auto' set background auto
expect 2 '"99" is not auto or a number from -24 to 24' set exposure 99
expect 2 "no camera named 'Nosuch'" set camera Nosuch
settle
expect 0 'value: Top' get camera
expect 2 'backend takes a reload' set backend kms
expect 2 'did you mean shadow?' set shadwo pcf

# ---- screenshots --------------------------------------------------------------------------------
expect 0 'value: no' set captions no
expect 0 'mode: Plain' mode Plain
settle
expect 0 "file: $folder/one.png" screenshot one.png
"$gnomon" render sundial.glb --no-animation --msaa 0 --size 160x90 --shadow none -o two.png || complain 'render'
cmp -s one.png two.png || complain 'a screenshot is not what render draws'
ln -s "$folder/victim" link.png && echo kept > victim
expect 1 'not replacing it' screenshot link.png
expect 2 'does not end in .png' screenshot victim
[ "$(cat victim)" = kept ] || complain 'a screenshot was written through a link'
expect 1 'cannot write' screenshot no/such.png
[ -z "$(find . -name '.gnomon-*')" ] || complain 'a screenshot leaves half a file'

# ---- reload -------------------------------------------------------------------------------------
expect 0 'mode: Plain' reload
expect 0 'value: hard' get shadow # what was set is forgotten
settle
expect 0 file screenshot before.png
cp kiosk.ini good.ini
sed -i 's/shadow = hard/shadow = hrad/' kiosk.ini
expect 2 'kiosk.ini:7: shadow: "hrad" is not one of' reload
expect 0 'modes: Plain, Top, Dial' status
expect 0 'config.error: kiosk.ini:7: shadow:' status
expect 0 'value: hard' get shadow # the last good one
expect 0 file screenshot error.png
cmp -s before.png error.png && complain 'a bad file is not told of on the screen'
cp good.ini kiosk.ini
expect 0 'mode: Plain' reload
expect 0 'config.error: -' status
settle
expect 0 file screenshot after.png
cmp -s before.png after.png || complain 'a good file leaves something on the screen'

# a light's own settings come and go with the file; a name that no light has is one warning
printf '[light "Sun"]\nshadow = none\n[light "Lamp"]\nmap = 64\n' >> kiosk.ini
expect 0 'mode: Plain' reload
expect 0 'lights.Sun: shadow = none' status
expect 0 'lights.Lamp: map = 64 (not in this scene)' status
settle
expect 0 file screenshot sun.png
cmp -s after.png sun.png && complain 'a light without shadows has some'
cp good.ini kiosk.ini
expect 0 'mode: Plain' reload
settle
expect 0 file screenshot after.png
cmp -s before.png after.png || complain 'the settings of a light stay'

# ---- another scene, and back: a bad one changes nothing, not even what is on the screen -------------
expect 1 'no scene FILE has replaced another one' rollback
printf '%s' '{"asset":{"version":"2.0"},"scenes":[{"nodes":[]}]}' > empty.gltf
head -c 5000 sundial.glb > cut.glb
mkfifo pipe.glb
other=$folder/other.glb
problem=$(ctl status | grep '^problem')
expect 0 "scene: $other" scene "$other"
settle
expect 0 file screenshot other.png
cmp -s after.png other.png && complain 'another scene is the same picture'
expect 0 'rollback: (configured)' status
for broken in cut.glb missing.glb pipe.glb . empty.gltf; do
    expect 1 "$broken" scene "$broken"
    expect 0 "scene: $other" status
    expect 0 "$problem" status
    expect 0 'config.error: -' status
done
expect 0 file screenshot still.png
cmp -s other.png still.png || complain 'a broken scene changes the picture'
expect 0 'scene: sundial.glb' rollback
settle
expect 0 file screenshot back.png
cmp -s after.png back.png || complain 'a rollback shows something else'
expect 0 "scene: $other" rollback
expect 0 "scene: $other" reload # a file stays in its place
expect 0 'scene: sundial.glb' rollback

# ---- a second one, and what a killed one leaves -------------------------------------------------
"$gnomon" show --backend egl --size 32x32 --frames 3 --socket "$folder/ctl" > out 2> err ||
    complain "a second kiosk: $(cat err)"
grep -q 'warning: .*in use by another kiosk' err || complain "a second kiosk says: $(cat err)"
expect 0 'mode: Plain' status
kill -KILL "$kiosk"
wait "$kiosk" 2> /dev/null
[ -S ctl ] || complain 'a killed kiosk leaves no socket?'
expect 1 'no kiosk answers' status
start -c kiosk.ini
stop

# ---- a turned screen ----------------------------------------------------------------------------
start -c kiosk.ini --rotate 90
settle
expect 0 'file' screenshot turned.png
"$gnomon" render sundial.glb --no-animation --msaa 0 --size 90x160 --shadow hard -o two.png || complain 'render'
"$compare" turned.png two.png > out || complain "a screenshot of a turned screen is not upright: $(cat out)"
stop

# ---- a scene that is drawn smaller ----------------------------------------------------------------
printf '%s\n' '[scene]' 'file = sundial.glb' 'no_animation = yes' '[render]' 'msaa = 0' 'shadow = hard' '[display]' 'scale = 0.5' > small.ini
start -c small.ini
settle
expect 0 'screen.scale: 0.5' status
expect 0 'screen.scaled_by: blit' status
expect 0 'screen.width: 160' status
expect 0 file screenshot small.png
sed -i '/scale/d' small.ini
expect 0 'scene: sundial.glb' reload
settle
expect 0 'screen.scale: 1' status # auto, on a GPU that no figures are of
expect 0 'screen.scaled_by: none' status
expect 0 file screenshot large.png
"$gnomon" render sundial.glb --no-animation --msaa 0 --size 160x90 --shadow hard -o two.png || complain 'render'
cmp -s large.png two.png || complain 'after a reload without scale the picture is not that of render'
cmp -s small.png two.png && complain 'scale changes nothing'
printf 'scale = 0.4\n' >> small.ini
expect 2 '0.5 to 1' reload
stop

# ---- a name with control characters does not reach the terminal as such -----------------------------
evil=$(printf 'a\033[31m\302\233b.glb')
cp sundial.glb "$evil"
start "$evil"
expect 0 'a\u001b[31m\u009bb.glb' status
stop

# ---- nothing moves, nobody asks, no caption ends: what was asked for is shown all the same ---------
printf '%s\n' '[scene]' 'file = sundial.glb' 'no_animation = yes' '[kiosk]' 'captions = no' \
    '[mode "Plain"]' 'shadow = none' '[mode "Soft"]' 'shadow = pcss' > kiosk.ini
start -v -c kiosk.ini
expect 0 'mode: Soft' mode Soft
for _ in $(seq 600); do
    grep -q '^mode Soft' kiosk.out && break
    sleep 0.1
done
grep -q '^mode Soft' kiosk.out || complain 'a mode is not shown until something else happens'
stop

# ---- a bad file at the start ---------------------------------------------------------------------
sed 's/press = next/press = nxt/' good.ini > kiosk.ini
start -c kiosk.ini
expect 0 'config.error: kiosk.ini:15: press: unknown action "nxt"' status
expect 0 'modes: Plain, Top, Dial' status # it costs the line alone
stop
grep -q 'warning: kiosk.ini:15: press' kiosk.err || complain "a bad file at the start: $(cat kiosk.err)"

# ---- before the first scene is there: its importer takes three seconds --------------------------
mkdir slow && cp "$gnomon" slow/ && echo v > slow.obj
printf '#!/bin/sh\nsleep 3\n: > "%s/imported"\nexec cat "%s"\n' "$PWD" "$PWD/other.glb" > slow/gnomon-import && chmod 755 slow/gnomon-import
gnomon=$PWD/slow/gnomon start slow.obj
[ ! -e imported ] || complain 'the first scene was there at once'
expect 0 "scene: $PWD/sundial.glb" scene "$PWD/sundial.glb"
[ -e imported ] || complain 'the first scene was not waited for'
stop

# ---- --check -------------------------------------------------------------------------------------
# checks STATUS TEXT FILE
checks() {
    timeout 60 "$gnomon" show --check "$3" > out 2> err
    local got=$?
    [ "$got" = "$1" ] || complain "--check $3: status $got, not $1: $(cat out err)"
    cat out err | grep -qF -- "$2" || complain "--check $3: no \"$2\" in: $(cat out err)"
    [ "$1" = 0 ] || [ "$(wc -l < err)" = 1 ] || complain "--check $3: not one line: $(cat err)"
}
checks 0 'good.ini is valid: 3 modes, 1 button, 1 scene' good.ini
checks 0 'mode "Dial": camera = Dial, shadow = none' good.ini
checks 0 'button "next": keys space; press = next' good.ini
checks 2 'kiosk.ini:15: press: unknown action "nxt"' kiosk.ini
sed 's/camera = Top/camera = Tpo/' good.ini > kiosk.ini
checks 2 "kiosk.ini:9: camera: no camera named 'Tpo'" kiosk.ini
sed 's/file = sundial.glb/file = moondial.glb/' good.ini > kiosk.ini
checks 1 'kiosk.ini:2: file: ' kiosk.ini
sed 's/press = next/press = mode Nosuch/' good.ini > kiosk.ini
checks 2 'kiosk.ini:15: press: no mode "Nosuch"; expected "Plain", "Top", "Dial"' kiosk.ini
printf '%s\n' '[kiosk]' 'screenshots = nowhere' > kiosk.ini
checks 1 'kiosk.ini:2: screenshots: ' kiosk.ini
checks 1 'missing.ini' missing.ini
# a name in a script that no font has
printf '%s\n' '[mode "Sun 𒀀"]' 'shadow = pcf' > kiosk.ini
checks 0 'texts: missing here: U+12000 (no package is known)' kiosk.ini

exit $bad

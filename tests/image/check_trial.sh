#!/bin/bash
# New content, and a scene of ctl scene, that end the kiosk each time: the third start shows what was shown before, says so, and answers.
# Killed here; what proves itself by a hundred pictures stays, and an end that was asked for does not count.
. tests/kiosk.sh
cd "$folder" || exit 1
for one in 'red 1,0,0' 'green 0,1,0' 'blue 0,0,1' 'white 1,1,1'; do colour $one; done

# base CONTENT [LINE..]: the machine's kiosk.ini
base() {
    printf '%s\n' '[scene]' 'file = red.gltf' '[render]' 'shadow = none' 'msaa = 0' '[kiosk]' 'captions = no' "content = $1" "${@:2}" > base.ini
}
start() { show -c base.ini; }
take() { timeout 120 "$gnomon" take -c base.ini "$@" > take.out 2> take.err || complain "take: $(cat take.err)"; }
dies() {
    kill -KILL "$kiosk"
    wait "$kiosk" 2> /dev/null
    kiosk=''
}

# shows NAME [WHEN]: that picture comes
shows() {
    local tries
    for tries in $(seq 200); do
        ctl screenshot now.png > out 2>&1 && cmp -s now.png "$1.png" && return
        sleep 0.1
    done
    complain "${2:-no $1}: $(ctl status | grep -E '^(scene|problem|config)'; cat kiosk.err)"
}

# mark FILE TRIES: that comes to be in it
mark() {
    local tries
    for tries in $(seq 200); do
        grep -qs "^trial $2 " "$1" && return
        sleep 0.1
    done
    complain "no mark $2: $(cat "$1" 2>&1)"
}

# brings NAME: a stick with that scene alone
brings() {
    rm -rf stick && mkdir -p stick/gnomon && cp "$1.gltf" stick/gnomon/
    take stick
}

# goes_back NAME PROBLEM: dies twice more, and then shows that
goes_back() {
    dies
    start
    shows "$1" 'the second try'
    says 'problem: -' 'the second try'
    dies
    start
    shows "$2" 'the third start'
    says "problem: .*$3.*" 'the third start'
    grep -q "^gnomon: warning: .*$3" kiosk.err || complain "no line for the journal: $(cat kiosk.err)"
}

# ---- content -------------------------------------------------------------------------------------------
base content 'state = state'
start
shows red
[ ! -e state.trial ] || complain "a mark without anything new: $(cat state.trial)"
brings green
shows green
mark state.trial 1
ctl set turntable 90 > /dev/null # pictures
mark state.trial 0
ctl set turntable 0 > /dev/null
brings blue
shows blue
mark state.trial 1
goes_back blue green '2 starts with version 2 brought no picture; back to version 1'
[[ $(readlink content/current) = versions/1-* ]] || complain "the link: $(readlink content/current)"
mark state.trial 0
take stick
grep -q '^not taken again' take.out || complain "what brought no picture: $(cat take.out)"
stop
start
shows green 'the start after it'
says 'problem: -' 'the start after it'
for i in 1 2 3; do # proven: it stays
    dies
    start
    shows green "start $i of what is proven"
    says 'problem: -' "start $i of what is proven"
done

# ---- asked to end ----------------------------------------------------------------------------------------
brings white
shows white
for i in 1 2 3; do
    stop
    start
    shows white "start $i after an end that was asked for"
done
goes_back white green 'back to version 1'
[ "$(wc -l < state.trial)" = 1 ] || complain "the mark: $(cat state.trial)"

# ---- ctl scene -------------------------------------------------------------------------------------------
ctl scene "$folder/blue.gltf" > out || complain "ctl scene: $(cat out)"
shows blue
for _ in $(seq 300); do cat state state.2 2> /dev/null | grep -q '^scene .*blue.gltf' && break || sleep 0.1; done
goes_back blue green 'scene .*blue.gltf: 2 starts with it brought no picture; showing the configured scene'
stop

# ---- the first content of all, taken while nothing runs ----------------------------------------------------
base other
brings blue
start
shows blue
goes_back blue red 'content: 2 starts with .* brought no picture; showing the machine.s scene'
[ ! -L other/current ] || complain 'it is shown at the next start'
take --rollback
shows blue 'forward by hand'
goes_back blue red 'the machine.s scene'
stop

# ---- a folder that nobody takes: its content is left out, until it changes -----------------------------------
mkdir plain && cp blue.gltf plain/
base plain
start
shows blue
goes_back blue red 'the machine.s scene'
dies
start
shows red 'the next start'
stop
cp white.gltf plain/blue.gltf
start
shows white 'another file'
stop
# ---- the socket of another one ---------------------------------------------------------------------------
base no
start
shows red
first=$kiosk
cp blue.gltf red.gltf
show -c base.ini
for _ in $(seq 200); do grep -q 'in use by another kiosk' kiosk.err && break || sleep 0.1; done
grep -q 'in use by another kiosk' kiosk.err || complain "two of one socket: $(cat kiosk.err)"
kill "$first"
wait "$first"
shows blue 'the socket is free, and it is not tried again'
says 'problem: -' 'the socket is there'
says 'config.error: -' 'the socket is there'
stop
echo 'a crash at each start: two starts, then what was there before'
exit $bad

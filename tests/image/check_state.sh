#!/bin/bash
# [kiosk] state of a kiosk that runs: mode, scene and counters outlast its end and its death; what
# is lost meanwhile is shown as configured, or as it was last, with the reason. Killed while it
# saves, it finds the old state or the new one. GN_FULL=1: killed 60 times; TIMES=N: N.
. tests/kiosk.sh
times=6
[ "${GN_FULL:-}" != 1 ] || times=60
times=${TIMES:-$times}
cd "$folder" || exit 1

start() { show -c kiosk.ini "$@"; }
quiet() { [ ! -s kiosk.err ] || complain "$1: $(cat kiosk.err)"; }

colour red 1,0,0
colour green 0,1,0
colour blue 0,0,1

# config LINE..: with those lines in [kiosk]
config() {
    printf '%s\n' '[scene]' 'file = red.gltf' 'file = green.gltf' '[mode "A"]' 'shadow = none' '[mode "B"]' 'shadow = none' \
        '[mode "C"]' 'shadow = none' '[kiosk]' "$@" > kiosk.ini
}

# newest: the generation that was saved last, as $file, $starts and $mode
newest() {
    file=state
    [ ! -e state.2 ] || [ "$(sed -n 's/^sequence //p' state.2)" -lt "$(sed -n 's/^sequence //p' state)" ] || file=state.2
    starts=$(sed -n 's/^starts //p' $file) mode=$(sed -n 's/^mode //p' $file)
}

# off by default: nothing is written
config
start
says 'mode: A' 'without a state'
ctl mode B > /dev/null
stop
[ -z "$(ls | grep state)" ] || complain "a state that nobody wants: $(ls)"
start
says 'mode: A' 'without a state'
stop

# on: mode, the place in the list of scenes, counters
config 'state = state'
start
says 'state.starts: 1' 'the first start'
ctl mode B > /dev/null
ctl next-scene > /dev/null
says 'scene: green.gltf' 'the next scene'
says 'waits: no' 'the next scene'
stop
quiet 'the first start'
newest
[ "$mode" = B ] || complain "the mode is not saved: $(cat $file)"
start
says 'mode: B' 'a second start'
says 'scene: green.gltf' 'a second start'
says 'state.starts: 2' 'a second start'
says 'state.restarts: 0' 'a second start'
ctl screenshot now.png > /dev/null || complain 'no picture of the second scene'
"$gnomon" render green.gltf --size 64x36 --shadow none --msaa 0 -o green.png && cmp -s now.png green.png ||
    complain 'another picture than that of the scene'
for _ in $(seq 300); do grep -qsx "runs yes" state state.2 && break || sleep 0.1; done # it is saved that it runs
kill -KILL "$kiosk"
wait "$kiosk" 2> /dev/null
start
says 'state.restarts: 1' 'a restart'
says 'mode: B' 'a restart'
stop
quiet 'a restart'
start --mode C
says 'mode: C' 'the command line says which'
stop
config 'state = state' 'idle = first' 'idle_after = 1'
start
says 'mode: A' 'the first mode is that of the configuration'
ctl mode C > /dev/null
stop

# the scene of ctl scene
config 'state = state'
start
says 'mode: C' 'before ctl scene'
ctl scene blue.gltf > /dev/null || complain 'ctl scene'
stop
start
says "scene: $folder/blue.gltf" 'a scene that was given'
ctl rollback > /dev/null || complain 'no way back to the configuration'
says 'scene: red.gltf' 'after rollback'
ctl scene blue.gltf > /dev/null || complain 'ctl scene'
stop
mv blue.gltf gone.gltf
start
says 'scene: red.gltf' 'the given scene is missing'
grep -q '^config.error: scene .*blue.gltf: .*No such file.* (showing the configured scene)' status || complain "$(cat status)"
stop
echo '{' > blue.gltf
start
says 'scene: red.gltf' 'the given scene is broken'
grep -q '^config.error: .*blue.gltf.* (showing the configured scene)' status || complain "$(cat status)"
stop
mv gone.gltf blue.gltf
start
says "scene: $folder/blue.gltf" 'the given scene is there again'
quiet 'the given scene is there again'

# the configured scene is missing: the last good one
ctl rollback > /dev/null
says 'scene: red.gltf' 'rolled back'
stop
sed -i 's/^file = red.gltf/file = none.gltf/; /^file = green/d' kiosk.ini
start
says "scene: red.gltf" 'the last good scene'
grep -q '^config.error: .*none.gltf: .*No such file.* (showing the last good scene)' status || complain "$(cat status)"
ctl screenshot now.png > /dev/null || complain 'no picture of the last good scene'
stop
mv red.gltf away.gltf
start
says "scene: $folder/blue.gltf" 'the last but one'
stop
mv blue.gltf away2.gltf
start
says 'scene: (default scene)' 'no good scene is left'
grep -q '^config.error: .*none.gltf: .*No such file.* (showing the default scene)' status || complain "$(cat status)"
stop
mv away.gltf red.gltf

# a mode that is no longer there; a broken state
config 'state = state'
sed -i '/"C"/,+1d' kiosk.ini
start
says 'mode: A' 'a mode that is gone'
grep -q 'state: there is no mode "C" any more; starting as configured' kiosk.err || complain "$(cat kiosk.err)"
stop
config 'state = state'
for file in state state.2; do printf 'xy' | dd of=$file bs=1 seek=20 conv=notrunc 2> /dev/null; done
start
says 'state.starts: 1' 'a broken state'
[ "$(grep -c 'state: state: its checksum is wrong; starting as configured' kiosk.err)" = 1 ] || complain "$(cat kiosk.err)"
stop
start
says 'state.starts: 2' 'after a broken state'
quiet 'after a broken state'
stop

# the place in the list of scenes, from a mode with a scene of its own
rm -f state state.2
cat > kiosk.ini << 'END'
[scene]
file = red.gltf
file = green.gltf
[render]
shadow = none
[mode "A"]
exposure = 0
[mode "Own"]
file = blue.gltf
[kiosk]
state = state
END
cp green.gltf blue.gltf
start
says 'mode: A' 'a list'
ctl next-scene > /dev/null
says 'scene: green.gltf' 'the list goes on'
says 'waits: no' 'it is shown'
ctl mode Own > /dev/null
says 'scene: blue.gltf' 'the scene of a mode'
says 'waits: no' 'it is shown'
stop
start
says 'mode: Own' 'a mode with a scene'
ctl mode A > /dev/null
says 'scene: green.gltf' 'the place in the list after a restart'
stop

# the first scene is missing, and another one is chosen
rm -f state state.2
mv red.gltf away.gltf
start
says 'problem: .*red.gltf.*' 'a missing first scene'
ctl next-scene > /dev/null
says 'scene: green.gltf' 'another scene'
says 'waits: no' 'it is shown'
stop
newest
grep -qx "scene green.gltf" $file || complain "the scene that was chosen is not saved: $(cat $file)"
mv away.gltf red.gltf
rm -f state state.2
config 'state = state'
start
says 'mode: A' 'a new state'
stop

# killed at any moment of its last save: what it had read, or what it was to write
within=0 new=0
newest
for i in $(seq "$times"); do
    before=$starts
    start
    says "state.starts: $((starts + 1))" "death $i"
    for _ in $(seq 100); do # what it began with is saved at once
        newest
        [ "$starts" = "$before" ] || break
        sleep 0.1
    done
    [ "$starts" = $((before + 1)) ] || complain "death $i: $starts starts are saved, after $before"
    quiet "death $i"
    before="$starts $mode"
    grep -qx "mode: $mode" status || complain "death $i: $(grep ^mode: status), not $mode"
    next=$([ "$mode" = A ] && echo B || echo A)
    after="$starts $next"
    ctl mode $next > /dev/null
    kill -TERM "$kiosk"
    sleep "0.00$(printf %02d $((RANDOM % 100)))"
    kill -KILL "$kiosk" 2> /dev/null
    wait "$kiosk" 2> /dev/null
    newest
    case "$starts $mode" in
    "$after") new=$((new + 1)) ;;
    "$before") ;;
    *) complain "death $i: \"$starts $mode\", neither \"$before\" nor \"$after\"" ;;
    esac
    [ -z "$(ls -A | grep '^\.gnomon-')" ] || within=$((within + 1))
    rm -f .gnomon-*
done
kiosk=''
echo "killed $times times, $within of them within a save; $new states were new"
exit $bad

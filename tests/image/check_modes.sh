#!/bin/sh
# The kiosk as people use it: buttons by a script, a file that changes, scenes that are good and bad.
set -u
gnomon=${GNOMON:-build/release/gnomon}
folder=$(mktemp -d)
pid=
trap 'kill -9 $pid 2> /dev/null; rm -rf "$folder"' EXIT
export XDG_CONFIG_HOME="$folder/none"
bad=0

fail() { echo "FAIL: $*" && cat "$folder/out" "$folder/err" && bad=1; }

# start ARGUMENT..: the kiosk, unseen
start() {
    "$gnomon" show -v --backend egl --size 64x64 "$@" > "$folder/out" 2> "$folder/err" < /dev/null &
    pid=$!
}

# until_says FILE PATTERN: at most a minute
until_says() {
    left=600
    until grep -q -- "$2" "$folder/$1"; do
        left=$((left - 1))
        if [ $left = 0 ] || ! kill -0 "$pid" 2> /dev/null; then
            fail "never said \"$2\""
            return
        fi
        sleep 0.1
    done
}

# stop: by SIGTERM, with status 0, within five seconds of a loaded machine
stop() {
    kill -TERM "$pid"
    before=$(date +%s)
    wait "$pid"
    status=$?
    [ $status = 0 ] || fail "exit status $status"
    [ $(($(date +%s) - before)) -le 20 ] || fail "took long to end"
    pid=
}

# buttons: twice on, one back; p and n are keys, next is a button by its name
printf '0.5 click next\n0.7 click space\n0.9 click prev\n' > "$folder/script"
start --input-script "$folder/script"
until_says out '^mode cone, scene (default scene)'
stop

# what is pressed wrongly is said at once
printf '0.5 click nowhere\n' > "$folder/script"
"$gnomon" show --backend egl --size 64x64 --input-script "$folder/script" 2> "$folder/err" > "$folder/out" < /dev/null
[ $? = 2 ] || fail "a script that names no button"

# a file with modes: the first is on; a reload keeps the mode by its name, wherever it stands then
cat > "$folder/kiosk.ini" << 'END'
[scene]
turntable = 5
[mode "Plain"]
shadow = none
[mode "Soft"]
shadow = pcss
END
printf '0.5 click next\n' > "$folder/script"
start -c "$folder/kiosk.ini" --input-script "$folder/script"
until_says out '^mode Soft'
cat > "$folder/kiosk.ini" << 'END'
[scene]
turntable = 5
[mode "Soft"]
shadow = disk
[mode "Sharp"]
shadow = hard
END
: > "$folder/script"
for signal in USR1 USR2 ALRM IO PWR RTMIN RTMAX; do kill -$signal "$pid"; done # none of them ends it
kill -HUP "$pid"
until_says out '^reloaded, mode Soft'
echo 'shado = soft' >> "$folder/kiosk.ini"
kill -HUP "$pid"
until_says err 'kiosk.ini:7: .*shado.* (not reloaded)'
kill -0 "$pid" || fail "it ended"
stop

# scenes: the next one, which is bad; then the one behind it
echo nothing > "$folder/bad.glb"
printf '0.5 click s\n8 click s\n' > "$folder/script"
start assets/bench/s1.glb "$folder/bad.glb" assets/sundial.glb --input-script "$folder/script"
until_says err 'warning: .*bad.glb'
until_says out 'scene assets/sundial.glb'
stop

exit $bad

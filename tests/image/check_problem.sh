#!/bin/bash
# The problem in the status of a kiosk goes by itself when it is cured: a scene of next-scene whose
# file is mended, a mode whose scene is, a state that can be written again. GN_FULL=1: that one, too,
# which takes a minute.
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
# says PATTERN SECONDS WHAT: a line of the status does, within so long
says() {
    for _ in $(seq $(($2 * 10))); do
        ctl status > status 2> err && grep -q "^$1" status && return
        sleep 0.1
    done
    complain "$3: no \"$1\": $(grep -E '^(mode|scene|problem|config|state)' status; cat err)"
}
start() {
    "$gnomon" show -c kiosk.ini --backend egl --size 64x36 --socket "$folder/ctl" > kiosk.out 2> kiosk.err &
    kiosk=$!
    says 'problem: -' 15 'a start'
}
stop() {
    ctl quit > /dev/null
    wait "$kiosk" || complain "it ends with $?: $(cat kiosk.err)"
    kiosk=''
}
good='{"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"buffers":[{"byteLength":36,"uri":"data:;base64,AAAAAAAAAAAAAAAAAAAAAAAAAAAAAIA/AACAPwAAAAAAAAAA"}],
"bufferViews":[{"buffer":0,"byteLength":36}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,0,1]}]}'
echo "$good" > one.gltf

# of the list, with watch: it goes once the file is mended, and the scene can be shown
echo 'no scene' > two.gltf
printf '%s\n' '[scene]' 'file = one.gltf' 'file = two.gltf' '[render]' 'shadow = none' '[kiosk]' 'watch = yes' > kiosk.ini
start
ctl next-scene > /dev/null
says 'problem: .*two.gltf' 15 'a broken scene'
says 'scene: one.gltf' 15 'a broken scene'
sleep 3
says 'problem: .*two.gltf' 1 'a scene that is still broken'
echo "$good" > two.new
mv two.new two.gltf
says 'problem: -' 15 'a scene that is mended'
says 'scene: one.gltf' 1 'a scene that is mended'
ctl next-scene > /dev/null
says 'scene: two.gltf' 15 'the mended scene'
stop

# of a mode, without watch: when the mode is shown
echo 'no scene' > two.gltf
printf '%s\n' '[scene]' 'file = one.gltf' '[render]' 'shadow = none' '[mode "A"]' 'exposure = 0' '[mode "B"]' 'file = two.gltf' \
    '[button "b"]' 'keys = x' 'press = mode B' > kiosk.ini
start
ctl mode B > /dev/null
says 'problem: .*two.gltf' 15 'a broken mode'
says 'mode: A' 15 'a broken mode'
ctl mode A > /dev/null
says 'problem: .*two.gltf' 1 'another mode'
echo "$good" > two.gltf
ctl mode B > /dev/null
says 'mode: B' 15 'the mended mode'
says 'problem: -' 15 'the mended mode'
stop

# a state that cannot be written
printf '%s\n' '[render]' 'shadow = none' '[kiosk]' 'state = nowhere/state' > kiosk.ini
start
says 'problem: state: nowhere/state.new: cannot write: No such file' 20 'no folder for the state'
if [ "${GN_FULL:-}" = 1 ]; then
    sleep 70 # another attempt
    [ "$(grep -c 'cannot write' kiosk.err)" = 1 ] || complain "more than one warning: $(cat kiosk.err)"
    mkdir nowhere
    says 'problem: -' 80 'a folder for the state'
fi
mkdir -p nowhere
stop
grep -q '^starts 1' nowhere/state || complain 'the last save'
exit $bad

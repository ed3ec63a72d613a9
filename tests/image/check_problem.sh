#!/bin/bash
# The problem in the status of a kiosk goes by itself when it is cured: a scene of next-scene whose
# file is mended, a mode whose scene is, a state that can be written again. GN_FULL=1: that one, too,
# which takes a minute.
. tests/kiosk.sh
cd "$folder" || exit 1

start() {
    show -c kiosk.ini
    says 'problem: -' 'a start'
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
says 'problem: .*two.gltf.*' 'a broken scene'
says 'scene: one.gltf' 'a broken scene'
sleep 3
says 'problem: .*two.gltf.*' 'a scene that is still broken' 1
echo "$good" > two.new
mv two.new two.gltf
says 'problem: -' 'a scene that is mended'
says 'scene: one.gltf' 'a scene that is mended' 1
ctl next-scene > /dev/null
says 'scene: two.gltf' 'the mended scene'
stop

# of a mode, without watch: when the mode is shown
echo 'no scene' > two.gltf
printf '%s\n' '[scene]' 'file = one.gltf' '[render]' 'shadow = none' '[mode "A"]' 'exposure = 0' '[mode "B"]' 'file = two.gltf' \
    '[button "b"]' 'keys = x' 'press = mode B' > kiosk.ini
start
ctl mode B > /dev/null
says 'problem: .*two.gltf.*' 'a broken mode'
says 'mode: A' 'a broken mode'
ctl mode A > /dev/null
says 'problem: .*two.gltf.*' 'another mode' 1
echo "$good" > two.gltf
ctl mode B > /dev/null
says 'mode: B' 'the mended mode'
says 'problem: -' 'the mended mode'
stop

# a state that cannot be written
printf '%s\n' '[render]' 'shadow = none' '[kiosk]' 'state = nowhere/state' > kiosk.ini
show -c kiosk.ini
says 'problem: state: nowhere/state: cannot write: No such file.*' 'no folder for the state' 20
if [ "${GN_FULL:-}" = 1 ]; then
    sleep 70 # another attempt
    [ "$(grep -c 'cannot write' kiosk.err)" = 1 ] || complain "more than one warning: $(cat kiosk.err)"
    mkdir nowhere
    says 'problem: -' 'a folder for the state' 80
fi
mkdir -p nowhere
stop
grep -q '^starts 1' nowhere/state || complain 'the last save'
exit $bad

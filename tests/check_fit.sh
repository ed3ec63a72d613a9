#!/bin/sh
# gnomon fit: the bound is that of inspect with what was written; nothing is written where the goal is out of reach, or over a file.
. tests/script.sh

bound_of() { sed -n "s/^ *$1 *\([0-9.]*\) ms.*/\1/p" "$folder/out"; }
mkdir "$folder/fit"
cp assets/bench/yard.glb "$folder/fit/a scene.glb"
for goal in 30 60; do
    ini=$folder/fit/$goal.ini
    expect 0 '' fit "$folder/fit/a scene.glb" --for pi4 --size 1280x720 --fps $goal -o "$ini"
    fit_ms=$(bound_of 'so a frame takes')
    grep -qx 'file = a scene.glb' "$ini" || complain "fit: the scene beside the file: $(cat "$ini")"
    grep -qx '; Made by gnomon fit: Raspberry Pi 4, V3D 4.2, 1280x720, '$goal' frames a second.' "$ini" || complain 'fit: the head of the file'
    grep -qx 'max_mode = 1280x720@60' "$ini" || complain 'fit: the size that was weighed'
    [ "$(grep -cx 'max_fps = 30' "$ini")" = $((goal == 30)) ] || complain 'fit: the frame rate'
    expect 0 '' show --check "$ini"
    expect 0 '' inspect -c "$ini" --for pi4
    inspected_ms=$(bound_of 'each frame')
    [ "${fit_ms:-none}" = "$inspected_ms" ] || complain "fit: $fit_ms ms, inspect: $inspected_ms ms"
    echo "$fit_ms $goal" | awk '{ exit !($1 <= 1000 / $2 && $1 > 500 / $2) }' || complain "fit: $fit_ms ms for $goal frames a second"
done
# the weaker of two lights does without its shadow, where that is enough
cheap='assets/bench/yard.glb --for pi4 --size 640x360 --map 512 --msaa 0'
printf '[light "Lantern"]\nshadow = none\n' > "$folder/fit/lantern.ini"
bounds=
# shellcheck disable=SC2086
for config in '' "-c $folder/fit/lantern.ini"; do
    expect 0 '' inspect $config $cheap --shadow pcf2
    bounds="$bounds$(bound_of 'each frame') "
done
fps=$(echo "$bounds" | awk '{ print 2000 / ($1 + $2) }')
# shellcheck disable=SC2086
expect 0 '' fit $cheap --fps "$fps" -o "$folder/fit/lights.ini"
tail -n 2 "$folder/fit/lights.ini" | cmp -s - "$folder/fit/lantern.ini" || complain "fit: shadows of lights: $(cat "$folder/fit/lights.ini")"
expect 0 '' inspect -c "$folder/fit/lights.ini" --for pi4
[ "$(bound_of 'each frame')" = "$(echo "$bounds" | cut -d ' ' -f 2)" ] || complain "fit: the time without a light's shadow: $bounds"
cp "$ini" "$folder/fit/kept"
expect 1 '60.ini exists: fit writes over no file' fit --for pi4 -o "$ini"
cmp -s "$ini" "$folder/fit/kept" || complain 'fit wrote over a file'
expect 0 '' fit --for g610 --size 640x360 --fps 24 --shadow pcf3
grep -q 'nothing has to be given up' "$folder/out" || complain 'fit: all is within reach'
grep -qx 'shadow = pcf3' "$folder/out" || complain 'fit: what is asked for stays'
! grep -q 'taps' "$folder/out" || complain 'fit: samples that pcf3 does not have'
expect 1 'pi4 reaches at most ' fit --for pi4 --size 480x270 --fps 1000 -o "$folder/fit/no.ini"
[ ! -e "$folder/fit/no.ini" ] || complain 'fit: a file that does not reach the goal'
grep -q 'shadow = none saves ' "$folder/out" || complain 'fit: what is nearest'
expect 1 'cannot' fit --for g610 --size 64x64 -o "$folder/nowhere/kiosk.ini"
expect 1 'is a folder' fit --for g610 --size 64x64 -o "$folder"
cp assets/sundial.glb "$folder/fit/a ;scene.glb"
expect 1 'a kiosk.ini cannot name this file' fit "$folder/fit/a ;scene.glb" --for g610 --size 64x64 -o "$folder/fit/no.ini"
expect 2 'fit needs --for GPU' fit
expect 2 '--for: "pi9" is not one of' fit --for pi9
for fps in 0 nan inf -1 1e9; do expect 2 "--fps: \"$fps\" is not" fit --for pi4 --fps $fps; done
expect 2 '--size: "0x10"' fit --for pi4 --size 0x10
expect 2 "--size: 16384x16384 is more than a board's GPU draws" fit --for pi4 --size 16384x16384

exit $bad

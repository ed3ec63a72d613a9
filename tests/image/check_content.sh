#!/bin/bash
# [kiosk] watch: the scene is replaced under way, by rename and in place, half of the times by a bad
# or unfinished file. Each good one is shown within 2 s once it is written, no bad one ever, and no
# black picture; the status has what is wrong while it is. GN_FULL=1: a hundred times; TIMES=N: N.
. tests/kiosk.sh
times=30
[ "${GN_FULL:-}" != 1 ] || times=100
times=${TIMES:-$times}
cd "$folder" || exit 1

printf '\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\200\77\0\0\200\77\0\0\0\0\0\0\0\0' > triangle.bin
buffer=triangle.bin
colour red 1,0,0 32x32
colour green 0,1,0 32x32
colour blue 0,0,1 32x32
cmp -s red.png blue.png && complain 'two colours are one'
mkdir shown
cp triangle.bin shown/
cp red.gltf shown/scene.gltf
printf '%s\n' '[scene]' 'file = scene.gltf' '[render]' 'shadow = none' '[kiosk]' \
    'captions = no' 'watch = yes' > shown/kiosk.ini

show -c shown/kiosk.ini --size 32x32

milliseconds() { echo $(($(date +%s%N) / 1000000)); }
shows() { ctl screenshot now.png > /dev/null 2> err && cmp -s now.png "$1.png"; }

# within NAME: that picture comes within 2 s, counted in looks, which on a quiet machine take .08 s
# each, and until then only the one before
before=red
within() {
    local begun looks=0
    begun=$(milliseconds)
    until shows "$1"; do
        cmp -s now.png "$before.png" || complain "a picture that is neither $before nor $1"
        looks=$((looks + 1))
        if [ $looks -gt 25 ]; then
            complain "no $1 within 2 s: $(ctl status | grep -E '^(scene|problem)')"
            break
        fi
        sleep 0.05
    done
    slowest=$(($(milliseconds) - begun > slowest ? $(milliseconds) - begun : slowest))
    before=$1
}
slowest=0
for _ in $(seq 300); do
    ctl status > /dev/null 2>&1 && shows red && break
    sleep 0.1
done
within red
slowest=0

# each time a good file after what is spoilt in one of the ways
names=(green blue red)
for ((i = 0; i < times; i += 2)); do
    good=${names[i / 2 % 3]}
    case $((i / 2 % 5)) in
    0) head -c $((100 + i * 37 % 400)) "$good.gltf" > shown/scene.gltf ;; # cut short
    1) : > shown/scene.gltf ;;
    2) head -c 300 /dev/urandom > shown/.new && mv shown/.new shown/scene.gltf ;;
    3) rm shown/scene.gltf ;;
    4) sed 's/triangle.bin/missing.bin/' "$good.gltf" > shown/scene.gltf ;;
    esac
    if ((i % 4 == 0)); then # so long that it is tried; otherwise the good one comes in between
        for _ in $(seq 100); do
            shows "$before" || complain "a bad file ($((i / 2 % 5))) shows something else"
            ctl status | grep -q '^problem: .*scene.gltf\|^problem: .*missing.bin' && break
            sleep 0.05
        done
        ctl status | grep -q '^problem: -' && complain "a bad file ($((i / 2 % 5))) is no problem"
    fi
    if ((i % 3)); then
        cp "$good.gltf" shown/.new && mv shown/.new shown/scene.gltf
    else # slowly, in place
        head -c 400 "$good.gltf" > shown/scene.gltf
        sleep 0.2
        tail -c +401 "$good.gltf" >> shown/scene.gltf
    fi
    within "$good"
    for _ in 1 2 3 4 5; do # the picture comes a moment before the status
        ctl status | grep -q '^problem: -' && break
        sleep 0.05
    done
    ctl status | grep -q '^problem: -' || complain "a cured problem stays: $(ctl status | grep ^problem)"
done
sort kiosk.err | uniq -c | awk -v most="$times" '$1 > most {exit 1}' || complain "it repeats itself: $(head -3 kiosk.err)"

# a file that the scene refers to, and the configuration: another scene, which comes after its name
printf '\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\200\77\0\0\200\77' > shown/triangle.bin
for _ in $(seq 60); do ctl status | grep -q '^problem: .*byteLength' && break || sleep 0.1; done
ctl status | grep -q '^problem: .*byteLength' || complain 'a cut buffer is no problem'
cp triangle.bin shown/
for _ in $(seq 60); do ctl status | grep -q '^problem: -' && break || sleep 0.1; done
ctl status | grep -q '^problem: -' || complain "a buffer is not seen: $(ctl status | grep ^problem)"
sed -i 's/scene.gltf/later.gltf/' shown/kiosk.ini
for _ in $(seq 60); do ctl status | grep -q '^problem: .*later.gltf' && break || sleep 0.1; done
next=green
[ "$before" != green ] || next=blue
cp $next.gltf shown/later.gltf
within $next
sed -i 's/shadow = none/shadow = nnoe/' shown/kiosk.ini
for _ in $(seq 60); do ctl status | grep -q '^config.error: .*nnoe' && break || sleep 0.1; done
ctl status | grep -q '^config.error: .*kiosk.ini:4: shadow' || complain 'a bad kiosk.ini is not told'
sed -i 's/shadow = nnoe/shadow = hard/' shown/kiosk.ini
for _ in $(seq 60); do ctl status | grep -q '^config.error: -' && break || sleep 0.1; done
ctl status | grep -q '^config.error: -' || complain 'a cured kiosk.ini is not seen'
ctl get shadow | grep -q 'value: hard' || complain 'a changed kiosk.ini is not taken'

# a scene that is missing at the start comes later
ctl quit > /dev/null
wait "$kiosk" || complain "it ends with $?: $(cat kiosk.err)"
rm shown/later.gltf
show -c shown/kiosk.ini --size 32x32
for _ in $(seq 200); do ctl status 2> err | grep -q '^problem: .*showing the default scene' && break || sleep 0.1; done
ctl status | grep -q '^config.error: .*later.gltf' || complain 'a missing scene is not told on the screen'
cp red.gltf shown/later.gltf
for _ in $(seq 100); do ctl status | grep -q '^problem: -' && break || sleep 0.1; done
ctl status | grep -q '^config.error: -' || complain 'a scene that comes later is not seen'
shows red || complain 'a scene that comes later is not shown'

ctl quit > /dev/null
wait "$kiosk" || complain "it ends with $?: $(cat kiosk.err)"
kiosk=''
echo "$times files, half of them bad: the slowest good one after $slowest ms"
exit $bad

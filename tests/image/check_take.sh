#!/bin/bash
# gnomon take: a stick's folder is shown by a kiosk that runs, and after a restart; what cannot be shown is refused, with the reason on
# the stick; it is killed at random moments, and what is shown is the old version or the new one, whole. TIMES=N: killed N times (20;
# GN_FULL=1: 200).
. tests/kiosk.sh
times=20
[ "${GN_FULL:-}" != 1 ] || times=200
times=${TIMES:-$times}
cd "$folder" || exit 1

colour red 1,0,0
colour green 0,1,0
colour blue 0,0,1
printf '%s\n' '[render]' 'shadow = none' 'msaa = 0' '[kiosk]' 'captions = no' 'content = content' > base.ini
mkdir -p stick/Gnomon
on=stick/Gnomon

take() { timeout 120 "$gnomon" take -c base.ini "$@" > take.out 2> take.err; }
status() { tr -d '\r' < $on/gnomon-status.txt; }

# took NAME: what is on the stick is taken, and that colour shown
took() {
    take stick || complain "take: $(cat take.err)"
    within "$1"
    status | grep -q '^This folder was taken over: ' || complain "the report: $(status)"
}

# within NAME: that picture comes within 10 s, and until then the one before; what a busy machine takes for two files
before=red
within() {
    local tries
    for tries in $(seq 100); do
        if ctl screenshot now.png > out 2>&1; then
            cmp -s now.png "$1.png" && break
            cmp -s now.png "$before.png" || complain "a picture that is neither $before nor $1"
        fi
        sleep 0.1
    done
    [ "$tries" != 100 ] || complain "no $1: $(ctl status | grep -E '^(scene|problem|config)'; cat kiosk.err)"
    before=$1
}

# refused REASON: nothing changes, the reason is printed and on the stick
refused() {
    local was
    was=$(readlink content/current)
    ! take stick || complain "taken: $1"
    grep -q "$1" take.err || complain "no \"$1\": $(cat take.err)"
    [ "$(wc -l < take.err)" = 1 ] || complain "more than one line: $(cat take.err)"
    status | grep -q "NOT taken over: .*$1" || complain "the report: $(status)"
    [ "$(readlink content/current)" = "$was" ] || complain "another version: $1"
    [ "$(find content/versions -name '*.new')" = '' ] || complain 'a copy is left'
}

# ---- a kiosk follows ---------------------------------------------------------------------------------
cp red.gltf first.gltf
sed -i '1i [scene]\nfile = first.gltf' base.ini
show -c base.ini
within red
mkdir empty
take empty || complain 'a stick without a folder gnomon is an error'
[ ! -e empty/gnomon-status.txt ] || complain 'a report on an ordinary stick'

cp green.gltf $on/
took green # the first version, while the kiosk runs
take stick && grep -q '^already shown' take.out || complain "again: $(cat take.out)"
status | grep -q 'is shown already' || complain "the report: $(status)"
grep -q $'\r$' $on/gnomon-status.txt || complain 'no CR at the end of lines'
status | head -1 | grep -q "^$("$gnomon" --version), 20..-..-.. ..:..:.. UTC" || complain "no version and date: $(status | head -1)"
rm $on/green.gltf
mkdir $on/parts
cp blue.gltf $on/parts/b.gltf
printf '\357\273\277[scene]\r\nfile = parts/b.gltf\r\n' > $on/KIOSK.INI # as an editor of Windows writes it
took blue
ctl status | grep -q '^config.path: .*/versions/2-[0-9a-f]*/kiosk.ini' || complain 'kiosk.ini of the stick is not read'
ctl get shadow | grep -q 'value: none' || complain 'the rest is not that of the base'

# ---- a restart, and back -------------------------------------------------------------------------------
stop
show -c base.ini
within blue
before=blue
take --rollback || complain "rollback: $(cat take.err)"
within green
take stick && grep -q '^not taken again' take.out || complain "after a rollback: $(cat take.out)"
take --rollback || complain 'forward'
within blue
take && grep -q 'shown now: .*/kiosk.ini' take.out || complain "take without a folder: $(cat take.out)"
ctl scene "$folder/red.gltf" > out || complain 'ctl scene'
before=blue
within red
take --rollback # content that comes later beats ctl scene
within green
take --rollback
within blue

# ---- refused -----------------------------------------------------------------------------------------
printf '[scene]\nfile = parts/b.gltf\n[render]\nshadow = nnoe\n' > $on/KIOSK.INI
refused 'gnomon/kiosk.ini:4: shadow: "nnoe"'
printf '[scene]\nfile = missing.glb\n[mode "A"]\nfile = other.glb\n' > $on/KIOSK.INI
refused '2 errors; the first: gnomon/kiosk.ini:2: file: gnomon/missing.glb'
status | grep -q '^- gnomon/kiosk.ini:4: file: gnomon/other.glb' || complain "not all errors: $(status)"
printf '[scene]\nfile = %s/red.gltf\n' "$folder" > $on/KIOSK.INI
refused 'is not in the folder gnomon'
printf '[scene]\nfile = ../../../red.gltf\n' > $on/KIOSK.INI
refused 'is not in the folder gnomon'
cp /usr/share/common-licenses/GPL-2 "$folder/outside.ttf" 2> /dev/null || cp red.gltf "$folder/outside.ttf"
printf '[scene]\nfile = parts/b.gltf\n[render]\nfont = %s/outside.ttf\n' "$folder" > $on/KIOSK.INI
refused 'gnomon/kiosk.ini:4: font: '
printf '[scene]\nfile = parts/b.gltf\n[mode "A"]\nenvironment = ../../../outside.ttf\n' > $on/KIOSK.INI
refused 'is not in the folder gnomon'
printf '[scene]\nfile = parts/b.gltf\ncamera = Nobody\n' > $on/KIOSK.INI
refused 'Nobody'
head -c 300 red.gltf > $on/parts/b.gltf
printf '[scene]\nfile = parts/b.gltf\n' > $on/KIOSK.INI
refused 'gnomon/parts/b.gltf'
rm $on/KIOSK.INI
cp red.gltf green.gltf $on/
refused '2 scenes (green.gltf, red.gltf)'
rm $on/green.gltf
ln -s /etc/passwd $on/texture.png
refused 'gnomon/texture.png: is a symbolic link'
rm $on/texture.png && mkfifo $on/pipe
refused 'gnomon/pipe: is neither a file nor a folder'
rm $on/pipe && echo x > "$on/$(printf 'a\nb')"
refused 'has control characters'
rm "$on/$(printf 'a\nb')" && mkdir -p $on/1/2/3/4/5/6/7/8/9
refused 'more than 8 folders'
rm -r $on/1 && truncate -s 3G $on/huge.bin # holes: they are read, not written
refused 'more than 2048 MB'
rm $on/huge.bin
(cd $on && for i in $(seq 4200); do echo > "x$i"; done)
refused 'more than 4096 files'
rm $on/x*
within blue
ctl status | grep -q '^problem: -' || complain "what was refused is the kiosk's problem: $(ctl status | grep ^problem)"
timeout 20 "$gnomon" take stick > out 2> err && complain 'without a place to keep it'
grep -q 'no content = DIR' err || complain "without a place: $(cat err)"
head -c 5000 /dev/zero > $on/parts/zeros
(ulimit -f 1 && take stick) && complain 'files may have 1 KB, and it is taken'
grep -q 'gnomon/parts/zeros: cannot write its copy: ' take.err || complain "a full disk: $(cat take.err)"
[ "$(ls content/versions | wc -l)" = 2 ] || complain "a full disk: left: $(ls content/versions)"
within blue

# what is the machine's does not come with a stick
cp blue.gltf $on/parts/b.gltf
rm -f $on/*.gltf $on/parts/zeros
printf '%s\n' '[scene]' 'file = parts/b.gltf' '[display]' 'backend = window' 'card = none' 'modeline = 1' '[render]' 'shaders = parts' \
    'limit = memory_mb=900000' 'limit = nodes=1' 'without = all' '[schedule]' 'on = none' 'cec_device = /dev/null' > $on/KIOSK.INI
took blue
says "config.path: .*/versions/3-[0-9a-f]*/kiosk.ini"
for key in '4: backend' '5: card' '6: modeline' '8: shaders' '9: limit' '11: without' '13: on' '14: cec_device'; do
    status | grep -q "^- warning: gnomon/kiosk.ini:$key is left out: " || complain "the report does not name $key: $(status)"
done
ctl get limit | grep -q '^value: nodes=1$' || complain "limits: $(ctl get limit)"
ctl get backend | grep -q 'value: egl' || complain "a stick chose the display: $(ctl get backend)"
rm $on/KIOSK.INI
cp red.gltf $on/

# a report that cannot be written is no error; the mount of a read-only stick, where this user may
rm -r $on/parts
if mkdir fixed && unshare -m sh -c 'mount --bind stick fixed && mount -o remount,bind,ro fixed' 2> err; then
    rm -f $on/gnomon-status.txt
    unshare -m sh -c "mount --bind stick fixed && mount -o remount,bind,ro fixed && exec '$gnomon' take -c base.ini fixed" > out 2> err ||
        complain "a stick that cannot be written to: $(cat err)"
    [ ! -e $on/gnomon-status.txt ] || complain 'it was written to'
    tr -d '\r' < content/gnomon-status.txt | grep -q 'was taken over' || complain 'no report beside the versions'
else
    take stick || complain "red: $(cat take.err)"
    echo 'not tried: a stick that is mounted for reading only'
fi
within red

# ---- killed ------------------------------------------------------------------------------------------
# Each version has its number in its files; the copy takes a while.
number() { # FILE: the number, or nothing where the files are not of one version
    local one
    one=$(sed -n 's/^; version //p' "$1/kiosk.ini")
    [ "$(head -c 12 "$1/big.bin")" = "$(printf 'version %4d' "$one")" ] && [ "$(stat -c %s "$1/big.bin")" = 4000012 ] &&
        cmp -s "$1/parts/b.gltf" "$folder/red.gltf" && echo "$one"
}
rm -r $on && mkdir -p $on/parts
cp red.gltf $on/parts/b.gltf
head -c 4000000 /dev/zero > zeros
fill() {
    { printf 'version %4d' "$1" && cat zeros; } > $on/big.bin
    printf '; version %d\n[scene]\nfile = parts/b.gltf\n' "$1" > $on/kiosk.ini
}
fill 1
begun=$(date +%s%N)
take stick || complain "a first one: $(cat take.err)"
most=$((($(date +%s%N) - begun) / 1000000 + 1))
# What is killed within `most` ms: longer after the old version was found, shorter after the new one, since a disk may be slower for one
# than for the next; and until both were found.
old=0 new=0 shown=1
for ((i = 2; i < 2 + times || (old * new == 0 && i < 2 + 5 * times); i++)); do
    fill $i
    "$gnomon" take -c base.ini stick > take.out 2>&1 &
    pid=$!
    after=$((RANDOM % most))
    sleep "$((after / 1000)).$(printf '%03d' $((after % 1000)))"
    kill -KILL $pid 2> /dev/null
    wait $pid 2> /dev/null
    now=$(number content/current)
    case $now in
    "$i") new=$((new + 1)) most=$((most * 7 / 8 + 1)) ;;
    "$shown") old=$((old + 1)) most=$((most * 9 / 8 + 1)) ;;
    *) complain "after a kill: '$now', neither $shown nor $i: $(ls content content/versions)" ;;
    esac
    [ -z "$now" ] || shown=$now
done
fill $i
take stick || complain "after kills: $(cat take.err)"
[ "$(number content/current)" = $i ] || complain 'after kills, not the new one'
[ "$(find content/versions -mindepth 1 -maxdepth 1 | wc -l)" = 2 ] || complain "left: $(ls content/versions)"
[ $((old > 0 && new > 0)) = 1 ] || complain "the kills are not at random: $old times the old one, $new times the new one"
within red
ctl status | grep -q '^problem: -' || complain "kills are a problem: $(ctl status | grep ^problem)"

# two at once
fill 1
"$gnomon" take -c base.ini stick > one 2>&1 &
pid=$!
take stick || complain "two at once: $(cat take.err)"
wait $pid || complain "two at once: $(cat one)"
cat one take.out | sort | tr '\n' ' ' | grep -q '^already shown taken: ' || complain "two at once: $(cat one take.out)"
stop
echo "killed $((old + new)) times, at last within $most ms: $old times the old one, $new times the new one"
exit $bad

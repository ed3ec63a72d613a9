#!/bin/sh
# The program as a user meets it: exit status, one line on stderr, odd descriptors.
. tests/script.sh

expect 0 '' --version
grep -q '^gnomon [0-9]' "$folder/out" || complain 'the version'
for command in '' $(commands_of); do
    # shellcheck disable=SC2086
    expect 0 '' $command --help
    grep -q -e '--help=all' "$folder/out" || complain "$command --help"
    [ "$(wc -l < "$folder/out")" -le 50 ] || complain "$command --help: $(wc -l < "$folder/out") lines"
    # shellcheck disable=SC2086
    expect 0 '' $command --help=all
    grep -q '^  .*--verbose' "$folder/out" || complain "$command --help=all"
done

for words in 'help' 'help render' 'version' '-V'; do
    # shellcheck disable=SC2086
    expect 0 '' $words
done
grep -q '^gnomon [0-9]' "$folder/out" || complain '-V'
expect 2 'did you mean render?' help rendr
for topic in board=board/README.md exhibit=board/wall.md use=board/use.md report=board/report.md scenes=assets/SCENES.md techniques=src/shadow/README.md; do
    expect 0 '' help "${topic%%=*}"
    cmp -s "$folder/out" "${topic#*=}" || complain "help ${topic%%=*} is not ${topic#*=}"
    "$gnomon" --help | grep -q "^  gnomon help ${topic%%=*} " || complain "--help does not name ${topic%%=*}"
done
expect 2 'is neither a command nor a topic; did you mean board?' help bord
expect 2 'the topics are board, exhibit' help quux
expect 2 '"exhibit" is neither a command nor a file' exhibit
expect 2 '-o: write -o VALUE or --out=VALUE' render -o=q.png
[ ! -e =q.png ] || complain '-o=q.png wrote a file'
expect 2 'unknown option --quux; --help lists the options' --quux
expect 2 'did you mean pcf?' render --shadow pfc -o "$folder/a.png"
expect 2 'gnomon: unknown option --sise; did you mean --size?' --sise 1x1
expect 2 'did you mean render?' rendr
expect 2 '--size: "0x10"' render --size 0x10 -o "$folder/a.png"
expect 2 '--size: "100000x10"' render --size 100000x10 -o "$folder/a.png"
expect 0 '/nowhere/x.ttf: cannot open' render --size 64x64 --caption Hi --font /nowhere/x.ttf -o "$folder/note.png"
expect 0 '' render --size 64x64 --font /nowhere/x.ttf -o "$folder/plain.png" # nobody needs it
cmp -s "$folder/note.png" "$folder/plain.png" && complain 'a caption that is not in the picture'
expect 0 'warning: shadow maps exceed the limit maps_mb=1: tiles of up to' render --size 64x64 --limit maps_mb=1 -o "$folder/plain.png"
expect 0 'warning: no light has soft shadows, so nothing is gathered' render --size 64x64 --shadow hard --gather always -o "$folder/plain.png"
expect 0 '' inspect --for pi4 --size 640x360
grep -q '^Time on Raspberry Pi 4.* at 640x360 with 4 samples' "$folder/out" || complain 'inspect: the time on a board'
# a triangle on an unseen floor, which reads the texel of its shadow
cat > "$folder/triangle.gltf" << 'END'
{"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}],
 "buffers": [{"byteLength": 36, "uri": "data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]}
END
expect 0 '' inspect --for pi4 --size 640x360 --floor 0 "$folder/triangle.gltf"
grep -qE '^ *[0-9]+ +1\.0 +[0-9]+ +floor$' "$folder/out" || complain "inspect: fetches of the floor: $(grep floor "$folder/out")"
expect 2 'gnomon: --for: "pi9" is not one of none, pi4, pi5, g31, g52, g610, a618, a660; did you mean pi4?' inspect --for pi9
expect 2 '--size: inspect needs --for GPU with it' inspect --size 640x360
expect 2 "--size: 16384x16384 is more than a board's GPU draws: at most 4096x4096" inspect --for pi4 --size 16384x16384
# each tap is one fetch
fetches=
for taps in 8 12 16; do
    expect 0 '' inspect assets/bench/s1.glb --for pi4 --size 64x64 --shadow cone --taps $taps
    fetches="$fetches$(sed -n 's/^ *[0-9]* *\([0-9.]*\) *[0-9]*  .*lit, DIRECTIONAL cone rg16f$/\1/p' "$folder/out" | head -n 1) "
done
echo "$fetches" | awk '{ exit !($2 - $1 == 4 && $3 - $2 == 4) }' || complain "inspect: fetches with 8, 12 and 16 taps: $fetches"
expect 0 '' inspect --limit maps_mb=1
grep -q 'shadow maps of [0-9]* MB exceed the limit maps_mb=1: they are reduced' "$folder/out" || complain 'inspect: maps over the limit'
expect 0 '' inspect --limit maps_mb=100
! grep -q maps_mb=100: "$folder/out" || complain 'inspect: maps within the limit'
expect 2 '--size: "100000x10"' render -v --size 100000x10 -o "$folder/a.png"
expect 2 'nosuch' render --shadow nosuch -o "$folder/a.png"
for command in show bench; do
    expect 2 '--shadow: truth is for stills: only gnomon render draws with it' $command --shadow truth
done
expect 2 '--shadow: truth is for stills' --shadow truth assets/sundial.glb
printf '[mode "Rays"]\nshadow = truth\n' > "$folder/truth.ini"
expect 2 'truth.ini:2: shadow: truth is for stills' show --check "$folder/truth.ini"

# all errors of a file, each on its line, then their number
printf '[scene]\nfile = gone.glb\n[display]\nrotate = 7\n[mode "A"]\nshadow = pfc\n[mode "A"]\nfoo = 1\n[mode "B"]\nfile = gone.glb\n' > "$folder/many.ini"
"$gnomon" show --check "$folder/many.ini" 2> "$folder/err"
[ $? = 2 ] || complain 'many errors: not status 2'
grep -qF 'many.ini: 4 errors' "$folder/err" || complain "many.ini: $(cat "$folder/err")"
for error in 'many.ini:4: rotate' 'many.ini:6: shadow' 'many.ini:7: mode "A" is there already, in line 5' 'gone.glb: cannot open'; do
    [ "$(grep -cF "$error" "$folder/err")" = 1 ] || complain "not once: $error"
done
[ "$(wc -l < "$folder/err")" = 5 ] || complain "many.ini: $(cat "$folder/err")"
expect 2 '--here is valid only with --check FILE' show --here
printf '[button "a"]\nline = no-such-line\nclick = next\n' > "$folder/here.ini"
expect 0 '' show --check "$folder/here.ini"
"$gnomon" show --check "$folder/here.ini" --here > "$folder/out" 2> "$folder/err" && complain '--here finds a line that is not there'
grep -q 'button "a": ' "$folder/err" || complain "--here: $(cat "$folder/err")"
expect 2 '--msaa 4: truth has one visibility for each pixel' render --shadow truth --msaa 4 -o "$folder/a.png"
expect 1 'over the limit maps_mb=1' render --shadow truth --size 1024x1024 --limit maps_mb=1 -o "$folder/a.png"
expect 1 'light 0 has no map: truth casts rays' render --shadow truth --aov map --size 8x8 -o "$folder/a.png"
expect 2 'no place: add --sun LAT,LON' render --aov sun-hours --date 2026-12-21 -o "$folder/a.png"
expect 2 'no date: add --date 2026-12-21, or --from and --to' render --aov sun-hours --sun 52.5,13.4 -o "$folder/a.png"
expect 2 'leave out --sun-altitude' render --aov sun-hours --sun 52.5,13.4 --date 2026-12-21 --sun-altitude 9 -o "$folder/a.png"
expect 2 '--from and --to are given together' render --aov sun-hours --sun 52.5,13.4 --to 2026-12-21T09:00 -o "$folder/a.png"
expect 2 '--from 2026-12-21: no time' render --aov sun-hours --sun 52.5,13.4 --from 2026-12-21 --to 2026-12-21T09:00 -o "$folder/a.png"
expect 2 'not later than --from' render --aov sun-hours --sun 52.5,13.4 --from 2026-12-21T09:00 --to 2026-12-21T08:00 -o "$folder/a.png"
expect 2 'more than a day after --from' render --aov sun-hours --sun 52.5,13.4 --from 2026-12-21T09:00 --to 2026-12-22T09:01 -o "$folder/a.png"
expect 2 'valid only with --aov sun-hours' render --from 2026-12-21T09:00 --to 2026-12-21T10:00 -o "$folder/a.png"
expect 1 'at 70.00, 20.00 the sun stays below the horizon on 2026-12-21' render --aov sun-hours --sun 70,20 --date 2026-12-21 -o "$folder/a.png"
printf '#?RADIANCE\n' > "$folder/sky.hdr"
printf 'ISO-10303-21;\n' > "$folder/part.step"
printf 'BLENDER-v304' > "$folder/model.blend"
printf '\253KTX 20\273' > "$folder/wood.ktx2"
for file in sky.hdr part.step model.blend wood.ktx2; do
    expect 1 "; what can be read is .glb and .gltf, and .obj .fbx .stl .ply .dae through gnomon-import: " inspect "$folder/$file"
done
expect 1 'sky.hdr: a Radiance picture; ' inspect "$folder/sky.hdr"
expect 1 'part.step: STEP; ' inspect "$folder/part.step"
expect 1 'model.blend: a Blender file; ' inspect "$folder/model.blend"
expect 1 'open it in Blender and choose File > Export > glTF 2.0, format .glb' inspect "$folder/model.blend"
expect 1 'wood.ktx2: a KTX2 texture; ' inspect "$folder/wood.ktx2"
printf 'PK\003\004' > "$folder/chair.usdz"
expect 1 'chair.usdz: USD; ' inspect "$folder/chair.usdz"
expect 1 "$folder/missing.glb" render "$folder/missing.glb" -o "$folder/a.png"
expect 1 "$folder/missing.ini" render -c "$folder/missing.ini" -o "$folder/a.png"
printf '[render]\nmap = 1\n' > "$folder/bad.ini"
expect 2 "$folder/bad.ini:2: map: \"1\" is not a whole number from 16 to 16384" render -c "$folder/bad.ini" -o "$folder/a.png"
[ ! -e "$folder/a.png" ] || complain 'a failure left a picture'

# the ground of the default scene is in no map: it would only coarsen them
"$gnomon" render assets/sundial.glb --plan -o "$folder/a.png" > "$folder/out" || complain 'the plan of the default scene'
sed -n "/^pass 'shadow/,/^pass 'opaque/p" "$folder/out" > "$folder/maps"
grep -q "'stone'" "$folder/maps" || complain 'the sundial casts nothing'
! grep -qE "'(court|lawn)'" "$folder/maps" || complain 'the ground is drawn into a map'

# two pictures
# samples by default: in a picture to look at, not in one to measure, nor where they take too much memory
# samples N FILE ARGUMENT..
samples() {
    wanted=$1 file=$2
    shift 2
    "$gnomon" render --plan "$@" -o "$folder/$file" > "$folder/out" 2> "$folder/err" || complain "render $*"
    grep -q "^plan .*, msaa $wanted," "$folder/out" || complain "samples of $file $*: $(head -1 "$folder/out")"
    [ ! -s "$folder/err" ] || complain "render $*: $(cat "$folder/err")"
}
samples 4 a.png --size 32x18
samples 4 a.png --size 32x18 --msaa auto
samples 2 a.png --size 32x18 --msaa 2
samples 0 a.png --size 32x18 --msaa 0
samples 0 a.pfm --size 32x18
samples 0 a.png --size 32x18 --output linear
samples 0 a.png --size 32x18 --aov normal
samples 0 a.png --size 32x18 --without msaa4
samples 0 a.png --size 32x18 --shadow truth --samples 1
samples 0 a.png --size 4200x2100 --shadow none
expect 0 '' render --size 32x24 --shadow none -o "$folder/a.png"
expect 0 '' render --size 32x24 --shadow pcf -o "$folder/b.png"
expect 0 '' compare "$folder/a.png" "$folder/a.png"
grep -q '^PSNR  *inf dB' "$folder/out" || complain "the same picture: $(cat "$folder/out")"
expect 3 "b.png differ: " compare "$folder/a.png" "$folder/b.png" --diff "$folder/d.pfm"
expect 0 '' compare "$folder/a.png" "$folder/b.png" --share 100 --json --diff "$folder/d.png"
grep -q '"psnr_db": [0-9]' "$folder/out" || complain "compare --json: $(cat "$folder/out")"
expect 3 'is 32x24, ' compare "$folder/d.png" assets/sundial.png
for technique in hard pcf5; do
    expect 0 '' render --size 160x120 --aov visibility --map 64 --shadow $technique -o "$folder/$technique.pfm"
done
for aov in distance normal; do
    expect 0 '' render --size 160x120 --aov $aov -o "$folder/$aov.pfm"
done
# tear PART FILE..: its tear against pcf5, as it is printed
tear() {
    part=$1
    shift
    expect 0 '' compare --shadows --share 100 "$@" "$folder/pcf5.pfm"
    tear=$(awk -v part="$part" '$1 == part { print $2 }' "$folder/out")
}
tear all "$folder/pcf5.pfm"
[ "$tear" = 0.0000 ] || complain "the same shadows: $(cat "$folder/out")"
tear all "$folder/hard.pfm"
all=$tear
awk "BEGIN { exit !($all > .1) }" || complain "hard shadows: $(cat "$folder/out")"
tear surfaces --distance "$folder/distance.pfm" "$folder/hard.pfm"
[ "$tear" != "$all" ] || complain "edges of depth do not count: $(cat "$folder/out")"
by_depth=$tear
tear surfaces --distance "$folder/distance.pfm" --normal "$folder/normal.pfm" "$folder/hard.pfm"
[ "$tear" != "$by_depth" ] || complain "edges of normal do not count: $(cat "$folder/out")"
edges=$tear
tear surfaces --distance "$folder/distance.pfm" --normal "$folder/normal.pfm" --to-light 1,.2,0 "$folder/hard.pfm"
[ "$tear" != "$edges" ] || complain "the direction does not count: $(cat "$folder/out")"
tear floor --distance "$folder/distance.pfm" "$folder/hard.pfm"
[ "$tear" = - ] || complain "a floor: $(cat "$folder/out")"
expect 0 '' compare --shadows --share 100 --json "$folder/hard.pfm" "$folder/pcf5.pfm"
grep -q '"tear_percent_px": [0-9]' "$folder/out" || complain "compare --shadows --json: $(cat "$folder/out")"
expect 1 'a.png is 32x24, the pictures are 160x120' compare --shadows --normal "$folder/a.png" "$folder/hard.pfm" "$folder/pcf5.pfm"
expect 2 '--to-light: add --shadows' compare --to-light 0,1,0 a.png b.png
expect 2 '--distance, --to-light: add --shadows' compare --distance d.pfm a.png b.png
expect 2 'add --normal FILE' compare --shadows --to-light 0,1,0 a.png b.png
expect 2 'is no direction' compare --shadows --normal n.pfm --to-light 0,0,0 a.png b.png
expect 2 'compare: expected two pictures' compare "$folder/a.png"
expect 2 'compare: unexpected argument' compare a.png b.png c.png
expect 2 'lesson: expected list, all or the name of a lesson' lesson
expect 2 'there is no lesson "acnee"; did you mean acne?' lesson acnee
expect 2 'one lesson, or all' lesson acne leak
expect 2 'is not valid for lesson' lesson acne --shadow pcf
expect 1 'lesson:nowhere: there is no such scene inside' render lesson:nowhere -o "$folder/a.png"
expect 2 'take: nothing is to be taken' take
expect 2 'take: nothing is to be taken' take "$folder" --content no
expect 2 'take: unexpected argument "b": it takes one folder' take a b
expect 2 'take: --rollback takes no folder' take --rollback a
expect 1 'missing: cannot open it' take "$folder/missing" --content "$folder/content"
expect 1 'there is no version before this one' take --rollback --content "$folder/content"
expect 2 'is not valid for take' take --size 8x8
expect 1 'missing.png' compare "$folder/missing.png" "$folder/a.png"
expect 1 'neither PNG nor PFM' compare "$folder/a.png" tests/check_cli.sh
expect 2 'is not valid for compare' compare a.png b.png --size 8x8

# pictures of the benchmark
mkdir "$folder/scenes" "$folder/pictures"
expect 2 'score: expected a picture' score
expect 2 'score: unexpected argument' score a.pfm b.pfm
expect 2 'score --make-truth: add --truth NAME' score --make-truth
expect 2 'score --make-truth: unexpected argument' score a.pfm --make-truth --truth field-sun-00
expect 1 'no scenes of the benchmark here: `make benchmark-scenes`' score a.pfm --truth field-sun-00 --benchmark "$folder/scenes"
cp assets/sundial.glb "$folder/scenes/field-sun-00.glb"
expect 2 'unknown truth "field-sun-0"; did you mean field-sun-00?' score "$folder/a.png" --truth field-sun-0 --benchmark "$folder/scenes"
expect 2 'unknown truth "../a"' score "$folder/a.png" --truth ../a --benchmark "$folder/scenes"
expect 2 'unknown truth "a"' score "$folder/a.png" --benchmark "$folder/scenes"
expect 1 'no truth yet: `gnomon score --make-truth --truth field-sun-00`' score "$folder/a.png" --truth field-sun-00 --benchmark "$folder/scenes"
expect 0 '' score --make-truth --truth field-sun-00 --benchmark "$folder/scenes"
truth=$folder/scenes/field-sun-00.pfm
expect 1 'a.png is 32x24, the truth of field-sun-00 is 640x480' score "$folder/a.png" --truth field-sun-00 --benchmark "$folder/scenes"
expect 1 'missing.pfm' score "$folder/missing.pfm" --truth field-sun-00 --benchmark "$folder/scenes"
expect 1 'no pictures called as scenes' score "$folder/pictures" --benchmark "$folder/scenes"
head -c 99999 "$truth" > "$folder/pictures/field-sun-00.pfm"
expect 1 'field-sun-00.pfm: PFM: 99983 bytes of pixels, not the 3686400 of 640x480' score "$folder/pictures" --benchmark "$folder/scenes"
expect 2 '--truth is of one picture' score "$folder/pictures" --truth field-sun-00 --benchmark "$folder/scenes"
cp "$truth" "$folder/pictures/field-sun-00.pfm"
expect 0 '' score "$folder/pictures" --benchmark "$folder/scenes" --csv
grep -q '^mean,field,sun,1,wrong,0,' "$folder/out" || complain "score --csv: $(cat "$folder/out")"
expect 0 '' score "$folder/pictures/field-sun-00.pfm" --benchmark "$folder/scenes" --json
grep -q '"wrong_percent": 0' "$folder/out" || complain "score --json: $(cat "$folder/out")"
cp "$folder/a.png" "$folder/pictures"
expect 2 'unknown truth "a"' score "$folder/pictures" --benchmark "$folder/scenes"
cp "$folder/d.pfm" "$truth"
expect 1 'is 32x24, not the 640x480 of a truth: delete it' score "$folder/pictures/field-sun-00.pfm" --benchmark "$folder/scenes"
rm -f "$folder/a.png"

# asked to stop, a long run ends at once and leaves no half of a file
mkdir "$folder/frames"
"$gnomon" render assets/sundial.glb --size 64x64 --frames 9999 -o "$folder/frames/%04d.png" &
for _ in $(seq 300); do [ -e "$folder/frames/0000.png" ] || sleep .1; done
kill -TERM $!
wait $!
[ $? = 143 ] || complain "render by SIGTERM: exit status $?"
[ -e "$folder/frames/0000.png" ] && [ -z "$(ls -A "$folder/frames" | grep -v png)" ] || complain 'what a stopped run leaves'
[ ! -e "$folder/frames/9998.png" ] || complain 'a run that was not stopped'

# so do rays
"$gnomon" render assets/sundial.glb --shadow truth --samples 60000 -o "$folder/rays.png" 2> "$folder/err" &
sleep 1
kill -TERM $!
wait $!
[ $? = 143 ] && [ ! -s "$folder/err" ] || complain "rays by SIGTERM: $(cat "$folder/err")"
[ -z "$(ls "$folder" | grep rays)" ] || complain 'what stopped rays leave'

# decimal points are points, whatever the locale
LC_ALL=de_DE.UTF-8 "$gnomon" render --time 1.5 --size 8x8 -o "$folder/a.png" || complain 'numbers in a German locale'

# a closed or full descriptor is no crash
"$gnomon" --help | head -n 1 > /dev/null
"$gnomon" --version >&- 2>&-
[ $? -le 1 ] || complain 'closed descriptors'
"$gnomon" --sise >&- 2>&-
[ $? = 2 ] || complain 'closed descriptors and a wrong option'
"$gnomon" --version > /dev/full 2> "$folder/err"
[ $? = 1 ] && grep -q 'standard output' "$folder/err" || complain 'a full disk'
(trap '' PIPE && "$gnomon" --help 2> "$folder/err" | :)
[ ! -s "$folder/err" ] || complain 'a reader that had enough'

exit $bad

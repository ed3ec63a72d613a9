#!/bin/bash
# gnomon bake: what it writes is read without a warning and looks as before, still and under way; it is
# smaller where it can be; errors are one line and leave nothing behind.
. tests/script.sh
assets=${GNOMON_SHARED:-../shared}/assets
"$gnomon" bake assets/sundial.glb -o "$folder/probe.glb" > "$folder/out" 2> "$folder/err"
if grep -q libmeshoptimizer "$folder/err"; then
    echo "$(cat "$folder/err")"
    exit 77
fi

# decibels FILE BAKED OPTION..: how alike the pictures of two files are
decibels() {
    local a=$1 b=$2
    shift 2
    "$gnomon" render "$a" -o "$folder/a.png" --size 320x240 --msaa 0 "$@" 2> "$folder/err.a" || complain "$a: $(cat "$folder/err.a")"
    "$gnomon" render "$b" -o "$folder/b.png" --size 320x240 --msaa 0 "$@" 2> "$folder/err.b" || complain "$b: $(cat "$folder/err.b")"
    [ "$(wc -l < "$folder/err.b")" -le "$(wc -l < "$folder/err.a")" ] || complain "$b: a new warning: $(cat "$folder/err.b")"
    "$gnomon" compare "$folder/a.png" "$folder/b.png" 2> /dev/null | awk '/^PSNR/ { print $2 == "inf" ? 999 : int($2) }'
}

# same FILE: baked, it looks the same
same() {
    local got
    "$gnomon" bake "$1" -o "$folder/baked.glb" > "$folder/out" 2> "$folder/err" || complain "$1: $(cat "$folder/err")"
    # a map's grid follows the scene's box, which moves by less than a grid's step: true shadows do not
    for options in "${2:---time 0}" '--time 1.3 --shadow truth --samples 4'; do
        # shellcheck disable=SC2086
        got=$(decibels "$1" "$folder/baked.glb" $options)
        echo "$(basename "$1") $options: PSNR ${got:-none} dB, $(stat -c %s "$1") to $(stat -c %s "$folder/baked.glb") bytes"
        [ "${got:-0}" -ge 40 ] || complain "$1 $options: PSNR ${got:-none} dB"
    done
}

# value NAME: of the report of the last bake
value() { sed -n "s/.*\"$1\": *\([0-9.e+-]*\).*/\1/p" "$folder/out" | "${2:-head}" -n 1; }

same assets/sundial.glb '--time 0 --shadow none'
[ "$(stat -c %s "$folder/baked.glb")" -lt "$(stat -c %s assets/sundial.glb)" ] || complain 'the sundial is not smaller'
cp "$folder/baked.glb" "$folder/once.glb"
same "$folder/once.glb" # again, which changes nothing
for file in gltf/Fox.glb gltf/robot.glb gltf/MorphStressTest.gltf gltf/kenney_alien.glb derived/Fox_draco.glb generated/four_spots_instanced.glb; do
    if [ -f "$assets/$file" ]; then
        same "$assets/$file"
    else
        echo "SKIPPED: no $assets/$file"
    fi
done

"$gnomon" bake assets/sundial.glb -o "$folder/half.glb" --simplify .5 --json > "$folder/out" 2> "$folder/err" || complain "--simplify: $(cat "$folder/err")"
[ "$(value triangles tail)" -lt "$(value triangles head)" ] || complain 'simplified, no triangle less'
"$gnomon" bake assets/sundial.glb -o "$folder/small.glb" --texture-limit 16 --json > "$folder/out" 2> "$folder/err" || complain "--texture-limit: $(cat "$folder/err")"
[ "$(value images)" = 0 ] || [ "$(value scaled_images)" -gt 0 ] || complain 'no picture is scaled down'
"$gnomon" render "$folder/small.glb" -o "$folder/a.png" --size 32x32 2> "$folder/err" || complain "small.glb: $(cat "$folder/err")"

# refused STATUS TEXT ARGUMENT..: one line, and no file
refused() {
    local status=$1 text=$2 got
    shift 2
    rm -rf "$folder/none" && mkdir "$folder/none"
    (cd "$folder/none" && timeout 60 "$gnomon" bake "$@" > ../out 2> ../err)
    got=$?
    [ "$got" = "$status" ] || complain "bake $*: exit status $got"
    [ "$(wc -l < "$folder/err")" = 1 ] && grep -qF -- "$text" "$folder/err" || complain "bake $*: $(cat "$folder/err")"
    [ -z "$(ls -A "$folder/none")" ] || complain "bake $*: leaves $(ls -A "$folder/none")"
}
sundial=$(realpath assets/sundial.glb)
head -c 3000 "$sundial" > "$folder/cut.glb"
printf 'ISO-10303-21;\n' > "$folder/part.step"
refused 2 'bake needs -o' "$sundial"
refused 2 'name it so' "$sundial" -o a.obj
refused 1 'nowhere' "$sundial" -o nowhere/a.glb
refused 1 'cut.glb' ../cut.glb -o a.glb
refused 1 'part.step' ../part.step -o a.glb
refused 1 'gone.glb' gone.glb -o a.glb
refused 2 '--simplify' "$sundial" -o a.glb --simplify 2
# a full disk: the old file stays
mkdir "$folder/full"
echo old > "$folder/full/a.glb"
(ulimit -f 32 && "$gnomon" bake "$sundial" -o "$folder/full/a.glb" > "$folder/out" 2> "$folder/err") && complain 'a full disk is not noticed'
[ "$(wc -l < "$folder/err")" = 1 ] || complain "a full disk: $(cat "$folder/err")"
[ "$(ls -A "$folder/full")" = a.glb ] && [ "$(cat "$folder/full/a.glb")" = old ] || complain "a full disk leaves $(ls -A "$folder/full")"

# inspect says when baking helps, and by how much: 6.0 MB of plain floats; nothing of what is baked or small
head -c 6291456 /dev/zero > "$folder/plain.bin"
echo '{"asset":{"version":"2.0"},"buffers":[{"uri":"plain.bin","byteLength":6291456}],"bufferViews":[{"buffer":0,"byteLength":6291456}],
"accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":524288,"min":[0,0,0],"max":[0,0,0]}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}]}' > "$folder/plain.gltf"
"$gnomon" inspect "$folder/plain.gltf" > "$folder/out" 2> "$folder/err" || complain "plain.gltf: $(cat "$folder/err")"
grep -q 'meshes take 6.0 MB of the file, 1.9 MB would do' "$folder/out" && grep -q 'cure: gnomon bake' "$folder/out" || complain 'inspect has no word of bake'
for file in assets/sundial.glb "$folder/once.glb"; do
    "$gnomon" inspect "$file" | grep -q 'gnomon bake' && complain "inspect: baking $file would help"
done

if [ -d "$assets/../malformed" ]; then
    find "$assets/../malformed" -name '*.gl*' | sort | awk "NR % ${GN_FULL:+1 + 0 * }7 == 0" > "$folder/list"
    while IFS= read -r file; do
        timeout 60 "$gnomon" bake "$file" -o "$folder/hostile.glb" > "$folder/out" 2> "$folder/err"
        got=$?
        [ "$got" -le 2 ] || complain "$file: exit status $got: $(cat "$folder/err")"
        [ "$got" = 0 ] || [ "$(wc -l < "$folder/err")" = 1 ] || complain "$file: not one line: $(cat "$folder/err")"
        [ "$got" != 0 ] || "$gnomon" inspect "$folder/hostile.glb" > /dev/null 2>&1 || complain "$file: its baked file is refused"
    done < "$folder/list"
    echo "$(wc -l < "$folder/list") malformed files"
else
    echo "SKIPPED: no $assets/../malformed"
fi
exit $bad

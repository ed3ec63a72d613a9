#!/bin/sh
# The scenes of `make book`: the same bytes each time, nothing for inspect to complain about, a configuration that show
# accepts, and a picture by it that is neither black nor burnt, nor of one colour.
. tests/script.sh
make_book=${MAKE_BOOK:-build/host/make_book}
[ -x "$make_book" ] || { echo "no $make_book: make tests" && exit 77; }

# wanted SCENE: the problems that inspect must find
wanted() {
    case $1 in
    product) echo '  - the file has no light: it is shown in a studio' ;; # as most files have none: that is the scene
    *) echo '  nothing' ;;
    esac
}

# measure PFM: OK, or what is wrong with the picture
measure() {
    tail -c "$((320 * 180 * 12))" "$1" | od -An -v -tf4 -w12 | awk '
        { sum += $1 + $2 + $3; if ($1 > 1 && $2 > 1 && $3 > 1) burnt++; if ($1 + $2 + $3 < .03) black++ }
        END {
            mean = sum / (3 * NR)
            if (NR != 57600) print NR " pixels"
            if (mean < .03 || mean > .8) print "mean " mean
            if (burnt > .02 * NR) print burnt / NR " of it is burnt"
            if (black > .85 * NR) print black / NR " of it is black"
        }'
}

count=0
for ini in assets/book/*.ini; do
    scene=$(basename "$ini" .ini)
    count=$((count + 1))
    cp "$ini" "$folder"
    "$make_book" "$scene" "$folder/$scene.glb" || complain "$scene: not made"
    "$make_book" "$scene" "$folder/again.glb" && cmp -s "$folder/$scene.glb" "$folder/again.glb" || complain "$scene: other bytes"
    "$gnomon" inspect "$folder/$scene.glb" > "$folder/out" 2> "$folder/err" || complain "$scene: $(cat "$folder/err")"
    sed -n '/^Problems/,$p' "$folder/out" | grep -v '^Problems\|^    cure' > "$folder/found"
    [ -s "$folder/found" ] || echo '  nothing' > "$folder/found"
    wanted "$scene" | cmp -s - "$folder/found" || complain "$scene: $(cat "$folder/found")"
    awk '/^Textures/ { on = 1; next } /^$/ { on = 0 } on { split($2, px, /[x,]/); if (px[1] > 2048 || px[2] > 2048) print }' "$folder/out" > "$folder/large"
    [ ! -s "$folder/large" ] || complain "$scene: $(cat "$folder/large")"
    "$gnomon" show --check "$folder/$scene.ini" > "$folder/out" 2>&1 || complain "$scene.ini: $(cat "$folder/out")"
    "$gnomon" render -c "$folder/$scene.ini" --backend egl --size 320x180 --output srgb -o "$folder/$scene.pfm" 2> "$folder/err" || complain "$scene: $(cat "$folder/err")"
    [ ! -s "$folder/err" ] || complain "$scene: $(cat "$folder/err")"
    measure "$folder/$scene.pfm" > "$folder/wrong"
    [ ! -s "$folder/wrong" ] || complain "$scene: $(cat "$folder/wrong")"
done
[ $count = 8 ] || complain "$count scenes"
"$make_book" none "$folder/none.glb" 2> "$folder/err" && complain 'a scene that is not there'
grep -q 'where SCENE is one of watch room' "$folder/err" || complain "$(cat "$folder/err")"
exit $bad

#!/bin/sh
# Files as other programs write them: each is drawn, or refused by one line that names what gnomon lacks; what is left out of
# a picture is named too. GNOMON_SHARED is the folder whose assets/ holds them.
set -u
gnomon=${GNOMON:-build/release/gnomon}
assets=${GNOMON_SHARED:-../shared}/assets
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
bad=0 drawn=0 refused=0

# what a file may be refused for
lacking='KTX2 of Basis Universal'

complain() {
    echo "FAIL: $*"
    sed 's/^/    /' "$folder/err"
    bad=1
}

# A PFM of one colour equals itself without its first pixel.
is_blank() {
    header=$(head -n 3 "$1" | wc -c) size=$(wc -c < "$1")
    cmp -s -n $((size - header - 12)) -i "$header:$((header + 12))" "$1" "$1"
}

# Its picture is of one colour only where a warning says why.
check_drawn() {
    drawn=$((drawn + 1))
    grep -q 'nothing can be seen\|shown without KHR_interactivity' "$folder/err" && return
    is_blank "$folder/picture.pfm" && complain "$file: the picture has one colour"
}

check_refused() {
    refused=$((refused + 1))
    [ "$(wc -l < "$folder/err")" = 1 ] || complain "$file: refused by more or less than one line"
    grep -qaF KHR_texture_basisu "$file" && grep -q "$lacking is not read: export" "$folder/err" && return
    complain "$file: refused, and what is missing is not named"
}

if [ ! -d "$assets" ]; then
    echo "no $assets: name its folder by GNOMON_SHARED"
    exit 77
fi
find "$assets" -name '*.gltf' -o -name '*.glb' | sort > "$folder/list"
while IFS= read -r file; do
    rm -f "$folder/picture.pfm"
    timeout 120 "$gnomon" render "$file" -o "$folder/picture.pfm" --size 320x240 > "$folder/out" 2> "$folder/err" < /dev/null
    status=$?
    case $status in
    0) check_drawn ;;
    1) check_refused ;;
    *) complain "$file: exit status $status" ;;
    esac
done < "$folder/list"

echo "$drawn drawn, $refused refused"
[ "$drawn" -ge 20 ] || complain "too few to mean anything"
exit $bad

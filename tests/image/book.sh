#!/bin/sh
# book.sh OUT.png SCENE..: renders each scene of assets/book by its configuration, into the folder OUT
# beside the sheet, which has them with their titles, two in a row, half as wide and high. `make book`.
set -eu
gnomon=${GNOMON:-build/release/gnomon}
build=${BUILD:-build/release}
out=$1
folder=${out%.png}
shift
mkdir -p "$folder"
count=$#
while [ "$count" -gt 0 ]; do
    scene=$1
    shift
    ini=assets/book/$scene.ini
    "$gnomon" render -c "$ini" --backend egl --size 1920x1080 -o "$folder/$scene.png"
    set -- "$@" "$(sed -n '1s/^; //p' "$ini")=$folder/$scene.png"
    count=$((count - 1))
done
"$build/tests/tool_sheet" "$out" 2/2 "$@"
echo "$out"

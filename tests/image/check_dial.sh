#!/bin/bash
# gnomon dial: what it writes is read without a warning and has no problem; what cannot be is one line,
# which names what can, and leaves no file behind.
. tests/script.sh
for kind in horizontal vertical equatorial analemmatic; do
    for latitude in 52.5 -33.9; do
        dial="$folder/$kind$latitude"
        "$gnomon" dial --latitude "$latitude" --kind $kind -o "$dial.glb" > "$folder/out" 2> "$folder/err" || complain "$kind $latitude: $(cat "$folder/err")"
        [ ! -s "$folder/out" ] && [ ! -s "$folder/err" ] || complain "$kind $latitude prints: $(cat "$folder/out" "$folder/err")"
        [ "$(stat -c %s "$dial.glb")" -lt 300000 ] || complain "$kind $latitude: $(stat -c %s "$dial.glb") bytes"
        "$gnomon" inspect "$dial.glb" > "$folder/out" 2> "$folder/err" || complain "$kind $latitude: $(cat "$folder/err")"
        [ ! -s "$folder/err" ] || complain "$kind $latitude: $(cat "$folder/err")"
        [ "$(sed -n '/^Problems/,$p' "$folder/out" | tail -n +2 | tr -d ' ')" = nothing ] || complain "$kind $latitude: $(sed -n '/^Problems/,$p' "$folder/out")"
        "$gnomon" dial --latitude "$latitude" --kind $kind -o "$dial.svg" 2> "$folder/err" || complain "$kind $latitude: $(cat "$folder/err")"
        python3 -c 'import sys, xml.dom.minidom; xml.dom.minidom.parse(sys.argv[1])' "$dial.svg" || complain "$kind $latitude: the pattern is no XML"
    done
done
# the same arguments give the same bytes
"$gnomon" dial --latitude 52.5 -o "$folder/again.glb" && cmp -s "$folder/again.glb" "$folder/horizontal52.5.glb" || complain 'two dials differ'
# 1:1
grep -q 'width="[0-9.]*mm" height="[0-9.]*mm" viewBox="0 0 ' "$folder/horizontal52.5.svg" || complain 'a pattern without its size'

no="$folder/no.glb"
expect 2 'needs --latitude' dial -o "$no"
expect 2 'needs -o FILE.glb or -o FILE.svg' dial --latitude 50
expect 2 'name it so' dial --latitude 50 -o "$folder/no.png"
expect 2 'name it so' dial --latitude 50 -o "$folder/no"
expect 2 'from -90 to 90' dial --latitude 91 -o "$no"
expect 2 'from -90 to 90' dial --latitude nan -o "$no"
expect 2 'from -90 to 90' dial --latitude '52,5' -o "$no"
expect 2 '--latitude' dial --latitude '' -o "$no"
expect 2 'use --kind equatorial' dial --latitude 0 -o "$no"
expect 2 'use --kind equatorial' dial --latitude 4.99 -o "$no"
expect 2 'use --kind equatorial' dial --latitude 10 --kind analemmatic -o "$no"
expect 2 'use --kind horizontal' dial --latitude 89 --kind analemmatic -o "$no"
expect 2 'use --kind horizontal' dial --latitude 90 --kind vertical -o "$no"
expect 2 'use --kind horizontal or equatorial' dial --latitude 50 --kind vertical --declination 90 -o "$no"
expect 2 'use --kind horizontal or equatorial' dial --latitude 50 --kind vertical --declination -88 -o "$no"
expect 2 'from -180 to 180' dial --latitude 50 --kind vertical --declination 181 -o "$no"
expect 2 'add --kind vertical' dial --latitude 50 --declination 10 -o "$no"
expect 2 'horizontal, vertical, equatorial, analemmatic' dial --latitude 50 --kind polar -o "$no"
expect 2 'go together' dial --latitude 50 --longitude 10 -o "$no"
expect 2 'go together' dial --latitude 50 --meridian 15 -o "$no"
expect 2 'from 0.02 to 100' dial --latitude 50 --width 0 -o "$no"
expect 2 'from 0.02 to 100' dial --latitude 50 --width 1e9 -o "$no"
expect 2 'it takes no scene' dial --latitude 50 -o "$no" scene.glb
expect 2 '--size' dial --latitude 50 --size 640x480 -o "$no"
expect 1 "$folder/missing" dial --latitude 50 -o "$folder/missing/no.glb"
mkdir "$folder/folder.svg"
expect 1 'folder.svg' dial --latitude 50 -o "$folder/folder.svg"
[ ! -e "$no" ] || complain 'a refused dial leaves a file'
exit $bad

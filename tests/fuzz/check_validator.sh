#!/bin/sh
# check_validator.sh: each file of the validator's corpus that is shown, with its faulty object in use (GN_GRAFTS of test_validator), is
# rendered: status 0, and the picture has more than the background. Every eighth of them; GN_FULL=1: all. Skipped (77) without
# ../shared/malformed/validator.
. tests/script.sh
corpus=${GNOMON_SHARED:-../shared}/malformed/validator/test
[ -d "$corpus" ] || { echo "SKIP: there is no folder $corpus" && exit 77; }
test=$(dirname "$gnomon")/tests/test_validator
cp -r "$corpus" "$folder/test"
chmod -R u+w "$folder/test"
GN_GRAFTS="$folder/test/../" "$test" > "$folder/said" || complain "$(grep FAIL "$folder/said")"

cat > "$folder/one.sh" << 'END'
picture=$(mktemp "$1/XXXXXX.pfm")
said=$("$2" render --size 64x64 --camera auto --floor none --msaa 0 --background '#ff00ff' -o "$picture" "$3" 2>&1) ||
    echo "FAIL: $3: status $?: $said"
colours=$(tail -c 49152 "$picture" | od -An -v -tx4 -w12 | sort -u | wc -l)
rm -f "$picture"
[ "$colours" -gt 1 ] || echo "FAIL: $3: nothing is seen"
END
find "$folder/test" -name '*.gltf' -o -name '*.glb' | sort |
    awk -v every="$([ "${GN_FULL:-}" ] && echo 1 || echo 8)" 'NR % every == 0' > "$folder/files"
xargs -P "$(nproc)" -n 1 sh "$folder/one.sh" "$folder" "$gnomon" < "$folder/files" > "$folder/faults"
[ ! -s "$folder/faults" ] || complain "$(sed "s#$folder/##g" "$folder/faults")"
echo "$(wc -l < "$folder/files") files rendered"
exit $bad

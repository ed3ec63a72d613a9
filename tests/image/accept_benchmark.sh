#!/bin/sh
# The open benchmark, its short form: all scenes and three truths have the committed hashes, pictures of gnomon
# have the figures of the techniques page, and pictures without shadows have not.
. tests/script.sh
tool=$(realpath "${BUILD:-build/release}")/tests/tool_benchmark
hashes=$(realpath assets/benchmark/SHA256SUMS)
scenes=$folder/scenes
mkdir "$scenes" "$folder/with" "$folder/without"

# of FILES: their hashes are those
check() {
    for file in "$@"; do grep " $file\$" "$hashes"; done > "$folder/few"
    (cd "$scenes" && sha256sum --quiet -c "$folder/few") || complain "not the committed bytes: $*"
}

"$tool" scenes "$scenes" || complain 'the scenes'
# shellcheck disable=SC2046
check $(cd "$scenes" && ls)
[ "$(find "$scenes" -name '*.glb' | wc -l)" = "$(grep -c 'glb$' "$hashes")" ] || complain 'the number of scenes'

for name in field-point-26 contact-spot soft-spot-low; do
    "$gnomon" score --make-truth --truth $name --benchmark "$scenes" || complain "the truth of $name"
    check $name.pfm
    size=640x480
    [ $name != soft-spot-low ] || size=480x360
    for technique in pcss none; do
        [ $technique = none ] && to=without || to=with
        "$gnomon" render "$scenes/$name.glb" --aov visibility --size $size --floor none --shadow $technique -o "$folder/$to/$name.pfm" || complain "a picture of $name"
    done
done

# below MOST in $folder/out: the figure of merit of CLASS
below() {
    awk -F , -v class="$1" -v most="$2" '$1 == "mean" && $2 == class { found = $6 <= most } END { exit !found }' "$folder/out"
}
"$gnomon" score "$folder/with" --benchmark "$scenes" --csv > "$folder/out" || complain 'scores'
below field .3 && below contact .3 && below soft .05 || complain "gnomon's own: $(cat "$folder/out")"
# the figure of COLUMN, the mean of class soft
of_soft() {
    awk -F , -v name="$1" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) at = i }
        $1 == "mean" && $2 == "soft" { print $at }' "$folder/out"
}
torn="$(of_soft tear_percent_px) $(of_soft grain_percent_px)"
echo "$torn" | awk '{ exit !($1 > 0 && $2 > $1 && $2 < .5) }' || complain "tear and grain of pcss: $torn"
"$gnomon" score "$folder/without" --benchmark "$scenes" --csv > "$folder/out" || complain 'scores without shadows'
! below field 1 && ! below contact 90 && ! below soft .3 || complain "without shadows: $(cat "$folder/out")"
torn="$(of_soft tear_percent_px) $(of_soft grain_percent_px)"
[ "$torn" = '0 0' ] || complain "tear and grain of what is all lit: $torn"

exit $bad

#!/bin/sh
# An entry for glTF-Render-Fidelity: what is drawn of a scenario, and what is said of a wrong one.
cd "$(dirname "$0")/../.." || exit 1
. tests/script.sh
tool=$(realpath "${BUILD:-build/release}/tests/tool_fidelity")
export GNOMON="$gnomon"
mkdir "$folder/models" "$folder/environments" "$folder/out"
build/host/make_studio "$folder/environments/studio.hdr" || complain 'make_studio'
cp assets/lessons/solids.glb "$folder/models"
cd "$folder" || exit 1

# scenario NAME=JSON..: one with these members in place of its own
scenario() {
    model='"../../../models/solids.glb"' lighting='"../../../environments/studio.hdr"' dimensions='{"width": 60, "height": 40}'
    target='{"x": 0, "y": 0.5, "z": -0.25}' orbit='{"theta": 30, "phi": 60, "radius": 5}' sky=false out='"out/it.png"'
    for member in "$@"; do
        case $member in
        model=*) model=${member#*=} ;;
        dimensions=*) dimensions=${member#*=} ;;
        orbit=*) orbit=${member#*=} ;;
        sky=*) sky=${member#*=} ;;
        out=*) out=${member#*=} ;;
        esac
    done
    echo "{\"scenario\": {\"name\": \"x\", \"model\": $model, \"lighting\": $lighting, \"dimensions\": $dimensions, \"target\": $target," \
        "\"orbit\": $orbit, \"verticalFoV\": 45, \"renderSkybox\": $sky}, \"outputFile\": $out}"
}

look='--tone aces --exposure 0 --floor none --no-animation --msaa 4'
camera='--camera-theta 30 --camera-phi 60 --camera-distance 5 --camera-target 0,0.5,-0.25 --camera-fov 45'
# shellcheck disable=SC2086
for sky in false true; do
    background=$([ $sky = true ] && echo '--environment-show yes' || echo '--background transparent')
    "$tool" "$(scenario sky=$sky)" > log 2>&1 || complain "renderSkybox $sky: $(cat log)"
    "$gnomon" render models/solids.glb -o own.png --size 120x80 --environment environments/studio.hdr $background $look $camera > log 2>&1 ||
        complain "render: $(cat log)"
    cmp -s out/it.png own.png || complain "renderSkybox $sky: another picture than by hand"
    mv own.png "sky-$sky.png"
done
cmp -s sky-false.png sky-true.png && complain 'the skybox is not in the picture'
"$tool" --print "$(scenario 'orbit={"theta": 0, "phi": 90, "radius": 0}')" | grep -q -- '--camera-distance 0.0001 ' || complain 'a radius of 0'

# refuse WHAT MEMBER..: one line that names it, and no picture
refuse() {
    what=$1 && shift
    rm -f out/it.png
    "$tool" "$(scenario "$@")" > log 2>&1 && complain "$* is drawn"
    [ "$(wc -l < log)" -eq 1 ] && grep -q "$what" log || complain "$*: $(cat log)"
    [ ! -e out/it.png ] || complain "$*: leaves a picture"
}
refuse none.glb 'model="../../../models/none.glb"'
refuse '"model"' 'model=7'
refuse '"dimensions"' 'dimensions={"width": 0, "height": 40}'
refuse '"height"' 'dimensions={"width": 60}'
refuse '"orbit"' 'orbit=[]'
refuse '"phi"' 'orbit={"theta": 0, "radius": 1}'
refuse '"outputFile"' 'out=null'
"$tool" '{' > log 2>&1 && complain 'no JSON is drawn'
[ "$(wc -l < log)" -eq 1 ] || complain "no JSON: $(cat log)"
"$tool" > log 2>&1 && complain 'nothing is drawn'
GNOMON=/nowhere/gnomon "$tool" "$(scenario)" > log 2>&1 && complain 'a program that is not there'
grep -q 'GNOMON names the program' log || complain "a program that is not there: $(cat log)"
exit $bad

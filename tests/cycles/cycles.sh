#!/bin/sh
# cycles.sh [HDR STOPS]..: eight models by Cycles, gnomon and model-viewer in the light of an environment, the studio's at 0 stops
# if none is named; prints how far the two are from Cycles. Installs nothing. SAMPLES (128), SIZE (640x480); SAME=1 takes the traces and
# pictures that are there; CHROMIUM, MODEL_VIEWER, ASSETS as for modelviewer.sh. Exit status 77: something is missing.
set -eu
cd "$(dirname "$0")/../.."
gnomon=${GNOMON:-build/release/gnomon} build=${BUILD:-build/release} size=${SIZE:-640x480}
package=$(realpath -m "${MODEL_VIEWER:-build/modelviewer/node_modules/@google/model-viewer}")
assets=$(realpath -m "${ASSETS:-../shared/assets}")
list=tests/cycles/models

leave() {
    echo "cycles: $*" >&2
    exit 77
}
chromium=${CHROMIUM:-$(command -v chromium || command -v chromium-browser || true)}
command -v blender > /dev/null || leave 'needs Blender: apt-get install blender'
[ -n "$chromium" ] || leave 'needs Chromium: apt-get install chromium, or CHROMIUM=PATH'
python3 -c "import numpy" 2> /dev/null || /usr/bin/python3 -c "import numpy" 2> /dev/null ||
    leave 'needs NumPy, which trace.py uses in Blender: apt-get install python3-numpy'
command -v node > /dev/null || leave 'needs Node.js: apt-get install nodejs npm'
[ -e "$package/dist/model-viewer.min.js" ] ||
    leave 'needs model-viewer: npm install --prefix build/modelviewer @google/model-viewer, or MODEL_VIEWER=FOLDER'
[ -d "$assets" ] || leave "needs the models of $assets, or ASSETS=FOLDER"
[ -x "$gnomon" ] && [ -x "$build/tests/tool_cycles" ] || leave 'needs the programs: make check-cycles'

# light HDR STOPS
light() {
    hdr=$(realpath -m "$1") stops=$2
    out=$(realpath -m "build/cycles/$(basename "$hdr" .hdr)")
    mkdir -p "$out"
    [ -n "${SAME:-}" ] || TONE=linear EXPOSURE=$(awk "BEGIN { print 2 ^ $stops }") \
        node tests/modelviewer/modelviewer.mjs "$package/dist" "$assets" "$hdr" "$out" "$chromium" "$size" "$list"
    set --
    while read -r name file _; do
        case $name in '' | '#'*) continue ;; esac
        file=$assets/$file
        [ ! -e "$out/$name.glb" ] || file=$out/$name.glb
        # shellcheck disable=SC2046
        "$gnomon" render "$file" -o "$out/$name-here.png" --size "$size" --environment "$hdr" --tone none --exposure "$stops" \
            --floor none --no-animation --background transparent --msaa 4 $(cat "$out/$name.camera")
        set -- "$@" "$name=$file"
    done < "$list"
    [ -n "${SAME:-}" ] || blender -b --factory-startup --python-exit-code 1 --python tests/cycles/trace.py -- \
        "$hdr" "$out" "${SAMPLES:-128}" "$size" "$@" > "$out/log" 2>&1 || { tail -n 5 "$out/log" && exit 1; }
    echo "$(basename "$hdr"), $stops stops"
    printf '%-10s %8s %8s %8s %8s %8s\n' model pixels noise here there ratio
    for model in "$@"; do "$build/tests/tool_cycles" "${model%%=*}" "$out" "$stops"; done | tee "$out/table"
    awk '{ sum += log($6); less += $6 < 1 } END { printf "geometric mean of the ratios %.3f, smaller on %d of %d\n", exp(sum / NR), less, NR }' "$out/table"
    echo "pictures: $out/NAME.png: Cycles, here, there; here and there less Cycles (red brighter, blue darker)"
}

echo "$(blender --version | head -n 1), model-viewer $(sed -n 's/.*"version": "\(.*\)".*/\1/p' "$package/package.json")"
if [ $# -lt 2 ]; then
    mkdir -p build/cycles
    build/host/make_studio build/cycles/studio.hdr
    set -- build/cycles/studio.hdr 0
fi
while [ $# -ge 2 ]; do
    light "$1" "$2"
    shift 2
done

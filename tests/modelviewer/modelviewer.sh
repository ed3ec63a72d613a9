#!/bin/sh
# modelviewer.sh [LIST [HDR]]: models drawn by model-viewer, in a headless Chromium by SwiftShader, and by gnomon, with the
# same environment, camera and tone mapping; prints how much their colours differ. LIST: models, or chart, of spheres.
# Installs nothing. CHROMIUM names the browser, MODEL_VIEWER the folder of the npm package, ASSETS that of the models;
# SAME=1 takes the pictures of model-viewer that are there. Exit status 77: something is missing; 1: a goal is missed.
set -eu
cd "$(dirname "$0")/../.."
list=tests/modelviewer/${1:-models}
gnomon=${GNOMON:-build/release/gnomon} build=${BUILD:-build/release}
package=$(realpath -m "${MODEL_VIEWER:-build/modelviewer/node_modules/@google/model-viewer}")
assets=$(realpath -m "${ASSETS:-../shared/assets}")
out=$(realpath -m "build/modelviewer/$(basename "$list")${2:+-$(basename "$2" .hdr)}")
hdr=$(realpath -m "${2:-build/modelviewer/studio.hdr}")

leave() {
    echo "modelviewer: $*" >&2
    exit 77
}
chromium=${CHROMIUM:-$(command -v chromium || command -v chromium-browser || true)}
[ -n "$chromium" ] || leave 'needs Chromium: apt-get install chromium, or CHROMIUM=PATH'
command -v node > /dev/null || leave 'needs Node.js: apt-get install nodejs npm'
[ -e "$package/dist/model-viewer.min.js" ] ||
    leave 'needs model-viewer: npm install --prefix build/modelviewer @google/model-viewer, or MODEL_VIEWER=FOLDER'
[ -d "$assets" ] || leave "needs the models of $assets, or ASSETS=FOLDER"
[ -x "$gnomon" ] && [ -x "$build/tests/tool_modelviewer" ] || leave 'needs the programs: make check-modelviewer'

mkdir -p "$out"
[ -n "${2:-}" ] || build/host/make_studio "$hdr"
[ -n "${SAME:-}" ] || node tests/modelviewer/modelviewer.mjs "$package/dist" "$assets" "$hdr" "$out" "$chromium" 640x480 "$list"

echo "model-viewer $(sed -n 's/.*"version": "\(.*\)".*/\1/p' "$package/package.json"), $("$chromium" --version 2> /dev/null)"
printf '%-10s %8s %8s %8s %8s %8s %9s\n' model pixels 'mean dE' '95 %' there here brighter
missed=0
# shellcheck disable=SC2046
while read -r name file _; do
    case $name in '' | '#'*) continue ;; esac
    file=$assets/$file
    [ ! -e "$out/$name.glb" ] || file=$out/$name.glb
    "$gnomon" render "$file" -o "$out/$name-here.png" --size 640x480 --environment "$hdr" --tone neutral --exposure 0 --shadow none \
        --floor none --no-animation --background transparent --msaa 4 $(cat "$out/$name.camera")
    "$build/tests/tool_modelviewer" "$name" "$out/$name-there.png" "$out/$name-here.png" "$out/$name.png" || missed=1
done < "$list"
echo "pictures: $out/NAME.png: there, here, difference (white: 20), brighter here (red) or there (blue)"
exit $missed

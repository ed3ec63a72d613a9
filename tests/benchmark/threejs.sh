#!/bin/sh
# threejs.sh [basic|pcf|pcfsoft|vsm [BIAS [NORMAL_BIAS]]]: the open benchmark with three.js in a headless Chromium,
# by SwiftShader; biases in texels. Installs nothing. CHROMIUM names the browser, THREE the folder of the npm
# package; exit status 77: something is missing.
set -eu
cd "$(dirname "$0")/../.."
type=${1:-pcf} bias=${2:-0} normal_bias=${3:-2}
case $type in basic | pcf | pcfsoft | vsm) ;; *) echo 'usage: threejs.sh [basic|pcf|pcfsoft|vsm [BIAS [NORMAL_BIAS]]]' >&2 && exit 2 ;; esac
gnomon=${GNOMON:-build/release/gnomon}
three=$(realpath -m "${THREE:-build/three/node_modules/three}")
scenes=assets/benchmark
out=build/benchmark/three-$type

leave() {
    echo "threejs: $*" >&2
    exit 77
}
chromium=${CHROMIUM:-$(command -v chromium || command -v chromium-browser || true)}
[ -n "$chromium" ] || leave 'needs Chromium: apt-get install chromium, or CHROMIUM=PATH'
command -v node > /dev/null || leave 'needs Node.js: apt-get install nodejs npm'
[ -e "$three/build/three.module.js" ] || leave 'needs three.js: npm install --prefix build/three three, or THREE=FOLDER'
[ -x "$gnomon" ] && [ -e $scenes/field-sun-00.pfm ] || leave 'needs the truths: make benchmark'

rm -rf "$out"
mkdir -p "$out"
node tests/benchmark/threejs.mjs "$three" "$(realpath $scenes)" "$out" "$chromium" "$type" "$bias" "$normal_bias"
"$gnomon" score "$out"

#!/bin/sh
# tangents.sh: tangents made at load against mikktspace.c, as npm has it: a sphere, mirrored coordinates, and triangles without area.
# Installs nothing. MIKKTSPACE names the folder of the npm package; exit status 77: something is missing.
set -eu
cd "$(dirname "$0")/../.."
build=${BUILD:-build/release}
package=$(realpath -m "${MIKKTSPACE:-build/modelviewer/node_modules/mikktspace}")
out=build/tangents

leave() {
    echo "tangents: $*" >&2
    exit 77
}
command -v node > /dev/null || leave 'needs Node.js: apt-get install nodejs npm'
[ -e "$package/package.json" ] || leave 'needs mikktspace: npm install --prefix build/modelviewer mikktspace, or MIKKTSPACE=FOLDER'
[ -x "$build/tests/tool_tangents" ] || leave 'needs the program: make check-tangents'
mkdir -p "$out"
"$build/tests/tool_tangents" "$out"
node tests/tangents/tangents.mjs "$package" "$out/sphere.bin" "$out/mirrored.bin" "$out/degenerate.bin"

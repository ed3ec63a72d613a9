#!/bin/sh
# Every model that others made and every clip of it stays wholly in pictures of 9:16, 1:1, 16:9 and 32:9. GNOMON_SHARED is the
# folder whose assets/ holds them.
set -u
build=${BUILD:-build/release}
assets=${GNOMON_SHARED:-../shared}/assets
log=$(mktemp)
trap 'rm -f "$log"' EXIT

if [ ! -d "$assets" ]; then
    echo "no $assets, so its models were not framed: name the folder by GNOMON_SHARED"
    exit 77
fi
find -L "$assets" \( -name '*.glb' -o -name '*.gltf' \) -print0 | sort -z | xargs -0 "$build/tests/tool_framing" > "$log"
status=$?
grep OUTSIDE "$log"
tail -n 1 "$log"
exit "$status"

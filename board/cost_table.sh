#!/bin/sh
# cost_table.sh GNOMON [README]: the table of costs in board/README.md, as `gnomon inspect --for` has them, between its two marks: with
# README the whole page on stdout, else the table alone.
# `make board-table`; tests/check_docs.sh compares.
# A square that fills the picture stands in the studio, with a base colour texture, one of metal and roughness and, in some rows, normals.
set -eu
gnomon=$1 page=${2-}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
boards='pi4 pi5 g31 g52 g610 a618 a660'

# scene FILE NORMALS: square of 1.7778 x 1 m, which an orthographic camera sees whole
scene() {
    cat > "$1" << END
{"asset": {"version": "2.0"}, "scenes": [{"nodes": [0, 1]}],
 "nodes": [{"mesh": 0}, {"camera": 0, "translation": [0, 0, 2]}],
 "cameras": [{"type": "orthographic", "orthographic": {"xmag": 0.8888, "ymag": 0.5, "znear": 0.1, "zfar": 10}}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 3, "material": 0}]}],
 "materials": [{$2 "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicRoughnessTexture": {"index": 0}}}],
 "textures": [{"source": 0}],
 "images": [{"uri": "data:image/png;base64,$png"}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-1, -1, 0], "max": [1, 1, 0]},
  {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC3"}, {"bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC2"},
  {"bufferView": 3, "componentType": 5123, "count": 6, "type": "SCALAR"}],
 "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 48},
  {"buffer": 0, "byteOffset": 96, "byteLength": 32}, {"buffer": 0, "byteOffset": 128, "byteLength": 12}],
 "buffers": [{"byteLength": 140, "uri": "data:;base64,$square"}]}
END
}
# grey, 1 x 1; corners, normals, texture coordinates, indices
png=$(base64 -w 0 board/cost_table.png)
square=$({
    for corner in '\200\277 \200\277' '\200\077 \200\277' '\200\077 \200\077' '\200\277 \200\077'; do
        # shellcheck disable=SC2059
        printf "\\000\\000${corner% *}\\000\\000${corner#* }\\000\\000\\000\\000"
    done
    for _ in 1 2 3 4; do printf '\000\000\000\000\000\000\000\000\000\000\200\077'; done
    for corner in '\000\000 \000\000' '\200\077 \000\000' '\200\077 \200\077' '\000\000 \200\077'; do
        # shellcheck disable=SC2059
        printf "\\000\\000${corner% *}\\000\\000${corner#* }"
    done
    printf '\000\000\001\000\002\000\000\000\002\000\003\000'
} | base64 -w 0)

# row NAME FILE OPTION..: milliseconds of a frame on each board
row() {
    name=$1 file=$2
    shift 2
    printf '| %s |' "$name"
    for board in $boards; do
        "$gnomon" inspect "$file" --for "$board" --size 1920x1080 --msaa 0 --floor none --occlusion none "$@" > "$folder/out"
        ms=$(sed -n 's/^  each frame *\([0-9.]*\) ms.*/\1/p' "$folder/out")
        grep -qE '\(estimated\) lit ' "$folder/out" && ms="~$ms"
        # the nearest program without normals says nothing about them
        [ "${name#*normal}" = "$name" ] || grep -q '^ *from lit .*NORMAL_TEXTURE' "$folder/out" || ms=-
        printf ' %s |' "${ms:?no time of $name on $board}"
    done
    echo
}
table() {
    scene "$folder/plain.gltf" ''
    scene "$folder/normals.gltf" '"normalTexture": {"index": 0},'
    printf '| |'
    for board in $boards; do printf ' %s |' "$board"; done
    printf '\n|---|%s\n' "$(for board in $boards; do printf -- '---|'; done)"
    # shellcheck disable=SC2016
    {
        row '`cone` (the default for the key light)' "$folder/plain.gltf" --shadow cone
        row '`cone` and a normal map' "$folder/normals.gltf" --shadow cone
        row '`cone`, `taps = 8`' "$folder/plain.gltf" --shadow cone --taps 8
        row '`pcf`' "$folder/plain.gltf" --shadow pcf
        row '`pcf` and a normal map' "$folder/normals.gltf" --shadow pcf
    }
}

table > "$folder/table"
[ -n "$page" ] || { cat "$folder/table"; exit; }
awk -v table="$folder/table" '
    /^<!-- end of the costs -->/ { inside = 0 }
    !inside { print }
    /^<!-- the costs: / { inside = 1; print ""; while ((getline line < table) > 0) print line; print "" }' "$page"

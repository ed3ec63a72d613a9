#!/bin/sh
# instructions.sh COMMAND [ARG..]: how many instructions the lit programs of every technique take on real GPUs, into
# tests/image/instructions. COMMAND is an offline compiler for them: called with names in a folder that holds NAME.vert and
# NAME.frag (which tool_shaders wrote), it prints lines "GPU NAME FRAG inst COUNT ..".
set -eu
tool=${BUILD:-build/release}/tests/tool_shaders
out=$PWD/tests/image/instructions
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$tool" "$folder"
cd "$folder"
# one at a time: emulated compilers have their time limits, and of two equal programs tell of one
ls | sed -n 's/^\(.*-\(sun\|spot\|point\)-.*\)\.frag$/\1/p' | xargs -n 1 "$@" > lines
awk '$3 == "FRAG" && $4 == "inst" { print $2, $1, $5 }' lines | sort > "$out"
wc -l < "$out"

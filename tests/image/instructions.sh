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
# a few at a time: emulated compilers are slow and have their time limits
ls | sed -n 's/^\(.*-\(sun\|spot\|point\)-.*\)\.frag$/\1/p' | xargs -n 6 "$@" > lines
awk '$3 == "FRAG" && $4 == "inst" { print $2, $1, $5 }' lines | sort > "$out"
wc -l < "$out"

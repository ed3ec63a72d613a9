#!/bin/sh
# gnomon on strict OpenGL ES 3.0: what tool_angle compares, then what gnomon says of itself there.
# GN_FULL=1: penumbrae against truth, too.
set -eu
build=${BUILD:-build/release}
gnomon=${GNOMON:-$build/gnomon}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

status=0
libraries=$(tests/angle/libraries.sh 2> "$work/why") || status=$?
case $status in
0) ;;
77) cat "$work/why" && exit 77 ;;
78) echo "not applicable: SKIP, $(cat "$work/why")" && exit 0 ;;
*) cat "$work/why" && exit 1 ;;
esac
path=$PWD/$build/tests/angle:$libraries
started=$(date +%s)
bad=0
note() {
    echo "$1: $(($(date +%s) - started)) s"
}

"$build/tests/tool_angle" "$path" || bad=1
note 'pictures'

LD_LIBRARY_PATH=$path "$gnomon" doctor --backend egl --self-test > "$work/doctor" 2>&1 || bad=1
cat "$work/doctor"
for words in 'not proved *r16f; instead: r32ui' 'not proved *rgba16f; instead:' 'hard *r32ui *PASS' \
    'pcf *depth *PASS' 'the CPU draws (ANGLE'; do
    grep -q -e "$words" "$work/doctor" || { bad=1 && echo "doctor does not say '$words'"; }
done
! grep -q FAIL "$work/doctor" || bad=1
note 'self-test'

if [ -n "${GN_FULL:-}" ]; then
    LD_LIBRARY_PATH=$path "$build/tests/test_penumbra" 2>&1 || bad=1
    note 'penumbrae'
fi
exit $bad

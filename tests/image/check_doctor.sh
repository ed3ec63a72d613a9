#!/bin/sh
# gnomon doctor as a user sees it: fields, exit status, and nothing that a library says.
set -eu
gnomon=${GNOMON:-build/release/gnomon}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
bad=0

# run STATUS ARGUMENT..: out and err in $work
run() {
    want=$1
    shift
    status=0
    "$gnomon" doctor "$@" > "$work/out" 2> "$work/err" || status=$?
    [ "$status" = "$want" ] || complain "doctor $*: status $status, not $want"
    last="doctor $*"
}
complain() {
    bad=1
    echo "$1; it ended with"
    tail -q -n 3 "$work/out" "$work/err" | sed 's/^/    /'
}
says() { grep -q -e "$1" "$work/out" || complain "$last: does not say '$1'"; }
never() { ! grep -q -e "$1" "$work/out" || complain "$last: says '$1'"; }
quiet() { [ ! -s "$work/err" ] || complain "$last: stderr is not empty"; }
one_line() { [ "$(wc -l < "$work/err")" = 1 ] || complain "$last: stderr is not one line"; }

if ! "$gnomon" doctor > "$work/out" 2>&1; then
    cat "$work/out"
    echo 'nothing can draw here'
    exit 77
fi

EGL_LOG_LEVEL=debug LIBGL_DEBUG=verbose run 0
quiet
for word in Machine texts Backends 'GPU (' renderer vendor version textures proved 'map formats' chosen \
    Cards GPIO Keys Problems 'kms ' 'window ' depth r16f rgba8; do
    says "$word"
done

run 0 --json
quiet
for field in version can_draw machine memory_mb groups backends opens why gpu renderer gles \
    software max_texture_px proved not_proved map_formats auto cards connectors gpio texts_missing input gpio_library devices_denied problems; do
    says "\"$field\":"
done
never '"self_test"'

run 0 --without r16f,srgb
says 'not proved *r16f; instead: r32ui'
says 'not proved *srgb; instead:'
says 'hard:r32ui'
never 'r16f-raw'
run 0 --without depth-compare,r32ui,r16f
says 'no map format but rgba8'
run 2 --without r16f,velvet
one_line
grep -q 'velvet' "$work/err" || complain 'the unknown capability is not named'

run 1 --backend kms
one_line
says Problems
MESA_GLES_VERSION_OVERRIDE=2.0 run 1 --backend egl
one_line
says 'has only OpenGL ES 2.0'

run 0 --self-test
quiet
says '^Self-test: 7 scenes at 128x96'
says 'hard *r16f *PASS'
says 'pcf *depth *PASS'
never FAIL
run 0 --self-test --json --without r16f,r32ui
says '"self_test":'
says '"failed": 0'
never '"map_format": "r16f"'

# a wrong shader is found: everything lit
mkdir "$work/shaders"
cp -r shaders_es/. "$work/shaders"
sed 's/return map_lit(map, s.at, s)/return 1.0/' shaders_es/shadow/hard.glsl \
    > "$work/shaders/shadow/hard.glsl"
if ! cmp -s shaders_es/shadow/hard.glsl "$work/shaders/shadow/hard.glsl"; then
    run 1 --self-test --shaders "$work/shaders"
    one_line
    says 'hard *depth *FAIL'
    says 'pcf *depth *PASS'
else
    complain 'hard.glsl has no function to spoil'
fi
# and one that does not compile
echo 'nonsense' > "$work/shaders/shadow/hard.glsl"
run 1 --self-test --shaders "$work/shaders"
one_line
says 'hard *r16f *FAIL'
says 'pcf3 *depth *PASS'
exit $bad

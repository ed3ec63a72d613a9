#!/bin/bash
# --shaders: a running kiosk reads the folder again when a file changes; a broken one changes nothing but for
# a line on stderr.
set -u
gnomon=$(realpath "${GNOMON:-build/release/gnomon}")
folder=$(mktemp -d)
kiosk=''
trap '[ -z "$kiosk" ] || kill -KILL "$kiosk" 2> /dev/null; rm -rf "$folder"' EXIT
export XDG_CONFIG_HOME="$folder/none"
unset XDG_RUNTIME_DIR
bad=0
cp -r shaders_es "$folder/shaders"
cd "$folder" || exit 1

complain() {
    echo "FAIL: $*"
    bad=1
}

ctl() { timeout 60 "$gnomon" ctl --socket "$folder/ctl" "$@"; }

# paint R G B: the lit program draws that colour alone; by way of another file, as editors do
paint() {
    sed "s/^    if (CUT_LAST) surface_cut(base);\$/&\n    o_color = vec4($1, $2, $3, 1.0);/" shaders/lit.frag > lit.new
    [ "$(grep -c 'o_color = vec4('"$1" lit.new)" = 1 ] || complain 'lit.frag cannot be painted'
}

# await FILE: until the picture is that one
await() {
    for _ in $(seq 100); do
        ctl screenshot now.png > /dev/null && "$gnomon" compare now.png "$1" > /dev/null 2>&1 && return
        sleep 0.1
    done
    complain "the picture is not $1: $(cat kiosk.err)"
}

printf '[kiosk]\ncaptions = no\n' > kiosk.ini
"$gnomon" show -c kiosk.ini --backend egl --size 96x54 --shadow hard --no-animation --shaders shaders --socket "$folder/ctl" > kiosk.out 2> kiosk.err &
kiosk=$!
for _ in $(seq 300); do
    ctl status > /dev/null 2>&1 && break
    sleep 0.1
done
ctl screenshot plain.png > /dev/null || complain "no picture: $(cat kiosk.err)"

paint 1.0 0.0 0.0
cp shaders/lit.frag lit.old
mv lit.new shaders/lit.frag
"$gnomon" render --backend egl --msaa 0 --size 96x54 --shadow hard --no-animation --shaders shaders -o red.png || complain 'a red picture'
"$gnomon" compare plain.png red.png > /dev/null 2>&1 && complain 'red is no other picture'
await red.png

# broken: in place this time
[ ! -s kiosk.err ] || complain "$(cat kiosk.err)"
echo 'this is no shader' >> shaders/lit.frag
for _ in $(seq 100); do
    [ -s kiosk.err ] && break
    sleep 0.1
done
[ "$(wc -l < kiosk.err)" = 1 ] && grep -q 'shader program (lit' kiosk.err || complain "a broken shader: $(cat kiosk.err)"
await red.png

# fixed; and a file of a folder below
cp lit.old shaders/lit.frag
await plain.png
sed 's/return step(min(at.z, s.far), map_code(map, at.xy));/return 1.0;/' shaders/lib/map_lit.glsl > lit.new
mv lit.new shaders/lib/map_lit.glsl
"$gnomon" render --backend egl --msaa 0 --size 96x54 --shadow none --no-animation -o none.png || complain 'a picture without shadows'
await none.png

ctl quit > /dev/null || complain 'quit'
wait "$kiosk" || complain "the kiosk ends with $?: $(cat kiosk.err)"
kiosk=''
[ "$(wc -l < kiosk.err)" = 1 ] || complain "warnings: $(cat kiosk.err)"
exit $bad

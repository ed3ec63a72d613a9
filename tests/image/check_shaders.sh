#!/bin/bash
# --shaders: a running kiosk reads the folder again when a file changes; a broken one changes nothing but for
# a line on stderr.
. tests/kiosk.sh
cp -r shaders_es "$folder/shaders"
cd "$folder" || exit 1

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
show -c kiosk.ini --size 96x54 --shadow hard --no-animation --shaders shaders
says 'frames.drawn: [1-9].*' 'a start' 60
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

stop
[ "$(wc -l < kiosk.err)" = 1 ] || complain "warnings: $(cat kiosk.err)"
exit $bad

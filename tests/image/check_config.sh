#!/bin/bash
# Configurations that are good, bad or missing: the kiosk draws all the same and names the reason, and --check
# looks at all that a file names. tests/unit/test_config_lines.c breaks each line of the good one.
. tests/script.sh
unset XDG_RUNTIME_DIR
cp assets/sundial.glb tests/image/kiosk-0.1.0.* "$folder/"
cd "$folder" || exit 1

cat > good.ini << 'END'
; a configuration of sixty lines
[display]
connector = HDMI-A-1
mode = 1920x1080@60
rotate = 90
max_fps = 30
legacy = no
[scene]
file = sundial.glb
camera = Garden
animation = hoop
time = 2.5
turntable = 6
[render]
size = 64x36
shadow = pcf
map = 512
map_format = auto
planar = mask
taps = 16
taps_fixed = no
shadow_strength = 0.9
show_lights = no
show_maps = no
exposure = auto
limit = nodes=100000
[kiosk]
socket = ctl
captions = yes
caption_seconds = 2
idle = first
idle_after = 90
fade = 0.3
[mode "Soft"]
shadow = pcss
exposure = -1
[mode "Plan"]
camera = Top
shadow = planar
show_lights = yes
[light "Sun"]
shadow = hard
radius = 0.01
[button "next"]
line = GPIO17
keys = space right
active_high = no
bias = pull-up
debounce_ms = 25
hold_ms = 900
press = next
hold = mode Soft
[button "prev"]
line = label:pinctrl-rp1/27
double_ms = 300
repeat_ms = 250
click = prev
double = pause
repeat = next-camera
[button "both"]
chord = next prev
chord_ms = 100
press = info
END
timeout 60 "$gnomon" show --check good.ini > out 2>&1 || complain "the good one: $(cat out)"

# what 0.1.0 could read means the same still
timeout 60 "$gnomon" show --check kiosk-0.1.0.ini > out 2> err || complain "of 0.1.0: $(cat err)"
tail -n +2 out | cmp -s kiosk-0.1.0.txt - || complain "of 0.1.0, other than then: $(tail -n +2 out | diff kiosk-0.1.0.txt -)"

# ---- a start that is never black: a picture, status 0, and the reason on the screen and in the status

mkdir folder.ini && mkfifo fifo.ini && head -c 1100000 /dev/zero > long.ini
printf '[scene]\nfile = none.glb\ncamera = Top\n' > scene.ini
printf '[kiosk]\nsocket = folder.ini\n' > socket.ini
printf '{"asset": {}}' > bad.gltf

# starts TEXT ARGUMENT..
starts() {
    local text=$1
    shift
    timeout 60 "$gnomon" show --backend egl --size 32x18 --frames 2 "$@" > out 2> err
    local got=$?
    [ "$got" = 0 ] && grep -qF "warning: $text" err || complain "show $*: status $got, $(cat err)"
}
sed 's/^rotate = 90/rotate = @/' good.ini > bad.ini
starts 'bad.ini:5: rotate: "@" is not one of' -c bad.ini
starts 'folder.ini: is a folder, not a file (running' -c folder.ini
starts 'fifo.ini: is a FIFO, not a file (running' -c fifo.ini
starts 'long.ini: larger than the limit' -c long.ini
starts 'none.ini: cannot open: No such file or directory (running' -c none.ini
starts 'scene.ini:2: file: none.glb: cannot open: No such file or directory (showing the default' -c scene.ini
starts 'bad.gltf: asset.version: missing' bad.gltf
starts 'none.glb: cannot open' none.glb sundial.glb --camera nosuch
NOTIFY_SOCKET=vsock:2:1 starts 'NOTIFY_SOCKET=vsock:2:1: expected a path' sundial.glb
starts 'control socket folder.ini: path exists and is not a socket' -c socket.ini
timeout 60 "$gnomon" show --backend egl --frames 2 --camera nosuch sundial.glb > out 2> err
[ $? = 2 ] || complain "a wrong command line does not end the kiosk: $(cat err)"

# a font that cannot be used, and a warning, are told while the kiosk runs
printf '[render]\nfont = none.ttf\nlimit = maps_mb=1\n' > font.ini
timeout 60 "$gnomon" show --backend egl --size 32x18 -c font.ini --socket ctl-font 2> err &
for _ in $(seq 600); do [ -S ctl-font ] || sleep .1; done
"$gnomon" ctl --socket ctl-font screenshot font.png > out || complain "font.ini: screenshot: $(cat out)"
for _ in $(seq 600); do grep -q maps_mb=1 err || sleep .1; done
grep -q '^gnomon: warning: font.ini:2: font: none.ttf: cannot open: No such file or directory (texts are shown in the built-in font)$' err || complain "a missing font: $(cat err)"
grep -q '^gnomon: warning: shadow maps exceed the limit maps_mb=1' err || complain "a warning of a kiosk: $(cat err)"
"$gnomon" ctl --socket ctl-font status > out
grep -q '^config.error: font.ini:2: font: none.ttf' out || complain "font.ini: status: $(cat out)"
"$gnomon" ctl --socket ctl-font quit > /dev/null
wait $! || complain "font.ini: status $? at the end"
[ "$(grep -c maps_mb=1 err)$(grep -c none.ttf err)" = 11 ] || complain "warnings of a kiosk twice: $(cat err)"

for file in scene.ini folder.ini; do
    timeout 60 "$gnomon" show --backend egl --size 32x18 -c $file --socket ctl-$file 2> /dev/null &
    for _ in $(seq 600); do [ -S ctl-$file ] || sleep .1; done
    "$gnomon" ctl --socket ctl-$file status > out 2> err || complain "$file: status: $(cat err)"
    grep -q "^config.error: $file:* *[2i]" out && grep -q '^scene: (default scene)' out || complain "$file: status: $(cat out)"
    "$gnomon" ctl --socket ctl-$file quit > /dev/null
    wait $! || complain "$file: status $? at the end"
done

# ---- what --check looks at

# checked TEXT LINE..: an INI file of those lines is refused
checked() {
    local text=$1
    shift
    printf '%s\n' "$@" > bad.ini
    timeout 60 "$gnomon" show --check bad.ini > out 2> err && complain "--check passes $*"
    grep -qF "gnomon: bad.ini:2: $text" err || complain "--check $*: $(cat err)"
}
checked 'file: none.glb: cannot open' '[scene]' 'file = none.glb'
checked 'font: none.ttf: cannot open' '[render]' 'font = none.ttf'
checked 'font: good.ini: not a scalable' '[mode "A"]' 'font = good.ini'
checked 'socket: control socket folder.ini: path exists' '[kiosk]' 'socket = folder.ini'
checked 'socket: control socket good.ini/ctl: good.ini is not a folder' '[kiosk]' 'socket = good.ini/ctl'
checked 'socket: control socket none/none/ctl: there is no folder none' '[kiosk]' 'socket = none/none/ctl'
checked 'connector: "HDMI" is not a connector' '[display]' 'connector = HDMI'
checked 'card: "card1" is not a device' '[display]' 'card = card1'

exit $bad

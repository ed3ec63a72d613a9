#!/bin/sh
# What the world can do to the program: hostile command lines, files, environments, limits and
# signals. Whatever happens, it ends with 0, 1 or 2, says one line if it failed, and leaves no
# temporary file.
. tests/script.sh
case $gnomon in */asan/*) asan=1 ;; *) asan=0 ;; esac

# run ARGUMENT..: status in $got, stderr in $said (by a pipe: a limit on files does not cut it)
run() {
    said=$(timeout 60 "$gnomon" "$@" 2>&1 > "${output:-/dev/null}" < /dev/null)
    got=$?
    printf '%s\n' "$said" | cut -c -600 > "$folder/said"
    lines=$(printf '%s' "$said" | grep -c '')
    [ "$got" -le 2 ] || complain "gnomon $*: status $got: $said"
    [ "$got" = 0 ] || [ "$lines" = 1 ] || complain "gnomon $*: $lines lines on stderr: $said"
    case $said in '' | 'gnomon: '*) ;; *) complain "gnomon $*: not our words: $said" ;; esac
    for left in "$folder"/.gnomon-*; do
        [ ! -e "$left" ] || { complain "gnomon $*: leaves $left" && rm -f "$left"; }
    done
}

# expect STATUS TEXT ARGUMENT..
expect() {
    wanted=$1 text=$2
    shift 2
    run "$@"
    [ "$got" = "$wanted" ] || complain "gnomon $*: status $got, not $wanted: $said"
    case $said in *"$text"*) ;; *) complain "gnomon $*: no \"$text\" in: $said" ;; esac
}

draw() {
    run render --size 8x8 -o "$folder/a.png" "$@"
}

picture="--size 8x8 -o $folder/a.png"

# ---- scenes whose cost is not in their size

# as many flat casters of the scene's size as there are instances, by 600 bytes
triangle=$(printf '\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0@\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0@' | base64)
cat > "$folder/stack.gltf" << EOF
{"asset":{"version":"2.0"},"extensionsUsed":["EXT_mesh_gpu_instancing"],
"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,$triangle"}],
"bufferViews":[{"buffer":0,"byteLength":36}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[2,0,2]},
{"componentType":5126,"count":100000,"type":"VEC3"}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"nodes":[{"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":1}}}}],
"scenes":[{"nodes":[0]}]}
EOF
# shellcheck disable=SC3045
(ulimit -t 8 && expect 0 '' inspect "$folder/stack.gltf" && exit "$bad") || bad=1 # seconds on a processor

# ---- command lines

# under sanitizers, ten times slower, those whose bytes are dangerous; tests of units have the others
if [ $asan = 1 ]; then set -- '' 1e999 99999999999999999999 %s%n; else
    set -- '' -1 1e999 nan inf abc 99999999999999999999 0x10 ' 1' '1 ' %s%n; fi
for value; do
    for option in time size shadow map map-format shadow-strength light aov output exposure msaa \
        without limit backend frames fps; do
        case $option$value in exposure-1) continue ;; esac
        expect 2 "--$option: " render -o "$folder/a.png" "--$option=$value"
    done
    for option in camera animation; do expect 2 "--$option: " render -o "$folder/a.png" "--$option=$value"; done
done
for option in camera animation time size shadow out config limit; do
    expect 2 "--$option needs a value" render "--$option"
done
for name in noext a.jpg .; do expect 2 'use .png or .pfm' render -o "$name"; done
for name in %s %n %100000d %d-%d '%*d' %-5d %ld '%1$d' %% %; do
    expect 2 'as in frame-%04d.png' render -o "$folder/$name.png" --frames 2
    expect 2 'as in frame-%04d.png' render -o "$folder/$name.png"
done
long=$(printf '%0300d' 0)
mkdir "$folder/folder.png" && : > "$folder/empty.glb" && mkfifo "$folder/fifo.glb"
expect 1 'cannot write: File name too long' render --size 8x8 -o "$folder/$long.png"
expect 1 'is a folder' render --size 8x8 -o "$folder/folder.png"
expect 1 'cannot write: No such file' render --size 8x8 -o "$folder/none/a.png"
expect 1 'is a folder' inspect "$folder"
expect 1 'is a FIFO' inspect "$folder/fifo.glb"
expect 1 'is a device' inspect /dev/zero
expect 1 'the file is empty' inspect "$folder/empty.glb"
expect 2 'SCENE: ""' inspect ''
# shellcheck disable=SC2086
expect 2 'exclude each other' render $picture --animation hoop --no-animation
# shellcheck disable=SC2086
expect 2 '--mode: there is no shadow technique' render $picture --mode nosuch
expect 2 '--without: unknown capability "wings"' bench --without r16f,wings
expect 2 "--limit: unknown limit 'verts'" inspect --limit verts=1
expect 1 'more than the limit nodes=1' inspect --limit nodes=1
expect 0 '' inspect --limit nodes=100000000
[ ! -e "$folder/a.png" ] || complain 'a refused command line left a picture'

# ---- capabilities and shaders

caps=depth-compare,r32ui,r16f,rgba16f,srgb,msaa4,timer,debug
for cap in $(echo $caps | tr , ' ') $caps; do
    draw --without "$cap" --msaa 4
    [ "$got" = 0 ] || complain "--without $cap: $said"
done
cp -r shaders_es "$folder/shaders"
expect 1 'none/blocks.glsl: cannot open' render --size 8x8 --shaders "$folder/none" -o "$folder/a.png"
printf '\nvoid bro\033ken( {\n' >> "$folder/shaders/shadow/pcf.glsl"
expect 1 'fragment: ' render --size 8x8 --shaders "$folder/shaders" -o "$folder/a.png"
case $said in *'-v prints the source'*) ;; *) complain "a failed shader: $said" ;; esac
"$gnomon" render -v --size 8x8 --shaders "$folder/shaders" -o "$folder/a.png" 2> "$folder/err" &&
    complain 'a failed shader and status 0'
grep -q '^ *[0-9]*  void bro?ken( {$' "$folder/err" || complain 'the source of a failed shader'
tail -n 1 "$folder/err" | grep -q '^gnomon: shader program' || complain 'the line of a failed shader'
head -c 5000 /dev/urandom > "$folder/shaders/lit.frag"
expect 1 'shader program' render --size 8x8 --shaders "$folder/shaders" -o "$folder/a.png"

# ---- the INI file

cat > "$folder/good.ini" << 'END'
[display]
connector = HDMI-A-1          ; default: the first connected
mode = 1920x1080@60
rotate = 90
max_fps = 60
backend = egl
[scene]
file = scene.glb
camera = Dial
animation = hoop
no_animation = no
time = 1.5
turntable = 6
[render]
size = 8x8
shadow = pcf
map = 64
map_format = auto
shadow_strength = .5
show_lights = no
light = 0
aov = color
output = srgb
exposure = auto
msaa = 0
without = timer
limit = nodes=5000
[mode "Soft"]
shadow = pcf5
limit = nodes=4000
[mode "Plan"]
camera = Top
without = debug
END
cp assets/sundial.glb "$folder/scene.glb"
ini=$folder/k.ini
show() { run show -c "$ini" --backend egl --frames 1 --size 8x8; }
cp "$folder/good.ini" "$ini" && show
[ "$got" = 0 ] || complain "a good INI file: $said"
number=0
while IFS= read -r line; do
    number=$((number + 1)) key=${line%% *}
    broken() { sed "${number}s|.*|$1|" "$folder/good.ini" > "$ini" && expect 2 "$ini:$number: $2" render -c "$ini" -o "$folder/a.png"; }
    case $line in
    '['*) broken "${line%]}" 'a section ends with ]' && broken "$line x" 'nothing may follow' && broken '[x]' 'unknown section' ;;
    *)
        broken "${key}x = 1" "unknown key \"${key}x\""
        broken "$key 1" "expected KEY = VALUE or [section], not \"$key 1\""
        broken " $line" 'begins with a space'
        broken "$key =" "$key: \"\" is not"
        case $key in # any text is a name; a file is looked for
        connector | file) ;;
        camera) [ "$number" -gt 27 ] || broken "$key = nosuch" "$key: " ;;
        *) broken "$key = nosuch" "$key: " ;;
        esac
        ;;
    esac
done < "$folder/good.ini"

# bad_ini TEXT PRINTF-FORMAT
bad_ini() {
    # shellcheck disable=SC2059
    printf "$2" > "$ini"
    expect 2 "$ini:$1" render -c "$ini" -o "$folder/a.png"
}
bad_ini '2: control characters' '[render]\nmap = 64\000\n'
bad_ini '1: control characters' '[render]\rmap = 64\r'
bad_ini '2: a line of more than 190' "[render]\\nmap = $(printf '%0190d' 64)\\n"
bad_ini '2: a key of more than 48' "[render]\\n$(printf '%049d' 0) = 1\\n"
bad_ini '2: mode "a" is there already' '[mode "a"]\n[mode "a"]\n'
bad_ini '3: map is set already' '[render]\nmap = 64\nmap = 64\n'
bad_ini '2: shadow: "pcf,hard": one technique' '[render]\nshadow = pcf,hard\n'
printf '\357\273\277[render]\r\nmap = 64\r\n' > "$ini" && show
[ "$got$said" = 0 ] || complain "a byte order mark and CR LF: $said"
# what only the scene or the GPU can know does not end a kiosk, and is said with its place
for line in '[scene]|camera = nosuch' '[scene]|animation = nosuch' '[render]|limit = verts=1' \
    '[render]|without = wings' '[render]|shadow = pcf,hard' '[mode "A"]|without = wings'; do
    printf '%s\n' "$line" | tr '|' '\n' > "$ini" && show
    case $got$said in 0*"$ini:2: "*) ;; *) complain "show with $line: $said" ;; esac
done

# ---- scenes

# scene NAME NODES [LIGHT]: a triangle, and what stands in the array of nodes
scene() {
    cat > "$folder/$1.gltf" << END
{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
 "nodes": [$2], "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1, "zfar": 0.1}}],
 "extensionsUsed": ["KHR_lights_punctual"],
 "extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "spot": {}, ${3:-"\"intensity\": 100"}}]}},
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
 "buffers": [{"byteLength": 36, "uri": "data:;base64,AAAAAAAAAAAAAAAAAAAAAAAAAAAAAIA/AACAPwAAAAAAAAAA"}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 0, 1]}]}
END
}
lamp='"extensions": {"KHR_lights_punctual": {"light": 0}}'
scene plain '{"mesh": 0}, {"translation": [0, 3, 0], "rotation": [-0.7071068, 0, 0, 0.7071068], '"$lamp"'}'
for scale in 0 1e30 1e-30 1e38; do
    scene "scale$scale" "{\"mesh\": 0, \"scale\": [$scale, $scale, $scale]}, {\"translation\": [0, 3, 0], $lamp}"
done
scene inside '{"mesh": 0}, {'"$lamp"'}'
scene zfar '{"mesh": 0}, {"camera": 0, '"$lamp"'}'
for light in 1e-38 1e38 0; do scene "light$light" "{\"mesh\": 0}, {\"translation\": [0, 3, 0], $lamp}" "\"intensity\": $light"; done
scene extras '{"mesh": 0, "extras": {"gnomon_cast": "x", "gnomon_plane": []}}, {"extras": {"gnomon_radius": {}, "gnomon_map_px": -1, "gnomon_shadow": 3}, '"$lamp"'}'
for name in plain scale0 scale1e30 scale1e-30 scale1e38 inside zfar light1e-38 light1e38 light0 extras; do
    expect 0 '' inspect "$folder/$name.gltf"
    draw --aov visibility "$folder/$name.gltf"
    [ "$got" = 0 ] || complain "$name: $said"
done
# wrong VALUE STATUS TEXT: of a translation, what is said of it
wrong() {
    scene wrong "{\"mesh\": 0, \"translation\": [$1, 0, 0]}, {$lamp}"
    expect "$2" '' inspect "$folder/wrong.gltf"
    expect "$2" "$folder/wrong.gltf: $3" render --size 8x8 -o "$folder/a.png" "$folder/wrong.gltf"
}
for value in NaN Infinity; do wrong "$value" 1 'byte '; done # that is no JSON
wrong 1e999 0 'nodes[0].translation[0]: 9e+307 or more is too large; ignored'
wrong 1e39 0 'nodes[0].translation[0]: 1e+39 is too large; ignored'
for value in '"x"' null; do wrong "$value" 0 'nodes[0].translation[0]: must be a number, is '; done
scene none '{}, {}'
expect 1 'the scene is empty' render --size 8x8 -o "$folder/a.png" "$folder/none.gltf"

# ---- environments

for setting in HOME= HOME=/dev/null XDG_CONFIG_HOME=relative XDG_CACHE_HOME=/dev/null EGL_PLATFORM=junk \
    MESA_SHADER_CACHE_DIR=/dev/null MESA_GLES_VERSION_OVERRIDE=junk LIBGL_DEBUG=verbose TZ=junk/ LC_ALL=junk; do
    said=$(env "$setting" "$gnomon" render --shadow none --size 8x8 -o "$folder/a.png" "$folder/plain.gltf" 2>&1) ||
        complain "$setting: $said"
    [ -z "$said" ] || complain "$setting: $said"
done
export MESA_GLES_VERSION_OVERRIDE=2.0
expect 1 'has only OpenGL ES 2.0; gnomon needs 3.0' render --size 8x8 --backend egl -o "$folder/a.png"
unset MESA_GLES_VERSION_OVERRIDE
export GALLIUM_DRIVER=softpipe && draw "$folder/plain.gltf" && [ "$got" = 0 ] || complain "softpipe: $said"
export GALLIUM_DRIVER=junk && draw # some versions of Mesa crash at it, some know better
unset GALLIUM_DRIVER

# ---- where the output goes

for command in '--help' 'inspect --json' "render $picture --plan" "bench --frames 1 --size 8x8 --json" 'doctor --json'; do
    # shellcheck disable=SC2086
    output=/dev/full expect 1 'standard output: cannot write: No space left' $command
    # shellcheck disable=SC2086
    (sleep .01 && "$gnomon" $command 2> "$folder/err") | true
    [ ! -s "$folder/err" ] || complain "$command to a reader that has gone: $(cat "$folder/err")"
done
output=

# ---- limits (in shells of their own) and signals

rm -f "$folder/a.png"
said=$(ulimit -f 0 && "$gnomon" render --size 64x64 -o "$folder/a.png" 2>&1 > /dev/null)
case $?$said in "1gnomon: $folder/a.png: cannot write: File too large") ;; *) complain "ulimit -f: $said" ;; esac
[ ! -e "$folder/a.png" ] && [ "$(echo "$folder"/.gnomon-*)" = "$folder/.gnomon-*" ] || complain 'what ulimit -f leaves'
if [ $asan = 0 ]; then
    said=$(ulimit -n 16 && "$gnomon" render --size 8x8 -o "$folder/a.png" 2>&1) || complain "ulimit -n: $said"
    for kib in 100000 400000 1500000; do
        said=$(ulimit -v $kib && "$gnomon" render --size 16384x16384 -o "$folder/a.png" 2>&1)
        case $?$said in 1gnomon:*) ;; *) complain "ulimit -v $kib: $? $said" ;; esac
    done
fi
# interrupted while it loads, compiles, draws a long frame or writes to nobody
mkfifo "$folder/fifo.png"
truncate -s 120000000 "$folder/zeros.bin"
cat > "$folder/zeros.gltf" << END
{"asset":{"version":"2.0"},"buffers":[{"byteLength":120000000,"uri":"zeros.bin"}],
"bufferViews":[{"buffer":0,"byteLength":120000000}],"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"accessors":[{"bufferView":0,"componentType":5126,"count":9999999,"type":"VEC3","min":[0,0,0],"max":[2,0,2]}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}]}
END
for signal in TERM=143 INT=130; do
    for command in '.5 bench --size 64x64 --frames 100000 --json' '.5 show --backend egl --size 64x64' \
        ".1 inspect $folder/zeros.gltf" ".4 render --size 8x8 -o $folder/fifo.png" \
        ".7 render --size 4096x4096 --msaa 4 --shadow pcss -o $folder/long.png" \
        "1 render --size 64x64 --frames 100000 -o $folder/%06d.pfm"; do
        after=${command%% *} command=${command#* }
        wanted=${signal#*=}
        case $command in show*) wanted=0 ;; esac
        # shellcheck disable=SC2086
        said=$(timeout -k 5 --preserve-status -s "${signal%=*}" "$after" "$gnomon" $command 2>&1)
        [ "$?$said" = "$wanted" ] || complain "$command by SIG${signal%=*}: $said"
    done
done
[ ! -e "$folder/long.png" ] || complain 'a picture of an interrupted frame'
[ "$(echo "$folder"/.gnomon-*)" = "$folder/.gnomon-*" ] || complain 'what a stopped run leaves'
for file in "$folder"/0*.pfm; do
    [ ! -e "$file" ] || [ "$(wc -c < "$file")" = $((64 * 64 * 12 + 14)) ] || complain "$file is torn"
done

exit $bad

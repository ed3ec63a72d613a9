# Sourced by bash scripts that try a kiosk that runs, unseen, in the top folder; they work in $folder. What tests/script.sh has, and:
# $kiosk, the process, which dies with the script.
# shellcheck shell=bash disable=SC2034
. tests/script.sh
kiosk=''
trap '[ -z "$kiosk" ] || kill -KILL "$kiosk" 2> /dev/null; rm -rf "$folder"' EXIT
unset XDG_RUNTIME_DIR

ctl() { timeout 90 "$gnomon" ctl --socket "$folder/ctl" "$@"; }

# show ARGUMENT..: a kiosk with these; its words are in kiosk.out and kiosk.err
show() {
    "$gnomon" show --backend egl --size 64x36 --socket "$folder/ctl" "$@" > kiosk.out 2> kiosk.err &
    kiosk=$!
}

# stop: by ctl, with status 0
stop() {
    ctl quit > /dev/null
    wait "$kiosk" || complain "it ends with $?: $(cat kiosk.err)"
    kiosk=''
}

# says PATTERN [WHAT [SECONDS]]: a whole line of the status does, within so long
says() {
    local tries
    for tries in $(seq $((${3:-15} * 10))); do
        ctl status > status 2> err && grep -qx -- "$1" status && return
        sleep 0.1
    done
    complain "${2:+$2: }no \"$1\": $(grep -E '^(mode|scene|problem|config|state|schedule|television|blanked|screen)' status; cat err kiosk.err)"
}

# colour NAME R,G,B [SIZE]: NAME.gltf, a scene that is all of that colour, and NAME.png, its picture of 64x36
colour() {
    cat > "$1.gltf" << END
{"asset":{"version":"2.0"},"extensionsUsed":["KHR_materials_unlit"],
"scenes":[{"nodes":[0],"extras":{"gnomon_background":[$2]}}],
"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],
"materials":[{"pbrMetallicRoughness":{"baseColorFactor":[$2,1]},"extensions":{"KHR_materials_unlit":{}}}],
"buffers":[{"byteLength":36,"uri":"${buffer:-data:;base64,AAAAAAAAAAAAAAAAAAAAAAAAAAAAAIA/AACAPwAAAAAAAAAA}"}],
"bufferViews":[{"buffer":0,"byteLength":36}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,0,1]}]}
END
    "$gnomon" render "$1.gltf" --size "${3:-64x36}" --shadow none --msaa 0 -o "$1.png" || complain "render $1"
}

#!/bin/sh
# same.sh take FILE | compare FILE: whether a change that should change no picture changes none.
# `take` draws pictures of every technique, view, map format, AOV and backend and prints their plans, runs
# the self-test, makes the contact sheet, reads the plan goldens, and writes a line "SHA-256  NAME" for each
# into FILE, below head lines (#) that name the machine and the driver: pictures are equal only where these
# are. A name is the command line; "status-N" stands for the hash of what could not be drawn. `compare`
# takes again and prints what differs from FILE or is missing (exit status 1); on another driver it skips.
# Runs in the top folder of the tree whose program is GNOMON; needs `make all tests` there, and tmux.
# Messages and warnings are not compared. The contact sheet also depends on the fonts installed.
set -eu
case "$#${1-}" in 2take | 2compare) ;; *) echo 'usage: tests/same.sh take|compare FILE' >&2 && exit 2 ;; esac
command -v tmux > /dev/null || { echo 'needs tmux: make deps' && exit 77; }
top=$PWD
build=$(realpath "${BUILD:-build/release}")
gnomon=$(realpath "${GNOMON:-build/release/gnomon}")
list=$(realpath -m "$2")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 1' INT TERM
unset DISPLAY WAYLAND_DISPLAY
export LC_ALL=C TZ=UTC LP_NUM_THREADS=1 XDG_CONFIG_HOME="$work/none"

cd "$work" # so that names and what is printed do not depend on folders
ln -s "$top/assets/bench/s1.glb" "$top/assets/bench/s2.glb" "$build/../selftest/lamp.glb" \
    "$build/../selftest/stack.glb" .
cat > modes.ini << 'INI'
[render]
map = 512
[mode "Dial"]
camera = Dial
shadow = pcss
time = 2
[mode "Lamp"]
file = lamp.glb
shadow = msm
[mode "Still"]
no_animation = true
show_maps = true
msaa = 4
INI

# line STATUS FILE NAME: a line of the list
line() {
    hash=status-$1
    [ "$1" != 0 ] || [ ! -e "$2" ] || hash=$(sha256sum < "$2" | cut -d ' ' -f 1)
    echo "$hash  $3"
    rm -f "$2"
}
# output NAME COMMAND..: what it prints
output() {
    name=$1 status=0
    shift
    timeout 300 "$@" > printed 2> /dev/null || status=$?
    line $status printed "$name"
}
# picture SIZE TYPE ARGUMENT..: a picture and its plan
look='--msaa 0 --tone none' # pinned: not the defaults; programs before these had a tone draw so
"$gnomon" help render 2> /dev/null | grep -q -e --tone || look='--msaa 0'
"$gnomon" help render 2> /dev/null | grep -q -e --floor && look="$look --floor none"
"$gnomon" help render 2> /dev/null | grep -q -e --environment && look="$look --environment none"
picture() {
    size=$1 type=$2 plain=$look
    shift 2
    case " $* " in *' --msaa '* | *' Still '*) plain=${look#--msaa 0} ;; esac
    # shellcheck disable=SC2086
    output "plan $size $*" "$gnomon" render --plan --size "$size" $plain "$@" -o "picture.$type"
    line $status "picture.$type" "$type $size $*"
}
small() { picture 320x180 png "$@"; }
# all that the program has, as its refusal of another one lists them
techniques=$("$gnomon" render --shadow '?' 2>&1 | sed -n 's/.* is not one of //p' | tr -d ,)
# and those whose maps are filtered: doctor names another format than that of a map
filtered=$("$gnomon" doctor --backend egl 2> /dev/null | sed -n 's/^ *chosen *//p' | tr ' ' '\n' |
    sed -nE '/:(depth|r32ui|r16f|r16f-raw|rgba8|mask)$/!s/:.*//p' | tr '\n' ' ')
filtered=${filtered:-$techniques}

head_lines() {
    echo "# $(uname -sm), LP_NUM_THREADS=$LP_NUM_THREADS"
    for backend in egl osmesa; do # the lines of the other JSON fields are worded for people
        echo "# $backend: $("$gnomon" doctor --json --backend $backend 2> /dev/null |
            sed -n '/^  "gpu"/,/^  }/s/^    "\(renderer\|gles\)": //p' | tr '\n' ' ')"
    done
}

default_scene() {
    small
    for shadow in $techniques; do
        small --shadow $shadow
        small --shadow $shadow --camera Dial --time 3.5
        small --shadow $shadow --light 1 --aov visibility
        small --backend osmesa --shadow $shadow
    done
    for shadow in pcf pcss msm planar; do
        small --shadow $shadow --mode none
        small --mode $shadow --camera Top
        small --shadow $shadow --msaa 4
        small --shadow $shadow --time 7
        small --shadow $shadow --show-maps --show-lights
        picture 320x180 pfm --shadow $shadow --output linear
        for aov in color visibility distance normal map; do
            picture 320x180 pfm --shadow $shadow --aov $aov
        done
        picture 1280x720 png --shadow $shadow
    done
    small --aov normal
    small --aov map --light 1
    small --shadow hard --msaa 2 --map 300
    for format in depth r32ui r16f r16f-raw rgba8; do
        for shadow in hard pcf; do small --shadow $shadow --map-format $format; done
    done
    for format in rg32ui rgba16ui rgba16f rgba32f-bits rgba32f-share rgba32ui; do
        for shadow in $filtered; do small --shadow $shadow --map-format $format; done
    done
}

options() {
    small --shadow planar --planar stencil
    for taps in 8 32; do
        for shadow in disk pcss; do small --shadow $shadow --taps $taps --taps-fixed; done
    done
    small --shadow-strength .5 --exposure -1
    small --no-animation --caption Sundial
    small --animation hoop --time 1
    for without in srgb depth-compare,r32ui rgba16f,rgba16ui,rgba32ui r16f,rg32ui; do
        for shadow in pcf hard evsm msm; do small --without $without --shadow $shadow; done
    done
    output 'plan turn' "$gnomon" render --plan --size 320x180 --frames 2 --fps 2 --turntable 30 -o turn-%04d.png
    for n in 0 1; do line "$status" turn-000$n.png "png turn $n"; done
    for mode in Dial Lamp Still; do small -c modes.ini --mode $mode; done
}

other_scenes() {
    for scene in s1.glb s2.glb lamp.glb stack.glb; do
        for shadow in $techniques; do small $scene --shadow $shadow; done
        small $scene --shadow pcf --aov visibility
        output "inspect $scene" "$gnomon" inspect --json $scene
    done
    output inspect "$gnomon" inspect --json
}

self_test() {
    status=0
    "$gnomon" doctor --self-test --json > all 2> /dev/null || status=$?
    sed -n '/^  "self_test"/,$p' all > printed
    line $status printed self-test
}

# where the captions of modes are shown; it says itself what went wrong
contact_sheet() (
    cd "$top"
    status=0
    BUILD=$build GNOMON=$gnomon tests/image/accept_terminal.sh "$work/sheet.png" > "$work/said" 2>&1 || status=$?
    [ $status = 0 ] || cat "$work/said" >&2
    line $status "$work/sheet.png" 'contact sheet'
)

take() {
    head_lines
    (cd "$top" && sha256sum assets/sundial.glb assets/bench/*.glb tests/plan/golden/*)
    default_scene
    options
    other_scenes
    self_test
    contact_sheet
}

if [ "$1" = take ]; then
    take > new
    cp new "$list"
    exit
fi

head_lines > here
if ! grep '^#' "$list" | cmp -s - here; then
    echo "another machine or driver: $(tr '\n' ' ' < here)here, $(grep '^#' "$list" | tr '\n' ' ')in $2"
    exit 77
fi
take > new
awk '/^#/ { next }
{ hash = $1; name = substr($0, length(hash) + 3) }
NR == FNR { was[name] = hash; next }
!(name in was) { print "new:     " name; next }
was[name] == hash { same++ }
was[name] != hash { print "differs: " name; bad++ }
{ delete was[name] }
END {
    for (name in was) { print "missing: " name; bad++ }
    printf "%d the same, %d not\n", same, bad
    exit bad > 0
}' "$list" new

#!/bin/sh
# accept_terminal.sh [OUT.png]: the kiosk with the default scene in a terminal, where somebody types: the
# space bar goes through modes of all techniques, in their order, and ^C ends it. Its screenshots of them
# become one sheet, OUT.png, which `make contact-sheet` leaves to be looked at.
set -u
build=${BUILD:-build/release}
gnomon=$(realpath "${GNOMON:-build/release/gnomon}")
command -v tmux > /dev/null || { echo 'needs tmux: make deps' && exit 77; }
folder=$(mktemp -d)
out=$(realpath -m "${1:-$folder/sheet.png}")
tmux() { command tmux -S "$folder/tmux" -f /dev/null "$@"; }
trap 'tmux kill-server 2> /dev/null; rm -rf "$folder"' EXIT
export XDG_CONFIG_HOME="$folder/none" XDG_RUNTIME_DIR="$folder"

fail() {
    echo "FAIL: $*"
    tmux capture-pane -p -t kiosk 2> /dev/null | grep -v '^$'
    exit 1
}
ctl() { "$gnomon" ctl --socket "$folder/ctl" "$@"; }
shoot() { ctl screenshot "$folder/$1.png" > /dev/null; } # a busy machine's kiosk may be too late for it
value() { ctl status 2> /dev/null | sed -n "s/^$1: //p"; }
# until_is KEY VALUE: in two minutes; on a machine without a GPU programs take their time
until_is() {
    left=600
    until [ "$(value "$1")" = "$2" ]; do
        left=$((left - 1))
        [ $left -gt 0 ] || fail "$1 is \"$(value "$1")\", not \"$2\""
        sleep 0.2
    done
}

printf '[kiosk]\ncaption_seconds = 60\n' > "$folder/kiosk.ini"
techniques=$("$gnomon" help show | tr '\n' ' ' | sed -n 's/.*One of: \(none, [a-z0-9, ]*\).*/\1/p' | tr -d ,)
for technique in $techniques; do
    printf '[mode "%s"]\nshadow = %s\n' "$technique" "$technique"
done >> "$folder/kiosk.ini"
tmux new-session -d -s kiosk -x 100 -y 30 \
    "'$gnomon' show -v --backend egl --size 480x270 --no-animation -c '$folder/kiosk.ini' --socket '$folder/ctl'; echo \"ended with \$?\"; cat"
until_is waits no
modes=$(value modes | tr -d ,)
tmux send-keys -t kiosk BSpace
until_is mode "${modes##* }"
until_is waits no
tmux send-keys -t kiosk Space
set --
[ "$(echo "$modes" | wc -w)" -gt 10 ] || fail "modes: $modes"
for mode in $modes; do
    until_is mode "$mode"
    until_is waits no
    shoot "$mode" || shoot "$mode" || shoot "$mode" || fail "no screenshot of $mode"
    set -- "$@" "$folder/$mode.png"
    tmux send-keys -t kiosk Space
done
until_is mode "${modes%% *}"
until_is input.seen $(($# + 2))
echo "$# modes, $(value input.median_ms) ms from a key to its picture and $(value input.median_frames) frames, at worst $(value input.worst_ms) ms"
tmux send-keys -t kiosk C-c
left=100
until tmux capture-pane -p -t kiosk | grep -q 'ended with'; do
    left=$((left - 1))
    [ $left -gt 0 ] || fail '^C does not end it'
    sleep 0.1
done
tmux capture-pane -p -t kiosk | grep -q '^ended with 0' || fail 'it does not end well'
"$build/tests/tool_sheet" "$out" 4 "$@"

#!/bin/sh
# The kiosk unseen: it ends by a signal or after its frames, with status 0, and without a word.
set -u
gnomon=${GNOMON:-build/release/gnomon}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export XDG_CONFIG_HOME="$folder/none"
bad=0

# quiet ARGUMENT..: status 0, nothing on stdout and stderr; the end of stdin is no reason to go
quiet() {
    "$@" > "$folder/out" 2>&1 < /dev/null
    status=$?
    [ "$status" = 0 ] || { echo "FAIL: $*: exit status $status" && bad=1; }
    [ ! -s "$folder/out" ] || { echo "FAIL: $*: $(cat "$folder/out")" && bad=1; }
}

# until_signal SIGNAL SECONDS ARGUMENT..: runs as long as that, then ends by that signal
until_signal() {
    signal=$1 seconds=$2
    shift 2
    before=$(date +%s)
    quiet timeout --preserve-status --kill-after=20 -s "$signal" "$seconds" "$gnomon" show --backend egl --size 64x64 "$@"
    [ $(($(date +%s) - before)) -ge "${seconds%.*}" ] || { echo "FAIL: show $* ended by itself" && bad=1; }
}

until_signal TERM 3
until_signal INT 3 --no-animation
until_signal TERM 0.5 # while it still loads
quiet "$gnomon" show --backend egl --size 64x64 --frames 3

# with -v it counts: a frame a tick, only one while nothing changes, and nothing made after the first
says() {
    text=$1
    shift
    "$@" 2> /dev/null > "$folder/said" < /dev/null
    grep -q "$text" "$folder/said" || { echo "FAIL: $*: $(cat "$folder/said")" && bad=1; }
}
says '^10 frames, [0-9]* late, 0 allocations and 0 GL objects' \
    "$gnomon" show -v --backend egl --size 64x64 --frames 10

# still FRAMES ARGUMENT..: a scene in which nothing moves has as many, and so many are late. Within an operation of the driver
# that takes long SIGTERM ends it without its counts: on a busy machine the work ahead of the next mode
# may last
still() {
    frames=$1
    shift
    for seconds in 8 30 90; do
        timeout -s TERM $seconds "$gnomon" show -v --backend egl --size 64x64 --no-animation "$@" \
            2> /dev/null > "$folder/out" < /dev/null
        ! grep -q ' late, ' "$folder/out" || break
    done
    says "^$frames late, 0 allocations and 0 GL objects" cat "$folder/out"
}
still "1 frames, 0"
# sixteen points of the lamp with each frame; after the last of 64 the mask is whole
still "4 frames, [0-9]*" --shadow planar --planar soft

exit $bad

#!/bin/bash
# Clips in a kiosk: none draws frames once it stands, at its end or without a speed; a mode that
# begins its clips anew plays them each time it is entered.
. tests/script.sh
kiosk=''
trap '[ -z "$kiosk" ] || kill -KILL "$kiosk" 2> /dev/null; rm -rf "$folder"' EXIT

ctl() { timeout 90 "$gnomon" ctl --socket "$folder/ctl" "$@" > "$folder/out" 2>&1; }

# frames: how many were drawn
frames() {
    until ctl status --json && grep -q '"drawn"' "$folder/out"; do sleep .1; done
    grep -o '"drawn": *[0-9]*' "$folder/out" | grep -o '[0-9]*$'
}

# stands WHAT: no frame within .8 s, twenty seconds from now at the latest
stands() {
    for _ in $(seq 25); do
        local before
        before=$(frames)
        sleep .8
        [ "$(frames)" != "$before" ] || return 0
    done
    complain "$1: draws frames for ever"
}

# moves WHAT: frames, within twenty seconds
moves() {
    local before
    before=$(frames)
    for _ in $(seq 100); do
        [ "$(frames)" -le $((before + 5)) ] || return 0
        sleep .2
    done
    complain "$1: draws no frames"
}

cat > "$folder/kiosk.ini" << 'END'
[kiosk]
clip_fade = 0
captions = no
[scene]
animation_loop = once
animation_speed = 6
[mode "Once"]
shadow = hard
[mode "Anew"]
shadow = hard
animation_restart = yes
[mode "Still"]
shadow = hard
animation_speed = 0
animation_start = 3
[mode "Loop"]
shadow = hard
animation_loop = loop
END
"$gnomon" show --backend egl --size 64x36 --socket "$folder/ctl" -c "$folder/kiosk.ini" \
    > "$folder/kiosk.out" 2>&1 &
kiosk=$!
for _ in $(seq 600); do ctl status && break || sleep .1; done

stands 'clips that played once'
# entered: a few frames for the other mode, but none of the clips, which have ended
before=$(frames)
ctl mode Still
stands 'clips without a speed'
ctl mode Once
stands 'clips that have ended'
passed=$(($(frames) - before))
before=$(frames)
ctl mode Anew
sleep 1
stands 'clips that began anew'
anew=$(($(frames) - before))
[ "$anew" -gt $((passed + 20)) ] || complain "begun anew $anew frames, of clips that ended $passed"
ctl mode Still
stands 'clips without a speed'
before=$(frames)
ctl mode Anew
sleep 1
stands 'clips that began anew once more'
again=$(($(frames) - before))
[ "$again" -gt $((passed + 20)) ] || complain "once more $again frames, of clips that ended $passed"
before=$(frames)
ctl mode Anew
sleep 1
stands 'clips that began anew where their mode was shown'
named=$(($(frames) - before))
[ "$named" -gt $((passed + 20)) ] || complain "named again $named frames, of clips that ended $passed"
ctl mode Loop
moves 'clips in a loop'
ctl set animation_speed 0
stands 'clips whose speed is set to 0'
ctl set animation_speed 2
moves 'clips that go on'
ctl quit
wait "$kiosk" || complain "status $?"
kiosk=''
echo "frames: $passed of modes whose clips stand, $anew, $again and $named of clips begun anew"
exit $bad

#!/bin/bash
# Clips in a kiosk: none draws frames once it stands, at its end or without a speed; a mode that
# begins its clips anew plays them each time it is entered.
. tests/kiosk.sh
cd "$folder" || exit 1

# frames: how many were drawn
frames() {
    ctl status | sed -n 's/^frames.drawn: //p'
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

cat > kiosk.ini << 'END'
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
animation_speed = 2
[mode "Still"]
shadow = hard
animation_speed = 0
animation_start = 3
[mode "Loop"]
shadow = hard
animation_loop = loop
END
show -c kiosk.ini
says 'frames.drawn: [1-9].*' 'a start' 60

stands 'clips that played once'
# entered: a few frames for the other mode, but none of the clips, which have ended
before=$(frames)
ctl mode Still > /dev/null
stands 'clips without a speed'
ctl mode Once > /dev/null
stands 'clips that have ended'
passed=$(($(frames) - before))

# begins WHAT: the mode Anew plays its clips once
begins() {
    local before new
    before=$(frames)
    ctl mode Anew > /dev/null
    sleep 1
    stands "$1"
    new=$(($(frames) - before))
    [ "$new" -gt $((passed + 8)) ] || complain "$1: $new frames, and $passed of clips that have ended"
    begun="$begun $new"
}
begun=''
begins 'clips of a mode that is entered'
ctl mode Still > /dev/null
stands 'clips without a speed'
begins 'clips of a mode that is entered again'
begins 'clips of a mode that is named while it is shown'

ctl mode Loop > /dev/null
moves 'clips in a loop'
ctl set animation_speed 0 > /dev/null
stands 'clips whose speed is set to 0'
ctl set animation_speed 2 > /dev/null
moves 'clips that go on'
stop
echo "frames: $passed of modes whose clips stand;$begun of clips that begin"
exit $bad

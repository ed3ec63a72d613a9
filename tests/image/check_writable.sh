#!/bin/bash
# What must be writable (board/README.md): nothing for the picture. In a mount namespace with everything read-only but the socket's folder,
# and again with a full disk in the place of each folder of the list, the kiosk shows its scene, answers, names what it cannot keep, and its
# journal stays short.
if [ "${1:-}" != inside ]; then
    unshare --user --map-root-user --mount true 2> /dev/null || { echo 'needs user namespaces'; exit 77; }
    base=$(mktemp -d)
    trap 'rmdir "$base"' EXIT
    unshare --user --map-root-user --mount bash "$0" inside "$base"
    exit
fi
base=$2
mount -t tmpfs tmpfs "$base" || exit 1
export TMPDIR=$base
. tests/kiosk.sh
mkdir "$folder/fixed" "$folder/full" "$folder/fixed/cache"
cd "$folder" || exit 1
colour red 1,0,0
mv red.gltf fixed
mount -t tmpfs -o size=64k full full && mkdir full/cache && head -c 1000000 /dev/zero > full/filled 2> /dev/null
mount --bind fixed fixed && mount -o remount,bind,ro fixed || complain 'a folder that cannot be written'
# all that this user may make so; what is left is the test's own folder
awk '{ print $5 }' /proc/self/mountinfo | sort -u | while read -r at; do
    case $at in "$base"*) ;; *) mount -o remount,bind,ro "$at" 2> /dev/null ;; esac
done
for at in / /tmp /var/tmp "$HOME" "$folder/fixed"; do
    ! touch "$at/gnomon-probe" 2> /dev/null || { rm -f "$at/gnomon-probe" && complain "$at can be written"; }
done
! echo x > full/more 2> /dev/null || [ ! -s full/more ] || complain 'the full disk has room'

for place in fixed full; do
    printf '%s\n' '[scene]' "file = $folder/fixed/red.gltf" '[mode "A"]' 'shadow = none' '[mode "B"]' 'shadow = none' '[kiosk]' \
        "state = $folder/$place/state" "screenshots = $folder/$place" "content = $folder/$place/content" > kiosk.ini
    export MESA_SHADER_CACHE_DIR=$folder/$place/cache XDG_CACHE_HOME=$folder/$place/cache
    show -c kiosk.ini
    says 'mode: A' "$place"
    ctl mode B > reply || complain "$place: mode B: $(cat reply)"
    says 'mode: B' "$place"
    for _ in {1..60}; do # until the captions are gone
        ctl screenshot now.png > reply || complain "$place: no screenshot: $(cat reply)"
        ! cmp -s now.png red.png || break
        sleep 0.5
    done
    cmp -s now.png red.png || complain "$place: the picture is another one"
    ! ctl screenshot "$folder/$place/lost.png" > reply 2>&1 || complain "$place: a screenshot was kept"
    for _ in 1 2 3 4 5 6; do
        ctl mode A > /dev/null
        ctl mode B > /dev/null
        sleep 0.5
    done
    says 'problem: .*state.*' "$place"
    stop
    [ "$(cat kiosk.out kiosk.err | wc -l)" -le 12 ] || complain "$place: its journal is $(cat kiosk.out kiosk.err | wc -l) lines: $(head -n 20 kiosk.err)"
done
rm -f full/filled

# the list is the units', which have no other folder
grep -q '^| `/var/lib/gnomon` |' "$OLDPWD/board/README.md" || complain 'the list of board/README.md'
sed -n '/^## What must be writable/,/^## /p' "$OLDPWD/board/README.md" | grep -oE '^\| `/[a-z/]+`' | tr -d '|` ' | sort > list
cat "$OLDPWD"/board/systemd/{common,gnomon.service}.in | sed -n 's,^CacheDirectory=,/var/cache/,p; s,^StateDirectory=,/var/lib/,p; s,^RuntimeDirectory=,/run/,p; s,^ReadWritePaths=,,p' | sort > units
cmp list units || complain "the list of board/README.md: $(diff list units)"
cd / && umount "$folder/fixed" "$folder/full"
exit $bad

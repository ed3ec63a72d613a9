#!/bin/sh
# gnomon doctor --report on this machine, with names of host and user that must not be in it; gpu.sh; what two reports say.
. tests/script.sh
secret=zimmermann-kiosk
mkdir "$folder/$secret"
cp -r shaders_es "$folder/$secret"

# with a host name of its own where user namespaces are allowed; the self-test then loads its shaders from a path with the name
# shellcheck disable=SC2016
report='hostname zimmermann-kiosk 2> /dev/null
cd "$1/zimmermann-kiosk" && exec "$2" doctor --report --shaders "$1/zimmermann-kiosk/shaders_es"'
inside='unshare --user --map-root-user --uts'
$inside true 2> /dev/null || inside=
HOSTNAME=$secret USER=wilhelmine LOGNAME=wilhelmine SUDO_USER=wilhelmine HOME=$folder/$secret WAYLAND_DISPLAY=$folder/$secret/wayland-0 \
    $inside sh -c "$report" sh "$folder" "$gnomon" > "$folder/out" 2> "$folder/err" || complain "$(cat "$folder/out" "$folder/err")"
made=$folder/$secret/gnomon-report.json
[ -s "$made" ] || complain 'there is no report'
for word in zimmermann wilhelmine "$folder" /tmp /home "$(hostname)" "$(cat /etc/machine-id 2> /dev/null || echo -)"; do
    case $word in localhost | debian | -) continue ;; esac
    ! grep -qiwF -- "$word" "$made" || complain "$word is in the report: $(grep -iwF -- "$word" "$made")"
done
! grep -qE '([0-9a-f]{2}:){5}|"/|[^0-9a-z]/(dev|etc|proc|sys|usr|var|root)/' "$made" || complain "an address or a path: $(grep -E '([0-9a-f]{2}:){5}|/dev' "$made")"
for field in gnomon_report built version kernel cpus renderer gles proved map_formats self_test failed bench ms_median connectors gpio problems; do
    grep -q "\"$field\":" "$made" || complain "no $field"
done
[ "$(grep -c '"ms_median": [0-9]*[1-9]' "$made")" = 6 ] || complain "times: $(grep '"ms_median"\|"failure": "' "$made")"
grep -q '^| [^|]* | OpenGL ES ' "$folder/out" || complain "no row: $(cat "$folder/out")"

expect 0 '' doctor --compare "$made"
expect 0 '' doctor --compare "$made" "$made"
grep -q '^nothing differs' "$folder/out" && grep -q '^verdict: neither is worse' "$folder/out" || complain "$(cat "$folder/out")"
sed 's/"failed": 0/"failed": 3/' "$made" > "$folder/worse.json"
expect 3 'is worse than' doctor --compare "$made" "$folder/worse.json"
grep -q '^verdict: B is worse than A: 3 more rows of the self-test fail' "$folder/out" || complain "$(cat "$folder/out")"
head -c 900 "$made" > "$folder/cut.json"
expect 1 'not a whole report' doctor --compare "$made" "$folder/cut.json"
expect 2 'name one report' doctor --compare
expect 2 'no scene' doctor "$made"
expect 2 'add --report' doctor -o "$folder/x.json"
expect 1 'no/such/folder' doctor --report --backend kms -o "$folder/no/such/folder/x.json"

# a machine on which nothing draws has a report, too: that is what it is for
expect 0 '' doctor --report --backend kms -o "$folder/none.json"
grep -q '"can_draw": false' "$folder/none.json" && grep -q '^| none draws |' "$folder/out" || complain "$(cat "$folder/out")"

export GNOMON="$gnomon" SOFTWARE=1
REPORT=$made tests/gpu.sh > "$folder/out" 2>&1 || complain "gpu.sh: $(cat "$folder/out")"
! REPORT=$folder/worse.json tests/gpu.sh > "$folder/out" 2>&1 || complain 'gpu.sh: rows that fail are good enough'
exit $bad

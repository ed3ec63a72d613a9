#!/bin/sh
# Models of other formats: gnomon-import run by hand and by gnomon, its limits, its crashes; and every
# such file of GNOMON_SHARED (../shared) is either shown or refused with one line.
. tests/script.sh
import=$(dirname "$gnomon")/gnomon-import
shared=${GNOMON_SHARED:-../shared}
if [ ! -x "$import" ]; then
    echo "no $import: it needs libassimp-dev (make deps)"
    exit 77
fi

# expect STATUS TEXT COMMAND..: that status, and one line on stderr that has the text ('' = none)
expect() {
    status=$1 text=$2
    shift 2
    timeout 60 "$@" > "$folder/out" 2> "$folder/err" < /dev/null
    got=$?
    [ "$got" = "$status" ] || complain "$*: exit status $got, not $status: $(cat "$folder/err")"
    lines=$(wc -l < "$folder/err")
    [ "$lines" = "$([ -n "$text" ] && echo 1 || echo 0)" ] || complain "$*: $lines lines on stderr: $(cat "$folder/err")"
    [ -z "$text" ] || grep -qF -- "$text" "$folder/err" || complain "$*: $(cat "$folder/err")"
}

# ---- by hand ----

expect 0 '' "$import" --version
grep -q '^gnomon-import [0-9]' "$folder/out" || complain 'the version'
expect 0 '' "$import" --help
grep -q -- '--memory' "$folder/out" || complain 'the help'
for option in --version --help; do
    expect 1 'standard output: cannot write: No space left' sh -c '"$0" "$1" > /dev/full' "$import" $option
done
expect 2 'missing MODEL' "$import"
expect 2 'a.3ds: unknown file extension' "$import" a.3ds
expect 2 '--up: "x"' "$import" --up x a.obj
expect 2 '--time: "0"' "$import" --time 0 a.obj
expect 2 '--nonsense: unknown option' "$import" --nonsense a.obj
expect 2 '-x: unknown option' "$import" -xy a.obj
expect 2 '--up: unknown option or missing value' "$import" a.obj --up

mkdir "$folder/m"
model=$folder/m/a.obj
printf 'v 0 0 0\nv 1 0 0\nv 1 2 0\nf 1 2 3\n' > "$model"
expect 0 '' "$import" "$model"
expect 1 'a.glb exists; use -o' "$import" "$model"
expect 0 '' "$import" "$model" -o "$folder/b.glb"
cmp -s "$folder/m/a.glb" "$folder/b.glb" || complain 'the same model gives other bytes'
expect 1 'cannot write' "$import" "$model" -o "$folder/none/b.glb"
expect 0 '' "$gnomon" render "$model" --size 64x64 -o "$folder/obj.pfm"
expect 0 '' "$gnomon" render "$folder/b.glb" --size 64x64 -o "$folder/glb.pfm"
cmp -s "$folder/obj.pfm" "$folder/glb.pfm" || complain 'named as .obj and as .glb, two pictures'
expect 0 '' "$gnomon" inspect --json "$model"
[ "$(ls "$folder/m")" = "$(printf 'a.glb\na.obj')" ] || complain 'something is left beside the model'
expect 0 '' "$import" --up z "$model" -o "$folder/b.glb"
"$gnomon" inspect "$folder/b.glb" | grep -q 'size  *1 x 0 x 2 m' || complain '--up z'

# ---- limits: assimp triangulates a face in steps of the square of its corners, and compares the names of
# all objects of an OBJ with each other ----

awk 'BEGIN { n = 150000; print "v 0 0 0"; for (i = 0; i < n; i++) printf "v %d 1 0\n", i
             for (i = 2; i < n; i++) printf "f 1 %d %d\n", i, i + 1 }' > "$folder/m/fan.obj"
awk 'BEGIN { print "v 0 0 0\nv 1 0 0\nv 0 1 0"; for (i = 0; i < 60000; i++) print "o o" i "\nf 1 2 3" }' > "$folder/m/objects.obj"
awk 'BEGIN { n = 28000; for (i = 0; i < n; i++) print "v", cos(i * 6.283 / n) * (1 + i % 2), sin(i * 6.283 / n) * (1 + i % 2), 0
             printf "f"; for (i = 1; i <= n; i++) printf " %d", i }' > "$folder/m/polygon.obj"
expect 0 '' prlimit --cpu=8 "$import" --time 50 "$folder/m/objects.obj" -o "$folder/c.glb"
expect 1 'polygon.obj: not read within 1 s; raise the limit: gnomon --limit seconds=N, or gnomon-import --time N' "$import" --time 1 "$folder/m/polygon.obj" -o "$folder/f.glb"
expect 1 'polygon.obj: not read within 1 s; raise the limit: gnomon --limit seconds=N' "$gnomon" inspect --limit seconds=1 "$folder/m/polygon.obj"
expect 1 'fan.obj: needs more than 80 MB of memory' "$import" --memory 80 "$folder/m/fan.obj" -o "$folder/f.glb"
expect 1 'fan.obj: needs more than 80 MB of memory; raise the limit: gnomon --limit memory_mb=N, or gnomon-import --memory N' "$gnomon" inspect --limit memory_mb=80 "$folder/m/fan.obj"
expect 0 '' "$gnomon" inspect --limit file_mb=1048576 --limit memory_mb=1048576 "$model"
expect 1 'fan.obj: larger than the limit' "$import" --file 1 "$folder/m/fan.obj" -o "$folder/f.glb"
[ ! -e "$folder/f.glb" ] || complain 'a failure left a file'

# ---- rights: the process that reads the model has none (tests/unit/test_sandbox.c tries them) ----

filters=0
! ldd "$import" | grep -q libseccomp || filters=2
wanted="CapPrm: 0000000000000000 CapEff: 0000000000000000 NoNewPrivs: 1 Seccomp: $filters "
! awk "$(id -u) == 0"' && $1 <= 65534 && $1 + $3 > 65534 { found = 1 } END { exit !found }' /proc/self/uid_map || wanted="Uid: 65534 $wanted"
rights=''
"$import" "$folder/m/fan.obj" -o "$folder/f.glb" 2> "$folder/err" &
while [ "$rights" != "$wanted" ] && kill -0 $! 2> /dev/null; do
    for child in $(cat /proc/$!/task/$!/children 2> /dev/null); do
        rights=$(awk '/^(CapEff|CapPrm|NoNewPrivs|Seccomp):/ || (/^Uid:/ && $2 == 65534) { printf "%s %s ", $1, $2 }' "/proc/$child/status" 2> /dev/null)
    done
done
kill $! 2> /dev/null
wait $! 2> /dev/null
[ "$rights" = "$wanted" ] || complain "the rights of the process that reads the model: $rights"

# ---- a library taken over by the model tries to get out, with both layers and with each hidden from it ----

hostile=$(dirname "$gnomon")/tests/hostile_assimp.so
echo secret > "$folder/secret"
# tries HIDDEN PATTERN: what it reports
tries() {
    expect 1 'cannot be read as' env LD_PRELOAD="$hostile" GN_HIDE="$1" "$import" "$model" -o "$folder/f.glb"
    sed 's/.*read as [^(]*( *//; s/).*//; s/landlock *//' "$folder/err" > "$folder/tried"
    grep -qxE "$2" "$folder/tried" || complain "without '$1' the library can: $(cat "$folder/tried")"
}
if [ -e "$hostile" ]; then
    [ $filters = 0 ] || tries '' 'gets-model'
    [ $filters = 0 ] || tries landlock 'gets-model'
    LD_PRELOAD="$hostile" GN_HIDE=filter "$import" "$model" -o "$folder/f.glb" 2> "$folder/err"
    ! grep -q landlock "$folder/err" || tries filter 'gets-model connects signals forks makes-code traces'
    [ ! -e "$model.new" ] || complain 'the library made a file'
else
    complain "no $hostile (make tests): what the library can do was not tried"
fi

# ---- an importer that misbehaves, beside a copy of gnomon ----

mkdir "$folder/bin"
cp "$gnomon" "$folder/bin/gnomon"
fake() {
    printf '#!/bin/sh\n%s\n' "$1" > "$folder/bin/gnomon-import"
    chmod +x "$folder/bin/gnomon-import"
}
if [ ! -e /usr/local/bin/gnomon-import ]; then
    expect 1 'a.obj: needs gnomon-import, which is not' env PATH=/nowhere "$folder/bin/gnomon" inspect "$model"
fi
fake 'echo chatter; echo more >&2; kill -SEGV $$'
expect 1 'a.obj: gnomon-import crashes (Segmentation fault)' "$folder/bin/gnomon" inspect "$model"
fake 'for last; do :; done; echo "gnomon-import: $last: no" >&2; echo "gnomon-import: warning: not told" >&2; exit 1'
expect 1 'a.obj: no' "$folder/bin/gnomon" inspect "$model"
fake 'echo garbage, and more than a header of it'
expect 1 'a.obj: byte 0: neither .glb' "$folder/bin/gnomon" inspect "$model"
fake 'exit 0'
expect 1 'a.obj: gnomon-import wrote no output' "$folder/bin/gnomon" inspect "$model"
fake "echo 'gnomon-import: warning: of a kind' >&2; exec cat '$folder/m/a.glb'"
expect 0 'gnomon: warning: of a kind' "$folder/bin/gnomon" render "$model" --size 64x64 -o "$folder/a.png"

# interrupted while it waits, gnomon ends at once and takes the importer along
fake "echo \$\$ > '$folder/pid'; exec sleep 50"
"$folder/bin/gnomon" render "$model" -o "$folder/c.png" 2> "$folder/err" &
for _ in 1 2 3 4 5 6 7 8 9 10; do [ -s "$folder/pid" ] || sleep .2; done
kill -TERM $!
wait $!
[ $? = 143 ] && [ ! -s "$folder/err" ] || complain "SIGTERM during an import: $(cat "$folder/err")"
[ -s "$folder/pid" ] || complain 'no importer was started'
importer_runs() { # a zombie does not
    grep -qs '^State:.[^Z]' "/proc/$(cat "$folder/pid")/status"
}
for _ in 1 2 3 4 5 6 7 8 9 10; do ! importer_runs || sleep .1; done
! importer_runs || complain 'an importer that outlives gnomon'
[ ! -e "$folder/c.png" ] || complain 'a picture of nothing'

# ---- what others wrote ----

if [ ! -d "$shared/malformed" ]; then
    echo "no $shared/malformed, so its models were not tried: name the folder by GNOMON_SHARED"
    [ "$bad" = 0 ] && exit 77
    exit 1
fi
shown=0 refused=0
find "$shared/malformed" "$shared/assets" -type f | grep -iE '\.(obj|fbx|stl|ply|dae)$' | sort > "$folder/list"
while IFS= read -r file; do
    (ulimit -t 10 && exec timeout 60 "$gnomon" inspect --json "$file") > "$folder/out" 2> "$folder/err" < /dev/null
    case $? in
    0)
        shown=$((shown + 1))
        [ ! -s "$folder/err" ] || complain "$file: shown, and says $(cat "$folder/err")"
        ;;
    1)
        refused=$((refused + 1))
        [ "$(wc -l < "$folder/err")" = 1 ] && grep -qF "gnomon: $file: " "$folder/err" || complain "$file: refused by: $(cat "$folder/err")"
        ;;
    *) complain "$file: neither shown nor refused: $(cat "$folder/err")" ;;
    esac
done < "$folder/list"
echo "$shown shown, $refused refused"
[ "$shown" -ge 60 ] || complain 'too few to mean anything'
exit $bad

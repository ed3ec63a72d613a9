#!/bin/sh
# accept_bench.sh [ROUNDS]: the bench scenes against the floor, the shortest program that draws them
# (FLOOR=floor.c, ../shared/tools/floor/floor.c). The two take turns, ROUNDS times; compared is
# the least CPU time per frame of each, which is the figure that other work on the machine disturbs
# least. A line a limit. Time on a busy machine is no test: only with LIMITS=1 does a passed limit fail.
# Two rounds of a few frames, to see that all of it works; with GN_FULL=1 or LIMITS=1 four of 60, for the figures.
set -eu

gnomon=${GNOMON:-build/release/gnomon}
build=${BUILD:-build/release}
floor_c=${FLOOR:-../shared/tools/floor/floor.c}
long=${GN_FULL:-}${LIMITS:-}
rounds=${1:-$([ -n "$long" ] && echo 4 || echo 2)}
frames=${FRAMES:-$([ -n "$long" ] && echo 60 || echo 5)}
width=1280 height=720
work=$build/accept-bench

skip() { echo "$1" && exit 77; }
[ -e "$floor_c" ] || skip "no floor to compare with: $floor_c is not here (FLOOR=.. names it)"
[ -x "$gnomon" ] || { echo "$gnomon is not built; make builds it" && exit 1; }
rm -rf "$work"
mkdir -p "$work/warm" "$work/rounds"

# what the floor says about memory is made the figure that gnomon gives: private dirty pages
sed 's/Pss: %ld/Private_Dirty: %ld/; s/pss_mb/private_dirty_mb/' "$floor_c" > "$work/floor.c"
"${CC:-cc}" -O2 -w -o "$work/floor" "$work/floor.c" -ldl -lm ||
    skip "the floor does not compile here: $floor_c"

floor() { "$work/floor" -w $width -h $height -n "$frames" --only frame "$@"; }
bench() { "$gnomon" bench --size ${width}x$height --json "$@"; }
plain='--msaa 0 --tone none --environment none' # as the floor draws
look='--msaa auto --tone neutral --environment studio' # as a model without lights is shown by itself

# out of JSON with a field a line: the run of a technique, a field of it; or a field of the top
run_field() { # FILE TECHNIQUE FIELD
    awk -v t="\"$2\"," -v f="\"$3\":" '$1 == "\"technique\":" { on = $2 == t }
        on && $1 == f { sub(/,$/, "", $2); print $2; exit }' "$1"
}
top_field() { awk -v f="\"$2\":" '$1 == f { gsub(/[",]/, "", $2); print $2; exit }' "$1"; }
floor_row() { # FILE ROW: its cpu=
    awk -F '\t' -v row="$2" '$1 == "ROW" && $2 == row' "$1" | sed 's/.*cpu=\([0-9.]*\).*/\1/'
}
floor_word() { tr '\t' '\n' < "$1" | sed -n "s/^$2=//p"; }

least() { sort -n | head -n 1; }
least_run() { for f in "$work"/rounds/"$1".*; do run_field "$f" "$2" cpu_ms; done | least; }
least_row() { # SCENE ROW..
    scene=$1 && shift
    for f in "$work"/rounds/"$scene".*; do for r; do floor_row "$f" "$r"; done; done | least
}

export MESA_SHADER_CACHE_DIR="$work/warm"
for round in $(seq "$rounds"); do
    for s in 1 2; do
        grid=8 && [ $s = 1 ] || grid=64
        floor -g $grid > "$work/rounds/floor$s.$round"
        for output in linear srgb; do
            # shellcheck disable=SC2086
            bench assets/bench/s$s.glb --frames "$frames" --shadow none,hard,pcf3 $plain \
                --output $output > "$work/rounds/$output$s.$round"
        done
        # shellcheck disable=SC2086
        bench assets/bench/s$s.glb --frames "$frames" --shadow cone $look > "$work/rounds/look$s.$round"
    done
done

# starts: warm with the cache that the rounds have filled, cold with an empty one each time
for round in $(seq "$rounds"); do
    "$work/floor" -n 1 --only frame/none/multi > "$work/rounds/context.$round"
    bench assets/bench/s1.glb --frames 1 > "$work/rounds/warm.$round"
    mkdir "$work/cold$round"
    MESA_SHADER_CACHE_DIR="$work/cold$round" bench assets/bench/s1.glb --frames 1 \
        > "$work/rounds/cold.$round"
done

failed=0
judge() { # WHAT OURS THEIRS UNIT LIMIT quotient|difference; LIMIT - : only said
    awk -v what="$1" -v a="$2" -v b="$3" -v unit="$4" -v limit="$5" -v kind="$6" 'BEGIN {
        value = kind == "quotient" ? a / b : a - b
        over = limit != "-" && value > limit
        sign = kind == "quotient" ? "x" : unit
        verdict = limit == "-" ? "" : sprintf("  at most %g: %s", limit, over ? "OVER" : "ok")
        printf "%-34s %8.2f %s, floor %8.2f %s: %6.3f %s%s\n", what, a, unit, b, unit, value, sign, verdict
        exit over }' || failed=1
}

echo "$(top_field "$work/rounds/linear1.1" gl_renderer), ${width}x$height, the least of $rounds rounds"
for s in 1 2; do
    for t in none hard pcf3; do
        row=frame/$t limit=1.15
        [ $t != pcf3 ] || { row=frame/pcf3x3hw && limit=.8; }
        [ $s$t != 2pcf3 ] || limit=- # the limit of S2 is that of the same shader
        rows=$row/inst
        [ $s = 2 ] || rows="$row/inst $row/multi"
        # shellcheck disable=SC2086
        base=$(least_row floor$s $rows)
        judge "S$s $t" "$(least_run linear$s $t)" "$base" ms $limit quotient
        judge "S$s $t, sRGB" "$(least_run srgb$s $t)" "$base" ms - quotient
    done
    judge "S$s in the studio, cone" "$(least_run look$s cone)" "$(least_row floor$s frame/none/inst)" ms - quotient
done
dirty=$(for f in "$work"/rounds/linear1.*; do top_field "$f" private_dirty_mb; done | least)
floor_dirty=$(for f in "$work"/rounds/floor1.*; do floor_word "$f" private_dirty_mb; done | least)
judge 'memory, private dirty, S1' "$dirty" "$floor_dirty" MB 8 difference

context=$(for f in "$work"/rounds/context.*; do floor_word "$f" main_to_ctx; done | least)
for kind in warm cold; do
    limit=60 && [ $kind = warm ] || limit=-
    first=$(for f in "$work/rounds/$kind".*; do
        [ "$(top_field "$f" cache)" != $kind ] || top_field "$f" start_to_first_picture_ms
    done | least)
    [ -n "$first" ] || { echo "no start was $kind" && failed=1 && continue; }
    judge "first picture over a context, $kind" "$first" "$context" ms $limit difference
done
[ -n "${LIMITS:-}" ] || failed=0
exit $failed

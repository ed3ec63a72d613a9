#!/bin/bash
# run.sh [NAME=VALUE | PROGRAM]..: runs programs and scripts one after another and counts. NAME=VALUE
# goes into the environment of those that follow (BUILD=build/asan). Each has its own time limit
# (tests/timeouts, else LIMIT seconds). Exit status 77 is a skip, whose last line says why; the tests
# inside a cmocka program count one by one. STRICT=1 makes a skip a failure. A script that ends well
# with a line "not applicable: why" has nothing to do on this kind of machine and is not counted.
set -u
passed=0 failed=0 skipped=0 failures=''
unset DISPLAY WAYLAND_DISPLAY # no test opens windows before the eyes of whoever runs it

export UBSAN_OPTIONS=${UBSAN_OPTIONS-print_stacktrace=1}
export LSAN_OPTIONS=${LSAN_OPTIONS-suppressions=tests/lsan.supp:print_suppressions=0}
# intercept_tls_get_addr: up to gcc 13 the leak checker takes some thread-local blocks for those of an
# older libc and crashes, once in thousands of runs
export ASAN_OPTIONS=${ASAN_OPTIONS-allocator_may_return_null=1:detect_stack_use_after_return=1:intercept_tls_get_addr=0}
default_limit=${LIMIT:-$([ -n "${GN_FULL:-}" ] && echo 1800 || echo 120)}

limit_of() {
    [ -n "${GN_FULL:-}" ] || awk -v name="$1" '$1 == name { print $2; exit }' tests/timeouts
}

# the number in cmocka's closing line of that word
count_of() {
    sed -n "s/^\[ *$2 *\] \([0-9]*\) test(s).*/\1/p" "$1" | tail -n 1
}

skip() {
    skipped=$((skipped + $2))
    [ -z "${STRICT:-}" ] || failed=$((failed + $2))
    echo "SKIP  $1: $3"
    [ -z "${STRICT:-}" ] || failures="$failures"$'\n'"  $1 (skipped, and nothing may be)"
}

judge() {
    local name=$1 log=$2 status=$3 took=$4 good bad left
    good=$(count_of "$log" PASSED) bad=$(count_of "$log" FAILED) left=$(count_of "$log" SKIPPED)
    if [ "$status" = 77 ]; then
        skip "$name" 1 "$(tail -n 1 "$log")"
        return
    fi
    if [ "$status" = 0 ] && grep -q '^not applicable: ' "$log"; then
        echo "n/a   $name: $(tail -n 1 "$log")"
        return
    fi
    [ -z "$good$bad" ] && [ "$status" = 0 ] && good=1
    [ "$status" != 0 ] && [ "${bad:-0}" = 0 ] && bad=1
    passed=$((passed + ${good:-0})) failed=$((failed + ${bad:-0}))
    [ "${left:-0}" = 0 ] || skip "$name" "$left" "$(grep -m 1 -A 1 'SKIPPED' "$log" | tr '\n' ' ')"
    if [ "${bad:-0}" = 0 ]; then
        echo "ok    $name (${took} s)"
        return
    fi
    failures="$failures"$'\n'"  $name (status $status)"
    echo "FAIL  $name (status $status, ${took} s); the end of $log:"
    tail -n 40 "$log" | sed 's/^/    /'
}

run() {
    local name=$1 base limit log status start=$SECONDS
    base=$(basename "$name") log=${BUILD:-build}/log/$(basename "$name").log
    limit=$(limit_of "$base")
    mkdir -p "$(dirname "$log")"
    GNOMON=${BUILD:-build/release}/gnomon timeout --kill-after=5 "${limit:-$default_limit}" \
        "./$name" > "$log" 2>&1 < /dev/null
    status=$?
    [ "$status" != 124 ] || echo "not done after ${limit:-$default_limit} seconds" >> "$log"
    judge "$name" "$log" "$status" $((SECONDS - start))
}

for argument in "$@"; do
    case $argument in
    [A-Z]*=*) export "${argument?}" ;;
    *) run "$argument" ;;
    esac
done

[ -z "$failures" ] || echo "failed:$failures"
[ $((passed + failed)) -gt 0 ] || { echo 'no test ran' && failed=1; }
echo "$passed passed, $failed failed, $skipped skipped"
[ "$failed" = 0 ]

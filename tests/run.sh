#!/bin/bash
# run.sh [NAME=VALUE | PROGRAM]..: runs programs and scripts, JOBS (one more than processors, since
# tests also wait) at a time, and counts. NAME=VALUE goes into the environment of those that follow (BUILD=build/asan),
# NAME= takes it out again; tests/goal.sh prints the arguments for a goal of make.
# tests/table has the processor seconds that each may take; the longest begin first, and those with ALONE=1
# run alone, after the others. Virtual machines (.guest), which also wait, begin
# before the others, one for every processor. A line is printed when a test has ended, and with it the end
# of its log if it failed. Exit status 77 is a skip, whose last line has the reason; the tests inside a
# cmocka program count one by one. STRICT=1 makes a skip a failure. A script that succeeds with a
# line "not applicable: why" has nothing to test on this kind of machine and is not counted.
#   JOBS      tests at a time
#   LIMIT     processor seconds that each test may take, whatever tests/table has
#   GN_FULL=1 the long forms, of 1800 processor seconds at most
#   DRY=1     prints what would run, in this order, and its limit
set -u
unset DISPLAY WAYLAND_DISPLAY # no test opens windows before the eyes of whoever runs it
unset MESA_SHADER_CACHE_DISABLE
ulimit -c 0

export UBSAN_OPTIONS=${UBSAN_OPTIONS-print_stacktrace=1}
export LSAN_OPTIONS=${LSAN_OPTIONS-suppressions=tests/lsan.supp:print_suppressions=0}
# intercept_tls_get_addr: up to gcc 13 the leak checker takes some thread-local blocks for those of an
# older libc and crashes, once in thousands of runs
export ASAN_OPTIONS=${ASAN_OPTIONS-allocator_may_return_null=1:detect_stack_use_after_return=1:intercept_tls_get_addr=0}
jobs=${JOBS:-$(($(nproc) + 1))}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# each job waits for a timeout, which ends its test when it is ended itself
end_jobs() {
    local job
    for job in $(jobs -p); do
        read -ra children 2> /dev/null < "/proc/$job/task/$job/children"
        kill "$job" "${children[@]}" 2> /dev/null
    done
    exit 130
}
trap end_jobs INT TERM

# ---- the plan: what runs, in which order -------------------------------------------------------
settings=() # NAME=VALUE, in their order
programs=() # "COUNT PROGRAM FULL ALONE": the first COUNT settings hold for it
full=${GN_FULL:-0} alone=0

for argument in "$@"; do
    case $argument in
    GN_FULL=*) full=${argument#*=} && settings+=("$argument") ;;
    ALONE=*) alone=${argument#*=} ;;
    [A-Z]*=*) settings+=("$argument") ;;
    *) programs+=("${#settings[@]} $argument ${full:-0} ${alone:-0}") ;;
    esac
done

# lines "WHEN LIMIT COUNT PROGRAM", in the order in which they may begin; WHEN is machine, beside or alone
plan() {
    printf '%s\n' "${programs[@]}" |
        awk -v own_limit="${LIMIT:-}" '
            FILENAME != "-" { sub(/.*\//, "", $1); limit[$1] = $5; next }
            {
                name = $2
                sub(/.*\//, "", name)
                known = limit[name] + 0
                most = $3 ? 1800 : own_limit ? own_limit : known ? known : 60
                machine = name ~ /[.]guest$/
                if (machine) most = 3600 # it has a limit of its own
                print $4 ? "alone" : machine ? "machine" : "beside", most, $1, $2, known
            }' tests/table - |
        sort -s -k 1,1r -k 5,5nr
}

# ---- one test ----------------------------------------------------------------------------------
# the number in cmocka's closing line of that word
count_of() {
    sed -n "s/^\[ *$2 *\] \([0-9]*\) test(s).*/\1/p" "$1" | tail -n 1
}

skip() {
    skipped=$((skipped + $2))
    echo "SKIP  $1: $3"
    [ -z "${STRICT:-}" ] || failed=$((failed + $2)) failures="$1 (skipped, and nothing may be)"
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
    passed=${good:-0} failed=${bad:-0}
    [ "${left:-0}" = 0 ] || skip "$name" "$left" "$(grep -m 1 -A 1 'SKIPPED' "$log" | tr '\n' ' ')"
    if [ "${bad:-0}" = 0 ]; then
        echo "ok    $name ($took)"
        return
    fi
    failures="$name (status $status) $(grep -m 3 FAIL "$log" | cut -c 1-300 | tr '\n' ';')"
    echo "FAIL  $name (status $status, $took); the end of $log:"
    tail -n 40 "$log" | sed 's/^/    /'
}

# run LIMIT COUNT PROGRAM RESULT: what it prints goes to the log, what is to be said of it to
# RESULT.out, and "PASSED FAILED SKIPPED FAILURE" to RESULT. The limit in processor time is each
# process's own; that in wall time is for what hangs, so that a busy machine does not reach it.
run() {
    local limit=$1 program=$3 result=$4 setting name log status cpu wall start=$SECONDS
    local passed=0 failed=0 skipped=0 failures=''
    for setting in "${settings[@]:0:$2}"; do
        if [ -n "${setting#*=}" ]; then export "${setting?}"; else unset "${setting%%=*}"; fi
    done
    BUILD=${BUILD:-build/release} name=$program
    case $program in *.sh | *.guest) [ "$2" -lt 2 ] || name="$program in $BUILD" ;; esac
    log=$BUILD/log/$(basename "$program").log
    mkdir -p "$BUILD/log" "$result.run"
    chmod 700 "$result.run"
    # shaders stay compiled from test to test; a test of starting up has a cache of its own
    : "${MESA_SHADER_CACHE_DIR=$(realpath -m "$(dirname "$BUILD")/shader-cache")}"
    export BUILD GNOMON="$BUILD/gnomon" MESA_SHADER_CACHE_DIR XDG_RUNTIME_DIR="$result.run"
    mkdir -p "$MESA_SHADER_CACHE_DIR" 2> /dev/null
    case $program in
    *.guest | */gpus.sh) wall=3600 ;; # guests have limits of their own; full GPUs take half an hour
    *) wall=$((limit > 180 ? 1800 : limit > 60 ? 10 * limit : 600)) ;;
    esac
    TIMEFORMAT='%U %S'
    ulimit -S -t "$limit"
    { time timeout --kill-after=5 "$wall" "./$program" > "$log" 2>&1 < /dev/null; } 2> "$result.time"
    status=$?
    [ "$status" != 124 ] || echo "not done after $wall seconds" >> "$log"
    [ "$status" != 152 ] || echo "took more than $limit processor seconds" >> "$log"
    cpu=$(awk '{ printf "%.1f", $1 + $2 }' "$result.time")
    judge "$name" "$log" "$status" "$((SECONDS - start)) s, $cpu s of CPU" > "$result.out"
    echo "$passed $failed $skipped $failures" > "$result"
}

# ---- all of them -------------------------------------------------------------------------------
passed=0 failed=0 skipped=0 failures='' number=0 machines=0
declare -A result_of=() machine=()

# finish: waits for one that runs, and prints and counts it
finish() {
    local pid good bad left why
    wait -n -p pid
    cat "${result_of[$pid]}.out" && read -r good bad left why < "${result_of[$pid]}" ||
        { good=0 bad=1 left=0 why="${result_of[$pid]##*/}: run.sh was interrupted"; }
    machines=$((machines - ${machine[$pid]:-0}))
    unset "result_of[$pid]" "machine[$pid]"
    passed=$((passed + good)) failed=$((failed + bad)) skipped=$((skipped + left))
    [ -z "$why" ] || failures="$failures"$'\n'"  $why"
}

# start WHEN LIMIT COUNT PROGRAM
start() {
    number=$((number + 1))
    run "$2" "$3" "$4" "$work/$number" &
    result_of[$!]=$work/$number
    [ "$1" != machine ] || { machine[$!]=1 && machines=$((machines + 1)); }
}

if [ -n "${DRY:-}" ]; then
    plan | while read -r when limit count program _; do
        echo "$when $limit s" "$(printf '%s\n' "${settings[@]:0:$count}" | tac | sort -u -t = -k 1,1 | grep -v '=$' | tr '\n' ' ')$program"
    done
    exit
fi
mapfile -t waiting < <([ ${#programs[@]} = 0 ] || plan | grep '^machine ')
mapfile -t others < <([ ${#programs[@]} = 0 ] || plan | grep -v '^machine ')
while :; do
    when=${others[0]:-none} when=${when%% *} running=${#result_of[@]}
    if [ "${#waiting[@]}" -gt 0 ] && [ "$running" -lt "$jobs" ] && [ "$machines" -lt "$(nproc)" ]; then
        # shellcheck disable=SC2086
        start ${waiting[0]}
        waiting=("${waiting[@]:1}")
    elif [ "$when" = alone ] && [ "$running" = 0 ] || [ "$when" = beside ] && [ "$running" -lt "$jobs" ]; then
        # shellcheck disable=SC2086
        start ${others[0]}
        others=("${others[@]:1}")
    elif [ "$running" -gt 0 ]; then
        finish
    else
        break
    fi
done

[ -z "$failures" ] || echo "failed:$failures"
[ $((passed + failed)) -gt 0 ] || { echo 'no test ran' && failed=1; }
echo "$passed passed, $failed failed, $skipped skipped"
[ "$failed" = 0 ]

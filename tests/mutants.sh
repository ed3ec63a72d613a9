#!/bin/bash
# shellcheck disable=SC2012,SC2046,SC2086,SC2207 # names of tests and mutants have no spaces
# mutants.sh [--list] [NAME..]: applies each mutant of tests/mutants.txt (or those named) to a copy of the
# tree, builds its killers, the tests that must fail then, and runs them: the proof that a change of the
# tests loses no finding. Run by hand: ten minutes on two cores. The copy and its build folder stay in
# build/mutants (TREE=DIR: elsewhere), so that the next run builds only what differs.
#   --list              prints the table, and what no longer applies; builds nothing
#   --find NAME [TEST]..  runs these tests against one mutant instead of its killers; by default the tests
#                       of unit, plan and kms that include a header of its room
# First all killers run without a mutant: one that fails there proves nothing. Prints a row for each mutant,
# with the tests inside a program that failed. Exit status 1: a mutant survived its killers or was killed
# although it is marked as surviving, did not compile, or its row is out of date.
set -u
cd "$(dirname "$0")/.." || exit
tree=${TREE:-build/mutants}
build=build/release
bad=0

complain() {
    echo "mutants.sh: $*" >&2
    bad=1
}

# ---- the table -----------------------------------------------------------------------------------
names=() name=''
declare -A file=() old=() new=() killers=() survives=()

# add_line ARRAY TEXT: the lines of a text that has several
add_line() {
    local -n lines=$1
    lines["$name"]=${lines[$name]+${lines[$name]}$'\n'}$2
}

while IFS= read -r line; do
    case $line in
    '' | '#'*) ;;
    'mutant '*) name=${line#mutant } && names+=("$name") ;;
    'file '*) file[$name]=${line#file } ;;
    -*) add_line old "${line#-}" ;;
    +*) add_line new "${line#+}" ;;
    'killers '*) killers[$name]=${line#killers } ;;
    'survives '*) killers[$name]=${line#survives } survives[$name]=1 ;;
    *) complain "tests/mutants.txt: what is \"$line\"?" ;;
    esac
done < tests/mutants.txt

# path_of TEST: a program's source, or a script
path_of() { ls tests/*/"$1".c "tests/$1" tests/*/"$1" 2> /dev/null | head -n 1; }

# goals_of TEST..: the first goals of make that run one of them
declare -A goals=()
for goal in check accept full; do goals[$goal]=" $(tests/goal.sh $goal | tr '\n' ' ') "; done
goals_of() {
    local test goal
    for test in "$@"; do
        for goal in check accept full; do
            [[ ${goals[$goal]} != *"/$test "* ]] || { echo $goal && break; }
        done
    done | sort -u | paste -sd ' '
}

# apply NAME FILE: writes the mutated file; false: the text does not occur exactly once
apply() {
    local text before after from=${file[$1]}
    [ -f "$from" ] && text=$(cat "$from" && echo x) || return 1
    text=${text%x} before=${text%%"${old[$1]}"*} after=${text#*"${old[$1]}"}
    [ "$after" != "$text" ] && [[ $after != *"${old[$1]}"* ]] || return 1
    printf '%s%s%s' "$before" "${new[$1]-}" "$after" > "$2"
}

# print_row NAME RESULT GOAL
print_row() { printf '%-36s %-30s %s%s\n' "$1" "${file[$1]}" "$2" "${3:+ ($3)}"; }

# ---- the copy of the tree ------------------------------------------------------------------------
# Files keep their times, so that make builds only what changed. A mutated file gets a new time twice: when
# it is mutated, and when it is restored, which it keeps (cp -u).
restore() {
    [ -s "$tree/build/mutated" ] || return 0
    local path
    path=$(cat "$tree/build/mutated")
    cp "$path" "$tree/$path" && rm "$tree/build/mutated"
}

copy_tree() {
    [ ! -f "$tree/build/files" ] || mv "$tree/build/files" "$tree/build/files.before"
    git ls-files -co --exclude-standard | while read -r path; do [ ! -f "$path" ] || echo "$path"; done |
        sort > "$tree/build/files"
    [ ! -f "$tree/build/files.before" ] ||
        comm -13 "$tree/build/files" "$tree/build/files.before" | (cd "$tree" && xargs -r -d '\n' rm -f)
    xargs -d '\n' cp -pu --parents -t "$tree" < "$tree/build/files"
    restore
}

# make_tests TEST..: builds these tests; the program, too, where one of them runs it
make_tests() {
    local test path targets=()
    for test in "$@"; do
        path=$(path_of "$test")
        case $path in
        *.sh) targets+=(all $(grep -oE 'tool_[a-z_]+' "$path" | sort -u | sed "s,^,$build/tests/,")) ;;
        *) targets+=("$build/tests/$test") ;;
        esac
        case $path in
        tests/unit/* | tests/plan/* | tests/kms/*) ! grep -qE 'GNOMON|import_help' "$path" || targets+=(all) ;;
        *) targets+=(all build/host/make_truth) ;;
        esac
    done
    make -C "$tree" --no-print-directory -j"$(nproc)" READY=1 CONFIG=release \
        $(printf '%s\n' "${targets[@]}" | sort -u) > "$tree/build/make.log" 2>&1
}

# failures_in LOG: of a program of cmocka, the first of its tests that failed
failures_in() {
    sed -n 's/^\[  FAILED  \] \([a-z0-9_ ]*\)$/\1/p' "$1" | awk '
        !seen[$0]++ && ++count <= 2 { printf "%s%s", count == 1 ? ": " : ", ", $0 }
        END { if (count > 2) printf " and %d more", count - 2 }'
}

# run_tests TEST..: sets failed to those that failed, with the tests inside them, and passed
run_tests() {
    local test path programs=()
    for test in "$@"; do
        path=$(path_of "$test")
        case $path in *.c) path=$build/tests/$test ;; esac
        programs+=("$path")
    done
    (cd "$tree" && tests/run.sh "BUILD=$build" "${programs[@]}") > "$tree/build/run.log" 2>&1
    failed=() passed=()
    for test in "$@"; do
        if grep -qE "^FAIL  [^ ]*\b$test( |\$)" "$tree/build/run.log"; then
            failed+=("$test$(failures_in "$tree/$build/log/$test.log")")
        elif grep -qE "^ok    [^ ]*\b$test( |\$)" "$tree/build/run.log"; then
            passed+=("$test")
        fi
    done
}

# ---- one mutant ----------------------------------------------------------------------------------
# join WORD..
join() { printf '%s' "$1" && [ $# = 1 ] || printf '; %s' "${@:2}"; }

try_mutant() {
    local test tests=()
    for test in ${killers[$1]-}; do
        [[ " $broken " == *" $test "* ]] || tests+=("$test")
    done
    if [ ${#tests[@]} = 0 ]; then
        print_row "$1" 'NO KILLER'
        bad=1 && return
    fi
    if ! apply "$1" /dev/null; then
        print_row "$1" 'DOES NOT APPLY: its text does not occur exactly once'
        bad=1 && return
    fi
    echo "${file[$1]}" > "$tree/build/mutated"
    apply "$1" "$tree/${file[$1]}"
    if ! make_tests "${tests[@]}"; then
        print_row "$1" "DOES NOT COMPILE: $(grep -m 1 'error:' "$tree/build/make.log")" && bad=1
    else
        run_tests "${tests[@]}"
        if [ ${#failed[@]} = 0 ]; then
            print_row "$1" "SURVIVED ${tests[*]}${survives[$1]+, as marked}"
            [ -n "${survives[$1]-}" ] || bad=1
        else
            print_row "$1" "killed by $(join "${failed[@]}")${passed[0]+, not by ${passed[*]}}" "$(goals_of "${failed[@]%%:*}")"
            [ -z "${survives[$1]-}" ] || complain "$1: is marked as surviving"
        fi
    fi
    restore
}

# ---- all of them ---------------------------------------------------------------------------------
find='' list=''
case ${1-} in
--list) list=1 && shift ;;
--find)
    find=${2-} && shift
    [ -n "${file[$find]-}" ] || { complain "--find: no mutant \"$find\""; exit 2; }
    room=$(dirname "${file[$find]#src/}")
    shift
    [ $# -gt 0 ] || set -- $(grep -l "\"${room%%/*}/" tests/unit/test_*.c tests/plan/test_*.c tests/kms/test_*.c | sed 's,.*/,,; s,\.c$,,')
    killers[$find]=$* && unset "survives[$find]"
    set -- "$find"
    ;;
esac
[ $# -gt 0 ] || set -- "${names[@]}"
for name in "$@"; do
    [ -n "${file[$name]-}" ] || complain "no mutant \"$name\""
    for test in ${killers[$name]-}; do
        [ -n "$(path_of "$test")" ] || complain "$name: no test \"$test\""
    done
    [ -n "$list" ] || continue
    apply "$name" /dev/null || complain "$name: its text does not occur exactly once in ${file[$name]-}"
    print_row "$name" "${survives[$name]+SURVIVES }${killers[$name]-}" \
        "$(goals_of ${killers[$name]-})"
done
[ -z "$list" ] && [ $bad = 0 ] || exit $bad

mkdir -p "$tree/build"
exec 9> "$tree/build/lock"
flock -n 9 || { complain "another run uses $tree"; exit 2; }
trap restore EXIT
copy_tree
all=$(for name in "$@"; do printf '%s\n' ${killers[$name]-}; done | sort -u)
make_tests $all || { tail "$tree/build/make.log" && complain 'the tree itself does not build'; exit 1; }
run_tests $all
broken=${failed[*]%%:*}
for test in "${failed[@]}"; do complain "fails without a mutant: $test"; done
for name in "$@"; do try_mutant "$name"; done
exit $bad

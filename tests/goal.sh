#!/bin/bash
# goal.sh GOAL [NAME]: prints what tests/run.sh is to run for a goal of make (check, accept or full), as its arguments: for
# each configuration its settings, and then the programs, scripts and guests that tests/table gives it. With NAME
# only the tests of that folder, that configuration or that name, as check has them where the goal has none.
#   O       the build folder (build)
#   SUITE   the Debian that the configuration `service` runs on
set -euf
export LC_ALL=C
goal=$1 name=${2:-} o=${O:-build}
case $goal in
check) column=2 ;;
accept) column=3 ;;
full) column=4 ;;
*) echo "goal.sh: there is no goal $goal" >&2 && exit 2 ;;
esac

settings() { # CONFIGURATION
    local build=$1 arch='' suite=${SUITE:-} host=$o/release
    case $1 in
    release | asan) host='' ;;
    service) build=release host='' ;;
    gpus) build=aarch64-linux-gnu-debug ;;
    arm64) build=aarch64-linux-gnu-release arch=arm64 ;;
    gpiod2) build=$(gcc -dumpmachine)-release suite=trixie ;;
    *) echo "tests/table: there is no configuration $1" >&2 && return 2 ;;
    esac
    echo "CONFIGURATION=$1 BUILD=$o/$build ARCH=$arch SUITE=$suite HOST_BUILD=$host"
}

# A test's row is the first that names it. Lines "RUN TEST", where RUN is a configuration and its forms.
runs() {
    local row test own path run runs
    declare -A seen=()
    while read -ra row; do
        case ${row[0]:-#} in '#'*) continue ;; esac
        set +f
        for path in tests/${row[0]} tests/${row[0]}.c; do
            [ -e "$path" ] || continue
            test=${path#tests/} test=${test%.c} own=${test##*/} own=${own%.*}
            runs=${row[column - 1]}
            [ "$runs${name:+.}" != -. ] || runs=${row[1]}
            [ -z "${seen[$test]:-}" ] || runs=-
            seen[$test]=1
            for run in ${runs//\// }; do
                case " ${test%/*} ${run%%+*} $own " in *" ${name:-${run%%+*}} "*) ;; *) run=- ;; esac
                [ "$run" = - ] || echo "$run $test"
            done
        done
        set -f
        # shellcheck disable=SC2053
        for test in "${!seen[@]}"; do [[ $test != ${row[0]} ]] || continue 2; done
        echo "tests/table: there is no test ${row[0]}" >&2 && return 2
    done < tests/table
}

lines=$(runs)
for run in $(cut -d ' ' -f 1 <<< "$lines" | sort -u); do
    configuration=${run%%+*}
    settings "$configuration"
    echo GN_FULL= ALONE= GN_MUTANTS= GPUS=
    form=${run#"$configuration"} form=${form//+/ } form=" $form"
    form=${form//' long'/' GN_FULL=1'} form=${form//' alone'/' ALONE=1'}
    echo "$form"
    build=$(settings "$configuration") build=${build#*BUILD=} build=${build%% *}
    for test in $(awk -v run="$run" '$1 == run { print $2 }' <<< "$lines"); do
        case $test in *.sh | *.guest) echo "tests/$test" ;; *) echo "$build/tests/${test##*/}" ;; esac
    done
done | xargs -n 1000

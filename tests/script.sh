# Sourced by scripts of tests, in the top folder: GNOMON is the program to try, $folder is theirs and goes when they end,
# no configuration of the user's is read. A script ends with `exit $bad`.
# shellcheck shell=sh disable=SC2034
set -u
gnomon=$(realpath "${GNOMON:-build/release/gnomon}")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export XDG_CONFIG_HOME="$folder/none"
bad=0

# the commands of the program, as its help lists them
commands_of() { "$gnomon" help | sed -n 's/^  gnomon \([a-z]*\) .*/\1/p' | grep -vx help; }

complain() {
    echo "FAIL: $*"
    bad=1
}

# expect STATUS TEXT ARGUMENT..: that status, and one line on stderr that has the text ('' = none)
expect() {
    status=$1 text=$2
    shift 2
    timeout 60 "$gnomon" "$@" > "$folder/out" 2> "$folder/err" < /dev/null
    got=$?
    [ "$got" = "$status" ] || complain "gnomon $*: exit status $got, not $status: $(cat "$folder/err")"
    lines=$(wc -l < "$folder/err")
    [ "$lines" = "$([ -n "$text" ] && echo 1 || echo 0)" ] || complain "gnomon $*: $lines lines on stderr"
    [ -z "$text" ] || grep -qF -- "$text" "$folder/err" || complain "gnomon $*: $(cat "$folder/err")"
}

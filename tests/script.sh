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

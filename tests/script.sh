# Sourced by scripts of tests, in the top folder: GNOMON is the program to try, $folder is theirs and goes when they end,
# no configuration of the user's is read. A script ends with `exit $bad`.
# shellcheck shell=sh disable=SC2034
set -u
gnomon=$(realpath "${GNOMON:-build/release/gnomon}")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export XDG_CONFIG_HOME="$folder/none"
bad=0

complain() {
    echo "FAIL: $*"
    bad=1
}

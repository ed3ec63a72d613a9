#!/bin/sh
# readme.sh TOOL: puts the table that TOOL measures into the techniques page. `make readme`.
set -eu
page=src/shadow/README.md
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$1" tests/gpus/budget > "$work/table"
awk -v table="$work/table" '
    /^<!-- end of the table -->/ { inside = 0 }
    !inside { print }
    /^<!-- the table: / { inside = 1; print ""; while ((getline line < table) > 0) print line; print "" }' "$page" > "$work/page"
cat "$work/page" > "$page"

#!/bin/sh
# readme.sh TOOL: puts the table that TOOL prints between the README's two marks.
set -eu
table=$(mktemp)
trap 'rm -f "$table"' EXIT
"$1" tests/gpus/budget > "$table"
awk -v table="$table" '
    /^<!-- end of the table -->/ { inside = 0 }
    !inside { print }
    /^<!-- the table: / { inside = 1; print ""; while ((getline line < table) > 0) print line; print "" }' README.md > README.md.new
mv README.md.new README.md

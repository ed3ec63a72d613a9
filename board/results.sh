#!/bin/sh
# results.sh GNOMON [README]: the table of board/results/*.json, as `gnomon doctor --compare` prints it, between its two marks in
# board/README.md: with README the whole page on stdout, else the table alone. `make board-table`; tests/check_docs.sh compares.
set -eu
gnomon=$1 page=${2-}
table=$(mktemp) rows=$(mktemp)
trap 'rm -f "$table" "$rows"' EXIT
# the first two are alike in each: the head; of two reports differences would follow
for report in board/results/*.json; do
    "$gnomon" doctor --compare "$report" >> "$rows"
done
awk 'NR <= 2 || !/^[|] GPU [|]|^[|]---/' "$rows" > "$table"
[ -n "$page" ] || { cat "$table"; exit; }
awk -v table="$table" '
    /^<!-- end of the results -->/ { inside = 0 }
    !inside { print }
    /^<!-- the results: / { inside = 1; print ""; while ((getline line < table) > 0) print line; print "" }' "$page"

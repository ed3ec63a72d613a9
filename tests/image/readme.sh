#!/bin/sh
# readme.sh TOOL: puts the table that TOOL measures into the techniques page, and its most telling
# rows into README.md.
# readme.sh --check: whether README.md has the rows of the techniques page.
set -eu
page=src/shadow/README.md
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# put FILE TABLE: TABLE between the two marks of FILE, on stdout
put() {
    awk -v table="$2" '
        /^<!-- end of the table -->/ { inside = 0 }
        !inside { print }
        /^<!-- the table: / { inside = 1; print ""; while ((getline line < table) > 0) print line; print "" }' "$1"
}

# ten rows of the page's table: under a sun, each technique with the encoding that it takes itself
short() {
    echo '| technique | map | darkening | leak | wrong | penumbra | time | Pi 4 | MB |'
    echo '|---|---|---|---|---|---|---|---|---|'
    awk -F ' *[|] *' '
        BEGIN { n = split("hard:r16f pcf:depth pcf3:depth pcss:r16f cone:rg16f vsm:rg32ui evsm:rgba32f-share msm:rgba16ui smsm:rgba32ui planar:stencil", row, " ")
                for (i = 1; i <= n; i++) wanted[row[i]] = 1 }
        { name = $2; gsub(/`/, "", name) }
        $3 == "sun" && (name ":" $4) in wanted {
            print "| " $2 " | " $4 " | " $6 " | " $8 " | " $10 " | " $11 " | " $14 " | " $15 " | " $18 " |" }' "$page"
}

if [ "$1" != --check ]; then
    "$1" tests/gpus/budget > "$work/table"
    put "$page" "$work/table" > "$page.new"
    mv "$page.new" "$page"
fi
short > "$work/short"
put README.md "$work/short" > "$work/README.md"
if [ "$1" = --check ]; then
    cmp "$work/README.md" README.md || { echo 'FAIL: the rows of README.md are not those of the techniques page; make readme writes them' && exit 1; }
else
    mv "$work/README.md" README.md
fi

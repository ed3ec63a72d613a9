#!/bin/sh
# gnomon lesson: each fault measures more than every cure, and the page has all its pictures.
. tests/script.sh

"$gnomon" lesson list > "$folder/list" || complain 'the list'
[ "$(wc -l < "$folder/list")" -ge 14 ] || complain "the list: $(cat "$folder/list")"

# columns of 20 from the 38th on: a figure, and "fault" where the step shows a fault by it
"$gnomon" lesson all --backend egl --size 320x240 > "$folder/out" 2> "$folder/err" || complain "$(cat "$folder/err")"
awk '
function compare(  i, k) {
    for (i in fault) for (k in cure)
        if (cure[k] + 0 >= fault[i] + 0 && substr(i, index(i, " ") + 1) == substr(k, index(k, " ") + 1))
            print name ": step " i " has " fault[i] ", its cure " cure[k]
    if (name != "" && length(fault) * length(cure) == 0) print name ": no fault, or no cure"
    delete fault
    delete cure
}
/^[a-z-]+: /{ compare(); name = substr($1, 1, length($1) - 1); lessons++ }
/^  [1-9] / && $2 != "gnomon" {
    is_fault = / fault/
    for (at = 38; at <= length($0); at += 20) {
        value = substr($0, at, 12)
        if (value !~ /[0-9]/) continue
        if (!is_fault) cure[$1 " " at] = value
        else if (substr($0, at + 12, 7) ~ /fault/) fault[$1 " " at] = value
    }
}
END { compare(); if (lessons < 14) print lessons " lessons" }' "$folder/out" > "$folder/wrong"
[ ! -s "$folder/wrong" ] || complain "$(cat "$folder/wrong")"

"$gnomon" lesson position --backend egl --size 96x72 -o "$folder/page" > "$folder/out" 2> "$folder/err" || complain "a page: $(cat "$folder/err")"
for file in index.html position-1.png position-1-diff.png position-2.png position-2-diff.png position-truth.png; do
    [ -s "$folder/page/$file" ] || complain "no $file"
done
grep -oE 'src="[^"]+"' "$folder/page/index.html" | sed 's/src="//; s/"//' | while read -r file; do
    [ -e "$folder/page/$file" ] || echo "$file"
done > "$folder/wrong"
[ ! -s "$folder/wrong" ] || complain "the page names $(cat "$folder/wrong")"
grep -o '<img src="[^"]*"' "$folder/page/index.html" | head -n 1 | grep -q position-truth.png || complain 'truth is not the first picture'
[ "$(grep -c 'type="range"' "$folder/page/index.html")" = 2 ] || complain 'a picture has no slider to its difference'
# a sign beside each colour; all steps have the same number of decimals
grep -q '"fault"><td>&#x2717;</td>.*>[0-9]*[.][0-9][0-9] %' "$folder/page/index.html" || complain 'the figure of the fault'
grep -q '"cure"><td>&#x2713;</td>.*>[0-9]*[.][0-9][0-9] %' "$folder/page/index.html" || complain 'the figure of the cure'
"$gnomon" lesson position --backend egl --size 96x72 --json | grep -q '"wrong": [0-9]' || complain 'JSON'
"$gnomon" render lesson:position --backend egl --size 96x72 -o "$folder/a.png" || complain 'the scene of a lesson'

exit $bad

#!/bin/sh
# The words of the documents, the manuals and --help: words for people used of programs, sentences over 35 words, and
# telegrams, which are sentences of a paragraph without a finite verb. Blocks of code, headings and targets of links are left out,
# inline code is one word, and cells of tables are searched for words for people only. A long sentence ends with a stop or a
# semicolon, a telegram with a stop. LIST=1 prints the number of each kind, too.
. tests/script.sh

pages=$(sed -n "s/^pages='\(.*\)'/\1/p" tests/check_docs.sh)
out=$(dirname "${BUILD:-build/release}")

cat > "$folder/words.awk" << 'AWK'
BEGIN {
    people = "hear hears heard hearing deaf deafen deafens deafened tell tells told telling say says said saying talk talks talked " \
             "knock knocks knocked blind blinded mend mends mended nobody somebody believe believes believed forgive forgives " \
             "forgets forgot promises insists complains complain thinks wishes patience riddle riddles"
    split_into(people, is_person)
    # verbs in the forms of the present tense; of a verb in o, s, x, ch, sh or y the third person is made by rule
    auxiliary = "is are was were has have had does do did can cannot could may might must shall should will would"
    split_into(auxiliary, is_auxiliary)
    n = split(verbs, list, " ")
    for (i = 1; i <= n; i++) {
        is_verb[list[i]] = 1
        third = list[i]
        if (third ~ /[^aeiou]y$/) sub(/y$/, "ies", third)
        else third = third (third ~ /(o|s|x|z|ch|sh)$/ ? "es" : "s")
        is_verb[third] = is_third[third] = 1
    }
    # what stands before a noun, or before a verb that is not the sentence's own
    split_into("to a an the of no each its their whose with without by for from per in on at every any", before_noun)
    split_into("which who what that", relative)
}
function split_into(text, set,    list, i, n) {
    n = split(text, list, " ")
    for (i = 1; i <= n; i++) set[list[i]] = 1
}
function report(line, kind, text) {
    print kind "\t" name ":" line ": " text
}
# bare: the word in lower case without punctuation
function bare(word) {
    gsub(/[^A-Za-z'-]/, "", word)
    return tolower(word)
}
function end_sentence(telegrams) {
    if (telegrams && words > 1 && !verb) report(first, "telegram", sentence)
    sentence = ""
    words = verb = 0
}
function end_clause() {
    if (clause_words > 35) report(clause_first, "long", clause_words " words: " clause)
    clause = ""
    clause_words = 0
}
# flush: the paragraph in buffer, by words; @N@ marks the line N of the page. Lists of --help and manuals are no sentences
function flush(    list, n, i, word, plain, before, line, next_word, j) {
    if (label) gsub(/(One of|Or|Limits): [^.;(]*/, "", buffer)
    gsub(/`[^`]*`/, "CODE", buffer)
    gsub(/\]\([^)]*\)/, "]", buffer)
    if (match(buffer, /^ @[0-9]+@ \*\*[^*]*\.\*\* /)) # a label
        buffer = substr(buffer, 1, index(buffer, "*") - 1) substr(buffer, RLENGTH + 1)
    n = split(buffer, list, " ")
    before = "."
    for (i = 1; i <= n; i++) {
        word = list[i]
        if (word ~ /^@[0-9]+@$/) {
            line = substr(word, 2, length(word) - 2)
            continue
        }
        plain = bare(word)
        if (!sentence) first = line
        if (!clause) clause_first = line
        sentence = sentence (sentence ? " " : "") word
        clause = clause (clause ? " " : "") word
        if (word ~ /[A-Za-z0-9]/) {
            words++
            clause_words++
        }
        if (plain in is_person) report(line, "people", plain)
        # at the beginning a third person is a noun in the plural, or lacks its subject
        if (!(before in relative) &&
            (plain in is_auxiliary || (plain in is_verb && !(before in before_noun) && !(words == 1 && plain in is_third))))
            verb = 1
        before = word ~ /[.,;:]$/ ? "." : plain
        # "that" joins a relative clause unless it begins a clause
        if (plain == "that" && (words == 1 || previous ~ /^(\.|and|but|or|as|than|of)$/)) before = "this"
        previous = before
        for (j = i + 1; j <= n && list[j] ~ /^@[0-9]+@$/; j++)
            ;
        next_word = j <= n ? list[j] : "."
        if (word ~ /;$/) end_clause()
        if (word ~ /[.!?][])"*_]*$/ && word !~ /\.\.$/ && (next_word !~ /^[a-z]/ || next_word ~ /^gnomon/)) {
            end_clause()
            end_sentence(!item && !caption)
        }
    }
    end_clause()
    end_sentence(0)
    buffer = ""
    item = caption = 0
}
FNR == 1 {
    flush()
    name = label ? label : FILENAME
    code = listed = 0
    blank = 1
}
/^ *```/ { flush(); code = !code; next }
code { next }
/^ *\|/ {
    gsub(/`[^`]*`/, "")
    n = split($0, cell, " ")
    for (i = 1; i <= n; i++)
        if (bare(cell[i]) in is_person) report(FNR, "people", bare(cell[i]))
}
/^ *$/ || /^ *[|#<]/ || /^!\[/ { flush(); if ($0 !~ /^ *$/) listed = 0; blank = 1; next }
/^    / && blank && !listed { next } # a block of code
{
    if (match($0, /^ *([-*]|[0-9]+\.) +/)) {
        flush()
        $0 = substr($0, RLENGTH + 1)
        item = listed = 1
    } else if (blank && /^ /) item = listed
    else if (blank) listed = 0
    if (!buffer && /^\*[A-Za-z]/) caption = 1
    buffer = buffer " @" FNR "@ " $0
    blank = 0
}
END { flush() }
AWK

verbs="add allow apply appear ask assume average be become begin belong bias bind blend break bring build call cast catch change choose clear
 clip close come commit compare compile compress compute connect contain converge convert copy cost count cover create cross cut
 darken decide define delay depend derive describe determine differ divide double draw drop end enforce ensure exceed exist expect
 explain export face fade fail fall feed fetch fill filter find finish fit follow free gather generate get give go grow guard halve
 handle hang happen hide hold include increase install join keep lack last lay lead leak leave let lie limit list listen load look lose
 lower make mark match matter mean measure miss mix move multiply name need occlude open order own pass pay play point pose prevent
 print probe produce project protect prove put quit raise reach read receive record redraw reduce reflect refuse reject release rely remain
 remember remove render repeat replace replay report require reset resolve respond rest restore return rotate run sample save scale search
 see select send separate serve set share shine show shrink simplify simulate skip snap sort spill split stand start state stay stick stop
 store subtract suffer supply support swap switch take terminate test throw tick trace track transmit travel treat trigger try turn
 uncover understand undo update upload use vanish vary verify wait wake wander want warn watch weigh work write"

findings() { awk -v verbs="$verbs" -f "$folder/words.awk" "$@"; }

# ---- the check itself ----------------------------------------------------------------------------
# one page of these paragraphs, of which each has the finding that is named before it, or none
awk '{ kind = $1; sub(/^[a-z]+: ?/, ""); print $0 "\n" > page; if (kind != "none:") print kind, 2 * NR - 1 > expected }' \
    page="$folder/own.md" expected="$folder/expected" << 'END'
people: The socket tells the timer what it needs.
people: `gnomon doctor` prints what the board says.
people: Nobody reads the second file.
people: A broken line of kiosk.ini is a problem until it is mended.
people: | `file` | what the loop hears |
long: A map of a light is drawn again when a caster moves, when the light moves, when the size of the picture changes, when the camera of the scene is another one, or when `a setting` is no longer that of the map.
none: A map of a light is drawn again when a caster moves, when the light moves, when the size of the picture changes, when the camera is another one, or when `a setting which has five words` is new.
none: A map of a light is drawn again when a caster moves, when the light moves, when the size of the picture changes. The same holds when the camera of the scene is another one, or when a setting is no longer that of the map.
telegram: The glyphs that were needed so far, as one picture.
telegram: No GL, no clock.
telegram: From a picture of all directions to a cube.
telegram: The socket is read. In the case of a lost context, the same. That is enough.
telegram: Calls of a library, without its errors.
telegram: Not tried: any of the boards.
telegram: To add a key: a row and its field.
telegram: Everything in double precision, by a test that leaks no ray.
telegram: **Bounds.** Limits of a `struct gn_scene`, in metres.
none: A display owns the GL context. `gnomon inspect` prints what a load takes: see its page. Of ten lamps, two are drawn.
none: Press the button .. and wait. That takes two draws (one for each colour). Add a row to the table.
none: **Label.** A paragraph has one.
none: *A caption, of a picture.*
none:     code that tells, without a stop.
none: - a label of a list, without a verb.
none: | a cell | without a verb. |
END
findings "$folder/own.md" | sed 's/^\([a-z]*\)\t[^:]*:\([0-9]*\):.*/\1: \2/' > "$folder/found"
diff "$folder/expected" "$folder/found" || complain 'these findings of the check on its own page are missing (<) or wrong (>)'

# ---- documents, manuals, --help ------------------------------------------------------------------
# shellcheck disable=SC2086
findings $pages board/image/card.txt > "$folder/all"

# the comments of configurations that come with gnomon
for page in board/image/board.ini board/*/kiosk.ini assets/book/*.ini; do
    sed 's/^[;#] //; t; s/.*//' "$page" > "$folder/page"
    findings label="$page" "$folder/page" >> "$folder/all"
done

# the tagged paragraphs of a manual, as items of a list
for page in "$out/gnomon.1" "$out/gnomon.ini.5" board/gnomon-import.1; do
    awk '/^\.nf/ { code = 1 } /^\.fi/ { code = 0 } code || /^\.SH/ { print ""; next }
         /^\.TP/ { print ""; tag = 1; next } tag { tag = 0; getline; printf "- " } /^\./ { print ""; next }
         { gsub(/\\f[BIPR]/, ""); gsub(/\\/, ""); print }' "$page" > "$folder/page"
    findings label="$page" "$folder/page" | grep -v '^telegram' >> "$folder/all"
done

# of_help LABEL COLUMN: the help on stdin, where an option begins left of COLUMN, and its text there
of_help() {
    awk -v column="$2" '
        /^ *$/ || /^[^ ]/ { print ""; print; next }
        substr($0, 1, column) ~ /[^ ]/ { print ""; print "- " substr($0, column + 1); next }
        { print "  " substr($0, column + 1) }' > "$folder/page"
    findings label="$1" "$folder/page" | grep -v '^telegram'
}
for command in '' $(commands_of); do
    # shellcheck disable=SC2086
    "$gnomon" $command --help=all | of_help "gnomon $command --help=all" 26
done >> "$folder/all"
import=$(dirname "$gnomon")/gnomon-import
[ ! -x "$import" ] || "$import" --help | of_help 'gnomon-import --help' 25 >> "$folder/all"

[ -z "${LIST:-}" ] || cut -f 1 "$folder/all" | sort | uniq -c
while read -r kind finding; do
    complain "$kind: $finding"
done < "$folder/all"

exit $bad

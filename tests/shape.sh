#!/bin/sh
# The shape of the code, by its layout (clang-format's): how long functions are, how many static ones are called
# once (callbacks that stand once in a table counted apart), which structs have more than 25 fields. Figures to watch, no limits: exit status 0.
# A field is a declarator; those of a struct inside without a name are the outer one's, those of a part are not.
set -eu
find "${1:-src}" -name '*.c' | sort | xargs awk '
function finish_function() {
    length_of[++count] = FNR - first + 1
    if (length_of[count] > longest) { longest = length_of[count]; longest_name = name " (" FILENAME ")" }
}
function finish_file(    name) {
    for (name in statics) {
        static_count++
        once += used[name] == 1
        callbacks += used[name] == 1 && !called[name]
    }
    split("", statics); split("", used); split("", called); in_function = 0; head = ""
}
FNR == 1 { finish_file() }
{
    line = $0
    gsub(/"([^"\\]|\\.)*"/, "\"\"", line)
    sub(/\/\*.*/, "", line)
}
!in_function && /^[a-zA-Z_]/ && !/^(typedef|extern|enum)/ { head = ""; start = FNR }
!in_function && !/^[#}\/ ]/ || (!in_function && head != "" && /^ /) {
    head = head line
    if (head ~ /[;=]/ && head !~ /\{/) head = ""
    else if (head ~ /^[^={]*\([^={]*\) *\{/) {
        name = head
        sub(/\(.*/, "", name)
        sub(/.*[ *]/, "", name)
        if (head ~ /^static / && head !~ /^static inline/) statics[name]
        first = start
        if (head ~ /\} *$/) finish_function()
        else in_function = 1
        body = head
        sub(/^[^{]*/, "", body)
        line = body
        head = ""
    } else if (head ~ /\{/) head = ""
    else line = ""
}
{ # every name used outside the head of its definition; a declaration ahead is no use
    if (!in_function && line ~ /^static .*\);? *$/) next
    while (match(line, /[a-zA-Z_][a-zA-Z_0-9]*/)) {
        word = substr(line, RSTART, RLENGTH)
        line = substr(line, RSTART + RLENGTH)
        used[word]++
        called[word] += line ~ /^\(/
    }
}
in_function && /^\}/ { finish_function(); in_function = 0 }
END {
    finish_file()
    for (i = 1; i <= count; i++) if (length_of[i] < 2000) tally[length_of[i]]++
    for (i = 1; i < 2000; i++) {
        sum += tally[i]
        if (!median && 2 * sum >= count) median = i
        if (!p90 && 10 * sum >= 9 * count) p90 = i
        if (i > 60) long += tally[i]
    }
    printf "%d functions: median %d lines, p90 %d, longest %d: %s; %d over 60\n", count, median, p90, longest, longest_name, long
    printf "%d static functions, %d named once: %.1f %%; called once: %.1f %% (%d are callbacks)\n",
        static_count, once, 100 * once / static_count, 100 * (once - callbacks) / static_count, callbacks
}'
find "${1:-src}" -name '*.[ch]' | sort | xargs awk '
# Every { .. } of a struct or union is a level; a level without declarators after it adds to the one around it.
function scan(text,    token, before) {
    while (match(text, /[{}();,]/)) {
        token = substr(text, RSTART, 1)
        before = rest substr(text, 1, RSTART - 1)
        rest = ""
        text = substr(text, RSTART + 1)
        if (token == "(") parens++
        else if (token == ")") parens--
        else if (token == "{") {
            level++
            is_struct[level] = before ~ /(struct|union)[ a-zA-Z_0-9]*$/ && before !~ /=/
            fields[level] = 0
            title[level] = before
            gsub(/.*;|.*(struct|union) *|[ \t]+/, "", title[level])
        } else if (token == "}" && level > 0) {
            inner = is_struct[level] ? fields[level] : 0
            if (is_struct[level] && fields[level] > 25)
                print FILENAME ": struct " title[level] " has " fields[level] " fields"
            level--
            closed = 1
            continue
        } else if (!parens && level > 0 && is_struct[level] && token != ")") {
            if (closed && before ~ /^[ \t]*$/ && token == ";") fields[level] += inner
            else if (before ~ /[a-zA-Z_0-9]/ || !closed) fields[level]++
        }
        if (token != ")") closed = 0
    }
    rest = rest text
}
FNR == 1 { level = parens = closed = in_comment = 0; rest = "" }
{
    gsub(/"([^"\\]|\\.)*"/, "\"\"")
    gsub(/\/\*([^*]|\*[^\/])*\*\//, "")
    if (in_comment && sub(/.*\*\//, "")) in_comment = 0
    else if (in_comment) next
    if (sub(/\/\*.*/, "")) in_comment = 1
    if (/^[ \t]*#/ || continues) { continues = /\\$/; next }
    scan($0 " ")
}'

#!/bin/sh
# Calls between files, as the symbols of their objects have them: within a room files call downwards, so none is
# called by one that it calls itself; between rooms a call goes to a room further down in the list. Prints each
# group of files that is a cycle, with its calls, and each call upwards; exit status 1 if there is any.
# Objects of BUILD (build/release) are read, which has to be made from these sources.
set -eu
objects=${BUILD:-build/release}/obj
find src -name '*.c' | sort | while read -r source; do
    object=$objects/${source%.c}.o
    [ ! -e "$object" ] || echo "$object"
done | xargs "${NM:-nm}" -A -P | awk -v objects="$objects/src/" '
BEGIN {
    split("core image shape dial environment scene bake truth shadow caption frame cost gl display input take options stage kiosk cli", rooms, " ")
    for (i in rooms) rank[rooms[i]] = i
    rank["import"] = 2.5 # a program of its own, on core and image
    rank["main.c"] = 99
}
function room_of(file) { sub(/\/.*/, "", file); return file }
{
    file = substr($1, length(objects) + 1)
    sub(/\.o:$/, ".c", file)
    files[file]
    if ($3 == "U") uses[file, ++use_count[file]] = $2
    else if ($3 ~ /^[A-Z]$/) home[$2] = file
}
# Tarjan, Depth-first search and linear graph algorithms, SIAM J. Comput. 1, 1972: the strongly connected files.
function visit(file,    i, next_file, members, group) {
    number[file] = low[file] = ++visited
    stack[++depth] = file
    on_stack[file] = 1
    for (i = 1; i <= call_count[file]; i++) {
        next_file = calls[file, i]
        if (!(next_file in number)) {
            visit(next_file)
            if (low[next_file] < low[file]) low[file] = low[next_file]
        } else if (on_stack[next_file] && number[next_file] < low[file]) low[file] = number[next_file]
    }
    if (low[file] != number[file]) return
    for (members = 0; group != file; members++) {
        group = stack[depth--]
        on_stack[group] = 0
        group_of[group] = file
    }
    if (members > 1) { cycles++; is_cycle[file] = 1 }
}
END {
    for (file in files)
        for (i = 1; i <= use_count[file]; i++) {
            symbol = uses[file, i]
            if (!(symbol in home) || home[symbol] == file) continue
            target = home[symbol]
            if (!((file, target) in names)) calls[file, ++call_count[file]] = target
            names[file, target] = names[file, target] " " symbol
        }
    for (file in files) if (!(file in number)) visit(file)
    sorter = "sort"
    for (file in files)
        for (i = 1; i <= call_count[file]; i++) {
            target = calls[file, i]
            if (is_cycle[group_of[file]] && group_of[file] == group_of[target])
                print "cycle: " file " calls " target ":" names[file, target] | sorter
            from = room_of(file)
            to = room_of(target)
            if (!(from in rank) || !(to in rank)) { print "no room: " from " or " to | sorter; bad = 1 }
            if (rank[from] + 0 < rank[to] + 0) { print "upwards: " file " calls " target ":" names[file, target] | sorter; up++ }
        }
    close(sorter)
    printf "%d cycles of files, %d calls upwards\n", cycles, up
    exit cycles + up + bad > 0
}'

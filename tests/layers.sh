#!/bin/sh
# Includes go one way, and each foreign header stays in its room; no file is long, tests neither. A service of the
# kiosk does not know the whole kiosk. The top level holds what it always has: a file that a program left there is not committed.
set -eu
[ $# = 0 ] || cd "$1"
more=$(git ls-files 2> /dev/null | cut -d / -f 1 | sort -u | grep -vxE '[.].*|Makefile|README[.]md|CONTRIBUTING[.]md|LICENSE|src|shaders_es|assets|board|tests' || true)
[ -z "$more" ] || { echo "FAIL: at the top level: $more" && exit 1; }
find src tests -name '*.[ch]' | sort | xargs awk '
BEGIN {
    # what a room may include, besides itself; src/main.c may include all
    may["core"] = ""
    may["image"] = "core"
    may["environment"] = "core image"
    may["scene"] = "core image"
    may["shape"] = "core"
    may["dial"] = "core shape"
    may["bake"] = "core image scene"
    may["shadow"] = "core scene"
    may["truth"] = "core scene"
    may["frame"] = "core environment scene shadow caption"
    may["cost"] = "core environment scene shadow truth frame caption"
    may["gl"] = "core environment scene shadow frame caption"
    may["caption"] = may["input"] = may["take"] = "core"
    may["display"] = "core caption"
    may["import"] = "core image" # a program of its own
    may["options"] = "core dial scene shadow frame cost display input take"
    may["stage"] = "core image environment scene shadow truth frame gl display input caption options cost"
    may["kiosk"] = may["stage"] " stage take"
    may["cli"] = may["kiosk"] " kiosk bake shape dial cost"
    # which rooms may include <KEY..>
    foreign["GLES3/"] = foreign["GLES2/"] = "gl"
    foreign["EGL/"] = foreign["GL/osmesa.h"] = foreign["gbm.h"] = foreign["xf86drm"] = "display"
    foreign["drm"] = foreign["libdrm/"] = foreign["GLFW/"] = foreign["wayland"] = "display"
    foreign["gpiod.h"] = foreign["linux/input"] = "input"
    foreign["linux/cec"] = "display"
    foreign["ft2build.h"] = foreign["freetype/"] = foreign["raqm.h"] = "caption"
    foreign["ini.h"] = "options"
    foreign["jansson.h"] = "core shape scene bake kiosk cli import"
    foreign["png.h"] = foreign["turbojpeg.h"] = "image"
    foreign["webp/"] = foreign["zstd.h"] = "image"
    foreign["zlib.h"] = "image kiosk"
    foreign["meshoptimizer.h"] = "scene bake"
    foreign["assimp/"] = foreign["draco/"] = "import"
    foreign["cmocka.h"] = "none"
}
function complain(what) { printf "%s:%d: %s\n", FILENAME, FNR, what; bad = 1 }
function is_in(word, list) { return index(" " list " ", " " word " ") > 0 }
FNR == 1 {
    n = split(FILENAME, part, "/")
    is_test = part[1] == "tests"
    room = n > 2 && !is_test ? part[2] : ""
    if (room != "" && !(room in may)) complain("no room is called " room)
}
FNR == 501 { complain("a file of more than 500 lines") }
is_test { next } # they may know everything
/^[ \t]*#[ \t]*include[ \t]*"/ {
    split($0, quoted, "\"")
    target = quoted[2]
    slash = index(target, "/")
    other = slash ? substr(target, 1, slash - 1) : ""
    if (index(target, "..")) complain("a path with .. in it")
    else if (other in may) {
        if (room != "" && other != room && !is_in(other, may[room])) complain(room " may not include " target)
        if (target ~ /\/private\.h$/ && other != room) complain("private.h of another room")
    } else if (target !~ /^(config|poisson|rays)\.h$|^blocks\.glsl$/) complain("\"" target "\" is in no room: write room/header.h")
}
FNR == 1 { whole_kiosk = 0 }
/"kiosk\/private\.h"/ { whole_kiosk = FILENAME !~ /\/(control\/(answer|status)|remember|trial)\.c$/ }
/^const struct gn_part gn_part_/ && whole_kiosk { complain("a part has struct gn_part_host, not the whole kiosk") }
/^[ \t]*#[ \t]*include[ \t]*</ {
    split($0, angled, /[<>]/)
    if (FILENAME ~ /[.]h$/ && angled[2] ~ /^cglm\/cglm/) complain("a header takes <cglm/types.h>: all of cglm is half of what most files would read")
    for (key in foreign)
        if (index(angled[2], key) == 1 && !is_in(room, foreign[key]))
            complain("<" angled[2] "> belongs to " foreign[key])
}
END { exit bad }
'

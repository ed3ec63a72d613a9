#!/bin/sh
# The documents against the program: links, options, goals of make, the example of kiosk.ini, the
# gnomon_ keys for artists and their examples, the rows of the table of techniques.
. tests/script.sh

pages='README.md CONTRIBUTING.md assets/README.md assets/SCENES.md assets/benchmark/README.md board/*.md board/*/README.md tests/README.md src/*/README.md tests/*/README.md'

# ---- links and paths -----------------------------------------------------------------------------
for page in $pages; do
    grep -oE '\]\([^)]+\)' "$page" | sed 's/^](//; s/)$//; s/#.*//' | while read -r link; do
        case $link in http*://* | '') continue ;; esac
        [ -e "$(dirname "$page")/$link" ] || echo "$page: no $link"
    done
    # `src/x`, `tests/x.c`: from the top folder, or from the page's
    grep -oE '`(src|tests|assets|board|shaders_es)/[A-Za-z0-9_./-]+`' "$page" | tr -d '`' | while read -r path; do
        case $path in */NAME*) continue ;; esac
        [ -e "$path" ] || [ -e "$path.c" ] || [ -e "$(dirname "$page")/$path" ] || echo "$page: no $path"
    done
done > "$folder/missing"
[ ! -s "$folder/missing" ] || complain "$(cat "$folder/missing")"

# ---- the worked examples of CONTRIBUTING.md -----------------------------------------------------
# example WHAT NAME FOLDERS [FILE]: its steps name the files of these folders that have the name, and this one
example() {
    awk -v from="^The $1" '$0 ~ from { on = 1; next } on && /^(The|##)/ { exit } on' CONTRIBUTING.md |
        grep -oE '`(src|shaders_es|tests)/[a-z_/0-9]+\.(c|h|sh|glsl)`' | tr -d '`' | sort -u > "$folder/named"
    # shellcheck disable=SC2086
    { grep -rlw "$2" $3 --include='*.[ch]' --include='*.sh' --exclude=check_docs.sh; echo "$4" | grep .; } |
        sort -u > "$folder/touched"
    cmp -s "$folder/named" "$folder/touched" || complain "CONTRIBUTING.md, $1: $(diff "$folder/named" "$folder/touched")"
}
example 'technique `box5`' box5 'src tests' shaders_es/shadow/box5.glsl
example 'option `--taps-fixed`' taps_fixed src ''

# ---- options and goals ---------------------------------------------------------------------------
for command in '' $(commands_of); do
    # shellcheck disable=SC2086
    "$gnomon" $command --help=all
done > "$folder/help"
import=$(dirname "$gnomon")/gnomon-import
options_of() { grep -oE -- '--[a-z][a-z-]+' "$1" | sort -u; }
options_of "$folder/help" > "$folder/own"
[ ! -x "$import" ] || "$import" --help >> "$folder/help"
options_of "$folder/help" > "$folder/options"
grep -ohE -- '--[a-z][a-z-]+' README.md assets/SCENES.md board/README.md board/use.md src/options/README.md src/shadow/README.md | sort -u |
    grep -vxF -f "$folder/options" | grep -vxE -- '--(now|create|reload|no-install-recommends|batch|passphrase|quick-generate-key)' > "$folder/unknown"
[ ! -s "$folder/unknown" ] || complain "options that do not exist: $(tr '\n' ' ' < "$folder/unknown")"
# shellcheck disable=SC2086
grep -ohE '(`|^sudo |&& |^)make [a-z][a-z0-9/_-]+' $pages | sed 's/.*make //' | grep -v / | sort -u | while read -r goal; do
    grep -qE "^([a-z -]* )?$goal( .*)?:|^TABLED .*\b$goal\b" Makefile || tests/goal.sh full "${goal#check-}" | grep -q tests/ || echo "$goal"
done > "$folder/goals"
[ ! -s "$folder/goals" ] || complain "goals of make that do not exist: $(tr '\n' ' ' < "$folder/goals")"

# ---- README.md -----------------------------------------------------------------------------------
[ "$(wc -l < README.md)" -le 120 ] || complain 'README.md is longer than 120 lines'
sed -n '/^```ini/,/^```/p' README.md | grep -v '^```' > "$folder/kiosk.ini"
cp assets/sundial.glb "$folder"
"$gnomon" show --check "$folder/kiosk.ini" > "$folder/out" 2> "$folder/err" < /dev/null || complain "README's kiosk.ini: $(cat "$folder/out" "$folder/err")"

# ---- tolerances: "share file..", of the table and of the code; shaders have squares of theirs -----
awk -F '[|]' '/^## /{ on = /Tolerances/ } on && /^\| `/ {
        n = split($2, name, "`"); files = ""
        for (i = 2; i <= n; i += 2) {
            if (name[i] ~ "/") { folder = name[i]; sub("/.*", "/", folder) } else name[i] = folder name[i]
            files = files " src/" name[i]
        }
        for (rest = $4; match(rest, /[0-9]e-[0-9]+/); rest = substr(rest, RSTART + RLENGTH)) print substr(rest, RSTART, RLENGTH) files
    }' src/truth/README.md | grep -v ' src/lib/' > "$folder/shares"
[ -s "$folder/shares" ] || complain 'src/truth/README.md has no table of tolerances'
while read -r share files; do
    # shellcheck disable=SC2086
    grep -qE "(^|[^0-9])${share}([^0-9]|$)" $files || complain "src/truth/README.md: the tolerance $share is not in $files"
done < "$folder/shares"
grep -oE '[0-9]e-[0-9]+f? \* [a-z_>(.-]*(size|reach|diagonal|length_of|highest)' src/truth/*.c src/shadow/*.c src/scene/*.c src/frame/*.c |
    sed -E 's/f? \*.*//; s/:/ /' | sort -u | while read -r file share; do
    grep -qE "^$share .*$file( |$)" "$folder/shares" || echo "$file: $share"
done > "$folder/unlisted"
[ ! -s "$folder/unlisted" ] || complain "tolerances that are not in src/truth/README.md: $(tr '\n' ' ' < "$folder/unlisted")"

# ---- what is generated, and the manuals ----------------------------------------------------------
out=$(dirname "${BUILD:-build/release}")
sh tests/options_page.sh "$out/host/man" | cmp - src/options/README.md || complain 'src/options/README.md is old: make options-page'
sh board/results.sh "$gnomon" board/README.md | cmp - board/README.md || complain 'the results of board/README.md are old: make board-table'
sh board/cost_table.sh "$gnomon" board/README.md | cmp - board/README.md || complain 'the costs of board/README.md are old: make board-table'
for page in "$out/gnomon.1" "$out/gnomon.ini.5" board/gnomon-import.1; do
    [ -s "$page" ] || complain "no $page"
    groff -man -Tascii -ww "$page" 2>&1 > /dev/null | grep . && complain "warnings about $page"
done
# the tags of a page, as "--option"
tags() { tr -d '\\' < "$1" | grep -E '^\.B ' | grep -oE -- '--[a-z][a-z-]+' | sort -u; }
tags "$out/gnomon.1" | diff "$folder/own" - || complain 'options of gnomon.1, and those of --help'
[ ! -x "$import" ] || { "$import" --help > "$folder/help" && options_of "$folder/help" > "$folder/own"; }
[ ! -x "$import" ] || tags board/gnomon-import.1 | diff "$folder/own" - || complain 'options of gnomon-import.1, and those of --help'

# every key of the configuration that gnomon.1 names is in gnomon.ini.5
tr -d '\\' < "$out/gnomon.1" | grep -oE 'INI: \[[a-z]+\] [a-z_]+' | sed 's/INI: //' | sort -u > "$folder/own"
tr -d '\\' < "$out/gnomon.ini.5" | awk '$1 == ".SS" { section = $2 } $1 == ".B" && section { print section, $2 }' | sort -u > "$folder/pages"
[ -s "$folder/own" ] || complain 'gnomon.1 names no keys of the configuration'
comm -23 "$folder/own" "$folder/pages" | grep . && complain 'these keys are not in gnomon.ini.5'

# ---- keys for artists ----------------------------------------------------------------------------
grep -ohE '"gnomon_[a-z_]+"' src/scene/gltf/extras.c | tr -d '"' | sort -u > "$folder/read"
grep -oE '^\| `gnomon_[a-z_]+`' assets/SCENES.md | tr -d '|` ' | sort -u > "$folder/written"
cmp -s "$folder/read" "$folder/written" || complain "keys in assets/SCENES.md: $(diff "$folder/read" "$folder/written" | grep '^[<>]')"

"$gnomon" render --size 4x4 --shadow none -o "$folder/slide.png" || complain 'a slide'
slide=$(base64 -w 0 < "$folder/slide.png")
# a square in the plane of x and z: four positions, six indices
square=$(printf '\000\000\200\277\000\000\000\000\000\000\200\077\000\000\200\077\000\000\000\000\000\000\200\077\000\000\200\077\000\000\000\000\000\000\200\277\000\000\200\277\000\000\000\000\000\000\200\277\000\000\001\000\002\000\000\000\002\000\003\000' | base64 -w 0)

# scene ON_LIGHT ON_OBJECT ON_SCENE ON_MATERIAL: a .gltf with a light of the type $lamp over the square, and these members in their extras
scene() {
    cat << JSON
{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1], "extras": {$3}}],
 "extensionsUsed": ["KHR_lights_punctual"],
 "extensions": {"KHR_lights_punctual": {"lights": [{"type": "$lamp", "intensity": 10, "extras": {$1}}]}},
 "nodes": [{"mesh": 0, "extras": {$2}},
           {"translation": [0, 3, 0], "rotation": [-0.70710678, 0, 0, 0.70710678], "extensions": {"KHR_lights_punctual": {"light": 0}}}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
 "materials": [{"extras": {$4}}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-1, 0, -1], "max": [1, 0, 1]},
               {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}],
 "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}],
 "buffers": [{"byteLength": 60, "uri": "data:application/octet-stream;base64,$square"}],
 "images": [{"uri": "data:image/png;base64,$slide"}], "textures": [{"source": 0}]}
JSON
}

# try MEMBER SECTION: inspect's warnings about it
try() {
    lamp=spot
    case $2 in
    Lights) lamp=directional && scene "$1" '' '' '' ;;
    Slides) scene "$1" '' '' '' ;;
    Objects) scene '' "$1" '' '' ;;
    Materials) scene '' '' '' "$1" ;;
    *) scene '' '' "$1" '' ;;
    esac > "$folder/key.gltf"
    "$gnomon" inspect "$folder/key.gltf" > "$folder/out" 2>&1 || echo "inspect fails: $(cat "$folder/out")"
    grep -F gnomon_ "$folder/out"
}

awk '/^### /{ section = $2 == "The" ? "Scene" : $2 } /^\| `gnomon_/{ n = split($0, cell, / *[|] */); print section "\t" cell[n - 1] }' assets/SCENES.md |
    tr -d '`' > "$folder/examples"
while IFS="$(printf '\t')" read -r section example; do
    key=$(echo "$example" | sed 's/^"\([a-z_]*\)".*/\1/')
    said=$(try "$example" "$section")
    [ -z "$said" ] || complain "$example: $said"
    said=$(try "\"$key\": {}" "$section")
    case $said in *"$key"*) ;; *) complain "$key of a wrong type on $section: $said" ;; esac
done < "$folder/examples"
[ "$(wc -l < "$folder/examples")" -ge 15 ] || complain 'examples in assets/SCENES.md'

exit $bad

#!/bin/bash
# gpus.sh [GPU..]: every program on the compilers of GPUs that are not here (README.md): all of them
# are built and drawn with, by one process a GPU, and what they cost is compared with budget/GPU.
# Those that have no ES 3.0 must be refused by name; programs that are broken or dear must be found.
#   GPUS          the same as the arguments, with commas between
#   GN_FULL=1     all lights, encodings, materials and pictures; nothing is taken from the cache
#   GN_UPDATE=1   writes the budgets, and what is known
#   BUILD         where tests/tool_gpus, tests/ident.so and gnomon are, built for arm64
set -u
here=tests/gpus # tests run in the top folder
build=${BUILD:-build/aarch64-linux-gnu-debug}
libraries=/usr/lib/aarch64-linux-gnu
gpus=(pi4 pi5 g31 g52 g610 a618 a660)
old_gpus=(pi3 mali450)
store=${XDG_CACHE_HOME:-$HOME/.cache}/gnomon/board
out=$build/gpus
mkdir -p "$out"

[ "$(uname -m)" = x86_64 ] || { echo 'not applicable: the GPUs are emulated on a PC' && exit 0; }
root=$(FOR=gpus tests/board/sysroot.sh arm64) || exit
qemu=$("$here/qemu.sh") || exit
command -v aarch64-linux-gnu-gcc > /dev/null || { echo 'needs gcc-aarch64-linux-gnu: make deps' && exit 77; }
[ -x "$build/tests/tool_gpus" ] || { echo "$build/tests/tool_gpus is not built" && exit 1; }

# The driver behind which is no GPU, and which GPU that shall be: as the registers say it, or a number.
driver_of() {
    case $1 in
    pi3) echo vc4 ;;
    pi4) echo v3d V3D=42 ;;
    pi5) echo v3d V3D=71 ;;
    mali450) echo lima ;;
    g31) echo panfrost PAN_GPU_ID=7093 ;;
    g52) echo panfrost PAN_GPU_ID=7402 ;;
    g610) echo panfrost PAN_GPU_ID=a867 ;;
    a618) echo freedreno FD_GPU_ID=618 ;;
    a660) echo freedreno FD_GPU_ID=660 ;;
    *) return 1 ;;
    esac
}

# on GPU COMMAND..: Mesa's threaded context loses what compilers tell, and a program out of its cache
# tells nothing; freedreno tells only when asked.
on() {
    local driver setting preload=''
    read -r driver setting <<< "$(driver_of "$1")"
    shift
    [ "$driver" != v3d ] || preload=$PWD/$build/tests/ident.so:
    env GALLIUM_THREAD=0 MESA_SHADER_CACHE_DISABLE=true FD_MESA_DEBUG=shaderdb ${setting:+"$setting"} \
        timeout --kill-after=5 "${GPU_LIMIT:-1500}" "$qemu" -L "$root" \
        -E LD_PRELOAD="$preload$libraries/lib${driver}_noop_drm_shim.so" "$@"
}

# What was found before by the same compiler and the same way of measuring (WAY): lines "HASH INSTRUCTIONS SPILLS FETCHES STAGE" of
# programs. Those of known/GPU are for everybody, those of the store of this machine's user. A program whose hash begins like
# that of the last commit is compiled again, so that every one is now and then.
way=$(cd "$root$libraries" && echo libgallium*.so | sed 's/\.so$//')-$(cat "$here"/cost.[ch] "$here/ident.c" | sha256sum | cut -c 1-12)
again=$(git rev-parse HEAD 2> /dev/null | cut -c 1)
known_of() {
    echo "$store/gpus-costs/$1-$way"
}
know() {
    sed "1{/ $way\$/!Q}" "$here/known/$1" 2> /dev/null | grep -v "^[#$again]"
    cat "$(known_of "$1")" 2> /dev/null
}
costs() {
    awk -F '\t' '$1 == "COST" { print $2, $3, $4, $5, $6 }' "$1"
}
keep() {
    local known
    known=$(known_of "$1")
    mkdir -p "$(dirname "$known")"
    { cat "$known" 2> /dev/null; costs "$2"; } | sort -u > "$known.$$" && mv "$known.$$" "$known"
}

# measure GPU FILE ARGUMENT..: what the tool prints; its exit status
measure() {
    local gpu=$1 file=$2
    shift 2
    on "$gpu" "$build/tests/tool_gpus" "$@" > "$file" 2> "$file.err"
}

# compare GPU FILE: what is dearer than its budget allows, one line each; and what is cheaper
compare() {
    awk -F '\t' -v gpu="$1" -v full="${GN_FULL:-}" -v strict="${STRICT:-}" -v budget="$here/budget/$1" '
        BEGIN {
            while ((getline line < budget) > 0) {
                if (line ~ /^# /) { head = line; continue }
                split(line, w, " "); name = line; sub(/^ *[0-9]+ +[0-9]+ +-?[0-9]+ +/, "", name); sub(/ +/, " ", name)
                most[name] = w[1]; spills[name] = w[2]; fetches[name] = w[3]
            }
        }
        $1 == "GPU" { mesa = $3; sub(/.*Mesa /, "", mesa); sub(/-.*/, "", mesa) }
        $1 == "COST" {
            name = $6 " " $7; seen[name] = 1
            if (!(name in most)) { if (!full || head ~ /full/) missing[name] = $3; else later++ }
            else if ($3 + 0 > most[name] + 0 || $4 + 0 > spills[name] + 0)
                dear[name] = $3 " instructions and " $4 " spills, budget " most[name] " and " spills[name]
            else if (fetches[name] >= 0 && $5 > fetches[name])
                dear[name] = $5 " fetches, budget " fetches[name]
            else if ($3 * 1.05 < most[name]) cheap[name] = $3
        }
        END {
            if (head == "") { print gpu ": no budget; GN_UPDATE=1 writes one"; exit 1 }
            if (head !~ " Mesa " mesa ",") {
                print gpu ": costs not judged: this is Mesa " mesa ", the budget is of " head
                exit strict != ""
            }
            for (n in dear) { print gpu ": " n ": " dear[n]; bad = 1 }
            for (n in missing) { print gpu ": " n ": " missing[n] " instructions, and no budget; GN_UPDATE=1"; bad = 1 }
            for (n in cheap) print gpu ": " n ": only " cheap[n] " instructions: the budget of " most[n] " can be lowered"
            if (full && head ~ /full/) for (n in most) if (!(n in seen)) { print gpu ": " n ": there is no such program any more"; bad = 1 }
            if (later) print gpu ": " later " stages have no budget yet: GN_FULL=1 GN_UPDATE=1 make check-gpus"
            exit bad
        }' "$2"
}

# update GPU FILE: what was measured takes the place of the same lines, or, in full, of all
update() {
    local file=$here/budget/$1 mesa form=quick
    mesa=$(awk -F '\t' '$1 == "GPU" { sub(/.*Mesa /, "", $3); sub(/-.*/, "", $3); print $3 }' "$2")
    [ -z "${GN_FULL:-}" ] && ! grep -qs '^#.* full$' "$file" || form=full
    mkdir -p "$here/budget"
    {
        echo "# $1, Mesa $mesa, instructions, spills, fetches (-1: not said), stage, program: $form"
        {
            [ -n "${GN_FULL:-}" ] || grep -v '^#' "$file" 2> /dev/null
            awk -F '\t' '$1 == "COST" { printf "%5d %2d %3d %-8s %s\n", $3, $4, $5, $6, $7 }' "$2"
        } | awk '{ name = $0; sub(/^ *[0-9]+ +[0-9]+ +-?[0-9]+ +/, "", name); line[name] = $0 } # the later one stays
                 END { for (n in line) print line[n] }' | LC_ALL=C sort -k 5 -k 4,4
    } > "$file.new" && mv "$file.new" "$file"
}

# One GPU: its lines, the last of which says how it was. To write a budget each technique is tried with
# all three kinds of light, one a turn, so that the table of techniques is whole.
try() {
    local gpu=$1 turn=$2 file=$out/$1 began=$SECONDS arguments status=0 said shifts=(0) shift
    [ -z "${GN_UPDATE:-}" ] || [ -n "${GN_FULL:-}" ] || shifts=(0 1 2)
    rm -f "$file.costs"
    for shift in "${shifts[@]}"; do
        know "$gpu" > "$file.known"
        arguments=(--turn $((turn + shift)) --known "$file.known")
        [ -z "${GN_FULL:-}" ] || arguments=(--full)
        case $gpu in pi4 | g52) arguments+=(--looks) ;; esac
        measure "$gpu" "$file" "${arguments[@]}"
        said=$?
        [ "$said" = 0 ] || status=$said
        keep "$gpu" "$file"
        [ "$said" != 124 ] || echo "$gpu: not done after ${GPU_LIMIT:-1500} seconds"
        grep '^FAIL' "$file" | sed "s/^FAIL\t/$gpu: /"
        [ "$said" = 0 ] || [ -s "$file" ] || tail -n 3 "$file.err"
        costs "$file" >> "$file.costs"
        [ -z "${GN_UPDATE:-}" ] || update "$gpu" "$file"
    done
    [ -z "${GN_UPDATE:-}" ] || { echo "# $gpu, $way" && sort -u "$file.costs"; } > "$here/known/$gpu"
    compare "$gpu" "$file" || status=1
    echo "$gpu: $(sed -n 's/^GPU\t\([^\t]*\)\t.*/\1/p' "$file"): $(sed -n 's/^DONE\t//p' "$file") ($((SECONDS - began)) s)"
    return "$status"
}

# refuse GPU: the program must end with 1 and one line that names the GPU and what it lacks
refuse() {
    local said status
    said=$(on "$1" "$build/gnomon" render --backend egl -o "$out/$1.png" 2>&1)
    status=$?
    echo "$1: $said"
    [ "$status" = 1 ] && [ "$(echo "$said" | wc -l)" = 1 ] && [ ! -e "$out/$1.png" ] &&
        [[ $said == 'gnomon: '*' has only OpenGL ES 2.0; gnomon needs 3.0'* ]] && return
    echo "$1: it is not refused as it should be (status $status)"
    return 1
}

# mutant GPU NAME SED-EXPRESSION WANTED: the same with one shader that is not as it should be; all the
# rest is known. The test must fail, and say of which program: else it would find nothing.
mutant() {
    local gpu=$1 folder=$out/$2 file=$out/$1-$2 said
    rm -rf "$folder"
    cp -R shaders_es "$folder"
    sed -i "$3" "$folder/caption.frag"
    ! cmp -s shaders_es/caption.frag "$folder/caption.frag" || { echo "$2: the shader is as it was" && return 1; }
    know "$gpu" > "$file.known"
    if measure "$gpu" "$file" --known "$file.known" --shaders "$folder"; then
        said=$(compare "$gpu" "$file") && { echo "$gpu: a shader that is $2 is not found" && return 1; }
    else
        said=$(grep '^FAIL' "$file")
    fi
    said=$(grep -m 1 "$4" <<< "$said") || { echo "$gpu: of a shader that is $2 nothing is said: $said" && return 1; }
    echo "$gpu: a shader that is $2 is found: ${said/FAIL/}"
}

mutants() {
    mutant "$1" broken 's/^}$/    missing();\n}/' 'caption' &&
        mutant "$1" dear 's/^}$/    for (float i = 1.0; i < 8.0; i++) o_color.r += sin(o_color.g * i * gl_FragCoord.x);\n}/' \
            'caption.*budget'
}

# all at a time, as many as there are processors; what each says comes when it is done
jobs=()
start() {
    [ "$(jobs -rp | wc -l)" -lt "$(nproc)" ] || wait -n
    { said=$("$@" 2>&1); status=$?; echo "$said"; exit "$status"; } &
    jobs+=($!)
}
chosen=${*:-${GPUS:-}} # names, with spaces or commas between them
chosen=${chosen//,/ }
read -ra wanted <<< "${chosen:-${gpus[*]}}"
for gpu in "${wanted[@]}"; do [[ " ${gpus[*]} " == *" $gpu "* ]] || { echo "there is no GPU called $gpu" && exit 2; }; done
for turn in "${!gpus[@]}"; do
    [[ " ${wanted[*]} " != *" ${gpus[turn]} "* ]] || start try "${gpus[turn]}" "$turn"
done
[ $# != 0 ] || for gpu in "${old_gpus[@]}"; do start refuse "$gpu"; done
failed=0
for job in "${jobs[@]}"; do wait "$job" || failed=1; done
[ "$failed" = 0 ] || [ -n "${GN_UPDATE:-}" ] || { echo 'failed' && exit 1; }
mutants "${wanted[0]}" || failed=1
exit "$failed"

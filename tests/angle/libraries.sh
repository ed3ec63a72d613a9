#!/bin/sh
# libraries.sh: a folder with ANGLE (libEGL.so, libGLESv2.so) and SwiftShader below it, as Chromium has them;
# taken once out of the npm package @sparticuz/chromium and kept in the user's cache; prints its name. Debian's
# chromium has only stubs of them. Exit status 77, with the reason on stderr, where a tool is missing; 78 where
# there is nothing to be had: another kind of machine, or a registry that does not answer.
set -eu
version=147.0.0
sha512=e1929e01041af2ea769adebbe6a4a2b73b4b75b42b95ff0129d0b99da79aa7ee4cbf5395d4e94974fa14f84242fe9e6c414254426378afeab9f8485a68e507a5
store=${XDG_CACHE_HOME:-$HOME/.cache}/gnomon/angle
folder=$store/$version-$(sha256sum < "$0" | cut -c 1-12)

leave() {
    status=$1
    shift
    echo "angle: $*" >&2
    exit "$status"
}

[ "$(uname -sm)" = 'Linux x86_64' ] || leave 78 "the libraries are for Linux on x86-64, this is $(uname -sm)"
if [ -e "$folder" ]; then
    echo "$folder"
    exit 0
fi
for tool in npm node; do
    command -v "$tool" > /dev/null || leave 77 "needs $tool: make deps"
done

mkdir -p "$store"
work=$(mktemp -d "$store/new.XXXXXX")
trap 'rm -rf "$work"' EXIT
cd "$work"
# Three tries: a registry may be busy. A package that came and is another one is no matter of luck.
download() {
    for pause in 3 9 0; do
        timeout 60 npm pack --ignore-scripts --fetch-retries=0 --loglevel=error --cache="$work/npm" \
            "@sparticuz/chromium@$version" > log 2>&1 < /dev/null && return
        sleep "$pause"
    done
    leave 78 "npm gives no @sparticuz/chromium $version: $(grep -m 1 -i 'err' log || echo 'no answer')"
}
download
file=$(ls ./*.tgz)
echo "$sha512  $file" | sha512sum --check --status || leave 1 "$file is not what it was: its SHA-512 differs"

tar -xzf "$file" package/bin/swiftshader.tar.br package/LICENSE
node -e 'const fs = require("fs"), zlib = require("zlib");
    fs.writeFileSync("libraries.tar", zlib.brotliDecompressSync(fs.readFileSync(process.argv[1])))' \
    package/bin/swiftshader.tar.br
mkdir libraries
tar -xf libraries.tar -C libraries --no-same-owner
for name in libEGL.so libGLESv2.so libvulkan.so.1 libvk_swiftshader.so vk_swiftshader_icd.json; do
    [ -s "libraries/$name" ] || leave 1 "$file holds no $name"
done
mv package/LICENSE libraries/
# Another test may have been faster: then ours is not needed.
mv -T libraries "$folder" 2> /dev/null || [ -e "$folder/libEGL.so" ]
echo "$folder"

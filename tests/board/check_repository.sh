#!/bin/sh
# board/repository.sh, with packages that have next to nothing in them and keys that are thrown away: apt installs from it by its
# SUITE.sources; a changed byte of a package or a list, another's key, one that has expired, and a list that nobody signed are
# refused; new versions are taken in; the same packages give the same bytes; wrong arguments get a line.
. tests/script.sh
for tool in apt-ftparchive gpg dpkg-deb apt-get; do
    command -v "$tool" > /dev/null || { echo "needs $tool (apt-utils, gpg)" && exit 77; }
done
arch=$(dpkg --print-architecture)
repository=$folder/repository
export GNUPGHOME="$folder/gpg" SOURCE_DATE_EPOCH=1790000000 LC_ALL=C
mkdir -m 700 "$GNUPGHOME"
trap 'gpgconf --kill all 2> /dev/null; rm -rf "$folder"' EXIT

# key NAME SECONDS-SINCE-1970 LIFETIME
key() { gpg --batch --quiet --no-tty --faked-system-time "$2" --passphrase '' --quick-generate-key "$1" ed25519 sign "$3" > /dev/null 2>&1 || complain "no key $1"; }
key good@example.org 1780000000 never
key other@example.org 1780000000 never
key expired@example.org 1780000000 2026-10-01

# package FOLDER VERSION [ARCHITECTURE]
package() {
    mkdir -p "$folder/made/DEBIAN" "$folder/made/usr/share/gnomon" "$1"
    echo "$2" > "$folder/made/usr/share/gnomon/version"
    printf 'Package: gnomon\nVersion: %s\nArchitecture: %s\nMaintainer: nobody <nobody@example.org>\nDescription: a try\n' \
        "$2" "${3:-$arch}" > "$folder/made/DEBIAN/control"
    dpkg-deb --root-owner-group --build "$folder/made" "$1/gnomon_$2_${3:-$arch}.deb" > /dev/null
    rm -r "$folder/made"
}
publish() { REPOSITORY=file://$repository KEY=${KEY:-good@example.org} sh board/repository.sh "$@" > "$folder/out" 2>&1; }

# apt_in SUITE: apt as a machine of that suite sees it, which knows no repository but this one
apt_in() {
    apt=$folder/apt suite=$1
    shift
    mkdir -p "$apt/lists/partial" "$apt/archives/partial" "$apt/sources"
    [ -e "$apt/sources/gnomon.sources" ] || cp "$repository/$suite.sources" "$apt/sources/gnomon.sources"
    (cd "$folder" && apt-get -q -o "Dir::State=$apt" -o "Dir::State::status=/dev/null" -o "Dir::Cache=$apt" -o Dir::Etc::sourcelist=/dev/null \
        -o "Dir::Etc::sourceparts=$apt/sources" -o APT::Sandbox::User=root -o APT::Update::Error-Mode=any -o Acquire::Languages=none \
        "$@") > "$folder/out" 2>&1
}
fetched() { rm -f "$folder"/gnomon_*.deb && apt_in bookworm update && apt_in bookworm download gnomon; }
again() { rm -rf "$folder/apt"; }
# refused WHAT TEXT: apt takes nothing, and its reason has the text
refused() {
    again
    fetched && complain "$1: apt takes it"
    grep -q "$2" "$folder/out" || complain "$1: $(cat "$folder/out")"
    cp -r "$folder/whole/." "$repository/"
}

# ---- installed from --------------------------------------------------------------------------------------
package "$folder/packages" 1.0-1~deb12
package "$folder/packages" 1.0-1~deb13
package "$folder/packages" 1.0-1~deb12 riscv64
publish "$folder/packages" "$repository" || complain "$(cat "$folder/out")"
fetched || complain "apt: $(cat "$folder/out")"
[ -e "$folder/gnomon_1.0-1~deb12_$arch.deb" ] || complain 'not the package of Debian 12'
grep -q 'deb13\|riscv64' "$repository/dists/bookworm/main/binary-$arch/Packages" && complain "another's package is in the list"
package "$folder/next" 1.1-1~deb12
publish "$folder/next" "$repository" || complain "$(cat "$folder/out")"
fetched || complain "apt, a new version: $(cat "$folder/out")"
[ -e "$folder/gnomon_1.1-1~deb12_$arch.deb" ] || complain 'the new version is not offered'
grep -q '^Version: 1.0' "$repository/dists/bookworm/main/binary-$arch/Packages" || complain 'the old version is gone'
again
apt_in trixie update && apt_in trixie download gnomon || complain "apt of Debian 13: $(cat "$folder/out")"
[ -e "$folder/gnomon_1.0-1~deb13_$arch.deb" ] || complain 'not the package of Debian 13'

# ---- refused ---------------------------------------------------------------------------------------------
cp -r "$repository" "$folder/whole"
# change FILE: one byte of it
change() { printf X | dd of="$1" bs=1 seek=$(($(wc -c < "$1") / 2)) conv=notrunc 2> /dev/null; }
change "$repository/pool/bookworm/gnomon_1.1-1~deb12_$arch.deb"
refused 'a byte of the package' 'Hash Sum mismatch'
change "$repository/dists/bookworm/main/binary-$arch/Packages.gz" && change "$repository/dists/bookworm/main/binary-$arch/Packages"
refused 'a byte of the list' 'Hash Sum mismatch\|unexpected size'
change "$repository/dists/bookworm/InRelease"
refused 'a byte of what is signed' 'BADSIG\|invalid\|not signed\|unsigned\|NOSPLIT'
rm "$repository/dists/bookworm/InRelease" "$repository/dists/bookworm/Release.gpg"
refused 'a list without a signature' 'not signed'
for who in other expired; do
    again
    cp "$folder/whole/bookworm.sources" "$folder/kept"
    if [ $who = expired ]; then # signed while the key was valid
        KEY=$who@example.org SOURCE_DATE_EPOCH=1780003600 publish "$folder/next" "$repository" || complain "$(cat "$folder/out")"
    else
        KEY=$who@example.org publish "$folder/next" "$repository" || complain "$(cat "$folder/out")"
        cp "$folder/kept" "$repository/bookworm.sources"
    fi
    refused "$who key" 'NO_PUBKEY\|EXPKEYSIG\|not signed\|expired\|issing key'
done
again
fetched || complain "apt, at the end: $(cat "$folder/out")"

# ---- the same bytes ------------------------------------------------------------------------------------
publish "$folder/packages" "$folder/one" || complain "$(cat "$folder/out")"
(umask 077 && export TZ=Asia/Kolkata LC_ALL=C.UTF-8 && repository=$folder/repository && mkdir "$folder/another folder" &&
    publish "$folder/packages" "$folder/another folder/two") || complain "$(cat "$folder/out")"
diff -r "$folder/one" "$folder/another folder/two" > "$folder/out" || complain "differ: $(cat "$folder/out")"
publish "$folder/packages" "$folder/one" && diff -r "$folder/one" "$folder/another folder/two" > "$folder/out" || complain "once more: $(cat "$folder/out")"

# ---- wrong arguments -----------------------------------------------------------------------------------
# wrong TEXT ARGUMENT..: one line that has the text, and nothing is made
wrong() {
    text=$1
    shift
    sh board/repository.sh "$@" > "$folder/out" 2>&1 && complain "$text: accepted"
    { [ "$(wc -l < "$folder/out")" = 1 ] && grep -qF -- "$text" "$folder/out"; } || complain "$text: $(cat "$folder/out")"
}
export REPOSITORY=https://example.org/gnomon KEY=good@example.org
wrong usage
wrong 'no packages in' "$folder/nowhere" "$folder/new"
REPOSITORY='' wrong 'REPOSITORY is the address' "$folder/packages" "$folder/new"
REPOSITORY=example.org wrong 'REPOSITORY is the address' "$folder/packages" "$folder/new"
KEY='' wrong 'KEY is the key' "$folder/packages" "$folder/new"
KEY=nobody@example.org wrong 'no secret key nobody@example.org' "$folder/packages" "$folder/new"
mkdir "$folder/strange" && cp "$folder/next"/*.deb "$folder/strange/gnomon_1.2_$arch.deb"
wrong 'neither Debian 12 nor 13' "$folder/strange" "$folder/new"
mkdir "$folder/text" && echo text > "$folder/text/gnomon_1.2-1~deb12_$arch.deb"
wrong 'no package' "$folder/text" "$folder/new"
[ -z "$(find "$folder/new" -type f 2> /dev/null)" ] || complain 'a refused call leaves files'
rm "$folder/strange"/* && package "$folder/strange" 1.1-1~deb12
echo more >> "$folder/strange/gnomon_1.1-1~deb12_$arch.deb"
wrong 'a change needs a new version' "$folder/strange" "$repository"
exit $bad

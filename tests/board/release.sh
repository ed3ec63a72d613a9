#!/bin/bash
# make release and make repository (make check-release): built twice, the second time in another folder, time zone, language, umask and
# for another user, they have the same bytes; then the line of README.md installs gnomon in fresh roots of Debian 12 and 13, without a
# compiler, and the default scene is rendered there; a changed package is refused. Roots of another architecture
# need qemu-user-static, binfmt_misc and arch-test. SUITES, ARCHES, IMAGES: fewer. BUILT=1: with the release that is there.
# What else is refused: check_repository.sh.
set -eu
: "${O:=build}" "${VERSION:?}" "${REPOSITORY:?}"
own=$(dpkg --print-architecture)
work=$(mktemp -d) root=$work/root port=$((20000 + $$ % 20000)) bad=0
export GNUPGHOME=$work/gpg KEY=throw-away@example.org SOURCE_DATE_EPOCH
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
leave() {
    if mountpoint -q "$root/proc"; then umount "$root/proc"; fi
    kill "${server:-}" 2> /dev/null || true
    gpgconf --kill all 2> /dev/null || true
    rm -rf --one-file-system "$work"
}
trap leave EXIT
complain() {
    echo "FAIL: $*"
    bad=1
}
{ [ "$(id -u)" = 0 ] && command -v mmdebstrap > /dev/null; } || { echo 'needs mmdebstrap, and root' && exit 77; }
mkdir -m 700 "$GNUPGHOME"
gpg --batch --quiet --faked-system-time "$((SOURCE_DATE_EPOCH - 3600))" --passphrase '' --quick-generate-key "$KEY" ed25519 sign never

# ---- twice the same --------------------------------------------------------------------------------
release() { make --no-print-directory READY=1 release > "$work/log" 2>&1 || { tail -n 20 "$work/log" && exit 1; }; }
if [ -z "${BUILT:-}" ]; then
    began=$SECONDS
    release
    echo "made in $((SECONDS - began)) s: $(du -sh "$O/gnomon-$VERSION" | cut -f 1)"
    store=${XDG_CACHE_HOME:-$HOME/.cache}
    git clone -q . "$work/another folder"
    (cd "$work/another folder" && umask 077 && unset O && export TZ=Asia/Kolkata LC_ALL=C.UTF-8 HOME=$work LOGNAME=else USER=else XDG_CACHE_HOME=$store && release)
    diff "$O/gnomon-$VERSION/SHA256SUMS" "$work/another folder/build/gnomon-$VERSION/SHA256SUMS" || complain 'made elsewhere it differs'
    rm -rf "$work/another folder"
fi
(cd "$O/gnomon-$VERSION" && sha256sum --quiet -c SHA256SUMS) || complain 'SHA256SUMS'
for into in one two; do
    REPOSITORY=http://127.0.0.1:$port sh board/repository.sh "$O/gnomon-$VERSION" "$work/$into"
done
diff -r "$work/one" "$work/two" || complain 'the repository differs'
echo "repository: $(du -sh "$work/one" | cut -f 1); a package of gnomon: $(du -h "$O/gnomon-$VERSION/gnomon_$VERSION"*_"$own".deb | head -n 1 | cut -f 1)"

# ---- installed by the line of README.md ----------------------------------------------------------------
busybox httpd -f -p "127.0.0.1:$port" -h "$work/one" &
server=$!
line=$(sed -n '/gnomon\.sources/,/install gnomon/s/sudo //gp' README.md)
case $line in
*"$REPOSITORY"*) ;;
*) complain "README.md has no line that installs from $REPOSITORY" ;;
esac
line=${line//"$REPOSITORY"/http://127.0.0.1:$port}
inside() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C DEBIAN_FRONTEND=noninteractive "$@"; }
mirror=$(sh board/mirror.sh)
for suite in ${SUITES:-bookworm trixie}; do
    for arch in ${ARCHES:-amd64 arm64}; do
        driver=llvmpipe
        if [ "$arch" != "$own" ]; then
            if ! command -v arch-test > /dev/null || ! arch-test "$arch" > /dev/null; then
                echo "SKIP: programs of $arch do not run here (qemu-user-static, binfmt_misc, arch-test)"
                [ -z "${STRICT:-}" ] || bad=1
                continue
            fi
            driver=softpipe # what llvmpipe compiles does not run under qemu-user
        fi
        mmdebstrap --mode=root --variant=apt --architectures="$arch" --include=passwd,wget --skip=cleanup/apt --quiet "$suite" "$root" \
            "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $mirror $suite main" 2> "$work/log" ||
            { cat "$work/log" && exit 1; }
        mount -t proc proc "$root/proc"
        inside sh -c 'APT_CONFIG=/root/apt.conf; printf "APT::Get::Assume-Yes yes;\n" > $APT_CONFIG; export APT_CONFIG; '"$line" > "$work/log" 2>&1 ||
            { tail -n 20 "$work/log" && complain "$suite $arch: the line of README.md"; }
        ! inside sh -c 'command -v cc gcc c++' || complain "$suite $arch: a compiler is there"
        began=$SECONDS
        inside env "GALLIUM_DRIVER=$driver" gnomon render --size 160x90 -o /root/picture.png > "$work/log" 2>&1 || { tail -n 20 "$work/log" && complain "$suite $arch: no picture"; }
        echo "$suite $arch: $(inside gnomon --version), a picture of $(wc -c < "$root/root/picture.png") bytes in $((SECONDS - began)) s"
        if [ "$arch" = "$own" ]; then
            file=$(echo "$work/one/pool/$suite"/gnomon_*_"$arch".deb)
            printf X | dd of="$file" bs=1 seek=1000 conv=notrunc 2> /dev/null
            inside sh -c 'apt-get clean && apt-get -q -y --reinstall install gnomon' > "$work/log" 2>&1 && complain "$suite: a changed package is installed"
        fi
        umount "$root/proc"
        rm -rf --one-file-system "$root"
    done
done
[ "$bad" != 0 ] || echo 'release: all as it should be'
exit "$bad"

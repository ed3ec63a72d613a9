#!/bin/bash
# The Debian packages of the last commit (make check-deb): built twice, in different folders, time zones,
# languages and umasks, they are equal byte for byte; lintian, systemd, AppStream and the desktop have
# nothing against them; they are installed in a root of their own, where the commands of autopkgtest
# pass, and purged, after which nothing of theirs is left. As SUITE and ARCH say, like make deb; programs of
# another architecture need qemu-user-static, binfmt_misc and arch-test, and only the quick ones of the
# commands pass there. INSTALL_ONLY=1: with the packages that are there.
set -eu
: "${O:=build}" "${VERSION:?}"
# shellcheck disable=SC1091
codename=$(. /etc/os-release && echo "${VERSION_CODENAME:-unknown}")
own=$(dpkg --print-architecture)
suite=${SUITE:-$codename} arch=${ARCH:-$own}
first=$O/deb/$suite
work=$(mktemp -d)
root=$work/installed
leave() {
    if mountpoint -q "$root/proc"; then umount "$root/proc"; fi
    rm -rf --one-file-system "$work"
}
trap leave EXIT
bad=0

complain() {
    echo "FAIL: $*"
    bad=1
}

skip() {
    echo "SKIP: not installed anywhere: $*"
    [ -z "${STRICT:-}" ] || bad=1
}

# ---- twice the same --------------------------------------------------------------------------------
if [ -z "${INSTALL_ONLY:-}" ]; then
    sh board/deb.sh > /dev/null
    mkdir -p "$work/another folder" "$work/out"
    cp "$O/gnomon-$VERSION.tar.gz" "$work/out"
    cp -r board "$work/another folder"
    (cd "$work/another folder" && umask 077 && TZ=Asia/Kolkata LC_ALL=C.UTF-8 O=$work/out sh board/deb.sh > /dev/null)
    for file in "$first"/*.deb "$first"/*.dsc "$first"/*.tar.*; do
        cmp "$file" "$work/out/deb/$suite/${file##*/}" || complain "${file##*/} differs when built elsewhere"
    done
    rm -rf "$work/out"
fi
ls -l "$first"/*.deb | awk '{ print $5, $9 }'

# ---- what tools say --------------------------------------------------------------------------------
# lintian knows the rules of this machine's suite
if [ "$suite" = "$codename" ]; then
    lintian --allow-root --fail-on error,warning "$first"/gnomon_"$VERSION"*.changes || complain lintian
fi
for package in "$first"/gnomon_*.deb "$first"/gnomon-import_*.deb; do dpkg-deb -x "$package" "$work/root"; done
desktop-file-validate "$work/root/usr/share/applications/gnomon.desktop" || complain 'the desktop entry'
# the name has no domain in it: the project has none
appstreamcli validate --no-net --override=cid-desktopapp-is-not-rdns=info \
    "$work/root/usr/share/metainfo/gnomon.metainfo.xml" || complain 'AppStream'
mkdir "$work/units"
find "$work/root" -name 'gnomon*.service' | while read -r unit; do
    name=${unit##*/}
    sed 's,/usr/\(bin/gnomon\|lib/gnomon/take\),/bin/true,' "$unit" > "$work/units/${name/@/@left}"
done
for unit in "$work"/units/*; do
    systemd-analyze verify --man=no "$unit" 2>&1 | grep -F "${unit##*/}" && complain "${unit##*/}"
done
systemd-analyze security --offline=yes --threshold=10 "$work/units/gnomon.service" | tail -n 1 ||
    complain 'the sandbox is wider than 1.0 of systemd-analyze security'
# it mounts sticks
systemd-analyze security --offline=yes --threshold=25 "$work/units/gnomon-take@left.service" | tail -n 1 ||
    complain 'the sandbox of sticks is wider than 2.5 of systemd-analyze security'
# each key that the sample has behind a semicolon is one
sed 's/^;\(\[\|[a-z_]* =\)/\1/; s,/srv/scene.glb,scene.glb,' board/systemd/kiosk.ini > "$work/kiosk.ini"
cp assets/sundial.glb "$work/scene.glb"

# ---- installed, used, purged -----------------------------------------------------------------------
if [ "$(id -u)" != 0 ] || ! command -v mmdebstrap > /dev/null; then
    skip 'needs mmdebstrap, and root'
elif [ "$arch" != "$own" ] && ! arch-test "$arch" > /dev/null; then
    skip "programs of $arch do not run here (qemu-user-static, binfmt_misc, arch-test)"
else
    mirror=$(sh board/mirror.sh)
    mmdebstrap --mode=root --variant=apt --architectures="$arch" --include=passwd --skip=cleanup/apt --quiet "$suite" "$root" \
        "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $mirror $suite main" 2> "$work/log" ||
        { cat "$work/log" && exit 1; }
    mount -t proc proc "$root/proc" # systemd-tmpfiles does nothing without it
    cp "$first"/gnomon_*_"$arch".deb "$first"/gnomon-import_*_"$arch".deb "$work/kiosk.ini" "$work/scene.glb" "$root/root"
    cp -r board/debian/tests "$root/root/tests"
    inside() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root DEBIAN_FRONTEND=noninteractive "$@"; }
    installed_mb() { inside dpkg-query -W -f '${Installed-Size}\n' | awk '{ kb += $1 } END { printf "%.0f", kb / 1024 }'; }
    before=$(installed_mb)
    add() { # WHAT ARGUMENTS-OF-APT
        inside sh -c "apt-get -q -y install $2" > "$work/log" 2>&1 || { tail -n 20 "$work/log" && exit 1; }
        echo "with $1 and all that it pulls in: $(installed_mb) MB on the disk, $before without"
    }
    more=$(inside sh -c 'apt-get -q --assume-no install /root/gnomon_*.deb' | sed -n 's/^After this operation, \(.*\) of additional.*/\1/p') || true
    echo "gnomon with all that is recommended: ${more:?apt says no size} more"
    add 'gnomon and a font, for a board,' '--no-install-recommends /root/gnomon_*.deb fonts-dejavu-core'
    add gnomon-import '--no-install-recommends /root/gnomon-import_*.deb'
    tests=$(sed -n 's/^Tests: //p' board/debian/tests/control | tr -d ,) driver=llvmpipe
    if [ "$arch" != "$own" ]; then # qemu-user cannot run what llvmpipe compiles, and softpipe is slow
        tests='render import' driver=softpipe
        echo "emulated: $tests; the rest, in a machine: make check-arm64"
    fi
    for test in $tests; do
        inside env AUTOPKGTEST_TMP=/tmp "GALLIUM_DRIVER=$driver" "/root/tests/$test" > "$work/log" 2>&1 ||
            { cat "$work/log" && complain "autopkgtest: $test"; }
    done
    inside gnomon show --check /root/kiosk.ini > "$work/log" 2>&1 ||
        { cat "$work/log" && complain 'the sample with all its keys'; }
    echo '; mine' >> "$root/etc/gnomon/kiosk.ini"
    inside sh -c 'apt-get -q -y install --reinstall /root/gnomon_*.deb' > "$work/log" 2>&1 || complain 'an upgrade'
    grep -q '^; mine' "$root/etc/gnomon/kiosk.ini" || complain 'an upgrade changes kiosk.ini'
    inside apt-get -q -y purge gnomon gnomon-import > "$work/log" 2>&1 || { cat "$work/log" && complain purge; }
    rm -rf "$root/root"
    find "$root" -xdev -path "$root/proc" -prune -o -path "$root/var/cache/apt" -prune -o -name '*gnomon*' -print > "$work/left"
    grep -l gnomon "$root"/etc/passwd "$root"/etc/group >> "$work/left" || true
    [ ! -s "$work/left" ] || complain "left after purge: $(cat "$work/left")"
fi
[ "$bad" != 0 ] || echo 'packages: all as it should be'
exit "$bad"

#!/bin/sh
# What make install puts where: all of its list, with paths and version filled in; the sample of
# kiosk.ini holds, also with each of its examples; make uninstall leaves nothing.
. tests/script.sh
export B="${BUILD:-build/release}" DESTDIR="$folder/root" PREFIX=/opt/kiosk VERSION=1.2.3 DATE=2026-01-02
O=$(dirname "$B") IMPORT=$([ ! -x "$B/gnomon-import" ] || echo yes)
export O IMPORT
into=$DESTDIR$PREFIX

(umask 077 && sh board/install.sh install) || complain 'install'
sh board/install.sh list | while read -r file; do
    [ -s "$into/$file" ] || echo "no $file"
    [ -z "$(find "$into/$file" ! -perm -044)" ] || echo "$file: not everybody may read it"
    ! grep -qI '@[A-Z]*@' "$into/$file" || echo "$file: $(grep -m 1 '@[A-Z]*@' "$into/$file")"
done > "$folder/out"
[ ! -s "$folder/out" ] || complain "$(cat "$folder/out")"
(cd "$into" && find . -type f | sed 's,^\./,,' | sort) > "$folder/found"
sh board/install.sh list | sort | cmp -s - "$folder/found" || complain "not in the list: $(sh board/install.sh list | sort | comm -13 - "$folder/found")"
[ "$("$into/bin/gnomon" --version)" = "$("$gnomon" --version)" ] || complain 'the program'
grep -q '^ExecStart=/opt/kiosk/bin/gnomon show -c /etc/gnomon/kiosk.ini$' "$into/lib/systemd/system/gnomon.service" || complain 'ExecStart'
grep -q 'version="1.2.3" date="2026-01-02"' "$into/share/metainfo/gnomon.metainfo.xml" || complain 'the release in AppStream'
for unit in gnomon gnomon@; do
    for line in Type=notify WatchdogSec= 'User=gnomon' 'NoNewPrivileges=yes' '\[Install\]'; do
        grep -q "^$line" "$into/lib/systemd/system/$unit.service" || complain "$unit.service: $line"
    done
done

for unit in gnomon-take gnomon-take@; do
    for line in Type=oneshot 'ExecCondition=/opt/kiosk/bin/gnomon take -c /etc/gnomon/kiosk.ini$' 'ExecStart=.*/opt/kiosk/lib/gnomon/take ' NoNewPrivileges=yes; do
        grep -q "^$line" "$into/lib/systemd/system/$unit.service" || complain "$unit.service: $line"
    done
    ! grep -q '^\[Install\]' "$into/lib/systemd/system/$unit.service" || complain "$unit.service is to be enabled by hand"
done
[ -x "$into/lib/gnomon/take" ] || complain 'gnomon-take'
grep -q 'ENV{SYSTEMD_WANTS}+="gnomon-take@%k.service"' "$into/lib/udev/rules.d/90-gnomon.rules" || complain 'the rule for sticks'

# links of the pages for boards lead to pages that are installed
(cd "$into/share/doc/gnomon/board" && for page in *.md */*.md; do
    grep -oE '\]\([^)]+\)' "$page" | sed 's/^](//; s/)$//; s/#.*//' | while read -r link; do
        case $link in http*://* | '') continue ;; esac
        [ -e "$(dirname "$page")/$link" ] || echo "$page: $link"
    done
done) > "$folder/out"
[ ! -s "$folder/out" ] || complain "links that lead nowhere: $(cat "$folder/out")"

cp assets/sundial.glb "$folder/scene.glb"
sed 's/^;\(\[\|[a-z_]* =\)/\1/; s,/srv/scene.glb,scene.glb,' board/systemd/kiosk.ini > "$folder/kiosk.ini"
! grep -q '^;[a-z_]* =' "$folder/kiosk.ini" && grep -q '^file = scene.glb' "$folder/kiosk.ini" || complain 'the examples'
for ini in "$into/share/gnomon/kiosk.ini" board/*/kiosk.ini "$folder/kiosk.ini"; do
    "$gnomon" show --check "$ini" > "$folder/out" 2> "$folder/err" || complain "$ini: $(cat "$folder/out" "$folder/err")"
done
[ ! -s "$folder/err" ] || complain "the examples: $(cat "$folder/err")"

# the changelog begins with the version of the Makefile
version=$(sed -n 's/^VERSION := //p' Makefile)
[ "$(sed -n 's/^## //p' board/CHANGELOG.md | head -n 1 | cut -d ' ' -f 1)" = "$version" ] || complain "CHANGELOG.md does not begin with $version"

sh board/install.sh uninstall || complain 'uninstall'
left=$(find "$DESTDIR" -type f -o -name gnomon)
[ -z "$left" ] || complain "left: $left"
exit $bad

#!/bin/sh
# install.sh install|uninstall|list: the files of `make install`, below DESTDIR and PREFIX; a folder
# that uninstall leaves empty goes, too. It takes from the environment O, B (the folders of the build),
# IMPORT (empty: there is no gnomon-import), VERSION and DATE.
set -eu
: "${PREFIX:=/usr/local}" "${DESTDIR:=}" "${O:=build}" "${B:=$O/release}" "${IMPORT:=}"
system=lib/systemd share=share

# MODE TARGET SOURCE..: sources are joined; @PREFIX@, @VERSION@ and @DATE@ in *.in are filled in
files() {
    cat << END
755 bin/gnomon $B/gnomon
644 $share/man/man1/gnomon.1 $O/gnomon.1
644 $share/man/man5/gnomon.ini.5 $O/gnomon.ini.5
644 $share/bash-completion/completions/gnomon $O/completion/gnomon.bash
644 $share/zsh/site-functions/_gnomon $O/completion/gnomon.zsh
644 $share/fish/vendor_completions.d/gnomon.fish $O/completion/gnomon.fish
644 $share/applications/gnomon.desktop board/desktop/gnomon.desktop
644 $share/metainfo/gnomon.metainfo.xml board/desktop/gnomon.metainfo.xml.in
644 $share/icons/hicolor/scalable/apps/gnomon.svg $O/gnomon.svg
644 $share/gnomon/kiosk.ini board/systemd/kiosk.ini
644 $share/doc/gnomon/LICENSE LICENSE
644 $share/doc/gnomon/CHANGELOG.md board/CHANGELOG.md
644 $system/system/gnomon.service board/systemd/gnomon.service.in board/systemd/common.in
644 $system/system/gnomon@.service board/systemd/gnomon@.service.in board/systemd/common.in
644 lib/sysusers.d/gnomon.conf board/systemd/sysusers.conf
644 lib/tmpfiles.d/gnomon.conf board/systemd/tmpfiles.conf.in
644 $system/system/gnomon-take.service board/systemd/gnomon-take.service.in board/systemd/take-common.in
644 $system/system/gnomon-take@.service board/systemd/gnomon-take@.service.in board/systemd/take-common.in
755 lib/gnomon/take board/systemd/take.sh.in
755 lib/gnomon/lock board/systemd/lock.sh.in
644 $share/gnomon/locked/logind.conf board/systemd/locked/logind.conf
644 $share/gnomon/locked/sysctl.conf board/systemd/locked/sysctl.conf
644 lib/udev/rules.d/90-gnomon.rules board/systemd/udev.rules
END
    [ -z "$IMPORT" ] || cat << END
755 bin/gnomon-import $B/gnomon-import
644 $share/man/man1/gnomon-import.1 board/gnomon-import.1
END
    for page in board/README.md board/use.md board/wall.md board/report.md board/museum.md board/*/README.md assets/SCENES.md src/options/README.md \
        src/import/README.md src/shadow/README.md src/cost/README.md; do
        echo "644 $share/doc/gnomon/$page $page"
        [ ! -f "${page%README.md}kiosk.ini" ] || echo "644 $share/doc/gnomon/${page%README.md}kiosk.ini ${page%README.md}kiosk.ini"
    done
}

install_one() {
    mode=$1 to=$DESTDIR$PREFIX/$2 && shift 2
    case $1 in
    *.in)
        mkdir -p "$(dirname "$to")" && rm -f "$to"
        cat "$@" | sed "s,@PREFIX@,$PREFIX,g; s,@VERSION@,$VERSION,g; s,@DATE@,$DATE,g" > "$to"
        chmod "$mode" "$to"
        ;;
    *) install -D -m "$mode" "$1" "$to" ;;
    esac
}

case ${1:-} in
install)
    umask 022
    files | while read -r mode target sources; do
        # shellcheck disable=SC2086
        install_one "$mode" "$target" $sources || exit 1
    done
    ;;
uninstall)
    IMPORT=yes
    files | while read -r mode target sources; do
        rm -f "$DESTDIR$PREFIX/$target"
    done
    for folder in "$DESTDIR$PREFIX/$share"/doc/gnomon/board/* "$DESTDIR$PREFIX/$share"/doc/gnomon/board \
        "$DESTDIR$PREFIX/$share"/doc/gnomon/src/* "$DESTDIR$PREFIX/$share"/doc/gnomon/src \
        "$DESTDIR$PREFIX/$share"/doc/gnomon/assets "$DESTDIR$PREFIX/$share"/doc/gnomon "$DESTDIR$PREFIX/$share"/gnomon/locked "$DESTDIR$PREFIX/$share"/gnomon "$DESTDIR$PREFIX"/lib/gnomon; do
        rmdir "$folder" 2> /dev/null || true
    done
    ;;
list) files | cut -d ' ' -f 2 ;;
*) echo 'usage: install.sh install|uninstall|list' >&2 && exit 2 ;;
esac

#!/bin/sh
# What `console = locked` needs: the key, which sticks cannot set; the unit; lock on and off in a folder; nothing of it without being asked.
. tests/script.sh
into=$folder/root
export B="${BUILD:-build/release}" DESTDIR="$into" PREFIX=/usr VERSION=1.2.3 DATE=2026-01-02
O=$(dirname "$B") IMPORT=
export O IMPORT
sh board/install.sh install || complain 'install'
lock=$into/usr/lib/gnomon/lock
export LOCKED="$into/usr/share/gnomon/locked"
etc=$into/etc

# nothing is locked by the installation
[ ! -e "$etc/systemd/logind.conf.d" ] && [ ! -e "$etc/sysctl.d" ] && [ ! -e "$etc/systemd/system/ctrl-alt-del.target" ] || complain 'locked unasked'
"$lock" off "$into" || complain 'off before on'
"$lock" on "$into" && "$lock" on "$into" || complain 'on, twice'
[ "$(readlink "$etc/systemd/system/ctrl-alt-del.target")" = /dev/null ] || complain 'Ctrl+Alt+Del is not masked'
for line in NAutoVTs=0 ReserveVT=0 HandlePowerKey=ignore HandleRebootKeyLongPress=ignore HandleLidSwitch=ignore; do
    grep -qx "$line" "$etc/systemd/logind.conf.d/gnomon-locked.conf" || complain "logind: $line"
done
grep -qx 'kernel.sysrq = 0' "$etc/sysctl.d/90-gnomon-locked.conf" || complain 'SysRq'
if command -v systemd-analyze > /dev/null; then
    systemd-analyze cat-config --root "$into" systemd/logind.conf 2> /dev/null | grep -qx NAutoVTs=0 || complain 'logind does not read it'
fi
"$lock" off "$into" || complain 'off'
[ -z "$(find "$etc" ! -type d)" ] || complain "left: $(find "$etc" ! -type d)"
mkdir -p "$etc/systemd/system" && echo own > "$etc/systemd/system/ctrl-alt-del.target"
! "$lock" on "$into" 2> "$folder/err" || complain 'a unit of the owner is replaced'
[ "$(cat "$etc/systemd/system/ctrl-alt-del.target")" = own ] || complain 'it is gone'
[ ! -e "$etc/systemd/logind.conf.d/gnomon-locked.conf" ] || complain 'half locked'
! "$lock" sideways "$into" 2> /dev/null || complain 'sideways'

unit=$into/usr/lib/systemd/system/gnomon.service
[ -f "$unit" ] || unit=$into/lib/systemd/system/gnomon.service
grep -q '^ExecStopPost=-+/bin/sh .*kbd_mode -f -u -C /dev/tty1' "$unit" || complain 'the unit does not give the keyboard back'
grep -q '^TTYPath=/dev/tty1$' "$unit" || complain 'of another console'
! grep -q kbd_mode "${unit%.service}@.service" || complain 'gnomon@ has no console'

# the key; without a console it is a warning, and the picture is shown
printf '[display]\nconsole = locked\n' > "$folder/kiosk.ini"
expect 0 '' show --check "$folder/kiosk.ini"
printf '[display]\nconsole = lockd\n' > "$folder/wrong.ini"
expect 2 "open, locked" show --check "$folder/wrong.ini"
exit $bad

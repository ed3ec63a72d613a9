#!/bin/sh
# gnomon-update: new versions of all packages, on the card itself; what is shown goes on meanwhile. Then the board starts again.
set -eu
[ "$(id -u)" = 0 ] || { echo 'gnomon-update: only root can' >&2 && exit 1; }
overlayroot-chroot sh -c 'mount -o rw LABEL=GNOMON /boot/firmware && trap "umount /boot/firmware" EXIT &&
    apt-get -q update && DEBIAN_FRONTEND=noninteractive apt-get -q -y -o Dpkg::Options::=--force-confold dist-upgrade && apt-get clean'
echo 'gnomon-update: done; the board starts again'
systemctl reboot

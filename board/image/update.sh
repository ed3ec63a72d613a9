#!/bin/sh
# gnomon-update: new versions of all packages, on the card itself; what is shown goes on meanwhile. Then the board starts again.
# overlayroot-chroot has the status 0 whatever failed, so a mark in /run, which it shares, stands for success. It makes what is bound below
# it writable for as long as it runs: the root, and the boot partition for a new kernel.
set -eu
[ "$(id -u)" = 0 ] || { echo 'gnomon-update: only root can' >&2 && exit 1; }
root=/media/root-ro done=/run/gnomon-updated
rm -f "$done"
leave() {
    umount "$root/dev" "$root/boot/firmware" || true
    mount -o remount,ro /boot/firmware || true
}
trap leave EXIT
mount --bind /dev "$root/dev"
mount -o remount,rw /boot/firmware
mount --bind /boot/firmware "$root/boot/firmware"
overlayroot-chroot sh -c 'apt-get -q update && export DEBIAN_FRONTEND=noninteractive &&
    apt-get -q -y -o Dpkg::Options::=--force-confold dist-upgrade && apt-get -q -y --purge autoremove && apt-get clean && touch /run/gnomon-updated'
[ -e "$done" ] || { echo 'gnomon-update: failed, for the reason above; the board goes on as it is' >&2 && exit 1; }
echo 'gnomon-update: done; the board starts again'
systemctl reboot

#!/bin/sh
# boot: after an update of the kernel or the initial RAM disk, both go to the folder `now` of the boot partition, where that is mounted to be
# written to. The kernel of before, with its RAM disk, is in `old`, an entry of the boot menu (hold the space bar). Two renames lie between
# the old pair and the new one; a power cut there leaves `old`. Called by hooks of the kernel's and of initramfs-tools' packages.
set -eu
boot=/boot/firmware
now=$boot/now old=$boot/old new=$boot/new
{ [ -d "$now" ] || [ -d "$old" ]; } && mountpoint -q $boot && [ -w $boot ] || exit 0
kernel=$(realpath /vmlinuz) disk=$(realpath /initrd.img)
if cmp -s "$kernel" $now/vmlinuz && cmp -s "$disk" $now/initrd.img; then exit 0; fi
rm -rf $new && mkdir $new
cp "$kernel" $new/vmlinuz && cp "$disk" $new/initrd.img && sync -f $boot
if cmp -s "$kernel" $now/vmlinuz; then
    mv $new/initrd.img $now/initrd.img && rm -r $new
else
    rm -rf $old
    [ ! -d $now ] || mv $now $old
    mv $new $now
fi
sync -f $boot

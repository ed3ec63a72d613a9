#!/bin/sh
# boot: after an update of the kernel or the initial RAM disk, both go to the boot partition, where it is mounted to be written to;
# what was there before is entry old of the boot menu (hold the space bar). Called by hooks of the kernel's and of initramfs-tools' packages.
set -eu
boot=/boot/firmware
[ -d $boot/loader ] && mountpoint -q $boot || exit 0
for file in vmlinuz initrd.img; do
    from=$(realpath "/$file")
    ! cmp -s "$from" $boot/$file || continue
    cp "$from" $boot/$file.new && sync -f $boot
    [ ! -e $boot/$file ] || mv $boot/$file $boot/$file.old
    mv $boot/$file.new $boot/$file && sync -f $boot
done

#!/bin/sh
# machine.sh ARCHITECTURE: makes the parts of the virtual machine and prints the folder that has
# them: vmlinuz and initrd.d, the initramfs but for its /init. They come out of Debian's kernel
# package, which is unpacked and never installed, and are kept in the user's cache: a second call
# takes no time. Exit status 77, with the reason on stderr, where the parts cannot be had.
set -eu
architecture=$1
here=$(cd "$(dirname "$0")" && pwd)
store=${XDG_CACHE_HOME:-$HOME/.cache}/gnomon/board

skip() {
    echo "board: $*" >&2
    exit 77
}

case $architecture in
amd64) cross='' kernel_arch=x86_64 ;;
arm64) cross=aarch64-linux-gnu- kernel_arch=arm64 ;;
*) skip "no virtual machine is known for $architecture" ;;
esac

# what decides how the parts come out is the kernel and this script
version=$(sha256sum < "$0" | cut -c 1-12)
found() {
    [ -n "$1" ] && [ -e "$1/vmlinuz" ] || return 0
    touch "$1"
    echo "$1"
    exit 0
}

# The headers that are here decide which kernel it is, since modules fit no other. For another
# architecture there are none, and the mirror may have left this machine's behind: then the newest
# kernel and its headers are fetched together.
release='*' headers=''
if [ "$architecture" = "$(dpkg --print-architecture 2> /dev/null)" ]; then
    headers=$(find /usr/src -maxdepth 1 -name "linux-headers-*-$architecture" ! -name '*-cloud-*' ! -name '*-rt-*' |
        sort -V | tail -n 1)
    [ -n "$headers" ] || skip "needs the headers of Debian's kernel: make deps (linux-headers-$architecture)"
    release=${headers##*/linux-headers-}
fi
found "$(find "$store" -maxdepth 1 -name "$release-$version" -name "*-$architecture-*" 2> /dev/null | sort -V | tail -n 1)"
for tool in apt-get dpkg-deb depmod modprobe make "${cross}gcc"; do
    command -v "$tool" > /dev/null || skip "needs $tool: make deps"
done
if [ -n "$headers" ]; then
    busybox=$(command -v busybox) || skip 'needs busybox: make deps (busybox-static)'
    ! ldd "$busybox" > /dev/null 2>&1 || skip 'needs a static busybox: make deps (busybox-static)'
else
    busybox=$("$here/sysroot.sh" "$architecture")/bin/busybox || exit
fi

mkdir -p "$store"
work=$(mktemp -d "$store/new.XXXXXX")
trap 'rm -rf "$work"' EXIT
log=$work/log
fail() {
    tail -n 20 "$log" >&2
    echo "board: $*" >&2
    exit 1
}

# A mirror may be busy: three tries.
download() {
    for try in 1 2 3; do
        (cd "$work" && apt-get -q download "$1") >> "$log" 2>&1 && return
        sleep "$((try * 3))"
    done
    return 1
}

fetch_kernel() {
    if [ -z "$headers" ] || ! download "linux-image-$release"; then
        headers=''
        (cd "$work" && "$here/sysroot.sh" "$architecture" linux-image-newest linux-headers-newest)
        release=$(cd "$work" && echo linux-image-*.deb | sed 's/linux-image-//;s/_.*//')
        found "$store/$release-$version"
    fi
    source=/usr/src/linux-source-$(echo "$release" | cut -d . -f 1,2).tar.xz
    [ -e "$source" ] || skip "needs $source: make deps (linux-source)"
    [ -n "$headers" ] || fetch_headers >> "$log" 2>&1 || fail 'cannot unpack the headers'
    dpkg-deb -x "$work"/linux-image-*.deb "$work/kernel" >> "$log" 2>&1 || fail 'cannot unpack the kernel'
    rm "$work"/linux-*.deb
    [ -e "$work/kernel/lib" ] || ln -s usr/lib "$work/kernel/lib"
}

# Headers in a folder of their own, with the programs that build modules from this machine's.
fetch_headers() {
    common=linux-headers-${release%-*}-common
    (cd "$work" && "$here/sysroot.sh" "$architecture" "$common") || return
    for package in "$work"/linux-headers-*.deb; do dpkg-deb -x "$package" "$work/headers" || return; done
    headers=$work/headers/usr/src/linux-headers-$release
    mkdir -p "$work/headers/usr/lib"
    ln -s /usr/lib/linux-kbuild-* "$work/headers/usr/lib/"
    echo "include $work/headers/usr/src/$common/Makefile" > "$headers/Makefile"
}

# Debian's kernel comes without three modules that the tests need. Their sources are of the same
# version; irq_sim is code of the kernel proper, which gpio-sim calls, so as a module it may not use
# what is not exported, and needs a licence. A simulated chip that goes would free its interrupts while a
# program still has them, which spoils the kernel's memory: here they stay.
build_modules() {
    mkdir "$work/source" "$work/build"
    tar -C "$work/source" --strip-components=1 -xf "$source" --wildcards \
        '*/drivers/gpu/drm/vkms/*' '*/drivers/gpio/gpio-sim.c' '*/drivers/gpio/*.h' '*/kernel/irq/irq_sim.c' || return
    cp -R "$work/source/drivers/gpu/drm/vkms" "$work/build/"
    cp "$work/source/drivers/gpio/"*.[ch] "$work/source/kernel/irq/irq_sim.c" "$work/build/"
    echo 'obj-m += irq_sim.o gpio-sim.o vkms/' > "$work/build/Kbuild"
    # shellcheck disable=SC2016
    sed -i 's/\$(CONFIG_DRM_VKMS)/m/' "$work/build/vkms/Makefile"
    sed -i 's/handle_simple_irq(irq_to_desc(irqnum));/generic_handle_irq(irqnum);/' "$work/build/irq_sim.c"
    sed -i 's/irq_dispose_mapping(irq_find_mapping(chip->irq_sim, i));/;/' "$work/build/gpio-sim.c"
    sed -i '/^void irq_domain_remove_sim/,/^}/s/^{/{\n\treturn;/' "$work/build/irq_sim.c"
    printf '#include <linux/module.h>\nMODULE_LICENSE("GPL");\n' >> "$work/build/irq_sim.c"
    make -C "$headers" ARCH="$kernel_arch" CROSS_COMPILE="$cross" \
        M="$work/build" modules || return
    mkdir -p "$work/kernel/lib/modules/$release/extra"
    find "$work/build" -name '*.ko' -exec cp {} "$work/kernel/lib/modules/$release/extra/" \;
    depmod -b "$work/kernel" "$release"
}

# order NAME MODULE..: the files of these modules, in the order in which they must be loaded
order() {
    name=$1
    shift
    for module in "$@"; do
        modprobe -d "$work/kernel" -S "$release" --show-depends "$module"
    done | awk '$1 == "insmod" && !seen[$2]++ { print $2 }' > "$work/$name.files" || return
    while read -r file; do
        cp "$file" "$work/initrd.d/modules/" || return
        basename "$file"
    done < "$work/$name.files" > "$work/initrd.d/modules/$name.order"
}

gather() {
    mkdir -p "$work/initrd.d/bin" "$work/initrd.d/modules"
    order base virtio_pci 9pnet_virtio 9p overlay virtio_console virtio_rng &&
        order disk virtio_blk crc32c_generic ext4 &&
        order stick xhci_pci usb_storage sd_mod vfat nls_cp437 nls_ascii nls_iso8859_1 nls_utf8 &&
        order gpu virtio_gpu && order vkms vkms && order gpio gpio-sim && order keys evdev uinput &&
        order cec vivid || return
    cp "$busybox" "$work/initrd.d/bin/busybox" && mv "$work/kernel/boot/vmlinuz-$release" "$work/vmlinuz"
}

echo "board: making the $architecture machine, once" >&2
fetch_kernel
parts=$store/$release-$version
build_modules >> "$log" 2>&1 || fail 'the modules do not build'
gather >> "$log" 2>&1 || fail 'cannot gather the modules'
find "$store" -maxdepth 1 -mindepth 1 -mtime +60 -exec rm -rf {} + # parts that nobody used for long
mkdir "$work/done"
mv "$work/vmlinuz" "$work/initrd.d" "$work/done/"
mv "$work/done" "$parts" 2> /dev/null || [ -e "$parts/vmlinuz" ] || fail "cannot write $parts"
echo "$parts"

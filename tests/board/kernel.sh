#!/bin/sh
# kernel.sh FOLDER: prints the file that QEMU boots, of a folder that machine.sh has made. A PC's vmlinuz unpacks itself, which
# takes an emulated processor as long as all that the kernel then does: here it is unpacked once, by this machine. The format is that
# of Documentation/arch/x86/boot.rst; QEMU boots the ELF file in it by the kernel's note for PVH.
set -eu
packed=$1/vmlinuz unpacked=$1/vmlinux

number() { od -An -t "u$2" -j "$1" -N "$2" "$packed" | tr -d ' '; } # OFFSET BYTES: little-endian, as the PC that emulates has it

if [ ! -e "$unpacked" ] && [ "$(dd if="$packed" bs=1 skip=514 count=4 2> /dev/null)" = HdrS ]; then
    setup=$((($(number 497 1) + 1) * 512)) offset=$(number 584 4) length=$(number 588 4)
    new=$(mktemp "$unpacked.XXXXXX")
    trap 'rm -f "$new"' EXIT
    # its last four bytes are the size of what it packs
    tail -c "+$((setup + offset + 1))" "$packed" | head -c "$((length - 4))" | xz -dc > "$new" 2> /dev/null &&
        readelf -n "$new" 2> /dev/null | grep -q Xen && mv "$new" "$unpacked"
fi
if [ -e "$unpacked" ]; then echo "$unpacked"; else echo "$packed"; fi # packed by another program: then it unpacks itself

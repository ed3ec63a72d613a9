#!/bin/sh
# build.sh: an image of a card or a disk that starts with gnomon as its only purpose, of the packages in $O/deb/SUITE (make deb), into
# $O/gnomon-VERSION-KIND-ARCH.img. The root is read-only, under memory (overlayroot); a small partition keeps content, state and caches;
# a FAT partition holds kernel, board.ini and the folder gnomon, for any PC to write to. README.md here explains it.
#   KIND   efi (PCs, and boards whose firmware has UEFI) or pi4 (Raspberry Pi 4, 400, CM4)
#   ARCH   arm64 or amd64: programs of another architecture than this machine's need qemu-user-static
#   SUITE  bookworm or trixie
#   MIRROR, SECURITY  where updates of Debian come from: the repositories that apt uses on this machine without them
#   SOURCES=FILE  a .sources of board/repository.sh: updates of gnomon come from there
#   EXTRA  more of the kernel's command line, for tests
# Root makes it, since device files and owners are the image's; no loop device is used.
set -eu
umask 022
: "${O:=build}" "${VERSION:?}"
here=$(cd "$(dirname "$0")" && pwd)
kind=${KIND:-efi} arch=${ARCH:-arm64} suite=${SUITE:-bookworm}
image=$O/gnomon-$VERSION-$kind-$arch.img
id=676e6f6d # of the disk; partitions are named by it
boot_mb=512 data_mb=256 free_mb=700

refuse() {
    echo "image: $*" >&2
    exit 1
}
[ "$(id -u)" = 0 ] || refuse 'only root can make it'
for tool in mmdebstrap mke2fs mkfs.vfat mcopy sfdisk; do command -v $tool > /dev/null || refuse "needs $tool: apt-get install mmdebstrap e2fsprogs dosfstools mtools fdisk"; done
debs=$(ls "$O/deb/$suite/"gnomon_*_"$arch".deb "$O/deb/$suite/"gnomon-import_*_"$arch".deb 2> /dev/null) || refuse "no packages for $arch in $O/deb/$suite: make deb SUITE=$suite ARCH=$arch"
[ "$arch" = "$(dpkg --print-architecture)" ] || arch-test "$arch" > /dev/null 2>&1 || refuse "programs of $arch do not run here: apt-get install qemu-user-static binfmt-support arch-test; without systemd mount binfmt_misc at /proc/sys/fs/binfmt_misc and run update-binfmts --enable"
packages=linux-image-$arch,systemd-sysv,systemd-timesyncd,systemd-resolved,udev,dbus,kmod,initramfs-tools,overlayroot,busybox,e2fsprogs,dosfstools,fdisk
packages=$packages,ca-certificates,iproute2,openssh-server,wpasupplicant,tzdata,fonts-dejavu-core
components=main
case $kind-$arch in
efi-arm64) packages=$packages,systemd-boot-efi firmware=aa64 ;;
efi-amd64) packages=$packages,systemd-boot-efi firmware=x64 ;;
pi4-arm64) packages=$packages,raspi-firmware,firmware-brcm80211 components='main non-free-firmware' ;;
*) refuse "KIND=$kind for ARCH=$arch: there are efi for arm64 and amd64, and pi4 for arm64" ;;
esac

SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct)}
export SOURCE_DATE_EPOCH E2FSPROGS_FAKE_TIME="$SOURCE_DATE_EPOCH" TZ=UTC
work=$(mktemp -d "$O/image.XXXXXX")
trap 'rm -rf --one-file-system "$work"' EXIT
root=$work/root

# ---- the root --------------------------------------------------------------------------------------------
mirror=$(sh "$here/../mirror.sh")
case ${MIRROR:-$mirror} in *@* | file:* | copy:*) refuse "updates would come from ${MIRROR:-$mirror}: MIRROR is a repository that others reach, without a password" ;; esac
security=${SECURITY:-$(sh "$here/../mirror.sh" -security 2> /dev/null || true)}
[ -n "$security" ] || echo 'image: without security updates of Debian: SECURITY is the address of their repository' >&2
inside() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 "SOURCE_DATE_EPOCH=$SOURCE_DATE_EPOCH" "$@"; }
mkdir -p "$work/debs"
# shellcheck disable=SC2086
cp $debs "$work/debs"
mmdebstrap --mode=root --variant=minbase --architectures="$arch" --include="$packages" --quiet --skip=cleanup/apt/lists \
    --setup-hook='mkdir -p "$1/boot/firmware"' \
    "$suite" "$root" \
    "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $mirror $suite $components" > "$work/log" 2>&1 ||
    { tail -n 20 "$work/log" >&2 && refuse 'mmdebstrap failed'; }
cp -r "$work/debs" "$root/debs"
rm -f "$root/etc/resolv.conf" && cp -L /etc/resolv.conf "$root/etc/resolv.conf" # that of systemd-resolved, which does not run here
inside sh -c 'apt-get -q -y --no-install-recommends install /debs/*.deb && apt-get clean && rm -rf /var/lib/apt/lists/*' > "$work/log" 2>&1 ||
    { tail -n 20 "$work/log" >&2 && refuse 'the packages are not installed'; }
rm -rf "$root/debs"
if [ -n "${SOURCES:-}" ]; then cp "$SOURCES" "$root/etc/apt/sources.list.d/gnomon.sources"; fi
# updates of Debian
{
    printf 'deb %s %s %s\n' "${MIRROR:-$mirror}" "$suite" "$components" "${MIRROR:-$mirror}" "$suite-updates" "$components"
    [ -z "$security" ] || printf 'deb %s %s %s\n' "$security" "$suite-security" "$components"
} > "$root/etc/apt/sources.list"

# ---- its configuration -------------------------------------------------------------------------------------
put() { install -D -m "$1" /dev/stdin "$root$2"; }
for script in data board boot; do put 755 /usr/lib/gnomon/$script < "$here/$script.sh"; done
put 755 /usr/sbin/gnomon-update < "$here/update.sh"
for unit in gnomon-data gnomon-board; do put 644 /etc/systemd/system/$unit.service < "$here/$unit.service"; done
for hook in kernel/postinst.d kernel/postrm.d initramfs/post-update.d; do
    printf '#!/bin/sh\nexec /usr/lib/gnomon/boot\n' | put 755 "/etc/$hook/zz-gnomon-boot"
done
put 644 /etc/hostname << 'TEXT'
gnomon
TEXT
put 644 /etc/hosts << 'TEXT'
127.0.0.1 localhost gnomon
TEXT
put 644 /etc/fstab << TEXT
PARTUUID=$id-02 / ext4 noatime,errors=remount-ro 0 1
PARTUUID=$id-01 /boot/firmware vfat ro,nofail,umask=0022,x-systemd.device-timeout=60s 0 0
TEXT
mkdir -p "$root/data" "$root/var/lib/gnomon" "$root/var/cache/gnomon"
put 644 /etc/systemd/network/50-gnomon.network << 'TEXT'
[Match]
Name=eth* wlan*
[Network]
DHCP=yes
[DHCPv4]
ClientIdentifier=mac
[Link]
RequiredForOnline=no
TEXT
put 644 /etc/systemd/journald.conf.d/gnomon.conf << 'TEXT'
[Journal]
Storage=volatile
RuntimeMaxUse=16M
TEXT
put 644 /etc/systemd/logind.conf.d/gnomon.conf << 'TEXT'
[Login]
NAutoVTs=0
ReserveVT=0
TEXT
put 644 /etc/ssh/sshd_config.d/gnomon.conf << 'TEXT'
HostKey /data/ssh/ssh_host_ed25519_key
AuthorizedKeysFile /run/gnomon-ssh/authorized_keys
PasswordAuthentication no
KbdInteractiveAuthentication no
PermitRootLogin prohibit-password
TEXT
put 644 /etc/systemd/system/gnomon-take.service.d/image.conf << 'TEXT'
[Unit]
RequiresMountsFor=/boot/firmware
After=gnomon-board.service
TEXT
put 644 /etc/gnomon/kiosk.ini << 'TEXT'
; What is shown comes from the folder gnomon of the boot partition, or from a stick.
[kiosk]
content = /var/lib/gnomon/content
state = /var/lib/gnomon/state
TEXT
inside systemctl -q enable gnomon gnomon-data gnomon-board systemd-networkd systemd-resolved systemd-timesyncd
inside systemctl -q disable ssh wpa_supplicant
inside systemctl -q mask getty@.service serial-getty@.service console-getty.service ctrl-alt-del.target apt-daily.timer apt-daily-upgrade.timer \
    dpkg-db-backup.timer fstrim.timer e2scrub_all.timer e2scrub_reap.service
inside passwd -q -l root
ln -sf /run/systemd/resolve/resolv.conf "$root/etc/resolv.conf"
options="root=PARTUUID=$id-02 ro rootwait overlayroot=tmpfs:recurse=0 net.ifnames=0 quiet loglevel=0 vt.global_cursor_default=0 systemd.show_status=no panic=10"
options="$options${EXTRA:+ $EXTRA}"

# ---- the boot partition: kernel, board.ini, the folder gnomon ------------------------------------------------
fat=$work/fat
mkdir -p "$fat/gnomon"
if [ "$kind" = efi ]; then
    mkdir -p "$fat/now" "$fat/EFI/BOOT" "$fat/loader/entries"
    cp "$(realpath "$root/boot"/vmlinuz-* | tail -n 1)" "$fat/now/vmlinuz"
    cp "$(realpath "$root/boot"/initrd.img-* | tail -n 1)" "$fat/now/initrd.img"
    cp "$root/usr/lib/systemd/boot/efi/systemd-boot$firmware.efi" "$fat/EFI/BOOT/BOOT$(echo "$firmware" | tr '[:lower:]' '[:upper:]').EFI"
    printf 'default gnomon.conf\ntimeout 0\neditor no\n' > "$fat/loader/loader.conf"
    printf 'title gnomon\nlinux /now/vmlinuz\ninitrd /now/initrd.img\noptions %s\n' "$options" > "$fat/loader/entries/gnomon.conf"
    printf 'title old\nlinux /old/vmlinuz\ninitrd /old/initrd.img\noptions %s\n' "$options" > "$fat/loader/entries/old.conf"
else
    printf 'ROOTPART="PARTUUID=%s-02"\nCONSOLES=""\n' "$id" >> "$root/etc/default/raspi-firmware"
    echo "${options#* }" > "$root/etc/default/raspi-extra-cmdline"
    inside update-initramfs -u > "$work/log" 2>&1 || { cat "$work/log" >&2 && refuse 'update-initramfs failed'; }
    cp -r "$root/boot/firmware/." "$fat/"
    rm -rf "${root:?}/boot/firmware"/*
    grep -q "PARTUUID=$id-02.*overlayroot" "$fat/cmdline.txt" || refuse "raspi-firmware wrote another cmdline.txt: $(cat "$fat/cmdline.txt")"
fi
cp "$here/board.ini" "$fat/"
cp "$here/card.txt" "$fat/README.txt"
cp "$here/../../assets/sundial.glb" "$fat/gnomon/scene.glb"
find "$fat" -exec touch -h -d "@$SOURCE_DATE_EPOCH" {} +

# ---- nothing of this build stays in it --------------------------------------------------------------------
rm -f "$root"/etc/ssh/ssh_host_* "$root"/var/lib/systemd/random-seed "$root"/var/cache/ldconfig/aux-cache "$root"/var/lib/dbus/machine-id "$root"/var/log/*.log "$root"/var/log/apt/*
: > "$root/etc/machine-id" # systemd makes one, in memory
find "$root" -newermt "@$SOURCE_DATE_EPOCH" -exec touch -h -d "@$SOURCE_DATE_EPOCH" {} +

# ---- partitions, each a file, then one behind the other --------------------------------------------------
uuid() { printf '%s-0000-4000-8000-00000000000%s' "$id" "$1"; }
mkdir -p "$work/data/lib" "$work/data/cache"
owner=$(awk -F : '$1 == "gnomon" { print $3 ":" $4 }' "$root/etc/passwd")
chown "${owner:?no user gnomon in the image}" "$work/data/lib" "$work/data/cache"
find "$work/data" -exec touch -h -d "@$SOURCE_DATE_EPOCH" {} +
root_mb=$(($(du -sm --apparent-size "$root" | cut -f 1) * 5 / 4 + free_mb))
ext4() { mke2fs -q -t ext4 -b 4096 -m 0 -L "$1" -U "$(uuid "$2")" -E "hash_seed=$(uuid "$2")" -d "$3" "$4" "$5M"; } # LABEL NUMBER FOLDER FILE MB
ext4 gnomon-root 2 "$root" "$work/root.ext4" $root_mb
ext4 gnomon-data 3 "$work/data" "$work/data.ext4" $data_mb
mkfs.vfat -F 32 -n GNOMON -i $id --invariant -C "$work/boot.fat" $((boot_mb * 1024)) > /dev/null
(cd "$fat" && for top in *; do mcopy -s -m -D o -i ../boot.fat "$top" ::; done)
rm -f "$image"
truncate -s $((1 + boot_mb + root_mb + data_mb))M "$image"
sfdisk --quiet "$image" << TEXT
label: dos
label-id: 0x$id
start=1MiB, size=${boot_mb}MiB, type=$([ "$kind" = efi ] && echo ef || echo c), bootable
size=${root_mb}MiB, type=83
size=${data_mb}MiB, type=83
TEXT
at=1
for part in boot.fat root.ext4 data.ext4; do
    dd if="$work/$part" of="$image" bs=1M seek=$at conv=notrunc,sparse status=none
    at=$((at + $(stat -c %s "$work/$part") / 1048576))
done
ls -ls "$image"

#!/bin/busybox sh
# shellcheck shell=dash
# The machine's first program: the host's root, read-only over 9p, under a layer of memory, then the
# test in it. No udevd, no systemd: a bare board; or, with gnomon.systemd on the kernel's line, both, from
# a disk (service-root.sh), whose changes go when the machine does.
export PATH=/bin
busybox mkdir -p /proc /sys /dev /lower /upper /new
busybox mount -t proc proc /proc # where it finds itself
busybox --install -s /bin
mount -t sysfs sysfs /sys
mount -t devtmpfs dev /dev

load() {
    while read -r module; do
        name=$(echo "${module%.ko*}" | tr - _)
        [ -e "/sys/module/$name" ] || insmod "/modules/$module" || echo "init: $module does not load"
    done < "/modules/$1.order"
}

share() { # TAG FOLDER OPTIONS
    mount -t 9p -o "trans=virtio,version=9p2000.L,msize=524288,$3" "$1" "$2"
}

load base
if grep -qw gnomon.systemd /proc/cmdline; then
    load disk
    while [ ! -b /dev/vda ]; do sleep 1; done
    mount -t ext4 /dev/vda /new
else
    # cache=loose: the host's files do not change while the test runs, and without a cache every page of
    # every program would be asked for again
    share root /lower ro,cache=loose
    mount -t tmpfs -o size=80% tmpfs /upper
    mkdir /upper/files /upper/work
    mount -t overlay -o lowerdir=/lower,upperdir=/upper/files,workdir=/upper/work overlay /new
fi
mkdir -p /new/proc /new/sys /new/dev /new/run /new/tmp /new/out

# With systemd (a root of service-root.sh): it mounts the rest, and the test is a service of its.
if grep -qw gnomon.systemd /proc/cmdline; then
    share out /new/out rw
    mkdir -p /new/opt/board /new/etc/systemd/system/multi-user.target.wants
    cp -R /modules /bin/busybox /new/opt/board/
    load gpu
    unit=gnomon-test.service
    cat > /new/etc/systemd/system/$unit << 'END'
[Unit]
After=basic.target systemd-logind.service
[Service]
Type=oneshot
Environment=HOME=/root TERM=linux PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin
StandardOutput=append:/out/log
StandardError=inherit
ExecStart=/bin/sh -c 'cp -R /opt/board/. /run/ && exec /bin/bash /out/guest.sh'
ExecStopPost=/bin/sh -c 'sync && systemctl poweroff --force --force'
TimeoutStartSec=infinity
END
    ln -s ../$unit /new/etc/systemd/system/multi-user.target.wants/$unit
    umount /sys
    exec switch_root /new /lib/systemd/systemd
fi
for folder in proc sys dev; do mount -o bind "/$folder" "/new/$folder"; done
mkdir -p /dev/pts /dev/shm
mount -t devpts devpts /new/dev/pts
for folder in dev/shm run tmp; do mount -t tmpfs -o mode=1777 tmpfs "/new/$folder"; done
share out /new/out rw
mkdir /new/run/modules && mount -o bind /modules /new/run/modules
cp /bin/busybox /new/run/busybox
load gpu
ip link set lo up

# what is said where nobody listens goes to the console, which the host keeps
env -i PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME=/root TERM=linux \
    chroot /new /bin/bash /out/guest.sh > /new/out/log 2>&1 < /dev/null
sync
poweroff -f

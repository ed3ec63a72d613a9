#!/bin/sh
# data: the data partition, the last of the card, takes all that is behind it, and is mounted for content, state and caches. Where it
# cannot be, those are in memory, and a picture stands none the less. Run at each start, before gnomon.
set -u
link=/dev/disk/by-partuuid/676e6f6d-03 # that of this card: a stick may have the same name
lose() {
    echo "gnomon-data: $*; content and state are in memory until it is well again"
    exit 1
}

udevadm wait --timeout=60 $link 2> /dev/null || lose 'there is no partition of that name'
device=$(realpath $link)
partition=/sys/class/block/${device##*/}
card=$(realpath "$partition/..")
end=$(($(cat "$partition/start") + $(cat "$partition/size")))
if [ "$(cat "$card/size")" -ge $((end + 8192)) ]; then # 4 MB are not worth it
    # one sector is written, so that a power cut leaves the table of before or the new one
    number=$(cat "$partition/partition")
    echo ', +' | sfdisk --quiet --no-reread --no-tell-kernel --force -N "$number" "/dev/${card##*/}" &&
        partx --update --nr "$number" "/dev/${card##*/}" || echo 'gnomon-data: it stays as small as it is'
fi

e2fsck -p "$device" || [ $? -lt 4 ] || e2fsck -y "$device" || [ $? -lt 4 ] || lose 'its file system is broken'
mount -o noatime,nosuid,nodev "$device" /data || lose 'it cannot be mounted'
resize2fs "$device"
for folder in lib cache; do
    [ -d /data/$folder ] || install -d -o gnomon -g gnomon /data/$folder
    mount --bind /data/$folder /var/$folder/gnomon || lose "/var/$folder/gnomon is not there"
done

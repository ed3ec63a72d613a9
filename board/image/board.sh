#!/bin/sh
# board: makes true what board.ini of the boot partition says: time zone, Wi-Fi, a key for SSH. Run at each start, before the network.
# /etc is memory's (overlayroot), so nothing of an earlier start is left. What is wrong is in board-problem.txt beside it.
set -u
boot=/boot/firmware ini=$boot/board.ini problems=/run/gnomon-board/problems
mkdir -p -m 700 /run/gnomon-board && : > $problems

complain() {
    echo "$*" | tee -a $problems
}
# value KEY: of the last line that has it, without the blanks around it and a carriage return
value() { sed -n "s/^[[:space:]]*$1[[:space:]]*=[[:space:]]*//p" $ini | tr -d '\r' | sed 's/[[:space:]]*$//' | tail -n 1; }

set_timezone() {
    case $1 in
    *..* | /*) complain "timezone = $1: a name such as Europe/Berlin is wanted" ;;
    *)
        if [ -f "/usr/share/zoneinfo/$1" ]; then
            ln -sf "/usr/share/zoneinfo/$1" /etc/localtime && echo "$1" > /etc/timezone
        else
            complain "timezone = $1: there is none of that name; Europe/Berlin is one"
        fi
        ;;
    esac
}

# set_wifi NAME PASSWORD COUNTRY
set_wifi() {
    local_file=/etc/wpa_supplicant/wpa_supplicant-wlan0.conf
    if [ ${#2} -lt 8 ] || [ ${#2} -gt 63 ]; then
        complain "password of the Wi-Fi: it has 8 to 63 characters, and this one ${#2}"
        return
    fi
    case $3 in
    [A-Z][A-Z]) ;;
    *) complain "country = $3: two capital letters are wanted, such as DE" && return ;;
    esac
    network=$(wpa_passphrase "$1" "$2") || { complain "wifi = $1: wpa_passphrase refuses it" && return; }
    (umask 077 && { printf 'country=%s\n' "$3" && echo "$network" | grep -v '^[[:space:]]*#psk'; } > $local_file)
    systemctl start --no-block wpa_supplicant@wlan0.service
}

# one way in, and only for who has that key: as root, for updates
set_key() {
    echo "$1" > /run/gnomon-board/key
    if ! ssh-keygen -l -f /run/gnomon-board/key > /dev/null 2>&1; then
        complain "ssh_key: this is no public key; the line of id_ed25519.pub is one"
        return
    fi
    mkdir -p -m 755 /run/gnomon-ssh /data/ssh && cp /run/gnomon-board/key /run/gnomon-ssh/authorized_keys
    # a power cut may leave half of one
    host=/data/ssh/ssh_host_ed25519_key
    ssh-keygen -y -P '' -f $host > /dev/null 2>&1 ||
        { rm -f $host $host.new* && ssh-keygen -q -t ed25519 -N '' -f $host.new && sync $host.new && mv $host.new $host; }
    systemctl start --no-block ssh.service
}

if [ -f $ini ]; then
    sed 's/\r$//' $ini | grep -vE '^[[:space:]]*(#|;|\[|$)' | while read -r line; do
        case $line in
        timezone*=* | wifi*=* | password*=* | country*=* | ssh_key*=*) ;;
        *) complain "\"$line\": the keys are timezone, wifi, password, country and ssh_key" ;;
        esac
    done
    [ -z "$(value timezone)" ] || set_timezone "$(value timezone)"
    [ -z "$(value wifi)" ] || set_wifi "$(value wifi)" "$(value password)" "$(value country)"
    [ -z "$(value ssh_key)" ] || set_key "$(value ssh_key)"
fi

# written only where it differs: a card is not written to at each start
told=$boot/board-problem.txt
if [ ! -s $problems ]; then
    [ ! -e $told ] || { mount -o remount,rw $boot && rm -f $told; }
elif ! cmp -s $problems $told; then
    mount -o remount,rw $boot && cp $problems $told
fi
mount -o remount,ro $boot 2> /dev/null
exit 0

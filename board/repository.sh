#!/bin/sh
# repository.sh PACKAGES OUT: makes an apt repository in OUT, files for any web server, of the Debian packages in the folder PACKAGES
# (make release), or takes those in that are new. With it come SUITE.sources, which a machine needs to install from it: the address
# and the public key.
#   REPOSITORY        the address at which OUT will stand, https://..
#   KEY               the key that signs, in gpg's keyring (GNUPGHOME): a fingerprint or an address
#   SOURCE_DATE_EPOCH seconds since 1970 that count as now: then the same packages give the same bytes
# What was signed before is replaced when all else is there: who reads meanwhile has the old list or the new one.
set -eu
umask 022
refuse() {
    echo "repository.sh: $*" >&2
    exit 1
}
[ $# = 2 ] || { echo 'usage: REPOSITORY=URL KEY=ID board/repository.sh PACKAGES OUT' >&2 && exit 2; }
packages=$1 out=$2
case ${REPOSITORY:-} in
https://?* | http://?* | file:///?*) ;;
*) refuse 'REPOSITORY is the address of the repository, https://..' ;;
esac
for tool in apt-ftparchive gpg; do command -v "$tool" > /dev/null || refuse "needs $tool: apt-get install apt-utils gpg gpg-agent"; done
[ -n "${KEY:-}" ] || refuse 'KEY is the key that signs: a fingerprint or an address'
ls "$packages"/*.deb > /dev/null 2>&1 || refuse "no packages in $packages"
now=${SOURCE_DATE_EPOCH:-$(date +%s)}
gpg() { command gpg --batch --quiet --no-tty ${SOURCE_DATE_EPOCH:+--faked-system-time "$now!"} "$@"; }
gpg --list-secret-keys "$KEY" > /dev/null 2>&1 || refuse "gpg has no secret key $KEY"

# ---- packages: pool/SUITE/NAME, which never change once they are there -----------------------------------
for file in "$packages"/*.deb; do
    name=${file##*/}
    case $name in
    *~deb12_*) suite=bookworm ;;
    *~deb13_*) suite=trixie ;;
    *) refuse "$name is of neither Debian 12 nor 13: its version ends with ~deb12 or ~deb13" ;;
    esac
    dpkg-deb --field "$file" Package > /dev/null 2>&1 || refuse "$name is no package"
    to=$out/pool/$suite/$name
    mkdir -p "${to%/*}"
    [ ! -e "$to" ] || cmp -s "$file" "$to" || refuse "$name is in $out with other content: a change needs a new version"
    cp "$file" "$to.new" && mv "$to.new" "$to"
done

# ---- lists, and their signatures -------------------------------------------------------------------------
cd "$out"
for pool in pool/*; do
    suite=${pool#pool/} list=dists/${pool#pool/}
    new=$list.new
    rm -rf "$new" && mkdir -p "$new"
    arches=$(for file in "$pool"/*.deb; do dpkg-deb --field "$file" Architecture; done | sort -u | tr '\n' ' ')
    for arch in $arches; do
        mkdir -p "$new/main/binary-$arch"
        apt-ftparchive --arch "$arch" packages "$pool" > "$new/main/binary-$arch/Packages"
        gzip -9nk "$new/main/binary-$arch/Packages"
    done
    # Acquire-By-Hash would keep old lists for who reads just now; these are a few kB, and apt tries again
    apt-ftparchive -o APT::FTPArchive::Release::Origin=gnomon -o APT::FTPArchive::Release::Label=gnomon \
        -o "APT::FTPArchive::Release::Suite=$suite" -o "APT::FTPArchive::Release::Codename=$suite" \
        -o "APT::FTPArchive::Release::Architectures=${arches% }" -o APT::FTPArchive::Release::Components=main \
        -o APT::FTPArchive::Release::Description='gnomon: 3-D scenes with true shadows, for kiosks' release "$new" > "$list.Release"
    sed "s/^Date: .*/Date: $(LC_ALL=C date -u -R -d "@$now")/" "$list.Release" > "$new/Release" && rm "$list.Release"
    gpg --local-user "$KEY" --clearsign --output "$new/InRelease" "$new/Release" || refuse "gpg does not sign with $KEY"
    gpg --local-user "$KEY" --armor --detach-sign --output "$new/Release.gpg" "$new/Release"
    rm -rf "$list.old"
    [ ! -d "$list" ] || mv "$list" "$list.old"
    mv "$new" "$list" && rm -rf "$list.old"
    {
        printf 'Types: deb\nURIs: %s\nSuites: %s\nComponents: main\nSigned-By:\n' "${REPOSITORY%/}" "$suite"
        # in a field of several lines an empty one is a dot
        gpg --armor --export "$KEY" | sed 's/^$/./; s/^/ /'
    } > "$suite.sources"
done

#!/bin/sh
# SPDX-License-Identifier: MIT
# cleanroom.sh [COMMAND...] - a minimal Debian root, a clone of this commit in it, and there the README, literally:
# apt-get install make; make run; make test (or the commands given, a line each).  What this machine happens to have
# installed can then hide nothing.  Exit status: 0 passed, 1 failed, 77 no root could be built (the reason is the last line).
#
# Needs root and debootstrap.  The bare root and the packages fetched are kept in $CACHE between runs.
set -u
cd "$(dirname "$0")/../.." || exit 1
commands=${*:-'make run
make test'}
cache=${CACHE:-${XDG_CACHE_HOME:-${HOME:-/root}/.cache}/waveform_iqn_rk}
skip() { echo "clean room: $*"; exit 77; }

[ "$(id -u)" = 0 ] || skip 'not root'
command -v debootstrap >/dev/null || skip 'no debootstrap (Debian: debootstrap)'
command -v git >/dev/null || skip 'no git'
suite=$(. /etc/os-release && echo "${VERSION_CODENAME:-}")
mirror=$(cat /etc/apt/sources.list /etc/apt/sources.list.d/* 2>/dev/null |
    sed -n 's/^URIs: *\([^ ]*debian\)\/* *$/\1/p; s/^deb  *\(\[[^]]*\] *\)\{0,1\}\([^ ]*debian\)\/*  *.*main.*/\2/p' | head -1)
[ -n "$suite" ] && [ -n "$mirror" ] || skip 'this is no Debian: no suite, or no mirror in /etc/apt'

mkdir -p "$cache/packages/partial" || skip "cannot write in $cache"
base=$cache/$suite.tar
root=$(mktemp -d) || exit 1
mounted=''
leave() {
    for place in $mounted; do umount -l "$place" 2>/dev/null; done
    rm -rf --one-file-system "$root"
}
trap leave EXIT
trap 'exit 1' HUP INT TERM

if [ ! -f "$base" ]; then
    echo "clean room: a minimal $suite root"
    debootstrap --variant=minbase "$suite" "$root" "$mirror" >"$cache/debootstrap.log" 2>&1 ||
        skip "debootstrap failed: $(tail -1 "$cache/debootstrap.log")"
    rm -f "$root"/var/cache/apt/archives/*.deb
    tar -C "$root" -cf "$base.new" . && mv "$base.new" "$base"
else
    tar -C "$root" -xf "$base" || skip "the cached root $base cannot be unpacked"
fi

bind() { # bind FROM TO: what programs expect of a running system
    mkdir -p "$root$2" && mount --bind "$1" "$root$2" 2>/dev/null && mounted="$root$2 $mounted"
}
bind /proc /proc || skip 'cannot mount'
bind /dev /dev
bind /dev/shm /dev/shm
bind "$cache/packages" /var/cache/apt/archives
cp /etc/resolv.conf "$root/etc/resolv.conf"
echo "deb $mirror $suite main" >"$root/etc/apt/sources.list"
cp /etc/apt/apt.conf.d/*proxy* "$root/etc/apt/apt.conf.d/" 2>/dev/null

git clone -q . "$root/kit" || exit 1
cat >"$root/readme.sh" <<END
set -e
export DEBIAN_FRONTEND=noninteractive
cd /kit
apt-get update -qq
apt-get install -y -qq make >/dev/null
set -x
$commands
END
env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C TERM=dumb chroot "$root" sh /readme.sh ||
    { echo "clean room: failed in a minimal $suite, $(git rev-parse --short HEAD)"; exit 1; }
echo "clean room: passed in a minimal $suite, $(git rev-parse --short HEAD): $(printf '%s' "$commands" | tr '\n' ';')"

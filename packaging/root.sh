#!/bin/sh
# Makes a root of Debian 12 with nothing but its base and some packages, to try what is installed on a machine without
# Rust. A root that is there already stays as it is.
#
#     sh packaging/root.sh FOLDER [PACKAGE...]
#
# Needs root, and debootstrap; MIRROR names another mirror.
set -eu
root=$1
shift
if [ ! -e "$root/made" ]; then
    packages=$(echo "ca-certificates $*" | tr ' ' ,)
    rm -rf "$root"
    mkdir -p "$root"
    debootstrap --variant=minbase --include="$packages" bookworm "$root" "${MIRROR:-http://deb.debian.org/debian}" > "$root.log" ||
        { tail "$root.log" && exit 1; }
    touch "$root/made"
fi
cp /etc/resolv.conf "$root/etc/"
mkdir -p "$root/try"
cp examples/fig2.sense packaging/outputs.sh "$root/try"

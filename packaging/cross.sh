#!/bin/sh
# Builds the program for another system, and tries it on this machine where that can be done:
#
#     sh packaging/cross.sh x86_64-pc-windows-gnu [PROFILE]      under Wine, if wine64 is there
#     sh packaging/cross.sh aarch64-unknown-linux-gnu [PROFILE]  under qemu-user
#     sh packaging/cross.sh x86_64-unknown-linux-musl [PROFILE]  a static program; by the toolchain of rustup alone
#     sh packaging/cross.sh aarch64-apple-darwin                 compiles only: to link it takes Apple's SDK
#
# What it built is a file in `target/cross`. Needs the linkers of the other systems (Debian: gcc-mingw-w64-x86-64,
# gcc-aarch64-linux-gnu), and either `rustup target add TARGET`, or Debian's rustc-web and rust-web-src, which build the
# standard library as well. Its outputs are compared with those of a program for this machine, which PROGRAM names.
set -eu
cd "$(dirname "$0")/.."
triple=$1
profile=${2:-dist}
target=${CARGO_TARGET_DIR:-$PWD/target}
folder=$profile
[ "$profile" != dev ] || folder=debug
program=${PROGRAM:-$target/$folder/sensedsl}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
ending=
build=build
case $triple in
    x86_64-pc-windows-gnu)
        ending=.exe
        export CARGO_TARGET_X86_64_PC_WINDOWS_GNU_LINKER=x86_64-w64-mingw32-gcc
        ;;
    aarch64-unknown-linux-gnu) export CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_LINKER=aarch64-linux-gnu-gcc ;;
    x86_64-unknown-linux-musl) ;;
    aarch64-apple-darwin | x86_64-apple-darwin) build=check ;;
    *) echo "targets: x86_64-pc-windows-gnu, aarch64-unknown-linux-gnu, x86_64-unknown-linux-musl, aarch64-apple-darwin" && exit 2 ;;
esac

# Of two compilers the one that has a standard library for that system.
if rustup target list --installed 2>/dev/null | grep -qx "$triple"; then
    cargo "$build" --locked --profile "$profile" -p sensedsl --target "$triple"
else
    export RUSTC=/usr/bin/rustc RUSTC_BOOTSTRAP=1
    cargo "$build" --locked -Zbuild-std=std,panic_unwind --profile "$profile" -p sensedsl --target "$triple"
fi
if [ "$build" = check ]; then
    echo "$triple: compiles"
    exit 0
fi
mkdir -p "$target/cross"
file="$target/cross/sensedsl-$triple$ending"
case $triple in
    x86_64-pc-windows-gnu) x86_64-w64-mingw32-strip -o "$file" "$target/$triple/$folder/sensedsl$ending" ;;
    aarch64-unknown-linux-gnu) aarch64-linux-gnu-strip -o "$file" "$target/$triple/$folder/sensedsl" ;;
    *) strip -o "$file" "$target/$triple/$folder/sensedsl" ;;
esac
du -h "$file"

cp examples/fig2.sense "$scratch"
here=$PWD
cd "$scratch"
env -i PATH="$PATH" sh "$here/packaging/outputs.sh" native "$program" > /dev/null
case $triple in
    x86_64-pc-windows-gnu)
        command -v wine > /dev/null || { echo "not tried: there is no Wine" && exit 0; }
        export WINEDEBUG=-all WINEPREFIX="$scratch/wine"
        cp "$file" "$scratch/sensedsl.exe"
        # Wine before version 9 lacks a library that Rust's standard library asks for random numbers.
        x86_64-w64-mingw32-gcc -shared -O1 -o "$scratch/bcryptprimitives.dll" "$here/packaging/bcryptprimitives.c" -ladvapi32
        wineboot --init > wineboot.log 2>&1 || true
        sh "$here/packaging/outputs.sh" outputs wine sensedsl.exe
        sh "$here/packaging/tcp.sh" "$program" wine sensedsl.exe
        ;;
    aarch64-unknown-linux-gnu) sh "$here/packaging/outputs.sh" outputs qemu-aarch64-static -L /usr/aarch64-linux-gnu "$file" ;;
    *) env -i PATH="$PATH" sh "$here/packaging/outputs.sh" outputs "$file" ;;
esac
diff -r native outputs
echo "$triple: the same bytes as on this machine"

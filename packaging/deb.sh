#!/bin/sh
# Builds the package for Debian and Ubuntu into `target/debian`, and tries what is in it: Fig. 2 is wired.
#
#     sh packaging/deb.sh
#
# Needs `dpkg`, and cargo-deb, which is installed if it is missing.
set -eu
cd "$(dirname "$0")/.."
target=${CARGO_TARGET_DIR:-$PWD/target}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cargo_deb=3.7.0

cargo build --locked --profile dist -p sensedsl
sh packaging/share.sh "$target/dist/sensedsl" packaging/wheel/data/share
[ "$(cargo deb --version 2>/dev/null)" = "$cargo_deb" ] ||
    cargo install --locked --quiet --debug --version "$cargo_deb" cargo-deb
rm -rf "$target/debian"
cargo deb --no-build --profile dist -p sensedsl --output "$target/debian/"

package=$(echo "$target"/debian/*.deb)
dpkg-deb --info "$package"
dpkg --dry-run --install "$package"
dpkg-deb --extract "$package" "$scratch"
env -i "$scratch/usr/bin/sensedsl" solve examples/fig2.sense | grep 'proved optimal'
test -f "$scratch/usr/share/man/man1/sensedsl.1.gz"
test -f "$scratch/usr/share/bash-completion/completions/sensedsl"
test -f "$scratch/usr/share/doc/sensedsl/copyright"
du -h "$package"

#!/bin/sh
# Runs a command of cargo so that no path of this machine gets into what it builds: for all that is handed out.
#
#     sh packaging/plain-paths.sh cargo build --locked --profile dist -p sensedsl
set -eu
cd "$(dirname "$0")/.."
home=${CARGO_HOME:-$HOME/.cargo}
sysroot=$(rustc --print sysroot)
flags="--remap-path-prefix=$PWD=/sensedsl --remap-path-prefix=$home=/cargo --remap-path-prefix=$sysroot=/rust"
[ -z "${CARGO_TARGET_DIR:-}" ] || flags="$flags --remap-path-prefix=$CARGO_TARGET_DIR=/target"
RUSTFLAGS="${RUSTFLAGS:-} $flags" exec "$@"

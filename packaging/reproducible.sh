#!/bin/sh
# Whether the program comes out the same, byte for byte, in two different folders with two different homes of cargo:
#
#     sh packaging/reproducible.sh [PROFILE]
#
# PROFILE is cargo's, `dist` unless you say: twice what that takes. Needs no network once cargo has the crates. Sources
# are those of the last commit.
set -eu
cd "$(dirname "$0")/.."
profile=${1:-dist}
folder_of_profile=$profile
[ "$profile" != dev ] || folder_of_profile=debug
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
home=${CARGO_HOME:-$HOME/.cargo}

# built NAME: a copy of the commit, built with a home of cargo of its own, without any path of this machine.
built() {
    folder="$scratch/$1/sources-of-$1"
    mkdir -p "$folder" "$scratch/$1/home/registry"
    git archive HEAD | tar -xf - -C "$folder"
    cp -r "$home/registry/index" "$home/registry/cache" "$scratch/$1/home/registry/"
    (cd "$folder" && CARGO_HOME="$scratch/$1/home" CARGO_TARGET_DIR="$scratch/$1/target" CARGO_INCREMENTAL=0 sh packaging/plain-paths.sh \
        cargo build --locked --offline --quiet --profile "$profile" -p sensedsl)
    cp "$scratch/$1/target/$folder_of_profile/sensedsl" "$scratch/$1.program"
    if grep -q "$scratch\|$HOME" "$scratch/$1.program"; then
        echo "the program has paths of this machine" && exit 1
    fi
    rm -rf "${scratch:?}/$1"
}

built one
built another
cmp "$scratch/one.program" "$scratch/another.program"
sha256sum "$scratch/one.program" | cut -d ' ' -f 1
echo "the same bytes in both folders"

#!/bin/sh
# Builds the Python wheel and the source distribution into `target/wheels`, and tries the wheel in an environment of its
# own: Fig. 2 is wired, and its picture drawn.
#
#     sh packaging/wheel.sh [PROFILE]
#
# PROFILE is cargo's: `dist`, or `release`, which is built sooner. `OLD_GLIBC=1` builds for glibc 2.17 with the compiler
# of Zig. `ROOT=FOLDER` installs it in a bare Debian 12, which is made there, as well; `SDIST=1` has pip build the source
# distribution. Needs Python with `venv` and what compiles the program. Says how long it took and how large it is.
set -eu
cd "$(dirname "$0")/.."
profile=${1:-dist}
target=${CARGO_TARGET_DIR:-$PWD/target}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

cargo build --locked --profile "$profile" -p sensedsl
sh packaging/share.sh "$target/$profile/sensedsl" packaging/wheel/data/share
if [ ! -x "$target/maturin/bin/maturin" ]; then
    python3 -m venv "$target/maturin"
    "$target/maturin/bin/pip" install --quiet --disable-pip-version-check 'maturin>=1.9,<2'
fi
rm -rf "$target/wheels"
if [ -n "${OLD_GLIBC:-}" ]; then
    "$target/maturin/bin/pip" install --quiet --disable-pip-version-check ziglang
    PATH="$target/maturin/bin:$PATH" maturin build --locked --profile "$profile" --zig --compatibility manylinux2014 \
        --target x86_64-unknown-linux-gnu --out "$target/wheels"
else
    "$target/maturin/bin/maturin" build --locked --profile "$profile" --out "$target/wheels"
fi
"$target/maturin/bin/maturin" sdist --out "$target/wheels"
sh packaging/sdist.sh "$target"/wheels/*.tar.gz

cp examples/fig2.sense "$scratch"
(cd "$scratch" && env -i PATH="$PATH" sh "$OLDPWD/packaging/outputs.sh" native "$target/$profile/sensedsl")

# installed FOLDER FILE: a fresh environment with it, and the outputs of what is in there.
installed() {
    python3 -m venv "$scratch/$1"
    began=$(date +%s)
    "$scratch/$1/bin/pip" install --quiet --disable-pip-version-check "$2"
    (cd "$scratch" && env -i PATH=/usr/bin:/bin sh "$OLDPWD/packaging/outputs.sh" "of-$1" "$scratch/$1/bin/sensedsl")
    echo "$(basename "$2"), from the file to the outputs: $(($(date +%s) - began)) s"
    diff -r "$scratch/native" "$scratch/of-$1"
    env -i "$scratch/$1/bin/python" -m sensedsl solve "$scratch/fig2.sense" | grep 'proved optimal'
    test -f "$scratch/$1/share/man/man1/sensedsl.1"
    test -f "$scratch/$1/share/bash-completion/completions/sensedsl"
}

installed wheel "$(echo "$target"/wheels/*.whl)"
if [ -n "${SDIST:-}" ]; then
    installed sdist "$(echo "$target"/wheels/*.tar.gz)"
fi
if [ -n "${ROOT:-}" ]; then
    sh packaging/root.sh "$ROOT" python3 python3-venv
    cp "$target"/wheels/*.whl "$ROOT/try"
    # It is the shell in the root that expands.
    # shellcheck disable=SC2016
    chroot "$ROOT" sh -euc 'cd /try && rm -rf venv && python3 -m venv venv && began=$(date +%s) &&
        venv/bin/pip install --quiet --disable-pip-version-check --no-index ./*.whl &&
        sh outputs.sh outputs venv/bin/sensedsl &&
        echo "in a bare Debian, from the wheel to the outputs: $(($(date +%s) - began)) s"'
    diff -r "$scratch/native" "$ROOT/try/outputs"
    rm "$ROOT"/try/*.whl
fi
du -h "$target"/wheels/*

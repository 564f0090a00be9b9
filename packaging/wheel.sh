#!/bin/sh
# Builds the Python wheel and the source distribution into `target/wheels`, and tries the wheel in an environment of its
# own: Fig. 2 is wired, and its picture drawn.
#
#     sh packaging/wheel.sh
#
# Needs Python with `venv` and what compiles the program. Says how long it took and how large it is.
set -eu
cd "$(dirname "$0")/.."
target=${CARGO_TARGET_DIR:-$PWD/target}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

cargo build --locked --profile dist -p sensedsl
sh packaging/share.sh "$target/dist/sensedsl" packaging/wheel/data/share
python3 -m venv "$scratch/build"
"$scratch/build/bin/pip" install --quiet --disable-pip-version-check 'maturin>=1.9,<2'
rm -rf "$target/wheels"
"$scratch/build/bin/maturin" build --locked --out "$target/wheels"
"$scratch/build/bin/maturin" sdist --out "$target/wheels"

python3 -m venv "$scratch/try"
began=$(date +%s)
"$scratch/try/bin/pip" install --quiet --disable-pip-version-check --no-index "$target"/wheels/*.whl
cp examples/fig2.sense "$scratch"
cd "$scratch"
env -i "$scratch/try/bin/sensedsl" solve fig2.sense --format svg > fig2.svg
env -i "$scratch/try/bin/python" -m sensedsl solve fig2.sense | grep 'proved optimal'
grep -q '<svg' fig2.svg
test -f "$scratch/try/share/man/man1/sensedsl.1"
test -f "$scratch/try/share/bash-completion/completions/sensedsl"
echo "from the wheel to the picture: $(($(date +%s) - began)) s"
du -h "$target"/wheels/*

#!/bin/sh
# Writes the bill of materials of the program, in CycloneDX: each crate that it is made of, with version, licence and
# checksum.
#
#     sh packaging/sbom.sh FILE.cdx.json
#
# Needs cargo-cyclonedx, which is installed if it is missing. It writes beside manifests, so it works on a copy.
set -eu
into=$1
cd "$(dirname "$0")/.."
cyclonedx=0.5.9
[ "$(cargo cyclonedx --version 2>/dev/null)" = "cargo-cyclonedx-cyclonedx $cyclonedx" ] ||
    cargo install --locked --quiet --debug --version "$cyclonedx" cargo-cyclonedx
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
git archive HEAD | tar -xf - -C "$scratch"
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct) cargo cyclonedx --quiet --manifest-path "$scratch/crates/sensedsl/Cargo.toml" \
    --format json --spec-version 1.5 --target x86_64-unknown-linux-gnu --override-filename sbom
# What the tool does not know to be a path of this machine.
sed "s,$scratch,/sensedsl,g" "$scratch/crates/sensedsl/sbom.json" > "$into"
grep -q '"bomFormat": *"CycloneDX"' "$into"
echo "$(grep -c '"purl"' "$into") components"

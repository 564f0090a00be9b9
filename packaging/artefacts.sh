#!/bin/sh
# Builds all that a release hands out into a folder, each tried as far as this machine can, with checksums and a bill of
# materials: `cargo xtask release VERSION --artefacts FOLDER` calls it.
#
#     sh packaging/artefacts.sh FOLDER
#
# REPOSITORY is the address of the project, which the manifests for package managers name. Takes an hour or more; needs
# root for the bare Debians, and what the scripts that are called here need.
set -eu
into=$1
cd "$(dirname "$0")/.."
version=$(sed -n '/^\[workspace.package\]/,/^$/s/^version = "\(.*\)"/\1/p' Cargo.toml)
target=${CARGO_TARGET_DIR:-$PWD/target}
REPOSITORY=${REPOSITORY:-https://example.org/sensedsl}
downloads="$REPOSITORY/releases/download/v$version"
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
export SOURCE_DATE_EPOCH
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir -p "$into"

# archived TRIPLE PROGRAM: licences and program in an archive whose bytes depend on nothing else.
archived() {
    name="sensedsl-$version-$1"
    mkdir -p "$scratch/$name"
    cp LICENSE-APACHE LICENSE-MIT README.md CHANGELOG.md "$scratch/$name"
    case $1 in
        *windows*)
            cp "$2" "$scratch/$name/sensedsl.exe"
            find "$scratch/$name" -exec touch -d "@$SOURCE_DATE_EPOCH" {} +
            rm -f "$into/$name.zip"
            (cd "$scratch/$name" && TZ=UTC zip -q -X "$into/$name.zip" LICENSE-APACHE LICENSE-MIT README.md CHANGELOG.md sensedsl.exe)
            ;;
        *)
            cp "$2" "$scratch/$name/sensedsl"
            (cd "$scratch" && tar --sort=name --owner=0 --group=0 --numeric-owner --mtime="@$SOURCE_DATE_EPOCH" -cf - "$name") |
                gzip -n > "$into/$name.tgz"
            ;;
    esac
}

git archive --prefix="sensedsl-$version/" HEAD | gzip -n > "$into/sensedsl-$version.tar.gz"

sh packaging/plain-paths.sh cargo build --locked --profile dist -p sensedsl
archived x86_64-unknown-linux-gnu "$target/dist/sensedsl"
sh packaging/plain-paths.sh sh packaging/deb.sh
cp "$target"/debian/*.deb "$into"
for triple in x86_64-pc-windows-gnu aarch64-unknown-linux-gnu x86_64-unknown-linux-musl; do
    sh packaging/plain-paths.sh sh packaging/cross.sh "$triple"
    archived "$triple" "$(echo "$target/cross/sensedsl-$triple"*)"
done
sh packaging/plain-paths.sh env OLD_GLIBC=1 sh packaging/wheel.sh
cp "$target"/wheels/*.whl "$target"/wheels/*.tar.gz "$into"
sh packaging/reproducible.sh
sh packaging/sbom.sh "$into/sensedsl-$version.cdx.json"

# filled TEMPLATE: with versions, addresses and checksums in place of what is between `@`.
filled() {
    name=$(basename "$1")
    sed "s,@VERSION@,$version,g; s,@REPOSITORY@,$REPOSITORY,g; s,@DOWNLOADS@,$downloads,g" "$1" > "$scratch/$name"
    sed -n 's/.*@SHA256 \([^@]*\)@.*/\1/p' "$scratch/$name" | while read -r file; do
        sum=$(sha256sum "$into/$file" | cut -d ' ' -f 1)
        sed -i "s,@SHA256 $file@,$sum,; /^# For .* fills in/d" "$scratch/$name"
    done
    if grep "@[A-Z]" "$scratch/$name"; then
        exit 1
    fi
    cp "$scratch/$name" "$into/$name"
}

for template in packaging/templates/*; do
    filled "$template"
done
rm -f "$into/SHA256SUMS"
(cd "$into" && find . -maxdepth 1 -type f -printf '%f\n' | LC_ALL=C sort | xargs sha256sum) > "$scratch/SHA256SUMS"
cp "$scratch/SHA256SUMS" "$into"
cat "$into/SHA256SUMS"

#!/bin/sh
# Builds the package for Debian and Ubuntu into `target/debian`, and tries it: lintian reads it, and with `ROOT=FOLDER` it
# is installed in a bare Debian 12, which is made there.
#
#     sh packaging/deb.sh [PROFILE]
#
# PROFILE is cargo's, `dist` unless you say. Needs `dpkg`, and cargo-deb, which is installed if it is missing; lintian is
# used if it is there.
set -eu
cd "$(dirname "$0")/.."
profile=${1:-dist}
target=${CARGO_TARGET_DIR:-$PWD/target}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cargo_deb=3.7.0

cargo build --locked --profile "$profile" -p sensedsl
sh packaging/share.sh "$target/$profile/sensedsl" packaging/wheel/data/share
sh packaging/changelog.sh > packaging/changelog.Debian
[ "$(cargo deb --version 2>/dev/null)" = "$cargo_deb" ] ||
    cargo install --locked --quiet --debug --version "$cargo_deb" cargo-deb
rm -rf "$target/debian"
mkdir -p "$target/debian"
cargo deb --no-build --profile "$profile" -p sensedsl --output "$target/debian/"

package=$(echo "$target"/debian/*.deb)
dpkg-deb --info "$package"
cp examples/fig2.sense "$scratch"
(cd "$scratch" && sh "$OLDPWD/packaging/outputs.sh" native "$target/$profile/sensedsl")
dpkg-deb --extract "$package" "$scratch/package"
(cd "$scratch" && env -i PATH=/usr/bin:/bin sh "$OLDPWD/packaging/outputs.sh" outputs "$scratch/package/usr/bin/sensedsl")
diff -r "$scratch/native" "$scratch/outputs"
for file in man/man1/sensedsl.1.gz bash-completion/completions/sensedsl zsh/vendor-completions/_sensedsl \
    fish/vendor_completions.d/sensedsl.fish doc/sensedsl/copyright doc/sensedsl/changelog.Debian.gz; do
    test -f "$scratch/package/usr/share/$file"
done
if command -v lintian > /dev/null; then
    # It is no upload to Debian, which would close a bug.
    lintian --tag-display-limit 0 --suppress-tags initial-upload-closes-no-bugs --fail-on error,warning "$package"
fi
if [ -n "${ROOT:-}" ]; then
    sh packaging/root.sh "$ROOT" man-db bash-completion
    cp "$package" "$ROOT/try"
    # It is the shell in the root that expands.
    # shellcheck disable=SC2016
    chroot "$ROOT" sh -euc 'cd /try && began=$(date +%s) && apt-get install -y -qq --no-install-recommends ./*.deb > log &&
        sh outputs.sh outputs sensedsl && echo "in a bare Debian, from the package to the outputs: $(($(date +%s) - began)) s" &&
        man -w sensedsl-solve && bash -c ". /usr/share/bash-completion/completions/sensedsl && complete -p sensedsl" &&
        apt-get remove -y -qq sensedsl > log && ! command -v sensedsl'
    diff -r "$scratch/native" "$ROOT/try/outputs"
    rm "$ROOT"/try/*.deb
fi
du -h "$package"

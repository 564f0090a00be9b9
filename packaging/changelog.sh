#!/bin/sh
# Prints the changelog of the Debian package: which version it is, dated as the release is in `CITATION.cff`, or as the
# last commit.
set -eu
cd "$(dirname "$0")/.."
version=$(sed -n '/^\[workspace.package\]/,/^$/s/^version = "\(.*\)"/\1/p' Cargo.toml)
released=$(sed -n 's/^date-released: *//p' CITATION.cff)
if [ -n "$released" ]; then
    date=$(LC_ALL=C date -Ru -d "$released")
else
    date=$(LC_ALL=C date -Ru -d "@${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct)}")
fi
cat <<END
sensedsl ($version-1) unstable; urgency=low

  * CHANGELOG.md of the sources says what has changed.

 -- The SenseDSL contributors <sensedsl@example.org>  $date
END

#!/bin/sh
# Whether a source distribution has what its build reads: every file of the crates that the program is made of, the
# licences, and nothing of what the repository ignores.
#
#     sh packaging/sdist.sh FILE.tar.gz
set -eu
cd "$(dirname "$0")/.."
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
tar -tzf "$1" | sed 's,^[^/]*/,,' | sort > "$scratch/there"
for file in Cargo.lock Cargo.toml LICENSE-APACHE LICENSE-MIT PKG-INFO README.md pyproject.toml; do
    grep -qx "$file" "$scratch/there" || { echo "$1 lacks $file" && exit 1; }
done
# The crates that are there are whole, but for what only their tests read.
grep -o '^crates/[^/]*/' "$scratch/there" | sort -u > "$scratch/crates"
while read -r crate; do
    git ls-files -- "$crate" | grep -v "^$crate\(tests\|benches\|examples\)/" | grep -v '/tests/\|/tests\.rs$' || true
done < "$scratch/crates" | sort > "$scratch/wanted"
comm -23 "$scratch/wanted" "$scratch/there" > "$scratch/missing"
if [ -s "$scratch/missing" ]; then
    echo "$1 lacks $(wc -l < "$scratch/missing") files, such as:" && head -5 "$scratch/missing" && exit 1
fi
if grep -q '^target/\|node_modules/\|^\.git/' "$scratch/there"; then
    echo "$1 has what was built" && exit 1
fi
echo "$(wc -l < "$scratch/there") files in $(wc -l < "$scratch/crates") crates"

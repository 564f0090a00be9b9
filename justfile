# Short names for what is done often; `just` lists them. CONTRIBUTING.md says more.

_list:
    @just --list

# Everything that a change must pass
ci:
    bash .ci/run

# The tests of one crate, and its lints
crate name:
    cargo test -p {{ name }}
    cargo clippy -p {{ name }} --all-targets -- -D warnings

# All tests that need nothing but Rust
test:
    cargo test --workspace

# Writes what tests compare with; look at the difference
bless:
    cargo xtask bless

# The studio on this machine
studio folder=".":
    cargo xtask studio
    cargo run --release -- studio {{ folder }} --site target/web/studio --open

//! Packs the files that are part of the program.

fn main() -> std::io::Result<()> {
    sensedsl_packed::build(&["boards", "forms", "silicon", "targets"], &["csv", "toml"])
}

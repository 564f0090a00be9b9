//! Packs the files that are part of the program.

fn main() -> std::io::Result<()> {
    sensedsl_packed::build(&["drivers"], &["csv", "sense"])
}

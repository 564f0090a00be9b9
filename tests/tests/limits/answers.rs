//! Earlier answers and certificates.

use rustix::fs::{CWD, FileType, Mode, mknodat};
use sensedsl_tests::{Scratch, root, verifier};

use super::{expect, expect_of, sparse};

#[test]
fn answers_to_keep() {
    let folder = Scratch::new("limits");
    let design = root().join("examples/fig2.sense");
    let design = design.to_str().unwrap();
    folder.write("nested.json", "[".repeat(100_000));
    expect(&folder, &["solve", "--keep", "nested.json", design], NOT_KEPT, "E0");
    sparse(&folder, "large.json", 60_000_000);
    expect(&folder, &["solve", "--keep", "large.json", design], 2, "E0112");
    folder.write("zeros.json", format!("[{}0]", "0,".repeat(1_000_000)));
    expect(&folder, &["solve", "--keep", "zeros.json", design], NOT_KEPT, "E0");
}

/// The status where an answer is not one.
const NOT_KEPT: i32 = 2;

#[test]
fn certificates() {
    let folder = Scratch::new("limits");
    sparse(&folder, "large.json", 60_000_000);
    folder.write("nested.json", format!("{{\"format\":{}", "[".repeat(100_000)));
    let digits = "9".repeat(1_000_000);
    let number = format!("{{\"format\":\"SenseDSL certificate 1\",\"problem\":{digits}}}");
    folder.write("number.json", number);
    mknodat(CWD, folder.join("pipe"), FileType::Fifo, Mode::RWXU, 0).unwrap();
    for name in ["large.json", "nested.json", "number.json", "pipe"] {
        expect_of(verifier(), &folder, &[name], 2, "");
    }
}

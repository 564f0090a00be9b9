//! Earlier answers and certificates.

use rustix::fs::{CWD, FileType, Mode, mknodat};
use sensedsl_tests::{TempDir, is_thorough, root, verifier};

use super::{expect, expect_of, sparse};

#[test]
fn answers_to_keep() {
    let folder = TempDir::new("limits");
    let design = root().join("examples/fig2.sense");
    let design = design.to_str().unwrap();
    folder.write("nested.json", "[".repeat(100_000));
    expect(&folder, &["solve", "--keep", "nested.json", design], NOT_KEPT, "E0");
    sparse(&folder, "large.json", 60_000_000);
    expect(&folder, &["solve", "--keep", "large.json", design], 2, "E0112");
    folder.write("zeros.json", format!("[{}0]", "0,".repeat(1_000_000)));
    expect(&folder, &["solve", "--keep", "zeros.json", design], NOT_KEPT, "E0");
}

/// The exit status if an answer cannot be kept.
const NOT_KEPT: i32 = 2;

#[test]
fn certificates() {
    let folder = TempDir::new("limits");
    sparse(&folder, "large.json", 60_000_000);
    folder.write("nested.json", format!("{{\"format\":{}", "[".repeat(100_000)));
    let digits = "9".repeat(1_000_000);
    let number = format!("{{\"format\":\"SenseDSL certificate 4\",\"problem\":{digits}}}");
    folder.write("number.json", number);
    mknodat(CWD, folder.join("pipe"), FileType::Fifo, Mode::RWXU, 0).unwrap();
    for name in ["large.json", "nested.json", "number.json", "pipe"] {
        expect_of(verifier(), &folder, &[name], 2, "");
    }
}

/// A subject without any files.
const SUBJECT: &str = r#"{"tool":"","options":{},"files":{},"built_in":{}}"#;

/// A certificate which claims that there is no wiring.
fn certificate(devices: &str, dma: &str, swaps: &str, steps: &str) -> String {
    let problem = format!(
        r#"{{"boards":{{"B":false}},"pins":{{"PA1":1}},"shared":[],"dma":{{{dma}}},"devices":{{{devices}}}}}"#
    );
    format!(
        r#"{{"format":"SenseDSL certificate 4","subject":{SUBJECT},"problem":{problem},"answer":null,
        "search":{{"weights":[1000,100,10,1,1],"facilities":[],"covers":[],"swaps":[{swaps}],"steps":[{steps}]}}}}"#
    )
}

/// A step that removes nothing, but has to check everything.
const STEP: &str = r#"{"narrowed":{"scale":1}}"#;

fn alternative(roles: &str) -> String {
    format!(r#"{{"board":"B","claims":{{}},"violates":[],"dma":[],"roles":{{{roles}}}}}"#)
}

/// A device with this number of candidates for its one wire, and the alternatives in `more`.
fn device(name: &str, candidates: usize, more: &str) -> String {
    let candidate = |at| {
        format!(
            r#""c{at}":{{"pin":"PA1","holder":"g","signal":"s{at}","claims":{{}},"violates":[],"moved":false}}"#
        )
    };
    let all: Vec<String> = (0..candidates).map(candidate).collect();
    format!(r#""{name}":{{"a":{}{more}}}"#, alternative(&format!(r#""r":{{{}}}"#, all.join(","))))
}

#[test]
fn certificates_of_many_steps_and_choices() {
    if !is_thorough() {
        return;
    }
    let folder = TempDir::new("limits");
    let refused = |text: &str, status, why| {
        folder.write("proof.json", text);
        expect_of(verifier(), &folder, &["proof.json"], status, why);
    };
    // Each step goes through all choices.
    let steps = vec![STEP; 50_000].join(",");
    refused(&certificate(&device("a", 4_000, ""), "", "", &steps), 1, "longer");
    // Each swap is compared with all choices of all devices.
    let alike: Vec<String> = (0..800).map(|at| device(&format!("d{at}"), 90, "")).collect();
    let swaps = vec![r#"{"devices":[0,1]}"#; 20_000].join(",");
    refused(&certificate(&alike.join(","), "", &swaps, STEP), 1, "longer");
    let requests = vec![r#"["a"]"#; 1_000_000].join(",");
    refused(&certificate("", &format!(r#""u":[{requests}]"#), "", STEP), 2, "lists");
}

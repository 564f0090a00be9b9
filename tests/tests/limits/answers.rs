//! Earlier answers and certificates.

use rustix::fs::{CWD, FileType, Mode, mknodat};
use sensedsl_tests::{Scratch, root, verifier};

use super::{expect, expect_of, repeat, sparse};

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
    let number = format!("{{\"format\":\"SenseDSL certificate 4\",\"problem\":{digits}}}");
    folder.write("number.json", number);
    mknodat(CWD, folder.join("pipe"), FileType::Fifo, Mode::RWXU, 0).unwrap();
    for name in ["large.json", "nested.json", "number.json", "pipe"] {
        expect_of(verifier(), &folder, &[name], 2, "");
    }
}

/// Nothing that it could be of.
const SUBJECT: &str = r#"{"tool":"","options":{},"files":{},"built_in":{}}"#;

/// A certificate that claims that there is no wiring.
fn certificate(devices: &str, dma: &str, nodes: &str) -> String {
    let problem = format!(
        r#"{{"boards":{{"B":false}},"pins":{{"PA1":1}},"shared":[],"dma":{{{dma}}},"devices":{{{devices}}}}}"#
    );
    let weights = r#"{"moved":0,"violated":0,"shared":0,"cost":0,"spares":0}"#;
    format!(
        r#"{{"format":"SenseDSL certificate 4","subject":{SUBJECT},"problem":{problem},"answer":null,"proofs":[
        {{"of":"existence","weights":{weights},"nodes":[{nodes}]}}]}}"#
    )
}

const LEAF: &str = r#"{"leaf":{"scale":1,"prices":{},"tolls":{}}}"#;

fn alternative(roles: &str) -> String {
    format!(r#"{{"board":"B","claims":{{}},"violates":[],"dma":[],"roles":{{{roles}}}}}"#)
}

/// A device with so many candidates for its one wire, and `more` alternatives.
fn device(name: &str, candidates: usize, more: &str) -> String {
    let candidate = |at| {
        format!(
            r#""c{at}":{{"pin":"PA1","holder":"g","signal":"s","claims":{{}},"violates":[],"moved":false}}"#
        )
    };
    let all: Vec<String> = (0..candidates).map(candidate).collect();
    format!(r#""{name}":{{"a":{}{more}}}"#, alternative(&format!(r#""r":{{{}}}"#, all.join(","))))
}

#[test]
fn certificates_of_many_cases_and_choices() {
    let folder = Scratch::new("limits");
    let refused = |text: &str, status, why| {
        folder.write("proof.json", text);
        expect_of(verifier(), &folder, &["proof.json"], status, why);
    };
    // Each case goes through all choices, and a device without any makes all leaves true.
    let n = 15_000;
    let case = |leaf: bool, at: usize| {
        let (last, leaf_at) = (at + 1 == n, n + at);
        let then = if last { 2 * n } else { at + 1 };
        let (kept, violated) = if leaf { (then, leaf_at) } else { (leaf_at, then) };
        format!(r#"{{"rule":{{"rule":"x{at}","kept":{kept},"violated":{violated}}}}},"#)
    };
    let leaves = vec![LEAF; n + 1].join(",");
    let devices = format!(r#"{},"z":{{}}"#, device("a", 1_000, ""));
    for leaf_first in [true, false] {
        let nodes = repeat(n, |at| case(leaf_first, at));
        refused(&certificate(&devices, "", &format!("{nodes}{leaves}")), 1, "longer");
    }
    // Devices that are alike but for their last alternative.
    let last = |at| format!(r#","z{at}":{}"#, alternative(""));
    let alike: Vec<String> = (0..800).map(|at| device(&format!("d{at}"), 90, &last(at))).collect();
    refused(&certificate(&alike.join(","), "", LEAF), 1, "leaf 0");
    let requests = vec![r#"["a"]"#; 1_000_000].join(",");
    refused(&certificate("", &format!(r#""u":[{requests}]"#), LEAF), 2, "lists");
}

//! Designs made of chance: enough of them get through, or the fuzzer would try the messages alone.
#![expect(clippy::disallowed_methods, reason = "a test asks the environment how much is wanted")]

use std::collections::BTreeSet;

use sensedsl_fuzzed::reached::{Stage, percent};
use sensedsl_fuzzed::{design, pipeline};
use sensedsl_model::kind::KindName;

#[test]
fn every_kind_is_drawn() {
    let drawn: BTreeSet<&str> = design::kinds().into_iter().collect();
    let all: BTreeSet<&str> = KindName::ALL.map(KindName::name).into();
    assert_eq!(drawn, all, "KINDS of tests/fuzz/src/design/words.rs");
}

#[test]
fn a_third_of_the_designs_reach_generate() {
    let is_thorough = std::env::var("SENSEDSL_THOROUGH").is_ok();
    // Few are certified, and short texts get less far: a quick run sees that the longer stages are reached at all.
    let (designs, generate, files) = if is_thorough { (200, 31, 12) } else { (60, 20, 5) };
    let mut state = 0x9E37_79B9_7F4A_7C15_u64;
    let mut byte = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 32) as u8
    };
    for number in 0..designs {
        let bytes: Vec<u8> = (0..40 + number).map(|_| byte()).collect();
        pipeline::run(&bytes);
    }
    let reached = [Stage::Generate, Stage::Files, Stage::Certified].map(percent);
    assert!(reached[0] >= generate, "{} % reach generate", reached[0]);
    assert!(reached[1] >= files, "{} % give files", reached[1]);
    assert!(reached[2] >= 1 || !is_thorough, "{} % are certified", reached[2]);
}

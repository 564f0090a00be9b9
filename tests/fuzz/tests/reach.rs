//! Designs made of chance: enough of them get through, or the fuzzer would try the messages alone.

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
    let designs = if std::env::var("SENSEDSL_THOROUGH").is_ok() { 200 } else { 60 };
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
    assert!(percent(Stage::Generate) > 30, "{} % reach generate", percent(Stage::Generate));
    assert!(percent(Stage::Files) >= 12, "{} % give files", percent(Stage::Files));
    assert!(percent(Stage::Certified) >= 1, "{} % are certified", percent(Stage::Certified));
}

//! The fuzzer's entry: inputs from libFuzzer in, to the target that `SENSEDSL_FUZZ_TARGET` names.
//!
//! One program for all targets: they share nearly all of their code, and linking it once is quicker.
#![allow(clippy::disallowed_methods, reason = "what the macro of the engine makes writes files")]
#![no_main]

use std::sync::OnceLock;

use libfuzzer_sys::fuzz_target;
use sensedsl_fuzzed::{Target, reached, target};

unsafe extern "C" {
    fn atexit(last: extern "C" fn()) -> i32;
}

extern "C" fn record() {
    if let Some(report) = reached::report() {
        eprintln!("stages: {report}");
    }
}

fn chosen() -> Target {
    static CHOSEN: OnceLock<Target> = OnceLock::new();
    *CHOSEN.get_or_init(|| {
        // SAFETY: `record` takes nothing, gives nothing and does not unwind.
        unsafe { atexit(record) };
        #[expect(clippy::disallowed_methods, reason = "the runner names the target")]
        let name = std::env::var("SENSEDSL_FUZZ_TARGET").unwrap_or_default();
        target(&name).unwrap_or_else(|| panic!("SENSEDSL_FUZZ_TARGET={name} is not a target"))
    })
}

fuzz_target!(|bytes: &[u8]| (chosen().body)(bytes));

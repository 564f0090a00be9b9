//! Compiles the decoders in C and C++ as the fuzzer wants them: with coverage, and with the address
//! and undefined-behaviour sanitizers, whose runtime is linked into the fuzzer.

use std::path::Path;

/// What the sanitizers look for; a finding ends the program.
const SANITIZERS: [&str; 4] = [
    "-fsanitize=address,undefined",
    "-fno-sanitize-recover=all",
    "-fsanitize=fuzzer-no-link",
    // Frames are made by the target; what bytes are compared with is known to it, and the calls
    // that would tell cost more than the decoders.
    "-fno-sanitize-coverage=trace-cmp",
];

fn main() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let (core, cpp) =
        (root.join("crates/firmware-c/runtime"), root.join("crates/host-cpp/runtime"));
    let mut c = cc::Build::new();
    c.compiler("clang").file("src/decode.c").file(core.join("up_decode.c"));
    for name in ["up_encode.c", "up_health.c", "up_memo.c", "up_schema.c", "up_wire.c"] {
        c.file(core.join(name));
    }
    c.include(&core).opt_level(2);
    for flag in SANITIZERS {
        c.flag(flag);
    }
    c.compile("sense_decode_c");
    let mut host = cc::Build::new();
    host.cpp(true).compiler("clang++").file("src/decode.cpp").include(&cpp).opt_level(2);
    host.std("c++98").flag("-Wno-long-long");
    for flag in SANITIZERS {
        host.flag(flag);
    }
    host.compile("sense_decode_cpp");
    println!("cargo::rustc-link-arg-bins=-fsanitize=address,undefined");
    println!("cargo::rustc-link-arg-bins=-fsanitize-link-c++-runtime");
    for folder in [core, cpp] {
        println!("cargo::rerun-if-changed={}", folder.display());
    }
    println!("cargo::rerun-if-changed=src");
}

//! Configurations of `monitor` that are too large, or would take much memory.

use sensedsl_tests::{TempDir, binary};

use super::expect_of;

const BOARD: &str =
    "board STM32F407G_DISC1 { sensor Turns returns int32 { id = 1; type = encoder; } }";

#[track_caller]
fn refused(config: &str, code: &str) {
    let folder = TempDir::new("configurations");
    let _ = folder.write("board.sense", BOARD);
    let _ = folder.write("a.toml", config);
    let call = ["monitor", "simulate", "board.sense", "--config", "a.toml"];
    let _ = expect_of(binary(), &folder, &call, 2, code);
}

#[test]
fn tables_lists_and_bytes_without_end() {
    let heads: String = (0..20_000).map(|at| format!("[a{at}]\n")).collect();
    refused(&heads, "E0560");
    refused(&format!("a = {}1{}", "[".repeat(60_000), "]".repeat(60_000)), "E0560");
    refused(&format!("[{}a]\n", "a.".repeat(100_000)), "E0560");
    refused(&"[[boards]]\n".repeat(20_000), "E0560");
    refused(&format!("[mqtt]\n{}", "# nothing\n".repeat(60_000)), "E0112");
    let devices: String = (0..900).map(|at| format!("[devices.D{at}]\n")).collect();
    refused(&format!("[mqtt]\n{devices}"), "E0561");
}

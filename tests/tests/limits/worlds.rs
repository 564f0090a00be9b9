//! Worlds of `simulate` that take much memory, or that would never end.

use sensedsl_tests::TempDir;

use super::expect_alone;

const BOARD: &str = "board STM32F407G_DISC1 {
    sensor Turns returns int32 { id = 1; type = encoder; }
    sensor Wheel returns uint32 { id = 2; type = icu; }
    sensor Button returns bool { id = 3; type = digital; }
    sensor Drops returns uint32 { id = 4; type = digital; edge = both; }
}";

#[track_caller]
fn refused(world: &str, code: &str) {
    let folder = TempDir::new("worlds");
    let _ = folder.write("board.sense", BOARD);
    let _ = folder.write("a.toml", world);
    expect_alone(&folder, &["simulate", "board.sense", "--world", "a.toml", "--judge"], code);
}

#[test]
fn tables_and_lists_without_end() {
    let heads: String = (0..150_000).map(|at| format!("[a{at}]\n")).collect();
    refused(&heads, "E0551");
    refused(&format!("[devices]\nTurns = {}1{}", "[".repeat(60_000), "]".repeat(60_000)), "E0551");
    refused(&format!("[{}a]\n", "a.".repeat(100_000)), "E0551");
    refused(&"[[fault]]\n".repeat(150_000), "E0551");
    let steps: String = (0..100_000).map(|at| format!("[{at},1],")).collect();
    refused(&format!("[devices]\nTurns = {{ steps = [{steps}] }}\n"), "E0551");
}

#[test]
fn edges_without_end() {
    for quantity in [
        "Turns = { rate = 1e18 }",
        "Turns = { rate = -1e18 }",
        "Turns = { sine = 2e9, period = \"1 ms\" }",
        "Turns = { ramp = [0, 2e9], over = \"10 s\" }",
        "Turns = { steps = [[\"0 s\", 0], [\"10 s\", 2e9]] }",
        "Turns = { value = 0, noise = 1e9 }",
        "Wheel = { rate = 1e18 }",
        "Drops = { rate = 1e18 }",
        "Button = { square = [0, 1], period = \"1 ns\" }",
    ] {
        refused(&format!("[devices]\n{quantity}\n"), "E0554");
    }
}

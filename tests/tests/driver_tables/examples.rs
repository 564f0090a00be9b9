//! Every driver on boards of several families: a file that uses all its values is wired.

use sensedsl_tests::sensedsl;

use super::library::examples;

/// Boards of different families.
const BOARDS: [&str; 4] =
    ["NUCLEO_F446RE", "NUCLEO_G474RE", "BLUEPILL_F103C8", "RASPBERRY_PI_PICO"];

#[test]
fn every_driver_is_wired_on_boards_of_several_families() {
    let mut wrong = Vec::new();
    for board in BOARDS {
        for (name, text) in examples(board) {
            let ran = sensedsl(["solve", "-", "-q"]).stdin(text).run();
            if ran.status != 0 {
                wrong.push(format!("{name} on {board}: {}\n{}", ran.status, ran.stderr));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

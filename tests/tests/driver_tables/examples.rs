//! Every driver on boards of several families: a file that uses all its values is wired, or the
//! reason against it is known.

use sensedsl_model::{NoFiles, Request, resolve};
use sensedsl_tests::one_in;
use sensedsl_wiring::{Solved, Wiring};

use super::library::examples;

/// The board has no unit for the driver. No check reports that, only the solver (E0401).
const NO_UNIT: &str = "";

/// Boards of different families, with the drivers that they cannot carry and the code of the
/// reason. An RP2040 does not decode quadrature, and its pins do not tolerate 5 V (the message
/// names resistors that help); the serial ports of F1 and F4 cannot invert.
const BOARDS: [(&str, &[(&str, &str)]); 4] = [
    ("NUCLEO_F446RE", &[("sbus", "E0320"), ("maxsonar_serial", "E0320")]),
    ("NUCLEO_G474RE", &[]),
    (
        "BLUEPILL_F103C8",
        &[
            ("sbus", "E0320"),
            ("maxsonar_serial", "E0320"),
            ("vesc", NO_UNIT),
            ("vesc_duty", NO_UNIT),
            ("vesc_current", NO_UNIT),
            ("canopen_pdo", NO_UNIT),
            ("canopen_nmt", NO_UNIT),
            ("odrive", NO_UNIT),
            ("odrive_position", NO_UNIT),
            ("odrive_torque", NO_UNIT),
        ],
    ),
    (
        "RASPBERRYPI_PICO",
        &[
            ("hcsr04", "E0321"),
            ("ds1307", "E0321"),
            ("yf_s201", "E0321"),
            ("odrive", NO_UNIT),
            ("odrive_position", NO_UNIT),
            ("odrive_torque", NO_UNIT),
            ("xl330", "E0320"),
            ("xl430", "E0320"),
            ("xl430_wheel", "E0320"),
            ("ax12", "E0320"),
            ("sts3215", "E0320"),
            ("lx16a", "E0320"),
            ("maxsonar_pw", "E0321"),
            ("maxsonar_serial", "E0321"),
            ("hrxl_maxsonar_serial", "E0321"),
            ("vesc", NO_UNIT),
            ("vesc_duty", NO_UNIT),
            ("vesc_current", NO_UNIT),
            ("canopen_pdo", NO_UNIT),
            ("canopen_nmt", NO_UNIT),
        ],
    ),
];

#[test]
fn every_driver_is_wired_on_boards_of_several_families() {
    let mut wrong = Vec::new();
    for (board, refused) in one_in(4, BOARDS) {
        for (name, text) in examples(board) {
            let found = refusal(&text);
            let expected =
                refused.iter().find(|(driver, _)| *driver == name).map(|(_, code)| *code);
            if found.as_deref() != expected {
                wrong.push(format!("{name} on {board}: {found:?}, not {expected:?}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The codes of the reasons why a file is not wired; `None` if it is wired.
fn refusal(text: &str) -> Option<String> {
    let request = Request { path: "example.sense", text, ..Request::default() };
    let resolved = resolve(&request, &NoFiles);
    let codes = |all: &[sensedsl_diagnostics::Diagnostic]| {
        let codes: Vec<String> = all.iter().map(|one| one.code.to_string()).collect();
        Some(codes.join(" "))
    };
    let Some(design) = resolved.design else { return codes(&resolved.diagnostics) };
    let wiring = Wiring::new(&design, None);
    match wiring.solve_only(true) {
        Solved::Wired(_) => None,
        _ => codes(&wiring.check()),
    }
}

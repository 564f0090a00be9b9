//! A device that firmware does not support yet is refused, never left out silently; everything else
//! is still written.

use sensedsl_tests::{RunOutput, TempDir, sensedsl};

fn generate(body: &str, arguments: &[&str]) -> RunOutput {
    generate_on("STM32F407G_DISC1", body, arguments)
}

fn generate_on(board: &str, body: &str, arguments: &[&str]) -> RunOutput {
    let scratch = TempDir::new("gaps");
    let text = format!("board {board} {{ {body} }}\n");
    let file = scratch.write("gap.sense", text);
    let out = scratch.join("out");
    let call = sensedsl(["generate", "-q"]).arg(file).arg("-o").arg(&out);
    let ran = call.args(arguments).run();
    assert_eq!(out.exists(), ran.status == 0, "there is all or nothing\n{}", ran.stderr);
    ran
}

#[test]
fn what_firmware_would_ignore_is_an_error() {
    // There is no code for one wire in both directions on this MCU, although its silicon can do that.
    let board = "ESP32_C6_DEVKITC_1";
    let body =
        "target = embassy; sensor Turn returns uint16 { driver = sts3215; reading = position; }";
    let ran = generate_on(board, body, &[]).exits(1);
    assert_eq!(ran.stderr.matches("E0501").count(), 1, "{body}\n{}", ran.stderr);
    assert!(ran.stderr.contains("--without firmware"), "{body}\n{}", ran.stderr);
    let _ = generate_on(board, body, &["--without", "firmware"]).exits(0);
}

/// Drivers of the first edition are served as before. So are chips, parts of words on buses, and a
/// curve, which the host applies.
#[test]
fn what_is_made_is_served() {
    let ranger = "sensor A returns uint16 { id = 1; driver = srf08; address = 0xE0; }";
    let _ = generate(ranger, &[]).exits(0);
    let chip = "chip Imu { driver = mpu6050; id = 1; }";
    let _ = generate(chip, &[]).exits(0);
    let part = "sensor A returns uint16 { id = 1; type = i2c; address = 0x20; register = 0; bits = 7..0; }";
    let _ = generate(part, &[]).exits(0);
    let filtered = "sensor A returns uint16 { id = 1; type = analog; invalid = 4095; median = 5; change = 3; }";
    let _ = generate(filtered, &[]).exits(0);
    let text = "actuator Out accepts int16 { id = 1; type = uart; end = [10]; format = decimal; field = 0; }";
    let _ = generate(text, &[]).exits(0);
    let curve = "sensor A returns uint16 { id = 1; driver = gp2y0a21; }";
    let _ = generate(curve, &[]).exits(0);
}

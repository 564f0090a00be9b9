//! What a driver states about its values: mistakes are reported where they are made, and correct
//! values are not reported.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use sensedsl_model::{NoFiles, Request, resolve};

/// The codes and messages of a file with a driver and a chip of it.
fn reported(driver: &str) -> String {
    let text = format!(
        "driver own {driver}\nboard STM32F407G_DISC1 {{ chip Chip {{ driver = own; id = 1; }} }}"
    );
    let request = Request { path: "x.sense", text: &text, ..Request::default() };
    let resolved = resolve(&request, &NoFiles);
    let lines = resolved.diagnostics.iter().map(|one| format!("{} {}\n", one.code, one.message));
    lines.collect()
}

#[track_caller]
fn tells(driver: &str, wanted: &str) {
    let reported = reported(driver);
    assert!(reported.contains(wanted), "{driver}\n{reported}");
    assert_eq!(reported.lines().count(), 1, "one mistake, one message\n{reported}");
}

#[test]
fn values_that_cannot_stand_in_their_bytes() {
    let i2c = |properties: &str, ty: &str| {
        format!(
            "for i2c {{ address = 0x20; reading a returns {ty} {{ register = 0; {properties} }} }}"
        )
    };
    tells(&i2c("bits = 16..3;", "uint16"), "a word of 2 bytes has no bit 16");
    tells(&i2c("length = 5; bits = 3..0;", "uint16[2]"), "5 bytes are not 2 words");
    tells(&i2c("length = 9; bits = 3..0;", "uint16"), "a word has 1 to 8 bytes");
    tells(&i2c("elements = [0, 1, 5]; length = 8;", "int16[3]"), "`elements` names word 5");
    tells(&i2c("packed = 11; length = 2;", "uint16[2]"), "2 numbers of 11 bits are 3 bytes");
    tells(&i2c("crc = sensirion;", "uint8"), "a checksum follows every two bytes");
    tells(&i2c("register = 256;", "uint8").replace("register = 0; ", ""), "256");
    assert_eq!(reported(&i2c("bits = 15..4; elements = [0, 2, 1];", "int16[3]")), "");
    let wide = i2c("", "uint8").replace("address", "register_size = 2; address");
    assert_eq!(reported(&wide.replace("register = 0;", "register = 0x0100;")), "");
}

#[test]
fn messages_that_never_end() {
    let uart = |properties: &str| {
        format!("for uart {{ {properties} reading a returns uint8 {{ byte = 0; }} }}")
    };
    tells(&uart("start = [1];"), "a message needs a `length`, or an `end`");
    tells(&uart("start = [1]; length = 3; checksum_from = 1;"), "`checksum_from`");
    tells(&uart("start = [1]; length = 3; checksum = sum8; checksum_from = 2;"), "checksum_from");
    assert_eq!(
        reported(&uart(
            "start = [1]; length = 3; checksum = xor8; checksum_from = 1; invert = true;"
        )),
        ""
    );
    assert_eq!(reported(&uart("end = \"\\n\";")), "");
}

/// Only a driver's reading can state how many channels a pulse train has.
#[test]
fn pulse_trains_are_readings() {
    assert_eq!(reported("for icu { mode = ppm; reading channels returns uint16[6] {} }"), "");
    tells("for icu { mode = width; reading channels returns uint16[6] {} }", "E0220");
    let text =
        "board STM32F407G_DISC1 { sensor A returns uint16 { id = 1; type = icu; mode = ppm; } }";
    let resolved = resolve(&Request { path: "x.sense", text, ..Request::default() }, &NoFiles);
    assert!(resolved.design.is_none());
    assert!(resolved.diagnostics[0].message.contains("driver = ppm"), "{:?}", resolved.diagnostics);
}

/// Two resistors make a voltage less, not the time of a pulse.
#[test]
fn a_divider_scales_what_a_converter_samples() {
    let scale = |device: &str| {
        let text = format!("board STM32F407G_DISC1 {{ sensor A returns uint16 {{ {device} }} }}");
        let request = Request { path: "x.sense", text: &text, ..Request::default() };
        let design = resolve(&request, &NoFiles).design.unwrap();
        design.devices.first().unwrap().shown.scale
    };
    let divider = "level = 5 V; divider = [1 kOhm, 1 kOhm];";
    assert_eq!(scale(&format!("type = analog; {divider}")), Some(2.0));
    assert_eq!(scale(&format!("driver = battery_divider; {divider} scale = 1;")), Some(2.0));
    assert_eq!(scale(&format!("type = icu; mode = width; {divider}")), None);
    assert_eq!(scale(&format!("driver = hcsr04; {divider}")), scale("driver = hcsr04;"));
}

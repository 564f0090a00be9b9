//! The hand-written core in C, copied beside the generated files: what every board has, and what only some drivers use.

/// The path below the runtime's folder, and the content.
pub type File = (&'static str, &'static str);

macro_rules! files {
    ($($name:literal,)*) => {
        &[$((concat!("core/", $name), include_str!(concat!("../runtime/", $name)))),*]
    };
}

/// The files that every board has. The linker leaves out what is not called.
pub const BASE: &[File] = files![
    "up_bus.h",
    "up_checksum.c",
    "up_checksum.h",
    "up_chip.c",
    "up_chip.h",
    "up_compose.c",
    "up_compose.h",
    "up_convert.c",
    "up_convert.h",
    "up_decode.c",
    "up_decode.h",
    "up_divide.h",
    "up_drive.c",
    "up_drive.h",
    "up_encode.c",
    "up_encode.h",
    "up_exchange.c",
    "up_exchange.h",
    "up_filter.c",
    "up_filter.h",
    "up_filter_double.c",
    "up_formula.c",
    "up_formula.h",
    "up_formula_hx711.c",
    "up_formula_ntc.c",
    "up_formula_tsl2561.c",
    "up_health.c",
    "up_health.h",
    "up_lamps.c",
    "up_lamps.h",
    "up_letters.c",
    "up_letters.h",
    "up_memo.c",
    "up_memo.h",
    "up_message.c",
    "up_message.h",
    "up_parse.c",
    "up_parse.h",
    "up_ppm.c",
    "up_ppm.h",
    "up_report.c",
    "up_report.h",
    "up_reporter.c",
    "up_reporter.h",
    "up_request.c",
    "up_request.h",
    "up_result.h",
    "up_rom.h",
    "up_schema.c",
    "up_schema.h",
    "up_silence.c",
    "up_silence.h",
    "up_text.c",
    "up_text.h",
    "up_uses.h",
    "up_value.c",
    "up_value.h",
    "up_wire.c",
    "up_wire.h",
];

/// Arithmetic on input captures, for these and for pins whose edges are read.
pub const CAPTURE: &[File] = files!["up_capture.c", "up_capture.h",];

/// Counts that wrap.
pub const COUNT: &[File] = files!["up_count.c", "up_count.h",];

/// Contacts that bounce.
pub const DEBOUNCE: &[File] = files!["up_debounce.c", "up_debounce.h",];

/// Values with one element per wire.
pub const ELEMENTS: &[File] = files!["up_elements.c", "up_elements.h",];

/// Answers on one wire.
pub const ONEWIRE: &[File] = files!["up_onewire.c", "up_onewire.h",];

/// Widths of pulses in timer ticks.
pub const PULSE_WIDTH: &[File] = files!["up_pulse_width.c", "up_pulse_width.h",];

/// Steps of motors.
pub const STEPPER: &[File] = files!["up_stepper.c", "up_stepper.h",];

//! The hand-written runtime that every board has, copied beside what is generated. What is a driver's is in its folder.
//!
//! The linker leaves out what nobody calls.

/// Path below `uproxy/`, and text.
macro_rules! files {
    ($($path:literal,)*) => {
        &[$(($path, include_str!(concat!("../../../../../runtime/", $path))),)*]
    };
}

/// Path below `uproxy/` and text.
pub(super) const FILES: &[(&str, &str)] = files![
    "core/up_bus.h",
    "core/up_capture.c",
    "core/up_capture.h",
    "core/up_checksum.c",
    "core/up_checksum.h",
    "core/up_chip.c",
    "core/up_chip.h",
    "core/up_convert.c",
    "core/up_convert.h",
    "core/up_decode.c",
    "core/up_decode.h",
    "core/up_drive.c",
    "core/up_drive.h",
    "core/up_encode.c",
    "core/up_encode.h",
    "core/up_filter.c",
    "core/up_filter.h",
    "core/up_filter_double.c",
    "core/up_formula.c",
    "core/up_formula.h",
    "core/up_formula_ntc.c",
    "core/up_formula_tsl2561.c",
    "core/up_memo.c",
    "core/up_memo.h",
    "core/up_message.c",
    "core/up_message.h",
    "core/up_parse.c",
    "core/up_parse.h",
    "core/up_ppm.c",
    "core/up_ppm.h",
    "core/up_report.c",
    "core/up_report.h",
    "core/up_schema.c",
    "core/up_schema.h",
    "core/up_text.c",
    "core/up_text.h",
    "core/up_value.c",
    "core/up_value.h",
    "chibios/up_doctor.c",
    "chibios/up_doctor.h",
    "chibios/up_life.c",
    "chibios/up_life.h",
    "chibios/up_link.c",
    "chibios/up_link.h",
    "chibios/up_link_serial.c",
    "chibios/up_link_usb.c",
    "chibios/up_mcu.h",
    "chibios/up_rt.c",
    "chibios/up_rt.h",
    "chibios/up_shell.c",
    "chibios/up_shell.h",
    "chibios/uproxy.mk",
];

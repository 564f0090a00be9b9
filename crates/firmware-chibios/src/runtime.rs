//! The hand-written runtime that every board has, copied beside the generated files. Files of a driver are in its
//! folder.

/// Files of `runtime/` with their path below `uproxy/`.
macro_rules! own {
    ($($name:literal),* $(,)?) => {
        &[$((
            concat!("chibios/", $name),
            include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/runtime/", $name)),
        )),*]
    };
}
pub(crate) use own;
use sensedsl_firmware_c::runtime::File;

/// The files between the core and the system.
pub(super) const FILES: &[File] = own![
    "up_chips.c",
    "up_chips.h",
    "up_dma.h",
    "up_doctor.c",
    "up_doctor.h",
    "up_life.c",
    "up_life.h",
    "up_link.c",
    "up_link.h",
    "up_link_serial.c",
    "up_link_usb.c",
    "up_main.c",
    "up_mcu.h",
    "up_rt.c",
    "up_rt.h",
    "up_shell.c",
    "up_shell.h",
    "up_wait.c",
    "up_wait.h",
    "uproxy.mk",
];

//! The properties of boards and of their links.

use sensedsl_wire::Checksum;

use super::{Meaning, Takes, first};
use crate::board::link::TRANSPORTS;

/// The properties of a board.
pub(super) const BOARD: &[Meaning] = &[Meaning::new(
    ("target", Takes::Target),
    "`chibios` where it covers the MCU, else `embassy` where that does, else `none`",
    "The system that the firmware is for. `none` is the pure pin model, for which no firmware can be made. `--target` \
     on the command line wins.",
    "target = embassy;",
)];

/// The properties of a link.
pub(super) const LINK: &[Meaning] = &[
    Meaning::new(
        ("transport", Takes::Words(|| first(&TRANSPORTS))),
        "the first link that the board has wired and the target has a driver for; else `usb`, or `uart` where the \
         target has no USB",
        "How the board talks to the host: USB CDC, a serial port, or no link, which takes no pin and has no firmware.",
        "transport = uart;",
    ),
    Meaning::new(
        ("unit", Takes::Peripheral),
        "the port that is wired on the board; else it is chosen with the wiring",
        "The serial port of the link.",
        "unit = USART2;",
    ),
    Meaning::new(
        ("baud", Takes::Whole(1_200, 10_000_000)),
        "115200",
        "Bits per second of a serial link; an error over USB.",
        "baud = 921600;",
    ),
    Meaning::new(
        ("checksum", Takes::Words(|| Checksum::ALL.map(Checksum::name).to_vec())),
        "`crc16` over a serial port, `none` over USB, which checks by itself",
        "What each frame ends with: `crc16` takes 3 bytes of it, `crc32` 5.",
        "checksum = crc32;",
    ),
    Meaning::new(
        ("stamp", Takes::Truth),
        "`false`",
        "Each report begins with the board's time in microseconds and a counter, by which the host tells lost ones. It \
         takes 6 bytes.",
        "stamp = true;",
    ),
    Meaning::new(
        ("silence", Takes::Time(10_000, 3_600_000_000)),
        "500 ms where an actuator has a `failsafe`, else none",
        "When the host has sent nothing for so long, actuators take their `failsafe`.",
        "silence = 1 s;",
    ),
    Meaning::new(
        ("rate", Takes::Frequency(1, 10_000)),
        "each report as it is due",
        "At most that many reports a second.",
        "rate = 100 Hz;",
    ),
    Meaning::new(
        ("vbus", Takes::Truth),
        "`true`, but on a built-in board that has nothing on that pin",
        "`false`: the USB device does not look for the host's supply, and leaves the pin for it (PA9 on many STM32) to \
         devices.",
        "vbus = false;",
    ),
];

//! The properties of devices that are not of one kind: identity, pace, place, how a value is shown and filtered.

use super::{Meaning, Takes, first};
use crate::part::placement::{SEQUENCE, TOGETHER};

/// The properties of every device, and those that chips and their devices have besides.
pub(super) const COMMON: &[Meaning] = &[
    Meaning::new(
        ("id", Takes::Whole(1, 254)),
        "the next number behind the greatest that is stated",
        "The identifier on the wire, unique in the file and what it uses. Of a chip: that of its first device, from \
         which the others count up. `sensedsl fmt --ids` writes the numbers into the file.",
        "id = 17;",
    ),
    Meaning::new(
        ("type", Takes::Kind),
        "that of the driver; required without a `driver`",
        "The kind: what the device is connected to.",
        "type = analog;",
    ),
    Meaning::new(
        ("driver", Takes::Driver),
        "none; required in a chip",
        "Takes over the properties of a driver, of the library or of the file. A part is also found by what else \
         people call it: `driver = \"GY-521\";` is `mpu6050`.",
        "driver = mpu6050;",
    ),
    Meaning::new(
        ("reading", Takes::Reading),
        "the one with the device's name; else the only one of its direction",
        "Which reading (a sensor) or command (an actuator) of the chip's driver the device is.",
        "reading = rate;",
    ),
    Meaning::new(
        ("delay", Takes::Time(1_000, 3_600_000_000)),
        "1000 ms",
        "The cycle time. It says nothing where the hardware measures by itself (`icu` without `pulse`, `encoder`).",
        "delay = 100 ms;",
    ),
    Meaning::new(
        ("prio", Takes::Whole(-60, 60)),
        "0",
        "The priority of the thread, relative to `NORMALPRIO`.",
        "prio = 10;",
    ),
    Meaning::new(
        ("group", Takes::Group),
        "the driver's, or none",
        "Devices of one group never measure at the same time; the rangers of the library are in `ultrasonic`.",
        "group = ultrasonic;",
    ),
    Meaning::new(
        ("unit", Takes::Peripheral),
        "chosen with the wiring",
        "Fixes the peripheral, as the MCU's data sheet names it.",
        "unit = ADC1;",
    ),
    Meaning::new(
        ("side", Takes::Side),
        "any",
        "Every wire of the device must be on that side of the board.",
        "side = left;",
    ),
    Meaning::new(
        ("header", Takes::Header),
        "any",
        "Every wire of the device must be at that connector.",
        "header = CN7;",
    ),
    Meaning::new(
        ("together", Takes::Words(|| first(&TOGETHER))),
        "none",
        "For an array with a wire for each element: all of them are on one peripheral instance, connector or side.",
        "together = unit;",
    ),
    Meaning::new(
        ("sequence", Takes::Words(|| first(&SEQUENCE))),
        "none",
        "For an array with a wire for each element: the elements come one after the other along a connector.",
        "sequence = header;",
    ),
    Meaning::new(
        ("level", Takes::Voltage(1, 1_000_000)),
        "none",
        "The voltage that the device puts on its wires; of an `analog` device the highest there is. A pin that does \
         not stand it is not offered.",
        "level = 5 V;",
    ),
    Meaning::new(
        ("divider", Takes::Resistances),
        "none",
        "Resistors in between: from the device to the pin, and from there to ground. They need a `level`. Of an `analog` \
         device they are part of the shown `scale`.",
        "divider = [33 kOhm, 10 kOhm];",
    ),
];

/// How a host shows a value.
pub(super) const SHOWN: &[Meaning] = &[
    Meaning::new(
        ("label", Takes::Text),
        "none",
        "What the device is, for people.",
        "label = \"left bumper\";",
    ),
    Meaning::new(
        ("quantity", Takes::Quantity),
        "none",
        "The unit of the shown value.",
        "quantity = cm;",
    ),
    Meaning::new(
        ("scale", Takes::Number),
        "1",
        "The host shows `scale * raw + offset`. It is never sent on the wire.",
        "scale = 1 / 256;",
    ),
    Meaning::new(
        ("offset", Takes::Number),
        "0",
        "The host shows `scale * raw + offset`. It is never sent on the wire.",
        "offset = -40;",
    ),
    Meaning::new(
        ("min", Takes::Bound),
        "none",
        "The least shown value to expect; one that the type or the part cannot reach is an error.",
        "min = 2;",
    ),
    Meaning::new(
        ("max", Takes::Bound),
        "none",
        "The greatest shown value to expect; one that the type or the part cannot reach is an error.",
        "max = 400;",
    ),
    Meaning::new(
        (
            "curve",
            Takes::Form(
                "a list of pairs such as `[[0.4, 80], [1.3, 20]]`, the first numbers rising",
                &[],
            ),
        ),
        "none",
        "Points between which the host interpolates `scale * raw + offset`; beyond them the first and the last one \
         hold.",
        "curve = [[0.4, 80], [1.3, 20]];",
    ),
];

/// What becomes of a value on the board before it is reported.
pub(super) const FILTER: &[Meaning] = &[
    Meaning::new(
        ("invalid", Takes::Form("a number, a range such as `0..3`, or a list of them", &[])),
        "none",
        "Raw values that mean \"nothing was measured\": counted as a fault, not reported.",
        "invalid = 0;",
    ),
    Meaning::new(
        ("median", Takes::Whole(3, 15)),
        "none",
        "The median of so many values is reported; an odd number.",
        "median = 5;",
    ),
    Meaning::new(
        ("smooth", Takes::Time(1_000, 3_600_000_000)),
        "none",
        "The time constant of a first-order low-pass.",
        "smooth = 200 ms;",
    ),
    Meaning::new(
        ("change", Takes::Number),
        "none",
        "Only what differs by at least so much from the last report is reported; raw, before `scale`.",
        "change = 3;",
    ),
    Meaning::new(
        ("heartbeat", Takes::Time(1_000, 3_600_000_000)),
        "none",
        "With `change`: the longest time between two reports.",
        "heartbeat = 5 s;",
    ),
];

/// A property that fixes the pin of a wire.
const fn wire(name: &'static str, text: &'static str, example: &'static str) -> Meaning {
    Meaning::new((name, Takes::Pin), "chosen with the wiring", text, example)
}

/// The properties that fix the wires of a device.
pub(super) const WIRES: &[Meaning] = &[
    wire(
        "pin",
        "Fixes the pin of the only wire. It is named as the MCU names it, by its label on the board, by connector and \
         contact, or by the on-board part that is on it.",
        "pin = PA0;",
    ),
    wire("scl", "Fixes the pin of the I2C clock.", "scl = PB6;"),
    wire("sda", "Fixes the pin of the I2C data.", "sda = PB7;"),
    wire(
        "tx",
        "Fixes the pin on which the board sends. `tx = none;` of a sensor needs no such wire.",
        "tx = PA2;",
    ),
    wire("rx", "Fixes the pin on which the board receives.", "rx = PA3;"),
    wire(
        "direction",
        "Fixes the pin that is high while the board sends, with `duplex = direction`; any pin can be it.",
        "direction = PA1;",
    ),
    wire("sck", "Fixes the pin of the SPI clock.", "sck = PA5;"),
    wire("miso", "Fixes the pin of the SPI data from the device.", "miso = PA6;"),
    wire("mosi", "Fixes the pin of the SPI data to the device.", "mosi = PA7;"),
    wire("cs", "Fixes the pin of the SPI chip select; any pin can be it.", "cs = PA4;"),
    wire("a", "Fixes the pin of an encoder's track A.", "a = PA0;"),
    wire("b", "Fixes the pin of an encoder's track B.", "b = PA1;"),
    wire(
        "trigger",
        "Fixes the pin of the pulse that makes the device measure, with `pulse`; any pin can be it.",
        "trigger = PA1;",
    ),
    wire("step", "Fixes the pin of a motor's steps, an output of a timer.", "step = PB4;"),
    wire("dir", "Fixes the pin of a motor's direction; any pin can be it.", "dir = PB5;"),
    wire(
        "enable",
        "Fixes the pin that lets current into a motor; any pin can be it. `none`: there is no such wire.",
        "enable = PB6;",
    ),
];

//! The properties of drivers: how the part is started, where a value stands in its bytes, what is said of the part.

use sensedsl_wire::Direction;

use super::takes::{RESISTANCE, TIME, VOLTAGE};
use super::{Meaning, Takes, first};
use crate::design::protocol::Formula;
use crate::kind::uart::SUMS_BEHIND;
use crate::part::coding::{CRCS, DRIVES, FORMATS};

/// Where a value stands, in a reading or command or in the driver for all of them.
pub(super) const CODING: &[Meaning] = &[
    Meaning::new(
        ("via", Takes::Connections),
        "the only connection",
        "What the value goes over; needed where the driver has several connections.",
        "via = [pwm, in1, in2];",
    ),
    Meaning::new(
        ("bits", Takes::Form("the highest and the lowest bit such as `13..0`, or one number", &[])),
        "all bits",
        "The bits of each word that count. With `bit` of CAN it is how many bits there are.",
        "bits = 13..0;",
    ),
    Meaning::new(
        ("signed", Takes::Truth),
        "as the type says",
        "Whether the highest of the bits is a sign.",
        "signed = true;",
    ),
    Meaning::new(
        ("byte", Takes::Whole(0, 1_023)),
        "0",
        "Where the value begins in a message, in bytes behind its `start`, or in what is read from the register.",
        "byte = 4;",
    ),
    Meaning::new(
        ("elements", Takes::Bytes(1, 255)),
        "one after the other",
        "Which word each element is, counted from 0: a number for each element.",
        "elements = [0, 2, 1];",
    ),
    Meaning::new(
        ("packed", Takes::Whole(1, 32)),
        "none",
        "Elements of that many bits, one behind the other without gaps, the lowest bit first.",
        "packed = 11;",
    ),
    Meaning::new(
        ("crc", Takes::Words(|| first(&CRCS))),
        "none",
        "A checksum after every two bytes, as parts of Sensirion have it.",
        "crc = sensirion;",
    ),
    Meaning::new(
        ("exchange", Takes::Bytes(1, 255)),
        "none",
        "On SPI, sent while as many bytes are received, which are the value's.",
        "exchange = [0x01, 0x80, 0x00];",
    ),
    Meaning::new(
        ("format", Takes::Words(|| first(&FORMATS))),
        "a binary number",
        "`decimal` and `hex` are numbers in a text; `degrees` is degrees and minutes as ten-millionths of a degree; \
         `bcd` is two decimal digits a byte, `sign_magnitude` a number whose highest bit is its sign.",
        "format = decimal;",
    ),
    Meaning::new(
        ("sentence", Takes::Text),
        "any message",
        "In a text, only sentences count whose first field ends so.",
        "sentence = \"RMC\";",
    ),
    Meaning::new(
        ("field", Takes::Whole(0, 63)),
        "0",
        "Which field of the sentence, behind its first one.",
        "field = 6;",
    ),
    Meaning::new(
        ("separator", Takes::Bytes(1, 1)),
        "`,` where there is a `sentence`, else the message is one field",
        "What is between the fields of a text.",
        "separator = \";\";",
    ),
    Meaning::new(
        ("decimals", Takes::Whole(0, 18)),
        "0",
        "The value is the number times ten to that power, so that its fraction is kept.",
        "decimals = 2;",
    ),
    Meaning::new(
        ("output", Takes::Output),
        "the one of the reading's own name",
        "Which output of the formula the value is.",
        "output = pressure;",
    ),
    Meaning::new(
        ("drive", Takes::Words(|| first(&DRIVES))),
        "none",
        "How one signed value becomes a motor's wires: a pulse width and two levels, a pulse width and \
         one level (on for a negative value), or one pulse width for each direction.",
        "drive = direction_pins;",
    )
    .only(Direction::Actuator),
    Meaning::new(
        ("failsafe", Takes::Shown),
        "keep the last",
        "What the actuator becomes when the host falls silent. Of a `bool` also `true` or `false`.",
        "failsafe = 0;",
    )
    .only(Direction::Actuator),
    Meaning::new(
        ("initial", Takes::Truth),
        "what `init` writes",
        "On a bus, whether an output of type `bool` is on before the host sets it.",
        "initial = true;",
    )
    .only(Direction::Actuator),
];

/// How the part is started. A chip that says one of them says it instead.
pub(super) const PROTOCOL: &[Meaning] = &[
    Meaning::new(
        (
            "init",
            Takes::Form(
                "a list of byte lists (or texts) and times such as `[[0x6B, 0x80], 100 ms]`",
                TIME,
            ),
        ),
        "none",
        "Written one after the other at the start, and again after a failed transfer; a time is a pause. Up to 128 \
         steps.",
        "init = [[0x6B, 0x80], 100 ms, [0x6B, 0x01]];",
    ),
    Meaning::new(
        ("init_checksum", Takes::Words(|| first(SUMS_BEHIND))),
        "`none`",
        "On a serial line, what stands after each list of bytes in `init`; of its bytes from `checksum_from` on.",
        "init_checksum = crc16_umts;",
    ),
    Meaning::new(
        (
            "identity",
            Takes::Form(
                "a register and the bytes that must be read there, such as `[0x75, 0x68]`",
                &[],
            ),
        ),
        "none",
        "Another part at the address is a fault, and its values are not reported.",
        "identity = [0x75, 0x68];",
    ),
    Meaning::new(
        ("identity_mask", Takes::Bytes(1, 32)),
        "all bits",
        "The bits of the `identity` that count: as many bytes as are expected.",
        "identity_mask = [0x7E];",
    ),
    Meaning::new(
        ("register_size", Takes::Whole(1, 2)),
        "1",
        "Bytes of a register's number.",
        "register_size = 2;",
    ),
    Meaning::new(
        ("read_mask", Takes::Whole(0, 255)),
        "0",
        "On SPI, added to a register's number when it is read.",
        "read_mask = 0x80;",
    ),
    Meaning::new(
        ("burst", Takes::Truth),
        "`true`",
        "Whether registers that follow each other are read in one transfer.",
        "burst = false;",
    ),
    Meaning::new(
        (
            "calibration",
            Takes::Form("a list of registers and counts such as `[[0x88, 24], [0xA1, 1]]`", &[]),
        ),
        "none",
        "Read once, for the formula.",
        "calibration = [[0x88, 24]];",
    ),
    Meaning::new(
        ("compensate", Takes::Words(|| Formula::ALL.map(Formula::name).to_vec())),
        "none",
        "The formula by which the readings are computed from the bytes.",
        "compensate = bmp280;",
    ),
    Meaning::new(
        (
            "parameters",
            Takes::Form("a list of numbers such as `[3950, 10 kOhm, 10 kOhm]`", RESISTANCE),
        ),
        "none",
        "The constants of the formula.",
        "parameters = [3950, 10 kOhm, 10 kOhm];",
    ),
];

/// What is said of the part: for people, for its page and for the checks of a design.
pub(super) const ABOUT: &[Meaning] = &[
    Meaning::new(
        ("part", Takes::Text),
        "the driver's name",
        "The full name of the part.",
        "part = \"InvenSense MPU-6050\";",
    ),
    Meaning::new(
        ("about", Takes::Text),
        "none",
        "What the part does, in a sentence.",
        "about = \"Three accelerations and three angular rates.\";",
    ),
    Meaning::new(
        ("aliases", Takes::Texts),
        "none",
        "What else people call the part; a design may use each as a name.",
        "aliases = [\"GY-521\"];",
    ),
    Meaning::new(
        ("sheet", Takes::Text),
        "none",
        "The document that the figures are from.",
        "sheet = \"RM-MPU-6000A-00, revision 4.2\";",
    ),
    Meaning::new(
        ("checked", Takes::Text),
        "none",
        "A second text that the figures were compared with, and what of them.",
        "checked = \"the registers, with the maker's example\";",
    ),
    Meaning::new(
        ("connector", Takes::Texts),
        "none",
        "The names at the usual module's connector, in their order; `\"RPWM = forward\"` says which wire goes there \
         where the name does not tell, `supply` and `ground` too.",
        "connector = [\"VCC\", \"GND\", \"SCL\", \"SDA\"];",
    ),
    Meaning::new(
        ("note", Takes::Texts),
        "none",
        "What whoever wires the part must know.",
        "note = [\"AD0 chooses the address.\"];",
    ),
    Meaning::new(
        ("pull", Takes::Words(|| vec!["up"])),
        "none",
        "The part's bus or its output needs resistors to the supply.",
        "pull = up;",
    ),
    Meaning::new(
        (
            "supply",
            Takes::Form("a voltage such as `5 V`, or a range such as `2.4 V..3.6 V`", VOLTAGE),
        ),
        "none",
        "The supply of the part. A `level` over the greatest is a warning, and so is a board that drives its wires \
         with more.",
        "supply = 2.4 V..3.6 V;",
    ),
    Meaning::new(
        ("addresses", Takes::Form("a list of addresses such as `[0x68, 0x69]`", &[])),
        "any",
        "The I2C addresses that the part can be set to, in 7-bit form, or in 8-bit form from 0x80 on. Another one is \
         an error.",
        "addresses = [0x68, 0x69];",
    ),
    Meaning::new(
        ("speed_max", Takes::Frequency(1_000, 100_000_000)),
        "none",
        "The greatest clock of the part's I2C bus; a `speed` over it is an error.",
        "speed_max = 400 kHz;",
    ),
    Meaning::new(
        ("clock_max", Takes::Frequency(1_000, 100_000_000)),
        "none",
        "The greatest clock of the part's SPI bus; a `clock` over it is an error.",
        "clock_max = 10 MHz;",
    ),
];

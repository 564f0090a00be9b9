//! What parts Wokwi has, and which of them is which part of a design: by its driver, or by its kind.
//!
//! Names, contacts and sizes are facts from `@wokwi/elements` 1.9.2 and the reference in `wokwi-docs`.

use sensedsl_model::kind::KindName;
use sensedsl_wire::Direction;

/// A supply of a part.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Rail {
    Ground,
    Three,
    Five,
    /// What the MCU runs at.
    Logic,
}

/// A part of Wokwi's.
#[derive(Debug)]
pub(super) struct WokwiPart {
    /// Wokwi's type.
    pub(super) kind: &'static str,
    /// Width and height in pixels.
    pub(super) size: (i32, i32),
    /// Its contacts with their places.
    pub(super) contacts: &'static str,
}

/// How a part of a design is drawn.
#[derive(Debug)]
pub(super) struct Use {
    pub(super) whom: Whom,
    /// Wokwi's type.
    pub(super) kind: &'static str,
    pub(super) attributes: &'static [(&'static str, &'static str)],
    /// For each wire the contact of the part; a wire without one goes nowhere.
    pub(super) wires: &'static [(&'static str, &'static str)],
    pub(super) rails: &'static [(&'static str, Rail)],
    /// The I2C address that a contact at the supply makes.
    pub(super) address: Option<(u8, &'static str)>,
    /// The ohms of a resistor before its wire.
    pub(super) ohms: Option<&'static str>,
}

/// Whose part it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Whom {
    /// That of a driver.
    Driver(&'static str),
    /// A stand-in for any device of a kind.
    Any(KindName, Direction),
    /// A stand-in for a device of a kind that has no driver.
    Plain(KindName, Direction),
}

/// All parts.
pub(super) const PARTS: &[WokwiPart] = &[
    WokwiPart {
        kind: "wokwi-74hc595",
        size: (75, 32),
        contacts: "GND@71,32 VCC@4,0 DS@23,0 OE@33,0 STCP@42,0 SHCP@52,0 MR@62,0",
    },
    WokwiPart { kind: "wokwi-buzzer", size: (64, 90), contacts: "1@27,84 2@37,84" },
    WokwiPart { kind: "wokwi-clock-generator", size: (110, 110), contacts: "CLK@55,110" },
    WokwiPart {
        kind: "wokwi-hc-sr04",
        size: (171, 95),
        contacts: "VCC@71,94 TRIG@81,94 ECHO@91,94 GND@101,94",
    },
    WokwiPart {
        kind: "wokwi-ky-040",
        size: (117, 71),
        contacts: "CLK@116,8 DT@116,17 SW@116,27 VCC@116,36 GND@116,46",
    },
    WokwiPart { kind: "wokwi-led", size: (40, 50), contacts: "A@25,42 C@15,42" },
    WokwiPart {
        kind: "wokwi-mpu6050",
        size: (82, 62),
        contacts: "INT@7,6 AD0@17,6 XCL@26,6 XDA@36,6 SDA@46,6 SCL@55,6 GND@65,6 VCC@74,6",
    },
    WokwiPart {
        kind: "wokwi-potentiometer",
        size: (76, 76),
        contacts: "GND@29,68 SIG@39,68 VCC@49,68",
    },
    WokwiPart {
        kind: "wokwi-pushbutton",
        size: (68, 46),
        contacts: "1.l@0,13 2.l@0,32 1.r@67,13 2.r@67,32",
    },
    WokwiPart {
        kind: "wokwi-relay-module",
        size: (128, 59),
        contacts: "VCC@0,20 GND@0,30 IN@0,39",
    },
    WokwiPart { kind: "wokwi-resistor", size: (60, 12), contacts: "1@0,6 2@59,6" },
    WokwiPart { kind: "wokwi-servo", size: (171, 120), contacts: "GND@0,50 V+@0,60 PWM@0,69" },
    WokwiPart { kind: "wokwi-slide-switch", size: (33, 35), contacts: "1@6,34 2@16,34 3@26,34" },
];

/// A line with nothing but a part.
const NOTHING: Use = Use {
    whom: Whom::Driver(""),
    kind: "",
    attributes: &[],
    wires: &[],
    rails: &[],
    address: None,
    ohms: None,
};

/// An LED between a resistor and ground.
const LED: Use = Use {
    kind: "wokwi-led",
    attributes: &[("color", "red")],
    wires: &[("out", "A")],
    rails: &[("C", Rail::Ground)],
    ohms: Some("330"),
    ..NOTHING
};

/// A switch that is closed to ground at rest, on its left.
const CLOSED: Use = Use {
    kind: "wokwi-slide-switch",
    wires: &[("in", "2")],
    rails: &[("1", Rail::Ground)],
    ..NOTHING
};

const SERVO: Use = Use {
    kind: "wokwi-servo",
    wires: &[("out", "PWM")],
    rails: &[("GND", Rail::Ground), ("V+", Rail::Five)],
    ..NOTHING
};

const MPU6050: Use = Use {
    kind: "wokwi-mpu6050",
    wires: &[("scl", "SCL"), ("sda", "SDA")],
    rails: &[("GND", Rail::Ground), ("VCC", Rail::Three)],
    address: Some((0x69, "AD0")),
    ..NOTHING
};

const BUZZER: Use =
    Use { kind: "wokwi-buzzer", wires: &[("out", "2")], rails: &[("1", Rail::Ground)], ..NOTHING };

const RELAY: Use = Use {
    kind: "wokwi-relay-module",
    wires: &[("out", "IN")],
    rails: &[("GND", Rail::Ground), ("VCC", Rail::Five)],
    ..NOTHING
};

const ENCODER: Use = Use {
    kind: "wokwi-ky-040",
    wires: &[("a", "CLK"), ("b", "DT")],
    rails: &[("GND", Rail::Ground), ("VCC", Rail::Logic)],
    ..NOTHING
};

const POTENTIOMETER: Use = Use {
    kind: "wokwi-potentiometer",
    wires: &[("in", "SIG")],
    rails: &[("GND", Rail::Ground), ("VCC", Rail::Logic)],
    ..NOTHING
};

const CLOCK: Use = Use { kind: "wokwi-clock-generator", wires: &[("in", "CLK")], ..NOTHING };

/// How parts are drawn: the first that fits counts.
pub(super) const USES: &[Use] = &[
    Use {
        whom: Whom::Driver("hcsr04"),
        kind: "wokwi-hc-sr04",
        wires: &[("in", "ECHO"), ("trigger", "TRIG")],
        rails: &[("GND", Rail::Ground), ("VCC", Rail::Five)],
        ..NOTHING
    },
    Use { whom: Whom::Driver("mpu6050"), ..MPU6050 },
    Use { whom: Whom::Driver("mpu6050_acceleration"), ..MPU6050 },
    Use { whom: Whom::Driver("mpu6050_rate"), ..MPU6050 },
    Use { whom: Whom::Driver("servo"), ..SERVO },
    Use { whom: Whom::Driver("esc"), ..SERVO },
    Use { whom: Whom::Driver("esc_reversible"), ..SERVO },
    Use { whom: Whom::Driver("led"), ..LED },
    Use { whom: Whom::Driver("led_dimmable"), ..LED },
    Use {
        whom: Whom::Driver("push_button"),
        kind: "wokwi-pushbutton",
        attributes: &[("color", "green")],
        wires: &[("in", "1.l")],
        rails: &[("2.l", Rail::Ground)],
        ..NOTHING
    },
    Use { whom: Whom::Driver("limit_switch"), ..CLOSED },
    Use { whom: Whom::Driver("emergency_stop"), ..CLOSED },
    Use { whom: Whom::Driver("relay"), attributes: &[("transistor", "npn")], ..RELAY },
    Use { whom: Whom::Driver("relay_active_low"), attributes: &[("transistor", "pnp")], ..RELAY },
    Use { whom: Whom::Driver("buzzer"), ..BUZZER },
    Use { whom: Whom::Driver("buzzer_passive"), ..BUZZER },
    Use { whom: Whom::Driver("quadrature_encoder"), ..ENCODER },
    Use {
        whom: Whom::Driver("hc595_pins"),
        kind: "wokwi-74hc595",
        wires: &[("mosi", "DS"), ("sck", "SHCP"), ("cs", "STCP"), ("miso", "")],
        rails: &[
            ("GND", Rail::Ground),
            ("OE", Rail::Ground),
            ("VCC", Rail::Logic),
            ("MR", Rail::Logic),
        ],
        ..NOTHING
    },
    Use { whom: Whom::Driver("potentiometer"), ..POTENTIOMETER },
    Use { whom: Whom::Driver("hall_speed"), attributes: &[("frequency", "10")], ..CLOCK },
    Use { whom: Whom::Any(KindName::Analog, Direction::Sensor), ..POTENTIOMETER },
    // Whatever the level means, both can be chosen.
    Use {
        whom: Whom::Any(KindName::Digital, Direction::Sensor),
        kind: "wokwi-slide-switch",
        wires: &[("in", "2")],
        rails: &[("1", Rail::Ground), ("3", Rail::Logic)],
        ..NOTHING
    },
    Use { whom: Whom::Any(KindName::Digital, Direction::Actuator), ..LED },
    Use { whom: Whom::Any(KindName::Encoder, Direction::Sensor), ..ENCODER },
    Use { whom: Whom::Plain(KindName::Pwm, Direction::Actuator), ..LED },
    Use {
        whom: Whom::Plain(KindName::Icu, Direction::Sensor),
        attributes: &[("frequency", "100")],
        ..CLOCK
    },
];

/// The size of a part.
pub(super) fn size(kind: &str) -> (i32, i32) {
    PARTS.iter().find(|part| part.kind == kind).map_or((0, 0), |part| part.size)
}

/// The place of a part's contact.
pub(super) fn place(kind: &str, contact: &str) -> (i32, i32) {
    PARTS.iter().find(|part| part.kind == kind).map_or((0, 0), |part| at(part.contacts, contact))
}

/// The place of a contact in a list of them.
pub(super) fn at(contacts: &str, wanted: &str) -> (i32, i32) {
    let place = |word: &str| {
        let (name, place) = word.split_once('@')?;
        let (x, y) = place.split_once(',').filter(|_| name == wanted)?;
        Some((x.parse().ok()?, y.parse().ok()?))
    };
    contacts.split(' ').find_map(place).unwrap_or_default()
}

/// Whether a contact is in a list of them.
pub(super) fn has(contacts: &str, wanted: &str) -> bool {
    contacts.split(' ').any(|word| word.split('@').next() == Some(wanted))
}

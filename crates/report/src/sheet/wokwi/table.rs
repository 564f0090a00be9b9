//! What Wokwi has: its boards with their contacts, its parts, and which of them is which part of a design.
//!
//! Names, contacts and sizes are facts from `@wokwi/elements` 1.9.2, `wokwi-boards` and the reference in `wokwi-docs`.

use sensedsl_model::kind::KindName;
use sensedsl_wire::Direction;

/// A board of Wokwi's.
#[derive(Debug)]
pub(super) struct WokwiBoard {
    /// The built-in board that it is.
    pub(super) name: &'static str,
    /// Wokwi's type.
    pub(super) kind: &'static str,
    /// Width and height in pixels.
    pub(super) size: (i32, i32),
    /// How its contacts are called.
    pub(super) names: Names,
    /// The contacts of ground, 3.3 V and 5 V, and which of the two the MCU runs at.
    pub(super) ground: &'static [&'static str],
    pub(super) three: &'static [&'static str],
    pub(super) five: &'static [&'static str],
    pub(super) logic: Rail,
    /// Its contacts with their places: `GP4@4,62`.
    pub(super) contacts: &'static str,
    /// Contacts of pins that are called otherwise.
    pub(super) others: &'static [(&'static str, &'static str)],
}

/// How a board's contacts are called.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Names {
    /// As printed, without a D before a number: `13`, `A0`.
    Numbers,
    /// As printed: `D13`, `A0`.
    Printed,
    /// As the pins: `GP4`, `PB12`; `.1` behind it where there are several.
    Pins,
    /// As the pins, without the P: `B12`.
    Short,
}

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

const PICO: &str = "GP0@6,13 GP1@6,22 GND.1@6,32 GP2@6,42 GP3@6,51 GP4@6,61 GP5@6,70 GND.2@6,80 GP6@6,90 GP7@6,99 \
                    GP8@6,109 GP9@6,118 GND.3@6,128 GP10@6,138 GP11@6,147 GP12@6,157 GP13@6,166 GND.4@6,176 \
                    GP14@6,186 GP15@6,195 GP16@73,195 GP17@73,186 GND.5@73,176 GP18@73,166 GP19@73,157 GP20@73,147 \
                    GP21@73,138 GND.6@73,128 GP22@73,118 GP26@73,99 GP27@73,90 GND.7@73,80 GP28@73,70 3V3@73,51 \
                    GND.8@73,32 VBUS@73,13";
const PICO_GROUND: &[&str] =
    &["GND.1", "GND.2", "GND.3", "GND.4", "GND.5", "GND.6", "GND.7", "GND.8"];
const NUCLEO_32: &str = "D1@6,37 D0@6,47 GND.1@6,66 D2@6,76 D3@6,85 D4@6,95 D5@6,104 D6@6,114 D7@6,124 D8@6,133 \
                         D9@6,143 D10@6,152 D11@6,162 D12@6,172 GND.2@64,47 5V@64,66 A7@64,76 A6@64,85 A5@64,95 \
                         A4@64,104 A3@64,114 A2@64,124 A1@64,133 A0@64,143 3V3@64,162 D13@64,172";

/// All boards.
pub(super) const BOARDS: &[WokwiBoard] = &[
    WokwiBoard {
        name: "ARDUINO-UNO-R3",
        kind: "wokwi-arduino-uno",
        size: (275, 202),
        names: Names::Numbers,
        ground: &["GND.2", "GND.3", "GND.1"],
        three: &["3.3V"],
        five: &["5V"],
        logic: Rail::Five,
        contacts: "GND.1@116,9 13@125,9 12@135,9 11@144,9 10@154,9 9@163,9 8@173,9 7@189,9 6@199,9 5@208,9 4@218,9 \
                   3@227,9 2@237,9 1@246,9 0@256,9 3.3V@150,192 5V@160,192 GND.2@170,192 GND.3@179,192 A0@208,192 \
                   A1@218,192 A2@227,192 A3@237,192 A4@246,192 A5@256,192",
        others: &[],
    },
    WokwiBoard {
        name: "ARDUINO-NANO",
        kind: "wokwi-arduino-nano",
        size: (170, 68),
        names: Names::Numbers,
        ground: &["GND.1", "GND.2"],
        three: &["3.3V"],
        five: &["5V"],
        logic: Rail::Five,
        contacts: "12@20,5 11@29,5 10@39,5 9@49,5 8@58,5 7@68,5 6@77,5 5@87,5 4@97,5 3@106,5 2@116,5 GND.2@125,5 \
                   0@145,5 1@154,5 13@20,62 3.3V@29,62 A0@49,62 A1@58,62 A2@68,62 A3@77,62 A4@87,62 A5@97,62 \
                   A6@106,62 A7@116,62 5V@125,62 GND.1@145,62",
        others: &[],
    },
    WokwiBoard {
        name: "ARDUINO-MEGA-2560",
        kind: "wokwi-arduino-mega",
        size: (388, 192),
        names: Names::Numbers,
        ground: &["GND.2", "GND.3", "GND.4", "GND.5", "GND.1"],
        three: &["3.3V"],
        five: &["5V", "5V.1", "5V.2"],
        logic: Rail::Five,
        contacts: "GND.1@119,9 13@129,9 12@138,9 11@148,9 10@158,9 9@168,9 8@177,9 7@190,9 6@200,9 5@210,9 4@219,9 \
                   3@229,9 2@238,9 1@248,9 0@258,9 14@271,9 15@280,9 16@290,9 17@299,9 18@309,9 19@319,9 20@328,9 \
                   21@338,9 5V.1@361,8 5V.2@371,8 22@361,18 23@371,18 24@361,27 25@371,27 26@361,37 27@371,37 \
                   28@361,46 29@371,46 30@361,56 31@371,56 32@361,66 33@371,66 34@361,75 35@371,75 36@361,85 \
                   37@371,85 38@361,94 39@371,94 40@361,104 41@371,104 42@361,114 43@371,114 44@361,123 45@371,123 \
                   46@361,133 47@371,133 48@361,142 49@371,142 50@361,152 51@371,152 52@361,162 53@371,162 \
                   GND.4@361,171 GND.5@371,171 3.3V@155,185 5V@165,185 GND.2@174,185 GND.3@184,185 A0@209,185 \
                   A1@218,185 A2@228,185 A3@237,185 A4@247,185 A5@256,185 A6@266,185 A7@276,185 A8@290,185 \
                   A9@300,185 A10@310,185 A11@319,185 A12@329,185 A13@339,185 A14@348,185 A15@358,185",
        others: &[],
    },
    WokwiBoard {
        name: "RASPBERRYPI-PICO",
        kind: "wokwi-pi-pico",
        size: (79, 200),
        names: Names::Pins,
        ground: PICO_GROUND,
        three: &["3V3"],
        five: &["VBUS"],
        logic: Rail::Three,
        contacts: PICO,
        others: &[],
    },
    WokwiBoard {
        name: "RASPBERRYPI-PICO-W",
        kind: "board-pi-pico-w",
        size: (79, 200),
        names: Names::Pins,
        ground: PICO_GROUND,
        three: &["3V3"],
        five: &["VBUS"],
        logic: Rail::Three,
        contacts: PICO,
        others: &[],
    },
    WokwiBoard {
        name: "RASPBERRYPI-PICO-2",
        kind: "board-pi-pico-2",
        size: (79, 200),
        names: Names::Pins,
        ground: PICO_GROUND,
        three: &["3V3"],
        five: &["VBUS"],
        logic: Rail::Three,
        contacts: PICO,
        others: &[],
    },
    WokwiBoard {
        name: "NUCLEO-C031C6",
        kind: "board-st-nucleo-c031c6",
        size: (265, 317),
        names: Names::Pins,
        ground: &["GND.3", "GND.4", "GND.5", "GND.6", "GND.7", "GND.8", "GND.9", "GND.1", "GND.2"],
        three: &["3V3.1", "3V3.2"],
        five: &["5V.1", "5V.2", "5V.3"],
        logic: Rail::Three,
        contacts: "PD0@11,124 PD2@11,134 PA14@11,153 PA13@11,182 PC6@11,201 GND.1@11,210 PC13@11,230 PC14@11,239 \
                   PF0@11,258 PF1@11,268 PB11@11,287 PA2@11,297 PD1@20,124 GND.2@20,153 3V3.1@20,191 5V.1@20,201 \
                   GND.3@20,210 GND.4@20,220 PA0@20,249 PA1@20,258 PA4@20,268 PB1@20,278 PA11@20,287 PA12@20,297 \
                   3V3.2@39,191 5V.2@39,201 GND.5@39,210 GND.6@39,220 5V.3@253,153 PA3@253,162 PC15@253,172 \
                   PB12.1@253,182 PB2@253,201 GND.7@253,210 PF3@253,220 PA8@253,230 PB15@253,239 PB14@253,249 \
                   PB13@253,258 PB0.1@253,278 PB8@244,134 PB9@244,143 GND.8@244,162 PA5@244,172 PA6@244,182 \
                   PA7@244,191 PC7@244,210 PA9@244,220 PA15@244,230 PB5@244,239 PB4@244,249 PB10@244,258 \
                   PB3@244,268 PA10@244,278 PB6@244,287 PB7@244,297 GND.9@224,153",
        others: &[],
    },
    WokwiBoard {
        name: "NUCLEO-L031K6",
        kind: "board-st-nucleo-l031k6",
        size: (71, 198),
        names: Names::Printed,
        ground: &["GND.1", "GND.2"],
        three: &["3V3"],
        five: &["5V"],
        logic: Rail::Three,
        contacts: NUCLEO_32,
        others: &[("PA15", "VCP_RX")],
    },
    WokwiBoard {
        name: "NUCLEO-L432KC",
        kind: "board-st-nucleo-l432kc",
        size: (71, 198),
        names: Names::Printed,
        ground: &["GND.1", "GND.2"],
        three: &["3V3"],
        five: &["5V"],
        logic: Rail::Three,
        contacts: NUCLEO_32,
        others: &[("PA15", "VCP_RX")],
    },
    WokwiBoard {
        name: "BLUEPILL-F103C8",
        kind: "board-stm32-bluepill",
        size: (87, 205),
        names: Names::Short,
        ground: &["GND.1", "GND.2", "GND.3"],
        three: &["3V3.1", "3V3.2"],
        five: &["5V.1"],
        logic: Rail::Three,
        contacts: "B12@13,11 B13@13,21 B14@13,30 B15@13,40 A8@13,49 A9@13,59 A10@13,69 A11@13,78 A12@13,88 \
                   A15@13,97 B3@13,107 B4@13,117 B5@13,126 B6@13,136 B7@13,145 B8@13,155 B9@13,165 5V.1@13,174 \
                   GND.1@13,184 3V3.1@13,193 GND.2@73,11 GND.3@73,21 3V3.2@73,30 B11@73,49 B10@73,59 B1@73,69 \
                   B0@73,78 A7@73,88 A6@73,97 A5@73,107 A4@73,117 A3@73,126 A2@73,136 A1@73,145 A0@73,155 \
                   C15@73,165 C14@73,174 C13@73,184",
        others: &[],
    },
    WokwiBoard {
        name: "BLACKPILL-F411CE",
        kind: "board-stm32-blackpill",
        size: (79, 201),
        names: Names::Short,
        ground: &["GND.1", "GND.3"],
        three: &["3V3.1", "3V3.2"],
        five: &["5V.1", "5V.2"],
        logic: Rail::Three,
        contacts: "C13@10,22 C14@10,31 C15@10,41 A0@10,60 A1@10,70 A2@10,79 A3@10,89 A4@10,98 A5@10,108 A6@10,118 \
                   A7@10,127 B0@10,137 B1@10,146 B2@10,156 B10@10,166 3V3.1@10,175 GND.1@10,185 5V.1@10,194 \
                   3V3.2@67,11 GND.3@67,21 5V.2@67,30 B9@67,40 B8@67,49 B7@67,59 B6@67,69 B5@67,78 B4@67,88 \
                   B3@67,97 A15@67,107 A12@67,117 A11@67,126 A10@67,136 A9@67,145 A8@67,155 B15@67,165 B14@67,174 \
                   B13@67,184 B12@67,193",
        others: &[],
    },
];

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

/// A board by the name of the built-in one.
pub(super) fn board(name: &str) -> Option<&'static WokwiBoard> {
    BOARDS.iter().find(|board| board.name == name)
}

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

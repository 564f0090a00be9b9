//! The vocabulary of the generated designs: kinds with their properties, right values and wrong
//! ones, boards, types, rules.

/// A property with values that are right, the plainest first, and values that are not.
pub(super) type Property = (&'static str, &'static [&'static str], &'static [&'static str]);

/// A kind of device.
#[derive(Debug)]
pub(super) struct Kind {
    pub(super) name: &'static str,
    pub(super) is_sensor: bool,
    pub(super) is_actuator: bool,
    pub(super) types: &'static [&'static str],
    /// What a device must have besides `id` and `type`.
    pub(super) needs: &'static [Property],
    pub(super) may: &'static [Property],
    /// Roles that fix a pin, with plausible pins.
    pub(super) roles: &'static [&'static str],
    /// Drivers of the library, each with what it needs.
    pub(super) drivers: &'static [&'static str],
}

const fn both(name: &'static str, types: &'static [&'static str]) -> Kind {
    let (is_sensor, is_actuator) = (true, true);
    Kind { name, is_sensor, is_actuator, types, needs: &[], may: &[], roles: &[], drivers: &[] }
}

const fn sensor(name: &'static str, types: &'static [&'static str]) -> Kind {
    Kind { is_actuator: false, ..both(name, types) }
}

const fn actuator(name: &'static str, types: &'static [&'static str]) -> Kind {
    Kind { is_sensor: false, ..both(name, types) }
}

/// Values of constants, and what else may stand where a value may.
pub(super) const CONSTANTS: &[&str] =
    &["5", "60 ms", "3 V..5 V", "N0 * 2", "-(1 + 2) / 3", "[1..2, [3, 4 us]]", "N9", "1 / 0"];

/// Lines of chips and of drivers with readings: such as are right, and such as are not.
pub(super) const CHIP_LINES: &[&str] = &[
    "driver = mpu6050;",
    "address = 0x68;",
    "delay = 2 * N0;",
    "prefer side = left;",
    "connection bus { speed = 100 kHz; }",
    "connection c0 { pin = PA1; }",
    "sensor Rate returns int16[3] { id = 201; reading = rate; }",
    "actuator Set accepts uint8[N0] { id = 202; }",
    "id = 200;",
];

/// The same of drivers.
pub(super) const READING_LINES: &[&str] = &[
    "connection bus for i2c { address = 0x68; speed = 400 kHz; }",
    "connection c0 for digital {}",
    "reading rate returns int16[3] { register = 0x43; length = 6; order = big; }",
    "reading turn returns uint8 { via = bus; register = 1; bits = 7..4; signed = false; }",
    "command set accepts uint16 { via = c0; }",
    "init = [[0x6B, 0x80], 100 ms, [0x6B, 0x00]];",
    "identity = [0x75, 0x68];",
    "supply = 2.4 V..3.5 V;",
    "curve = [[0.4, 80], [1.3, 20]];",
    "part = \"a part\";",
];

const NUMBERS: &[&str] = &["uint16", "uint8", "int16", "uint32", "float32", "int64", "float64"];
const ANY: &[&str] =
    &["uint16", "int16[3]", "uint8[32]", "bool", "float32", "uint64", "uint8[1024]"];
const LEVELS: &[&str] = &["bool", "uint8", "int32"];

const BYTES: &[&str] = &["[0x00, 0x51]", "[]", "[7]", "\"$GP\"", "5"];
const BAD_BYTES: &[&str] = &["[256]", "[1, -1]", "[\"x\"]", "[[1]]", "1.5"];

/// The kinds for which there is firmware come first.
pub(super) const KINDS: &[Kind] = &[
    Kind {
        may: &[
            ("samples", &["32", "1", "1024", "7"], &["0", "1025", "1.5"]),
            ("sampling", &["84", "3", "480", "1000"], &["0", "2 s"]),
        ],
        roles: &["pin"],
        ..sensor("analog", NUMBERS)
    },
    Kind {
        may: &[
            ("mode", &["count", "width", "period", "frequency", "duty"], &["area", "1"]),
            ("edge", &["rising", "falling", "both"], &["up"]),
            ("resolution", &["10 kHz", "1 us", "1 MHz", "1000"], &["0", "7 MHz", "1 h"]),
            ("pulse", &["10 us", "1 ms", "10 ms"], &["0", "1 s", "10 Hz"]),
        ],
        roles: &["pin", "trigger"],
        drivers: &["driver = hcsr04;", "driver = rc_channel;"],
        ..sensor("icu", NUMBERS)
    },
    Kind {
        needs: &[(
            "address",
            &["0x70", "0x71", "0xE2", "0xE4", "0x1E", "0x68", "0x48"],
            &["0x100", "0x03", "0xE3", "-1"],
        )],
        may: &[
            ("speed", &["100 kHz", "400 kHz", "1 MHz", "1 kHz"], &["2 MHz", "1 ms"]),
            ("exclusive", &["false", "true"], &["yes"]),
            ("trigger", BYTES, BAD_BYTES),
            ("wait", &["0", "65 ms", "1 s"], &["-1", "61 s"]),
            ("register", &["0", "2", "255"], &["256", "[1]"]),
            ("length", &["2"], &["0", "2049", "6", "1", "32", "2048"]),
            ("order", &["big", "little"], &["middle"]),
            ("start", BYTES, BAD_BYTES),
            ("encoding", &["none"], &["text", "morse"]),
        ],
        roles: &["scl", "sda"],
        drivers: &[
            "driver = srf08; address = 0x70;",
            "driver = srf10; address = 0xE2;",
            "driver = srf02; address = 0x71;",
            "driver = mpu6050_rate; address = 0x68;",
            "driver = as5600; address = 0x36;",
            "driver = cmps03; address = 0x60;",
            "driver = lm75; address = 0x48;",
            "driver = tmp102; address = 0x4A;",
        ],
        ..both("i2c", ANY)
    },
    Kind {
        may: &[
            ("pull", &["none", "up", "down"], &["left"]),
            ("active", &["high", "low"], &["1"]),
            ("edge", &["both", "rising", "falling"], &["none"]),
            ("debounce", &["0", "10 ms", "10 s"], &["11 s", "1 kHz"]),
            ("initial", &["false", "true"], &["2"]),
        ],
        roles: &["pin"],
        ..both("digital", LEVELS)
    },
    Kind {
        may: &[("counts", &["2000", "1", "10000000"], &["0", "1e9"])],
        roles: &["a", "b"],
        ..sensor("encoder", NUMBERS)
    },
    Kind {
        may: &[
            ("mode", &["position", "velocity"], &["torque"]),
            ("speed", &["4000", "1", "500000"], &["0", "500001", "1 ms"]),
            ("acceleration", &["8000", "1", "10000000"], &["0", "-1"]),
            ("pulse", &["2 us", "1 ms"], &["0", "2 ms"]),
            ("forward", &["high", "low"], &["up"]),
            ("enabled", &["low", "high"], &["true"]),
            ("enable", &["none"], &["5"]),
        ],
        roles: &["step", "dir"],
        drivers: &["driver = a4988; reading = target;"],
        ..actuator("stepper", NUMBERS)
    },
    Kind {
        may: &[
            ("baud", &["9600", "115200", "300", "10000000"], &["1", "9600 Hz"]),
            ("frame", &["\"8N1\"", "\"7E1\"", "\"8O1\""], &["\"9N1\"", "8"]),
            ("start", BYTES, BAD_BYTES),
            ("end", BYTES, BAD_BYTES),
            ("length", &["2", "1024"], &["0", "1025"]),
            ("behind", BYTES, BAD_BYTES),
            ("wait", &["5 ms", "1 s"], &["0 ms", "2 s"]),
            ("tx", &["none"], &["5"]),
        ],
        roles: &["tx", "rx"],
        ..both("uart", ANY)
    },
    Kind {
        may: &[
            ("clock", &["1 MHz", "1 kHz", "100 MHz"], &["1 s", "0"]),
            ("mode", &["0", "3"], &["4"]),
            ("read", BYTES, BAD_BYTES),
            ("length", &["6", "1024"], &["0"]),
            ("encoding", &["none"], &["ws2812", "text"]),
        ],
        roles: &["sck", "miso", "mosi", "cs"],
        drivers: &["driver = ws2812b;", "driver = apa102;"],
        ..both("spi", ANY)
    },
    Kind {
        may: &[
            ("frequency", &["50 Hz", "20 kHz", "1 MHz", "1 Hz"], &["0", "20 ms"]),
            ("min", &["1 ms", "0"], &["-1 ms"]),
            ("max", &["2 ms", "20 ms"], &["1 h"]),
            ("failsafe", &["0", "5000", "-1", "0.5"], &["true"]),
        ],
        roles: &["pin"],
        drivers: &["driver = servo;"],
        ..actuator("pwm", NUMBERS)
    },
    Kind {
        may: &[("failsafe", &["0", "4095"], &["off"])],
        roles: &["pin"],
        ..actuator("dac", NUMBERS)
    },
    Kind {
        needs: &[("frame", &["0x120", "0", "0x1FFFFFFF"], &["0x20000000", "-1"])],
        may: &[
            ("bitrate", &["500 kHz", "1 MHz", "10 kHz"], &["1 kHz"]),
            ("byte", &["0", "2", "63"], &["64"]),
        ],
        roles: &["tx", "rx"],
        ..both("can", ANY)
    },
    Kind {
        needs: &[("protocol", &["w1", "dht"], &["i2c", "1"])],
        may: &[
            ("family", &["0x28", "1", "255"], &["0", "256"]),
            (
                "rom",
                &["\"28-0000055f311a\"", "\"02 1C B8 01 00 00 00 A2\""],
                &["\"28\"", "\"021CB801000000A3\""],
            ),
            ("pulse", &["1 ms", "18 ms"], &["0", "1 s"]),
            ("trigger", &["[0x44]", "[]"], BAD_BYTES),
            ("read", &["[0xBE]"], &["[]"]),
            ("wait", &["750 ms", "0", "1 s"], &["-1", "61 s"]),
            ("length", &["2", "1"], &["0", "9"]),
            ("order", &["big", "little"], &["middle"]),
        ],
        roles: &["pin"],
        drivers: &["driver = ds18b20;", "driver = dht22; delay = 2 s;"],
        ..sensor("onewire", ANY)
    },
    Kind {
        may: &[
            ("default", &["0", "1", "0.8", "-5"], &["1e999", "x"]),
            ("store", &["false", "true"], &["1"]),
        ],
        ..both("code", ANY)
    },
];

/// What a controller may say, and wrong values.
pub(super) const CONTROLLER: &[Property] = &[
    ("takes", &["200 us", "1 us", "4 ms"], &["1 Hz", "61 s"]),
    ("host", &["refused", "override"], &["maybe"]),
    ("prio", &["0", "+12"], &["61"]),
    ("id", &["240"], &["0", "255"]),
    ("label", &["\"by itself\""], &["[1]"]),
];

/// Kinds with firmware: the first ones of [`KINDS`].
pub(super) const WITH_FIRMWARE: usize = 3;

/// What any device may say.
pub(super) const COMMON: &[Property] = &[
    ("delay", &["1000 ms", "60 ms", "1 ms", "1 s"], &["0", "2 MHz", "1e9"]),
    ("prio", &["0", "+12", "-60", "60"], &["61", "1.5"]),
    ("label", &["\"front left\"", "\"\"", "\"<&\\\"'%|*`{{\\n\\u{202e}\"", "\"\\\\\""], &["[1]"]),
    ("quantity", &["cm", "\"°C\"", "\"%d\"", "\"*/\""], &["7"]),
    ("scale", &["1", "0.5", "-1.5e-3", "1e308", "0"], &["1e999", "x"]),
    ("offset", &["0", "-273.15", "1e-308"], &["[0]"]),
    ("min", &["0", "1"], &["a", "-5"]),
    ("max", &["100", "90"], &["b", "1e9"]),
    // From here on a plain design has none.
    ("level", &["3.3 V", "5 V", "5000 mV", "12.6"], &["5 kHz", "0"]),
    ("divider", &["[10 kOhm, 20 kOhm]", "[0.82 kOhm, 1000]"], &["[1 kOhm]", "[1 V, 2]"]),
    ("group", &["ultrasonic", "none", "x"], &["1"]),
    ("unit", UNITS, &["ADC99", "PA1", "5"]),
    ("side", &["left", "right", "bottom"], &["3"]),
    ("header", &["P1", "P2", "CN7"], &["\"\""]),
];

/// So many of them a plain design may have.
pub(super) const COMMON_PLAIN: usize = 8;

pub(super) const UNITS: &[&str] = &[
    "ADC1", "ADC2", "ADC3", "I2C1", "I2C2", "TIM3", "TIM4", "TIM2", "USART2", "SPI1", "CAN1",
    "DAC1", "TIM9", "UART4",
];

pub(super) const PINS: &[&str] = &[
    "PA1", "PA2", "PA3", "PB0", "PB1", "PB6", "PB7", "PB8", "PB9", "PB10", "PB11", "PC1", "PC2",
    "PC4", "PC5", "PD12", "PE9", "PA0", "PA13", "PC14", "GP4", "D3", "PZ99",
];

/// Names that boards have printed, and parts on them.
pub(super) const PRINTED: &[&str] = &["LED", "D13", "A0", "\"CN7.3\"", "\"\""];

/// Built-in boards and parts: those with firmware and few pins first.
pub(super) const BOARDS: &[&str] = &[
    "STM32F4DiscoveryBoard",
    "STM32F4DiscoveryBoard",
    "STM32F4DiscoveryBoard",
    "STM32F407G_DISC1",
    "NUCLEO_F411RE",
    "STM32F429I_DISC1",
    "NUCLEO_F401RE",
    "NUCLEO_F446RE",
    "STM32F103C8T6",
    "Pico",
    "ArduinoUno",
    "STM32F401CCU6",
    "NUCLEO_L432KC",
    "STM32H743ZIT6",
    "stm32f407vgt6",
    "NoSuchBoard",
];

/// So many of them come first.
pub(super) const WITH_FIRMWARE_BOARDS: usize = 8;

pub(super) const TARGETS: &[&str] = &["none", "chibios-21.11", "chibios", "zephyr"];

/// Rows of small tables: all pins of an STM32F407, with what they can do there.
pub(super) const ROWS: &[[&str; 2]] = &[
    ["PA1", "ADC123_IN1 TIM2_CH2@1 TIM5_CH2@2"],
    ["PB6", "I2C1_SCL@4 TIM4_CH1@2 USART1_TX@7"],
    ["PB7", "I2C1_SDA@4 TIM4_CH2@2 USART1_RX@7"],
    ["PC1", "ADC123_IN11"],
    ["PA2", "ADC123_IN2 TIM2_CH3@1 TIM9_CH1@3 USART2_TX@7"],
    ["PA3", "ADC123_IN3 TIM2_CH4@1 TIM9_CH2@3 USART2_RX@7"],
    ["PB10", "I2C2_SCL@4 TIM2_CH3@1 USART3_TX@7"],
    ["PB11", "I2C2_SDA@4 TIM2_CH4@1 USART3_RX@7"],
    ["PA4", "ADC12_IN4 DAC1_OUT1"],
    ["PA5", "ADC12_IN5 DAC1_OUT2 SPI1_SCK@5 TIM2_CH1@1"],
    ["PA6", "ADC12_IN6 SPI1_MISO@5 TIM3_CH1@2"],
    ["PA7", "ADC12_IN7 SPI1_MOSI@5 TIM3_CH2@2"],
    ["PD0", "CAN1_RX@9"],
    ["PD1", "CAN1_TX@9"],
    ["PE9", "TIM1_CH1@1"],
    ["PE11", "TIM1_CH2@1"],
];

/// Cells that are odd in one way or the other.
pub(super) const ODD_CELLS: &[&str] = &[
    "ADC1_IN1 ADC1_IN1",
    "TIM3_CH9",
    "I2C1-SLC",
    "\"a,b\"",
    "\"",
    "TIM3_CH1@16",
    "TIM2_CH1#0|2",
    "-",
    "ADC12IN8",
    "I²C1-SCL",
    "PA1",
    "=1+1",
    "TIM3_CH1N",
    "TIM99_CH1",
    "x\u{a0}y",
];

/// Rows that are odd.
pub(super) const ODD_ROWS: &[&str] =
    &["PA1,,,\n", "PA01,P1\n", ",,,,,,\n", "VDD,,,\n", "PB6,\"x\ny\",,\n"];

/// Pieces of text that break a file in some place.
pub(super) const BREAKS: &[&str] = &[
    "",
    ";",
    "{",
    "}",
    "\"",
    "/*",
    "id = 1;",
    "sensor",
    "=",
    "0x",
    "1e999",
    "\u{feff}",
    "\u{202e}",
    "[",
    "]]",
    "use \"robot.sense\";",
    "board B {}",
    "18446744073709551616",
    "-",
    "..",
    "1..5",
    " * (2",
    ")",
    "const N0 = 4;",
    "chip C {",
    "reading r returns int8 {",
    "é",
    "// x\n",
    "\\",
];

pub(super) const CODES: &[&str] = &["W0601", "W0602", "W0603", "W0604", "W0605", "H0703", "E0401"];

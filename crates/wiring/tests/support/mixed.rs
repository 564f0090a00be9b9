//! Seeded designs on several boards: a family and a number in, always the same text out.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use sensedsl_model::design::Design;
use sensedsl_model::{FileRequest, Files, ReadError, Request, resolve};

/// A small generator (splitmix64), so that a seed always gives the same design.
struct Rng(u64);

impl Rng {
    fn below(&mut self, limit: u64) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        (z ^ (z >> 31)) % limit
    }

    /// One of the words; empty if there are none.
    fn of<'a>(&mut self, words: &[&'a str]) -> &'a str {
        if words.is_empty() {
            return "";
        }
        words.get(self.below(words.len() as u64) as usize).copied().unwrap_or_default()
    }
}

/// A design as files.
pub struct Text {
    pub sense: String,
    /// The target that it is for.
    pub target: &'static str,
    /// Tables by the names of their files.
    pub tables: BTreeMap<String, String>,
}

impl Files for Text {
    fn read(&self, wanted: &FileRequest<'_>) -> Result<String, ReadError> {
        self.tables.get(wanted.path).cloned().ok_or(ReadError::Missing)
    }
}

impl Text {
    /// The design for its target.
    pub fn design(&self) -> Design {
        let target = Some(self.target);
        let request = Request { path: "mixed.sense", text: &self.sense, board: None, target };
        let resolved = resolve(&request, self);
        let reported: Vec<&str> =
            resolved.diagnostics.iter().map(|one| one.message.as_str()).collect();
        resolved.design.unwrap_or_else(|| panic!("{reported:?}\n{}", self.sense))
    }
}

pub struct Family {
    pub name: &'static str,
    pub number: u64,
    pub make: fn(u64) -> Text,
}

pub const FAMILIES: &[Family] = &[
    Family { name: "mixed boards", number: 500, make: mixed },
    Family { name: "eight equal F407", number: 10, make: eight_equal },
    Family { name: "64 digital on 63 pins", number: 1, make: digital_64 },
    Family { name: "30 i2c with 7 addresses", number: 1, make: i2c_30 },
    Family { name: "two F407 with 61 i2c", number: 1, make: i2c_61 },
    Family { name: "four equal chips", number: 1, make: four_chips },
    Family { name: "robots", number: 100, make: robot },
    Family { name: "robots of 40 devices", number: 1000, make: small_robot },
];

/// Boards of the catalog beside those with a table of their own.
const BOARDS: &[&str] = &["STM32F4DiscoveryBoard", "NUCLEO_G474RE", "BLUEPILL_F103C8"];

/// Two to four unequal boards; one to three devices of some kinds of buses, fixed to a board or
/// floating; up to twelve floating devices with a pin or two.
fn mixed(seed: u64) -> Text {
    let mut rng = Rng(seed.wrapping_mul(0x1234_5678_9ABC_DEF1) ^ 0x4D49_5845);
    let boards = 2 + rng.below(3);
    let mut tables = BTreeMap::new();
    let mut places = Vec::new();
    let mut on_boards = vec![String::new(); boards as usize];
    for board in 0..boards {
        if board > 0 && rng.below(3) == 0 {
            places.push(rng.of(BOARDS).to_owned());
        } else {
            let name = format!("table_{board}.csv");
            let pins = 12 + rng.below(69);
            tables.insert(name.clone(), table(&mut rng, pins));
            places.push(format!("\"{name}\""));
        }
    }
    let mut floating = String::new();
    let mut number = 0;
    let mut put = |rng: &mut Rng, on_boards: &mut [String], kind: &str, fixed: u64| {
        number += 1;
        let text = device(number, kind);
        let on = rng.below(boards) as usize;
        match on_boards.get_mut(on).filter(|_| rng.below(4) < fixed) {
            Some(board) => board.push_str(&text),
            None => floating.push_str(&text),
        }
    };
    for kind in ["i2c", "spi", "can", "uart"] {
        let some = if kind == "i2c" || kind == "spi" { 3 } else { 1 };
        if rng.below(4) < some {
            for _ in 0..1 + rng.below(3) {
                put(&mut rng, &mut on_boards, kind, 2);
            }
        }
    }
    for _ in 0..rng.below(13) {
        let kind = rng.of(&["digital", "digital", "output", "analog", "pwm", "icu"]);
        put(&mut rng, &mut on_boards, kind, 0);
    }
    let spare = rng.below(3) == 0;
    let mut sense = String::new();
    for (board, (place, devices)) in places.iter().zip(&on_boards).enumerate() {
        let spare = if spare && board > 0 && board + 1 == places.len() { "spare " } else { "" };
        let _ = writeln!(sense, "{spare}board Brd{board} on {place} {{\n{devices}}}");
    }
    sense.push_str(&floating);
    Text { sense, target: "none", tables }
}

/// Boards that robots are built on.
const ROBOT_BOARDS: &[&str] = &[
    "STM32F407G_DISC1",
    "NUCLEO_F446RE",
    "NUCLEO_G474RE",
    "NUCLEO_F303RE",
    "BLUEPILL_F103C8",
    "NUCLEO_F429ZI",
    "NUCLEO_L476RG",
    "BLACKPILL_F411CE",
];

/// Robot boards whose tables name no header.
const WITHOUT_HEADERS: &[&str] = &["STM32F407G_DISC1", "BLUEPILL_F103C8", "BLACKPILL_F411CE"];

/// Parts of the library with the number of their devices, and the addresses that each can have;
/// empty if it has no address.
const CHIPS: &[(&str, u64, &[&str])] = &[
    ("gearmotor_tb6612", 2, &[]),
    ("gearmotor_tb6612", 2, &[]),
    ("tb6612", 2, &[]),
    ("drv8833", 2, &[]),
    ("l298n", 2, &[]),
    ("mpu6050", 3, &["0x68", "0x69"]),
    ("bme280", 3, &["0x76", "0x77"]),
    ("ina226", 4, &["0x40", "0x41", "0x44"]),
    ("ads1115", 4, &["0x48", "0x49", "0x4A", "0x4B"]),
    ("pca9685", 17, &["0x40", "0x41"]),
    ("vl53l1x", 2, &["0x29"]),
    ("mcp3008", 8, &[]),
    ("mpu6500_spi", 3, &[]),
    ("nmea_gps", 10, &[]),
];

/// Single values and arrays.
const SINGLES: &[&str] = &[
    "sensor NAME returns uint16 { type = analog; }",
    "sensor NAME returns uint16 { type = analog; }",
    "sensor NAME returns bool { type = digital; }",
    "actuator NAME accepts bool { type = digital; }",
    "sensor NAME returns uint16 { driver = hcsr04; }",
    "sensor NAME returns uint16 { driver = rc_channel; }",
    "actuator NAME accepts uint16 { driver = servo; }",
    "actuator NAME accepts uint16 { driver = esc_400hz; }",
    "sensor NAME returns int32 { driver = quadrature_encoder; }",
    "sensor NAME returns uint16 { driver = srf02; address = 0x7ADDRESS; }",
    "sensor NAME returns bool[COUNT] { type = digital; sequence = header; }",
    "sensor NAME returns bool[COUNT] { type = digital; }",
    "sensor NAME returns uint16[COUNT] { type = analog; together = unit; }",
    "actuator NAME accepts uint16[COUNT] { type = pwm; frequency = 50 Hz; prefer together = unit; }",
];

/// One to four boards, all equal in a third of the designs, and 4 to 43 parts of the library,
/// single values and arrays: alone or several of a kind, on a board or floating.
fn robot(seed: u64) -> Text {
    let mut rng = Rng(seed.wrapping_mul(0x2545_F491_4F6C_DD1D) ^ 0x524F_424F);
    let mut robot = Robot::new(&mut rng);
    let most = 4 + rng.below(37);
    while robot.parts < most {
        let alike = if rng.below(4) == 0 { 2 + rng.below(3) } else { 1 };
        let (part, _) = part(&mut rng);
        robot.put(&mut rng, &part, alike);
    }
    robot.text(seed)
}

/// The same robots with 4 to 40 devices, where each value of a chip and each element of an array is
/// one. Arrays lie along a header only if all boards have one.
fn small_robot(seed: u64) -> Text {
    let mut rng = Rng(seed.wrapping_mul(0x9E6C_63D0_876A_68DD) ^ 0x534D_414C);
    let mut robot = Robot::new(&mut rng);
    let mut left = 4 + rng.below(37);
    while left > 0 {
        let (mut part, devices) = part(&mut rng);
        if !robot.has_headers() {
            part = part.replace(" sequence = header;", "");
        }
        let alike = if rng.below(4) == 0 { 2 + rng.below(3) } else { 1 };
        let alike = alike.min(left / devices);
        robot.put(&mut rng, &part, alike);
        left -= alike * devices;
    }
    robot.text(seed)
}

struct Robot {
    /// Each board's name and the parts that are fixed to it.
    boards: Vec<(&'static str, String)>,
    floating: String,
    parts: u64,
}

impl Robot {
    fn new(rng: &mut Rng) -> Self {
        let boards = 1 + rng.below(4);
        let are_equal = rng.below(3) == 0;
        let first = rng.of(ROBOT_BOARDS);
        let boards = (0..boards)
            .map(|_| (if are_equal { first } else { rng.of(ROBOT_BOARDS) }, String::new()))
            .collect();
        Self { boards, floating: String::new(), parts: 0 }
    }

    fn has_headers(&self) -> bool {
        self.boards.iter().all(|(board, _)| !WITHOUT_HEADERS.contains(board))
    }

    /// Adds some equal parts, on one board or floating.
    fn put(&mut self, rng: &mut Rng, part: &str, alike: u64) {
        let on = (rng.below(3) == 0).then(|| rng.below(self.boards.len() as u64) as usize);
        for _ in 0..alike {
            self.parts += 1;
            let text = part.replace("NAME", &format!("Dev{}", self.parts));
            match on.and_then(|on| self.boards.get_mut(on)) {
                Some((_, devices)) => devices.push_str(&text),
                None => self.floating.push_str(&text),
            }
        }
    }

    fn text(self, seed: u64) -> Text {
        let mut sense = String::new();
        for (number, (board, devices)) in self.boards.iter().enumerate() {
            let _ = writeln!(sense, "board Brd{number} on {board} {{\n{devices}}}");
        }
        sense.push_str(&self.floating);
        let target = if seed.is_multiple_of(2) { "none" } else { "chibios" };
        Text { sense, target, tables: BTreeMap::new() }
    }
}

/// A part with a place for its name, and how many devices it is.
fn part(rng: &mut Rng) -> (String, u64) {
    if rng.below(3) > 0 {
        let single = rng.of(SINGLES);
        let count = 2 + rng.below(5);
        let text = single.replace("COUNT", &count.to_string());
        let devices = if single.contains("COUNT") { count } else { 1 };
        return (text.replace("ADDRESS", &rng.below(8).to_string()) + "\n", devices);
    }
    let at = rng.below(CHIPS.len() as u64) as usize;
    let (driver, devices, addresses) = CHIPS.get(at).copied().unwrap_or_default();
    let address = match rng.of(addresses) {
        "" => String::new(),
        address => format!(" address = {address};"),
    };
    (format!("chip NAME {{ driver = {driver};{address} }}\n"), devices)
}

fn device(number: u64, kind: &str) -> String {
    let (head, more) = match kind {
        "i2c" => ("sensor NAME returns uint16", format!("address = {};", 0x10 + number)),
        "can" => ("sensor NAME returns uint16", format!("frame = {};", 0x100 + number)),
        "spi" | "uart" | "analog" | "icu" | "encoder" => {
            ("sensor NAME returns uint16", String::new())
        }
        "pwm" => {
            ("actuator NAME accepts uint16", format!("frequency = {};", 1000 + number % 2 * 50))
        }
        "dac" => ("actuator NAME accepts uint16", String::new()),
        "output" => ("actuator NAME accepts bool", String::new()),
        _ => ("sensor NAME returns bool", String::new()),
    };
    let kind = if kind == "output" { "digital" } else { kind };
    let head = head.replace("NAME", &format!("Dev{number}"));
    format!("{head} {{\n    id = {number};\n    type = {kind};\n    {more}\n}}\n")
}

/// A table with one to seven usages for each pin, as random as those of small boards that people
/// describe.
fn table(rng: &mut Rng, pins: u64) -> String {
    let mut text = "Pin,Usages\n".to_owned();
    let units = 1 + pins / 30;
    for pin in 0..pins {
        let mut usages: Vec<String> = Vec::new();
        for _ in 0..rng.below(7) {
            let unit = 1 + rng.below(units);
            let usage = match rng.below(12) {
                0 => format!("I2C{unit}_SCL"),
                1 => format!("I2C{unit}_SDA"),
                2 => format!("SPI{unit}_{}", rng.of(&["SCK", "MISO", "MOSI"])),
                3 => format!("USART{unit}_{}", rng.of(&["TX", "RX"])),
                4 => format!("CAN{unit}_{}", rng.of(&["TX", "RX"])),
                5 => format!("ADC1_IN{}", rng.below(16)),
                6..=8 => {
                    format!("TIM{}_CH{}", 1 + rng.below(1 + units * 2), 1 + rng.below(4))
                }
                _ => format!("ETH_{}", rng.below(20)),
            };
            if !usages.contains(&usage) {
                usages.push(usage);
            }
        }
        let port = char::from(b'A' + (pin / 16) as u8);
        let _ = writeln!(text, "P{port}{},{}", pin % 16, usages.join(" "));
    }
    text
}

/// Eight boards of one sort and eighty floating devices.
fn eight_equal(seed: u64) -> Text {
    let mut rng = Rng(seed ^ 0x4551_5541);
    let mut sense = String::new();
    for board in 0..8 {
        let _ = writeln!(sense, "board Brd{board} on STM32F407VGT6 {{\n}}");
    }
    for number in 1..=80 {
        let kinds = [
            ("analog", 25),
            ("i2c", 14),
            ("icu", 14),
            ("encoder", 5),
            ("pwm", 14),
            ("uart", 7),
            ("spi", 5),
            ("can", 2),
            ("dac", 2),
            ("digital", 12),
        ];
        let mut at = rng.below(100);
        let kind = kinds.iter().find(|(_, share)| {
            let here = at < *share;
            at = at.saturating_sub(*share);
            here
        });
        sense.push_str(&device(number, kind.map_or("digital", |kind| kind.0)));
    }
    Text { sense, target: "none", tables: BTreeMap::new() }
}

fn digital_64(_: u64) -> Text {
    let mut table = "Pin,Usages\n".to_owned();
    for pin in 0..63_u8 {
        let _ = writeln!(table, "P{}{},", char::from(b'A' + pin / 16), pin % 16);
    }
    let mut sense = "board Brd0 on \"table_0.csv\" {\n}\n".to_owned();
    (1..=64).for_each(|number| sense.push_str(&device(number, "digital")));
    Text { sense, target: "none", tables: BTreeMap::from([("table_0.csv".to_owned(), table)]) }
}

/// More devices of one address than there are buses.
fn i2c(boards: u64, devices: u64, addresses: u64) -> Text {
    let mut sense = String::new();
    for board in 0..boards {
        let _ = writeln!(sense, "board Brd{board} on STM32F407VGT6 {{\n}}");
    }
    for number in 1..=devices {
        let (own, shared) = (0x10 + number, 0x10 + number % addresses);
        let text = device(number, "i2c");
        sense.push_str(&text.replace(&format!("= {own};"), &format!("= {shared};")));
    }
    Text { sense, target: "none", tables: BTreeMap::new() }
}

fn i2c_30(_: u64) -> Text {
    i2c(1, 30, 7)
}

fn i2c_61(_: u64) -> Text {
    i2c(2, 61, 10)
}

/// Four equal motors with encoders, and an array in a row, floating between two boards.
fn four_chips(_: u64) -> Text {
    let mut sense =
        "board Brd0 on NUCLEO_F446RE {\n}\nboard Brd1 on NUCLEO_G474RE {\n}\n".to_owned();
    for number in 1..=4 {
        let (place, speed) = (2 * number, 2 * number + 1);
        let _ = writeln!(
            sense,
            "chip Motor{number} {{\n    driver = gearmotor_tb6612;\n    sensor Position{number} \
             returns int32 {{ id = {place}; }}\n    actuator Speed{number} accepts int16 \
             {{ id = {speed}; }}\n}}"
        );
    }
    sense.push_str(
        "sensor Buttons returns bool[8] { id = 20; type = digital; sequence = header; }\n",
    );
    Text { sense, target: "none", tables: BTreeMap::new() }
}

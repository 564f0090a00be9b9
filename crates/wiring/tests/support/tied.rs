//! Seeded small designs with arrays, chips and two boards: a number in, the case and its files out.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use sensedsl_model::design::Design;
use sensedsl_model::{FileRequest, Files, ReadError, Request, resolve};

/// A small generator (splitmix64), so that a seed always gives the same case.
pub struct Rng(u64);

impl Rng {
    fn below(&mut self, limit: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) % limit as u64) as usize
    }

    fn one_in(&mut self, times: usize) -> bool {
        self.below(times) == 0
    }

    fn of<T: Clone>(&mut self, all: &[T]) -> T {
        all[self.below(all.len())].clone()
    }
}

/// A row of a table. It has either both a position and a header, or neither.
#[derive(Clone, Debug)]
pub struct Row {
    pub name: String,
    pub place: Option<(&'static str, usize)>,
    pub side: Option<&'static str>,
    pub care: bool,
    pub usages: Vec<String>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Analog,
    /// Whether it awaits an edge.
    Digital(bool),
    Pwm(u32),
    Icu,
    Encoder,
    I2c(u8),
}

/// A hard or soft rule for a part's wires.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Rule {
    Unit(String),
    Side(&'static str),
    Header(&'static str),
    Pin(String),
    TogetherUnit,
    TogetherHeader,
    TogetherSide,
    Sequence,
}

impl Rule {
    fn text(&self) -> String {
        match self {
            Self::Unit(unit) => format!("unit = {unit};"),
            Self::Side(side) => format!("side = {side};"),
            Self::Header(header) => format!("header = {header};"),
            Self::Pin(pin) => format!("pin = {pin};"),
            Self::TogetherUnit => "together = unit;".into(),
            Self::TogetherHeader => "together = header;".into(),
            Self::TogetherSide => "together = side;".into(),
            Self::Sequence => "sequence = header;".into(),
        }
    }

    pub fn is_tie(&self) -> bool {
        matches!(
            self,
            Self::TogetherUnit | Self::TogetherHeader | Self::TogetherSide | Self::Sequence
        )
    }
}

/// A soft rule: whether it is preferred, and what.
pub type Preference = (bool, Rule);

#[derive(Clone, Debug)]
pub struct Part {
    pub board: Option<usize>,
    /// The wires to be found: elements of an array, connections of a chip, or one.
    pub connections: Vec<(Kind, Option<String>)>,
    pub is_array: bool,
    /// The driver of a chip.
    pub chip: Option<&'static str>,
    pub rules: Vec<Rule>,
    pub wishes: Vec<Preference>,
}

#[derive(Clone, Debug)]
pub struct Case {
    pub boards: Vec<Vec<Row>>,
    pub spare: bool,
    pub board_wishes: Vec<Vec<Preference>>,
    pub parts: Vec<Part>,
    /// Whether the limits of ChibiOS's drivers apply, on an STM32F407.
    pub chibios: bool,
}

/// Chips with their connections, by the names in the text below.
const CHIPS: &[(&str, &[(Kind, &str)])] = &[
    (
        "bridge",
        &[
            (Kind::Pwm(1_000), "speed"),
            (Kind::Digital(false), "one"),
            (Kind::Digital(false), "two"),
        ],
    ),
    (
        "wheel",
        &[(Kind::Pwm(1_000), "forward"), (Kind::Pwm(1_000), "back"), (Kind::Encoder, "turns")],
    ),
    ("eye", &[(Kind::I2c(0x29), "bus"), (Kind::Digital(false), "standby")]),
    ("probe", &[(Kind::Analog, "hot"), (Kind::Analog, "cold")]),
];

const DRIVERS: &str = "
driver bridge {
    connection speed for pwm { frequency = 1 kHz; }
    connection one for digital { }
    connection two for digital { }
    command power accepts int16 { via = [speed, one, two]; drive = direction_pins; }
}
driver wheel {
    connection forward for pwm { frequency = 1 kHz; }
    connection back for pwm { frequency = 1 kHz; }
    connection turns for encoder { }
    command power accepts int16 { via = [forward, back]; drive = two_pwm; }
    reading place returns int32 { via = turns; }
}
driver eye {
    connection bus for i2c { address = 0x29; }
    connection standby for digital { }
    reading far returns uint16 { via = bus; register = 1; }
}
driver probe {
    connection hot for analog { }
    connection cold for analog { }
    reading warm returns uint16 { via = hot; }
    reading chill returns uint16 { via = cold; }
}
";

/// The case for a seed.
pub fn case(seed: u64) -> Case {
    let mut rng = Rng(seed.wrapping_mul(0x5851_F42D_4C95_7F2D) ^ 0x5449_4544);
    let chibios = rng.one_in(3);
    let boards = 1 + usize::from(rng.one_in(3));
    let pins = if boards == 1 { 6 + rng.below(5) } else { 5 + rng.below(3) };
    let boards: Vec<Vec<Row>> = (0..boards).map(|_| table(&mut rng, pins)).collect();
    let mut parts = Vec::new();
    let mut wires = 0;
    for number in 0..1 + rng.below(4) {
        let part = part(&mut rng, number, boards.len());
        let of_kind = |kind: &Kind| 1 + usize::from(matches!(kind, Kind::Encoder | Kind::I2c(_)));
        let own: usize = part.connections.iter().map(|(kind, _)| of_kind(kind)).sum();
        if wires + own <= 6 {
            wires += own;
            parts.push(part);
        }
    }
    let board_wishes = boards.iter().map(|_| {
        let some = usize::from(rng.one_in(4));
        (0..some).filter_map(|_| wish(&mut rng, true, true)).collect()
    });
    let board_wishes = board_wishes.collect();
    let spare = boards.len() > 1 && rng.one_in(3);
    // Parts on the boards come first in the text.
    parts.sort_by_key(|part| part.board.unwrap_or(usize::MAX));
    Case { boards, spare, board_wishes, parts, chibios }
}

const NAMES: &[&str] =
    &["PA0", "PA1", "PA2", "PA3", "PB0", "PB1", "PC0", "PC1", "PC10", "PC11", "PC2", "PC3"];
const SIDES: &[Option<&str>] = &[Some("left"), Some("right"), Some("left"), None];

fn table(rng: &mut Rng, pins: usize) -> Vec<Row> {
    let mut names = NAMES.to_vec();
    let mut rows = Vec::new();
    // Positions are in random order; two pins may be on one contact.
    let mut positions: Vec<usize> = (1..=12).collect();
    for _ in 0..pins {
        let name = names.remove(rng.below(names.len())).to_owned();
        let place = match rng.below(8) {
            0 => None,
            at => {
                let position =
                    if rng.one_in(12) { 12 } else { positions.remove(rng.below(positions.len())) };
                Some((if at < 5 { "P1" } else { "P2" }, position))
            }
        };
        let mut usages: Vec<String> = Vec::new();
        for _ in 0..rng.below(4) + usize::from(rng.one_in(2)) {
            let usage = match rng.below(10) {
                0..=3 => {
                    let units = rng.of(&["1", "2", "12", "13", "23", "123"]);
                    format!("ADC{units}_IN{}", rng.below(16))
                }
                4..=7 => format!("TIM{}_CH{}", 1 + rng.below(3), 1 + rng.below(3)),
                8 => format!("I2C{}_{}", 1 + rng.below(2), rng.of(&["SCL", "SDA"])),
                _ => format!("ETH_TX{}", rng.below(4)),
            };
            if !usages.contains(&usage) {
                usages.push(usage);
            }
        }
        rows.push(Row { name, place, side: rng.of(SIDES), care: rng.one_in(6), usages });
    }
    // A table may be in any order; pins count in natural order.
    rows
}

fn wish(rng: &mut Rng, is_array: bool, single: bool) -> Option<Preference> {
    if is_array && rng.one_in(2) {
        return Some((true, tie(rng)));
    }
    let prefer = rng.one_in(2);
    let rule = match rng.below(4) {
        0 => Rule::Side(rng.of(&["left", "right"])),
        1 => Rule::Header(rng.of(&["P1", "P2"])),
        2 if !prefer || single => Rule::Pin(rng.of(NAMES).to_owned()),
        _ => Rule::Unit(rng.of(&["ADC1", "ADC2", "TIM1", "TIM2", "TIM3", "I2C1"]).to_owned()),
    };
    Some((prefer, rule))
}

fn tie(rng: &mut Rng) -> Rule {
    rng.of(&[Rule::TogetherUnit, Rule::TogetherHeader, Rule::TogetherSide, Rule::Sequence])
}

fn part(rng: &mut Rng, number: usize, boards: usize) -> Part {
    let board = if boards > 1 && rng.one_in(2) { None } else { Some(rng.below(boards)) };
    if rng.one_in(4) {
        let (name, connections) = rng.of(CHIPS);
        let connections = connections.iter().map(|(kind, _)| (own_kind(*kind, number), None));
        let rules = if rng.one_in(8) { vec![Rule::Header("P1")] } else { Vec::new() };
        let wishes =
            if rng.one_in(2) { wish(rng, false, false).into_iter().collect() } else { Vec::new() };
        let connections = connections.collect();
        return Part { board, connections, is_array: false, chip: Some(name), rules, wishes };
    }
    let kind = match rng.below(8) {
        0..=2 => Kind::Analog,
        3 => Kind::Digital(rng.one_in(2)),
        4 | 5 => Kind::Pwm(rng.of(&[50, 1_000])),
        6 => rng.of(&[Kind::Icu, Kind::Encoder]),
        _ => Kind::I2c(0x10 + number as u8 % 2),
    };
    let is_array = !matches!(kind, Kind::I2c(_)) && !rng.one_in(4);
    let most = if kind == Kind::Encoder { 2 } else { 4 };
    let length = if is_array { 1 + rng.below(most) } else { 1 };
    let length = if is_array && length == 1 { 1 + rng.below(2) } else { length };
    let mut rules = Vec::new();
    if is_array && rng.one_in(2) {
        let one = tie(rng);
        if one != Rule::TogetherUnit || !matches!(kind, Kind::Digital(_)) {
            rules.push(one.clone());
        }
        if one != Rule::Sequence && rng.one_in(4) {
            rules.push(Rule::Sequence);
        }
    }
    if rng.one_in(8) {
        rules.push(Rule::Side("left"));
    }
    if kind == Kind::Analog && rng.one_in(6) {
        rules.push(Rule::Unit(rng.of(&["ADC1", "ADC2"]).to_owned()));
    }
    let single = length == 1 && !is_array && !matches!(kind, Kind::Encoder | Kind::I2c(_));
    let wishes = (0..rng.below(3)).filter_map(|_| wish(rng, is_array, single)).collect();
    let fixed =
        rng.one_in(6) && kind != Kind::Encoder && !matches!(kind, Kind::I2c(_)) && board == Some(0);
    let mut names = NAMES.to_vec();
    let connections = (0..length).map(|_| {
        let pin = fixed.then(|| names.remove(rng.below(names.len())).to_owned());
        (kind, pin)
    });
    let connections = connections.collect();
    Part { board, connections, is_array, chip: None, rules, wishes }
}

fn own_kind(kind: Kind, number: usize) -> Kind {
    match kind {
        Kind::I2c(_) => Kind::I2c(0x29 + number as u8 % 2),
        other => other,
    }
}

/// Keeps only the fixed pins that the board has.
pub fn sound(case: &mut Case) {
    for part in &mut case.parts {
        let rows = part.board.map(|board| &case.boards[board]);
        let has = |pin: &String| rows.is_some_and(|rows| rows.iter().any(|row| row.name == *pin));
        if part.connections.iter().flat_map(|(_, pin)| pin).any(|pin| !has(pin)) {
            part.connections.iter_mut().for_each(|(_, pin)| *pin = None);
        }
    }
}

/// The files of a case.
pub struct Text {
    pub sense: String,
    tables: BTreeMap<String, String>,
    target: &'static str,
}

impl Files for Text {
    fn read(&self, wanted: &FileRequest<'_>) -> Result<String, ReadError> {
        self.tables.get(wanted.path).cloned().ok_or(ReadError::Missing)
    }
}

impl Text {
    pub fn of(case: &Case) -> Self {
        let mut sense = DRIVERS.to_owned();
        let mut tables = BTreeMap::new();
        let mut floating = String::new();
        for (index, rows) in case.boards.iter().enumerate() {
            tables.insert(format!("table_{index}.csv"), csv(rows));
            let spare = if case.spare && index + 1 == case.boards.len() { "spare " } else { "" };
            let _ = writeln!(sense, "{spare}board Brd{index} on \"table_{index}.csv\" {{");
            let _ = writeln!(sense, "    link {{ transport = none; }}");
            for wish in &case.board_wishes[index] {
                let _ = writeln!(sense, "    {}", wish_text(wish));
            }
            for (number, part) in case.parts.iter().enumerate() {
                if part.board == Some(index) {
                    sense.push_str(&part_text(number, part));
                }
            }
            sense.push_str("}\n");
        }
        for (number, part) in case.parts.iter().enumerate().filter(|(_, part)| part.board.is_none())
        {
            floating.push_str(&part_text(number, part));
        }
        sense.push_str(&floating);
        let target = if case.chibios { "chibios" } else { "none" };
        Self { sense, tables, target }
    }

    /// `None` if a rule names something that no pin of the board has.
    pub fn design(&self) -> Option<Design> {
        let (path, text, target) = ("tied.sense", self.sense.as_str(), Some(self.target));
        let resolved = resolve(&Request { path, text, board: None, target }, self);
        let reported: Vec<&str> =
            resolved.diagnostics.iter().map(|one| one.message.as_str()).collect();
        let is_unnamed =
            reported.iter().any(|reported| reported.starts_with("no pin of the board is"));
        if resolved.design.is_none() {
            assert!(is_unnamed, "{reported:?}\n{}", self.all());
        }
        resolved.design
    }

    /// All files as one text, for messages.
    pub fn all(&self) -> String {
        let tables = self.tables.iter().map(|(name, text)| format!("{name}\n{text}"));
        format!(
            "target {}\n{}\n{}",
            self.target,
            tables.collect::<String>(),
            self.sense.replace(DRIVERS, "")
        )
    }
}

fn csv(rows: &[Row]) -> String {
    let mut csv = "# mcu = STM32F407VGT6\nPin,Header,Position,Side,Onboard,Usages\n".to_owned();
    for row in rows {
        let (header, position) = row.place.map_or(("", String::new()), |(h, p)| (h, p.to_string()));
        let care = if row.care { "LED:care" } else { "" };
        let side = row.side.unwrap_or_default();
        let _ = writeln!(
            csv,
            "{},{header},{position},{side},{care},{}",
            row.name,
            row.usages.join(" ")
        );
    }
    csv
}

fn wish_text((prefer, rule): &Preference) -> String {
    format!("{} {}", if *prefer { "prefer" } else { "avoid" }, rule.text())
}

fn part_text(number: usize, part: &Part) -> String {
    let mut inner: Vec<String> = part.rules.iter().map(Rule::text).collect();
    inner.extend(part.wishes.iter().map(wish_text));
    let pins: Vec<&str> = part.connections.iter().filter_map(|(_, pin)| pin.as_deref()).collect();
    let id = 1 + 10 * number;
    if let Some(driver) = part.chip {
        if let Some((Kind::I2c(address), _)) = part.connections.first() {
            inner.push(format!("address = {address};"));
        }
        return format!(
            "chip Dev{number} {{ driver = {driver}; id = {id}; {} }}\n",
            inner.join(" ")
        );
    }
    let (kind, _) = part.connections[0];
    let length = part.connections.len();
    let array = if part.is_array { format!("[{length}]") } else { String::new() };
    if !pins.is_empty() {
        let list = pins.join(", ");
        inner.push(if part.is_array {
            format!("pin = [{list}];")
        } else {
            format!("pin = {list};")
        });
    }
    let (head, own) = match kind {
        Kind::Analog => ("sensor NAME returns uint16", "type = analog;".to_owned()),
        Kind::Digital(true) => ("sensor NAME returns bool", "type = digital; edge = both;".into()),
        Kind::Digital(false) => ("actuator NAME accepts bool", "type = digital;".into()),
        Kind::Pwm(hz) => {
            ("actuator NAME accepts uint16", format!("type = pwm; frequency = {hz} Hz;"))
        }
        Kind::Icu => ("sensor NAME returns uint32", "type = icu;".into()),
        Kind::Encoder => ("sensor NAME returns int32", "type = encoder;".into()),
        Kind::I2c(at) => {
            ("sensor NAME returns uint16", format!("type = i2c; register = 1; address = {at};"))
        }
    };
    let head = head.replace("NAME", &format!("Dev{number}"));
    format!("{head}{array} {{ id = {id}; {own} {} }}\n", inner.join(" "))
}

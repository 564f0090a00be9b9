//! All wirings of a small case, according to the pages of the language: every way is tried.

use std::collections::{BTreeMap, BTreeSet};

use super::tied::{Case, Kind, Part, Preference, Rule};

/// A wire: board, pin and usage by their numbers in the case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Wire {
    pub board: usize,
    pub pin: usize,
    pub usage: Option<usize>,
}

/// A wiring with the values by which it is ordered.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Found {
    /// Violated rules, shared pins, cost, spare boards.
    pub objective: [u32; 4],
    /// Board and name of each wire's pin, in natural order.
    pub pins: Vec<(usize, Natural)>,
    pub signals: Vec<Natural>,
    /// Connection by connection of the parts in question.
    pub wires: Vec<Vec<Wire>>,
}

/// Letters and numbers of a name, by which names are ordered.
pub type Natural = Vec<(String, u32)>;

pub fn natural(name: &str) -> Natural {
    let mut parts: Natural = Vec::new();
    let mut was_digit = true;
    for letter in name.chars() {
        let digit = letter.to_digit(10);
        if was_digit && digit.is_none() || parts.is_empty() {
            parts.push((String::new(), 0));
        }
        let last = parts.last_mut().unwrap();
        match digit {
            Some(digit) => last.1 = last.1 * 10 + digit,
            None => last.0.push(letter),
        }
        was_digit = digit.is_some();
    }
    parts
}

/// One way to connect one connection, and the unit that it takes whole.
struct Way {
    wires: Vec<Wire>,
    unit: Option<String>,
}

struct World<'c> {
    case: &'c Case,
    /// The part of each connection, and its number within the part.
    of: Vec<(&'c Part, usize)>,
    ways: Vec<Vec<Way>>,
}

/// The owner of a pin or a signal. Wires that may share it have equal owners: those of a bus.
type Owner = (Option<String>, usize, String);

#[derive(Clone, Default)]
struct Taken {
    pins: BTreeMap<(usize, usize), Owner>,
    signals: BTreeMap<(usize, String), (Owner, usize)>,
}

/// The most combinations that [`all`] tries.
pub fn combinations(case: &Case) -> f64 {
    let world = World::new(case, &vec![true; case.parts.len()]);
    world.ways.iter().map(|ways| ways.len() as f64).product()
}

/// All wirings of the chosen parts, best first.
pub fn all(case: &Case, chosen: &[bool]) -> Vec<Found> {
    let world = World::new(case, chosen);
    let mut found = Vec::new();
    world.walk(&mut Vec::new(), &Taken::default(), &mut found);
    found.sort_by(|a, b| {
        (a.objective, &a.pins, &a.signals).cmp(&(b.objective, &b.pins, &b.signals))
    });
    found
}

impl<'c> World<'c> {
    fn new(case: &'c Case, chosen: &[bool]) -> Self {
        let parts = case.parts.iter().zip(chosen).filter(|(_, chosen)| **chosen);
        let of: Vec<_> = parts
            .flat_map(|(part, _)| (0..part.connections.len()).map(move |number| (part, number)))
            .collect();
        let ways = of.iter().map(|(part, number)| ways(case, part, *number)).collect();
        Self { case, of, ways }
    }

    fn signal(&self, wire: Wire) -> Option<&'c str> {
        Some(self.case.boards[wire.board][wire.pin].usages[wire.usage?].as_str())
    }

    fn walk(&self, chosen: &mut Vec<usize>, taken: &Taken, found: &mut Vec<Found>) {
        let at = chosen.len();
        let Some(ways) = self.ways.get(at) else {
            if self.holds_as_a_whole(chosen) {
                found.push(self.read(chosen));
            }
            return;
        };
        for (number, way) in ways.iter().enumerate() {
            let mut next = taken.clone();
            if self.take(&mut next, at, way) {
                chosen.push(number);
                self.walk(chosen, &next, found);
                chosen.pop();
            }
        }
    }

    /// Takes each pin once and each signal once, except for the wires of a bus.
    fn take(&self, taken: &mut Taken, connection: usize, way: &Way) -> bool {
        let (part, number) = self.of[connection];
        let is_bus = matches!(part.connections[number].0, Kind::I2c(_));
        for (role, wire) in way.wires.iter().enumerate() {
            let signal = self.signal(*wire).unwrap_or_default().to_owned();
            let owner: Owner = if is_bus {
                (way.unit.clone(), usize::MAX, signal.clone())
            } else {
                (None, 10 * connection + role, signal.clone())
            };
            let before = taken.pins.insert((wire.board, wire.pin), owner.clone());
            if before.is_some_and(|before| before != owner) {
                return false;
            }
            if !signal.is_empty() {
                let key = (wire.board, signal);
                let before = taken.signals.insert(key, (owner.clone(), wire.pin));
                if before.is_some_and(|before| before != (owner, wire.pin)) {
                    return false;
                }
            }
        }
        true
    }

    fn way(&self, chosen: &[usize], connection: usize) -> &Way {
        &self.ways[connection][chosen[connection]]
    }

    fn holds_as_a_whole(&self, chosen: &[usize]) -> bool {
        let mut contacts: BTreeMap<(usize, &str, usize), usize> = BTreeMap::new();
        let mut timers: BTreeMap<(usize, &str), (usize, u32)> = BTreeMap::new();
        let mut addresses = BTreeSet::new();
        let mut lines: BTreeSet<(usize, &str)> = BTreeSet::new();
        for (connection, (part, number)) in self.of.iter().enumerate() {
            let way = self.way(chosen, connection);
            let board = way.wires[0].board;
            for wire in &way.wires {
                let row = &self.case.boards[wire.board][wire.pin];
                if let Some((header, position)) = row.place {
                    let before = contacts.insert((wire.board, header, position), wire.pin);
                    if before.is_some_and(|before| before != wire.pin) {
                        return false;
                    }
                }
            }
            let kind = part.connections[*number].0;
            if let (Kind::I2c(address), Some(unit)) = (kind, &way.unit)
                && !addresses.insert((board, unit.clone(), address))
            {
                return false;
            }
            if !self.case.chibios {
                continue;
            }
            let used = match kind {
                // Outputs at one frequency have the same number.
                Kind::Pwm(hz) => Some((usize::MAX, hz)),
                Kind::Icu | Kind::Encoder => Some((connection, 0)),
                Kind::Analog | Kind::Digital(_) | Kind::I2c(_) => None,
            };
            if let (Some(used), Some(unit)) = (used, &way.unit)
                && timers.insert((board, unit.as_str()), used).is_some_and(|other| other != used)
            {
                return false;
            }
            let pin = &self.case.boards[board][way.wires[0].pin].name;
            if kind == Kind::Digital(true) && !lines.insert((board, &pin[2..])) {
                return false;
            }
        }
        self.parts(chosen).all(|(part, range)| {
            let ways: Vec<&Way> = range.map(|at| self.way(chosen, at)).collect();
            let boards: BTreeSet<usize> = ways.iter().map(|way| way.wires[0].board).collect();
            boards.len() == 1
                && part
                    .rules
                    .iter()
                    .filter(|rule| rule.is_tie())
                    .all(|rule| self.ties(part, rule, &ways))
        })
    }

    /// The parts, each with the positions of its connections.
    fn parts<'s>(
        &'s self,
        _: &'s [usize],
    ) -> impl Iterator<Item = (&'c Part, std::ops::Range<usize>)> + 's {
        let firsts = (0..self.of.len()).filter(|at| self.of[*at].1 == 0);
        firsts.map(|at| (self.of[at].0, at..at + self.of[at].0.connections.len()))
    }

    /// The units that can serve a signal to the part: several for an analog input.
    fn units(&self, part: &Part, way: &Way, wire: Wire) -> BTreeSet<String> {
        if let Some(unit) = &way.unit {
            return BTreeSet::from([unit.clone()]);
        }
        let Some(signal) = self.signal(wire) else { return BTreeSet::new() };
        let fixed = part.rules.iter().find_map(|rule| match rule {
            Rule::Unit(unit) => Some(unit.clone()),
            _ => None,
        });
        let units = units_of(signal);
        units.into_iter().filter(|unit| fixed.as_ref().is_none_or(|fixed| fixed == unit)).collect()
    }

    /// Whether the elements of an array keep a tie.
    fn ties(&self, part: &Part, rule: &Rule, ways: &[&Way]) -> bool {
        let rows = |way: &Way| -> Vec<_> {
            way.wires.iter().map(|wire| &self.case.boards[wire.board][wire.pin]).collect()
        };
        let all: Vec<_> = ways.iter().flat_map(|way| rows(way)).collect();
        match rule {
            Rule::TogetherUnit => {
                let sets = ways.iter().map(|way| self.units(part, way, way.wires[0]));
                let common = sets.reduce(|one, other| &one & &other).unwrap_or_default();
                // Wires without a unit have nothing to be kept together.
                !common.is_empty() || matches!(part.connections[0].0, Kind::Digital(_))
            }
            Rule::TogetherHeader => {
                let first = all[0].place.map(|place| place.0);
                first.is_some() && all.iter().all(|row| row.place.map(|place| place.0) == first)
            }
            Rule::TogetherSide => {
                all[0].side.is_some() && all.iter().all(|row| row.side == all[0].side)
            }
            Rule::Sequence => {
                let positions = |way: &&Way| -> Vec<Option<usize>> {
                    rows(way).iter().map(|row| row.place.map(|place| place.1)).collect()
                };
                self.ties(part, &Rule::TogetherHeader, ways)
                    && ways.windows(2).all(|pair| {
                        positions(&pair[0]).iter().max() < positions(&pair[1]).iter().min()
                    })
            }
            Rule::Unit(_) | Rule::Side(_) | Rule::Header(_) | Rule::Pin(_) => true,
        }
    }

    fn violates(&self, part: &Part, (prefer, rule): &Preference, ways: &[&Way]) -> bool {
        if rule.is_tie() {
            return part.is_array && !self.ties(part, rule, ways);
        }
        let kinds = || part.connections.iter().map(|(kind, _)| *kind);
        let single = ways.len() == 1 && ways[0].wires.len() == 1 && !part.is_array;
        if matches!(rule, Rule::Pin(_)) && *prefer && !single {
            return false;
        }
        let board = ways[0].wires[0].board;
        // For a chip, only those connections count that could have the unit.
        let could = |kind: Kind, number: usize| match rule {
            Rule::Unit(unit) if part.chip.is_some() => {
                let mut all = self::ways(self.case, part, number).into_iter();
                let _ = kind;
                all.any(|way| {
                    way.wires[0].board == board
                        && self.units(part, &way, way.wires[0]).contains(unit)
                })
            }
            _ => true,
        };
        let any_could = kinds().enumerate().any(|(number, kind)| could(kind, number));
        ways.iter().zip(kinds()).enumerate().any(|(number, (way, kind))| {
            (!any_could || could(kind, number))
                && way
                    .wires
                    .iter()
                    .any(|wire| self.wire_violates(part, (*prefer, rule), way, *wire))
        })
    }

    fn wire_violates(
        &self,
        part: &Part,
        (prefer, rule): (bool, &Rule),
        way: &Way,
        wire: Wire,
    ) -> bool {
        let row = &self.case.boards[wire.board][wire.pin];
        match rule {
            Rule::Side(side) => (row.side == Some(side)) != prefer,
            Rule::Header(header) => (row.place.map(|place| place.0) == Some(header)) != prefer,
            Rule::Pin(pin) => (row.name == *pin) != prefer,
            Rule::Unit(unit) => {
                let units = self.units(part, way, wire);
                if units.is_empty() {
                    return false;
                }
                if prefer { !units.contains(unit) } else { units.iter().all(|one| one == unit) }
            }
            Rule::TogetherUnit | Rule::TogetherHeader | Rule::TogetherSide | Rule::Sequence => {
                false
            }
        }
    }

    fn read(&self, chosen: &[usize]) -> Found {
        let wires: Vec<Vec<Wire>> =
            (0..self.of.len()).map(|at| self.way(chosen, at).wires.clone()).collect();
        let mut violated = 0;
        for (part, range) in self.parts(chosen) {
            let ways: Vec<&Way> = range.map(|at| self.way(chosen, at)).collect();
            let of_board = &self.case.board_wishes[ways[0].wires[0].board];
            let wishes = part.wishes.iter().chain(of_board);
            violated += wishes.filter(|wish| self.violates(part, wish, &ways)).count() as u32;
        }
        let flat = || wires.iter().flatten();
        let pins: BTreeSet<(usize, usize)> = flat().map(|wire| (wire.board, wire.pin)).collect();
        let rows = || pins.iter().map(|(board, pin)| &self.case.boards[*board][*pin]);
        let shared = rows().filter(|row| row.care).count() as u32;
        let cost = rows().map(|row| row.usages.len() as u32).sum();
        let last = self.case.boards.len() - 1;
        let spares = u32::from(self.case.spare && pins.iter().any(|(board, _)| *board == last));
        let name = |wire: &Wire| natural(&self.case.boards[wire.board][wire.pin].name);
        Found {
            objective: [violated, shared, cost, spares],
            pins: flat().map(|wire| (wire.board, name(wire))).collect(),
            signals: flat().map(|wire| natural(self.signal(*wire).unwrap_or("GPIO"))).collect(),
            wires,
        }
    }
}

fn units_of(signal: &str) -> BTreeSet<String> {
    let (unit, _) = signal.split_once('_').unwrap();
    match unit.strip_prefix("ADC") {
        Some(digits) => digits.chars().map(|digit| format!("ADC{digit}")).collect(),
        None => BTreeSet::from([unit.to_owned()]),
    }
}

/// All ways to connect one connection by itself.
fn ways(case: &Case, part: &Part, number: usize) -> Vec<Way> {
    let (kind, fixed) = &part.connections[number];
    let mut found = Vec::new();
    for (board, rows) in case.boards.iter().enumerate() {
        if part.board.is_some_and(|own| own != board) {
            continue;
        }
        let fits = |pin: usize| {
            let row = &rows[pin];
            fixed.as_ref().is_none_or(|fixed| *fixed == row.name)
                && part.rules.iter().all(|rule| match rule {
                    Rule::Side(side) => row.side == Some(side),
                    Rule::Header(header) => row.place.map(|place| place.0) == Some(header),
                    _ => true,
                })
        };
        let pins: Vec<usize> = (0..rows.len()).filter(|pin| fits(*pin)).collect();
        let usages: Vec<(Wire, &str)> = pins
            .iter()
            .flat_map(|pin| {
                let usages = rows[*pin].usages.iter().enumerate();
                usages.map(|(usage, name)| {
                    (Wire { board, pin: *pin, usage: Some(usage) }, name.as_str())
                })
            })
            .collect();
        match kind {
            Kind::Digital(_) => found.extend(pins.iter().map(|pin| Way {
                wires: vec![Wire { board, pin: *pin, usage: None }],
                unit: None,
            })),
            Kind::Analog => {
                let fixed = |name: &str| {
                    part.rules.iter().all(|rule| match rule {
                        Rule::Unit(unit) => units_of(name).contains(unit),
                        _ => true,
                    })
                };
                let inputs =
                    usages.iter().filter(|(_, name)| name.starts_with("ADC") && fixed(name));
                found.extend(inputs.map(|(wire, _)| Way { wires: vec![*wire], unit: None }));
            }
            Kind::Pwm(_) | Kind::Icu => {
                let most = if *kind == Kind::Icu { 2 } else { 4 };
                for (wire, name) in &usages {
                    let Some((unit, channel)) = name.split_once("_CH") else { continue };
                    if channel.parse::<u32>().unwrap() <= most {
                        found.push(Way { wires: vec![*wire], unit: Some(unit.to_owned()) });
                    }
                }
            }
            Kind::Encoder => found.extend(pairs(&usages, "_CH1", "_CH2")),
            Kind::I2c(_) => found.extend(pairs(&usages, "_SCL", "_SDA")),
        }
    }
    found
}

/// The ways to have two signals of one unit on two pins.
fn pairs(usages: &[(Wire, &str)], one: &str, two: &str) -> Vec<Way> {
    let mut pairs = Vec::new();
    for (first, name) in usages {
        let Some((unit, _)) = name.split_once(one).filter(|(_, rest)| rest.is_empty()) else {
            continue;
        };
        let other = format!("{unit}{two}");
        let others =
            usages.iter().filter(|(second, name)| *name == other && second.pin != first.pin);
        pairs.extend(
            others.map(|(second, _)| Way {
                wires: vec![*first, *second],
                unit: Some(unit.to_owned()),
            }),
        );
    }
    pairs
}

//! Requests on bare parts, with only pins: the solver's cost equals that of a separately written
//! search over the table of the part. One contact carries one pin, a pin one signal, a bus has one
//! unit, a peripheral of an STM32F1 one remap block.

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_board::remap::Blocks;
use sensedsl_board::silicon::pin_roles;
use sensedsl_parts::find;
use sensedsl_wiring::{Solved, Wiring};

use super::designs;

/// Part, devices (a kind with its fixed properties), and whether there is a wiring.
const REQUESTS: [(&str, &str, bool); 40] = [
    // I2C2 is on PB10 and PB11, and with 48 pins USART3 is nowhere else.
    ("STM32F103C8", "i2c unit=I2C2; uart unit=USART3", false),
    ("STM32F103C8", "i2c unit=I2C2; uart unit=USART1", true),
    ("STM32F103R8", "i2c unit=I2C2; uart unit=USART3; encoder", true),
    // TIM3_CH1 on PB4 is in another remap block than TIM3_CH2 on PC7.
    ("STM32F103R8", "encoder a=PB4 b=PC7", false),
    ("STM32F103R8", "encoder a=PC6 b=PC7", true),
    // The CAN controller of the 36-pin part is only on the USB pins.
    ("STM32F103T8", "digital pin=PA11; digital pin=PA12; can", false),
    ("STM32F103T8", "can; analog", true),
    ("STM32F103C8", "digital pin=PA11; digital pin=PA12; can; analog; analog", true),
    // Two signals on one contact of eight.
    ("STM32G031J6", "digital pin=PB7; digital pin=PB8", false),
    ("STM32G031K6", "digital pin=PB7; digital pin=PB8", true),
    ("STM32G031J6", "i2c scl=PB8 sda=PB9", false),
    // Six contacts beside the supply carry six wires, not seven.
    ("STM32G031J6", "digital; digital; digital; digital; digital; digital", true),
    ("STM32G031J6", "digital; digital; digital; digital; digital; digital; digital", false),
    ("STM32G031J6", "spi", true),
    ("STM32G031J6", "analog; i2c; pwm", true),
    ("STM32C011J6", "uart; i2c; digital", true),
    ("STM32F042F6", "can; i2c; analog", true),
    ("STM32F100R8", "uart unit=USART3; spi; dac", true),
    ("STM32F205RE", "can unit=CAN1; can unit=CAN2; spi", true),
    ("STM32F303K8", "can; digital pin=PA11", false),
    ("STM32F303K8", "dac; dac; analog; encoder", true),
    ("STM32F407VG", "analog; analog; i2c; icu", true),
    ("STM32F767ZI", "can unit=CAN1; can unit=CAN2; can unit=CAN3", true),
    ("STM32G474RE", "can unit=FDCAN1; can unit=FDCAN2; can unit=FDCAN3", true),
    ("STM32H743VI", "spi; encoder; can unit=FDCAN2; dac", true),
    ("STM32L053R8", "uart unit=LPUART1; i2c; dac", true),
    ("STM32L152RE", "analog; encoder; uart", true),
    ("STM32L432KC", "can; dac; dac; i2c unit=I2C3", true),
    ("STM32WB55CG", "uart unit=LPUART1; spi; analog", true),
    ("STM32H503EB", "i2c; i2c; uart; analog", true),
    ("RP2040", "uart unit=UART0; uart unit=UART1; i2c unit=I2C0; i2c unit=I2C1; analog", true),
    ("RP2040", "analog; analog; analog; analog; analog", false),
    ("RP2040", "spi; spi unit=SPI1; icu unit=PWM4; pwm unit=PWM4", true),
    ("ATmega328P", "i2c; spi; uart; pwm; analog", true),
    ("ATmega328P", "icu", true),
    ("ATmega328P", "icu; icu", false),
    ("ATmega2560", "icu; icu; icu; icu; pwm unit=TC1", true),
    ("ATmega328P", "icu unit=TC2", false),
    ("ATmega32U4", "icu unit=TC3; icu unit=TC1", true),
    ("ATmega328P", "encoder", false),
];

#[test]
fn the_cost_is_that_of_an_independent_search() {
    for (part, devices, feasible) in REQUESTS.into_iter().step_by(crate::step(8)) {
        let own = Search::of(part, devices);
        assert_eq!(own.is_some(), feasible, "{part}: {devices}");
        assert_eq!(cost(part, devices), own, "{part}: {devices}");
    }
    let families: BTreeSet<&str> =
        REQUESTS.iter().map(|(part, ..)| &part[..7.min(part.len())]).collect();
    assert!(families.len() >= 12, "{families:?}");
}

/// Fig. 2 costs 16 on a bare STM32F407VG, where an input of three converters is one usage as in
/// Table 1. Counted once for each converter, as ST lists them, the same request costs 18.
#[test]
fn what_counts_as_a_usage_decides_the_cost() {
    assert_eq!(cost("STM32F407VG", "analog; analog; i2c; icu"), Some(16));
    let mut search = Search::new("STM32F407VG");
    for pin in &mut search.pins {
        let units = |(usage, _): &(String, Option<Blocks>)| match usage.strip_prefix("ADC") {
            Some(rest) => rest.bytes().take_while(u8::is_ascii_digit).count(),
            None => 1,
        };
        pin.cost = pin.usages.iter().map(units).sum::<usize>().try_into().unwrap();
    }
    assert_eq!(search.run("analog; analog; i2c; icu"), Some(18));
}

/// The solver's cost of the best wiring of devices on the pins of a part.
fn cost(part: &str, devices: &str) -> Option<u32> {
    // The search knows only pins, not what they are needed for.
    let sheet = find(part).unwrap().sheet;
    let held = pin_roles(part).into_keys().filter(|pin| sheet.pin(pin).is_some());
    let released: String = held.map(|pin| format!("    release {pin};\n")).collect();
    // `uart unit=USART1 rx=PA3` has no commas.
    let with_commas = |device: &str| device.trim().replace(' ', ", ").replacen(", ", " ", 1);
    let written: Vec<String> = devices.split(';').map(with_commas).collect();
    let design = designs::of_devices(part, "none", &released, &written.join(";"));
    match Wiring::new(&design, None).solve_only(false) {
        Solved::Wired(wiring) => {
            // No two pins in use are on one contact.
            let board = &design.boards[0];
            let wires = wiring.boards[0].devices.iter().flat_map(|device| &device.wires);
            let pins: BTreeSet<usize> = wires.map(|wire| wire.pin).collect();
            let places: Vec<&str> =
                pins.iter().filter_map(|pin| board.table.pins[*pin].package_position()).collect();
            assert_eq!(
                places.iter().collect::<BTreeSet<_>>().len(),
                places.len(),
                "{part}: {devices}"
            );
            Some(wiring.cost)
        }
        Solved::Infeasible(_) => None,
        Solved::Failed(why) => panic!("{why:?}"),
    }
}

/// A pin as the search sees it.
struct Pin {
    name: String,
    contact: String,
    usages: Vec<(String, Option<Blocks>)>,
    cost: u32,
}

/// A wire to be placed: the unit whose bus it is, and the pins with their signals.
struct Wire {
    bus: Option<String>,
    places: Vec<(usize, String, Option<Blocks>)>,
}

/// Depth-first over devices, their units and wires; a branch that costs as much as the best ends.
struct Search {
    pins: Vec<Pin>,
    /// Taken contacts and signals.
    taken: BTreeSet<String>,
    /// Peripherals with the remap blocks that the signals in use are in.
    remaps: Vec<(String, Blocks)>,
    buses: BTreeMap<String, usize>,
    best: Option<u32>,
}

impl Search {
    fn of(part: &str, devices: &str) -> Option<u32> {
        Self::new(part).run(devices)
    }

    fn new(part: &str) -> Self {
        let found = find(part).unwrap();
        let pin = |(name, contact, usages): (&_, Option<&str>, &[(String, Option<u8>)])| Pin {
            name: ToString::to_string(name),
            contact: contact.map_or(format!("pin {name}"), |contact| format!("contact {contact}")),
            usages: usages
                .iter()
                .map(|(usage, _)| Blocks::split(usage))
                .map(|(signal, blocks)| (signal.to_owned(), blocks))
                .collect(),
            cost: usages.len().try_into().unwrap(),
        };
        let pins = found.sheet.pins().map(pin).collect();
        Self {
            pins,
            taken: BTreeSet::new(),
            remaps: Vec::new(),
            buses: BTreeMap::new(),
            best: None,
        }
    }

    fn run(&mut self, devices: &str) -> Option<u32> {
        let devices: Vec<Vec<Vec<Wire>>> =
            devices.split(';').map(|device| self.ways(device.trim())).collect();
        self.device(&devices, 0);
        self.best
    }

    /// Each way to connect a device, as its wires.
    fn ways(&self, device: &str) -> Vec<Vec<Wire>> {
        let mut words = device.split(' ');
        let kind = words.next().unwrap();
        let fixed: BTreeMap<&str, &str> = words.filter_map(|word| word.split_once('=')).collect();
        let (stems, roles): (&[&str], &[(&str, &[&str])]) = match kind {
            "analog" => (&["ADC"], &[("in", &["IN"])]),
            "dac" => (&["DAC"], &[("out", &["OUT1", "OUT2", "OUT3"])]),
            "i2c" => (&["I2C", "TWI"], &[("scl", &["SCL"]), ("sda", &["SDA"])]),
            "uart" => (&["USART", "UART", "LPUART"], &[("tx", &["TX"]), ("rx", &["RX"])]),
            "can" => (&["CAN", "FDCAN"], &[("tx", &["TX"]), ("rx", &["RX"])]),
            "spi" => (
                &["SPI"],
                &[("sck", &["SCK"]), ("miso", &["MISO"]), ("mosi", &["MOSI"]), ("cs", &[])],
            ),
            "icu" => (&["TIM", "PWM", "TC"], &[("in", &["CH1", "CH2", "B", "ICP"])]),
            "pwm" => (
                &["TIM", "PWM", "TC"],
                &[(
                    "out",
                    &["CH1", "CH2", "CH3", "CH4", "CH5", "CH6", "A", "B", "OCA", "OCB", "OCC"],
                )],
            ),
            "encoder" => (&["TIM"], &[("a", &["CH1"]), ("b", &["CH2"])]),
            "digital" => (&[""], &[("pin", &[])]),
            _ => panic!("{kind}"),
        };
        let usages = self.pins.iter().flat_map(|pin| &pin.usages);
        let units: BTreeSet<String> = usages.map(|(usage, _)| unit(usage)).collect();
        let of_kind = |name: &String| {
            stems.contains(&name.trim_end_matches(|c: char| c.is_ascii_digit()))
                && fixed.get("unit").is_none_or(|wanted| *wanted == name.as_str())
        };
        let units: Vec<String> = if kind == "digital" {
            vec![String::new()]
        } else {
            units.into_iter().filter(of_kind).collect()
        };
        let shares = ["i2c", "spi", "can"].contains(&kind);
        let wire = |unit_name: &str, role: &str, lines: &[&str]| {
            let serves = |(usage, _): &&(String, Option<Blocks>)| {
                let line = line(usage);
                let line = line.as_str();
                let input = line.strip_prefix("INP").or(line.strip_prefix("IN"));
                let channel =
                    input.is_some_and(|n| !n.is_empty() && n.bytes().all(|b| b.is_ascii_digit()));
                unit(usage) == unit_name && (lines.contains(&line) || (kind == "analog" && channel))
            };
            let mut places: Vec<(usize, String, Option<Blocks>)> = Vec::new();
            for (at, pin) in self.pins.iter().enumerate() {
                if fixed.get(role).is_some_and(|wanted| *wanted != pin.name) {
                    continue;
                }
                if lines.is_empty() {
                    places.push((at, format!("gpio {at}"), None));
                } else {
                    let found = pin.usages.iter().filter(serves);
                    places.extend(found.map(|(usage, blocks)| (at, usage.clone(), *blocks)));
                }
            }
            places.sort_by_key(|(at, ..)| self.pins[*at].cost);
            let bus = (shares && role != "cs").then(|| format!("{unit_name} {role}"));
            Wire { bus, places }
        };
        units
            .iter()
            .map(|unit| roles.iter().map(|(role, lines)| wire(unit, role, lines)).collect())
            .collect()
    }

    fn device(&mut self, devices: &[Vec<Vec<Wire>>], cost: u32) {
        let Some((first, rest)) = devices.split_first() else {
            self.best = Some(self.best.map_or(cost, |best| best.min(cost)));
            return;
        };
        for way in first {
            self.wire(way, rest, cost);
        }
    }

    fn wire(&mut self, way: &[Wire], rest: &[Vec<Vec<Wire>>], cost: u32) {
        let least = |wire: &Wire| match (&wire.bus, wire.places.first()) {
            (None, Some((at, ..))) => self.pins[*at].cost,
            _ => 0,
        };
        // The least that the other wires cost; a bus may be there already.
        let sure = |way: &Vec<Wire>| way.iter().map(least).sum::<u32>();
        let more: u32 = way.iter().map(least).sum::<u32>()
            + rest.iter().map(|ways| ways.iter().map(sure).min().unwrap_or(0)).sum::<u32>();
        if self.best.is_some_and(|best| cost + more >= best) {
            return;
        }
        let Some((first, others)) = way.split_first() else { return self.device(rest, cost) };
        if first.bus.as_ref().is_some_and(|bus| self.buses.contains_key(bus)) {
            return self.wire(others, rest, cost);
        }
        for (at, signal, blocks) in &first.places {
            let (contact, price) = (self.pins[*at].contact.clone(), self.pins[*at].cost);
            if self.taken.contains(&contact) || self.taken.contains(signal) {
                continue;
            }
            if let Some(blocks) = blocks {
                self.remaps.push((unit(signal), *blocks));
            }
            if !self.is_in_one_block(&unit(signal)) {
                self.remaps.pop();
                continue;
            }
            self.taken.insert(contact.clone());
            self.taken.insert(signal.clone());
            if let Some(bus) = &first.bus {
                self.buses.insert(bus.clone(), *at);
            }
            self.wire(others, rest, cost + price);
            if let Some(bus) = &first.bus {
                self.buses.remove(bus);
            }
            self.taken.remove(&contact);
            self.taken.remove(signal);
            if blocks.is_some() {
                self.remaps.pop();
            }
        }
    }

    /// Whether all signals of a peripheral that are in use have a remap block in common.
    fn is_in_one_block(&self, peripheral: &str) -> bool {
        let mut blocks = self.remaps.iter().filter(|(of, _)| of == peripheral).map(|(_, b)| *b);
        let Some(first) = blocks.next() else { return true };
        blocks.try_fold(first, Blocks::and).is_some()
    }
}

/// `I2C1` of `I2C1_SCL`; `TC1` of `OC1A` and `ICP1`.
fn unit(usage: &str) -> String {
    let number = |rest: &str| rest.trim_end_matches(|c: char| c.is_ascii_uppercase()).to_owned();
    match usage.strip_prefix("OC").or_else(|| usage.strip_prefix("ICP")) {
        Some(rest) if rest.starts_with(|c: char| c.is_ascii_digit()) => {
            format!("TC{}", number(rest))
        }
        _ => usage.split('_').next().unwrap_or(usage).to_owned(),
    }
}

/// `SCL` of `I2C1_SCL`; `OCA` of `OC1A`, `ICP` of `ICP1`; SPI lines as most data sheets name them.
fn line(usage: &str) -> String {
    if unit(usage).starts_with("TC") {
        return usage.chars().filter(|c| !c.is_ascii_digit()).collect();
    }
    let line = usage.split_once('_').map_or("", |(_, line)| line);
    match line {
        "RX" if usage.starts_with("SPI") => "MISO".to_owned(),
        "TX" if usage.starts_with("SPI") => "MOSI".to_owned(),
        _ => line.to_owned(),
    }
}

//! The ways to connect one device: which peripheral instances it may take and which pins then.

use std::collections::BTreeSet;

use sensedsl_board::pin::{PinName, natural};
use sensedsl_board::profile::{TargetProfile, Timer};
use sensedsl_board::remap::Blocks;
use sensedsl_board::signal::{CanLine, Function, I2cLine, SpiLine, UartLine};
use sensedsl_board::table::{Pin, Usage};
use sensedsl_model::design::{BoardIndex, Device, Placement, Wish};
use sensedsl_model::kind::{Kind, Role};
use sensedsl_solve::problem::{Alternative, Candidate, Claim, Holder, Role as SolverRole, RuleId};
use sensedsl_wire::Direction;

use crate::formulate::{Builder, Chosen, GPIO, Meaning, board_id};
use crate::names::{Group, Resource};
use crate::offer::Offer;
use crate::wishes;

/// A device, or a link, as far as its wires go.
pub(crate) struct Wanted<'a> {
    pub(crate) kind: &'a Kind,
    pub(crate) direction: Direction,
    /// The boards it may go to.
    pub(crate) boards: Vec<BoardIndex>,
    pub(crate) pins: Vec<(Role, PinName)>,
    pub(crate) unit: Option<&'a str>,
    pub(crate) side: Option<&'a str>,
    pub(crate) header: Option<&'a str>,
    pub(crate) wishes: &'a [Wish],
}

impl<'a> Wanted<'a> {
    pub(crate) fn device(device: &'a Device, boards: Vec<BoardIndex>) -> Self {
        let Placement { pins, unit, side, header } = &device.placement;
        Self {
            kind: &device.kind,
            direction: device.direction,
            boards,
            pins: pins.iter().map(|(role, pin)| (*role, pin.value.clone())).collect(),
            unit: unit.as_ref().map(|unit| unit.value.as_str()),
            side: side.as_ref().map(|side| side.value.as_str()),
            header: header.as_ref().map(|header| header.value.as_str()),
            wishes: &device.wishes,
        }
    }

    /// A serial link; `pins` are TX and RX where the board has wired them.
    pub(crate) fn link(
        board: BoardIndex,
        kind: &'a Kind,
        unit: Option<&'a str>,
        pins: &[PinName],
    ) -> Self {
        let boards = vec![board];
        let direction = Direction::Sensor;
        let pins = [Role::Tx, Role::Rx].into_iter().zip(pins.iter().cloned()).collect();
        let (side, header) = (None, None);
        Self { kind, direction, boards, pins, unit, side, header, wishes: &[] }
    }

    pub(crate) fn fixed(&self, role: Role) -> Option<&PinName> {
        self.pins.iter().find(|(fixed, _)| *fixed == role).map(|(_, pin)| pin)
    }
}

/// How the devices on one peripheral instance share it.
enum Sharing {
    /// Not at all.
    Exclusive,
    /// As a bus; the number is a setting they must agree on.
    Bus(u32),
}

/// All ways to connect a device, with what they mean.
pub(crate) fn alternatives<'a>(
    builder: &mut Builder<'a>,
    offers: &[Offer<'a>],
    wanted: &Wanted<'a>,
) -> (Vec<Alternative>, Vec<Meaning>) {
    let rules = wishes::rules(builder, wanted);
    let mut list = Vec::new();
    let mut meanings = Vec::new();
    for offer in offers.iter().filter(|offer| wanted.boards.contains(&offer.index)) {
        let mut maker = Maker { builder, offer, wanted, rules: &rules };
        for (alternative, meaning) in maker.on_board() {
            list.push(alternative);
            meanings.push(meaning);
        }
    }
    (list, meanings)
}

struct Maker<'b, 'a> {
    builder: &'b mut Builder<'a>,
    offer: &'b Offer<'a>,
    wanted: &'b Wanted<'a>,
    rules: &'b wishes::Rules<'a>,
}

type Made = (Alternative, Meaning);

/// What a role needs of a pin.
enum Need<'n> {
    /// A usage for which the function holds.
    Usage(&'n dyn Fn(&Usage) -> bool),
    /// Nothing: any pin.
    Gpio,
    /// Any pin, and the interrupt line of its number.
    Interrupt,
}

impl Maker<'_, '_> {
    fn profile(&self) -> Option<&TargetProfile> {
        self.offer.board.profile()
    }

    fn on_board(&mut self) -> Vec<Made> {
        match self.wanted.kind {
            Kind::Analog(_) => self.analog(),
            Kind::Icu(_) => self.timers(TimerUse::Icu),
            Kind::Encoder(_) => self.timers(TimerUse::Encoder),
            Kind::Pwm(pwm) => self.timers(TimerUse::Pwm(pwm.frequency_hz)),
            Kind::Digital(digital) => {
                let interrupt =
                    digital.edge.is_some() && self.wanted.direction == Direction::Sensor;
                let need = if interrupt { Need::Interrupt } else { Need::Gpio };
                let role =
                    if self.wanted.direction == Direction::Sensor { Role::In } else { Role::Out };
                let roles = vec![self.role(role, &need, None)];
                self.finish(None, &[], roles)
            }
            Kind::Dac(_) => self.dac(),
            Kind::I2c(_) | Kind::Uart(_) | Kind::Spi(_) | Kind::Can(_) => self.units(),
        }
    }

    fn analog(&mut self) -> Vec<Made> {
        let unit = self.wanted.unit.and_then(|unit| unit.strip_prefix("ADC")?.parse::<u8>().ok());
        if self.wanted.unit.is_some() && unit.is_none() {
            return Vec::new();
        }
        let offer = self.offer;
        let profile = offer.board.profile();
        let can_be = |one: u8| {
            unit.is_none_or(|unit| unit == one) && !offer.unit_reserved(&format!("ADC{one}"))
        };
        let serves = |usage: &Usage| match usage.signal.function() {
            Function::Adc { units, channel } => units.iter().any(|one| {
                can_be(*one)
                    && profile.is_none_or(|profile| {
                        profile.adc(*one).is_some_and(|adc| adc.inputs.contains(channel))
                    })
            }),
            Function::I2c { .. }
            | Function::Timer { .. }
            | Function::Uart { .. }
            | Function::Spi { .. }
            | Function::Can { .. }
            | Function::Dac { .. }
            | Function::Other => false,
        };
        let roles = vec![self.role(Role::In, &Need::Usage(&serves), None)];
        let mut made = self.finish(None, &[], roles);
        // Where there is a choice of converters it is made after the wiring, and streams with it.
        let converters = profile.map(|profile| profile.adcs.as_slice()).unwrap_or_default();
        let mut converters = converters.iter().filter(|adc| adc.number().is_some_and(can_be));
        if let (Some(only), None) = (converters.next(), converters.next()) {
            let dma = self.builder.dma(offer.index, &only.name);
            for (alternative, _) in &mut made {
                alternative.dma.clone_from(&dma);
            }
        }
        made
    }

    fn dac(&mut self) -> Vec<Made> {
        let (offer, wanted) = (self.offer, self.wanted);
        let profile = offer.board.profile();
        let serves = |usage: &Usage| match usage.signal.function() {
            Function::Dac { unit, channel } => {
                unit_fits(offer, wanted, &format!("DAC{unit}"))
                    && profile.is_none_or(|profile| profile.dac_output(*unit, *channel).is_some())
            }
            Function::Adc { .. }
            | Function::I2c { .. }
            | Function::Timer { .. }
            | Function::Uart { .. }
            | Function::Spi { .. }
            | Function::Can { .. }
            | Function::Other => false,
        };
        let roles = vec![self.role(Role::Out, &Need::Usage(&serves), None)];
        self.finish(None, &[], roles)
    }

    /// Timers: whole ones where a driver takes them whole, channels in the pure pin model.
    fn timers(&mut self, using: TimerUse) -> Vec<Made> {
        let whole = self.profile().is_some();
        let (offer, wanted) = (self.offer, self.wanted);
        if !whole && using != TimerUse::Encoder {
            let serves = |usage: &Usage| {
                channel(usage).is_some_and(|(timer, channel)| {
                    using.takes(None, channel) && unit_fits(offer, wanted, &format!("TIM{timer}"))
                })
            };
            let mut roles = vec![self.role(using.role(), &Need::Usage(&serves), None)];
            self.push_trigger(&mut roles);
            return self.finish(None, &[], roles);
        }
        let mut made = Vec::new();
        for number in self.timer_numbers() {
            let unit = format!("TIM{number}");
            let timer = self.profile().and_then(|profile| profile.timer(number)).cloned();
            if !unit_fits(self.offer, self.wanted, &unit) || (whole && timer.is_none()) {
                continue;
            }
            made.extend(self.timer(using, number, &unit, timer.as_ref()));
        }
        made
    }

    fn timer(
        &mut self,
        using: TimerUse,
        number: u8,
        unit: &str,
        timer: Option<&Timer>,
    ) -> Vec<Made> {
        let on = |wanted: Option<u8>| {
            move |usage: &Usage| {
                channel(usage).is_some_and(|(of, channel)| {
                    of == number
                        && using.takes(timer, channel)
                        && wanted.is_none_or(|wanted| wanted == channel)
                })
            }
        };
        let mut roles = match using {
            TimerUse::Encoder => vec![
                self.role(Role::A, &Need::Usage(&on(Some(1))), None),
                self.role(Role::B, &Need::Usage(&on(Some(2))), None),
            ],
            TimerUse::Icu | TimerUse::Pwm(_) => {
                vec![self.role(using.role(), &Need::Usage(&on(None)), None)]
            }
        };
        self.push_trigger(&mut roles);
        let board = self.offer.index;
        let resource = Resource::Unit(board, unit.to_owned());
        let claim = match using {
            TimerUse::Pwm(frequency_hz) => {
                let group = Group::Frequency(board, unit.to_owned(), frequency_hz);
                self.builder.names.shared(resource, group)
            }
            TimerUse::Icu | TimerUse::Encoder => self.builder.names.own(resource),
        };
        let claims = if timer.is_some() { vec![claim] } else { Vec::new() };
        self.finish(Some(unit), &claims, roles)
    }

    fn push_trigger(&mut self, roles: &mut Vec<(SolverRole, Vec<Chosen>)>) {
        if self.wanted.kind.roles(self.wanted.direction).contains(&Role::Trigger) {
            roles.push(self.role(Role::Trigger, &Need::Gpio, None));
        }
    }

    /// The timers that the offered pins name.
    fn timer_numbers(&self) -> BTreeSet<u8> {
        let usages = self.offer.pins().flat_map(|(_, pin)| &pin.usages);
        usages.filter_map(|usage| channel(usage).map(|(timer, _)| timer)).collect()
    }

    /// Buses and serial ports: all wires of one instance.
    fn units(&mut self) -> Vec<Made> {
        let mut made = Vec::new();
        for unit in self.unit_names() {
            let known = self.profile().is_none_or(|profile| profile.unit(&unit).is_some());
            if known && unit_fits(self.offer, self.wanted, &unit) {
                made.extend(self.unit(&unit));
            }
        }
        made
    }

    fn unit(&mut self, unit: &str) -> Vec<Made> {
        let board = self.offer.index;
        let resource = Resource::Unit(board, unit.to_owned());
        let names = &mut self.builder.names;
        let mut claims = Vec::new();
        let sharing = match self.wanted.kind {
            Kind::I2c(i2c) => {
                let address = Resource::Address(board, unit.to_owned(), i2c.address);
                claims.push(names.own(address));
                if i2c.exclusive { Sharing::Exclusive } else { Sharing::Bus(0) }
            }
            Kind::Spi(_) => Sharing::Bus(0),
            Kind::Can(can) => Sharing::Bus(can.bitrate_hz),
            Kind::Uart(_)
            | Kind::Analog(_)
            | Kind::Icu(_)
            | Kind::Encoder(_)
            | Kind::Digital(_)
            | Kind::Pwm(_)
            | Kind::Dac(_) => Sharing::Exclusive,
        };
        let bus = match sharing {
            Sharing::Exclusive => {
                claims.push(names.own(resource));
                None
            }
            Sharing::Bus(setting) => {
                let group = Group::Bus(board, unit.to_owned(), setting);
                claims.push(names.shared(resource, group.clone()));
                Some(group)
            }
        };
        let roles = self.wanted.kind.roles(self.wanted.direction);
        let roles = roles.into_iter().map(|role| {
            let serves = |usage: &Usage| is_wire(usage, unit, role);
            if role == Role::Cs {
                return self.role(role, &Need::Gpio, None);
            }
            self.role(role, &Need::Usage(&serves), bus.as_ref().map(|bus| (unit, bus)))
        });
        let roles: Vec<_> = roles.collect();
        self.finish(Some(unit), &claims, roles)
    }

    /// The instances of the device's kind that the offered pins name, in natural order.
    fn unit_names(&self) -> Vec<String> {
        let roles = self.wanted.kind.roles(self.wanted.direction);
        let usages = self.offer.pins().flat_map(|(_, pin)| &pin.usages);
        let named = usages.filter_map(|usage| {
            let unit = wire_unit(usage, self.wanted.kind)?;
            roles.iter().any(|role| is_wire(usage, &unit, *role)).then_some(unit)
        });
        let mut names: Vec<String> = named.collect();
        names.sort_by(|a, b| natural(a, b));
        names.dedup();
        names
    }

    /// The candidates of one role. `bus` is set for a wire that devices share.
    fn role(
        &mut self,
        role: Role,
        need: &Need<'_>,
        bus: Option<(&str, &Group)>,
    ) -> (SolverRole, Vec<Chosen>) {
        let mut made: Vec<(Candidate, Chosen)> = Vec::new();
        let (offer, wanted) = (self.offer, self.wanted);
        for (index, pin) in offer.pins().filter(|(_, pin)| pin_fits(wanted, role, pin)) {
            match need {
                Need::Usage(serves) => {
                    for (at, usage) in pin.usages.iter().enumerate() {
                        if serves(usage) && (!offer.bus_only(pin) || joins_buses(self.wanted.kind))
                        {
                            made.push(self.with_signal(role, (index, pin), (at, usage), bus));
                        }
                    }
                }
                Need::Gpio | Need::Interrupt => {
                    if !offer.bus_only(pin) {
                        let interrupt = matches!(need, Need::Interrupt);
                        made.push(self.bare(role, index, pin, interrupt));
                    }
                }
            }
        }
        made.sort_by_key(|(candidate, _)| (candidate.pin, candidate.signal));
        let (candidates, chosen) = made.into_iter().unzip();
        (SolverRole { candidates }, chosen)
    }

    fn with_signal(
        &mut self,
        role: Role,
        (index, pin): (usize, &Pin),
        (at, usage): (usize, &Usage),
        bus: Option<(&str, &Group)>,
    ) -> (Candidate, Chosen) {
        let board = self.offer.index;
        let (holder, claim) = match bus {
            Some((unit, group)) => {
                let wire = Resource::BusWire(board, unit.to_owned(), role);
                let on = Group::Pin(board, unit.to_owned(), role, index, at);
                let holder = self.builder.names.group(group.clone());
                (holder, self.builder.names.shared(wire, on))
            }
            None => {
                let signal = Resource::Signal(board, usage.signal.name().to_owned());
                (Holder::Own, self.builder.names.own(signal))
            }
        };
        let mut claims = vec![claim];
        claims.extend(self.pad(index));
        claims.extend(self.remap(usage));
        let candidate = Candidate {
            pin: self.builder.pin(board, index),
            holder,
            signal: self.builder.signal(usage.signal.name()),
            claims,
            violates: self.violates(role, pin, Some(usage)),
            moved: false,
        };
        (candidate, Chosen { pin: index, usage: Some(at) })
    }

    fn bare(
        &mut self,
        role: Role,
        index: usize,
        pin: &Pin,
        interrupt: bool,
    ) -> (Candidate, Chosen) {
        let board = self.offer.index;
        let line = self.profile().and_then(|profile| profile.exti_group(&pin.name));
        let mut claims = Vec::new();
        if let Some(line) = line.filter(|_| interrupt) {
            claims.push(self.builder.names.own(Resource::Exti(board, line)));
        }
        claims.extend(self.pad(index));
        let candidate = Candidate {
            pin: self.builder.pin(board, index),
            holder: Holder::Own,
            signal: self.builder.signal(GPIO),
            claims,
            violates: self.violates(role, pin, None),
            moved: false,
        };
        (candidate, Chosen { pin: index, usage: None })
    }

    /// The claim of a contact that the pin shares with others: one of them is in use.
    fn pad(&mut self, pin: usize) -> Option<Claim> {
        let board = self.offer.index;
        let pad = Resource::Pad(board, self.offer.shared_pad(pin)?.to_owned());
        Some(self.builder.names.shared(pad, Group::Pad(board, pin)))
    }

    /// The claims of a usage that is on its pin in some remap blocks of its peripheral alone: no
    /// other may be where no such block is.
    fn remap(&mut self, usage: &Usage) -> Vec<Claim> {
        let board = self.offer.index;
        let Some((unit, blocks)) = self.offer.blocks(usage) else { return Vec::new() };
        let others = self.offer.other_blocks(&unit, blocks);
        let claim = |other: Blocks| {
            let (first, second) = (blocks.min(other), blocks.max(other));
            let resource = Resource::Remap(board, unit.clone(), first, second);
            self.builder.names.shared(resource, Group::Blocks(board, unit.clone(), blocks))
        };
        others.into_iter().map(claim).collect()
    }

    fn violates(&self, role: Role, pin: &Pin, usage: Option<&Usage>) -> Vec<RuleId> {
        self.rules.violated_by(self.offer.index, role, pin, usage)
    }

    /// The alternative, unless one of its roles has no candidate; several where roles could meet on
    /// one contact, or be in different remap blocks.
    fn finish(&mut self, unit: Option<&str>, claims: &[Claim], roles: Vec<MadeRole>) -> Vec<Made> {
        let board = self.offer.index;
        let mut made = Vec::new();
        let cases = self.apart(roles).into_iter().flat_map(|roles| self.in_one_block(roles, None));
        let cases: Vec<_> = cases.collect();
        for roles in cases {
            let dma = unit.map(|unit| self.builder.dma(board, unit));
            let violates = self.rules.violated_by_unit(board, unit);
            let (roles, chosen) = roles.into_iter().unzip();
            let alternative = Alternative {
                board: board_id(board),
                claims: claims.to_vec(),
                violates,
                dma: dma.unwrap_or_default(),
                roles,
            };
            made.push((
                alternative,
                Meaning { board, unit: unit.map(str::to_owned), roles: chosen },
            ));
        }
        made
    }

    /// The same choices with no two wires of the device on one contact. Claims keep devices apart,
    /// not the wires of one device: where the first role may take a contact that a later one may
    /// take as well, each such contact makes a case of its own, so that no choice is in two cases.
    fn apart(&self, mut roles: Vec<MadeRole>) -> Vec<Vec<MadeRole>> {
        if roles.iter().any(|(role, _)| role.candidates.is_empty()) {
            return Vec::new();
        }
        if roles.len() < 2 {
            return vec![roles];
        }
        let first = roles.remove(0);
        let pads = |(_, chosen): &MadeRole| -> BTreeSet<&str> {
            chosen.iter().filter_map(|at| self.offer.shared_pad(at.pin)).collect()
        };
        let later: BTreeSet<&str> = roles.iter().flat_map(pads).collect();
        let contested: Vec<&str> = pads(&first).intersection(&later).copied().collect();
        let free = keep(&first, |at| {
            self.offer.shared_pad(at.pin).is_none_or(|pad| !contested.contains(&pad))
        });
        let mut cases = vec![(free, roles.clone())];
        for pad in contested {
            let on = |at: &Chosen| self.offer.shared_pad(at.pin) == Some(pad);
            let others = roles.iter().map(|role| keep(role, |at| !on(at))).collect();
            cases.push((keep(&first, on), others));
        }
        let mut apart = Vec::new();
        for (first, others) in cases {
            if first.1.is_empty() {
                continue;
            }
            for mut roles in self.apart(others) {
                roles.insert(0, first.clone());
                apart.push(roles);
            }
        }
        apart
    }

    /// The same choices with all wires of the device in one remap block of its peripheral: a case
    /// for each choice of sets of blocks that have one in common.
    fn in_one_block(&self, mut roles: Vec<MadeRole>, common: Option<Blocks>) -> Vec<Vec<MadeRole>> {
        if roles.is_empty() {
            return vec![roles];
        }
        let first = roles.remove(0);
        let blocks = |at: &Chosen| {
            let pin = self.offer.board.table.pins.get(at.pin)?;
            Some(self.offer.blocks(pin.usages.get(at.usage?)?)?.1)
        };
        let sets: BTreeSet<Option<Blocks>> = first.1.iter().map(blocks).collect();
        let mut cases = Vec::new();
        for set in sets {
            let common = match (common, set) {
                (Some(common), Some(set)) => match common.and(set) {
                    Some(common) => Some(common),
                    None => continue,
                },
                (one, other) => one.or(other),
            };
            let kept = keep(&first, |at| blocks(at) == set);
            for mut others in self.in_one_block(roles.clone(), common) {
                others.insert(0, kept.clone());
                cases.push(others);
            }
        }
        cases
    }
}

/// A role's candidates and what they stand for.
type MadeRole = (SolverRole, Vec<Chosen>);

/// The candidates for which the condition holds.
fn keep((role, chosen): &MadeRole, fits: impl Fn(&Chosen) -> bool) -> MadeRole {
    let pairs = role.candidates.iter().zip(chosen).filter(|(_, at)| fits(at));
    let (candidates, chosen) = pairs.map(|(candidate, at)| (candidate.clone(), *at)).unzip();
    (SolverRole { candidates }, chosen)
}

/// Whether the instance is neither reserved nor another one than the fixed one.
fn unit_fits(offer: &Offer<'_>, wanted: &Wanted<'_>, unit: &str) -> bool {
    wanted.unit.is_none_or(|fixed| fixed == unit) && !offer.unit_reserved(unit)
}

/// Whether the pin is where the device is bound to be.
fn pin_fits(wanted: &Wanted<'_>, role: Role, pin: &Pin) -> bool {
    let same = |wanted: Option<&str>, has: Option<&str>| {
        wanted.is_none_or(|wanted| has.is_some_and(|has| has.eq_ignore_ascii_case(wanted)))
    };
    wanted.fixed(role).is_none_or(|fixed| *fixed == pin.name)
        && same(wanted.side, pin.side.as_deref())
        && same(wanted.header, pin.header.as_deref())
}

/// What a timer is taken for.
#[derive(Clone, Copy, PartialEq, Eq)]
enum TimerUse {
    Icu,
    Encoder,
    Pwm(u32),
}

impl TimerUse {
    fn role(self) -> Role {
        match self {
            Self::Icu | Self::Encoder => Role::In,
            Self::Pwm(_) => Role::Out,
        }
    }

    /// Whether the channel can be used; without a timer's facts what the hardware has in general.
    fn takes(self, timer: Option<&Timer>, channel: u8) -> bool {
        match (self, timer) {
            (Self::Icu | Self::Encoder, None) => matches!(channel, 1 | 2),
            (Self::Pwm(_), None) => true,
            (Self::Icu, Some(timer)) => {
                timer.icu.as_ref().is_some_and(|driver| driver.channels.contains(&channel))
            }
            (Self::Encoder, Some(timer)) => timer.encoder && matches!(channel, 1 | 2),
            (Self::Pwm(_), Some(timer)) => {
                timer.pwm.as_ref().is_some_and(|driver| driver.channels.contains(&channel))
            }
        }
    }
}

/// Timer and channel of a timer's plain output or input.
fn channel(usage: &Usage) -> Option<(u8, u8)> {
    match usage.signal.function() {
        Function::Timer { timer, channel, complementary: false } => Some((*timer, *channel)),
        Function::Timer { .. }
        | Function::Adc { .. }
        | Function::I2c { .. }
        | Function::Uart { .. }
        | Function::Spi { .. }
        | Function::Can { .. }
        | Function::Dac { .. }
        | Function::Other => None,
    }
}

/// The instance whose wire the usage is, when it is of the device's kind.
fn wire_unit(usage: &Usage, kind: &Kind) -> Option<String> {
    match (usage.signal.function(), kind) {
        (Function::I2c { unit, .. }, Kind::I2c(_)) => Some(format!("I2C{unit}")),
        (Function::Spi { unit, .. }, Kind::Spi(_)) => Some(format!("SPI{unit}")),
        (Function::Uart { unit, .. }, Kind::Uart(_))
        | (Function::Can { unit, .. }, Kind::Can(_)) => Some(unit.to_string()),
        _ => None,
    }
}

/// Whether the usage is that wire of that instance.
fn is_wire(usage: &Usage, unit: &str, role: Role) -> bool {
    match (usage.signal.function(), role) {
        (Function::I2c { unit: of, line: I2cLine::Scl }, Role::Scl)
        | (Function::I2c { unit: of, line: I2cLine::Sda }, Role::Sda) => unit == format!("I2C{of}"),
        (Function::Spi { unit: of, line: SpiLine::Sck }, Role::Sck)
        | (Function::Spi { unit: of, line: SpiLine::Miso }, Role::Miso)
        | (Function::Spi { unit: of, line: SpiLine::Mosi }, Role::Mosi) => {
            unit == format!("SPI{of}")
        }
        (Function::Uart { unit: of, line: UartLine::Tx }, Role::Tx)
        | (Function::Uart { unit: of, line: UartLine::Rx }, Role::Rx)
        | (Function::Can { unit: of, line: CanLine::Tx }, Role::Tx)
        | (Function::Can { unit: of, line: CanLine::Rx }, Role::Rx) => unit == of.as_str(),
        _ => false,
    }
}

/// A pin on an on-board bus is for devices that join the bus.
fn joins_buses(kind: &Kind) -> bool {
    matches!(kind, Kind::I2c(_) | Kind::Spi(_) | Kind::Can(_))
}

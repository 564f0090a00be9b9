//! The names of everything in the problem, for its certificate and for other programs.

use std::collections::BTreeMap;

use sensedsl_certify::{AlternativeLabels, Labels, distinct};
use sensedsl_model::design::{BoardIndex, Design, Preference, PreferenceSubject};

use crate::builder::GPIO;
use crate::formulate::{Formulation, Requester, wanted};
use crate::names::{Group, Resource};
use crate::read_back;

/// The names that the design and its tables give.
pub(crate) fn labels(design: &Design, formulation: &Formulation<'_>) -> Labels {
    let names = Namer { design, formulation };
    let problem = &formulation.problem;
    let boards = design.boards.iter().map(|board| board.name.value.clone());
    let devices = formulation.askers.iter().map(|asker| names.device(*asker));
    let pins = formulation.pins.iter().map(|(board, pin)| {
        let pin = names.pin(*board, *pin).map(|pin| pin.name.to_string());
        names.on(*board, &pin.unwrap_or_default())
    });
    let resources = formulation.resources.iter().map(|one| names.resource(one));
    let users = formulation.users.iter().map(|(board, user)| names.on(*board, user));
    let streams =
        formulation.streams.iter().map(|(board, stream)| names.on(*board, &stream.name()));
    Labels {
        boards: distinct(boards),
        pins: distinct(pins),
        devices: distinct(devices),
        alternatives: names.alternatives(),
        signals: names.signals(),
        resources: distinct(resources),
        groups: distinct(formulation.groups.iter().map(|group| names.group(group))),
        rules: names.rules(problem.rules as usize),
        dma: distinct(users),
        streams: distinct(streams),
    }
}

struct Namer<'a> {
    design: &'a Design,
    formulation: &'a Formulation<'a>,
}

impl Namer<'_> {
    /// The name, with the board in front if there are several.
    fn on(&self, board: BoardIndex, name: &str) -> String {
        let board = self.design.board(board).filter(|_| self.design.boards.len() > 1);
        board.map_or(name.to_owned(), |board| format!("{}.{name}", board.name.value))
    }

    fn pin(&self, board: BoardIndex, pin: usize) -> Option<&sensedsl_board::table::Pin> {
        self.design.board(board)?.table.pins.get(pin)
    }

    fn device(&self, asker: Requester) -> String {
        let board = |board| self.design.board(board).map_or("", |board| &board.name.value);
        match asker {
            Requester::Connection(connection) => {
                let connection = self.design.connection(connection);
                connection.map_or(String::new(), |one| self.design.connection_name(one))
            }
            Requester::Link(of) => format!("link of {}", board(of)),
        }
    }

    fn resource(&self, resource: &Resource) -> String {
        let name = match resource {
            Resource::BusWire(_, unit, role) => format!("{} of {unit}", role.name()),
            // Otherwise several devices of a bus would claim the bus by that name.
            Resource::Signal(_, signal) => format!("signal {signal}"),
            Resource::Remap(_, unit, one, other) => format!("remap of {unit}, {one} or {other}"),
            Resource::Unit(..)
            | Resource::Address(..)
            | Resource::Exti(..)
            | Resource::Pad(..)
            | Resource::Part(_)
            | Resource::Tie(..) => resource.name(),
        };
        match resource.board() {
            Some(board) => self.on(board, &name),
            None => name,
        }
    }

    fn group(&self, group: &Group) -> String {
        let (Group::Bus(board, ..)
        | Group::Frequency(board, ..)
        | Group::Program(board, ..)
        | Group::Pin(board, ..)
        | Group::Pad(board, ..)
        | Group::Blocks(board, ..)
        | Group::Tie(board, ..)) = group;
        let pin = |pin: usize| self.pin(*board, pin).map(|pin| pin.name.to_string());
        let name = match group {
            Group::Bus(_, unit, _, 0) => format!("bus {unit}"),
            // What a serial line is set to besides its rate is in the upper bits.
            Group::Bus(_, unit, _, setting) => {
                format!("bus {unit} at {}", setting & 0x00FF_FFFF)
            }
            Group::Frequency(_, timer, frequency_hz) => format!("{timer} at {frequency_hz} Hz"),
            Group::Program(_, unit, program) => format!("{unit} with the {program}"),
            Group::Pin(_, unit, role, at, _) => {
                format!("{} of {unit} on {}", role.name(), pin(*at).unwrap_or_default())
            }
            Group::Pad(_, at) => pin(*at).unwrap_or_default(),
            Group::Blocks(_, unit, blocks) => format!("{unit} in {blocks}"),
            Group::Tie(_, what) => format!("those {what}"),
        };
        self.on(*board, &name)
    }

    fn alternatives(&self) -> Vec<Vec<AlternativeLabels>> {
        let of_device = |(asker, meanings): (&Requester, &Vec<_>)| {
            let roles: Vec<String> = read_back::roles(self.design, *asker)
                .iter()
                .map(|role| role.name().to_owned())
                .collect();
            let names = meanings.iter().map(|meaning: &crate::builder::Meaning| {
                self.on(meaning.board, meaning.unit.as_deref().unwrap_or("any pin"))
            });
            let names = distinct(names).into_iter();
            names.map(|name| AlternativeLabels { name, roles: roles.clone() }).collect()
        };
        self.formulation.askers.iter().zip(&self.formulation.meanings).map(of_device).collect()
    }

    fn signals(&self) -> BTreeMap<u32, String> {
        let mut names = BTreeMap::new();
        for (device, meanings) in
            self.formulation.problem.devices.iter().zip(&self.formulation.meanings)
        {
            for (alternative, meaning) in device.alternatives.iter().zip(meanings) {
                for (role, chosen) in alternative.roles.iter().zip(&meaning.roles) {
                    for (candidate, at) in role.candidates.iter().zip(chosen) {
                        let pin = self.pin(meaning.board, at.pin);
                        let usage = pin.zip(at.usage).and_then(|(pin, at)| pin.usages.get(at));
                        let name = usage.map_or(GPIO, |usage| usage.signal.name());
                        names.entry(candidate.signal.0).or_insert_with(|| name.to_owned());
                    }
                }
            }
        }
        names
    }

    /// The names of the rules in the order of their numbers: for each device its own, then its
    /// boards'.
    fn rules(&self, count: usize) -> Vec<String> {
        let mut names = Vec::new();
        let mut last = None;
        for asker in &self.formulation.askers {
            // The connections of a part share their rules.
            let part = match asker {
                Requester::Connection(index) => self.design.connection(*index).map(|one| one.part),
                Requester::Link(_) => None,
            };
            if part.is_some() && part == last {
                continue;
            }
            last = part;
            let (own, boards): (&[Preference], _) = match asker {
                Requester::Connection(index) => match self.design.connection(*index) {
                    Some(one) => (&one.wishes, wanted(self.design, one).boards),
                    None => (&[], Vec::new()),
                },
                Requester::Link(board) => (&[], vec![*board]),
            };
            let boards = boards.iter().filter_map(|board| self.design.board(*board));
            let of_boards = boards.flat_map(|board| &board.wishes);
            let all = own.iter().chain(of_boards);
            names.extend(all.map(|wish| format!("{} ({})", describe(wish), self.device(*asker))));
        }
        if names.len() != count {
            names = (1..=count).map(|number| format!("rule {number}")).collect();
        }
        distinct(names.into_iter())
    }
}

/// A wish as it is written.
pub(crate) fn describe(wish: &Preference) -> String {
    let verb = if wish.prefer { "prefer" } else { "avoid" };
    match &wish.what {
        PreferenceSubject::Pin(Some(role), pin) => {
            format!("{verb} {} = {}", role.name(), pin.spelled)
        }
        PreferenceSubject::Pin(None, pin) => format!("{verb} pin = {}", pin.spelled),
        PreferenceSubject::Unit(unit) => format!("{verb} unit = {unit}"),
        PreferenceSubject::Side(side) => format!("{verb} side = {side}"),
        PreferenceSubject::Header(header) => format!("{verb} header = {header}"),
        PreferenceSubject::Together(what) => format!("{verb} together = {}", what.name()),
        PreferenceSubject::Sequence => format!("{verb} sequence = header"),
    }
}

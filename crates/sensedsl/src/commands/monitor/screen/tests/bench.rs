//! What the tests of the screen stand on: boards in, values that are made by formulas, keys, and the screen as text out.

use std::f64::consts::TAU;
use std::time::Duration;

use clap::Parser as _;
use ratatui_core::backend::TestBackend;
use ratatui_core::buffer::Buffer;
use ratatui_core::terminal::Terminal;
use sensedsl_host::{Board, Device, Moment, News, Scale, What};
use sensedsl_record::Past;
use sensedsl_wire::{
    Causes, Checksum, DeviceHealth, Direction, Health, Item, ResetCause, Scalar, ScalarType,
    Schema, Stamp, Status, ValueType, encode_health, encode_hello, encode_stamped_report,
};

use crate::cli::{Cli, Command, MonitorArgs};
use crate::commands::monitor::face::Ask;
use crate::commands::monitor::link::{Happening, Link};
use crate::commands::monitor::screen::draw::draw;
use crate::commands::monitor::screen::keys::{Key, Pressed};
use crate::commands::monitor::screen::state::State;
use crate::commands::monitor::screen::style::Look;
use crate::commands::monitor::source::Source;

/// The time between two reports.
pub(super) const REPORT_MS: u64 = 50;

pub(super) fn arguments() -> MonitorArgs {
    let Command::Monitor(args) = Cli::parse_from(["sensedsl", "monitor"]).command else {
        panic!("another command")
    };
    args
}

fn device(id: u8, name: &str, direction: Direction, value: ValueType) -> Device {
    Device {
        name: name.to_owned(),
        id,
        direction,
        value,
        kind: String::new(),
        quantity: None,
        scale: Scale::default(),
        min: None,
        max: None,
        cycle_ms: (direction == Direction::Sensor).then_some(50),
        obeys: None,
    }
}

fn plain(scalar: ScalarType) -> ValueType {
    ValueType { scalar, length: None }
}

/// A distance, a current, angles, a switch, a servo and a lamp.
pub(super) fn rover(name: &str) -> Board {
    let sensor = Direction::Sensor;
    let mut distance = device(17, "Distance", sensor, plain(ScalarType::Uint16));
    (distance.quantity, distance.scale) =
        (Some("cm".into()), Scale::new(Some(0.1), None, Vec::new()));
    distance.max = Some(400.0);
    let mut current = device(18, "Current", sensor, plain(ScalarType::Int16));
    (current.quantity, current.scale) =
        (Some("A".into()), Scale::new(Some(0.001), None, Vec::new()));
    let mut angles =
        device(19, "Angles", sensor, ValueType { scalar: ScalarType::Int16, length: Some(2) });
    angles.quantity = Some("deg".into());
    let switch = device(20, "Switch", sensor, plain(ScalarType::Bool));
    let mut servo = device(21, "Servo", Direction::Actuator, plain(ScalarType::Uint16));
    (servo.quantity, servo.scale) = (Some("deg".into()), Scale::new(Some(0.1), None, Vec::new()));
    (servo.min, servo.max) = (Some(0.0), Some(180.0));
    let lamp = device(22, "Lamp", Direction::Actuator, plain(ScalarType::Bool));
    board(name, vec![distance, current, angles, switch, servo, lamp])
}

/// So many temperatures.
pub(super) fn greenhouse(count: u8) -> Board {
    let all = (0..count).map(|index| {
        let mut one = device(
            index + 1,
            &format!("Temperature{index:02}"),
            Direction::Sensor,
            plain(ScalarType::Int16),
        );
        (one.quantity, one.scale) = (Some("°C".into()), Scale::new(Some(0.01), None, Vec::new()));
        one
    });
    board("Greenhouse", all.collect())
}

fn board(name: &str, devices: Vec<Device>) -> Board {
    let items = devices.iter().map(|one| Item {
        id: one.id,
        name: one.name.clone(),
        direction: one.direction,
        value: one.value,
    });
    let schema = Schema { checksum: Checksum::Crc16, stamp: true, items: items.collect() };
    Board { name: name.to_owned(), schema, baud: None, silence_ms: None, devices }
}

/// Boards whose values are made by formulas, and the screen that shows them.
pub(super) struct Bench<'a> {
    links: Vec<Link<'a>>,
    pub(super) state: State<'a>,
    pub(super) now_ms: u64,
    pub(super) look: Look,
}

impl<'a> Bench<'a> {
    pub(super) fn new(args: &'a MonitorArgs, boards: &'a [Board]) -> Self {
        let links: Vec<Link<'a>> =
            boards.iter().map(|board| Link::new(args, board, Source::Replayed)).collect();
        let state = State::new(boards.iter().collect());
        let mut bench =
            Self { links, state, now_ms: 0, look: Look { has_colours: true, has_shapes: true } };
        for (index, board) in boards.iter().enumerate() {
            bench.feed(index, encode_hello(&board.schema));
        }
        bench
    }

    pub(super) fn moment(&self) -> Moment {
        Moment { run: Duration::from_millis(self.now_ms), unix: Duration::ZERO }
    }

    pub(super) fn feed(&mut self, board: usize, bytes: Vec<u8>) {
        let at = self.moment();
        self.links[board].feed(bytes, at);
        self.tell(board);
    }

    pub(super) fn replay(&mut self, board: usize, what: Past) {
        let at = self.moment();
        self.links[board].replay(what, at);
        self.tell(board);
    }

    fn tell(&mut self, board: usize) {
        let at = self.moment();
        for happening in self.links[board].happened() {
            let what = match &happening {
                Happening::Online => What::Online,
                Happening::Offline(why) => What::Offline(why),
                Happening::Report(report) => What::Report(report),
                Happening::Command(device, value) => What::Command { device: *device, value },
                Happening::Say(text) => {
                    self.state.notes.say(at.run, text);
                    continue;
                }
                Happening::Received(bytes) => What::Received(bytes),
                Happening::Sent(bytes) => What::Sent(bytes),
                Happening::Health(health) => What::Health(health),
                Happening::Other(..) | Happening::Opened | Happening::Ended { .. } => continue,
            };
            self.state.hear(&News { board, at, what });
        }
    }

    /// Lets time go by, in which all boards but some report.
    pub(super) fn run(&mut self, time_ms: u64, without: &[usize]) {
        let end = self.now_ms + time_ms;
        while self.now_ms < end {
            self.now_ms += REPORT_MS;
            for board in (0..self.links.len()).filter(|board| !without.contains(board)) {
                self.report(board);
            }
        }
    }

    fn report(&mut self, board: usize) {
        let described = self.links[board].board;
        // The link takes a while.
        let made_ms = self.now_ms - self.now_ms / REPORT_MS * 7 % 5 - 1;
        let seconds = made_ms as f64 / 1e3;
        let sensors = described.devices.iter().filter(|one| one.direction == Direction::Sensor);
        let values: Vec<(u8, Vec<Scalar>)> = sensors
            .enumerate()
            .map(|(place, one)| {
                let all = (0..one.value.count()).map(|element| {
                    let phase = place as f64 * 0.7 + element as f64 * 1.5;
                    raw(one, 0.5 + 0.5 * (TAU * seconds / (8.0 + 3.0 * place as f64) + phase).sin())
                });
                (one.id, all.collect())
            })
            .collect();
        // A clock that trembles.
        let time_us = made_ms * 1_000 + self.now_ms * 31 % 400;
        let counter = (self.now_ms / REPORT_MS) as u8;
        let stamp = Stamp { time_us: time_us as u32, counter };
        let frame = encode_stamped_report(&described.schema, stamp, &values).unwrap();
        self.feed(board, frame);
    }

    /// Has a board tell its health; some of its devices are not well.
    pub(super) fn health(&mut self, board: usize, ill: &[(usize, Status, Causes)]) {
        let described = self.links[board].board;
        let devices = described.devices.iter().enumerate().map(|(place, one)| {
            let found = ill.iter().find(|(ill, ..)| *ill == place);
            let usual = match one.direction {
                Direction::Sensor => Status::Good,
                Direction::Actuator => Status::NeverRead,
            };
            DeviceHealth {
                id: one.id,
                status: found.map_or(usual, |found| found.1),
                age_ms: 3,
                causes: found.map_or(Causes::default(), |found| found.2),
            }
        });
        let health = Health {
            uptime_ms: self.now_ms as u32 + 4_000,
            reset_cause: ResetCause::Power,
            reset_device: 0,
            reports_sent: (self.now_ms / REPORT_MS) as u32,
            reports_refused: 0,
            load_percent: 12,
            stack_left_bytes: 512,
            devices: devices.collect(),
        };
        let frame = encode_health(&described.schema, &health).unwrap();
        self.feed(board, frame);
    }

    /// Presses keys: a letter each, or a name in angle brackets.
    pub(super) fn press(&mut self, keys: &str) -> Vec<Ask> {
        const NAMES: [&str; 14] = [
            "up",
            "down",
            "left",
            "right",
            "far-left",
            "page-down",
            "page-up",
            "home",
            "end",
            "enter",
            "esc",
            "tab",
            "backspace",
            "ctrl-c",
        ];
        let mut asks = Vec::new();
        let mut rest = keys;
        while let Some(letter) = rest.chars().next() {
            let named = rest.strip_prefix('«').and_then(|rest| rest.split_once('»'));
            let key = match named {
                Some((name, after)) => {
                    rest = after;
                    Key::Named(NAMES.iter().find(|one| **one == name).unwrap())
                }
                None => {
                    rest = &rest[letter.len_utf8()..];
                    Key::Char(letter)
                }
            };
            self.state.now = self.moment().run;
            asks.extend(self.state.press(&Pressed::Key(key)));
        }
        asks
    }

    pub(super) fn draw(&mut self, wide: u16, high: u16) -> Buffer {
        let mut terminal = Terminal::new(TestBackend::new(wide, high)).unwrap();
        let now = self.moment().run;
        let (state, links, look) = (&mut self.state, &self.links, self.look);
        terminal
            .draw(|frame| {
                if let Some(cursor) = draw(frame.buffer_mut(), state, links, now, look) {
                    frame.set_cursor_position(cursor);
                }
            })
            .unwrap();
        terminal.backend().buffer().clone()
    }

    pub(super) fn text(&mut self, wide: u16, high: u16) -> String {
        text(&self.draw(wide, high))
    }
}

fn raw(device: &Device, share: f64) -> Scalar {
    let scalar = device.value.scalar;
    if scalar == ScalarType::Bool {
        Scalar::Bool(share > 0.5)
    } else if scalar == ScalarType::Uint16 {
        Scalar::Unsigned((300.0 + 2_700.0 * share) as u64)
    } else {
        Scalar::Signed((2_000.0 * share) as i64 - 200)
    }
}

pub(super) fn text(buffer: &Buffer) -> String {
    let area = buffer.area;
    let rows = (area.y..area.bottom()).map(|y| {
        let row: String = (area.x..area.right()).map(|x| buffer[(x, y)].symbol()).collect();
        format!("{}\n", row.trim_end())
    });
    rows.collect()
}

//! Board tables as text in, pin problems out, for tests and measurements only.

use sensedsl_solve::problem::{
    Alternative, Board, BoardId, Candidate, Claim, Device, DmaRequest, DmaUser, DmaUserId, Holder,
    Pin, PinId, Problem, ResourceId, Role, SignalId, StreamId,
};
use std::collections::{BTreeMap, BTreeSet};

/// The table of the paper: pin, then its usages.
pub const TABLE_1: &str = "\
PA1 ADC123_IN1 TIM2_CH2 TIM5_CH2
PA2 ADC123_IN2 TIM9_CH1
PA3 ADC123_IN3 TIM9_CH2
PA8 I2C3_SCL
PB0 ADC12_IN8
PB1 ADC12_IN9
PB4 TIM3_CH1
PB5 TIM3_CH2
PB6 I2C1_SCL
PB7 I2C1_SDA TIM4_CH2
PB8 I2C1_SCL TIM10_CH1
PB9 I2C1_SDA
PB10 I2C2_SCL
PB11 I2C2_SDA
PB14 TIM12_CH1
PB15 TIM12_CH2
PC1 ADC123_IN11
PC2 ADC123_IN12
PC4 ADC12_IN14
PC5 ADC12_IN15
PC6 TIM3_CH1 TIM8_CH1
PC9 I2C3_SDA
PE5 TIM9_CH1
PE6 TIM9_CH2
PE9 TIM1_CH1
PE11 TIM1_CH2
";

/// The resources that a target takes in addition to pins.
#[derive(Clone, Copy, Default, PartialEq, Eq)]
pub enum Target {
    /// Pins and signals only.
    #[default]
    None,
    /// One capture per timer.
    Timers,
    /// In addition, no capture on one-channel timers.
    Chibios,
}

/// A kind of device.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Kind {
    Analog,
    /// Shared unless exclusive; devices of one address are kept apart.
    I2c {
        address: u32,
        exclusive: bool,
    },
    Icu,
    Encoder,
    /// Outputs of one group share a timer.
    Pwm {
        group: u32,
    },
    Uart,
    Spi,
    Can,
    Dac,
    Digital {
        edge: bool,
    },
}

/// Builds a problem device by device.
#[derive(Default)]
pub struct Builder {
    pub problem: Problem,
    pub names: Vec<String>,
    pub signals: Vec<String>,
    target: Target,
    /// Pins and signals of each board, in order.
    usages: Vec<Vec<(PinId, String)>>,
    resources: BTreeMap<String, u32>,
    users: BTreeMap<String, DmaUserId>,
    /// Streams of a peripheral's requests, by its name.
    dma: BTreeMap<String, Vec<Vec<u32>>>,
    streams_per_board: u32,
}

fn natural(pin: &str) -> (char, u32) {
    (pin.chars().nth(1).unwrap_or('?'), pin.get(2..).and_then(|n| n.parse().ok()).unwrap_or(0))
}

impl Builder {
    /// Boards with their tables; `true` marks a spare one.
    pub fn new(target: Target, boards: &[(&str, bool)]) -> Self {
        let mut builder = Self { target, ..Self::default() };
        let names: BTreeSet<&str> = boards
            .iter()
            .flat_map(|(table, _)| table.lines())
            .flat_map(|line| line.split_whitespace().skip(1))
            .collect();
        builder.signals = names.into_iter().map(str::to_owned).collect();
        builder.signals.push("~GPIO".to_owned());
        for (index, (table, spare)) in boards.iter().enumerate() {
            let board = BoardId(index as u32);
            builder.problem.boards.push(Board { spare: *spare });
            let mut rows: Vec<Vec<&str>> =
                table.lines().map(|line| line.split_whitespace().collect()).collect();
            rows.retain(|row| !row.is_empty());
            rows.sort_by_key(|row| natural(row[0]));
            let mut usages = Vec::new();
            for row in rows {
                let pin = PinId(builder.problem.pins.len() as u32);
                builder.problem.pins.push(Pin { board, cost: row.len() as u32 - 1, shared: false });
                builder.names.push(row[0].to_owned());
                usages.extend(row[1..].iter().map(|usage| (pin, (*usage).to_owned())));
                usages.push((pin, "~GPIO".to_owned()));
            }
            builder.usages.push(usages);
        }
        builder
    }

    /// Streams that the requests of a peripheral can take, numbered on each board from 0.
    pub fn dma(&mut self, streams: u32, peripheral: &str, requests: &[&[u32]]) {
        self.streams_per_board = streams;
        self.problem.streams = streams * self.problem.boards.len() as u32;
        self.dma.insert(peripheral.to_owned(), requests.iter().map(|r| r.to_vec()).collect());
    }

    fn resource(&mut self, name: String) -> ResourceId {
        let next = self.resources.len() as u32;
        let number = *self.resources.entry(name).or_insert(next);
        self.problem.resources = self.resources.len() as u32;
        ResourceId(number)
    }

    fn claim(&mut self, name: String, holder: Holder) -> Claim {
        Claim { resource: self.resource(name), holder }
    }

    fn signal(&self, name: &str) -> SignalId {
        SignalId(self.signals.iter().position(|s| s == name).expect("a known signal") as u32)
    }

    fn user(&mut self, board: usize, unit: &str) -> Vec<DmaUserId> {
        let Some(requests) = self.dma.get(unit) else { return Vec::new() };
        let base = board as u32 * self.streams_per_board;
        let requests = requests
            .iter()
            .map(|r| DmaRequest { streams: r.iter().map(|s| StreamId(base + s)).collect() })
            .collect();
        let next = DmaUserId(self.problem.dma.len() as u32);
        let user = *self.users.entry(format!("{board} {unit}")).or_insert(next);
        if user == next {
            self.problem.dma.push(DmaUser { requests });
        }
        vec![user]
    }

    /// Candidates on a board whose signal is accepted, with the claims that the target requires.
    fn role(&mut self, board: usize, accept: impl Fn(&str) -> bool, shared: Option<&str>) -> Role {
        let mut candidates = Vec::new();
        for (pin, usage) in self.usages[board].clone() {
            if !accept(&usage) {
                continue;
            }
            let mut claims = Vec::new();
            let holder = match shared {
                Some(wire) => {
                    claims.push(self.claim(format!("{board} {wire}"), Holder::Group(pin.0)));
                    Holder::Group(self.resource(format!("{board} {wire}")).0)
                }
                None => {
                    if usage != "~GPIO" && self.target == Target::None {
                        claims.push(self.claim(format!("{board} signal {usage}"), Holder::Own));
                    }
                    Holder::Own
                }
            };
            let signal = self.signal(&usage);
            candidates.push(Candidate { holder, claims, ..Candidate::new(pin, signal) });
        }
        candidates.sort_by_key(|c| (c.pin, c.signal));
        Role { candidates }
    }

    fn units(&self, board: usize, prefixes: &[&str]) -> Vec<String> {
        let mut units = BTreeSet::new();
        for (_, usage) in &self.usages[board] {
            let unit = usage.split('_').next().unwrap_or("");
            let digits = unit.trim_start_matches(|c: char| c.is_ascii_alphabetic());
            let letters = unit.get(..unit.len() - digits.len()).unwrap_or("");
            let i2c = unit.starts_with("I2C") && prefixes.contains(&"I2C");
            if i2c || prefixes.contains(&letters) {
                units.insert(unit.to_owned());
            }
        }
        units.into_iter().collect()
    }

    fn alternative(&self, board: usize, claims: Vec<Claim>, roles: Vec<Role>) -> Alternative {
        Alternative {
            board: BoardId(board as u32),
            claims,
            violates: Vec::new(),
            dma: Vec::new(),
            roles,
        }
    }

    /// Adds a device that may go to any of the boards.
    pub fn device(&mut self, kind: &Kind, boards: &[usize]) {
        let mut alternatives = Vec::new();
        for &board in boards {
            alternatives.extend(self.alternatives(kind, board));
        }
        alternatives.retain(|a: &Alternative| a.roles.iter().all(|r| !r.candidates.is_empty()));
        self.problem.devices.push(Device { alternatives });
    }

    fn alternatives(&mut self, kind: &Kind, board: usize) -> Vec<Alternative> {
        match kind {
            Kind::Analog => {
                let role = self.role(board, |u| u.starts_with("ADC"), None);
                vec![self.alternative(board, vec![], vec![role])]
            }
            Kind::Dac => {
                let role = self.role(board, |u| u.starts_with("DAC"), None);
                vec![self.alternative(board, vec![], vec![role])]
            }
            Kind::Digital { edge } => {
                let mut role = self.role(board, |u| u == "~GPIO", None);
                if *edge {
                    for c in &mut role.candidates {
                        let line = natural(&self.names[c.pin.0 as usize]).1;
                        c.claims.push(self.claim(format!("{board} EXTI{line}"), Holder::Own));
                    }
                }
                vec![self.alternative(board, vec![], vec![role])]
            }
            Kind::I2c { address, exclusive } => self.i2c(board, *address, *exclusive),
            Kind::Icu if self.target == Target::None => {
                let role = self.role(board, |u| capture(u, false), None);
                vec![self.alternative(board, vec![], vec![role])]
            }
            Kind::Icu => {
                let chibios = self.target == Target::Chibios;
                self.timers(board, Holder::Own, |unit, u| {
                    vec![u.starts_with(&format!("{unit}_")) && capture(u, chibios)]
                })
            }
            Kind::Encoder => self.timers(board, Holder::Own, |unit, u| {
                vec![u == format!("{unit}_CH1"), u == format!("{unit}_CH2")]
            }),
            Kind::Pwm { group } => {
                let mut all = self.timers(board, Holder::Group(*group), |unit, u| {
                    vec![u.starts_with(&format!("{unit}_CH"))]
                });
                for c in all.iter_mut().flat_map(|a| &mut a.roles).flat_map(|r| &mut r.candidates) {
                    let name = self.signals[c.signal.0 as usize].clone();
                    c.claims.push(self.claim(format!("{board} channel {name}"), Holder::Own));
                }
                all
            }
            Kind::Uart => self.bus(board, &["USART", "UART", "LPUART"], &["TX", "RX"], None),
            Kind::Can => self.bus(board, &["CAN", "FDCAN"], &["RX", "TX"], Some(0)),
            Kind::Spi => {
                let mut all = self.bus(board, &["SPI"], &["SCK", "MISO", "MOSI"], Some(0));
                for a in &mut all {
                    a.roles.push(self.role(board, |u| u == "~GPIO", None));
                }
                all
            }
        }
    }

    fn i2c(&mut self, board: usize, address: u32, exclusive: bool) -> Vec<Alternative> {
        let group = if exclusive { None } else { Some(0) };
        let mut all = self.bus(board, &["I2C"], &["SCL", "SDA"], group);
        for a in &mut all {
            let unit = a.claims[0].resource.0;
            a.claims.push(self.claim(format!("{unit} address {address}"), Holder::Own));
        }
        all
    }

    fn bus(
        &mut self,
        board: usize,
        prefixes: &[&str],
        roles: &[&str],
        group: Option<u32>,
    ) -> Vec<Alternative> {
        let mut alternatives = Vec::new();
        for unit in self.units(board, prefixes) {
            let holder = group.map_or(Holder::Own, Holder::Group);
            let claims = vec![self.claim(format!("{board} {unit}"), holder)];
            let mut made = Vec::new();
            for role in roles {
                let wire = format!("{unit}_{role}");
                made.push(self.role(board, |u| u == wire, group.map(|_| wire.as_str())));
            }
            let mut alternative = self.alternative(board, claims, made);
            alternative.dma = self.user(board, &unit);
            alternatives.push(alternative);
        }
        alternatives
    }

    fn timers(
        &mut self,
        board: usize,
        holder: Holder,
        roles: impl Fn(&str, &str) -> Vec<bool>,
    ) -> Vec<Alternative> {
        let mut alternatives = Vec::new();
        for unit in self.units(board, &["TIM"]) {
            let mut made = Vec::new();
            for index in 0..roles(&unit, "").len() {
                made.push(self.role(board, |u| roles(&unit, u)[index], None));
            }
            let claims = vec![self.claim(format!("{board} {unit}"), holder)];
            alternatives.push(self.alternative(board, claims, made));
        }
        alternatives
    }

    /// Pin names of an answer, device by device.
    pub fn pins(&self, answer: &sensedsl_solve::Answer) -> Vec<Vec<&str>> {
        self.wires(answer, |c| self.names[c.pin.0 as usize].as_str())
    }

    /// Signal names of an answer, device by device.
    pub fn used_signals(&self, answer: &sensedsl_solve::Answer) -> Vec<Vec<&str>> {
        self.wires(answer, |c| self.signals[c.signal.0 as usize].as_str())
    }

    fn wires<'a>(
        &'a self,
        answer: &sensedsl_solve::Answer,
        name: impl Fn(&Candidate) -> &'a str,
    ) -> Vec<Vec<&'a str>> {
        let devices = self.problem.devices.iter().zip(&answer.choices);
        devices
            .map(|(device, choice)| {
                let roles = &device.alternatives[choice.alternative].roles;
                let picks = roles.iter().zip(&choice.candidates);
                picks.map(|(role, &c)| name(&role.candidates[c])).collect()
            })
            .collect()
    }
}

/// Channels 1 and 2 can capture; ChibiOS does not measure on one-channel timers.
fn capture(usage: &str, chibios: bool) -> bool {
    let Some((unit, channel)) = usage.split_once('_') else { return false };
    let single = ["TIM10", "TIM11", "TIM13", "TIM14"].contains(&unit);
    unit.starts_with("TIM") && (channel == "CH1" || channel == "CH2") && !(chibios && single)
}

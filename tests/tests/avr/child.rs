//! The process with an AVR in it: what the board asks of its surroundings in, answers out.

use std::collections::BTreeMap;
use std::io::{BufReader, Read, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use sensedsl_surroundings::{I2cEvent, I2cReply, Pad, Surroundings, TimerOutput};

use super::tools;

/// The only I2C bus and the only SPI port.
const BUS: u8 = 1;
/// Where a port would be, of an input of the converter that has none.
const NO_PORT: u8 = 0xFF;
/// The ports A to L.
const PORTS: usize = 12;
/// A level that nothing drives.
const FLOATING: u8 = 2;

/// What is around an AVR: what is around any MCU, and inputs of its converter that no port has.
pub(crate) trait Around: Surroundings {
    /// The voltage at such an input.
    fn input_millivolts(&mut self, _input: u8, _now_ns: u64) -> f64 {
        0.0
    }
}

/// The port that the host is at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Link {
    Serial(u8),
    Usb,
    None,
}

/// How a serial port is set up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Serial {
    pub baud: u32,
    pub data_bits: u8,
    pub odd_parity: Option<bool>,
    pub stop_bits: u8,
}

/// How a port of the board is set up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Setting {
    Serial(Serial),
    Spi { clock_hz: u32, mode: u8 },
    I2c { clock_hz: u32 },
}

/// The board, and what is connected to it.
pub(crate) struct Setup<'a> {
    /// The MCU, as simavr calls it.
    pub mcu: &'a str,
    pub clock_hz: u32,
    pub image: &'a Path,
    pub link: Link,
    /// What is at the serial ports, that of the link included, by number.
    pub serials: BTreeMap<u8, Serial>,
    /// The pads that may be driven from outside.
    pub pads: Vec<Pad>,
}

/// A reset that was not the beginning.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Reset {
    pub at_ns: u64,
    /// As in the MCU's register: 1 is power, 8 the watchdog.
    pub cause: u8,
}

impl Reset {
    pub(crate) const POWER: u8 = 1;
    pub(crate) const WATCHDOG: u8 = 8;
}

/// The first change of a pad that is announced, and its level then.
type Edge = Option<(u64, Option<bool>)>;

/// An AVR in its surroundings.
pub(crate) struct Avr<A> {
    child: Child,
    orders: ChildStdin,
    news: BufReader<ChildStdout>,
    pub around: A,
    /// The pads, each with what the board was told of it.
    told: BTreeMap<Pad, Option<(Option<bool>, Edge)>>,
    now_ns: u64,
    asleep_ns: u64,
    watchdog_ns: u64,
    /// What the host has received, with the times.
    received: Vec<(u64, u8)>,
    resets: Vec<Reset>,
    settings: BTreeMap<(char, u8), Setting>,
    crash: Option<u32>,
}

impl<A: Around> Avr<A> {
    pub(crate) fn start(setup: &Setup<'_>, around: A) -> Self {
        let link = match setup.link {
            Link::Serial(unit) => unit.to_string(),
            Link::Usb => "usb".to_owned(),
            Link::None => "none".to_owned(),
        };
        let mut command = Command::new(tools::emulator());
        command.arg(setup.mcu).arg(setup.clock_hz.to_string()).arg(setup.image).arg(link);
        for (unit, serial) in &setup.serials {
            let Serial { baud, data_bits, odd_parity, stop_bits } = serial;
            let parity = odd_parity.map_or(0, |is_odd| if is_odd { 2 } else { 1 });
            command.arg(format!("{unit}:{baud}:{data_bits}:{parity}:{stop_bits}"));
        }
        let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
        let (orders, news) = (child.stdin.take().unwrap(), child.stdout.take().unwrap());
        Self {
            child,
            orders,
            news: BufReader::new(news),
            around,
            told: setup.pads.iter().map(|pad| (*pad, None)).collect(),
            now_ns: 0,
            asleep_ns: 0,
            watchdog_ns: 0,
            received: Vec::new(),
            resets: Vec::new(),
            settings: BTreeMap::new(),
            crash: None,
        }
    }

    pub(crate) const fn now_ns(&self) -> u64 {
        self.now_ns
    }

    /// The time that the processor has slept so far.
    pub(crate) const fn asleep_ns(&self) -> u64 {
        self.asleep_ns
    }

    /// How long the watchdog waits; none if it does not run.
    pub(crate) fn watchdog_ns(&self) -> Option<u64> {
        Some(self.watchdog_ns).filter(|ns| *ns > 0)
    }

    pub(crate) fn resets(&self) -> &[Reset] {
        &self.resets
    }

    /// Where the program did something that no AVR can.
    pub(crate) const fn crash(&self) -> Option<u32> {
        self.crash
    }

    /// How the ports are set up: `u` and a number for a serial one, `s` for SPI, `i` for I2C.
    pub(crate) const fn settings(&self) -> &BTreeMap<(char, u8), Setting> {
        &self.settings
    }

    /// What the program has written to DDRx and PORTx, by port from A on.
    pub(crate) fn registers(&mut self) -> Vec<(u8, u8)> {
        self.order(b"S");
        let all: [u8; 2 * PORTS] = self.bytes();
        all.chunks_exact(2).map(|pair| (pair[0], pair[1])).collect()
    }

    pub(crate) fn link_read(&mut self) -> Vec<(u64, u8)> {
        std::mem::take(&mut self.received)
    }

    pub(crate) fn link_write(&mut self, bytes: &[u8]) {
        for some in bytes.chunks(1_000) {
            let count = u16::try_from(some.len()).unwrap().to_le_bytes();
            self.order(&[b"L", &count[..], some].concat());
        }
    }

    pub(crate) fn link_open(&mut self, is_open: bool) {
        self.order(&[b'O', u8::from(is_open)]);
    }

    pub(crate) fn power(&mut self, is_on: bool) {
        self.order(&[b'P', u8::from(is_on)]);
        self.serve();
    }

    /// What is around the board has changed, not only as it had announced.
    pub(crate) fn surroundings_changed(&mut self) {
        self.told.values_mut().for_each(|told| *told = None);
    }

    pub(crate) fn run_until(&mut self, until_ns: u64) {
        let levels = self.changed_levels(self.now_ns);
        self.order(&[b"R", &until_ns.to_le_bytes()[..], &levels].concat());
        self.serve();
    }

    fn order(&mut self, bytes: &[u8]) {
        self.orders.write_all(bytes).unwrap();
        self.orders.flush().unwrap();
    }

    fn bytes<const N: usize>(&mut self) -> [u8; N] {
        let mut bytes = [0; N];
        let read = self.news.read_exact(&mut bytes);
        assert!(read.is_ok(), "the board is gone: {:?}", self.child.wait());
        bytes
    }

    fn byte(&mut self) -> u8 {
        let [byte] = self.bytes();
        byte
    }

    fn pad(&mut self) -> Pad {
        let [port, pin] = self.bytes();
        Pad { port, pin }
    }

    fn time(&mut self) -> u64 {
        u64::from_le_bytes(self.bytes())
    }

    /// The levels that the board does not know yet. What was announced it knows when it comes.
    fn changed_levels(&mut self, now_ns: u64) -> Vec<u8> {
        let mut changed = Vec::new();
        for (pad, told) in &mut self.told {
            let level = self.around.level(*pad, now_ns);
            if told.is_none_or(|(before, _)| before != level) {
                let edge = edge_after(&mut self.around, *pad, now_ns);
                *told = Some((level, edge));
                changed.push((*pad, level, edge));
            }
        }
        levels(&changed)
    }

    /// The same after the board has driven a pad, which may change what was announced.
    fn levels_after_drive(&mut self, now_ns: u64) -> Vec<u8> {
        let mut changed = Vec::new();
        for (pad, told) in &mut self.told {
            let level = self.around.level(*pad, now_ns);
            let fresh = Some((level, edge_after(&mut self.around, *pad, now_ns)));
            if fresh != *told {
                *told = fresh;
                changed.extend(fresh.map(|(level, edge)| (*pad, level, edge)));
            }
        }
        levels(&changed)
    }

    /// Answers until the board has done what it was told.
    fn serve(&mut self) {
        loop {
            match self.byte() {
                b'D' => break,
                asked @ (b'a' | b'e' | b'd' | b'i' | b's' | b'u') => {
                    let answer = self.answer(asked);
                    self.order(&answer);
                }
                told => self.hear(told),
            }
        }
        (self.now_ns, self.asleep_ns, self.watchdog_ns) = (self.time(), self.time(), self.time());
    }

    fn answer(&mut self, asked: u8) -> Vec<u8> {
        match asked {
            b'a' => {
                let (pad, now_ns) = (self.pad(), self.time());
                let millivolts = match pad.port {
                    NO_PORT => self.around.input_millivolts(pad.pin, now_ns),
                    _ => self.around.millivolts(pad, now_ns),
                };
                let microvolts = (millivolts * 1_000.0).round().clamp(0.0, 1e9) as u32;
                microvolts.to_le_bytes().to_vec()
            }
            b'e' => {
                let (pad, at_ns) = (self.pad(), self.time());
                let level = self.around.level(pad, at_ns);
                let edge = edge_after(&mut self.around, pad, at_ns);
                self.told.insert(pad, Some((level, edge)));
                levels(&[(pad, level, edge)])
            }
            b'd' => {
                let (pad, level, now_ns) = (self.pad(), self.byte(), self.time());
                let level = (level != FLOATING).then_some(level == 1);
                self.around.driven(pad, level, now_ns);
                self.levels_after_drive(now_ns)
            }
            b'i' => self.answer_i2c().to_vec(),
            b's' => {
                let (out, now_ns) = (self.byte(), self.time());
                vec![self.around.spi(BUS, out, now_ns)]
            }
            _ => {
                let (unit, now_ns) = (self.byte(), self.time());
                let byte = self.around.uart_in(unit, now_ns);
                vec![u8::from(byte.is_some()), byte.unwrap_or_default()]
            }
        }
    }

    fn answer_i2c(&mut self) -> [u8; 2] {
        let ([event, value, flag], now_ns) = (self.bytes(), self.time());
        let event = match event {
            0 => I2cEvent::Start { address: value, read: flag == 1 },
            1 => I2cEvent::Write(value),
            2 => I2cEvent::Read { ack: flag == 1 },
            _ => I2cEvent::Stop,
        };
        match self.around.i2c(BUS, event, now_ns) {
            I2cReply::Ack => [0, 0],
            I2cReply::Nack => [1, 0],
            I2cReply::Byte(byte) => [2, byte],
            I2cReply::Stuck => [3, 0],
            I2cReply::Silent => [4, 0],
        }
    }

    fn hear(&mut self, told: u8) {
        match told {
            b'o' => {
                let ([unit, byte], now_ns) = (self.bytes(), self.time());
                self.around.uart_out(unit, byte, now_ns);
            }
            b'k' => {
                let (byte, now_ns) = (self.byte(), self.time());
                self.received.push((now_ns, byte));
            }
            b'v' => {
                let (byte, from_ps, bit_ps) = (self.byte(), self.time(), self.time());
                self.around.levels(BUS, byte, from_ps, bit_ps);
            }
            b'p' => {
                let [timer, channel, is_complement] = self.bytes();
                let output = TimerOutput { timer, channel, is_complement: is_complement == 1 };
                let (period_ns, width_ns, now_ns) = (self.time(), self.time(), self.time());
                self.around.pwm(output, period_ns, width_ns, now_ns);
            }
            b'r' => {
                let (cause, at_ns) = (self.byte(), self.time());
                self.resets.push(Reset { at_ns, cause });
            }
            b'b' => self.hear_setting(),
            b'x' => self.crash = Some(u32::from_le_bytes(self.bytes())),
            other => panic!("the board says {other}"),
        }
    }

    fn hear_setting(&mut self) {
        let [kind, unit] = self.bytes();
        let hz = u32::from_le_bytes(self.bytes());
        let [data_bits, parity, stop_bits] = self.bytes();
        let setting = match kind {
            b'u' => {
                let odd_parity = (parity > 0).then_some(parity == 2);
                Setting::Serial(Serial { baud: hz, data_bits, odd_parity, stop_bits })
            }
            b's' => Setting::Spi { clock_hz: hz, mode: data_bits },
            _ => Setting::I2c { clock_hz: hz },
        };
        self.settings.insert((char::from(kind), unit), setting);
    }
}

impl<A> Drop for Avr<A> {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// The next edge of a pad; one in the past would make the time stand still.
fn edge_after(around: &mut impl Around, pad: Pad, now_ns: u64) -> Edge {
    let (at_ns, level) = around.next_edge(pad, now_ns)?;
    Some((at_ns.max(now_ns + 1), Some(level)))
}

fn code(level: Option<bool>) -> u8 {
    level.map_or(FLOATING, u8::from)
}

/// Levels and edges as the board reads them.
fn levels(all: &[(Pad, Option<bool>, Edge)]) -> Vec<u8> {
    let mut bytes = u16::try_from(all.len()).unwrap().to_le_bytes().to_vec();
    for (pad, level, edge) in all {
        let (at_ns, after) = edge.unwrap_or((u64::MAX, None));
        bytes.extend([pad.port, pad.pin, code(*level)]);
        bytes.extend(at_ns.to_le_bytes());
        bytes.push(code(after));
    }
    bytes
}

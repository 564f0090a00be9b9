//! A host computer that uses the board as a serial port: it enumerates the device and moves bytes both ways.

use super::unit::Function;
use crate::wires::{NEVER, Wires};

/// The length of a frame, and the time after which the host polls again.
const FRAME_NS: u64 = 1_000_000;
const TURN_NS: u64 = 50_000;
/// How long a host waits before it resets a device that it found, and how long the reset takes.
const DEBOUNCE_NS: u64 = 100_000_000;
const RESET_NS: u64 = 10_000_000;
/// The number of polls after which an unanswered request is made again, after a reset.
const PATIENCE_TURNS: u32 = 20_000;
/// The index of the last request in the list, which tells the device whether a program has the port open.
const LINES: usize = 7;
/// The address that it gives the device, and the number of the request that does.
const ADDRESS: u8 = 7;
const ADDRESSING: usize = 1;
/// The longest packet of an endpoint at full speed.
const PACKET_BYTES: usize = 64;

/// The stage of a control transfer.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
enum Step {
    #[default]
    Setup,
    DataIn,
    DataOut,
    StatusIn,
    StatusOut,
}

/// The host's activity with the device.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
enum State {
    #[default]
    Absent,
    Debouncing,
    Resetting,
    /// It makes the request with this number in the list.
    Enumerating(usize),
    Running,
}

/// The host's end of the cable.
#[derive(Debug, Default)]
pub(super) struct Host {
    pub next_ns: u64,
    state: State,
    step: Step,
    frame_ns: u64,
    /// The address at which it talks to the device.
    address: u8,
    answer: Vec<u8>,
    waited: u32,
    configuration_bytes: u16,
    configuration: u8,
    input: usize,
    output: usize,
    interface: u8,
    /// The port state that it has last told the device.
    is_open: bool,
}

/// A request of the enumeration: its packet, and the data sent with it.
struct ControlRequest {
    packet: [u8; 8],
    data: Vec<u8>,
}

impl ControlRequest {
    fn is_in(&self) -> bool {
        self.packet[0] & 0x80 != 0
    }

    fn length(&self) -> usize {
        usize::from(u16::from_le_bytes([self.packet[6], self.packet[7]]))
    }
}

fn request(kind: u8, request: u8, value: u16, index: u16, length: u16) -> [u8; 8] {
    let ([v0, v1], [i0, i1], [l0, l1]) =
        (value.to_le_bytes(), index.to_le_bytes(), length.to_le_bytes());
    [kind, request, v0, v1, i0, i1, l0, l1]
}

impl Host {
    pub(super) fn new() -> Self {
        Self {
            next_ns: NEVER,
            configuration_bytes: 9,
            configuration: 1,
            input: 1,
            output: 1,
            is_open: true,
            ..Self::default()
        }
    }

    /// The device connects to the bus, or disconnects.
    pub(super) fn plugged(&mut self, is_there: bool, now: u64) {
        if is_there && self.state == State::Absent {
            self.state = State::Debouncing;
            self.next_ns = now + DEBOUNCE_NS;
        } else if !is_there {
            *self = Self::new();
        }
    }

    pub(super) fn act(&mut self, usb: &mut dyn Function, wires: &mut Wires) {
        let now = self.next_ns;
        match self.state {
            State::Absent => self.next_ns = NEVER,
            State::Debouncing => {
                usb.reset();
                self.address = 0;
                self.state = State::Resetting;
                self.next_ns = now + RESET_NS;
            }
            State::Resetting => {
                usb.enumerated();
                (self.state, self.step) = (State::Enumerating(0), Step::Setup);
                self.frame_ns = now + FRAME_NS;
                self.next_ns = now + FRAME_NS;
            }
            State::Enumerating(at) => {
                self.frame(usb, now);
                self.enumerate(at, usb);
                self.next_ns = now + TURN_NS;
            }
            State::Running if wires.link.is_open != self.is_open => {
                self.is_open = wires.link.is_open;
                (self.state, self.step) = (State::Enumerating(LINES), Step::Setup);
                self.next_ns = now + TURN_NS;
            }
            State::Running => {
                self.frame(usb, now);
                if self.is_open {
                    self.exchange(usb, wires, now);
                }
                self.next_ns = now + TURN_NS;
            }
        }
    }

    fn frame(&mut self, usb: &mut dyn Function, now: u64) {
        if now >= self.frame_ns {
            usb.start_frame();
            self.frame_ns += FRAME_NS;
        }
    }

    /// The host's requests, in order; `None` after the last one.
    fn enquiry(&self, at: usize) -> Option<ControlRequest> {
        let interface = u16::from(self.interface);
        let line = vec![0x00, 0xC2, 0x01, 0x00, 0, 0, 8];
        let (packet, data) = match at {
            0 => (request(0x80, 6, 0x0100, 0, 64), Vec::new()),
            ADDRESSING => (request(0x00, 5, u16::from(ADDRESS), 0, 0), Vec::new()),
            2 => (request(0x80, 6, 0x0100, 0, 18), Vec::new()),
            3 => (request(0x80, 6, 0x0200, 0, 9), Vec::new()),
            4 => (request(0x80, 6, 0x0200, 0, self.configuration_bytes), Vec::new()),
            5 => (request(0x00, 9, u16::from(self.configuration), 0, 0), Vec::new()),
            6 => (request(0x21, 0x20, 0, interface, 7), line),
            LINES => {
                let lines = if self.is_open { 3 } else { 0 };
                (request(0x21, 0x22, lines, interface, 0), Vec::new())
            }
            _ => return None,
        };
        Some(ControlRequest { packet, data })
    }

    fn enumerate(&mut self, at: usize, usb: &mut dyn Function) {
        let Some(enquiry) = self.enquiry(at) else {
            self.state = State::Running;
            return;
        };
        self.waited += 1;
        if self.waited > PATIENCE_TURNS {
            (self.waited, self.state) = (0, State::Debouncing);
            return;
        }
        if !usb.hears(self.address) {
            return;
        }
        let is_in = matches!(self.step, Step::DataIn | Step::StatusIn);
        if self.step != Step::Setup && usb.has_stalled(0, is_in) {
            // The device does not know the request: a host goes on without its answer.
            self.finish(at, usb);
            return;
        }
        match self.step {
            Step::Setup if usb.is_idle() => {
                usb.setup(enquiry.packet);
                self.answer.clear();
                self.step = match (enquiry.is_in(), enquiry.length()) {
                    (true, 1..) => Step::DataIn,
                    (false, 1..) => Step::DataOut,
                    _ => Step::StatusIn,
                };
            }
            Step::Setup => {}
            Step::DataIn => {
                if let Some(data) = usb.fetch(0) {
                    let is_short = data.len() < PACKET_BYTES;
                    self.answer.extend(data);
                    if is_short || self.answer.len() >= enquiry.length() {
                        self.step = Step::StatusOut;
                    }
                }
            }
            Step::DataOut if usb.send(0, &enquiry.data) => self.step = Step::StatusIn,
            Step::StatusIn if usb.fetch(0).is_some() => self.finish(at, usb),
            Step::StatusOut if usb.send(0, &[]) => self.finish(at, usb),
            Step::DataOut | Step::StatusIn | Step::StatusOut => {}
        }
    }

    /// Reads the answer and goes on.
    fn finish(&mut self, at: usize, usb: &dyn Function) {
        let answer = std::mem::take(&mut self.answer);
        if at == 3
            && let (Some(low), Some(high)) = (answer.get(2), answer.get(3))
        {
            self.configuration_bytes = u16::from_le_bytes([*low, *high]);
        }
        if at == 4 {
            self.read_configuration(&answer, usb.endpoints());
        }
        if at == ADDRESSING {
            self.address = ADDRESS;
        }
        (self.step, self.waited) = (Step::Setup, 0);
        self.state = State::Enumerating(at + 1);
    }

    /// Finds the interface of the communications class and the endpoints for the bytes.
    fn read_configuration(&mut self, answer: &[u8], endpoints: usize) {
        let number = |address: u8| usize::from(address & 15) % endpoints;
        let mut rest = answer;
        while let Some(length) =
            rest.first().map(|length| usize::from(*length)).filter(|length| *length >= 2)
        {
            match *rest {
                [_, 2, _, _, _, value, ..] => self.configuration = value,
                [_, 4, interface, _, _, 2, 2, ..] => self.interface = interface,
                [_, 5, address, 2, ..] if address & 0x80 != 0 => {
                    self.input = number(address);
                }
                [_, 5, address, 2, ..] => self.output = number(address),
                _ => {}
            }
            rest = rest.get(length..).unwrap_or_default();
        }
    }

    fn exchange(&mut self, usb: &mut dyn Function, wires: &mut Wires, now: u64) {
        if !usb.hears(self.address) {
            return;
        }
        if let Some(data) = usb.fetch(self.input) {
            wires.link.from_mcu.extend(data.into_iter().map(|byte| (now, byte)));
        }
        if wires.link.to_mcu.is_empty() {
            return;
        }
        let count = wires.link.to_mcu.len().min(PACKET_BYTES);
        let packet: Vec<u8> = wires.link.to_mcu.iter().take(count).copied().collect();
        if usb.send(self.output, &packet) {
            wires.link.to_mcu.drain(..count);
        }
    }
}

//! The program `tests/drivers/main.c` again, in Rust: it reads the same requests and prints the
//! same lines, using the runtime in Rust.

use std::fmt::Write as _;

use sense_rt::{
    BridgeState, Chip, ChipTable, Filter, Heard, MessageStream, Outcome, Scalar, Sink, Step, Train,
    store_signed,
};

use super::library::Unit;
use super::rust_tables::Tables;

const MEMORY_BYTES: usize = 8192;
const FILL: u8 = 0xA5;
const STEPS_MAX: u32 = 2000;

enum Kind {
    Register(u32),
    Answer,
    Exchange,
}

struct Entry {
    kind: Kind,
    trigger: Vec<u8>,
    bytes: Vec<u8>,
}

/// A part on its bus.
#[derive(Default)]
struct Bus {
    register_bytes: usize,
    read_mask: u8,
    alone: bool,
    entries: Vec<Entry>,
    written: Vec<u8>,
    seed: u32,
    traces: bool,
    prints: bool,
}

impl Bus {
    fn draw(&mut self, limit: u32) -> u32 {
        self.seed = self.seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (self.seed >> 16) % limit
    }

    fn fate(&mut self, what: &str, bytes: &[u8], now_ms: &mut u32, out: &mut String) -> Outcome {
        const FAULTS: [Outcome; 4] = [
            Outcome::NotAcknowledged,
            Outcome::BusError,
            Outcome::ArbitrationLost,
            Outcome::TimedOut,
        ];
        let mut outcome = Outcome::Fresh;
        if self.seed != 0 && self.draw(9) == 0 {
            outcome = FAULTS[self.draw(4) as usize];
        }
        if self.seed != 0 {
            *now_ms = now_ms.wrapping_add(self.draw(3));
        }
        if self.traces {
            writeln!(out, "{what} {} {}", outcome as u8, upper(bytes)).unwrap();
        }
        outcome
    }

    fn holds(&self, entry: &Entry) -> bool {
        entry.trigger.is_empty() || entry.trigger == self.written
    }

    fn make(&mut self, step: Step<'_>, now_ms: &mut u32, out: &mut String) -> Outcome {
        match step {
            Step::Wait(_) => panic!("a wait is no transfer"),
            Step::Write(bytes) => {
                let outcome = self.fate("write", bytes, now_ms, out);
                assert!(!bytes.is_empty(), "nothing is written");
                if outcome == Outcome::Fresh {
                    self.written = bytes.to_vec();
                    if self.prints {
                        writeln!(out, "written {}", upper(bytes)).unwrap();
                    }
                }
                outcome
            }
            Step::WriteRead(sent, received) => {
                let outcome = self.fate("read", sent, now_ms, out);
                assert!(!received.is_empty(), "nothing is read");
                if outcome == Outcome::Fresh {
                    received.fill(FILL);
                    self.read(sent, received);
                }
                outcome
            }
            Step::Exchange(sent, received) => {
                let outcome = self.fate("exchange", sent, now_ms, out);
                assert_eq!(sent.len(), received.len());
                if outcome == Outcome::Fresh {
                    received.fill(FILL);
                    for entry in &self.entries {
                        if matches!(entry.kind, Kind::Exchange) && entry.trigger == sent {
                            fill(received, &entry.bytes);
                        }
                    }
                }
                outcome
            }
        }
    }

    fn read(&self, sent: &[u8], received: &mut [u8]) {
        if sent.is_empty() {
            let answers = self.entries.iter().filter(|entry| matches!(entry.kind, Kind::Answer));
            answers.filter(|entry| self.holds(entry)).for_each(|one| fill(received, &one.bytes));
            return;
        }
        assert_eq!(sent.len(), self.register_bytes, "the register has another size");
        assert_eq!(sent[0] & self.read_mask, self.read_mask, "the register is not for reading");
        let mut address = sent.to_vec();
        address[0] &= !self.read_mask;
        let at = address.iter().fold(0, |at, byte| at << 8 | u32::from(*byte));
        for entry in self.entries.iter().filter(|entry| self.holds(entry)) {
            let Kind::Register(first) = entry.kind else { continue };
            if self.alone && first != at {
                continue;
            }
            for (place, byte) in (first..).zip(&entry.bytes) {
                if let Some(free) = place.checked_sub(at) {
                    received.get_mut(free as usize).into_iter().for_each(|free| *free = *byte);
                }
            }
        }
    }
}

fn fill(to: &mut [u8], from: &[u8]) {
    to.iter_mut().zip(from).for_each(|(to, from)| *to = *from);
}

fn upper(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02X}")).collect()
}

fn unhex(text: &str) -> Vec<u8> {
    let digits = text.trim_matches('-');
    (0..digits.len())
        .step_by(2)
        .map(|at| u8::from_str_radix(&digits[at..at + 2], 16).unwrap())
        .collect()
}

/// The outcomes reported for each field, and their values after the filters.
struct Told<'a> {
    tables: &'a Tables,
    filters: Vec<Option<Filter<[u8; MEMORY_BYTES]>>>,
    results: Vec<Outcome>,
    values: Vec<Vec<u8>>,
    now_ms: u32,
}

impl<'a> Told<'a> {
    fn new(tables: &'a Tables) -> Self {
        let count = tables.schema.items.len();
        Self {
            tables,
            filters: tables.own.iter().map(|own| own.filter.map(Filter::new)).collect(),
            results: vec![Outcome::Nothing; count],
            values: vec![Vec::new(); count],
            now_ms: 0,
        }
    }

    fn trace(&self, index: usize, outcome: Outcome, value: &[u8], out: &mut String) {
        write!(out, "told {index} {}", outcome as u8).unwrap();
        let item = &self.tables.schema.items[index];
        for element in 0..usize::from(item.count) {
            if outcome == Outcome::Fresh {
                write!(out, " {:x}", item.scalar.load_at(value, element)).unwrap();
            }
        }
        out.push('\n');
    }

    fn record(
        &mut self,
        index: usize,
        outcome: Outcome,
        value: &mut [u8],
        traces: bool,
        out: &mut String,
    ) {
        let mut outcome = outcome;
        if traces {
            self.trace(index, outcome, value, out);
        }
        if let (Outcome::Fresh, Some(filter)) = (outcome, &mut self.filters[index]) {
            outcome = filter.apply(&self.tables.schema.items[index], self.now_ms, value);
            if traces {
                self.trace(index, outcome, value, out);
            }
        }
        if outcome == Outcome::Fresh {
            self.values[index] = value.to_vec();
        }
        if outcome != Outcome::Nothing {
            self.results[index] = outcome;
        }
    }
}

/// A run of one case.
struct Run<'a> {
    tables: &'a Tables,
    bus: Bus,
    chip: Option<Box<Chip<[u8; MEMORY_BYTES]>>>,
    stream: Option<Box<MessageStream<[u8; MEMORY_BYTES]>>>,
    reported: Told<'a>,
    bridges: Vec<BridgeState>,
    out: String,
}

/// The answer of the program to a request.
pub fn answer(units: &[(Unit, Tables)], request: &str) -> String {
    let mut words = request.split_whitespace();
    assert_eq!(words.next(), Some("unit"));
    let (_, tables) = &units[words.next().unwrap().parse::<usize>().unwrap()];
    let mut run = Run {
        tables,
        bus: Bus { register_bytes: 1, ..Bus::default() },
        chip: tables.chip.map(|table| Box::new(Chip::new(table, tables.schema))),
        stream: tables.message.map(|table| Box::new(MessageStream::new(table, tables.schema))),
        reported: Told::new(tables),
        bridges: vec![BridgeState::NEW; tables.schema.items.len()],
        out: String::new(),
    };
    if let Some(stream) = &mut run.stream {
        stream.gap();
    }
    while let Some(word) = words.next() {
        let mut ask = || words.next().unwrap();
        match word {
            "registers" => {
                run.bus.register_bytes = ask().parse().unwrap();
                run.bus.read_mask = ask().parse().unwrap();
                run.bus.alone = ask() != "0";
            }
            "register" => run.add(Kind::Register(ask().parse().unwrap()), "-", ask()),
            "after" => {
                let trigger = ask();
                run.add(Kind::Register(ask().parse().unwrap()), trigger, ask());
            }
            "answer" => run.add(Kind::Answer, ask(), ask()),
            "exchange" => run.add(Kind::Exchange, ask(), ask()),
            "run" => run.run(),
            "faults" => run.bus.seed = ask().parse().unwrap(),
            "steps" => run.steps(ask().parse().unwrap()),
            "trace" => run.bus.traces = ask() != "0",
            "later" => run.reported.now_ms += ask().parse::<u32>().unwrap(),
            "feed" => run.feed(&unhex(ask())),
            "asked" => run.asked(&unhex(ask()), &unhex(ask())),
            "raw" => run.raw(ask().parse().unwrap(), ask().parse().unwrap()),
            "frame" => run.frame(ask().parse().unwrap(), &unhex(ask())),
            "edges" => {
                let count: usize = ask().parse().unwrap();
                run.edges((0..count).map(|_| ask().parse().unwrap()).collect());
            }
            "command" => {
                let (index, count): (usize, usize) =
                    (ask().parse().unwrap(), ask().parse().unwrap());
                run.command(index, (0..count).map(|_| ask().parse().unwrap()).collect());
            }
            "end" => run.end(),
            other => panic!("{other}"),
        }
    }
    run.out
}

impl Run<'_> {
    fn add(&mut self, kind: Kind, trigger: &str, bytes: &str) {
        self.bus.entries.push(Entry { kind, trigger: unhex(trigger), bytes: unhex(bytes) });
    }

    /// One step of the chip; returns how long the chip then has nothing to do.
    fn step(&mut self) -> u32 {
        let Self { bus, chip, reported, out, .. } = self;
        let chip = chip.as_mut().unwrap();
        loop {
            let outcome = match chip.next(reported.now_ms) {
                Step::Wait(ms) => return ms,
                step => bus.make(step, &mut reported.now_ms, out),
            };
            let traces = bus.traces;
            let sink: &mut Sink<'_> =
                &mut |index, outcome, value| reported.record(index, outcome, value, traces, out);
            chip.done(outcome, sink);
        }
    }

    fn is_finished(&self) -> bool {
        let chip = self.chip.as_ref().unwrap();
        let lines = |item: u16| self.reported.results[usize::from(item)] != Outcome::Nothing;
        chip.table().readings.iter().all(|reading| lines(reading.item))
            && (chip.is_running() || chip.fault() != Outcome::Nothing)
    }

    fn run(&mut self) {
        let mut steps = 0;
        while !self.is_finished() {
            assert!(steps < STEPS_MAX, "it gives no end of it");
            let idle_ms = self.step();
            self.reported.now_ms += idle_ms.max(1);
            steps += 1;
        }
    }

    fn steps(&mut self, count: u32) {
        self.bus.traces = true;
        for _ in 0..count {
            let idle_ms = self.step();
            let chip = self.chip.as_ref().unwrap();
            let (now_ms, fault, seen) = (self.reported.now_ms, chip.fault(), chip.identity_seen());
            writeln!(self.out, "step {now_ms} {idle_ms} {} {seen}", fault as u8).unwrap();
            let cycle_ms = chip.table().cycle_ms;
            let is_other = self.bus.draw(3) == 0;
            let later_ms = if is_other { self.bus.draw(cycle_ms + 2) } else { idle_ms };
            self.reported.now_ms = self.reported.now_ms.wrapping_add(later_ms);
        }
        self.bus.traces = false;
    }

    fn feed(&mut self, bytes: &[u8]) {
        let Self { bus, stream, reported, out, .. } = self;
        let sink: &mut Sink<'_> =
            &mut |index, outcome, value| reported.record(index, outcome, value, bus.traces, out);
        stream.as_mut().unwrap().feed(bytes, sink);
    }

    fn asked(&mut self, request: &[u8], answer: &[u8]) {
        let mut all = self.tables.exchanges.iter();
        let exchange = *all.find(|one| one.request == request).expect("nobody sends that request");
        let mut stream: Box<MessageStream<[u8; MEMORY_BYTES]>> =
            Box::new(MessageStream::new(exchange.answer, self.tables.schema));
        let Self { bus, reported, out, .. } = self;
        let sink: &mut Sink<'_> =
            &mut |index, outcome, value| reported.record(index, outcome, value, bus.traces, out);
        exchange.begin(&mut stream);
        if exchange.take(&mut stream, answer, sink) == Heard::Waiting {
            exchange.fail(Outcome::TimedOut, sink);
        }
    }

    fn record(&mut self, index: usize, outcome: Outcome, value: &mut [u8]) {
        self.reported.record(index, outcome, value, self.bus.traces, &mut self.out);
    }

    fn empty(&self, index: usize) -> (Scalar, Vec<u8>) {
        let item = &self.tables.schema.items[index];
        (item.scalar, vec![0; item.bytes()])
    }

    fn raw(&mut self, index: usize, number: i64) {
        let (scalar, mut value) = self.empty(index);
        let mut outcome = Outcome::Fresh;
        let mut number = number;
        if let Some((formula, parameters, output)) = self.tables.own[index].formula {
            let [.., high, low] = number.to_be_bytes();
            let outputs = formula.compute(&[], parameters, &[high, low]);
            outcome = if outputs.is_some() { Outcome::Fresh } else { Outcome::Invalid };
            number = outputs.unwrap_or_default()[usize::from(output)];
        }
        store_signed(scalar, number, &mut value);
        self.record(index, outcome, &mut value);
    }

    fn frame(&mut self, index: usize, bytes: &[u8]) {
        let (_, mut value) = self.empty(index);
        let field = self.tables.own[index].can.unwrap();
        let item = &self.tables.schema.items[index];
        let outcome = field.value.decode(item, &bytes[usize::from(field.byte)..], &mut value);
        self.record(index, outcome, &mut value);
    }

    fn edges(&mut self, times_us: Vec<u32>) {
        let index = self.tables.own.iter().position(|own| own.train.is_some()).unwrap();
        let config = self.tables.own[index].train.unwrap();
        let (mut train, mut time_us, mut seen) = (Train::NEW, 0_u32, 0);
        for interval in times_us.iter().chain([&0]) {
            let ticks = u64::from(time_us) * u64::from(config.tick_hz) / 1_000_000;
            train.on_edge(&config, ticks as u32);
            time_us = time_us.wrapping_add(*interval);
        }
        let (_, mut value) = self.empty(index);
        let outcome = train.read(&config, &mut seen, &self.tables.schema.items[index], &mut value);
        self.record(index, outcome, &mut value);
    }

    fn command(&mut self, index: usize, numbers: Vec<i64>) {
        let (scalar, mut value) = self.empty(index);
        for (element, number) in value.chunks_mut(scalar.bytes()).zip(numbers) {
            if scalar == Scalar::Float32 {
                element.copy_from_slice(&(number as f32).to_be_bytes());
            } else {
                store_signed(scalar, number, element);
            }
        }
        if let Some(bridge) = self.tables.own[index].bridge {
            for write in bridge.drive(&mut self.bridges[index], scalar, &value).as_slice() {
                writeln!(self.out, "output {} {}", write.output, write.value).unwrap();
            }
            self.out.push_str("commanded\n");
            return;
        }
        if let Some(field) = self.tables.own[index].can {
            let mut data = [0; 8];
            let item = &self.tables.schema.items[index];
            let bytes = &mut data[usize::from(field.byte)..];
            assert!(field.value.encode(item, &value, bytes) > 0);
            writeln!(self.out, "frame {}", upper(&data)).unwrap();
            return;
        }
        if let Some(compose) = self.tables.own[index].compose {
            let item = &self.tables.schema.items[index];
            let mut message = vec![0; compose.bytes(item)];
            let size = compose.write(item, &value, &mut message);
            writeln!(self.out, "written {}", upper(&message[..size])).unwrap();
            return;
        }
        let table: &'static ChipTable = self.tables.chip.unwrap();
        let chip = self.chip.as_mut().unwrap();
        for command in table.commands.iter().filter(|one| usize::from(one.item) == index) {
            self.bus.prints = true;
            let written = match chip.write(command, &value) {
                Ok(step) => {
                    let outcome = self.bus.make(step, &mut self.reported.now_ms, &mut self.out);
                    chip.done(outcome, &mut |_, _, _| panic!("a command has no values"));
                    outcome
                }
                Err(outcome) => outcome,
            };
            if self.bus.seed == 0 {
                assert_eq!(written, Outcome::Fresh, "the command was not written");
            } else {
                writeln!(self.out, "came to {}", written as u8).unwrap();
            }
            self.bus.prints = false;
        }
    }

    fn end(&mut self) {
        let items = self.tables.schema.items.iter();
        for (index, (item, outcome)) in items.zip(&self.reported.results).enumerate() {
            let value = &self.reported.values[index];
            match outcome {
                Outcome::Nothing => {}
                Outcome::Fresh => {
                    write!(self.out, "value {index}").unwrap();
                    for element in 0..usize::from(item.count) {
                        let bits = item.scalar.load_at(value, element);
                        if item.scalar == Scalar::Float32 {
                            let number = f32::from_bits(bits as u32);
                            assert_eq!(number.fract(), 0.0, "a float with a fraction");
                            write!(self.out, " {number}").unwrap();
                        } else if item.scalar.is_signed() {
                            write!(self.out, " {}", item.scalar.extend(bits)).unwrap();
                        } else {
                            write!(self.out, " {bits}").unwrap();
                        }
                    }
                    self.out.push('\n');
                }
                Outcome::Invalid | Outcome::WrongCrc => {
                    writeln!(self.out, "invalid {index}").unwrap();
                }
                Outcome::NotAcknowledged
                | Outcome::BusError
                | Outcome::ArbitrationLost
                | Outcome::TimedOut
                | Outcome::WrongIdentity => writeln!(self.out, "error {index}").unwrap(),
            }
        }
        if let Some(stream) = self.stream.as_ref().filter(|_| self.bus.traces) {
            let counts = stream.counts();
            let (messages, dropped) = (counts.messages, counts.dropped_bytes);
            let (wrong, values, invalid) = (counts.wrong_checksum, counts.values, counts.invalid);
            writeln!(self.out, "stream {messages} {dropped} {wrong} {values} {invalid}").unwrap();
        }
        if let Some(chip) = &self.chip {
            let counts = chip.counts();
            if self.bus.seed != 0 {
                write!(self.out, "counts {} {}", counts.starts, counts.written).unwrap();
                counts.causes.iter().for_each(|count| write!(self.out, " {count}").unwrap());
                self.out.push('\n');
            }
            let is_wrong = counts.causes[Outcome::WrongIdentity as usize] > 0;
            writeln!(self.out, "identity {}", if is_wrong { "wrong" } else { "right" }).unwrap();
        }
        self.out.push_str("end\n");
    }
}

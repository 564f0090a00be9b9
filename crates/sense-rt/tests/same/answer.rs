//! The Rust runtime's answer to a question.

use std::fmt::Write as _;
use std::str::SplitWhitespace;

use sense_rt::{
    Bridge, BridgeMode, BridgeState, Capture, CaptureConfig, CaptureMode, Captured, Code, Coding,
    Compose, Contact, ContactConfig, ContactReport, Counter, Crc, Edge, Elements, FieldFormat,
    Filter, FilterTable, Item, MessageChecksum, MotorConfig, Number, Outcome, PulseWidth, Range,
    Scalar, Stepper, Turn, WIDE, decay, load_magnitude, parse_decimal, parse_degrees, parse_hex,
    pulse_level, store_count, store_signed, store_signed_ratio, store_unsigned,
};

use super::link::Link;

/// The scalars, in the order of the C code.
pub(crate) const SCALARS: [Scalar; 11] = {
    use Scalar::{
        Bool, Float32, Float64, Int8, Int16, Int32, Int64, Uint8, Uint16, Uint32, Uint64,
    };
    [Bool, Uint8, Int8, Uint16, Int16, Uint32, Int32, Uint64, Int64, Float32, Float64]
};

/// The words of a question.
pub(crate) struct Words<'a>(SplitWhitespace<'a>);

impl<'a> Words<'a> {
    pub(crate) fn word(&mut self) -> &'a str {
        self.0.next().unwrap()
    }

    pub(crate) fn number(&mut self) -> u64 {
        self.word().parse().unwrap()
    }

    pub(crate) fn small(&mut self) -> u32 {
        u32::try_from(self.number()).unwrap()
    }

    pub(crate) fn flag(&mut self) -> bool {
        self.number() != 0
    }

    fn byte(&mut self) -> u8 {
        u8::try_from(self.number()).unwrap()
    }

    fn bits(&mut self) -> u64 {
        u64::from_str_radix(self.word(), 16).unwrap()
    }

    pub(crate) fn bytes(&mut self) -> Vec<u8> {
        let digits = self.word().trim_matches('-');
        let byte = |at: usize| u8::from_str_radix(&digits[at..at + 2], 16).unwrap();
        (0..digits.len()).step_by(2).map(byte).collect()
    }

    fn scalar(&mut self) -> Scalar {
        SCALARS[self.number() as usize]
    }

    fn item(&mut self) -> Item {
        Item::sensor(1, self.scalar(), self.number() as u16)
    }

    fn value(&mut self, item: &Item) -> Vec<u8> {
        let mut value = vec![0; item.bytes()];
        for index in 0..usize::from(item.count) {
            item.scalar.store_at(self.bits(), &mut value, index);
        }
        value
    }

    fn element(&mut self, scalar: Scalar) -> Vec<u8> {
        self.value(&Item::sensor(1, scalar, 1))
    }

    fn coding(&mut self) -> Coding {
        Coding {
            elements: self.bytes().leak(),
            words: self.number() as u16,
            code: CODES[self.number() as usize],
            crc: [Crc::None, Crc::Sensirion][self.number() as usize],
            word_bytes: self.byte(),
            low: self.byte(),
            bits: self.byte(),
            is_signed: self.flag(),
            is_little_endian: self.flag(),
        }
    }
}

/// In the order of C's numbers.
const CODES: [Code; 8] = [
    Code::Integer,
    Code::Float,
    Code::Bcd,
    Code::Packed,
    Code::Magnitude,
    Code::Pulses,
    Code::Leds,
    Code::Text,
];

fn say_value(out: &mut String, scalar: Scalar, value: &[u8]) {
    for element in value.chunks(scalar.bytes()) {
        write!(out, " {:x}", scalar.load(element)).unwrap();
    }
}

pub(crate) fn say_bytes(out: &mut String, bytes: &[u8]) {
    bytes.iter().for_each(|byte| write!(out, "{byte:02x}").unwrap());
}

const MOTOR: MotorConfig =
    MotorConfig { tick_hz: 1, speed: 1, acceleration: 1, is_velocity: false };

/// The state that is kept from question to question.
pub(crate) struct Desk {
    item: Item,
    filter: Box<Filter<[u8; 4096]>>,
    capture: (CaptureConfig, Captured, Capture),
    contact: (ContactConfig, Contact, ContactReport),
    bridge: (Bridge, BridgeState),
    counter: Counter,
    turn: Turn,
    elements: Elements,
    motor: (MotorConfig, Stepper),
    link: Link,
}

impl Default for Desk {
    fn default() -> Self {
        let capture = CaptureConfig { mode: CaptureMode::Count, tick_hz: 1, silent_ms: 1 };
        let contact = ContactConfig { lasting: 0, edge: Edge::Both };
        Self {
            item: Item::sensor(1, Scalar::Bool, 1),
            filter: Box::new(Filter::new(&FilterTable::NEW)),
            capture: (capture, Captured::NEW, Capture::NEW),
            contact: (contact, Contact::NEW, ContactReport::NEW),
            bridge: (Bridge { mode: BridgeMode::TwoPwm, full: 0 }, BridgeState::NEW),
            counter: Counter::NEW,
            turn: Turn::NEW,
            elements: Elements::NEW,
            motor: (MOTOR, Stepper::NEW),
            link: Link::default(),
        }
    }
}

impl Desk {
    pub(crate) fn answer(&mut self, question: &str) -> String {
        let mut words = Words(question.split_whitespace());
        let word = words.word();
        let mut out = word.to_owned();
        match word {
            "ratio" => ratio(&mut words, &mut out),
            "store" => stored(&mut words, &mut out),
            "magnitude" => magnitude(&mut words, &mut out),
            "decode" => decode(&mut words, &mut out),
            "encode" => encode(&mut words, &mut out),
            "compose" => compose(&mut words, &mut out),
            "parse" => parse(&mut words, &mut out),
            "formula" => formula(&mut words, &mut out),
            "decay" => write!(out, " {}", decay(words.small(), words.small())).unwrap(),
            "filter" => self.begin_filter(&mut words),
            "apply" => self.apply(&mut words, &mut out),
            "capture" => self.begin_capture(&mut words),
            "captured" => self.captured(&mut words, &mut out),
            "contact" => {
                let edges = [Edge::Rising, Edge::Falling, Edge::Both];
                let lasting = words.small();
                let config = ContactConfig { lasting, edge: edges[words.number() as usize] };
                self.contact = (config, Contact::NEW, ContactReport::NEW);
            }
            "see" => self.see(&mut words, &mut out),
            "bridge" => {
                use BridgeMode::{DirectionPin, DirectionPins, TwoPwm};
                let mode = [DirectionPins, TwoPwm, DirectionPin][words.number() as usize];
                self.bridge = (Bridge { mode, full: words.small() }, BridgeState::NEW);
            }
            "drive" => {
                let scalar = words.scalar();
                let element = words.element(scalar);
                let (bridge, state) = &mut self.bridge;
                for write in bridge.drive(state, scalar, &element).as_slice() {
                    write!(out, " {}={}", write.output, write.value).unwrap();
                }
            }
            "count" => {
                self.counter.step(words.number() as u16);
                write!(out, " {}", self.counter.total()).unwrap();
            }
            "turn" => {
                let is_next = self.turn.is_next(words.small(), words.small());
                write!(out, " {}", u8::from(is_next)).unwrap();
            }
            "element" => {
                self.elements.note(words.number() as usize);
                write!(out, " {}", u8::from(self.elements.are_due(8, words.flag()))).unwrap();
            }
            "motor" | "target" | "halt" | "advance" => self.motor(word, &mut words, &mut out),
            _ => self.link.answer(word, &mut words, &mut out),
        }
        out
    }

    fn motor(&mut self, word: &str, words: &mut Words<'_>, out: &mut String) {
        let (config, stepper) = &mut self.motor;
        match word {
            "motor" => {
                *config = MotorConfig {
                    tick_hz: words.small(),
                    speed: words.small(),
                    acceleration: words.small(),
                    is_velocity: words.flag(),
                };
                *stepper = Stepper::NEW;
            }
            "target" => {
                let scalar = words.scalar();
                stepper.command(config, scalar, &words.element(scalar));
            }
            "halt" => stepper.stop(),
            _ => {
                let ticks = stepper.advance(config);
                let (step, back) = (stepper.is_step(), stepper.is_backward());
                let (step, back) = (u8::from(step), u8::from(back));
                write!(out, " {ticks} {step} {back} {}", stepper.position()).unwrap();
            }
        }
    }

    fn begin_filter(&mut self, words: &mut Words<'_>) {
        self.item = words.item();
        let scalar = self.item.scalar;
        let number = |bits: u64| {
            if scalar == Scalar::Float32 {
                Number::float32(f32::from_bits(bits as u32))
            } else if scalar == Scalar::Float64 {
                Number::float64(f64::from_bits(bits))
            } else {
                Number::unsigned(bits)
            }
        };
        let wide = words.flag().then_some(WIDE);
        let (median, smooth_ms) = (words.number() as u8, words.small());
        let (has_change, change) = (words.flag(), number(words.bits()));
        let heartbeat_ms = words.small();
        let ranges = (0..words.number())
            .map(|_| Range { low: number(words.bits()), high: number(words.bits()) });
        let invalid = ranges.collect::<Vec<_>>().leak();
        let change = has_change.then_some(change);
        let table = FilterTable { invalid, wide, median, smooth_ms, change, heartbeat_ms };
        assert!(table.bytes(&self.item) <= 4096);
        *self.filter = Filter::new(Box::leak(Box::new(table)));
    }

    fn apply(&mut self, words: &mut Words<'_>, out: &mut String) {
        let now_ms = words.small();
        let mut value = words.value(&self.item);
        let outcome = self.filter.apply(&self.item, now_ms, &mut value);
        write!(out, " {}", outcome as u8).unwrap();
        say_value(out, self.item.scalar, &value);
    }

    fn begin_capture(&mut self, words: &mut Words<'_>) {
        use CaptureMode::{Count, Duty, Frequency, Period, Width};
        let mode = [Count, Width, Period, Frequency, Duty][words.number() as usize];
        let config = CaptureConfig { mode, tick_hz: words.small(), silent_ms: words.small() };
        self.capture = (config, Captured::NEW, Capture::NEW);
    }

    fn captured(&mut self, words: &mut Words<'_>, out: &mut String) {
        let (config, raw, capture) = &mut self.capture;
        let (what, ticks, now_ms) = (words.number(), words.small(), words.small());
        let (scalar, first) = (words.scalar(), words.flag());
        match what {
            0 | 1 => raw.on_width(ticks, what == 1),
            2 => raw.on_period(ticks),
            _ => {}
        }
        let mut element = vec![0; scalar.bytes()];
        let is_new = capture.read(config, raw, first, now_ms, scalar, &mut element);
        write!(out, " {}", u8::from(is_new)).unwrap();
        say_value(out, scalar, &element);
    }

    fn see(&mut self, words: &mut Words<'_>, out: &mut String) {
        let (config, contact, reported) = &mut self.contact;
        let (what, level, now) = (words.number(), words.flag(), words.small());
        match what {
            0 => contact.on_edge(config, level, now),
            1 => contact.look(config, level, now),
            2 => contact.sample(config, level, now),
            _ => {
                if let Some(level) = reported.record(config, contact) {
                    write!(out, " {}", u8::from(level)).unwrap();
                }
            }
        }
        write!(out, " {}", contact.edges()).unwrap();
    }
}

fn ratio(words: &mut Words<'_>, out: &mut String) {
    let (scalar, is_negative) = (words.scalar(), words.flag());
    let mut element = vec![0; scalar.bytes()];
    store_signed_ratio(scalar, is_negative, words.number(), words.number(), &mut element);
    say_value(out, scalar, &element);
}

fn stored(words: &mut Words<'_>, out: &mut String) {
    let (scalar, bits) = (words.scalar(), words.bits());
    let mut element = vec![0; scalar.bytes()];
    store_unsigned(scalar, bits, &mut element);
    say_value(out, scalar, &element);
    store_signed(scalar, bits.cast_signed(), &mut element);
    say_value(out, scalar, &element);
    store_count(scalar, bits.cast_signed(), &mut element);
    say_value(out, scalar, &element);
}

fn magnitude(words: &mut Words<'_>, out: &mut String) {
    let scalar = words.scalar();
    let (least_ticks, greatest_ticks) = (words.number() as u16, words.number() as u16);
    let element = words.element(scalar);
    let (magnitude, is_negative) = load_magnitude(scalar, &element);
    let width = PulseWidth { least_ticks, greatest_ticks };
    let ticks = width.ticks(pulse_level(scalar, &element));
    write!(out, " {magnitude} {} {ticks}", u8::from(is_negative)).unwrap();
}

fn decode(words: &mut Words<'_>, out: &mut String) {
    let (item, coding, bytes) = (words.item(), words.coding(), words.bytes());
    let mut value = vec![0; item.bytes()];
    let outcome = coding.decode(&item, &bytes, &mut value);
    write!(out, " {}", outcome as u8).unwrap();
    if outcome == Outcome::Fresh {
        say_value(out, item.scalar, &value);
    }
}

fn encode(words: &mut Words<'_>, out: &mut String) {
    let (item, coding) = (words.item(), words.coding());
    let value = words.value(&item);
    let mut bytes = [0xEE; 512];
    let size = coding.encode(&item, &value, &mut bytes);
    out.push(' ');
    say_bytes(out, &bytes[..size]);
}

fn compose(words: &mut Words<'_>, out: &mut String) {
    let (item, value) = (words.item(), words.coding());
    let (start, behind) = (words.bytes().leak(), words.bytes().leak());
    let end = words.bytes().leak();
    let formats =
        [FieldFormat::Binary, FieldFormat::Decimal, FieldFormat::Degrees, FieldFormat::Hex];
    let format = formats[words.number() as usize];
    let (separator, decimals) = (words.byte(), words.byte());
    use MessageChecksum::{
        Crc8DvbS2, Crc8Ld06, Crc16Umts, Crc16Xmodem, Ibus, NegSum8, NegSum16, Nmea,
    };
    use MessageChecksum::{NotSum8, Slamtec, Sum7, Sum8, Sum16, Xor8};
    let first = [MessageChecksum::None, Sum8, Xor8, Ibus, Crc8DvbS2, Nmea];
    let second = [Sum7, NotSum8, NegSum8, NegSum16, Crc16Umts, Crc16Xmodem];
    let all = [&first[..], &second, &[Crc8Ld06, Sum16, Slamtec]].concat();
    let checksum = all[words.number() as usize];
    let checksum_from = words.byte();
    let compose =
        Compose { start, behind, end, format, value, separator, decimals, checksum, checksum_from };
    let value = words.value(&item);
    let mut message = vec![0xEE; compose.bytes(&item)];
    let size = compose.write(&item, &value, &mut message);
    assert!(size == 0 || size == message.len() || format != FieldFormat::Binary);
    out.push(' ');
    say_bytes(out, &message[..size]);
}

fn parse(words: &mut Words<'_>, out: &mut String) {
    let (how, scalar, decimals) = (words.number(), words.scalar(), words.byte());
    let (text, hemisphere) = (words.bytes(), words.bytes());
    let mut element = vec![0; scalar.bytes()];
    let outcome = match how {
        0 => parse_decimal(&text, decimals, scalar, &mut element),
        1 => parse_degrees(&text, &hemisphere, scalar, &mut element),
        _ => parse_hex(&text, scalar, &mut element),
    };
    write!(out, " {}", outcome as u8).unwrap();
    say_value(out, scalar, &element);
}

fn formula(words: &mut Words<'_>, out: &mut String) {
    let all =
        [sense_rt::BMP280, sense_rt::BME280, sense_rt::NTC, sense_rt::TSL2561, sense_rt::HX711];
    let formula = all[words.number() as usize];
    let parameters = [(); 3].map(|()| words.small().cast_signed());
    let (calibration, raw) = (words.bytes(), words.bytes());
    match formula.compute(&calibration, &parameters, &raw) {
        None => out.push_str(" none"),
        Some(outputs) => {
            let outputs = &outputs[..usize::from(formula.outputs_count)];
            outputs.iter().for_each(|output| write!(out, " {output}").unwrap());
        }
    }
}

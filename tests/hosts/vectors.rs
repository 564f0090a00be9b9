//! Runs wire vectors through the decoder and encoder of the Rust host: what `vectors.cpp` does for C++.
//!
//! Arguments: the number of the board, then an item each: `ID,TYPE`. A stream is decoded at once, byte by byte, as given
//! and cut at each place; `differs` says that two did not agree.

use std::fmt;
use std::io::BufRead as _;

use sense_robot::*;

/// Prints a raw value alone.
struct Bare<M>(M);

impl<M: AnyMessage> fmt::Display for Bare<M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.print_raw(f)
    }
}

fn health_words<S: Schema>(health: HealthFrame<'_, S>) -> String {
    let board = health.board();
    let (load, stack) = (board.load_percent.unwrap_or(255), board.stack_left_bytes.unwrap_or(65535));
    let mut words = format!(
        "got health {} {} {} {} {} {load} {stack}",
        board.uptime_ms,
        board.reset_cause.code(),
        board.reset_device,
        board.reports_sent,
        board.reports_refused,
    );
    for device in health.devices() {
        let age = device.age_ms.unwrap_or(u32::MAX);
        words.push_str(&format!(" {}={}/{age}", device.id, device.status.code()));
        device.failures.iter().for_each(|count| words.push_str(&format!("/{count}")));
    }
    words + "\n"
}

fn decode<S: Schema, const SENSORS: bool>(pieces: &[&[u8]]) -> String {
    let (mut decoder, mut text) = (Decoder::<S, SENSORS>::new(), String::new());
    for piece in pieces {
        decoder.feed(piece, |found| match found {
            Found::Hello(hash) => text.push_str(&format!("got hello 0x{hash:08x}\n")),
            Found::HelloRequest => text.push_str("got hello-request\n"),
            Found::HealthRequest => text.push_str("got health-request\n"),
            Found::OtherHealth(version) => text.push_str(&format!("got health-version {version}\n")),
            Found::Health(health) => text.push_str(&health_words(health)),
            Found::Report(report) => {
                text.push_str("got");
                if let Some(stamp) = report.stamp {
                    text.push_str(&format!(" stamp={}/{}", stamp.time_us, stamp.counter));
                }
                for message in report.messages() {
                    let raw = Bare(message).to_string().replace(['[', ']', ' '], "");
                    text.push_str(&format!(" {}={raw}", message.facts().id));
                }
                text.push('\n');
            }
        });
    }
    format!("{text}dropped {}\n", decoder.dropped_bytes())
}

fn decoded<S: Schema, const SENSORS: bool>(pieces: &[Vec<u8>]) -> String {
    let whole = pieces.concat();
    let text = decode::<S, SENSORS>(&[&whole]);
    let pieces: Vec<&[u8]> = pieces.iter().map(Vec::as_slice).collect();
    let mut is_same = decode::<S, SENSORS>(&pieces) == text;
    is_same &= decode::<S, SENSORS>(&whole.chunks(1).collect::<Vec<_>>()) == text;
    for at in 0..=whole.len() {
        let (one, other) = whole.split_at(at);
        is_same &= decode::<S, SENSORS>(&[one, other]) == text;
    }
    if is_same { text } else { format!("differs\n{text}") }
}

fn from_hex(word: &str) -> Vec<u8> {
    (0..word.len()).step_by(2).map(|at| u8::from_str_radix(&word[at..at + 2], 16).unwrap()).collect()
}

fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

fn scalar(kind: &str, text: &str) -> Vec<u8> {
    match kind {
        "bool" => vec![u8::from(text == "true" || text == "1")],
        "uint8" => text.parse::<u8>().unwrap().to_be_bytes().into(),
        "int8" => text.parse::<i8>().unwrap().to_be_bytes().into(),
        "uint16" => text.parse::<u16>().unwrap().to_be_bytes().into(),
        "int16" => text.parse::<i16>().unwrap().to_be_bytes().into(),
        "uint32" => text.parse::<u32>().unwrap().to_be_bytes().into(),
        "int32" => text.parse::<i32>().unwrap().to_be_bytes().into(),
        "uint64" => text.parse::<u64>().unwrap().to_be_bytes().into(),
        "int64" => text.parse::<i64>().unwrap().to_be_bytes().into(),
        "float32" => text.parse::<f32>().unwrap().to_be_bytes().into(),
        "float64" => text.parse::<f64>().unwrap().to_be_bytes().into(),
        other => panic!("what is {other}?"),
    }
}

fn encoded<S: Schema>(kinds: &[String], way: &str, words: &[&str]) -> String {
    let (mut stamp, mut messages) = (Stamp { time_us: 0, counter: 0 }, Vec::new());
    for word in words {
        let (key, list) = word.split_once('=').unwrap();
        if key == "stamp" {
            let (time, counter) = list.split_once('/').unwrap();
            stamp = Stamp { time_us: time.parse().unwrap(), counter: counter.parse().unwrap() };
            continue;
        }
        let kind = kinds.iter().find_map(|kind| kind.strip_prefix(&format!("{key},"))).unwrap();
        let bytes: Vec<u8> = list.split(',').flat_map(|text| scalar(kind, text)).collect();
        messages.push(S::read(key.parse().unwrap(), &bytes).unwrap());
    }
    let mut memory = [0; 4096];
    let frame = if way == "sensors" {
        encode_report::<S>(stamp, &messages, &mut memory)
    } else {
        encode::<S>(&messages, &mut memory)
    };
    format!("frame {}\n", hex(frame.unwrap()))
}

fn serve<S: Schema>(kinds: &[String]) {
    for line in std::io::stdin().lock().lines() {
        let line = line.unwrap();
        let words: Vec<&str> = line.split(' ').collect();
        let answer = match words[..] {
            ["hash"] => {
                let mut memory = [0; 32];
                let hello = hex(encode_hello::<S>(&mut memory).unwrap());
                let [who, how] = [false, true].map(|health| hex(question(S::CHECKSUM, health).as_ref()));
                format!("hello {hello}\nhello-request {who}\nhealth-request {how}\n")
            }
            ["decode", way, ref pieces @ ..] => {
                let pieces: Vec<Vec<u8>> = pieces.iter().map(|word| from_hex(word)).collect();
                if way == "sensors" { decoded::<S, true>(&pieces) } else { decoded::<S, false>(&pieces) }
            }
            ["encode", way, ref values @ ..] => encoded::<S>(kinds, way, values),
            _ => panic!("what is {line}?"),
        };
        print!("{answer}end\n");
    }
}

fn main() {
    let mut arguments = std::env::args().skip(1);
    let number = arguments.next().unwrap();
    let kinds: Vec<String> = arguments.collect();
    BOARDS!(number, kinds);
}

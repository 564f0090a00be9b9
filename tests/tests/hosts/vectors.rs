//! The shared wire vectors through the decoder and encoder of the C++ hosts, and random streams
//! compared with the reference decoder.

use std::path::{Path, PathBuf};
use std::process::Command;

use sensedsl_wire::{
    Checksum, Decoder, Direction, Event, Health, ScalarType, Schema, Stamp, encode_health_request,
    encode_hello, encode_hello_request,
};

use sensedsl_tests::{answered, few, has, is_exhaustive, is_thorough};

use super::designs::{board, item};
use super::files as folders;

/// The requests to the C++ program, and the expected answers.
#[derive(Default)]
pub(super) struct Exchange {
    asked: String,
    expected: String,
    cases: usize,
}

impl Exchange {
    /// What is asked, a line each.
    pub(super) fn asked(&self) -> &str {
        &self.asked
    }

    /// What a right program answers.
    pub(super) fn expected(&self) -> &str {
        &self.expected
    }

    /// Those with other commands than one that a program does not have, in its first words.
    pub(super) fn without(&self, command: &str) -> Self {
        let mut kept = Self::default();
        for (asked, expected) in self.asked.lines().zip(self.expected.split_inclusive("end\n")) {
            if !format!("{asked} ").starts_with(&format!("{command} ")) {
                kept.asked.push_str(&format!("{asked}\n"));
                kept.expected.push_str(expected);
                kept.cases += 1;
            }
        }
        kept
    }

    fn ask(&mut self, command: &str, answer: &str) {
        self.asked.push_str(&format!("{command}\n"));
        self.expected.push_str(&format!("{answer}end\n"));
        self.cases += 1;
    }
}

fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// Turns a vector file into one exchange and the schema that it needs. All numbers stay text.
pub(super) fn read(path: &Path) -> (Schema, Exchange) {
    let text = std::fs::read_to_string(path).unwrap();
    let mut schema = Schema::default();
    let mut exchange = Exchange::default();
    let (mut command, mut answer) = (String::new(), String::new());
    for line in text.lines() {
        let (word, rest) = line.split_once(' ').unwrap_or((line, ""));
        match word {
            "" | "#" | "schema" => {}
            "checksum" => {
                schema.checksum = Checksum::of_name(rest).expect("a checksum");
            }
            "item" => schema.items.push(item(rest)),
            "hash" => {
                assert_eq!(format!("0x{:08x}", schema.hash()), rest);
                let frames = [encode_hello, encode_hello_request, encode_health_request];
                let [hello, request, health] = frames.map(|encode| hex(&encode(&schema)));
                let answer =
                    format!("hello {hello}\nhello-request {request}\nhealth-request {health}\n");
                exchange.ask("hash", &answer);
            }
            "encode" | "decode" => (command, answer) = (format!("{word} sensors"), String::new()),
            "encode-actuators" => (command, answer) = ("encode actuators".into(), String::new()),
            "decode-actuators" => (command, answer) = ("decode actuators".into(), String::new()),
            "encode-health" => (command, answer) = (word.into(), String::new()),
            "stamp" if rest == "on" => schema.stamp = true,
            "stamp" => command.push_str(&format!(" stamp={}", rest.replace(' ', "/"))),
            "board" => command.push_str(&format!(" {rest}")),
            "device" => {
                let (id, numbers) = rest.split_once(' ').unwrap();
                command.push_str(&format!(" {id}={}", numbers.replace(' ', "/")));
            }
            "value" => {
                let (id, scalars) = rest.split_once(' ').unwrap();
                command.push_str(&format!(" {id}={}", scalars.replace(' ', ",")));
            }
            "in" => command.push_str(&format!(" {rest}")),
            "got" => answer.push_str(&format!("{line}\n")),
            "frame" | "dropped" => exchange.ask(&command, &format!("{answer}{line}\n")),
            other => panic!("{}: what is {other}?", path.display()),
        }
    }
    (schema, exchange)
}

/// Compiles the driver program for a schema and compares its answer with the exchange.
fn run(compiler: &[&str], name: &str, schema: &Schema, exchange: &Exchange) {
    assert_eq!(answer(compiler, name, schema, exchange), exchange.expected, "{name} {compiler:?}");
}

/// Compiles the driver program for a schema and returns its answer.
fn answer(compiler: &[&str], name: &str, schema: &Schema, exchange: &Exchange) -> String {
    let mut vectors = board("Vectors", schema.checksum, "");
    vectors.schema = schema.clone();
    let folder = folders::generate("cpp", &format!("vectors-{name}-{}", compiler[0]), &[vectors]);
    let mut items = String::from("#define ITEMS(X)");
    for item in &schema.items {
        let cpp_type = match item.value.scalar.name() {
            "bool" => "bool".to_owned(),
            "float32" => "float".to_owned(),
            "float64" => "double".to_owned(),
            integer => format!("{integer}_t"),
        };
        items.push_str(&format!(" X({}, {cpp_type}, {})", item.id, item.value.count()));
    }
    std::fs::write(folder.join("include/items.h"), items + "\n").unwrap();
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("hosts/vectors.cpp");
    let program = folder.join("vectors");
    sensedsl_tests::run(
        Command::new(compiler[0])
            .args(&compiler[1..])
            .args(["-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wshadow", "-Werror", "-g"])
            .arg(format!("-I{}", folder.join("include").display()))
            .arg(source)
            .arg("-o")
            .arg(&program),
    );
    answered(&mut Command::new(&program), exchange.asked.as_str())
}

/// The answer with each real value in a common form, because the languages print them
/// differently.
pub(super) fn with_reals_alike(schema: &Schema, answer: &str) -> String {
    let bytes = |id: &str| {
        let mut items = schema.items.iter().filter(|item| item.id.to_string() == id);
        items.find_map(|item| match item.value.scalar {
            ScalarType::Float32 => Some(4),
            ScalarType::Float64 => Some(8),
            _ => None,
        })
    };
    let alike = |word: &str| {
        let Some((id, list)) = word.split_once('=') else { return word.to_owned() };
        let Some(bytes) = bytes(id) else { return word.to_owned() };
        let values = list.split(',').map(|one| match bytes {
            4 => format!("{:?}", one.trim_end().parse::<f32>().unwrap()),
            _ => format!("{:?}", one.trim_end().parse::<f64>().unwrap()),
        });
        format!("{id}={:?}{}", values.collect::<Vec<_>>(), &list[list.trim_end().len()..])
    };
    answer.split_inclusive([' ', '\n']).map(alike).collect()
}

/// All vector files of the wire.
pub(super) fn files() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("vectors");
    let mut files: Vec<PathBuf> =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|file| file.extension().is_some_and(|extension| extension == "txt"));
    files.sort();
    assert!(files.len() >= 10, "{files:?}");
    files
}

/// The oldest and the newest C++ for which hosts are written, and the sanitizers.
const COMPILERS: [&[&str]; 3] = [
    &["g++", "-std=c++98", "-fsanitize=address,undefined", "-fno-sanitize-recover=all"],
    &["g++", "-std=c++17", "-O2"],
    &["clang++", "-std=c++14", "-O1"],
];

#[test]
fn shared_vectors_cut_at_every_place() {
    let compilers = if is_exhaustive() { &COMPILERS[..] } else { &COMPILERS[..1] };
    for compiler in compilers {
        if !has(compiler[0]) {
            continue;
        }
        for path in few(&files(), 1) {
            let (schema, exchange) = read(path);
            assert!(exchange.cases > 5, "{}: {} cases", path.display(), exchange.cases);
            run(compiler, path.file_stem().unwrap().to_str().unwrap(), &schema, &exchange);
        }
    }
}

/// The reference decoder's reading of a stream, in the words of a vector file.
fn reference(schema: &Schema, stream: &[u8]) -> String {
    let mut answer = String::new();
    let mut decoder = Decoder::new(schema, Direction::Sensor);
    decoder.feed(stream, |event| match event {
        Event::Hello(hash) => answer.push_str(&format!("got hello 0x{hash:08x}\n")),
        Event::HelloRequest => answer.push_str("got hello-request\n"),
        Event::HealthRequest => answer.push_str("got health-request\n"),
        Event::OtherHealth(version) => answer.push_str(&format!("got health-version {version}\n")),
        Event::Health(health) => answer.push_str(&format!("got health{}\n", health_words(&health))),
        Event::Report(stamp, values) => {
            answer.push_str("got");
            if let Some(Stamp { time_us, counter }) = stamp {
                answer.push_str(&format!(" stamp={time_us}/{counter}"));
            }
            for (id, scalars) in values {
                let texts: Vec<String> = scalars.iter().map(ToString::to_string).collect();
                answer.push_str(&format!(" {id}={}", texts.join(",")));
            }
            answer.push('\n');
        }
    });
    answer.push_str(&format!("dropped {}\n", decoder.dropped_bytes()));
    answer
}

/// Health in the words of a vector file.
fn health_words(health: &Health) -> String {
    let Health { uptime_ms, reset_device, reports_sent, reports_refused, .. } = health;
    let (cause, load, stack) =
        (health.reset_cause.code(), health.load_percent, health.stack_left_bytes);
    let mut words = format!(
        " {uptime_ms} {cause} {reset_device} {reports_sent} {reports_refused} {load} {stack}"
    );
    for device in &health.devices {
        words.push_str(&format!(" {}={}/{}", device.id, device.status.code(), device.age_ms));
        words.extend(device.causes.counts().map(|count| format!("/{count}")));
    }
    words
}

/// Pseudorandom numbers that are the same in each run.
pub(super) struct Numbers(u64);

impl Numbers {
    /// A sequence of its own for each seed.
    pub(super) fn new(seed: u64) -> Self {
        Self(seed)
    }

    fn below(&mut self, bound: usize) -> usize {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        usize::try_from(self.0 >> 33).unwrap() % bound
    }
}

/// Complete frames among bytes that look like them. The bytes come from the vectors' frames by
/// dropping, doubling and changing some, so that most of the stream is nearly right.
fn damaged(numbers: &mut Numbers, frames: &[Vec<u8>]) -> Vec<u8> {
    const LIKELY: &[u8] = b"0123456789:,\x00\x11\x12\x13\x14\xff";
    let mut stream = Vec::new();
    for _ in 0..1 + numbers.below(5) {
        let mut frame = frames[numbers.below(frames.len())].clone();
        for _ in 0..numbers.below(3) {
            let at = numbers.below(frame.len());
            match numbers.below(4) {
                0 => frame[at] = LIKELY[numbers.below(LIKELY.len())],
                1 => frame.insert(at, LIKELY[numbers.below(LIKELY.len())]),
                2 if frame.len() > 1 => drop(frame.remove(at)),
                _ => frame.truncate(at.max(1)),
            }
        }
        stream.extend(frame);
    }
    stream
}

/// The vector files whose frames are damaged.
pub(super) const DAMAGED: [&str; 9] = [
    "arrays_crc32",
    "stamp_checksum",
    "health",
    "fig2",
    "checksum",
    "crc32",
    "arrays",
    "arrays_checksum",
    "stamp",
];

/// Damaged frames of a vector file, and how the reference reads them.
pub(super) fn damage(name: &str, numbers: &mut Numbers, count: usize) -> (Schema, Exchange) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("vectors/{name}.txt"));
    let (schema, vectors) = read(&path);
    let frames: Vec<Vec<u8>> = vectors
        .expected
        .lines()
        .filter_map(|line| line.strip_prefix("frame ").or_else(|| line.strip_prefix("hello ")))
        .map(|digits| {
            let at = (0..digits.len()).step_by(2);
            at.map(|at| u8::from_str_radix(&digits[at..at + 2], 16).unwrap()).collect()
        })
        .collect();
    let mut exchange = Exchange::default();
    for _ in 0..count {
        let stream = damaged(numbers, &frames);
        exchange.ask(&format!("decode sensors {}", hex(&stream)), &reference(&schema, &stream));
    }
    (schema, exchange)
}

#[test]
fn damaged_streams_are_read_as_by_the_reference() {
    if !is_thorough() || !has("g++") {
        return;
    }
    for name in few(&DAMAGED, 1) {
        let (schema, exchange) = damage(name, &mut Numbers::new(2014), 2000);
        let compiler = ["g++", "-std=c++17", "-O0"];
        let found = answer(&compiler, &format!("damaged-{name}"), &schema, &exchange);
        let alike = |answer| with_reals_alike(&schema, answer);
        assert_eq!(alike(&found), alike(&exchange.expected), "{name}");
    }
}

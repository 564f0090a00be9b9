//! The decoders in C and C++ as a program, and the decoder in Rust. All answer in the same bytes,
//! which `tests/decoders/decoders.h` defines.

use std::io::{BufRead as _, BufReader, Read as _, Write as _};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdout, Command, Stdio};

use sensedsl_tests::{compiled_once, root, run};
use sensedsl_wire::{
    Checksum, Decoder, Direction, Frame, HealthFrame, ID_HEALTH, ScalarType, Schema, encode_health,
};

/// The answer of a decoder.
#[derive(Default)]
pub(crate) struct Answer(Vec<u8>);

impl Answer {
    /// Adds a frame, given its payload without the checksum.
    pub(crate) fn frame(&mut self, payload: &[u8]) {
        match payload {
            [0] => self.0.push(b'Q'),
            [0, _] => self.0.push(b'A'),
            [0, hash @ ..] if hash.len() == 4 => {
                self.0.push(b'H');
                self.0.extend(hash);
            }
            [ID_HEALTH, version, ..] if *version != 1 => self.0.extend([b'V', *version]),
            whole => {
                self.0.push(if whole.first() == Some(&ID_HEALTH) { b'D' } else { b'R' });
                self.0.extend(u32::try_from(whole.len()).unwrap().to_be_bytes());
                self.0.extend(whole);
            }
        }
    }

    pub(crate) fn end(mut self, frames: u64, dropped_bytes: u64) -> Vec<u8> {
        self.0.push(b'E');
        for number in [frames, dropped_bytes] {
            self.0.extend(u32::try_from(number).unwrap().to_be_bytes());
        }
        self.0
    }
}

/// The decoder in Rust.
pub(crate) fn rust(
    schema: &Schema,
    direction: Direction,
    stream: &[u8],
    pieces: &[u32],
) -> Vec<u8> {
    let mut decoder = Decoder::new(schema, direction);
    let mut answer = Answer::default();
    let mut sizes = pieces.iter().cycle();
    let mut rest = stream;
    while !rest.is_empty() {
        let size = sizes.next().map_or(0, |&size| size as usize);
        let size = if size == 0 { rest.len() } else { size.min(rest.len()) };
        let (piece, others) = rest.split_at(size);
        decoder.feed_frames(piece, |frame| match frame {
            Frame::HelloRequest => answer.frame(&[0]),
            Frame::HealthRequest => answer.frame(&[0, 1]),
            Frame::Health(health) => answer.frame(&health_payload(schema, health)),
            Frame::OtherHealth(version) => answer.frame(&[ID_HEALTH, version]),
            Frame::Hello(hash) => answer.frame(&[&[0][..], &hash.to_be_bytes()].concat()),
            Frame::Report(report) => {
                let items = report.values().flat_map(|value| {
                    std::iter::once(value.item.id).chain(value.bytes.iter().copied())
                });
                let stamp = report.stamp().map_or(Vec::new(), |stamp| {
                    let time = stamp.time_us.to_be_bytes();
                    [&[0], &time[..], &[stamp.counter]].concat()
                });
                answer.frame(&stamp.into_iter().chain(items).collect::<Vec<u8>>());
            }
        });
        rest = others;
    }
    answer.end(decoder.frames(), decoder.dropped_bytes())
}

/// The payload of a health frame, encoded again from the decoded values.
fn health_payload(schema: &Schema, health: HealthFrame<'_>) -> Vec<u8> {
    let bare = Schema { checksum: Checksum::None, ..schema.clone() };
    let frame = encode_health(&bare, &health.read()).unwrap();
    let start = frame.iter().position(|&byte| byte == b':').unwrap() + 1;
    frame[start..frame.len() - 1].to_vec()
}

/// The schema in the byte format that the program reads.
pub(crate) fn schema_bytes(schema: &Schema, direction: Direction) -> Vec<u8> {
    let checksum = match schema.checksum {
        Checksum::None => 0,
        Checksum::Crc16 => 1,
        Checksum::Crc32 => 8,
    };
    let to_board = u8::from(direction == Direction::Actuator);
    let mut bytes = vec![checksum | to_board << 1 | u8::from(schema.stamp) << 2];
    for item in &schema.items {
        let scalar = ScalarType::ALL.iter().position(|&scalar| scalar == item.value.scalar);
        bytes.extend([item.id, u8::try_from(scalar.unwrap()).unwrap()]);
        bytes.push(u8::from(item.direction == Direction::Actuator));
        bytes.extend(u16::try_from(item.value.count()).unwrap().to_be_bytes());
    }
    bytes
}

/// A stream that is cut into pieces, with its schema in the byte format.
#[derive(Clone, Copy)]
pub(crate) struct Input<'a> {
    pub(crate) schema: &'a [u8],
    pub(crate) stream: &'a [u8],
    pub(crate) pieces: &'a [u32],
}

/// The running program.
pub(crate) struct Program {
    child: Child,
    answers: BufReader<ChildStdout>,
}

impl Program {
    /// Starts it; the first test that asks for these flags compiles it into `folder`.
    pub(crate) fn build(folder: &Path, flags: &[&str]) -> Self {
        let what = format!("decoders {}", flags.join(" "));
        let program = compiled_once(what, || Self::compile(folder, flags));
        let mut child = Command::new(&program)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .unwrap_or_else(|error| panic!("{}: {error}", program.display()));
        let answers = BufReader::new(child.stdout.take().unwrap());
        Self { child, answers }
    }

    fn compile(folder: &Path, flags: &[&str]) -> PathBuf {
        std::fs::create_dir_all(folder).unwrap();
        let mut objects = Vec::new();
        for (compiler, standard, source) in [
            ("gcc", "-std=c99", "tests/decoders/c.c"),
            ("gcc", "-std=c99", "tests/decoders/main.c"),
            ("gcc", "-std=c99", "crates/firmware-c/runtime/up_decode.c"),
            ("gcc", "-std=c99", "crates/firmware-c/runtime/up_encode.c"),
            ("gcc", "-std=c99", "crates/firmware-c/runtime/up_health.c"),
            ("gcc", "-std=c99", "crates/firmware-c/runtime/up_memo.c"),
            ("gcc", "-std=c99", "crates/firmware-c/runtime/up_schema.c"),
            ("gcc", "-std=c99", "crates/firmware-c/runtime/up_wire.c"),
            ("g++", "-std=c++98", "tests/decoders/cpp.cpp"),
        ] {
            let object = folder.join(Path::new(source).file_name().unwrap()).with_extension("o");
            let include = |path: &str| format!("-I{}", root().join(path).display());
            let mut command = Command::new(compiler);
            command.args([standard, "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wshadow"]);
            command.args(["-Werror", "-D_POSIX_C_SOURCE=199309L", "-c"]).args(flags);
            command
                .args([include("crates/firmware-c/runtime"), include("crates/host-cpp/runtime")]);
            run(command.arg(root().join(source)).arg("-o").arg(&object));
            objects.push(object);
        }
        let program: PathBuf = folder.join("decoders");
        run(Command::new("g++").args(flags).args(objects).arg("-o").arg(&program));
        program
    }

    fn ask(&mut self, who: &str, how: &str, repeats: u32, input: Input<'_>) {
        let Input { schema, stream, pieces } = input;
        let stdin = self.child.stdin.as_mut().unwrap();
        let (schema_size, stream_size) = (schema.len(), stream.len());
        let sizes = format!("{schema_size} {} {stream_size}", pieces.len());
        writeln!(stdin, "{who} {how} {repeats} {sizes}").unwrap();
        stdin.write_all(schema).unwrap();
        for piece in pieces {
            stdin.write_all(&piece.to_ne_bytes()).unwrap();
        }
        stdin.write_all(stream).unwrap();
        stdin.flush().unwrap();
    }

    /// The answer of a decoder (`c` or `cpp`) to a stream that is cut into pieces.
    pub(crate) fn say(&mut self, who: &str, input: Input<'_>) -> Vec<u8> {
        self.ask(who, "say", 1, input);
        let mut size = [0; 4];
        self.answers.read_exact(&mut size).unwrap();
        let mut answer = vec![0; u32::from_ne_bytes(size) as usize];
        self.answers.read_exact(&mut answer).unwrap();
        answer
    }

    /// The time in nanoseconds that a decoder takes to decode the stream `repeats` times.
    pub(crate) fn time(&mut self, who: &str, repeats: u32, input: Input<'_>) -> u64 {
        self.ask(who, "time", repeats, input);
        let mut line = String::new();
        self.answers.read_line(&mut line).unwrap();
        line.trim().parse().unwrap()
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        drop(self.child.stdin.take());
        let _ = self.child.wait();
    }
}

//! The host `rust`: the shared vectors, damaged streams, lints, and a program on a serial line that the test plays.

use std::path::{Path, PathBuf};
use std::process::Command;

use sensedsl_tests::{TempDir, answered, compiled_once, few, is_thorough, run, sensedsl};
use sensedsl_wire::{Direction, Event, Scalar, Schema, encode_hello, encode_report};

use super::played::played;
use super::vectors::{self, DAMAGED, Exchange, Numbers};
use super::{designs, files};

/// Cargo in a generated folder. What the packages build on is built once for all tests.
///
/// The lock file must be what Cargo would make of the package. Where it is not, `cargo generate-lockfile` in the folder
/// makes the new `crates/host-rust/src/Cargo.lock.txt`.
fn cargo(folder: &Path, arguments: &[&str]) -> Command {
    let mut cargo = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    let target = folder.parent().unwrap().join("rust-target");
    cargo.current_dir(folder).args(arguments).args(["--quiet", "--offline", "--locked"]);
    cargo.env("CARGO_TARGET_DIR", target).env("CARGO_PROFILE_DEV_DEBUG", "none");
    cargo
}

/// The program that answers for the vectors: all their schemas are boards of one design.
fn program() -> PathBuf {
    compiled_once("the vectors in Rust".into(), || {
        let mut serve = String::new();
        let paths = vectors::files();
        let boards = paths.iter().enumerate().map(|(number, path)| {
            serve.push_str(&format!("            \"{number}\" => serve::<V{number}>(&$kinds),\n"));
            let name = format!("V{number}");
            let mut one = designs::board(&name, sensedsl_wire::Checksum::None, "");
            one.schema = vectors::read(path).0;
            one
        });
        let boards: Vec<_> = boards.collect();
        let folder = files::generate("rust", "vectors", &boards);
        let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("hosts/vectors.rs");
        let source = std::fs::read_to_string(source).unwrap();
        let table = format!(
            "macro_rules! BOARDS {{\n    ($number:ident, $kinds:ident) => {{\n        match $number.as_str() {{\n{serve}\
             \n            _ => panic!(),\n        }}\n    }};\n}}\n"
        );
        let (head, rest) = source.split_once("\nuse std::fmt;").unwrap();
        std::fs::write(
            folder.join("examples/vectors.rs"),
            format!("{head}\n{table}use std::fmt;{rest}"),
        )
        .unwrap();
        run(&mut cargo(&folder, &["build", "--no-default-features", "--example", "vectors"]));
        folder.parent().unwrap().join("rust-target/debug/examples/vectors")
    })
}

fn answer(number: usize, schema: &Schema, exchange: &Exchange) -> String {
    let items = schema.items.iter().map(|item| format!("{},{}", item.id, item.value.scalar));
    let mut program = Command::new(program());
    answered(program.arg(number.to_string()).args(items), exchange.asked())
}

#[test]
fn shared_vectors_cut_at_every_place() {
    for (number, path) in vectors::files().iter().enumerate() {
        let (schema, exchange) = vectors::read(path);
        // How a board tells its health is no business of a host.
        let exchange = exchange.without("encode-health");
        let answer = answer(number, &schema, &exchange);
        let alike = |answer| vectors::with_reals_alike(&schema, answer);
        assert_eq!(alike(&answer), alike(exchange.expected()), "{}", path.display());
    }
}

#[test]
fn damaged_streams_are_read_as_by_the_reference() {
    for name in few(&DAMAGED, 2) {
        let count = if is_thorough() { 1_000 } else { 100 };
        let (schema, exchange) = vectors::damage(name, &mut Numbers::new(2016), count);
        let all = vectors::files();
        let number = all.iter().position(|path| path.file_stem().is_some_and(|stem| stem == *name));
        assert_eq!(answer(number.unwrap(), &schema, &exchange), exchange.expected(), "{name}");
    }
}

#[test]
fn clippy_has_nothing_to_say() {
    for (name, boards) in few(&designs::all(), 2) {
        let folder = files::generate("rust", &format!("{name}-lints"), boards);
        // What this project forbids its libraries is no business of the user's.
        std::fs::write(folder.join("clippy.toml"), "").unwrap();
        for features in [&["--all-targets"][..], &["--no-default-features"]] {
            let arguments = [&["clippy"], features].concat();
            run(cargo(&folder, &arguments).args(["--", "-D", "warnings"]));
        }
    }
}

pub(super) const ROBOT: &str = "board Rover on NUCLEO_F446RE {
    sensor Light returns uint16 { id = 17; type = analog; scale = 0.5; offset = -10; quantity = cm; max = 900; }
    sensor loop returns int32 { id = 18; type = encoder; }
    actuator Servo accepts uint16 { id = 19; type = dac; scale = 0.1; quantity = deg; min = 0; max = 180; failsafe = 0; }
    link { silence = 400 ms; }
}";

const PROGRAM: &str = r#"
use std::time::Duration;
use sense_robot::{Error, Light, Rover, RoverMessage, Servo, loop_};

fn main() -> Result<(), Error> {
    let path = std::env::args().nth(1).unwrap();
    let mut board = match Rover::open(&path) {
        Ok(board) => board,
        Err(error) => { println!("{error}"); std::process::exit(2) }
    };
    if let Err(error) = board.send(Servo::of(45.5)?) {
        println!("{error}");
        std::process::exit(1);
    }
    board.send(Servo::of_raw(7)?)?;
    for wrong in [Servo::of(180.1), Servo::of_raw(1801), Servo::of(f64::NAN)] {
        println!("{}", wrong.unwrap_err());
    }
    println!("{}", board.send(Servo { raw: 1801 }).unwrap_err());
    let first = board.find_map(|one| Light::try_from(one.unwrap().message).ok()).unwrap();
    println!("{first}: {} {} {} {:?}", first.value(), first.unit(), first.raw, first.outside());
    while !matches!(board.next_within(Duration::from_secs(9))?.unwrap().message, RoverMessage::loop_(_)) {}
    println!("{} {}", board.latest::<loop_>().unwrap().message.value(), board.is_overdue::<Light>());
    let health = board.health(Duration::from_secs(3))?;
    println!("{} {} {:?}", health.board.uptime_ms, health.board.reset_cause, health.devices[0]);
    println!("{} {}", board.counts().dropped_bytes, board.is_ready());
    let mut stream = board.into_stream();
    stream.send(Servo::of(1.0)?)?;
    let mut context = std::task::Context::from_waker(std::task::Waker::noop());
    let start = std::time::Instant::now();
    let mut seen = 0;
    while seen < 3 || start.elapsed() < Duration::from_millis(300) {
        if let std::task::Poll::Ready(Some(one)) = stream.poll_next(&mut context) {
            one?;
            seen += 1;
        }
    }
    println!("streamed");
    Ok(())
}
"#;

/// The robot's schema, and its program.
fn robot() -> (Schema, PathBuf) {
    let scratch = TempDir::new("rust-robot");
    let file = scratch.write("robot.sense", ROBOT);
    let out = scratch.join("out");
    let call = sensedsl(["generate", "--quiet", "--without", "firmware", "--host", "rust", "-o"]);
    let _ = call.arg(&out).arg(&file).run().exits(0);
    let text = sensedsl_tests::read(&out.join("schema.json"));
    let boards = sensedsl_host::Board::all_of_json(&text).unwrap();
    let program = compiled_once("the robot in Rust".into(), || {
        let folder = files::folder("robot-rust");
        let tree = sensedsl_tests::tree(&out.join("host/rust"));
        sensedsl_tests::write_all(&folder, &tree);
        std::fs::write(folder.join("examples/program.rs"), PROGRAM).unwrap();
        run(&mut cargo(&folder, &["build", "--examples"]));
        folder.parent().unwrap().join("rust-target/debug/examples/program")
    });
    (boards[0].schema.clone(), program)
}

#[test]
fn a_program_reads_sets_and_asks() {
    let (schema, program) = robot();
    let (commands, status, said) =
        played(&mut Command::new(&program), &schema, &encode_hello(&schema));
    assert_eq!(status, 0, "{said}");
    let servo = |code| Event::Report(None, vec![(19, vec![Scalar::Unsigned(code)])]);
    assert_eq!(commands, [servo(455), servo(7), servo(10)], "{said}");
    for expected in [
        "Servo: 180.1 is above the maximum of 180\nServo: 180.1 is above the maximum of 180\n",
        "Servo: NaN is out of reach of its type\nServo: 180.1 is above the maximum of 180\n",
        "Light = 1840 (910 cm) (above the maximum of 900 cm): 910 cm 1840 Some(Above(900.0))\n",
        "-3 false\n",
        "12345 watchdog DeviceHealth { id: 17, name: \"Light\", status: Failed, age_ms: Some(7), failures: [1, 2, 3, 4, 5, 6] }\n",
        "0 true\nstreamed\n",
    ] {
        assert!(said.contains(expected), "{expected}: {said}");
    }
}

#[test]
fn other_firmware_and_devices_that_are_none_end_it() {
    let (schema, program) = robot();
    let mut other = schema.clone();
    other.items[0].name = "Dark".to_owned();
    let text = other.canonical_text().replace('\n', "\r\n");
    let hello = [encode_hello(&other), format!("ch> schema\r\n{text}ch> ").into_bytes()].concat();
    let (commands, status, said) = played(&mut Command::new(&program), &schema, &hello);
    assert_eq!((status, commands.len()), (1, 0), "{said}");
    for expected in ["Light: not on the board", "Dark: only on the board"] {
        assert!(said.contains(expected), "{expected}: {said}");
    }
    let output = Command::new(&program).arg("/dev/no such").output().unwrap();
    let said = String::from_utf8(output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains("/dev/no such cannot be opened: there is no such device"), "{said}");
}

#[test]
fn a_recording_is_played() {
    let scratch = TempDir::new("rust-recording");
    let (schema, program) = robot();
    let value = [(17, vec![Scalar::Unsigned(100)])];
    let report = encode_report(&schema, Direction::Sensor, &value).unwrap();
    let bytes = [b"garbage".to_vec(), encode_hello(&schema), report].concat();
    let file = scratch.join("recording");
    std::fs::write(&file, bytes).unwrap();
    let monitor = program.with_file_name("monitor");
    let output = Command::new(monitor).arg(&file).output().unwrap();
    assert_eq!(String::from_utf8(output.stdout).unwrap(), "Light = 100 (40 cm)\n");
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(said, "2 frames, 7 bytes dropped\n");
}

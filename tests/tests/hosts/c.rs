//! The host `c`: the shared vectors, damaged streams, other compilers, what it links on a microcontroller, and a program
//! on a serial line that the test plays.

use std::path::{Path, PathBuf};
use std::process::Command;

use sensedsl_tests::{
    TempDir, answered, compiled_once, few, has, is_thorough, root, run, sensedsl,
};
use sensedsl_wire::{Checksum, Event, Scalar, Schema, encode_hello, encode_report};

use super::played::played;
use super::rust::ROBOT;
use super::vectors::{self, DAMAGED, Exchange, Numbers};
use super::{designs, files};

const WARNINGS: [&str; 7] =
    ["-std=c99", "-Wall", "-Wextra", "-Wconversion", "-Wshadow", "-Werror", "-pedantic"];

/// A call of a compiler in a folder, with all warnings as errors.
fn compiler(name: &str, folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(name);
    command.current_dir(folder).args(WARNINGS).args(arguments);
    command
}

/// The program that answers for the vectors: all their schemas are boards of one design.
fn program(name: &'static str) -> PathBuf {
    compiled_once(format!("the vectors in C by {name}"), || {
        let paths = vectors::files();
        let boards = paths.iter().enumerate().map(|(number, path)| {
            let mut one = designs::board(&format!("V{number}"), Checksum::None, "");
            one.schema = vectors::read(path).0;
            one
        });
        let boards: Vec<_> = boards.collect();
        let folder = files::generate_as("all", "c", &format!("vectors-{name}"), &boards);
        let mut header = String::new();
        let mut table = String::from("static const sensedsl_schema *const boards[] = {");
        let mut sources = vec!["sensedsl.c".to_owned(), "vectors.c".to_owned()];
        for number in 0..boards.len() {
            header.push_str(&format!("#include \"all_V{number}.h\"\n"));
            table.push_str(&format!("&all_V{number}_schema, "));
            sources.push(format!("all_V{number}.c"));
        }
        std::fs::write(folder.join("boards.h"), format!("{header}{table}}};\n")).unwrap();
        std::fs::copy(root().join("tests/hosts/vectors.c"), folder.join("vectors.c")).unwrap();
        let arguments = ["-g", "-O1", "-fsanitize=address,undefined", "-fno-sanitize-recover=all"];
        run(compiler(name, &folder, &arguments).args(sources).args(["-o", "vectors"]));
        folder.join("vectors")
    })
}

fn answer(program: &Path, number: usize, exchange: &Exchange) -> String {
    answered(Command::new(program).arg(number.to_string()), exchange.asked())
}

/// What a host does of the vectors: it reads what boards say, and sets actuators.
fn of_a_host(exchange: &Exchange) -> (Exchange, String) {
    let exchange =
        exchange.without("encode-health").without("encode sensors").without("decode actuators");
    let lines = exchange.expected().split_inclusive('\n');
    let expected = lines.filter(|line| !line.starts_with("hello ")).collect();
    (exchange, expected)
}

#[test]
fn shared_vectors_cut_at_every_place() {
    for name in few(&["gcc", "clang"], 1) {
        if !has(name) {
            continue;
        }
        for (number, path) in vectors::files().iter().enumerate() {
            let (schema, exchange) = vectors::read(path);
            let (exchange, expected) = of_a_host(&exchange);
            let answer = answer(&program(name), number, &exchange);
            let alike = |answer: &str| vectors::with_reals_alike(&schema, answer);
            assert_eq!(alike(&answer), alike(&expected), "{}", path.display());
        }
    }
}

#[test]
fn damaged_streams_are_read_as_by_the_reference() {
    if !has("gcc") {
        return;
    }
    let all = vectors::files();
    for name in few(&DAMAGED, 3) {
        let count = if is_thorough() { 1_000 } else { 100 };
        let (schema, exchange) = vectors::damage(name, &mut Numbers::new(2017), count);
        let number = all.iter().position(|path| path.file_stem().is_some_and(|stem| stem == *name));
        let answer = answer(&program("gcc"), number.unwrap(), &exchange);
        let alike = |answer: &str| vectors::with_reals_alike(&schema, answer);
        assert_eq!(alike(&answer), alike(exchange.expected()), "{name}");
    }
}

#[test]
fn it_is_of_other_compilers_and_single_precision() {
    for (name, boards) in few(&designs::all(), 1) {
        let folder = files::generate("c", &format!("{name}-others"), boards);
        for source in files::sources(&folder, "c") {
            if has("clang") {
                run(&mut compiler("clang", &folder, &["-fsyntax-only", &source]));
            }
            // The hostile design has numbers that no `float` holds.
            if has("gcc") && *name != "hostile" && !source.starts_with("monitor") {
                let single = ["-DSENSEDSL_REAL=float", "-fsyntax-only", &source];
                run(&mut compiler("gcc", &folder, &single));
            }
        }
        if has("g++") {
            for header in files::sources(&folder, "h") {
                let arguments =
                    ["-Wall", "-Wextra", "-Werror", "-x", "c++", "-fsyntax-only", &header];
                run(Command::new("g++").current_dir(&folder).args(arguments));
            }
        }
    }
}

#[test]
fn a_microcontroller_needs_nothing_but_memory_functions() {
    if !has("arm-none-eabi-gcc") || !has("arm-none-eabi-nm") {
        return;
    }
    let folder = files::generate("c", "arm", &designs::all_types());
    let sources = ["robot_Everything.c", "sensedsl.c"];
    let arguments = ["-mcpu=cortex-m0", "-mthumb", "-Os", "-r", "-nostdlib", "-o", "all.o"];
    run(compiler("arm-none-eabi-gcc", &folder, &arguments).args(sources));
    let names =
        answered(Command::new("arm-none-eabi-nm").current_dir(&folder).args(["-u", "all.o"]), "");
    // What the compiler calls for arithmetic begins with two underscores.
    let called = names.split_whitespace().filter(|name| *name != "U" && !name.starts_with("__"));
    let called: Vec<&str> = called.collect();
    assert_eq!(called, ["memcmp", "memcpy", "memmove", "memset"]);
}

const PROGRAM: &str = r#"
#define _DEFAULT_SOURCE
#include <fcntl.h>
#include <poll.h>
#include <stdio.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>
#include "robot_Rover.h"

static robot_Rover board;
static int device, lights, loops, is_over;

static void send(const uint8_t *bytes, size_t count) {
    if (write(device, bytes, count) != (ssize_t)count) { is_over = 1; }
}

static void on_matched(void *context) {
    uint8_t frame[robot_Rover_FRAME_BYTES];
    uint16_t raw = 0;
    sensedsl_writer writer;
    printf("matched %d\n", *(int *)context);
    printf("%d", robot_Rover_code_Servo(45.5, &raw));
    printf(" %d", raw);
    printf(" %d %d\n", robot_Rover_code_Servo(180.1, &raw), (int)robot_Rover_set_Servo(frame, 1801));
    send(frame, robot_Rover_set_Servo(frame, 455));
    sensedsl_begin(&writer, &robot_Rover_schema, frame, sizeof frame);
    printf("%d", robot_Rover_add_Servo(&writer, 7));
    printf(" %d\n", robot_Rover_add_Servo(&writer, 7));
    printf("%d\n", (int)sensedsl_end(&writer));
    send(frame, robot_Rover_set_Servo(frame, 7));
    sensedsl_ask_health(&board.link);
    board.link.is_held = true;
}

static void on_other(void *context, uint32_t hash) {
    (void)context;
    printf("other %s\n", hash != robot_Rover_schema.hash ? "hash" : "");
    is_over = 1;
}

static void on_Light(void *context, uint16_t raw) {
    (void)context;
    if (lights++ == 0) { printf("Light %d %d\n", raw, (int)robot_Rover_value_Light(raw)); }
}

static void on_loop(void *context, int32_t raw) {
    (void)context;
    if (loops++ == 0) { printf("loop %d\n", (int)raw); }
}

static void on_health(void *context, const sensedsl_event *event) {
    sensedsl_device_health health;
    (void)context;
    printf("%d %d\n", (int)event->health.uptime_ms, event->health.reset_cause);
    if (sensedsl_health_of(&robot_Rover_schema, event, 2, &health)) {
        printf("%s %d %d %d\n", health.device->name, health.status, (int)health.age_ms, health.failures[5]);
    }
    is_over = 1;
}

int main(int count, char **arguments) {
    int context = 5;
    const robot_Rover_handlers handlers = {&context, on_matched, on_other, on_health, on_Light, on_loop};
    struct termios line;
    (void)count;
    device = open(arguments[1], O_RDWR | O_NOCTTY);
    tcgetattr(device, &line);
    line.c_iflag = 0; line.c_oflag = 0; line.c_lflag = 0;
    tcsetattr(device, TCSANOW, &line);
    robot_Rover_open(&board, &handlers);
    while (!is_over) {
        uint8_t question[SENSEDSL_QUESTION_BYTES], bytes[64];
        struct timespec now;
        struct pollfd wait = {device, POLLIN, 0};
        clock_gettime(CLOCK_MONOTONIC, &now);
        send(question, sensedsl_to_send(&board.link, (uint32_t)(now.tv_sec * 1000 + now.tv_nsec / 1000000), question));
        if (poll(&wait, 1, 20) > 0) {
            const ssize_t got = read(device, bytes, sizeof bytes);
            if (got > 0) { robot_Rover_feed(&board, bytes, (size_t)got); }
        }
    }
    printf("dropped %d\n", (int)board.link.decoder.dropped_bytes);
    return 0;
}
"#;

/// The robot's schema, and its program; `None` without a compiler.
fn robot() -> Option<(Schema, PathBuf)> {
    if !has("gcc") {
        return None;
    }
    let scratch = TempDir::new("c-robot");
    let file = scratch.write("robot.sense", ROBOT);
    let out = scratch.join("out");
    let call = sensedsl(["generate", "--quiet", "--without", "firmware", "--host", "c", "-o"]);
    let _ = call.arg(&out).arg(&file).run().exits(0);
    let text = sensedsl_tests::read(&out.join("schema.json"));
    let boards = sensedsl_host::Board::all_of_json(&text).unwrap();
    let program = compiled_once("the robot in C".into(), || {
        let folder = files::folder("robot-c");
        let tree = sensedsl_tests::tree(&out.join("host/c"));
        sensedsl_tests::write_all(&folder, &tree);
        std::fs::write(folder.join("program.c"), PROGRAM).unwrap();
        let sanitize = ["-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=all"];
        for name in ["program", "monitor_robot_Rover"] {
            let main = format!("{name}.c");
            let arguments = ["-std=c99", "-o", name, &main, "sensedsl.c", "robot_Rover.c"];
            run(Command::new("gcc").current_dir(&folder).args(sanitize).args(arguments));
        }
        folder.join("program")
    });
    Some((boards[0].schema.clone(), program))
}

#[test]
fn a_program_reads_sets_and_asks() {
    let Some((schema, program)) = robot() else { return };
    let (commands, status, said) =
        played(&mut Command::new(&program), &schema, &encode_hello(&schema));
    assert_eq!(status, 0, "{said}");
    let servo = |code| Event::Report(None, vec![(19, vec![Scalar::Unsigned(code)])]);
    assert_eq!(commands, [servo(455), servo(7)], "{said}");
    for expected in [
        "matched 5\n1 455 0 0\n1 0\n0\n",
        "Light 1840 910\n",
        "loop -3\n",
        "12345 4\nServo 3 7 6\n",
        "dropped 0\n",
    ] {
        assert!(said.contains(expected), "{expected}: {said}");
    }
}

#[test]
fn other_firmware_is_told_and_nothing_else() {
    let Some((schema, program)) = robot() else { return };
    let mut other = schema.clone();
    other.items[0].name = "Dark".to_owned();
    let (commands, status, said) =
        played(&mut Command::new(&program), &schema, &encode_hello(&other));
    assert_eq!((commands.len(), status, &*said), (0, 0, "other hash\ndropped 0\n"));
}

#[test]
fn a_recording_is_played() {
    let Some((schema, program)) = robot() else { return };
    let scratch = TempDir::new("c-recording");
    let values = [(17, vec![Scalar::Unsigned(1_840)]), (18, vec![Scalar::Signed(-3)])];
    let report = encode_report(&schema, sensedsl_wire::Direction::Sensor, &values).unwrap();
    let file = scratch.join("recording");
    std::fs::write(&file, [b"garbage".to_vec(), encode_hello(&schema), report].concat()).unwrap();
    let output =
        Command::new(program.with_file_name("monitor_robot_Rover")).arg(&file).output().unwrap();
    assert_eq!(String::from_utf8(output.stdout).unwrap(), "Light = 1840 (910 cm)\nloop = -3\n");
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(
        (said.as_str(), output.status.code()),
        ("firmware and design agree\n2 frames, 7 bytes dropped\n", Some(0))
    );
}

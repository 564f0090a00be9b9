//! The host `ros2`: its nodes against stand-ins of ROS 2, which print what is published: the shared vectors, units,
//! commands, diagnostics.

use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use sensedsl_generate::host;
use sensedsl_tests::{TempDir, compiled_once, few, has, is_thorough, root, run, sensedsl};
use sensedsl_wire::{
    Decoder, DeviceHealth, Direction, Event, Health, ResetCause, Scalar, Schema, Status,
    encode_health, encode_hello, encode_report,
};

use super::compile::compile;
use super::terminal::{Line, is_command};
use super::vectors;
use super::{designs, files};

/// The headers of the messages, under the names that ROS 2 gives them.
const HEADERS: &str = "diagnostic_msgs/diagnostic_array diagnostic_msgs/diagnostic_status diagnostic_msgs/key_value \
    sensor_msgs/range sensor_msgs/temperature sensor_msgs/fluid_pressure sensor_msgs/illuminance \
    sensor_msgs/relative_humidity sensor_msgs/imu sensor_msgs/magnetic_field std_msgs/header std_msgs/bool \
    std_msgs/u_int8 std_msgs/int8 std_msgs/u_int16 std_msgs/int16 std_msgs/u_int32 std_msgs/int32 std_msgs/u_int64 \
    std_msgs/int64 std_msgs/float32 std_msgs/float64 std_msgs/u_int8_multi_array std_msgs/int8_multi_array \
    std_msgs/u_int16_multi_array std_msgs/int16_multi_array std_msgs/u_int32_multi_array std_msgs/int32_multi_array \
    std_msgs/u_int64_multi_array std_msgs/int64_multi_array std_msgs/float32_multi_array std_msgs/float64_multi_array";

/// A folder with the stand-ins.
fn stand_ins() -> PathBuf {
    compiled_once("the stand-ins of ROS 2".into(), || {
        let folder = files::folder("ros2-stand-ins");
        let own = sensedsl_tests::tree(&root().join("tests/hosts/ros2"));
        sensedsl_tests::write_all(&folder, &own);
        for header in HEADERS.split_whitespace() {
            let (package, name) = header.split_once('/').unwrap();
            sensedsl_tests::write_file(
                &folder.join(format!("{package}/msg/{name}.hpp")),
                "#include \"messages.hpp\"\n",
            );
        }
        folder
    })
}

/// Compiles the node of a board.
fn built(folder: &Path, board: &str) -> PathBuf {
    let program = folder.join(board);
    let mut compiler = Command::new("g++");
    compiler.current_dir(folder).args(["-std=c++17", "-O0", "-pthread", "-Iinclude", "-isystem"]);
    compiler.arg(stand_ins()).arg(format!("src/{board}.cpp")).arg("-o").arg(&program);
    run(&mut compiler);
    program
}

#[test]
fn nodes_of_all_designs_are_of_their_language() {
    if !has("g++") {
        return;
    }
    for (name, boards) in few(&designs::all(), 2) {
        let folder = files::generate("ros2", &format!("{name}-language"), boards);
        compile(&host::find("ros2").unwrap().compile(), &folder, &[&stand_ins()]);
    }
}

#[test]
fn manifest_and_launch_file_are_of_their_languages() {
    if !has("python3") {
        return;
    }
    const CHECK: &str = "
import sys, ast, xml.dom.minidom as dom
package = dom.parse('package.xml').documentElement
text = lambda name: [one.firstChild.data for one in package.getElementsByTagName(name)]
tree = ast.parse(open('launch/' + text('name')[0] + '.launch.py').read())
print(package.getAttribute('format'), text('name'), text('depend'), [one.name for one in tree.body if hasattr(one, 'name')])";
    for (name, boards) in designs::all() {
        let folder = files::generate("ros2", &format!("{name}-files"), &boards);
        let checked = run(Command::new("python3").current_dir(folder).args(["-c", CHECK]));
        assert_eq!(
            String::from_utf8(checked.stdout).unwrap(),
            "3 ['sense_robot'] ['diagnostic_msgs', 'rclcpp', 'sensor_msgs', 'std_msgs'] ['generate_launch_description']\n"
        );
    }
}

/// What a right node publishes of a stream, from what the vectors say of it: a line for each value.
fn published(schema: &Schema, answer: &str) -> String {
    let mut lines = String::new();
    for word in
        answer.lines().filter_map(|line| line.strip_prefix("got ")).flat_map(str::split_whitespace)
    {
        let Some((id, values)) = word.split_once('=') else { continue };
        let item = schema.items.iter().find(|item| item.id.to_string() == id);
        if let Some(item) = item.filter(|item| item.direction == Direction::Sensor) {
            let values = values.replace("true", "1").replace("false", "0");
            let values: Vec<String> = values.split(',').map(alike).collect();
            lines.push_str(&format!("/vectors/{} {}\n", item.name, values.join(",")));
        }
    }
    lines
}

/// A real as the shortest text that is the same single, anything else as it is.
fn alike(text: &str) -> String {
    let is_real = text.contains(['.', 'e', 'n', 'i']);
    if is_real {
        text.parse::<f32>().map_or(text.to_owned(), |real| real.to_string())
    } else {
        text.to_owned()
    }
}

#[test]
fn what_is_published_is_what_the_vectors_say() {
    if !has("g++") {
        return;
    }
    let wanted: &[&str] = if is_thorough() {
        &["fig2", "all_types", "arrays", "stamp", "checksum", "crc32"]
    } else {
        &["fig2"]
    };
    for path in vectors::files() {
        let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
        if !wanted.contains(&&*name) {
            continue;
        }
        let (schema, exchange) = vectors::read(&path);
        let mut board = designs::board("Vectors", schema.checksum, "");
        board.schema = schema.clone();
        let folder = files::generate("ros2", &format!("vectors-{name}"), &[board]);
        let program = built(&folder, "Vectors");
        let answers = exchange.expected().split_inclusive("end\n");
        let mut count = 0;
        for (asked, answer) in exchange.asked().lines().zip(answers) {
            // A hello in a vector is that of any design: what comes behind it is of another board.
            let Some(hex) = asked.strip_prefix("decode sensors") else { continue };
            if answer.contains("hello") {
                continue;
            }
            let digits: String = hex.split_whitespace().collect();
            let bytes = (0..digits.len()).step_by(2);
            let bytes: Vec<u8> =
                bytes.map(|at| u8::from_str_radix(&digits[at..at + 2], 16).unwrap()).collect();
            let recording = folder.join("recording");
            std::fs::write(&recording, [encode_hello(&schema), bytes].concat()).unwrap();
            let mut node = Command::new(&program);
            let node =
                run(node.args(["--ros-args", "-p"]).arg(format!("port:={}", recording.display())));
            let said = String::from_utf8(node.stdout).unwrap();
            let values = said.lines().filter(|line| !line.starts_with("/diagnostics"));
            let values = values.map(|line| {
                let (topic, numbers) = line.split_once(' ').unwrap();
                let numbers: Vec<String> = numbers.split(',').map(alike).collect();
                format!("{topic} {}\n", numbers.join(","))
            });
            assert_eq!(values.collect::<String>(), published(&schema, answer), "{name}: {asked}");
            count += 1;
        }
        assert!(count > 2, "{name}: {count}");
    }
}

const ROBOT: &str = "board Rover on NUCLEO_F446RE {
    sensor Front returns uint16 { id = 17; type = analog; scale = 0.1; quantity = cm; min = 10; max = 80; }
    sensor Cabin returns int16 { id = 18; type = encoder; scale = 0.01; quantity = degC; }
    sensor Battery returns uint16 { id = 20; type = analog; scale = 0.01; quantity = V; }
    sensor Bumper returns bool[3] { id = 21; type = digital; }
    sensor Pressure returns uint16 { id = 22; type = analog; quantity = hPa; }
    actuator Servo accepts uint16 { id = 19; type = dac; scale = 0.1; quantity = deg; min = 0; max = 180; failsafe = 0; }
    actuator Lamps accepts bool[2] { id = 23; type = digital; }
}";

/// The robot's schema, and its node.
fn robot() -> (Schema, PathBuf) {
    let scratch = TempDir::new("ros2-robot");
    let file = scratch.write("robot.sense", ROBOT);
    let out = scratch.join("out");
    let call = sensedsl(["generate", "--quiet", "--without", "firmware", "--host", "ros2", "-o"]);
    let _ = call.arg(&out).arg(&file).run().exits(0);
    let text = sensedsl_tests::read(&out.join("schema.json"));
    let boards = sensedsl_host::Board::all_of_json(&text).unwrap();
    let program = compiled_once("the robot in ROS 2".into(), || {
        let folder = files::folder("robot-ros2");
        sensedsl_tests::write_all(&folder, &sensedsl_tests::tree(&out.join("host/ros2")));
        built(&folder, "Rover")
    });
    (boards[0].schema.clone(), program)
}

fn report(schema: &Schema) -> Vec<u8> {
    use Scalar::{Bool, Signed, Unsigned};
    let values = [
        (17, vec![Unsigned(255)]),
        (18, vec![Signed(-1234)]),
        (20, vec![Unsigned(1260)]),
        (21, vec![Bool(true), Bool(false), Bool(true)]),
        (22, vec![Unsigned(1013)]),
    ];
    encode_report(schema, Direction::Sensor, &values).unwrap()
}

fn health(schema: &Schema) -> Vec<u8> {
    let devices = schema.items.iter().enumerate().map(|(place, item)| DeviceHealth {
        id: item.id,
        status: [Status::Good, Status::Failed, Status::NeverRead][place % 3],
        age_ms: 7,
        causes: if place % 3 == 1 { [2, 0, 0, 4, 0, 0].into() } else { [0; 6].into() },
    });
    let health = Health {
        uptime_ms: 12_345,
        reset_cause: ResetCause::Power,
        reset_device: 0,
        reports_sent: 5,
        reports_refused: 1,
        load_percent: 40,
        stack_left_bytes: 200,
        devices: devices.collect(),
    };
    encode_health(schema, &health).unwrap()
}

#[test]
fn a_node_publishes_takes_commands_and_tells_diagnostics() {
    if !has("g++") {
        return;
    }
    let (schema, program) = robot();
    let mut line = Line::new();
    let mut child = Command::new(program)
        .args(["--ros-args", "-p", &format!("port:={}", line.device.display())])
        .args(["-p", "frame:=base", "-p", "frames.Front:=bumper", "-p", "infrared:=Front"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut stdin = child.stdin.take().unwrap();
    let mut decoder = Decoder::new(&schema, Direction::Actuator);
    let (mut commands, mut met) = (Vec::new(), None);
    let (start, mut is_ended) = (Instant::now(), false);
    while child.try_wait().unwrap().is_none() {
        assert!(start.elapsed() < Duration::from_secs(30), "it does not end");
        let mut asked = (false, false);
        decoder.feed(&line.hear(1, Duration::from_millis(30)), |event| {
            asked.0 |= event == Event::HelloRequest;
            asked.1 |= event == Event::HealthRequest;
            commands.extend(Some(event).filter(is_command));
        });
        if asked.0 {
            line.say(&encode_hello(&schema));
            met.get_or_insert_with(Instant::now);
        }
        if asked.1 {
            line.say(&health(&schema));
        }
        if let Some(met) = met {
            line.say(&report(&schema));
            if commands.is_empty() && met.elapsed() > Duration::from_millis(300) {
                let lines = "/rover/Servo 45.5\n/rover/Servo 180.1\n/rover/Servo nan\n/rover/Lamps 1 0\n/rover/Lamps 1\n";
                let _ = stdin.write_all(lines.as_bytes());
            }
            if !is_ended && met.elapsed() > Duration::from_millis(2500) {
                is_ended = true;
                let _ = stdin.write_all(b"end\n");
            }
        }
    }
    let output = child.wait_with_output().unwrap();
    let [said, told] =
        [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
    assert_eq!(output.status.code(), Some(0), "{said}{told}");
    let of = |id, value| Event::Report(None, vec![(id, value)]);
    let servo = of(19, vec![Scalar::Unsigned(455)]);
    let lamps = of(23, vec![Scalar::Bool(true), Scalar::Bool(false)]);
    assert_eq!(commands[..2], [servo, lamps], "{said}{told}");
    assert!(commands.len() % 2 == 0, "{commands:?}");
    for expected in [
        "/rover/Front frame=bumper type=1 min=0.1 max=0.8 range=0.255\n",
        "/rover/Cabin frame=base temperature=-12.34\n",
        "/rover/Battery 12.6",
        "/rover/Bumper 1,0,1\n",
        "/rover/Pressure frame=base fluid_pressure=101300\n",
        "[Rover 0 firmware and design agree; port: ",
        "up: 12.3 s; started by: power; reports sent: 5; reports refused: 1; load in %: 40]",
        "[Rover: Front 0 good; age: 7 ms]",
        "[Rover: Cabin 2 failed; age: 7 ms; failures: 2 not acknowledged, 4 timed out]",
        "[Rover: Battery 3 never read; age: 7 ms]",
    ] {
        assert!(said.contains(expected), "{expected}: {said}");
    }
    let refused = "Servo: not sent: beyond the limits of the design or of its type\n";
    assert!(told.contains(&format!("[WARN] [rover]: {refused}")), "{told}");
    assert!(told.contains("Lamps: not sent: beyond the limits"), "{told}");
}

#[test]
fn a_device_that_is_none_ends_a_node() {
    if !has("g++") {
        return;
    }
    let (_, program) = robot();
    let node =
        Command::new(program).args(["--ros-args", "-p", "port:=/dev/no such"]).output().unwrap();
    let told = String::from_utf8(node.stderr).unwrap();
    assert_eq!(node.status.code(), Some(2), "{told}");
    assert!(
        told.contains("[FATAL] [rover]: cannot open /dev/no such: there is no such device"),
        "{told}"
    );
}

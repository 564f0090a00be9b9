//! Stamps and health in the example of host `cpp`; the test plays a board that sends them.

use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use sensedsl_job::host::HostBoard;
use sensedsl_tests::printed;
use sensedsl_wire::{
    Causes, Checksum, Decoder, DeviceHealth, Direction, Event, Health, NEVER_MS, ResetCause,
    Scalar, Schema, Stamp, Status, UNKNOWN_LOAD, UNKNOWN_STACK, encode_health, encode_hello,
    encode_stamped_report,
};

use super::designs;
use super::terminal::{Line, build};
use super::tools::Background;

const LONG: Duration = Duration::from_secs(10);

fn boards() -> Vec<HostBoard> {
    let mut board = designs::board(
        "Robot",
        Checksum::Crc16,
        "17 sensor IRFront uint16
         33 actuator Servo int16
         20 sensor Wheel uint32",
    );
    board.schema.stamp = true;
    board.silence_ms = Some(200);
    vec![board]
}

fn healthy() -> Health {
    let device =
        |id, status, age_ms| DeviceHealth { id, status, age_ms, causes: Causes::default() };
    Health {
        uptime_ms: 7_261_000,
        reset_cause: ResetCause::Power,
        reset_device: 0,
        reports_sent: 65_536,
        reports_refused: 3,
        load_percent: 83,
        stack_left_bytes: 212,
        devices: vec![
            device(17, Status::Good, 12),
            device(33, Status::NeverRead, NEVER_MS),
            device(20, Status::Good, 1_250),
        ],
    }
}

/// The monitor on a line, and the state of the board that the test plays.
struct Scene {
    line: Line,
    schema: Schema,
    decoder_bytes: Vec<u8>,
    monitor: Background,
}

impl Scene {
    fn start(program: &(PathBuf, PathBuf), options: &[&str]) -> Self {
        let mut line = Line::new();
        let mut command = Command::new(&program.1);
        command.arg("--no-reconnect").args(options).arg(&line.device);
        let monitor = Background::start(&mut command, &program.0);
        let schema = boards().remove(0).schema;
        line.hear(4, LONG);
        line.say(&encode_hello(&schema));
        Self { line, schema, decoder_bytes: Vec::new(), monitor }
    }

    /// Waits until the host asks for health.
    fn wait_for_question(&mut self) {
        let start = Instant::now();
        loop {
            assert!(start.elapsed() < LONG, "nobody asks:\n{}", self.monitor.output());
            self.decoder_bytes.extend(self.line.hear(1, Duration::from_millis(50)));
            let mut decoder = Decoder::new(&self.schema, Direction::Actuator);
            let mut is_asked = false;
            decoder.feed(&self.decoder_bytes, |event| is_asked |= event == Event::HealthRequest);
            if is_asked {
                self.decoder_bytes.clear();
                return;
            }
        }
    }

    fn answer(&mut self, health: &Health) {
        self.wait_for_question();
        self.line.say(&encode_health(&self.schema, health).unwrap());
    }

    fn report(&mut self, time_us: u32, counter: u8, front: u64) {
        let stamp = Stamp { time_us, counter };
        let values = [(17, vec![Scalar::Unsigned(front)])];
        self.line.say(&encode_stamped_report(&self.schema, stamp, &values).unwrap());
    }
}

#[test]
fn health_becomes_lines_and_warnings() {
    let Some(program) = build("health", &boards(), "Robot") else { return };
    let mut scene = Scene::start(&program, &["--health=0.2"]);
    scene.answer(&healthy());
    scene.monitor.wait_for(
        "health of Robot: up 2 h 1 min, started by power\n  65536 reports sent, 3 refused; load up to 83 %; \
         212 bytes of stack left\n  IRFront  good, 12 ms ago\n  Servo    never set\n  Wheel    good, 1.2 s ago\n",
    );
    assert!(!scene.monitor.output().contains("IRFront: "), "{}", scene.monitor.output());
    // A failure is reported once with its causes, however often it arrives, and once when it is
    // over.
    let mut failed = healthy();
    failed.devices[0].status = Status::Failed;
    failed.devices[0].causes =
        Causes { not_acknowledged: 19, timed_out: 65_535, ..Causes::default() };
    for _ in 0..3 {
        scene.answer(&failed);
    }
    scene.answer(&healthy());
    scene.monitor.wait_for("IRFront: good again\n");
    let output = scene.monitor.output();
    let reported = "IRFront: failed (19 not acknowledged, 65535 or more timed out)\n";
    assert_eq!(output.matches(reported).count(), 1, "{output}");
    assert!(
        output.contains(
            "  IRFront  failed, 12 ms ago: 19 not acknowledged, 65535 or more timed out\n"
        )
    );
    // A reset by the watchdog is reported once for each start.
    let hung = Health {
        uptime_ms: 1_500,
        reset_cause: ResetCause::Watchdog,
        reset_device: 20,
        load_percent: UNKNOWN_LOAD,
        stack_left_bytes: UNKNOWN_STACK,
        ..healthy()
    };
    scene.answer(&hung);
    scene.answer(&Health { uptime_ms: 1_700, ..hung.clone() });
    scene.monitor.wait_for("up 1.7 s, started by its watchdog: the thread of Wheel hung\n  65536 reports sent, 3 refused\n");
    let output = scene.monitor.output();
    let reported = "Robot was reset 1.5 s ago by its watchdog: the thread of Wheel hung\n";
    assert_eq!(output.matches(reported).count(), 1, "{output}");
}

#[test]
fn health_of_another_version_is_told_and_not_believed() {
    let Some(program) = build("health-version", &boards(), "Robot") else { return };
    let mut scene = Scene::start(&program, &["--health=0.2"]);
    let mut failed = healthy();
    failed.devices[0].status = Status::Failed;
    for _ in 0..2 {
        scene.wait_for_question();
        let good = encode_health(&scene.schema, &failed).unwrap();
        let start = good.iter().position(|&byte| byte == 255).unwrap();
        let mut payload = good[start..good.len() - 4].to_vec();
        payload[1] = 2;
        let crc = sensedsl_wire::crc16_ccitt_false(&payload).to_be_bytes();
        payload.extend([255, crc[0], crc[1]]);
        scene.line.say(&[format!("{}:", payload.len()).as_bytes(), &payload, b","].concat());
    }
    scene.wait_for_question();
    let output = scene.monitor.output();
    let reported = "Robot tells its health in version 2, and this program knows version 1: not believed; \
                generate again\n";
    assert_eq!(output.matches(reported).count(), 1, "{output}");
    assert!(!output.contains("health of Robot") && !output.contains("failed"), "{output}");
}

#[test]
fn a_board_without_health_is_told() {
    let Some(program) = build("health-none", &boards(), "Robot") else { return };
    let scene = Scene::start(&program, &["--health"]);
    scene
        .monitor
        .wait_for("Robot does not tell its health: is its firmware older than this program?\n");
}

#[test]
fn stamps_tell_the_time_and_what_was_lost() {
    let Some(program) = build("stamps", &boards(), "Robot") else { return };
    let mut scene = Scene::start(&program, &["--time"]);
    scene.report(1_500_000, 254, 300);
    scene.report(1_520_000, 255, 301);
    // Two reports are lost, and counter and time wrap.
    scene.report(1_580_007, 2, 302);
    scene
        .monitor
        .wait_for("1.500000  IRFront = 300\n1.520000  IRFront = 301\n1.580007  IRFront = 302\n");
    // The board restarts: the reports lost meanwhile cannot be counted.
    scene.report(20, 0, 303);
    scene.report(20_020, 1, 304);
    scene.monitor.wait_for("0.000020  IRFront = 303\n0.020020  IRFront = 304\n");
    let Scene { line, monitor, .. } = scene;
    drop(line);
    // The hello counts as a frame too.
    monitor.wait_for("6 frames, 0 bytes dropped, 2 reports lost\n");
}

#[test]
fn typed_commands_are_held() {
    let Some((_, program)) = build("held", &boards(), "Robot") else { return };
    let mut line = Line::new();
    let schema = boards().remove(0).schema;
    let mut child = Command::new(program)
        .args(["--no-reconnect".as_ref(), line.device.as_os_str()])
        .stdin(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    line.hear(4, LONG);
    line.say(&encode_hello(&schema));
    // The design's silence is 200 ms; a busy machine is sometimes late.
    let (mut frames, start) = (0, Instant::now());
    let mut decoder = Decoder::new(&schema, Direction::Actuator);
    while start.elapsed() < Duration::from_secs(2) {
        decoder.feed(&line.hear(1, Duration::from_millis(50)), |_| frames += 1);
    }
    assert!(frames >= 12, "only {frames} frames in 2 s");
    child.kill().unwrap();
    child.wait().unwrap();
}

#[test]
fn wrong_periods_are_told() {
    let Some((_, program)) = build("health-options", &boards(), "Robot") else { return };
    for (given, problem) in [
        ("--health=never", "how many seconds between questions for health? 0.1 to 3600, not never"),
        ("--health=0.01", "how many seconds between questions for health? 0.1 to 3600, not 0.01"),
        ("--health=", "--health needs a value: --health[=SECONDS]"),
    ] {
        let output = Command::new(&program).args([given, "/dev/null"]).output().unwrap();
        assert_eq!(output.status.code(), Some(2));
        assert_eq!(String::from_utf8_lossy(&output.stderr).trim(), problem);
    }
    let help = printed(Command::new(&program).arg("--help"));
    assert!(help.contains("  --health[=SECONDS]    ask the board for its health"), "{help}");
    assert!(help.lines().skip(1).all(|line| line.len() <= 86), "{help}");
}

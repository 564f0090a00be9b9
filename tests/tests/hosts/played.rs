//! A board on a serial line that the test plays, for programs of generated hosts: it says hello when it is asked, reports,
//! and tells how it is.

use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use sensedsl_wire::{Decoder, Direction, Event, Scalar, Schema, encode_health, encode_report};

use super::terminal::{Line, is_command};

/// Runs a program with the device as its last argument while the test plays the board. Returns what it has commanded, its
/// status, and all that it printed.
pub(super) fn played(
    program: &mut Command,
    schema: &Schema,
    hello: &[u8],
) -> (Vec<Event>, i32, String) {
    let mut line = Line::new();
    let mut child = program
        .arg(&line.device)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut decoder = Decoder::new(schema, Direction::Actuator);
    let values = [(17, vec![Scalar::Unsigned(1_840)]), (18, vec![Scalar::Signed(-3)])];
    let report = encode_report(schema, Direction::Sensor, &values).unwrap();
    let devices = schema.items.iter().map(|item| sensedsl_wire::DeviceHealth {
        id: item.id,
        status: sensedsl_wire::Status::Failed,
        age_ms: 7,
        causes: [1, 2, 3, 4, 5, 6].into(),
    });
    let health = sensedsl_wire::Health {
        uptime_ms: 12_345,
        reset_cause: sensedsl_wire::ResetCause::Watchdog,
        reset_device: 17,
        reports_sent: 5,
        reports_refused: 1,
        load_percent: 40,
        stack_left_bytes: 200,
        devices: devices.collect(),
    };
    let health = encode_health(schema, &health).unwrap();
    let (mut commands, mut is_met) = (Vec::new(), false);
    let start = Instant::now();
    while child.try_wait().unwrap().is_none() {
        assert!(start.elapsed() < Duration::from_secs(30), "it does not end");
        let bytes = line.hear(1, Duration::from_millis(30));
        let mut asked = (false, false);
        decoder.feed(&bytes, |event| {
            asked.0 |= event == Event::HelloRequest;
            asked.1 |= event == Event::HealthRequest;
            commands.extend(Some(event).filter(is_command));
        });
        // A board says hello when it is asked, and its shell answers.
        if asked.0 || bytes.windows(6).any(|word| word == b"schema") {
            is_met = true;
            line.say(hello);
        }
        if asked.1 {
            line.say(&health);
        }
        if is_met {
            line.say(&report);
        }
    }
    let output = child.wait_with_output().unwrap();
    let [out, errors] =
        [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
    (commands, output.status.code().unwrap(), out + &errors)
}

//! Sessions with boards that answer, stay silent, or are others.
#![allow(clippy::unwrap_used, clippy::panic, clippy::indexing_slicing, reason = "a test may panic")]

use std::time::Duration;

use sensedsl_host::{Board, Event, Session, State};
use sensedsl_wire::{
    Checksum, Direction, Health, ResetCause, Scalar, Schema, Stamp, encode_health, encode_hello,
    encode_hello_request, encode_report, encode_stamped_report,
};

fn ms(milliseconds: u64) -> Duration {
    Duration::from_millis(milliseconds)
}

/// A board with a sensor of a cycle of 100 ms, one without a cycle, and an actuator.
fn board(checksum: &str, stamp: bool) -> Board {
    let items = r#"[ { "id": 17, "name": "Light", "direction": "sensor", "type": "uint16", "cycle_ms": 100 },
        { "id": 18, "name": "Edge", "direction": "sensor", "type": "uint32" },
        { "id": 19, "name": "Servo", "direction": "actuator", "type": "int16" } ]"#;
    let text = |hash: &str| {
        format!(
            r#"{{ "version": 2, "boards": [ {{ "name": "Rover", "hash": "{hash}", "checksum": "{checksum}",
                "stamp": {stamp}, "items": {items} }} ] }}"#
        )
    };
    let why = Board::all_of_json(&text("0x")).unwrap_err().to_string();
    let hash = why.split([' ', ',']).find(|word| word.starts_with("0x")).unwrap().to_owned();
    Board::all_of_json(&text(&hash)).unwrap().remove(0)
}

fn light(schema: &Schema, value: u64) -> Vec<u8> {
    encode_report(schema, Direction::Sensor, &[(17, vec![Scalar::Unsigned(value)])]).unwrap()
}

fn fed(session: &mut Session<'_>, bytes: &[u8], now: Duration) -> Vec<Event> {
    let mut events = Vec::new();
    session.feed(bytes, now, &mut |event| events.push(event));
    events
}

fn looked(session: &mut Session<'_>, now: Duration) -> Vec<Event> {
    let mut events = Vec::new();
    session.look(now, &mut |event| events.push(event));
    events
}

#[test]
fn nothing_is_believed_before_the_hello_however_the_stream_is_cut() {
    let board = board("crc16", false);
    let stream = [
        light(&board.schema, 1),
        b"garbage 3:".to_vec(),
        encode_hello(&board.schema),
        light(&board.schema, 2),
        light(&board.schema, 3),
    ]
    .concat();
    let value = |number| Event::Values(None, vec![(0, vec![Scalar::Unsigned(number)])]);
    for cut in 0..=stream.len() {
        let mut session = Session::new(&board, Duration::ZERO);
        let mut events = fed(&mut session, &stream[..cut], ms(1));
        events.extend(fed(&mut session, &stream[cut..], ms(2)));
        assert_eq!(events, [Event::Matched, value(2), value(3)], "cut at {cut}");
        let counts = session.counts();
        assert_eq!((counts.frames, counts.withheld, counts.dropped_bytes), (4, 1, 10));
        assert_eq!(counts.bytes, stream.len() as u64);
    }
}

#[test]
fn a_board_is_asked_until_it_answers() {
    let board = board("none", false);
    let mut session = Session::new(&board, Duration::ZERO);
    let mut asked = Vec::new();
    for now in (0..8_000).step_by(10) {
        let bytes = session.to_send(ms(now));
        if !bytes.is_empty() {
            asked.push((now, bytes));
        }
    }
    let times: Vec<u64> = asked.iter().map(|(now, _)| *now).collect();
    assert_eq!(times[..4], [0, 250, 500, 750]);
    assert_eq!(times[times.len() - 3..], [5_750, 6_750, 7_750]);
    let own = encode_hello_request(&board.schema);
    let others = [Checksum::Crc16, Checksum::Crc32]
        .map(|checksum| encode_hello_request(&Schema { checksum, ..Schema::default() }));
    assert_eq!(asked[0].1, own);
    for other in others {
        assert!(asked.iter().any(|(_, bytes)| *bytes == other));
    }
    assert_eq!(looked(&mut session, ms(8_000)), [Event::Unanswered]);
    assert_eq!(looked(&mut session, ms(9_000)), []);
    assert_eq!(session.state(), State::Asking);
}

#[test]
fn another_board_is_asked_in_what_it_differs() {
    let (board, other) = (board("none", false), board("none", true));
    let hello = encode_hello(&other.schema);
    let mut session = Session::new(&board, Duration::ZERO);
    assert_eq!(fed(&mut session, &hello, ms(100)), []);
    assert_eq!(session.state(), State::Comparing);
    assert_eq!(session.to_send(ms(100)), b"q");
    assert_eq!(session.to_send(ms(200)), b"");
    assert_eq!(session.to_send(ms(250)), b"\rschema\r");
    let answer = other.schema.canonical_text().replace('\n', "\r\n");
    let events = fed(&mut session, format!("ch> schema\r\n{answer}ch> ").as_bytes(), ms(300));
    let differences = vec!["stamp: on on the board, off here".to_owned()];
    assert_eq!(events, [Event::Other { hash: other.schema.hash(), differences }]);
    assert_eq!(session.state(), State::Refused);
    assert_eq!(fed(&mut session, &light(&board.schema, 5), ms(400)), []);
    // Firmware without a shell is known by its hash alone.
    let mut session = Session::new(&board, Duration::ZERO);
    let _ = fed(&mut session, &hello, ms(100));
    assert_eq!(looked(&mut session, ms(2_000)), []);
    let events = looked(&mut session, ms(2_100));
    assert_eq!(events, [Event::Other { hash: other.schema.hash(), differences: Vec::new() }]);
}

#[test]
fn a_board_with_another_checksum_is_told_from_a_silent_one() {
    let (board, other) = (board("none", false), board("crc32", false));
    let mut session = Session::new(&board, Duration::ZERO);
    let hello = encode_hello(&other.schema);
    let _ = fed(&mut session, &hello, ms(10));
    assert_eq!(session.state(), State::Asking);
    let _ = fed(&mut session, &hello, ms(20));
    assert_eq!(session.state(), State::Comparing);
}

#[test]
fn what_does_not_come_is_told_once() {
    let board = board("none", false);
    let mut session = Session::new(&board, Duration::ZERO);
    let _ = fed(&mut session, &encode_hello(&board.schema), ms(0));
    let _ = fed(&mut session, &light(&board.schema, 1), ms(100));
    let edge = encode_report(&board.schema, Direction::Sensor, &[(18, vec![Scalar::Unsigned(4)])])
        .unwrap();
    let _ = fed(&mut session, &edge, ms(450));
    assert_eq!(looked(&mut session, ms(450)), []);
    let _ = fed(&mut session, &edge, ms(600));
    assert_eq!(looked(&mut session, ms(600)), [Event::Overdue(0, ms(500))]);
    assert!(session.is_overdue(0, ms(600)) && !session.is_overdue(1, ms(600)));
    assert_eq!(looked(&mut session, ms(700)), []);
    let events = fed(&mut session, &light(&board.schema, 2), ms(900));
    assert_eq!(events[0], Event::Again(0, ms(800)));
    // A board that says nothing at all may have been restarted: it is asked anew.
    assert_eq!(looked(&mut session, ms(1_900)), []);
    assert_eq!(looked(&mut session, ms(1_901)), [Event::Silent(ms(1_001))]);
    assert_eq!(session.state(), State::Asking);
    assert_eq!(fed(&mut session, &light(&board.schema, 3), ms(2_000)), []);
    assert_eq!(fed(&mut session, &encode_hello(&board.schema), ms(2_100)), [Event::Matched]);
}

#[test]
fn stamps_tell_how_many_reports_were_lost() {
    let board = board("crc16", true);
    let mut session = Session::new(&board, Duration::ZERO);
    let _ = fed(&mut session, &encode_hello(&board.schema), ms(0));
    for counter in [254, 255, 0, 3, 4] {
        let stamp = Stamp { time_us: 1_000, counter };
        let values = [(17, vec![Scalar::Unsigned(1)])];
        let bytes = encode_stamped_report(&board.schema, stamp, &values).unwrap();
        let events = fed(&mut session, &bytes, ms(10));
        assert!(matches!(events[..], [Event::Values(Some(found), _)] if found == stamp));
    }
    assert_eq!(session.counts().lost, 2);
}

#[test]
fn health_is_asked_when_it_is_wanted() {
    let board = board("none", false);
    let mut session = Session::new(&board, Duration::ZERO);
    let _ = session.to_send(ms(0));
    let _ = fed(&mut session, &encode_hello(&board.schema), ms(1));
    // Once when the board is met, and then as often as asked for.
    assert_eq!(session.to_send(ms(2)), b"2:\0\x01,");
    assert_eq!(session.to_send(ms(5_000)), b"");
    session.health_every(ms(500));
    assert_eq!(session.to_send(ms(5_000)), b"2:\0\x01,");
    assert_eq!(session.to_send(ms(5_499)), b"");
    assert_eq!(session.to_send(ms(5_500)), b"2:\0\x01,");
    let devices = board.devices.iter().map(|device| sensedsl_wire::DeviceHealth {
        id: device.id,
        status: sensedsl_wire::Status::Good,
        age_ms: 3,
        causes: sensedsl_wire::Causes::default(),
    });
    let health = Health {
        uptime_ms: 7,
        reset_cause: ResetCause::Power,
        reset_device: 0,
        reports_sent: 1,
        reports_refused: 0,
        load_percent: 5,
        stack_left_bytes: 9,
        devices: devices.collect(),
    };
    let bytes = encode_health(&board.schema, &health).unwrap();
    assert_eq!(fed(&mut session, &bytes, ms(5_600)), [Event::Health(health)]);
}

#[test]
fn a_recording_is_believed_until_a_hello_says_otherwise() {
    let (board, other) = (board("none", false), board("none", true));
    let mut session = Session::recording(&board);
    assert_eq!(session.to_send(ms(0)), b"");
    let events = fed(&mut session, &light(&board.schema, 9), ms(0));
    assert!(matches!(events[..], [Event::Unverified, Event::Values(None, _)]), "{events:?}");
    assert_eq!(fed(&mut session, &light(&board.schema, 9), ms(0)).len(), 1);
    assert_eq!(fed(&mut session, &encode_hello(&board.schema), ms(0)), [Event::Matched]);
    let mut session = Session::recording(&board);
    let events = fed(&mut session, &encode_hello(&other.schema), ms(0));
    assert!(matches!(events[..], [Event::Other { .. }]));
    assert_eq!(session.state(), State::Refused);
}

//! What a sink gets of a run: rates, order, and what happens to one that hangs.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
#![allow(clippy::disallowed_methods, reason = "a test of threads has clocks")]

use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::{Duration, Instant};

use sensedsl_host::{Board, Moment, News, Output as _, Report, What, Wish};
use sensedsl_sinks::command::Command;
use sensedsl_sinks::{Config, Event, Inbox, Next, Outbox, Plan, Relay, Sink};
use sensedsl_wire::Scalar;

const BOARD: &str = r#"{ "version": 2, "boards": [ { "name": "Rover", "hash": "0x00b4763a", "checksum": "none",
    "items": [ { "id": 17, "name": "Light", "direction": "sensor", "type": "uint16", "scale": 0.1 } ] } ] }"#;

/// Passes all events on to the test, after it was let go.
struct Told(Sender<Event>, Receiver<()>);

impl Sink for Told {
    fn run(self: Box<Self>, inbox: &Inbox, outbox: &Outbox) {
        let _ = self.1.recv();
        outbox.broken("it does not work", "wait");
        outbox.broken("it does not work", "wait");
        outbox.works();
        let (name, text) = ("Servo".to_owned(), "5".to_owned());
        outbox.set(Command { board: 0, index: 0, name, text }).unwrap();
        loop {
            match inbox.next(Duration::from_millis(100)) {
                Next::Event(event) => self.0.send(event).unwrap(),
                Next::Nothing => {}
                Next::Over => return,
            }
        }
    }
}

fn relay(rate_hz: Option<f64>) -> (Relay, Receiver<Event>, Sender<()>) {
    let boards = Board::all_of_json(BOARD).unwrap();
    let plan = Arc::new(Plan::new(&boards, &Config::default(), rate_hz));
    let (tell, told) = channel();
    let (go, wait) = channel();
    (Relay::start("Told", plan, Box::new(Told(tell, wait))), told, go)
}

fn at(run_ms: u64) -> Moment {
    let run = Duration::from_millis(run_ms);
    Moment { run, unix: Duration::from_secs(1_000) + run }
}

fn light(relay: &mut Relay, run_ms: u64, code: u64) {
    let values = vec![(0, vec![Scalar::Unsigned(code)])];
    let report = Report { stamp: None, latency: Some(Duration::from_millis(3)), values };
    relay.take(&News { board: 0, at: at(run_ms), what: What::Report(&report) });
}

/// The time and the code of each value.
fn values(told: &Receiver<Event>) -> Vec<(u128, u64)> {
    let of = |event| {
        let Event::Values(values) = event else { return None };
        let (_, raw) = values.values.first()?;
        let Scalar::Unsigned(code) = *raw.first()? else { return None };
        Some((values.taken.as_millis() - 1_000_000, code))
    };
    told.try_iter().filter_map(of).collect()
}

#[test]
fn all_values_pass_with_the_time_when_they_were_taken() {
    let (mut relay, told, go) = relay(None);
    go.send(()).unwrap();
    for number in 0..500 {
        light(&mut relay, 3 + number, number);
    }
    let wishes = relay.close(at(600));
    assert_eq!(values(&told), (0..500).map(|number| (number.into(), number)).collect::<Vec<_>>());
    // What was broken is told once, with its code, and what works again as well.
    let [Wish::Trouble { what, help }, Wish::Note(note), Wish::Set { name, text, .. }] =
        &wishes[..]
    else {
        panic!("{wishes:?}")
    };
    assert_eq!((what.as_str(), help.as_str()), ("Told: it does not work (E0567)", "wait"));
    assert_eq!((note.as_str(), name.as_str(), text.as_str()), ("Told: works again", "Servo", "5"));
}

#[test]
fn a_rate_thins_values_out_and_the_last_one_still_comes() {
    let (mut relay, told, go) = relay(Some(10.0));
    go.send(()).unwrap();
    // 1000 a second for a second.
    for number in 0..1_000 {
        light(&mut relay, 3 + number, number);
        let _ = relay.look(at(3 + number));
    }
    for after in 0..20 {
        let _ = relay.look(at(1_000 + 10 * after));
    }
    let _ = relay.close(at(1_200));
    let found = values(&told);
    assert!((10..=13).contains(&found.len()), "{found:?}");
    assert_eq!(found.last().unwrap().1, 999);
    // The last one had no values behind it: it came as soon as the rate let it.
    let mut gaps = found[..found.len() - 1].windows(2).map(|pair| pair[1].1 - pair[0].1);
    assert!(gaps.all(|gap| (90..=110).contains(&gap)), "{found:?}");
}

#[test]
fn a_sink_that_hangs_stops_nobody_and_loses_values_alone() {
    let (mut relay, told, go) = relay(None);
    let start = Instant::now();
    for number in 0..5_000 {
        light(&mut relay, number, number);
    }
    relay.take(&News { board: 0, at: at(5_000), what: What::Offline("unplugged") });
    assert!(start.elapsed() < Duration::from_secs(1), "it has waited");
    go.send(()).unwrap();
    std::thread::sleep(Duration::from_millis(300));
    let wishes = relay.close(at(6_000));
    let told: Vec<Event> = told.try_iter().collect();
    let gone = Event::Presence { board: 0, away: Some("unplugged".to_owned()) };
    assert_eq!(told.last(), Some(&gone));
    let missed = 5_000 - (told.len() - 1);
    let note = Wish::Note(format!("Told: {missed} reports did not fit its queue"));
    assert!(missed > 3_000 && wishes.contains(&note), "{missed}: {wishes:?}");
}

#[test]
fn a_sink_that_never_ends_is_left_alone() {
    let (mut relay, _told, _go) = relay(None);
    let start = Instant::now();
    let _ = relay.close(at(0));
    assert!(start.elapsed() < Duration::from_secs(3));
}

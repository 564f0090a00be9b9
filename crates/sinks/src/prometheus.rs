//! Prometheus: values, presence and health in, the latest of all as text over HTTP out, whenever somebody asks.
//!
//! The text is the exposition format of Prometheus, version 0.0.4. Each request has a thread of its own, which makes the
//! text from what the sink's thread has kept. The names are written down in `docs/sinks/prometheus.md`.

use std::fmt::Write as _;
use std::io::{self, Read as _, Write as _};
use std::net::{SocketAddr, TcpStream};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use sensedsl_limits::CLIENTS_MAX;
use sensedsl_wire::NEVER_MS;

use crate::config::Settings;
use crate::event::{Event, Inbox, Next, Outbox, Sink};
use crate::listener::Listener;
use crate::picture::Picture;
use crate::plan::{Place, Plan, seconds};

/// How long the sink waits for an event before it looks whether somebody asks.
const WAIT: Duration = Duration::from_millis(20);
/// How long somebody may take to ask, and to take the answer.
const ASKS_WITHIN: Duration = Duration::from_secs(3);
/// The most bytes of a request.
const HEAD_BYTES_MAX: usize = 8 << 10;

/// The server.
#[derive(Debug)]
pub(crate) struct Prometheus {
    plan: Arc<Plan>,
    listen: SocketAddr,
}

/// What is known.
struct Known {
    picture: Picture,
    /// How many values came of each device.
    counts: Vec<Vec<u64>>,
}

impl Prometheus {
    /// With what a configuration says; none if its address is not one.
    #[must_use]
    pub(crate) fn new(settings: &Settings, plan: Arc<Plan>) -> Option<Self> {
        let listen = crate::config::listening(settings.text("listen")).ok()?;
        Some(Self { plan, listen })
    }
}

impl Sink for Prometheus {
    fn run(self: Box<Self>, inbox: &Inbox, outbox: &Outbox) {
        let counts = self.plan.boards.iter().map(|on| vec![0; on.routes.len()]).collect();
        let known = Arc::new(Mutex::new(Known { picture: Picture::new(&self.plan), counts }));
        let alive = Arc::new(AtomicUsize::new(0));
        let mut listener = Listener::new(self.listen, false);
        loop {
            match inbox.next(WAIT) {
                Next::Event(event) => {
                    known.lock().unwrap_or_else(PoisonError::into_inner).take(&event);
                }
                Next::Nothing => {}
                Next::Over => return,
            }
            for stream in listener.accept(outbox, &|at| format!("http://{at}/metrics")) {
                if alive.load(Ordering::Relaxed) < CLIENTS_MAX {
                    serve(stream, Arc::clone(&self.plan), Arc::clone(&known), Arc::clone(&alive));
                }
            }
        }
    }
}

impl Known {
    fn take(&mut self, event: &Event) {
        if let Event::Values(values) = event
            && let Some(counts) = self.counts.get_mut(values.board)
        {
            for (index, _) in &values.values {
                if let Some(count) = counts.get_mut(*index) {
                    *count += 1;
                }
            }
        }
        self.picture.take(event);
    }
}

/// Answers one who asks.
fn serve(
    mut stream: TcpStream,
    plan: Arc<Plan>,
    known: Arc<Mutex<Known>>,
    alive: Arc<AtomicUsize>,
) {
    alive.fetch_add(1, Ordering::Relaxed);
    let _ = std::thread::spawn(move || {
        // One that breaks off has no use for an answer.
        let _ = answer(&mut stream, &plan, &known);
        alive.fetch_sub(1, Ordering::Relaxed);
    });
}

fn answer(stream: &mut TcpStream, plan: &Plan, known: &Mutex<Known>) -> io::Result<()> {
    stream.set_nonblocking(false)?;
    stream.set_read_timeout(Some(ASKS_WITHIN))?;
    stream.set_write_timeout(Some(ASKS_WITHIN))?;
    let (mut head, mut bytes, began) = (Vec::new(), [0; 1_024], Instant::now());
    while !head.windows(4).any(|four| four == b"\r\n\r\n") {
        let count = stream.read(&mut bytes)?;
        head.extend_from_slice(bytes.get(..count).unwrap_or_default());
        if count == 0 || head.len() > HEAD_BYTES_MAX || began.elapsed() > ASKS_WITHIN {
            return Err(io::Error::other("no head"));
        }
    }
    let (status, body) = if head.starts_with(b"GET /metrics ") {
        ("200 OK", text(plan, &known.lock().unwrap_or_else(PoisonError::into_inner)))
    } else {
        ("404 Not Found", "the values are at /metrics\n".to_owned())
    };
    let length = body.len();
    let head = format!(
        "HTTP/1.1 {status}\r\nContent-Type: text/plain; version=0.0.4; charset=utf-8\r\nContent-Length: \
         {length}\r\nConnection: close\r\n\r\n"
    );
    stream.write_all(head.as_bytes())?;
    stream.write_all(body.as_bytes())?;
    stream.shutdown(std::net::Shutdown::Write)
}

/// All that is known, in the exposition format: the samples of a family stand together.
fn text(plan: &Plan, known: &Known) -> String {
    let mut text = String::new();
    values(&mut text, plan, known);
    boards(&mut text, plan, known);
    text
}

fn values(text: &mut String, plan: &Plan, known: &Known) {
    let latest = || {
        plan.places().filter_map(|place| {
            let board = known.picture.boards.get(place.board)?;
            Some((place, board.latest.get(place.index)?.as_ref()?))
        })
    };
    family(
        text,
        "sensedsl_value",
        "gauge",
        "Latest value of a device in its unit; a bool is 0 or 1.",
    );
    for (place, values) in latest() {
        let raws = values.values.iter().flat_map(|(_, raw)| raw);
        for (element, raw) in raws.enumerate() {
            let element = place.device.value.length.map(|_| element.to_string());
            let labels = labels(&place, element.as_deref());
            sample(text, "sensedsl_value", &labels, &real(place.number(*raw)));
        }
    }
    family(
        text,
        "sensedsl_value_timestamp_seconds",
        "gauge",
        "When the latest value was taken, since 1970.",
    );
    for (place, values) in latest() {
        let name = "sensedsl_value_timestamp_seconds";
        sample(text, name, &labels(&place, None), &real(seconds(values.taken)));
    }
    family(text, "sensedsl_values_total", "counter", "Values of a device that came.");
    for place in plan.places() {
        let counts = known.counts.get(place.board);
        let count = counts.and_then(|counts| counts.get(place.index)).copied().unwrap_or_default();
        sample(text, "sensedsl_values_total", &labels(&place, None), &count.to_string());
    }
}

fn boards(text: &mut String, plan: &Plan, known: &Known) {
    let all = || plan.boards.iter().zip(&known.picture.boards);
    let named = |name: &str| format!("board=\"{}\"", escaped(name));
    family(text, "sensedsl_board_online", "gauge", "Whether a board is there.");
    for (on, state) in all() {
        let is_online = u8::from(state.is_online).to_string();
        sample(text, "sensedsl_board_online", &named(&on.board.name), &is_online);
    }
    let told = || all().filter_map(|(on, state)| Some((on, state.health.as_ref()?)));
    family(text, "sensedsl_board_uptime_seconds", "gauge", "How long a board has run.");
    for (on, health) in told() {
        let uptime_s = real(f64::from(health.uptime_ms) / 1e3);
        sample(text, "sensedsl_board_uptime_seconds", &named(&on.board.name), &uptime_s);
    }
    family(
        text,
        "sensedsl_board_load_percent",
        "gauge",
        "The highest load of a board's processor.",
    );
    for (on, health) in told().filter(|(_, health)| health.load_percent != u8::MAX) {
        let load = health.load_percent.to_string();
        sample(text, "sensedsl_board_load_percent", &named(&on.board.name), &load);
    }
    let devices = || {
        told().flat_map(|(on, health)| {
            health.devices.iter().filter_map(move |one| {
                let device = on.board.devices.iter().find(|device| device.id == one.id)?;
                let board = named(&on.board.name);
                Some((format!("{board},device=\"{}\"", escaped(&device.name)), one))
            })
        })
    };
    family(text, "sensedsl_device_failures_total", "counter", "Readings of a device that failed.");
    for (labels, one) in devices() {
        let failures: u32 = one.causes.counts().into_iter().map(u32::from).sum();
        sample(text, "sensedsl_device_failures_total", &labels, &failures.to_string());
    }
    let name = "sensedsl_device_age_seconds";
    family(text, name, "gauge", "How old a device's value was when the board told its health.");
    for (labels, one) in devices().filter(|(_, one)| u64::from(one.age_ms) != u64::from(NEVER_MS)) {
        sample(text, name, &labels, &real(f64::from(one.age_ms) / 1e3));
    }
}

fn labels(place: &Place<'_>, element: Option<&str>) -> String {
    let mut labels = format!(
        "board=\"{}\",device=\"{}\",topic=\"{}\"",
        escaped(&place.on.board.name),
        escaped(&place.device.name),
        escaped(&place.route.topic)
    );
    if let Some(unit) = &place.route.unit {
        let _ = write!(labels, ",unit=\"{}\"", escaped(unit));
    }
    if let Some(element) = element {
        let _ = write!(labels, ",element=\"{element}\"");
    }
    labels
}

fn family(text: &mut String, name: &str, sort: &str, help: &str) {
    let _ = writeln!(text, "# HELP {name} {help}\n# TYPE {name} {sort}");
}

fn sample(text: &mut String, name: &str, labels: &str, value: &str) {
    let _ = writeln!(text, "{name}{{{labels}}} {value}");
}

/// A number as the format spells it.
fn real(number: f64) -> String {
    if number.is_nan() {
        "NaN".to_owned()
    } else if number.is_infinite() {
        if number > 0.0 { "+Inf" } else { "-Inf" }.to_owned()
    } else {
        number.to_string()
    }
}

/// A label's text.
fn escaped(text: &str) -> String {
    text.replace('\\', "\\\\").replace('"', "\\\"").replace('\n', "\\n")
}

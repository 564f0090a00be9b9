//! PlotJuggler: values in, JSON in UDP datagrams out, as the streaming plugin "UDP Server" of PlotJuggler reads them.
//!
//! A datagram has the values of one report below the words of their topics, so that the plugin names them
//! `/Rover/Light`, and their time as `timestamp`. Nothing tells whether somebody listens: UDP has no answer.

use std::net::{SocketAddr, ToSocketAddrs as _, UdpSocket};
use std::sync::Arc;
use std::time::{Duration, Instant};

use serde_json::{Map, Value};

use crate::config::{Address, Settings};
use crate::event::{Event, Inbox, Next, Outbox, Sink, Values};
use crate::plan::{Plan, nest, seconds};

/// How often it is looked whether there is something to do.
const WAIT: Duration = Duration::from_millis(500);
/// How long a name that is not found is not looked for again.
const LOOK_AGAIN_AFTER: Duration = Duration::from_secs(2);
/// The most bytes of a UDP datagram.
const DATAGRAM_BYTES_MAX: usize = 65_507;

/// The way to PlotJuggler.
#[derive(Debug)]
pub(crate) struct PlotJuggler {
    plan: Arc<Plan>,
    to: Address,
    socket: Option<UdpSocket>,
    failed: Option<Instant>,
}

impl PlotJuggler {
    /// With what a configuration says; none if its address is not one.
    #[must_use]
    pub(crate) fn new(settings: &Settings, plan: Arc<Plan>) -> Option<Self> {
        let to = crate::config::remote(settings.text("to"), None).ok()?;
        Some(Self { plan, to, socket: None, failed: None })
    }

    fn connected(&mut self) -> std::io::Result<&UdpSocket> {
        if self.socket.is_none() {
            let found = (self.to.host.as_str(), self.to.port).to_socket_addrs()?.next();
            let to = found.ok_or_else(|| std::io::Error::other("the name has no address"))?;
            let own: SocketAddr = match to {
                SocketAddr::V4(_) => ([0, 0, 0, 0], 0).into(),
                SocketAddr::V6(_) => ([0_u16; 8], 0).into(),
            };
            let socket = UdpSocket::bind(own)?;
            socket.connect(to)?;
            socket.set_nonblocking(true)?;
            self.socket = Some(socket);
        }
        self.socket.as_ref().ok_or_else(|| std::io::Error::other("no socket"))
    }

    fn send(&mut self, values: &Values, outbox: &Outbox) {
        if self.failed.is_some_and(|failed| failed.elapsed() < LOOK_AGAIN_AFTER) {
            return;
        }
        self.failed = None;
        let text = datagram(&self.plan, values).to_string();
        let to = self.to.clone();
        if text.len() > DATAGRAM_BYTES_MAX {
            let what = format!("a report of {} bytes does not fit a datagram", text.len());
            return outbox.broken(&what, "leave a long array out: `leave_out = true`");
        }
        let sent = self.connected().and_then(|socket| socket.send(text.as_bytes()));
        match sent {
            Ok(_) => outbox.works(),
            Err(error) if error.kind() == std::io::ErrorKind::ConnectionRefused => {
                let help = "start its UDP server: Streaming, UDP Server, JSON";
                outbox.broken(&format!("nobody listens at {to}"), help);
                // This is the answer to the datagram before; what it kept from going out goes out now.
                let _ = self.connected().and_then(|socket| socket.send(text.as_bytes()));
            }
            Err(error) if error.kind() == std::io::ErrorKind::WouldBlock => {}
            Err(error) => {
                self.socket = None;
                self.failed = Some(Instant::now());
                outbox.broken(&format!("cannot send to {to}: {error}"), "trying again");
            }
        }
    }
}

/// The values of a report, below the words of their topics.
fn datagram(plan: &Plan, values: &Values) -> Value {
    let mut object = Map::new();
    object.insert("timestamp".to_owned(), seconds(values.taken).into());
    for (place, raw) in plan.of(values) {
        nest(&mut object, &place.route.topic, place.json(raw));
    }
    object.into()
}

impl Sink for PlotJuggler {
    fn run(mut self: Box<Self>, inbox: &Inbox, outbox: &Outbox) {
        loop {
            match inbox.next(WAIT) {
                Next::Event(Event::Values(values)) => self.send(&values, outbox),
                Next::Event(Event::Presence { .. } | Event::Health { .. }) | Next::Nothing => {}
                Next::Over => return,
            }
        }
    }
}

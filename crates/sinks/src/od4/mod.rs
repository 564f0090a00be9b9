//! OD4: values in, messages of an OD4 session out, as the generated host for libcluon sends them, and its commands back.
//!
//! A session is a multicast group. A message of it is an envelope with a number, the message itself, times and a stamp
//! of its sender; `proto.rs` has its bytes. Numbers and fields are those of the generated `sense.odvd`.

mod proto;

use std::io;
use std::net::{Ipv4Addr, SocketAddr, SocketAddrV4, UdpSocket};
use std::sync::Arc;
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use sensedsl_wire::{Scalar, ScalarType};
use serde_json::Value;
use socket2::{Domain, Protocol, Socket, Type};

use crate::command;
use crate::config::Settings;
use crate::event::{Event, Inbox, Next, Outbox, Refusals, Sink, Values};
use crate::plan::{Place, Plan};
use proto::{Field, Raw};

/// What is added to an identifier to give the number of its message.
const NUMBER_BASE: u32 = 21_000;
/// The first bytes of an envelope.
const MAGIC: [u8; 2] = [0x0d, 0xa4];
/// The most bytes of a datagram.
const DATAGRAM_BYTES_MAX: usize = 65_507;
/// How long the sink waits for an event before it looks for commands.
const WAIT: Duration = Duration::from_millis(5);
/// How often a group that cannot be joined is tried again.
const JOIN_EVERY: Duration = Duration::from_secs(2);

/// The way to a session.
#[derive(Debug)]
pub(crate) struct Od4 {
    plan: Arc<Plan>,
    group: SocketAddrV4,
    interface: Ipv4Addr,
    takes_commands: bool,
}

/// The two ends of a session: what is sent, and what is heard.
struct Session {
    out: UdpSocket,
    heard: UdpSocket,
}

impl Od4 {
    /// With what a configuration says; none if its address is not one.
    #[must_use]
    pub(crate) fn new(settings: &Settings, plan: Arc<Plan>) -> Option<Self> {
        let interface = crate::config::listening(settings.text("interface")).ok()?;
        let SocketAddr::V4(interface) = interface else { return None };
        let cid = u8::try_from(settings.whole("cid")).ok()?;
        let group = SocketAddrV4::new(Ipv4Addr::new(225, 0, 0, cid), interface.port());
        let (interface, takes_commands) = (*interface.ip(), settings.flag("commands"));
        Some(Self { plan, group, interface, takes_commands })
    }

    fn join(&self) -> io::Result<Session> {
        let out = Socket::new(Domain::IPV4, Type::DGRAM, Some(Protocol::UDP))?;
        if !self.interface.is_unspecified() {
            out.set_multicast_if_v4(&self.interface)?;
        }
        out.bind(&SocketAddr::from((self.interface, 0)).into())?;
        let heard = Socket::new(Domain::IPV4, Type::DGRAM, Some(Protocol::UDP))?;
        // Other programs of this machine are in the session as well.
        heard.set_reuse_address(true)?;
        heard.set_nonblocking(true)?;
        // Bound to the group, it gets nothing of other groups; Windows does not know that.
        let own = if cfg!(windows) { Ipv4Addr::UNSPECIFIED } else { *self.group.ip() };
        heard.bind(&SocketAddr::from((own, self.group.port())).into())?;
        heard.join_multicast_v4(self.group.ip(), &self.interface)?;
        Ok(Session { out: out.into(), heard: heard.into() })
    }

    fn send(&self, session: &Session, values: &Values) -> io::Result<()> {
        for (place, raw) in self.plan.of(values).filter(|(place, _)| !place.is_actuator()) {
            let message = proto::write(&fields(&place, raw));
            let now = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
            let bytes =
                envelope(number(&place), message, now, values.taken, place.device.id.into());
            if bytes.len() <= DATAGRAM_BYTES_MAX {
                session.out.send_to(&bytes, self.group)?;
            }
        }
        Ok(())
    }

    /// Takes commands that came.
    fn hear(&self, session: &Session, outbox: &Outbox, refusals: &mut Refusals) {
        let mut bytes = vec![0; DATAGRAM_BYTES_MAX];
        while let Ok((count, _)) = session.heard.recv_from(&mut bytes) {
            let Some((number_heard, message)) = opened(bytes.get(..count).unwrap_or_default())
            else {
                continue;
            };
            let mut actuators = self.plan.places().filter(Place::is_actuator);
            let Some(place) = actuators.find(|place| number(place) == number_heard) else {
                continue;
            };
            if let Err(why) = self.command(&place, message, outbox) {
                refusals.tell(outbox, format!("{} not set: {why}", place.device.name));
            }
        }
    }

    fn command(&self, place: &Place<'_>, message: &[u8], outbox: &Outbox) -> Result<(), String> {
        let wanted = wanted(place, message)?;
        outbox.set(command::of_json(place, &wanted)?)
    }
}

impl Sink for Od4 {
    fn run(self: Box<Self>, inbox: &Inbox, outbox: &Outbox) {
        let (mut session, mut tried) = (None, None::<Instant>);
        let mut refusals = Refusals::default();
        let help =
            "look at the network: OD4 needs multicast (`ip route` on Linux), or set `interface`";
        loop {
            if session.is_none() && tried.is_none_or(|tried| tried.elapsed() >= JOIN_EVERY) {
                tried = Some(Instant::now());
                match self.join() {
                    Ok(joined) => session = Some(joined),
                    Err(error) => outbox.broken(&format!("{}: {error}", self.group), help),
                }
            }
            let next = inbox.next(WAIT);
            if matches!(next, Next::Over) {
                return;
            }
            let Some(joined) = &session else { continue };
            if let Next::Event(Event::Values(values)) = next {
                match self.send(joined, &values) {
                    Ok(()) => outbox.works(),
                    Err(error) => outbox.broken(&format!("{}: {error}", self.group), help),
                }
            }
            if self.takes_commands {
                self.hear(joined, outbox, &mut refusals);
                refusals.look(outbox);
            }
        }
    }
}

fn number(place: &Place<'_>) -> u32 {
    NUMBER_BASE + u32::from(place.device.id)
}

/// Whether a value is shown besides the raw one, which then has fields of its own.
fn has_value(place: &Place<'_>) -> bool {
    place.device.quantity.is_some() || !place.device.scale.is_plain()
}

/// The fields of a sensor's message: its raw elements, and after them the shown ones.
fn fields(place: &Place<'_>, raw: &[Scalar]) -> Vec<(u32, Field)> {
    let raws = raw.iter().map(|one| match *one {
        Scalar::Bool(flag) => Field::Unsigned(flag.into()),
        Scalar::Unsigned(number) => Field::Unsigned(number),
        Scalar::Signed(number) => Field::Signed(number),
        Scalar::Float32(number) => Field::Float(number),
        Scalar::Float64(number) => Field::Double(number),
    });
    let shown =
        raw.iter().filter(|_| has_value(place)).map(|one| Field::Double(place.number(*one)));
    (1..).zip(raws.chain(shown)).collect()
}

fn time(since_1970: Duration) -> Field {
    let seconds = i64::try_from(since_1970.as_secs()).unwrap_or_default();
    let microseconds = i64::from(since_1970.subsec_micros());
    Field::Bytes(proto::write(&[(1, Field::Signed(seconds)), (2, Field::Signed(microseconds))]))
}

fn envelope(
    number: u32,
    message: Vec<u8>,
    sent: Duration,
    sampled: Duration,
    stamp: u64,
) -> Vec<u8> {
    let envelope = proto::write(&[
        (1, Field::Signed(number.into())),
        (2, Field::Bytes(message)),
        (3, time(sent)),
        (4, time(Duration::ZERO)),
        (5, time(sampled)),
        (6, Field::Unsigned(stamp)),
    ]);
    let mut bytes = MAGIC.to_vec();
    bytes.extend((envelope.len() as u32).to_le_bytes().iter().take(3));
    bytes.extend(envelope);
    bytes
}

/// The number and the message of an envelope.
fn opened(bytes: &[u8]) -> Option<(u32, &[u8])> {
    let (head, envelope) = bytes.split_at_checked(5)?;
    let &[first, second, a, b, c] = head else { return None };
    let length = u32::from_le_bytes([a, b, c, 0]) as usize;
    if [first, second] != MAGIC || length != envelope.len() {
        return None;
    }
    let fields = proto::read(envelope)?;
    let of = |wanted| fields.iter().rev().find(|(number, _)| *number == wanted).map(|one| one.1);
    match (of(1), of(2)) {
        (Some(Raw::Varint(number)), Some(Raw::Bytes(message))) => {
            Some((u32::try_from(proto::signed(number)).ok()?, message))
        }
        _ => None,
    }
}

/// What a message wants an actuator to be set to: shown values, or codes.
fn wanted(place: &Place<'_>, message: &[u8]) -> Result<Value, String> {
    let fields = proto::read(message).ok_or("the message is damaged")?;
    let count = u32::try_from(place.device.value.count()).map_err(|why| why.to_string())?;
    let of =
        |wanted: u32| fields.iter().rev().find(|(number, _)| *number == wanted).map(|one| one.1);
    let raws: Vec<String> = (1..=count)
        .map(|number| code(place.device.value.scalar, of(number)))
        .collect::<Option<_>>()
        .ok_or("a field has another type")?;
    let codes = || Value::String(format!("raw {}", raws.join(" ")));
    if place.is_bool() {
        return Ok(Value::String(raws.join(" ")));
    }
    let is_raw = matches!(of(2 * count + 1), Some(Raw::Varint(1)));
    if is_raw || !has_value(place) {
        return Ok(codes());
    }
    if raws.iter().any(|raw| raw.parse() != Ok(0.0)) {
        return Err("`raw` is set and `is_raw` is not: set both, or `value` alone".to_owned());
    }
    let shown: Option<Vec<Value>> = (count + 1..=2 * count)
        .map(|number| match of(number) {
            Some(Raw::Fixed64(bytes)) => Some(Value::from(f64::from_le_bytes(bytes))),
            None => Some(Value::from(0.0)),
            Some(Raw::Varint(_) | Raw::Fixed32(_) | Raw::Bytes(_)) => None,
        })
        .collect();
    let shown = shown.ok_or("a field has another type")?;
    Ok(match place.device.value.length {
        Some(_) => Value::Array(shown),
        None => shown.into_iter().next().unwrap_or_default(),
    })
}

/// A code as it is typed; one that is left out is zero.
fn code(scalar: ScalarType, raw: Option<Raw<'_>>) -> Option<String> {
    let is_signed = scalar.integer_range().is_some_and(|(least, _)| least < 0);
    Some(match raw {
        None if scalar == ScalarType::Bool => "false".to_owned(),
        None => "0".to_owned(),
        Some(Raw::Varint(number)) if scalar == ScalarType::Bool => (number != 0).to_string(),
        Some(Raw::Varint(number)) if is_signed => proto::signed(number).to_string(),
        Some(Raw::Varint(number)) => number.to_string(),
        Some(Raw::Fixed32(bytes)) => f32::from_le_bytes(bytes).to_string(),
        Some(Raw::Fixed64(bytes)) => f64::from_le_bytes(bytes).to_string(),
        Some(Raw::Bytes(_)) => return None,
    })
}

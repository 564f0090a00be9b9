//! Foxglove: values in, channels of Foxglove's WebSocket protocol out, and what is published to actuators back.
//!
//! Messages about the connection are JSON in text, values are JSON behind a few bytes that say of what and when, as the
//! published protocol has it. The topics are written down in `docs/sinks/foxglove.md`.

use std::collections::BTreeMap;
use std::net::SocketAddr;
use std::sync::Arc;
use std::sync::mpsc::{SyncSender, TrySendError, sync_channel};
use std::time::Duration;

use serde_json::{Value, json};
use tungstenite::Message;

use crate::command;
use crate::config::Settings;
use crate::event::{Event, Inbox, Next, Outbox, Sink, Values};
use crate::listener::Listener;
use crate::picture::Picture;
use crate::plan::{Place, Plan};
use crate::websocket::{Door, REQUESTS_MAX, Request, Terms};

/// How long the hub waits for an event before it looks at clients.
const WAIT: Duration = Duration::from_millis(5);
/// The protocol's name.
const PROTOCOL: &str = "foxglove.sdk.v1";
/// Where Foxglove's own pages and its program come from.
const ORIGINS: [&str; 2] = ["https://app.foxglove.dev", "file://"];
/// What begins a message with a value, in both directions.
const MESSAGE_DATA: u8 = 1;
/// The most channels that one client may subscribe to or publish on.
const CLIENT_CHANNELS_MAX: usize = 4_096;

/// A server for Foxglove.
#[derive(Debug)]
pub(crate) struct Foxglove {
    plan: Arc<Plan>,
    listen: SocketAddr,
    origins: Vec<String>,
    takes_commands: bool,
}

struct Client {
    number: u64,
    to: SyncSender<Message>,
    /// The client's number of a subscription, and the channel that it is of.
    subscriptions: BTreeMap<u32, u32>,
    /// The client's number of a channel of its own, and its topic.
    published: BTreeMap<u32, String>,
}

struct Hub<'a> {
    plan: &'a Plan,
    takes_commands: bool,
    outbox: &'a Outbox,
    picture: Picture,
    clients: Vec<Client>,
    /// The channel of each device.
    channels: BTreeMap<(usize, usize), u32>,
}

impl Foxglove {
    /// With what a configuration says; none if its address is not one.
    #[must_use]
    pub(crate) fn new(settings: &Settings, plan: Arc<Plan>) -> Option<Self> {
        let listen = crate::config::listening(settings.text("listen")).ok()?;
        let mut origins = settings.texts("origins").to_vec();
        origins.extend(ORIGINS.map(str::to_owned));
        Some(Self { plan, listen, origins, takes_commands: settings.flag("commands") })
    }
}

impl Sink for Foxglove {
    fn run(self: Box<Self>, inbox: &Inbox, outbox: &Outbox) {
        let (to_hub, requests) = sync_channel(REQUESTS_MAX);
        let places = self.plan.places().map(|place| (place.board, place.index));
        let mut hub = Hub {
            plan: &self.plan,
            takes_commands: self.takes_commands,
            outbox,
            picture: Picture::new(&self.plan),
            clients: Vec::new(),
            channels: places.zip(1..).collect(),
        };
        let terms = Terms { origins: self.origins.clone(), protocol: Some(PROTOCOL) };
        let listener = Listener::new(self.listen, self.takes_commands);
        let mut door = Door::new(listener, terms);
        loop {
            door.tend(&to_hub, outbox, &|at| format!("ws://{at}"));
            match inbox.next(WAIT) {
                Next::Event(event) => hub.take(&event),
                Next::Nothing => {}
                Next::Over => return,
            }
            while let Ok(request) = requests.try_recv() {
                hub.hear(request);
            }
        }
    }
}

impl Hub<'_> {
    fn take(&mut self, event: &Event) {
        self.picture.take(event);
        match event {
            Event::Values(values) => self.values(values),
            Event::Presence { board, away } => {
                let Some(on) = self.plan.board(*board) else { return };
                let (level, what) = match away {
                    None => (0, "is there"),
                    Some(why) => (1, why.as_str()),
                };
                let told = status(level, &format!("{}: {what}", on.board.name));
                self.clients.retain(|client| is_read(client, &told));
            }
            Event::Health { .. } => {}
        }
    }

    /// Sends values to all who have subscribed to them. One that does not read is let go.
    fn values(&mut self, values: &Values) {
        let (plan, channels, outbox) = (self.plan, &self.channels, self.outbox);
        self.clients.retain(|client| {
            for (place, raw) in plan.of(values) {
                let Some(channel) = channels.get(&(place.board, place.index)) else { continue };
                let wanted = client.subscriptions.iter().filter(|(_, of)| *of == channel);
                for (subscription, _) in wanted {
                    let message = value(*subscription, &place, values, raw);
                    if !is_read(client, &message) {
                        outbox.note("a client was too slow and was let go");
                        return false;
                    }
                }
            }
            true
        });
    }

    fn hear(&mut self, request: Request) {
        match request {
            Request::Open(number, to) => {
                let (subscriptions, published) = (BTreeMap::new(), BTreeMap::new());
                let client = Client { number, to, subscriptions, published };
                if is_read(&client, &self.info()) && is_read(&client, &self.advertised()) {
                    self.clients.push(client);
                }
            }
            Request::Closed(number, _) => self.clients.retain(|one| one.number != number),
            Request::Text(number, text) => {
                let told =
                    serde_json::from_str(&text).ok().and_then(|asked| self.asked(number, &asked));
                if told.is_none() {
                    self.refuse(number, "the message is not of the protocol");
                }
            }
            Request::Binary(number, bytes) => {
                if let Err(why) = self.published(number, &bytes) {
                    self.refuse(number, &why);
                }
            }
        }
    }

    fn info(&self) -> Message {
        let capabilities = if self.takes_commands { vec!["clientPublish"] } else { Vec::new() };
        let name = concat!("sensedsl ", env!("CARGO_PKG_VERSION"));
        let info = json!({ "op": "serverInfo", "name": name, "capabilities": capabilities,
            "supportedEncodings": ["json"] });
        Message::text(info.to_string())
    }

    fn advertised(&self) -> Message {
        let channels = self.plan.places().filter_map(|place| {
            let id = self.channels.get(&(place.board, place.index))?;
            let (name, schema) = schema(&place);
            Some(json!({ "id": id, "topic": format!("/{}", place.route.topic), "encoding": "json",
                "schemaName": name, "schemaEncoding": "jsonschema", "schema": schema.to_string() }))
        });
        let channels: Vec<Value> = channels.collect();
        Message::text(json!({ "op": "advertise", "channels": channels }).to_string())
    }

    fn refuse(&self, number: u64, why: &str) {
        if let Some(client) = self.clients.iter().find(|one| one.number == number) {
            let _ = is_read(client, &status(2, why));
        }
    }

    /// What a client asks for; none if it is not of the protocol. What this server does not have is passed over.
    fn asked(&mut self, number: u64, asked: &Value) -> Option<()> {
        let client = self.clients.iter_mut().find(|one| one.number == number)?;
        let id = |value: &Value| u32::try_from(value.as_u64()?).ok();
        match asked.get("op")?.as_str()? {
            "subscribe" => {
                for one in asked.get("subscriptions")?.as_array()? {
                    let (subscription, channel) = (id(one.get("id")?)?, id(one.get("channelId")?)?);
                    if client.subscriptions.len() >= CLIENT_CHANNELS_MAX {
                        return None;
                    }
                    client.subscriptions.insert(subscription, channel);
                    latest(self.plan, &self.channels, &self.picture, client, subscription, channel);
                }
            }
            "unsubscribe" => {
                for one in asked.get("subscriptionIds")?.as_array()? {
                    client.subscriptions.remove(&id(one)?);
                }
            }
            "advertise" => {
                for one in asked.get("channels")?.as_array()? {
                    if client.published.len() >= CLIENT_CHANNELS_MAX {
                        return None;
                    }
                    let topic = one.get("topic")?.as_str()?.to_owned();
                    client.published.insert(id(one.get("id")?)?, topic);
                }
            }
            "unadvertise" => {
                for one in asked.get("channelIds")?.as_array()? {
                    client.published.remove(&id(one)?);
                }
            }
            _ => {}
        }
        Some(())
    }

    /// What a client has published: a value for an actuator, alone or as `value` of an object.
    fn published(&self, number: u64, bytes: &[u8]) -> Result<(), String> {
        if !self.takes_commands {
            return Err("commands are off: `commands = true` in the configuration".to_owned());
        }
        let client = self.clients.iter().find(|one| one.number == number);
        let (Some(client), Some((&MESSAGE_DATA, rest))) = (client, bytes.split_first()) else {
            return Err("the message is not of the protocol".to_owned());
        };
        let (channel, payload) =
            rest.split_first_chunk().ok_or("the message is not of the protocol")?;
        let topic = client.published.get(&u32::from_le_bytes(*channel));
        let topic = topic.ok_or("nothing was advertised with this number")?;
        let actuator = topic.trim_start_matches('/').strip_suffix("/set");
        let place = actuator.and_then(|topic| self.plan.actuator(topic));
        let place = place.ok_or_else(|| format!("no actuator has the topic `{topic}`"))?;
        let payload: Value = serde_json::from_slice(payload).map_err(|why| why.to_string())?;
        let wanted = match payload.as_object() {
            Some(object) => object.get("value").cloned().ok_or("the message has no `value`")?,
            None => payload,
        };
        let command = command::of_json(&place, &wanted).map_err(|why| format!("{topic}: {why}"))?;
        self.outbox.set(command)
    }
}

/// Sends the latest value of a channel, so that one who comes later need not wait.
fn latest(
    plan: &Plan,
    channels: &BTreeMap<(usize, usize), u32>,
    picture: &Picture,
    client: &Client,
    subscription: u32,
    channel: u32,
) {
    for values in picture.values() {
        for (place, raw) in plan.of(values) {
            if channels.get(&(place.board, place.index)) == Some(&channel) {
                let _ = is_read(client, &value(subscription, &place, values, raw));
            }
        }
    }
}

/// Puts a message into a client's queue; false if it is full.
fn is_read(client: &Client, message: &Message) -> bool {
    !matches!(client.to.try_send(message.clone()), Err(TrySendError::Full(_)))
}

/// Something for the people at the other end: 0 is a note, 1 a warning, 2 an error.
fn status(level: u8, what: &str) -> Message {
    Message::text(json!({ "op": "status", "level": level, "message": what }).to_string())
}

fn value(
    subscription: u32,
    place: &Place<'_>,
    values: &Values,
    raw: &[sensedsl_wire::Scalar],
) -> Message {
    let taken_ns = u64::try_from(values.taken.as_nanos()).unwrap_or(u64::MAX);
    let payload = json!({ "value": place.json(raw), "raw": place.raw_json(raw), "unit": place.route.unit,
        "frame_id": place.route.frame });
    let mut bytes = vec![MESSAGE_DATA];
    bytes.extend(subscription.to_le_bytes());
    bytes.extend(taken_ns.to_le_bytes());
    bytes.extend(payload.to_string().as_bytes());
    Message::binary(bytes)
}

/// The name and the schema of a device's messages.
fn schema(place: &Place<'_>) -> (&'static str, Value) {
    let (one, many, sort) = if place.is_bool() {
        ("sensedsl.Flag", "sensedsl.Flags", "boolean")
    } else {
        ("sensedsl.Number", "sensedsl.Numbers", "number")
    };
    let (name, value) = match place.device.value.length {
        None => (one, json!({ "type": sort })),
        Some(_) => (many, json!({ "type": "array", "items": { "type": sort } })),
    };
    let schema = json!({ "type": "object", "title": name, "properties": {
        "value": value, "raw": value, "unit": { "type": "string" }, "frame_id": { "type": "string" },
    } });
    (name, schema)
}

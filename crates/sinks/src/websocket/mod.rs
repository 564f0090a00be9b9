//! WebSocket: what happens in, text messages in JSON for pages and scripts out, and their commands back.
//!
//! The sink's thread is the hub: it makes each message once and puts it into the queue of each client. `door.rs`
//! lets clients in, `client.rs` has the thread of one, `head.rs` a page for browsers. A client that does not read what it gets is let go, so that it slows nobody down.
//! The protocol is written down in `docs/sinks/websocket.md`.

mod client;
mod door;
mod head;
mod origin;

use std::net::SocketAddr;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, SyncSender, TrySendError, sync_channel};
use std::time::{Duration, Instant};

use serde_json::{Map, Value, json};
use tungstenite::Message;

use crate::command;
use crate::config::Settings;
use crate::event::{Event, Inbox, Next, Outbox, Sink, Values};
use crate::json;
use crate::listener::Listener;
use crate::picture::Picture;
use crate::plan::Plan;
pub(crate) use client::Terms;
pub(crate) use door::Door;

/// How long the hub waits for an event before it looks at clients.
const WAIT: Duration = Duration::from_millis(5);
/// Messages that wait for one client; one that lets more come is not reading.
pub(crate) const CLIENT_QUEUE_MAX: usize = 512;
/// Requests of all clients that wait for the hub.
pub(crate) const REQUESTS_MAX: usize = 256;
/// How long a command waits for its echo.
const ANSWERED_WITHIN: Duration = Duration::from_secs(2);
/// The version of the protocol.
const PROTOCOL: u32 = 1;

/// A server for pages and scripts.
#[derive(Debug)]
pub(crate) struct WebSocketServer {
    plan: Arc<Plan>,
    listen: SocketAddr,
    origins: Vec<String>,
    takes_commands: bool,
}

/// What a client's thread tells the hub.
pub(crate) enum Request {
    /// Somebody connected: where its messages go.
    Open(u64, SyncSender<Message>),
    /// It sent a text.
    Text(u64, String),
    /// It sent bytes.
    Binary(u64, Vec<u8>),
    /// It is gone; whether because it read too slowly.
    Closed(u64, bool),
}

struct Client {
    number: u64,
    to: SyncSender<Message>,
}

/// A command that waits for its echo.
struct Pending {
    client: u64,
    id: Value,
    board: usize,
    index: usize,
    topic: String,
    since: Instant,
}

struct Hub<'a> {
    plan: &'a Plan,
    takes_commands: bool,
    outbox: &'a Outbox,
    picture: Picture,
    clients: Vec<Client>,
    pending: Vec<Pending>,
    dropped: u64,
}

impl WebSocketServer {
    /// With what a configuration says; none if its address is not one.
    #[must_use]
    pub(crate) fn new(settings: &Settings, plan: Arc<Plan>) -> Option<Self> {
        let listen = crate::config::listening(settings.text("listen")).ok()?;
        let origins = settings.texts("origins").to_vec();
        Some(Self { plan, listen, origins, takes_commands: settings.flag("commands") })
    }
}

impl Sink for WebSocketServer {
    fn run(self: Box<Self>, inbox: &Inbox, outbox: &Outbox) {
        let (to_hub, requests) = sync_channel(REQUESTS_MAX);
        let mut hub = Hub {
            plan: &self.plan,
            takes_commands: self.takes_commands,
            outbox,
            picture: Picture::new(&self.plan),
            clients: Vec::new(),
            pending: Vec::new(),
            dropped: 0,
        };
        let terms = Terms { origins: self.origins.clone(), protocol: None };
        let listener = Listener::new(self.listen, self.takes_commands);
        let mut door = Door::new(listener, terms);
        let open = |at| format!("ws://{at}, with a page at http://{at}");
        loop {
            door.tend(&to_hub, outbox, &open);
            match inbox.next(WAIT) {
                Next::Event(event) => hub.take(&event),
                Next::Nothing => {}
                Next::Over => break,
            }
            hub.requests(&requests);
        }
        hub.end();
    }
}

impl Hub<'_> {
    fn take(&mut self, event: &Event) {
        self.picture.take(event);
        let message = match event {
            Event::Values(values) => {
                let name = if values.is_command { "command" } else { "values" };
                self.echo(values);
                json!({ name: json::values(self.plan, values) })
            }
            Event::Presence { board, away } => {
                let Some(on) = self.plan.board(*board) else { return };
                json!({ "presence": json::presence(on, away.as_deref()) })
            }
            Event::Health { board, health, .. } => {
                let Some(on) = self.plan.board(*board) else { return };
                json!({ "health": json::health(on, health) })
            }
        };
        self.broadcast(&message);
    }

    fn broadcast(&mut self, message: &Value) {
        if self.clients.is_empty() {
            return;
        }
        let text = Message::text(message.to_string());
        let before = self.clients.len();
        self.clients.retain(|client| {
            !matches!(client.to.try_send(text.clone()), Err(TrySendError::Full(_)))
        });
        for _ in self.clients.len()..before {
            self.slow();
        }
    }

    fn slow(&mut self) {
        self.dropped += 1;
        let count = self.dropped;
        self.outbox.note(&format!("a client was too slow and was let go ({count} so far)"));
    }

    fn send(&self, client: u64, message: &Value) {
        if let Some(client) = self.clients.iter().find(|one| one.number == client) {
            // One whose queue is full is let go with the next value.
            let _ = client.to.try_send(Message::text(message.to_string()));
        }
    }

    fn requests(&mut self, requests: &Receiver<Request>) {
        while let Ok(request) = requests.try_recv() {
            match request {
                Request::Open(number, to) => {
                    let _ = to.try_send(Message::text(self.hello().to_string()));
                    self.clients.push(Client { number, to });
                }
                Request::Closed(number, is_slow) => {
                    let before = self.clients.len();
                    self.clients.retain(|one| one.number != number);
                    // One that the hub let go was counted then.
                    if is_slow && self.clients.len() < before {
                        self.slow();
                    }
                }
                Request::Binary(number, _) => {
                    self.refuse(number, &Value::Null, None, "a message must be text");
                }
                Request::Text(number, text) => self.asked(number, &text),
            }
        }
        let (late, waiting) = std::mem::take(&mut self.pending)
            .into_iter()
            .partition(|one| one.since.elapsed() > ANSWERED_WITHIN);
        self.pending = waiting;
        let late: Vec<Pending> = late;
        for one in late {
            self.refuse(one.client, &one.id, Some(&one.topic), "the board did not take it");
        }
    }

    /// What a client is told first: the boards, how they are, and the latest value of each device.
    fn hello(&self) -> Value {
        let mut schema = json::schema(self.plan);
        if let Value::Array(boards) = &mut schema {
            let plans = self.plan.boards.iter().zip(&self.picture.boards);
            for (board, (on, state)) in boards.iter_mut().zip(plans) {
                if let Value::Object(board) = board {
                    board.insert("online".into(), state.is_online.into());
                    let health = state.health.as_ref().map(|told| json::health(on, told));
                    board.insert("health".into(), health.unwrap_or_default());
                }
            }
        }
        let mut values = Map::new();
        for latest in self.picture.values() {
            for (place, raw) in self.plan.of(latest) {
                values.insert(place.route.topic.clone(), json::value(&place, latest, raw));
            }
        }
        let program = concat!("sensedsl ", env!("CARGO_PKG_VERSION"));
        json!({ "hello": {
            "protocol": PROTOCOL, "program": program, "commands": self.takes_commands,
            "boards": schema, "values": values,
        } })
    }

    fn asked(&mut self, client: u64, text: &str) {
        let Ok(Value::Object(message)) = serde_json::from_str(text) else {
            return self.refuse(client, &Value::Null, None, "a message must be an object in JSON");
        };
        let id = message.get("id").cloned().unwrap_or_default();
        let Some(Value::Object(wanted)) = message.get("set") else {
            return self.refuse(client, &id, None, "a message must have `set`, an object");
        };
        for (topic, value) in wanted {
            if let Err(why) = self.set(client, &id, topic, value) {
                self.refuse(client, &id, Some(topic), &why);
            }
        }
    }

    fn set(&mut self, client: u64, id: &Value, topic: &str, value: &Value) -> Result<(), String> {
        if !self.takes_commands {
            return Err("commands are off: `commands = true` in the configuration".to_owned());
        }
        let place = self.plan.places().find(|one| one.route.topic == topic);
        let place = place.ok_or_else(|| "no device has this topic".to_owned())?;
        let wanted = command::of_json(&place, value)?;
        let state = self.picture.boards.get(wanted.board);
        if !state.is_some_and(|state| state.is_online) {
            return Err("the board is not there".to_owned());
        }
        if self.pending.len() >= REQUESTS_MAX {
            return Err("too many commands wait for their echo".to_owned());
        }
        let (board, index) = (wanted.board, wanted.index);
        self.outbox.set(wanted)?;
        let (id, topic) = (id.clone(), topic.to_owned());
        self.pending.push(Pending { client, id, board, index, topic, since: Instant::now() });
        Ok(())
    }

    fn refuse(&self, client: u64, id: &Value, topic: Option<&str>, why: &str) {
        self.send(
            client,
            &json!({ "answer": { "id": id, "set": topic, "ok": false, "error": why } }),
        );
    }

    /// Answers who waits for the echo of a command.
    fn echo(&mut self, values: &Values) {
        if !values.is_command {
            return;
        }
        for (place, raw) in self.plan.of(values) {
            let is_of = |one: &Pending| one.board == place.board && one.index == place.index;
            // Commands are taken in their order, so the first that waits is the one.
            if let Some(at) = self.pending.iter().position(is_of) {
                let one = self.pending.remove(at);
                self.send(
                    one.client,
                    &json!({ "answer": {
                    "id": one.id, "set": one.topic, "ok": true,
                    "value": place.json(raw), "raw": place.raw_json(raw),
                } }),
                );
            }
        }
    }

    fn end(&self) {
        let bye = Message::text(json!({ "bye": "the monitor ended" }).to_string());
        for client in &self.clients {
            let _ = client.to.try_send(bye.clone());
        }
        // The threads of clients get the rest out, and end with their queues.
        std::thread::sleep(Duration::from_millis(50));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::Config;
    use sensedsl_host::Wish;

    #[test]
    fn a_client_that_does_not_read_is_let_go() {
        let plan = Plan::new(&[], &Config::default(), None);
        let outbox = Outbox::new("WebSocket");
        let mut hub = Hub {
            plan: &plan,
            takes_commands: true,
            outbox: &outbox,
            picture: Picture::new(&plan),
            clients: Vec::new(),
            pending: Vec::new(),
            dropped: 0,
        };
        let (quick, from_quick) = sync_channel(CLIENT_QUEUE_MAX);
        let (slow, _from_slow) = sync_channel(CLIENT_QUEUE_MAX);
        hub.clients = vec![Client { number: 1, to: quick }, Client { number: 2, to: slow }];
        for number in 0..=CLIENT_QUEUE_MAX {
            hub.broadcast(&json!(number));
            assert_eq!(from_quick.try_recv().unwrap(), Message::text(number.to_string()));
        }
        assert_eq!(hub.clients.iter().map(|one| one.number).collect::<Vec<_>>(), [1]);
        let told = "WebSocket: a client was too slow and was let go (1 so far)".to_owned();
        assert_eq!(outbox.take(), [Wish::Note(told)]);
    }
}

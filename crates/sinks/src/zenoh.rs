//! Zenoh: values in, samples in JSON out, for fleets that do not share one network.
//!
//! Each device has a key, its topic below the prefix. Who comes later asks for `PREFIX/**` and gets the latest of
//! everything; a board that is there has a liveliness token, which goes with it, with this program, and with the
//! network. Commands are samples of the key with `/set` behind it.

use std::collections::BTreeMap;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};

use sensedsl_limits::MESSAGE_BYTES_MAX;
use serde_json::Value;
use zenoh::bytes::Encoding;
use zenoh::handlers::Callback;
use zenoh::key_expr::{KeyExpr, OwnedKeyExpr};
use zenoh::liveliness::LivelinessToken;
use zenoh::pubsub::Subscriber;
use zenoh::query::{Query, Queryable};
use zenoh::sample::{Sample, SampleKind};
use zenoh::{Session, Wait as _};

use crate::command::{self, Command};
use crate::config::Settings;
use crate::event::{Event, Inbox, Outbox, Sink};
use crate::json;
use crate::network::{Network, serve};
use crate::plan::{BoardPlan, Plan};

/// The most commands that wait.
const COMMANDS_MAX: usize = 64;

/// The way to Zenoh.
#[derive(Debug)]
pub(crate) struct Zenoh {
    plan: Arc<Plan>,
    mode: String,
    connect: Vec<String>,
    listen: Vec<String>,
    is_scouting: bool,
    prefix: String,
    takes_commands: bool,
}

/// The latest sample of each key, for who asks.
type Latest = Arc<Mutex<BTreeMap<String, (OwnedKeyExpr, Vec<u8>)>>>;

/// A session with all that is declared in it.
pub(crate) struct Joined {
    session: Session,
    latest: Latest,
    commands: Receiver<(usize, usize, Vec<u8>)>,
    /// They hold what they have declared.
    _subscribers: Vec<Subscriber<()>>,
    _queryable: Queryable<()>,
    tokens: BTreeMap<usize, LivelinessToken>,
}

impl Zenoh {
    /// With what a configuration says.
    #[must_use]
    pub(crate) fn new(settings: &Settings, plan: Arc<Plan>) -> Self {
        Self {
            plan,
            mode: settings.text("mode").to_owned(),
            connect: settings.texts("connect").to_vec(),
            listen: settings.texts("listen").to_vec(),
            is_scouting: settings.flag("scouting"),
            prefix: settings.text("prefix").trim_matches('/').to_owned(),
            takes_commands: settings.flag("commands"),
        }
    }

    /// The key of a topic.
    fn key(&self, topic: &str) -> Result<OwnedKeyExpr, String> {
        let text = if self.prefix.is_empty() {
            topic.to_owned()
        } else {
            format!("{}/{topic}", self.prefix)
        };
        OwnedKeyExpr::autocanonize(text.clone()).ok().filter(|key| !key.is_wild()).ok_or_else(
            || format!("`{text}` is no key for Zenoh: it must have no `*`, `$`, `#` or `?`"),
        )
    }

    fn link_key(&self, on: &BoardPlan, what: &str) -> Result<OwnedKeyExpr, String> {
        self.key(&format!("{}/link/{what}", on.topic))
    }

    fn config(&self) -> Result<zenoh::Config, String> {
        let mut config = zenoh::Config::default();
        let mut say = |key: &str, value: Value| {
            config
                .insert_json5(key, &value.to_string())
                .map_err(|why| format!("`{key}` cannot be {value}: {why}"))
        };
        say("mode", self.mode.as_str().into())?;
        say("scouting/multicast/enabled", self.is_scouting.into())?;
        if !self.connect.is_empty() {
            say("connect/endpoints", self.connect.clone().into())?;
        }
        if !self.listen.is_empty() {
            say("listen/endpoints", self.listen.clone().into())?;
        }
        // Whom a peer does not reach it tries again by itself; a client fails, and is begun anew.
        Ok(config)
    }
}

impl Network for Zenoh {
    type Joined = Joined;
    const HELP: &'static str = "look at the network, or correct `[zenoh]`; trying again";

    fn join(&self) -> Result<Joined, String> {
        let session = zenoh::open(self.config()?).wait().map_err(|why| why.to_string())?;
        let latest = Latest::default();
        let all =
            if self.prefix.is_empty() { "**".to_owned() } else { format!("{}/**", self.prefix) };
        let known = Arc::clone(&latest);
        let queryable = session
            .declare_queryable(all)
            .callback(move |query| answer(&query, &known))
            .wait()
            .map_err(|why| why.to_string())?;
        let (to_sink, commands) = sync_channel(COMMANDS_MAX);
        let mut subscribers = Vec::new();
        for place in self.plan.places() {
            let key = self.key(&place.route.topic)?;
            if !(self.takes_commands && place.is_actuator()) {
                continue;
            }
            let heard = heard(to_sink.clone(), place.board, place.index);
            let set = format!("{key}/set");
            let declared = session.declare_subscriber(set).with(Callback::from(heard)).wait();
            subscribers.push(declared.map_err(|why| why.to_string())?);
        }
        Ok(Joined {
            session,
            latest,
            commands,
            _subscribers: subscribers,
            _queryable: queryable,
            tokens: BTreeMap::new(),
        })
    }

    fn tell(&self, joined: &mut Joined, event: &Event) -> Result<(), String> {
        match event {
            Event::Values(values) => {
                for (place, raw) in self.plan.of(values) {
                    let key = self.key(&place.route.topic)?;
                    joined.put(key, &json::value(&place, values, raw))?;
                }
                Ok(())
            }
            Event::Presence { board, away } => {
                let Some(on) = self.plan.board(*board) else { return Ok(()) };
                let alive = self.link_key(on, "alive")?;
                match away {
                    None => {
                        let token = joined.session.liveliness().declare_token(alive).wait();
                        let _ = joined.tokens.insert(*board, token.map_err(|why| why.to_string())?);
                    }
                    // Dropping it takes it back.
                    Some(_) => drop(joined.tokens.remove(board)),
                }
                joined.put(self.link_key(on, "presence")?, &json::presence(on, away.as_deref()))
            }
            Event::Health { board, health, .. } => {
                let Some(on) = self.plan.board(*board) else { return Ok(()) };
                joined.put(self.link_key(on, "health")?, &json::health(on, health))
            }
        }
    }

    fn heard(&self, joined: &mut Joined) -> Vec<(String, Result<Command, String>)> {
        let all = joined.commands.try_iter();
        let all = all.filter_map(|(board, index, bytes)| {
            let place = self.plan.place(board, index)?;
            Some((place.device.name.clone(), command::of_bytes(&place, &bytes)))
        });
        all.collect()
    }

    fn leave(&self, joined: Joined) {
        // Tokens and declarations go with the session; a router that is gone needs no goodbye.
        let _ = joined.session.close().wait();
    }
}

impl Joined {
    fn put(&self, key: OwnedKeyExpr, value: &Value) -> Result<(), String> {
        let text = value.to_string();
        let put = self.session.put(&key, text.as_str()).encoding(Encoding::APPLICATION_JSON);
        put.wait().map_err(|why| why.to_string())?;
        let mut latest = self.latest.lock().unwrap_or_else(PoisonError::into_inner);
        let _ = latest.insert(key.to_string(), (key, text.into_bytes()));
        Ok(())
    }
}

/// Answers with the latest of all keys that are asked for.
fn answer(query: &Query, latest: &Latest) {
    let asked = query.key_expr();
    let latest = latest.lock().unwrap_or_else(PoisonError::into_inner);
    for (key, bytes) in latest.values().filter(|(key, _)| asked.intersects(key)) {
        let reply = query.reply(KeyExpr::from(key.clone()), bytes.as_slice());
        // Who has asked may be gone.
        let _ = reply.encoding(Encoding::APPLICATION_JSON).wait();
    }
}

/// Hands a command to the sink's thread; more than fit are dropped, as on a network.
fn heard(
    to_sink: SyncSender<(usize, usize, Vec<u8>)>,
    board: usize,
    index: usize,
) -> impl Fn(Sample) + Send + Sync + 'static {
    move |sample| {
        if sample.kind() == SampleKind::Put && sample.payload().len() <= MESSAGE_BYTES_MAX {
            let bytes = sample.payload().to_bytes().into_owned();
            let _ = to_sink.try_send((board, index, bytes));
        }
    }
}

impl Sink for Zenoh {
    fn run(self: Box<Self>, inbox: &Inbox, outbox: &Outbox) {
        serve(&*self, inbox, outbox);
    }
}

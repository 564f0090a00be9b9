//! MQTT: values, presence and health in, retained topics out, and commands back.
//!
//! `network.rs` has the thread of the connection, `discovery.rs` what Home Assistant is told, `elements.rs` sets one
//! element of an array. The topics are written
//! down in `docs/sinks/mqtt.md`. After each connection everything that is known goes out again, so that a broker that
//! was away or has forgotten has it all.

mod discovery;
mod elements;
mod network;

use std::sync::Arc;
use std::time::{Duration, Instant};

use rumqttc::{Client, LastWill, MqttOptions, QoS};
use sensedsl_wire::Health;

use crate::command;
use crate::config::{Address, Settings};
use crate::event::{Event, Inbox, Next, Outbox, Refusals, Sink, Values};
use crate::json;
use crate::picture::Picture;
use crate::plan::{BoardPlan, Place, Plan};
use elements::Elements;
use network::{Network, Said};

/// How long the sink waits for an event before it looks at the network.
const WAIT: Duration = Duration::from_millis(5);
/// Messages that wait for the network: a value that finds no room is followed by a newer one.
const REQUESTS_MAX: usize = 4_096;
/// The longest time without a word of the broker, half of which is waited before it is asked.
const KEEP_ALIVE: Duration = Duration::from_secs(10);
/// The most bytes of a packet: a longer one ends the connection.
const PACKET_BYTES_MAX: usize = 1 << 20;
/// How long a run that is over waits for a connection that was never there.
const CONNECTS_WITHIN: Duration = Duration::from_millis(500);
/// How long the goodbye may take.
const BYE_WITHIN: Duration = Duration::from_millis(800);

const ONLINE: &str = "online";
const OFFLINE: &str = "offline";

/// The way to a broker.
#[derive(Debug)]
pub(crate) struct Mqtt {
    plan: Arc<Plan>,
    broker: Address,
    topics: Topics,
    is_json: bool,
    discovery: String,
    client_id: String,
    login: Option<(String, String)>,
    takes_commands: bool,
}

/// The names of topics. No name of a design has a hyphen, so none can be one of these.
#[derive(Clone, Debug)]
struct Topics {
    prefix: String,
}

impl Topics {
    fn host_status(&self) -> String {
        format!("{}/host-status", self.prefix)
    }

    fn board_status(&self, board: &str) -> String {
        format!("{}/{board}/board-status", self.prefix)
    }

    fn board_health(&self, board: &str) -> String {
        format!("{}/{board}/board-health", self.prefix)
    }

    fn state(&self, place: &Place<'_>) -> String {
        format!("{}/{}", self.prefix, place.route.topic)
    }

    fn set(&self, place: &Place<'_>) -> String {
        format!("{}/set", self.state(place))
    }

    fn set_element(&self, place: &Place<'_>, element: usize) -> String {
        format!("{}/{element}", self.set(place))
    }
}

impl Mqtt {
    /// With what a configuration says; none if its address is not one. `own_name` tells this program's connections
    /// from those of others.
    #[must_use]
    pub(crate) fn new(settings: &Settings, plan: Arc<Plan>, own_name: &str) -> Option<Self> {
        let broker = crate::config::remote(settings.text("broker"), Some(1883)).ok()?;
        let text = |key: &str| settings.text(key).to_owned();
        let client_id = Some(text("client_id")).filter(|id| !id.is_empty());
        let login = Some(text("user")).filter(|user| !user.is_empty());
        Some(Self {
            plan,
            broker,
            topics: Topics { prefix: text("prefix").trim_matches('/').to_owned() },
            is_json: settings.text("payload") == "json",
            discovery: text("discovery").trim_matches('/').to_owned(),
            client_id: client_id.unwrap_or_else(|| format!("sensedsl-{own_name}")),
            login: login.map(|user| (user, text("password"))),
            takes_commands: settings.flag("commands"),
        })
    }

    fn options(&self) -> MqttOptions {
        let mut options =
            MqttOptions::new(self.client_id.clone(), self.broker.host.clone(), self.broker.port);
        let will = LastWill::new(self.topics.host_status(), OFFLINE, QoS::AtLeastOnce, true);
        options
            .set_keep_alive(KEEP_ALIVE)
            .set_last_will(will)
            .set_max_packet_size(PACKET_BYTES_MAX, PACKET_BYTES_MAX);
        if let Some((user, password)) = &self.login {
            options.set_credentials(user.clone(), password.clone());
        }
        options
    }
}

impl Sink for Mqtt {
    fn run(self: Box<Self>, inbox: &Inbox, outbox: &Outbox) {
        let (client, connection) = Client::new(self.options(), REQUESTS_MAX);
        let network = Network::start(connection);
        let mut link = Link {
            mqtt: &self,
            client,
            outbox,
            picture: Picture::new(&self.plan),
            is_connected: false,
            is_lost: false,
            refusals: Refusals::default(),
            elements: Elements::default(),
        };
        loop {
            match inbox.next(WAIT) {
                Next::Event(event) => {
                    link.picture.take(&event);
                    link.publish(&event);
                }
                Next::Nothing => {}
                Next::Over => break,
            }
            network.heard().for_each(|said| link.hear(said));
            link.refusals.look(outbox);
        }
        // A run that is shorter than a connection takes is told as well.
        let over = Instant::now();
        while !link.is_connected && !link.is_lost && over.elapsed() < CONNECTS_WITHIN {
            std::thread::sleep(WAIT);
            network.heard().for_each(|said| link.hear(said));
        }
        link.end();
        network.end(BYE_WITHIN);
    }
}

struct Link<'a> {
    mqtt: &'a Mqtt,
    client: Client,
    outbox: &'a Outbox,
    picture: Picture,
    is_connected: bool,
    is_lost: bool,
    refusals: Refusals,
    elements: Elements,
}

impl Link<'_> {
    fn send(&self, topic: String, qos: QoS, payload: impl Into<Vec<u8>>) {
        // Without room the message is lost; the state follows with the next value or connection.
        let _ = self.client.try_publish(topic, qos, true, payload);
    }

    fn publish(&self, event: &Event) {
        if !self.is_connected {
            return;
        }
        let (plan, topics) = (&self.mqtt.plan, &self.mqtt.topics);
        match event {
            Event::Values(values) => self.values(values),
            Event::Presence { board, away } => {
                if let Some(on) = plan.board(*board) {
                    let status = if away.is_none() { ONLINE } else { OFFLINE };
                    self.send(topics.board_status(&on.topic), QoS::AtLeastOnce, status);
                }
            }
            Event::Health { board, health, .. } => {
                if let Some(on) = plan.board(*board) {
                    self.health(on, health);
                }
            }
        }
    }

    fn health(&self, on: &BoardPlan, health: &Health) {
        let topic = self.mqtt.topics.board_health(&on.topic);
        self.send(topic, QoS::AtMostOnce, json::health(on, health).to_string());
    }

    fn values(&self, values: &Values) {
        for (place, raw) in self.mqtt.plan.of(values) {
            let payload = if self.mqtt.is_json {
                json::value(&place, values, raw).to_string()
            } else {
                let value = place.json(raw);
                if value.is_null() { "nan".to_owned() } else { value.to_string() }
            };
            self.send(self.mqtt.topics.state(&place), QoS::AtMostOnce, payload);
        }
    }

    fn hear(&mut self, said: Said) {
        match said {
            Said::Connected => self.connected(),
            Said::Lost(why, help) => {
                (self.is_connected, self.is_lost) = (false, true);
                self.outbox.broken(&format!("{}: {why}", self.mqtt.broker), help);
            }
            Said::Message { topic, payload, is_retained } => {
                if let Err(why) = self.command(&topic, &payload, is_retained) {
                    self.refusals.tell(self.outbox, format!("not set by {topic}: {why}"));
                }
            }
        }
    }

    /// Tells the broker all that is known.
    fn connected(&mut self) {
        let mqtt = self.mqtt;
        (self.is_connected, self.is_lost) = (true, false);
        self.outbox.works();
        for place in mqtt.plan.places() {
            if mqtt.takes_commands && place.is_actuator() {
                let _ = self.client.try_subscribe(mqtt.topics.set(&place), QoS::AtLeastOnce);
                if elements::are_set(&place) {
                    let all = format!("{}/+", mqtt.topics.set(&place));
                    let _ = self.client.try_subscribe(all, QoS::AtLeastOnce);
                }
            }
            for (topic, payload) in discovery::messages(mqtt, &place) {
                self.send(topic, QoS::AtLeastOnce, payload);
            }
        }
        self.send(mqtt.topics.host_status(), QoS::AtLeastOnce, ONLINE);
        for (board, state) in self.picture.boards.iter().enumerate() {
            let away = if state.is_online { None } else { Some(String::new()) };
            self.publish(&Event::Presence { board, away });
            if let (Some(on), Some(told)) = (mqtt.plan.board(board), &state.health) {
                self.health(on, told);
            }
        }
        self.picture.values().for_each(|values| self.values(values));
    }

    fn command(&mut self, topic: &str, payload: &[u8], is_retained: bool) -> Result<(), String> {
        let mqtt = self.mqtt;
        let mut actuators = mqtt.plan.places().filter(Place::is_actuator);
        // The actuator, and what follows its topic: the number of an element.
        let found = actuators.find_map(|place| {
            let rest = topic.strip_prefix(&mqtt.topics.set(&place))?;
            (rest.is_empty() || rest.starts_with('/')).then_some((place, rest.strip_prefix('/')))
        });
        let (place, element) = found.ok_or("no actuator has this topic")?;
        // Nobody knows how old it is, and it would come again with each connection.
        if is_retained {
            return Err("the command is retained: send it without that".to_owned());
        }
        let command = match element {
            None => command::of_bytes(&place, payload)?,
            Some(element) => {
                let element = element.parse().map_err(|_| "there is no such element")?;
                let all = self.elements.with(&place, &self.picture, element, payload)?;
                command::of_json(&place, &all)?
            }
        };
        self.outbox.set(command)
    }

    fn end(&self) {
        if self.is_connected {
            for on in &self.mqtt.plan.boards {
                let topic = self.mqtt.topics.board_status(&on.topic);
                self.send(topic, QoS::AtLeastOnce, OFFLINE);
            }
            self.send(self.mqtt.topics.host_status(), QoS::AtLeastOnce, OFFLINE);
        }
        let _ = self.client.try_disconnect();
    }
}

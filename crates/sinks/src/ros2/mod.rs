//! ROS 2: values in, topics over DDS out, without an installation of ROS, and commands by subscription.
//!
//! `shape.rs` says which message a device has, `message.rs` has their fields, `topics.rs` the topics, and `composed.rs`
//! the messages of several devices; `parameters.rs` answers for actuators. What a topic is called, and what is in it, is written down in `docs/sinks/ros2.md`.

mod composed;
mod message;
mod parameters;
mod shape;
mod topics;

use std::sync::Arc;
use std::time::{SystemTime, UNIX_EPOCH};

use ros2_client::{
    Context, ContextOptions, Name, Node, NodeName, NodeOptions, ParameterValue, Publisher,
    ServiceMapping,
};
use sensedsl_wire::Scalar;

use crate::command::{self, Command};
use crate::config::Settings;
use crate::event::{Event, Inbox, Outbox, Sink};
use crate::network::{Network, serve};
use crate::plan::{Place, Plan};
use composed::Together;
use message::DiagnosticArray;
use parameters::Parameters;
use topics::{Heard, Told, publisher};

/// The way to ROS 2.
#[derive(Debug)]
pub(crate) struct Ros2 {
    plan: Arc<Plan>,
    is_humble: bool,
    domain: u16,
    /// Empty, or words with a slash before each.
    namespace: String,
    node: String,
    mapping: ServiceMapping,
    takes_commands: bool,
}

/// A node with all its topics.
pub(crate) struct Joined {
    /// It holds what it has made, and the values of parameters.
    node: Node,
    told: Vec<Vec<Option<Told>>>,
    heard: Vec<(usize, usize, Heard)>,
    together: Vec<Together>,
    parameters: Parameters,
    diagnostics: Publisher<DiagnosticArray>,
}

impl Ros2 {
    /// With what a configuration says; none if its domain cannot be one.
    #[must_use]
    pub(crate) fn new(settings: &Settings, plan: Arc<Plan>) -> Option<Self> {
        let namespace = settings.text("namespace").trim_matches('/');
        let namespace = if namespace.is_empty() { String::new() } else { format!("/{namespace}") };
        Some(Self {
            plan,
            is_humble: settings.text("distro") == "humble",
            domain: u16::try_from(settings.whole("domain")).ok()?,
            namespace,
            node: settings.text("node").to_owned(),
            mapping: match settings.text("rmw") {
                "cyclonedds" => ServiceMapping::Cyclone,
                _ => ServiceMapping::Enhanced,
            },
            takes_commands: settings.flag("commands"),
        })
    }

    /// The name of a topic.
    fn name(&self, topic: &str) -> Result<Name, String> {
        Name::parse(&format!("{}/{topic}", self.namespace))
            .map_err(|why| format!("`{topic}` is not a valid topic name: {why:?}"))
    }

    fn told(&self, node: &mut Node, place: &Place<'_>) -> Result<Told, String> {
        Told::new(node, place, &self.name(&place.route.topic)?, self.is_humble)
    }
}

impl Joined {
    /// An actuator was set: its parameter is what others read of it.
    fn set(&self, place: &Place<'_>, raw: &[Scalar]) -> Result<(), String> {
        let (name, value) = parameters::told(place, raw);
        if self.node.get_parameter(&name).as_ref() == Some(&value) {
            return Ok(());
        }
        self.node.set_parameter(&name, value)
    }
}

impl Network for Ros2 {
    type Joined = Joined;
    const HELP: &'static str = "look at the network, or correct `[ros2]`; trying again";

    fn join(&self) -> Result<Joined, String> {
        let context = Context::with_options(ContextOptions::new().domain_id(self.domain));
        let context = context.map_err(|why| format!("domain {}: {why}", self.domain))?;
        let namespace = if self.namespace.is_empty() { "/" } else { &self.namespace };
        let name = NodeName::new(namespace, &self.node)
            .map_err(|why| format!("`{}` is not a valid node name: {why:?}", self.node))?;
        let options = NodeOptions::new().enable_rosout(false).start_parameter_services(false);
        let names = parameters::names(&self.plan);
        let options = names
            .iter()
            .fold(options, |options, name| options.declare_parameter(name, ParameterValue::NotSet));
        let mut node =
            context.new_node(name, options).map_err(|why| format!("no node: {why:?}"))?;
        let mut told = Vec::new();
        for (board, on) in self.plan.boards.iter().enumerate() {
            let mut of_board = Vec::new();
            for index in 0..on.routes.len() {
                let place = self.plan.place(board, index);
                of_board.push(place.map(|place| self.told(&mut node, &place)).transpose()?);
            }
            told.push(of_board);
        }
        let mut heard = Vec::new();
        for place in self.plan.places().filter(|one| self.takes_commands && one.is_actuator()) {
            let name = self.name(&format!("{}/set", place.route.topic))?;
            heard.push((place.board, place.index, Heard::new(&mut node, &place, &name)?));
        }
        let together = self.plan.messages.iter().map(|message| {
            let name = self.name(&message.message.topic)?;
            Together::new(&mut node, message, &name)
        });
        let together = together.collect::<Result<_, _>>()?;
        let name = Name::parse("/diagnostics").map_err(|why| format!("{why:?}"))?;
        let diagnostics = publisher(&mut node, &name, ("diagnostic_msgs", "DiagnosticArray"))?;
        let parameters = Parameters::new(&mut node, &self.plan, self.mapping, self.takes_commands)?;
        Ok(Joined { node, told, heard, together, parameters, diagnostics })
    }

    fn tell(&self, joined: &mut Joined, event: &Event) -> Result<(), String> {
        match event {
            Event::Values(values) => {
                for (place, raw) in self.plan.of(values) {
                    if place.is_actuator() {
                        joined.set(&place, raw)?;
                    }
                    let told = joined.told.get(place.board).and_then(|all| all.get(place.index));
                    if let Some(Some(told)) = told {
                        told.publish(&place, raw, values.taken)?;
                    }
                }
                for (together, of) in joined.together.iter_mut().zip(&self.plan.messages) {
                    together.take(&self.plan, of, values)?;
                }
                Ok(())
            }
            Event::Presence { board, away } => {
                let now = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
                let Some(on) = self.plan.board(*board) else { return Ok(()) };
                let told = DiagnosticArray::of_presence(on, away.as_deref(), now);
                joined.diagnostics.publish(told).map_err(|why| why.to_string())
            }
            Event::Health { board, at, health } => {
                let Some(on) = self.plan.board(*board) else { return Ok(()) };
                let told = DiagnosticArray::of_health(on, health, *at);
                joined.diagnostics.publish(told).map_err(|why| why.to_string())
            }
        }
    }

    fn heard(&self, joined: &mut Joined) -> Vec<(String, Result<Command, String>)> {
        let mut commands = Vec::new();
        for (board, index, heard) in &joined.heard {
            let Some(place) = self.plan.place(*board, *index) else { continue };
            let wanted = std::iter::from_fn(|| heard.take());
            commands.extend(
                wanted.map(|value| (place.device.name.clone(), command::of_json(&place, &value))),
            );
        }
        commands.extend(joined.parameters.serve(&joined.node, &self.plan));
        commands
    }

    fn leave(&self, _: Joined) {}
}

impl Sink for Ros2 {
    fn run(self: Box<Self>, inbox: &Inbox, outbox: &Outbox) {
        serve(&*self, inbox, outbox);
    }
}

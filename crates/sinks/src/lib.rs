//! Values of boards for other programs: plotters, pages, brokers, middleware.
//!
//! In: a host's news, as [`sensedsl_host::Output`]s are told them, and a configuration in TOML. Out: messages over the
//! network, and what other programs want to be set. Each way out is a cargo feature and a [`Sink`] with a thread of its
//! own behind a [`Relay`], so that a network that hangs stops neither the board nor the other sinks.
//!
//! # Example
//!
//! ```
//! use sensedsl_diagnostics::SourceMap;
//! use sensedsl_host::Board;
//!
//! let schema = r#"{ "version": 2, "boards": [ { "name": "Rover", "hash": "0x00b4763a", "checksum": "none",
//!     "items": [ { "id": 17, "name": "Light", "direction": "sensor", "type": "uint16", "scale": 0.1 } ] } ] }"#;
//! let boards = Board::all_of_json(schema).unwrap();
//! let text = "[plotjuggler]\nto = \"127.0.0.1:9870\"\n[devices.\"Rover/Ligth\"]\nrate_hz = 5";
//! let mut sources = SourceMap::default();
//! let file = sources.add("sinks.toml", text);
//! let (_, mistakes) = sensedsl_sinks::config::read(file, text, &boards);
//! assert_eq!(mistakes[0].message, "the design has no device called `Rover/Ligth`");
//! ```
#![allow(clippy::disallowed_methods, reason = "this crate is the network: it has clocks")]
#![cfg_attr(
    not(all(feature = "mqtt", feature = "foxglove")),
    allow(dead_code, unused_variables, reason = "what sinks share, some builds do without")
)]

pub mod command;
pub mod config;
mod event;
#[cfg(feature = "foxglove")]
mod foxglove;
mod json;
mod listener;
#[cfg(feature = "mqtt")]
mod mqtt;
#[cfg(any(feature = "ros2", feature = "zenoh"))]
mod network;
#[cfg(feature = "od4")]
mod od4;
mod picture;
mod plan;
#[cfg(feature = "plotjuggler")]
mod plotjuggler;
#[cfg(feature = "prometheus")]
mod prometheus;
mod relay;
#[cfg(feature = "ros2")]
mod ros2;
#[cfg(feature = "websocket")]
mod websocket;
#[cfg(feature = "zenoh")]
mod zenoh;

use std::sync::Arc;

use sensedsl_host::{Board, Output};

pub use config::Config;
pub use event::{Event, Inbox, Next, Outbox, Refusals, Sink, Values};
pub use picture::{BoardState, Picture};
pub use plan::{BoardPlan, Composed, Place, Plan, Route, nest, seconds};
pub use relay::Relay;

use config::Settings;

/// The outputs of a configuration for the boards that are watched, in their order. `own_name` tells this program from
/// others that run the same: the number of its process.
#[must_use]
pub fn outputs(config: &Config, boards: &[Board], own_name: &str) -> Vec<Box<dyn Output>> {
    let all = config.sinks.iter().filter_map(|settings| {
        let plan = Plan::new(boards, config, settings.number("rate_hz"));
        let has_messages = settings.spec.name == "ros2";
        let plan = Arc::new(if has_messages { plan.with_messages(config) } else { plan });
        let sink = sink(settings, &plan, own_name)?;
        Some(Box::new(Relay::start(settings.spec.title, plan, sink)) as Box<dyn Output>)
    });
    all.collect()
}

/// The sink of a table; none if this build does not have it, which the reader has told.
fn sink(settings: &Settings, plan: &Arc<Plan>, own_name: &str) -> Option<Box<dyn Sink>> {
    let plan = Arc::clone(plan);
    match settings.spec.name {
        #[cfg(feature = "plotjuggler")]
        "plotjuggler" => boxed(plotjuggler::PlotJuggler::new(settings, plan)),
        #[cfg(feature = "websocket")]
        "websocket" => boxed(websocket::WebSocketServer::new(settings, plan)),
        #[cfg(feature = "mqtt")]
        "mqtt" => boxed(mqtt::Mqtt::new(settings, plan, own_name)),
        #[cfg(feature = "prometheus")]
        "prometheus" => boxed(prometheus::Prometheus::new(settings, plan)),
        #[cfg(feature = "od4")]
        "od4" => boxed(od4::Od4::new(settings, plan)),
        #[cfg(feature = "ros2")]
        "ros2" => boxed(ros2::Ros2::new(settings, plan)),
        #[cfg(feature = "zenoh")]
        "zenoh" => boxed(Some(zenoh::Zenoh::new(settings, plan))),
        #[cfg(feature = "foxglove")]
        "foxglove" => boxed(foxglove::Foxglove::new(settings, plan)),
        _ => None,
    }
}

fn boxed(sink: Option<impl Sink>) -> Option<Box<dyn Sink>> {
    sink.map(|sink| Box::new(sink) as Box<dyn Sink>)
}

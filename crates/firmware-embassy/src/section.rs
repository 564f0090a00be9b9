//! What a kind of device adds to a project.

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_diagnostics::Diagnostic;

use super::context::Context;
use super::item::{Constant, Item};
use super::lack::{Missing, Printed};
use sensedsl_job::{Cycle, JobConnection, JobStream};

/// What one kind adds. A text is a line of Rust at most; `plan.rs` puts the sections together and looks into none.
#[derive(Debug, Default)]
pub(super) struct Section {
    /// What the wiring hands over, in order.
    pub(super) fields: Vec<Field>,
    /// The handlers of interrupts.
    pub(super) handlers: Handlers,
    /// Statics and tasks of `main.rs`.
    pub(super) items: Vec<Item>,
    /// Constants of `tables.rs`.
    pub(super) tables: Vec<Constant>,
    /// Statements that start tasks.
    pub(super) starts: Vec<Start>,
    /// What the reporter keeps.
    pub(super) keeps: Vec<Keep>,
    /// What else it keeps, and what it looks at in each cycle.
    pub(super) states: Vec<String>,
    pub(super) polls: Vec<Vec<String>>,
    /// What the host sets: the fields of `Outputs`, and what is done for an item.
    pub(super) outputs: Vec<Field>,
    pub(super) sets: BTreeMap<usize, Vec<String>>,
    /// What is done with outputs at the start.
    pub(super) begins: Vec<String>,
    /// What is done first when the host is silent.
    pub(super) hushes: Vec<String>,
    /// What is done when the host is silent.
    pub(super) fails: Vec<String>,
    /// The cycles of the tasks, which the watchdog watches.
    pub(super) watched: Vec<Watched>,
    /// What the link goes over.
    pub(super) link: LinkPlan,
    /// Features of `sense-embassy`: the versions of units that are in use.
    pub(super) features: BTreeSet<&'static str>,
}

/// What the link to the host goes over.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum LinkPlan {
    /// Nothing that is known yet.
    #[default]
    None,
    /// A USB device.
    Usb,
    /// A USB device that can be a host as well.
    Otg,
    /// A serial port.
    Uart,
}

/// A statement of `main`.
#[derive(Clone, Debug)]
pub(super) enum Start {
    /// Something is made that tasks share.
    Make(String),
    /// A task of a priority is started by this call.
    Task(i8, String),
}

impl Start {
    pub(super) fn prio(&self) -> Option<i8> {
        match self {
            Self::Make(_) => None,
            Self::Task(prio, _) => Some(*prio),
        }
    }
}

/// The handlers of each interrupt.
pub(super) type Handlers = BTreeMap<String, BTreeSet<String>>;

/// A line of the wiring: a device or a unit, and what it is made of.
#[derive(Clone, Debug)]
pub(super) struct Field {
    pub(super) name: String,
    /// `IRFront at PB0 (ADC12-IN8)`
    pub(super) comment: String,
    pub(super) type_: String,
    pub(super) make: String,
}

/// Something that the reporter keeps.
#[derive(Clone, Debug)]
pub(super) struct Keep {
    /// Its parameter, which may be `mut`.
    pub(super) name: String,
    pub(super) type_: String,
    /// What is handed over for it.
    pub(super) from: String,
}

/// A task that must make its cycles.
#[derive(Clone, Debug)]
pub(super) struct Watched {
    /// The constant with its number.
    pub(super) constant: String,
    /// So long it may take to a beat, beside what every task may be late.
    pub(super) cycle_ms: u32,
    /// The identifier of its first device.
    pub(super) device: u8,
}

impl Watched {
    pub(super) fn new(constant: String, cycle: Cycle, device: u8) -> Self {
        Self { constant, cycle_ms: cycle.delay_ms.saturating_add(cycle.start_ms), device }
    }
}

/// A kind of device.
pub(super) type Peripheral = fn(&Context<'_>, &mut Vec<Diagnostic>) -> Section;

impl Section {
    /// Binds a handler to an interrupt.
    pub(super) fn bind(&mut self, interrupt: &str, handler: String) {
        self.handlers.entry(interrupt.to_owned()).or_default().insert(handler);
    }

    /// The DMA channel of a request of a unit, with its handler bound.
    pub(super) fn stream(
        &mut self,
        context: &Context<'_>,
        wire: &JobConnection<'_>,
        request: &str,
    ) -> Printed<String> {
        let of = |one: &&JobStream<'_>| one.request.ends_with(request);
        let stream = wire.streams.iter().find(of);
        let stream =
            stream.ok_or_else(|| Missing::wire(format!("a DMA stream for {request}")))?.stream;
        let channel = context.names.channel(stream);
        let channel = channel.ok_or_else(|| Missing::name(format!("the DMA stream {stream}")))?;
        let interrupt = context.interrupt(&channel, "GLOBAL")?;
        self.bind(interrupt, format!("hal::dma::InterruptHandler<{channel}>"));
        Ok(channel)
    }

    /// Takes over what another has.
    pub(super) fn append(&mut self, mut other: Self) {
        self.fields.append(&mut other.fields);
        for (interrupt, handlers) in other.handlers {
            self.handlers.entry(interrupt).or_default().extend(handlers);
        }
        self.items.append(&mut other.items);
        self.tables.append(&mut other.tables);
        self.starts.append(&mut other.starts);
        self.keeps.append(&mut other.keeps);
        self.states.append(&mut other.states);
        self.polls.append(&mut other.polls);
        self.outputs.append(&mut other.outputs);
        for (index, sets) in other.sets {
            self.sets.entry(index).or_default().extend(sets);
        }
        self.begins.append(&mut other.begins);
        self.hushes.append(&mut other.hushes);
        self.fails.append(&mut other.fails);
        self.watched.append(&mut other.watched);
        if other.link != LinkPlan::None {
            self.link = other.link;
        }
        self.features.append(&mut other.features);
    }
}

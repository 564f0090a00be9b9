//! What a kind of device adds to a project, as data.

use std::collections::{BTreeMap, BTreeSet};

use super::item::{Constant, Item};
use sensedsl_job::Cycle;

/// What one kind adds. A text is at most one line of Rust; `plan.rs` joins the sections and looks into none of them.
#[derive(Debug, Default)]
pub(super) struct Section {
    /// The fields of `Wiring`, in order.
    pub(super) fields: Vec<Field>,
    /// The handlers of interrupts.
    pub(super) handlers: Handlers,
    /// Statics and tasks of `main.rs`.
    pub(super) items: Vec<Item>,
    /// Constants of `tables.rs`.
    pub(super) tables: Vec<Constant>,
    /// Statements that start tasks.
    pub(super) starts: Vec<Start>,
    /// The parameters of the reporter.
    pub(super) keeps: Vec<Keep>,
    /// The reporter's variables, a statement each.
    pub(super) states: Vec<String>,
    /// Blocks of statements that the reporter runs in each cycle.
    pub(super) polls: Vec<Vec<String>>,
    /// The fields of `Outputs`, which the host sets.
    pub(super) outputs: Vec<Field>,
    /// The statements that set an item, by its index.
    pub(super) sets: BTreeMap<usize, Vec<String>>,
    /// Statements of `main` before tasks are started.
    pub(super) begins: Vec<String>,
    /// The first statements when the host is silent.
    pub(super) hushes: Vec<String>,
    /// The statements with the outputs when whoever sets them is silent, with the index of the item.
    pub(super) fails: Vec<(usize, String)>,
    /// The tasks that the watchdog watches.
    pub(super) watched: Vec<Watched>,
    /// How the link is made.
    pub(super) link: LinkPlan,
    /// Features of `sense-embassy` for the versions of units in use.
    pub(super) features: BTreeSet<&'static str>,
}

/// How the link to the host is made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum LinkPlan {
    /// The section does not make it.
    #[default]
    None,
    /// A USB device.
    Usb,
    /// A USB device that can be a host as well.
    Otg,
    /// A serial port.
    Uart,
    /// A port that carries bytes, with a task of its own.
    Stream,
}

impl LinkPlan {
    /// Whether a task has the driver, and queues lie between it and the reporter.
    pub(super) fn is_queued(self) -> bool {
        matches!(self, Self::Usb | Self::Otg | Self::Stream)
    }
}

/// A statement of `main`.
#[derive(Clone, Debug)]
pub(super) enum Start {
    /// It makes something that tasks share.
    Make(String),
    /// It starts a task of a priority by this call.
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

/// A field of `Wiring` or `Outputs`: a device or a unit, and what it is made of.
#[derive(Clone, Debug)]
pub(super) struct Field {
    pub(super) name: String,
    /// `IRFront at PB0 (ADC12-IN8)`
    pub(super) comment: String,
    pub(super) type_: String,
    pub(super) make: String,
}

/// A parameter of the reporter.
#[derive(Clone, Debug)]
pub(super) struct Keep {
    /// Its name, which may begin with `mut`.
    pub(super) name: String,
    pub(super) type_: String,
    /// The argument.
    pub(super) from: String,
}

/// A task that the watchdog watches.
#[derive(Clone, Debug)]
pub(super) struct Watched {
    /// The constant that has its number.
    pub(super) constant: String,
    /// How long it may take from beat to beat, besides the delay that every task may have.
    pub(super) cycle_ms: u32,
    /// The identifier of its first device.
    pub(super) device: u8,
}

impl Watched {
    pub(super) fn new(constant: String, cycle: Cycle, device: u8) -> Self {
        Self { constant, cycle_ms: cycle.delay_ms.saturating_add(cycle.start_ms), device }
    }
}

/// What a HAL's driver is made of.
#[derive(Clone, Debug)]
pub(super) struct Constructor {
    /// The type in `wiring.rs`.
    pub(super) type_: String,
    /// The expression that makes it of the peripherals `p`.
    pub(super) make: String,
}

impl Field {
    /// A field that has a driver.
    pub(super) fn of(name: String, comment: String, made: Constructor) -> Self {
        Self { name, comment, type_: made.type_, make: made.make }
    }
}

impl Section {
    /// Binds a handler to an interrupt.
    pub(super) fn bind(&mut self, interrupt: &str, handler: String) {
        self.handlers.entry(interrupt.to_owned()).or_default().insert(handler);
    }

    /// Adds everything that another section has.
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

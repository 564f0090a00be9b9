//! What the kinds add to `main.rs` and `tables.rs`, as data that templates print. A text here is a line of Rust at most.

use sensedsl_job::Cycle;

/// An item of `main.rs`.
#[derive(Debug)]
pub(super) enum Item {
    /// A declaration.
    Line(String),
    /// A declaration with its documentation.
    Static {
        /// Without a full stop.
        doc: String,
        /// The declaration.
        line: String,
    },
    /// A task.
    Task(Task),
    /// The handler of an interrupt.
    Handler(Handler),
    /// A function that drives a bridge.
    Bridge(BridgeItem),
}

/// A task: what it keeps, and what it does for ever.
#[derive(Debug)]
pub(super) struct Task {
    /// Its documentation, without a full stop.
    pub(super) doc: String,
    pub(super) ident: String,
    /// `name: Type`
    pub(super) parameters: Vec<String>,
    /// When it starts among those that take turns.
    pub(super) start_ms: u32,
    /// Statements before the loop.
    pub(super) before: Vec<String>,
    /// Statements of the loop; none: there is no loop.
    pub(super) cycle: Vec<String>,
}

impl Task {
    /// A task that waits for something, without a cycle.
    pub(super) fn new(doc: String, ident: String) -> Self {
        Self {
            doc,
            ident,
            parameters: Vec::new(),
            start_ms: 0,
            before: Vec::new(),
            cycle: Vec::new(),
        }
    }

    /// A task that starts when the turn of its cycle comes.
    pub(super) fn in_turn(doc: String, ident: String, cycle: Cycle) -> Self {
        Self { start_ms: cycle.start_ms, ..Self::new(doc, ident) }
    }

    /// What it does in each cycle: the statements, then the beat that the watchdog waits for, then the next tick.
    pub(super) fn ticks(&mut self, delay_ms: u32, statements: Vec<String>, constant: &str) {
        self.before
            .push(format!("let mut ticker = Ticker::every(Duration::from_millis({delay_ms}));"));
        self.cycle = statements;
        self.cycle.push(beat(constant));
        self.cycle.push("ticker.next().await;".to_owned());
    }
}

/// Tells the watchdog that a task has made its cycle.
pub(super) fn beat(constant: &str) -> String {
    format!("WATCH.beat(tables::{constant}, now_ms());")
}

/// The handler of an interrupt: a type that is bound to it.
#[derive(Debug)]
pub(super) struct Handler {
    /// Its documentation, without a full stop.
    pub(super) doc: String,
    pub(super) name: String,
    /// What it is called as: `the device`.
    pub(super) named_as: &'static str,
    pub(super) interrupt: String,
    /// What it does.
    pub(super) calls: Vec<String>,
}

/// The outputs of a bridge.
#[derive(Debug)]
pub(super) struct BridgeItem {
    /// The device.
    pub(super) name: String,
    pub(super) ident: String,
    pub(super) constant: String,
    /// By output: a pattern and what is done.
    pub(super) arms: Vec<(String, String)>,
}

/// A constant of `tables.rs` with members, a line each.
#[derive(Debug)]
pub(super) struct Table {
    pub(super) name: String,
    pub(super) type_: &'static str,
    pub(super) members: Vec<(&'static str, Entry)>,
    /// Whether members that are not named are as usual.
    pub(super) has_more: bool,
}

/// A member of a table.
#[derive(Debug)]
pub(super) enum Entry {
    /// A value.
    One(String),
    /// A list with a line for each.
    Many(Vec<String>),
}

/// A constant of `tables.rs`.
#[derive(Debug)]
pub(super) enum Constant {
    /// On one line.
    Line(String),
    /// With members.
    Table(Table),
    /// A list with a line for each.
    List {
        /// Without a full stop; may be empty.
        doc: &'static str,
        /// `NAME: TYPE`
        declaration: String,
        /// The entries.
        entries: Vec<String>,
    },
}

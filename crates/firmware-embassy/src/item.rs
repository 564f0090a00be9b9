//! What kinds add to `main.rs` and `tables.rs`, as data that templates print. A text is at most one line of Rust.

use sensedsl_job::Cycle;

/// An item of `main.rs`.
#[derive(Debug)]
pub(super) enum Item {
    /// A declaration.
    Line(String),
    /// A declaration with its documentation.
    Static {
        /// The documentation, without a full stop.
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

/// A task: what it keeps, and what it does in its loop.
#[derive(Debug)]
pub(super) struct Task {
    /// The documentation, without a full stop.
    pub(super) doc: String,
    pub(super) ident: String,
    /// `name: Type`
    pub(super) parameters: Vec<String>,
    /// The delay of its start: tasks with the same cycle take turns.
    pub(super) start_ms: u32,
    /// Statements before the loop.
    pub(super) before: Vec<String>,
    /// Statements of the loop; there is no loop if there are none.
    pub(super) cycle: Vec<String>,
}

impl Task {
    /// A task without a cycle, which waits for something.
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

    /// Makes a loop of statements, the beat that the watchdog waits for, and the wait for the next tick.
    pub(super) fn ticks(&mut self, delay_ms: u32, statements: Vec<String>, constant: &str) {
        self.before
            .push(format!("let mut ticker = Ticker::every(Duration::from_millis({delay_ms}));"));
        self.cycle = statements;
        self.cycle.push(beat(constant));
        self.cycle.push("ticker.next().await;".to_owned());
    }
}

/// The statement that reports a cycle of a task to the watchdog.
pub(super) fn beat(constant: &str) -> String {
    format!("WATCH.beat(tables::{constant}, now_ms());")
}

/// The handler of an interrupt: a type that is bound to it.
#[derive(Debug)]
pub(super) struct Handler {
    /// The documentation, without a full stop.
    pub(super) doc: String,
    pub(super) name: String,
    /// What it is named after: `the device`.
    pub(super) named_as: &'static str,
    pub(super) interrupt: String,
    /// Its statements.
    pub(super) calls: Vec<String>,
}

/// The outputs of a bridge.
#[derive(Debug)]
pub(super) struct BridgeItem {
    /// The device.
    pub(super) name: String,
    pub(super) ident: String,
    pub(super) constant: String,
    /// The arms of a `match` over the outputs: a pattern and an expression each.
    pub(super) arms: Vec<(String, String)>,
}

/// A constant of `tables.rs` with members, a line each.
#[derive(Debug)]
pub(super) struct Table {
    pub(super) name: String,
    pub(super) type_: &'static str,
    pub(super) members: Vec<(&'static str, Entry)>,
    /// Whether members that are not named have their usual values.
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
        /// The documentation, without a full stop; may be empty.
        doc: &'static str,
        /// `NAME: TYPE`
        declaration: String,
        /// The entries.
        entries: Vec<String>,
    },
}

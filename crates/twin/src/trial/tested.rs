//! A board in a test, as its host sees it, and why it can go no further.

use crate::commands::outputs::Outputs;
use crate::plants::Trouble;
use crate::soft::SoftBoard;

/// Why a run ended before its end.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Stopped {
    /// When.
    pub at_ns: u64,
    /// What has failed.
    pub culprit: Culprit,
    /// Why, for people.
    pub why: String,
}

/// What ends a run before its end.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Culprit {
    /// The code of controllers.
    Code,
    /// The program of a plant of the world, by the plant's name.
    Plant(String),
    /// The board itself.
    Board,
}

/// A board in a test: one that this program imitates, an image on an emulated MCU, or a real one.
pub trait Tested {
    /// The time since the beginning.
    fn now_ns(&self) -> u64;
    /// Goes on until that time.
    fn run_until(&mut self, until_ns: u64);
    /// The host opens its port.
    fn link_open(&mut self);
    /// The host sends bytes.
    fn link_write(&mut self, bytes: &[u8]);
    /// The bytes that have arrived since the last call.
    fn link_read(&mut self) -> Vec<u8>;
    /// Whether [`Tested::applied`] tells what the board has.
    fn sees_inside(&self) -> bool {
        false
    }
    /// The bytes of the value that a device of the schema has.
    fn applied(&self, _index: usize) -> Option<&[u8]> {
        None
    }
    /// What its wires do; `None` if nobody measures them.
    fn outputs(&self) -> Option<Outputs> {
        None
    }
    /// Why it cannot go on.
    fn stopped(&mut self) -> Option<Stopped>;
}

impl Tested for SoftBoard {
    fn now_ns(&self) -> u64 {
        self.now_ns()
    }

    fn run_until(&mut self, until_ns: u64) {
        self.run_until(until_ns);
        // Nobody asks for what was set: it is in the values.
        let _ = self.received();
    }

    fn link_open(&mut self) {
        self.link_open(true);
    }

    fn link_write(&mut self, bytes: &[u8]) {
        self.link_write(bytes);
    }

    fn link_read(&mut self) -> Vec<u8> {
        self.link_read()
    }

    fn sees_inside(&self) -> bool {
        true
    }

    fn applied(&self, index: usize) -> Option<&[u8]> {
        self.applied(index)
    }

    fn stopped(&mut self) -> Option<Stopped> {
        let of_code =
            self.code_ended().map(|(at_ns, why)| Stopped { at_ns, culprit: Culprit::Code, why });
        of_code.or_else(|| self.bench().trouble().map(Stopped::of_plant))
    }
}

impl Stopped {
    /// A program of the world has failed.
    #[must_use]
    pub fn of_plant(trouble: Trouble) -> Self {
        let Trouble { at_ns, plant, why, .. } = trouble;
        Self { at_ns, culprit: Culprit::Plant(plant), why }
    }
}

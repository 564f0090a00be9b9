//! The handlers of pin interrupts: which lines run when a pin changes, put together for each interrupt.
//!
//! In: what sections want done at which pins. Out: functions for pins with an interrupt of their own, and one handler for
//! each interrupt that pins share, which finds out which of them has changed.

use std::collections::BTreeMap;

use crate::context::{Context, port_and_mask};
use crate::names::Interrupt;
use crate::section::Change;

/// All handlers of a board.
#[derive(Clone, Debug, Default)]
pub(crate) struct Handlers {
    /// Those of pins with an interrupt of their own.
    pub(crate) external: Vec<External>,
    /// Those of pins that share one.
    pub(crate) banks: Vec<Bank>,
}

/// The handler of one pin.
#[derive(Clone, Debug)]
pub(crate) struct External {
    /// The framework's number of the pin.
    pub(crate) number: u8,
    pub(crate) lines: Vec<String>,
}

/// The handler of an interrupt that pins share.
#[derive(Clone, Debug)]
pub(crate) struct Bank {
    pub(crate) number: usize,
    /// The bits of the pins that are used: what goes into `PCMSKn`.
    pub(crate) mask: String,
    pub(crate) ports: Vec<Port>,
}

/// The pins of one port in a handler.
#[derive(Clone, Debug)]
pub(crate) struct Port {
    /// `D`
    pub(crate) letter: char,
    /// What runs, by the pins one of which must have changed.
    pub(crate) groups: Vec<Group>,
}

/// What runs when one of some pins has changed.
#[derive(Clone, Debug)]
pub(crate) struct Group {
    /// `0x0CU`
    pub(crate) mask: String,
    pub(crate) lines: Vec<String>,
}

impl Handlers {
    pub(crate) fn new<'a>(
        context: &Context<'_>,
        changes: impl Iterator<Item = &'a Change>,
    ) -> Self {
        let mut external: BTreeMap<u8, Vec<String>> = BTreeMap::new();
        let mut banks: BTreeMap<usize, Vec<(usize, &Change)>> = BTreeMap::new();
        for change in changes {
            match context.names.interrupt(&change.pin) {
                Some(Interrupt::External) => {
                    let Some(number) = context.names.number(&change.pin) else { continue };
                    external.entry(number).or_default().push(change.line.clone());
                }
                Some(Interrupt::Bank { number, bit }) => {
                    banks.entry(number).or_default().push((bit, change));
                }
                None => {}
            }
        }
        let external = external.into_iter().map(|(number, lines)| External { number, lines });
        let bank = |(number, all): (usize, Vec<(usize, &Change)>)| Bank::new(number, &all);
        Self { external: external.collect(), banks: banks.into_iter().map(bank).collect() }
    }
}

impl Bank {
    fn new(number: usize, all: &[(usize, &Change)]) -> Self {
        let mask = all.iter().fold(0_u32, |mask, (bit, _)| mask | 1 << bit);
        // Lines that several pins want run once, however many of these have changed.
        let mut ports: BTreeMap<char, BTreeMap<&str, u32>> = BTreeMap::new();
        for (_, change) in all {
            let (letter, _) = port_and_mask(&change.pin);
            let bit = 1 << change.pin.number().unwrap_or(0);
            *ports.entry(letter).or_default().entry(&change.line).or_default() |= bit;
        }
        let port = |(letter, lines): (char, BTreeMap<&str, u32>)| {
            let mut groups: BTreeMap<u32, Vec<String>> = BTreeMap::new();
            for (line, mask) in lines {
                // The levels are those that were looked at.
                let line = line.replace(&format!("PIN{letter}"), "now");
                groups.entry(mask).or_default().push(line);
            }
            let group =
                |(mask, lines): (u32, Vec<String>)| Group { mask: format!("0x{mask:02X}U"), lines };
            Port { letter, groups: groups.into_iter().map(group).collect() }
        };
        Self {
            number,
            mask: format!("0x{mask:02X}U"),
            ports: ports.into_iter().map(port).collect(),
        }
    }
}

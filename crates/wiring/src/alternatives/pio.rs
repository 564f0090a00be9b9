//! Programmable state machines: those of a block run one program, and each device takes one of them. Which one it is is
//! no wire, so they are dealt out as DMA streams are.

use sensedsl_board::signal::Function;
use sensedsl_board::table::{Pin, Usage};
use sensedsl_model::kind::Role;

use super::candidates::Need;
use super::{Alternatives, Maker, unit_fits};
use crate::names::{Group, Resource};

impl Maker<'_, '_> {
    /// The ways to have these wires read by a machine with the program; none if the system programs none.
    pub(super) fn machines(&mut self, program: &'static str, wires: &[Role]) -> Vec<Alternatives> {
        let blocks = self.profile().map(|profile| profile.pios.clone()).unwrap_or_default();
        let mut made = Vec::new();
        for block in blocks.iter().filter(|block| unit_fits(self.offer, self.wanted, &block.name)) {
            let reaches = |pin: &Pin| block.reaches(&pin.name);
            let reads = |usage: &Usage| matches!(usage.signal.function(), Function::Pio { unit } if unit.as_str() == block.name);
            let need = Need::Reached(&reaches, &reads);
            let mut roles: Vec<_> =
                wires.iter().map(|role| self.role(*role, &need, None)).collect();
            self.push_gpios(&mut roles);
            let board = self.offer.index;
            let resource = Resource::Unit(board, block.name.clone());
            let group = Group::Program(board, block.name.clone(), program);
            let claim = self.builder.names.shared(resource, group);
            let machine = self.builder.machine(board, block);
            for (mut alternative, meaning) in self.finish(Some(&block.name), &[claim], roles) {
                alternative.dma.push(machine);
                made.push((alternative, meaning));
            }
        }
        made
    }
}

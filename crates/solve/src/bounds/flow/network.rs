//! The nodes of the flow network: numbers for demands, gates and pins.

use crate::index::{DemandId, GateId, Id, NodeId, WireId};
use crate::problem::PinId;

/// How nodes are numbered: demands, then two for each gate, then pins.
#[derive(Clone, Copy, Debug)]
pub(super) struct Layout {
    /// Number of demands of devices; those of shared wires follow.
    pub(super) device_demands: usize,
    pub(super) demands: usize,
    pub(super) gates: usize,
}

#[derive(Clone, Copy)]
pub(super) enum Node {
    Demand(DemandId),
    GateIn(GateId),
    GateOut(GateId),
    Pin(PinId),
}

impl Layout {
    pub(super) fn wire(self, wire: WireId) -> DemandId {
        DemandId::new(self.device_demands + wire.index())
    }

    /// The shared wire of a demand, if it is one.
    pub(super) fn wire_of(self, demand: DemandId) -> Option<WireId> {
        demand.index().checked_sub(self.device_demands).map(WireId::new)
    }

    #[inline]
    pub(super) fn id(self, node: Node) -> NodeId {
        NodeId::new(match node {
            Node::Demand(demand) => demand.index(),
            Node::GateIn(gate) => self.demands + 2 * gate.index(),
            Node::GateOut(gate) => self.demands + 2 * gate.index() + 1,
            Node::Pin(pin) => self.demands + 2 * self.gates + pin.index(),
        })
    }

    #[inline]
    pub(super) fn node(self, id: NodeId) -> Node {
        let index = id.index();
        let pins = self.demands + 2 * self.gates;
        if index < self.demands {
            Node::Demand(DemandId::new(index))
        } else if index >= pins {
            Node::Pin(PinId::new(index - pins))
        } else {
            let gate = GateId::new((index - self.demands) / 2);
            let enters = (index - self.demands).is_multiple_of(2);
            if enters { Node::GateIn(gate) } else { Node::GateOut(gate) }
        }
    }
}

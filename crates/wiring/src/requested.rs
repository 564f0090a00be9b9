//! The wires that a connection or a link wants.
//!
//! In: a connection of the design, or a board's link. Out: everything that decides which wires it
//! can have, in one form for both.

use sensedsl_board::pin::PinName;
use sensedsl_model::design::{BoardIndex, Connection, PartIndex, PinRef, Placement, Preference};
use sensedsl_model::kind::{Kind, Role};
use sensedsl_wire::Direction;

/// The wires that a connection or a link wants.
pub(crate) struct RequestedWires<'a> {
    /// The part; `None` for a link.
    pub(crate) part: Option<PartIndex>,
    /// Whether it is one element of an array.
    pub(crate) is_element: bool,
    pub(crate) kind: &'a Kind,
    pub(crate) direction: Direction,
    /// The boards it may go to.
    pub(crate) boards: Vec<BoardIndex>,
    pub(crate) pins: Vec<(Role, PinRef)>,
    pub(crate) unit: Option<&'a str>,
    pub(crate) side: Option<&'a str>,
    pub(crate) header: Option<&'a str>,
    pub(crate) wishes: &'a [Preference],
    /// The voltage that the device puts on the pins, in millivolts, if it is stated.
    pub(crate) level_mv: Option<u32>,
}

impl<'a> RequestedWires<'a> {
    pub(crate) fn connection(connection: &'a Connection, boards: Vec<BoardIndex>) -> Self {
        let Placement { pins, unit, side, header, .. } = &connection.placement;
        Self {
            part: Some(connection.part),
            is_element: connection.element.is_some(),
            kind: &connection.kind,
            direction: connection.direction,
            boards,
            pins: pins.iter().map(|(role, pin)| (*role, pin.value.clone())).collect(),
            unit: unit.as_ref().map(|unit| unit.value.as_str()),
            side: side.as_ref().map(|side| side.value.as_str()),
            header: header.as_ref().map(|header| header.value.as_str()),
            wishes: &connection.wishes,
            level_mv: connection.level.map(|level| level.at_pin_mv()),
        }
    }

    /// A serial link; `pins` are TX and RX if the board has wired them.
    pub(crate) fn link(
        board: BoardIndex,
        kind: &'a Kind,
        unit: Option<&'a str>,
        pins: &[PinName],
    ) -> Self {
        let boards = vec![board];
        let direction = Direction::Sensor;
        let pins = pins.iter().map(|pin| PinRef::of_board(board, pin.clone()));
        let pins = [Role::Tx, Role::Rx].into_iter().zip(pins).collect();
        let (side, header) = (None, None);
        let (part, is_element, level_mv, wishes) = (None, false, None, &[]);
        Self {
            part,
            is_element,
            kind,
            direction,
            boards,
            pins,
            unit,
            side,
            header,
            wishes,
            level_mv,
        }
    }

    pub(crate) fn fixed(&self, role: Role) -> Option<&PinRef> {
        self.pins.iter().find(|(fixed, _)| *fixed == role).map(|(_, pin)| pin)
    }
}

/// Gives up what fixes the wires.
pub(crate) fn free(wanted: &mut RequestedWires<'_>) {
    wanted.pins.clear();
    wanted.unit = None;
    wanted.side = None;
    wanted.header = None;
}

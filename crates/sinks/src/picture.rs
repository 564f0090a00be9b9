//! The latest of everything, for who comes later: events in, the state of all boards out.

use sensedsl_wire::{Health, Scalar};

use crate::event::{Event, Values};
use crate::plan::Plan;

/// The state of a board.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BoardState {
    /// Whether it is there.
    pub is_online: bool,
    /// Why it is not there, where that is known.
    pub away: Option<String>,
    /// The latest value of each device; each stands alone in its report.
    pub latest: Vec<Option<Values>>,
    /// What it told of itself.
    pub health: Option<Health>,
}

/// The state of all boards.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Picture {
    /// The boards, in their order.
    pub boards: Vec<BoardState>,
}

impl Picture {
    /// Nothing is known yet.
    #[must_use]
    pub fn new(plan: &Plan) -> Self {
        let of = |count| BoardState { latest: vec![None; count], ..BoardState::default() };
        Self { boards: plan.boards.iter().map(|on| of(on.routes.len())).collect() }
    }

    /// Takes what happened.
    pub fn take(&mut self, event: &Event) {
        match event {
            Event::Values(values) => {
                let Some(board) = self.boards.get_mut(values.board) else { return };
                for (index, value) in &values.values {
                    if let Some(latest) = board.latest.get_mut(*index) {
                        let one = vec![(*index, value.clone())];
                        *latest = Some(Values { values: one, ..values.clone() });
                    }
                }
            }
            Event::Presence { board, away } => {
                if let Some(board) = self.boards.get_mut(*board) {
                    board.is_online = away.is_none();
                    board.away.clone_from(away);
                }
            }
            Event::Health { board, health, .. } => {
                if let Some(board) = self.boards.get_mut(*board) {
                    board.health = Some(health.clone());
                }
            }
        }
    }

    /// The latest values of all devices.
    pub fn values(&self) -> impl Iterator<Item = &Values> {
        self.boards.iter().flat_map(|board| board.latest.iter().flatten())
    }

    /// The latest raw value of a device.
    #[must_use]
    pub fn raw(&self, board: usize, index: usize) -> Option<&[Scalar]> {
        let values = self.boards.get(board)?.latest.get(index)?.as_ref()?;
        values.values.first().map(|(_, raw)| raw.as_slice())
    }
}

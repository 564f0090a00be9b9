//! The linear program of the Lagrangian bound: dualized constraints and domains in, a matrix and
//! the meaning of its columns out.
//!
//! Interchangeable devices that have the same choices left when the program is made share one set
//! of columns, which count them. This keeps the program small, and no branch of the search makes it
//! wrong: once the domains of these devices differ, it is only less sharp until it is made again. A
//! role with one way left has no columns; its entries go to the column that needs it.

mod builder;

use self::builder::Builder;
use super::dualized::Dualized;
use super::lp::Simplex;
use crate::domains::Domains;
use crate::index::{AltId, CandId, ColumnId, FacilityId, IdVec, PenaltyId, PriceId, RowId, Rows};
use crate::model::Model;
use crate::problem::DeviceId;

/// The column of an alternative or candidate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Column {
    /// It was not possible when the program was made.
    Absent,
    /// It is part of another column, or has no price.
    Merged,
    Of(ColumnId),
}

/// The program and what its columns stand for.
#[derive(Clone, Debug)]
pub(crate) struct Program {
    pub(crate) simplex: Simplex,
    /// For each device the first one of its group.
    pub(crate) group: IdVec<DeviceId, DeviceId>,
    /// Row of each price that something is tied to.
    pub(crate) price_row: IdVec<PriceId, Option<RowId>>,
    /// Column of an alternative of the first device of each group.
    pub(crate) alt_column: IdVec<AltId, Column>,
    /// Columns whose sum is the number of devices of the group at that alternative.
    pub(crate) counted: Rows<AltId, ColumnId>,
    pub(crate) cand_column: IdVec<CandId, Column>,
    /// Column of each facility that could be opened.
    pub(crate) opening: IdVec<FacilityId, Option<ColumnId>>,
    pub(crate) penalty: IdVec<PenaltyId, ColumnId>,
    /// The upper bound of each column while it is live. The exact bound has only a few of these
    /// limits. The others are too high to be reached, so they hide no part of the value.
    pub(crate) ceiling: IdVec<ColumnId, f64>,
    /// Columns that no domain bounds.
    pub(crate) loose: Vec<ColumnId>,
}

impl Program {
    /// The program of what the domains allow now.
    pub(crate) fn new(dualized: &Dualized, model: &Model, domains: &Domains) -> Self {
        let mut builder = Builder::new(dualized, model, domains);
        builder.covers();
        let group = groups(model, domains);
        for leader in model.devices.iter().filter(|&device| group[device] == device) {
            let class = model.class_of(model.class[leader]);
            builder.group(&class.filter(|&device| group[device] == leader).collect::<Vec<_>>());
        }
        for facility in dualized.facilities.ids() {
            builder.facility(facility);
        }
        let penalty = dualized.penalties.iter().map(|p| builder.penalty(p)).collect();
        builder.finish(penalty, group)
    }
}

/// For each device, the first that is interchangeable with it and has the same choices left.
fn groups(model: &Model, domains: &Domains) -> IdVec<DeviceId, DeviceId> {
    let first = |device: DeviceId| {
        let mut class = model.class_of(model.class[device]);
        class.find(|&other| domains.same_domain(model, other, device)).unwrap_or(device)
    };
    model.devices.iter().map(first).collect()
}

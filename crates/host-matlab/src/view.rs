//! The plan in MATLAB's words.

use sensedsl_job::host::{BoardPlan, HostPlan, MessagePlan};

use crate::names::{Fields, field, literal, plain};

/// A design.
pub(super) struct DesignView {
    /// The name of the design, on one line.
    pub(super) name: String,
    /// What stands behind `plot_`.
    pub(super) own: String,
    pub(super) boards: Vec<BoardView>,
}

/// A board.
pub(super) struct BoardView {
    pub(super) field: String,
    pub(super) name: String,
    /// Rows and columns of its plots.
    pub(super) rows: usize,
    pub(super) columns: usize,
    pub(super) devices: Vec<DeviceView>,
}

/// A device.
pub(super) struct DeviceView {
    pub(super) field: String,
    /// The place of its plot, from 1 on.
    pub(super) place: usize,
    pub(super) title: String,
    pub(super) unit: String,
    pub(super) table_type: String,
    pub(super) table_unit: String,
}

impl DesignView {
    pub(super) fn new(plan: &HostPlan) -> Self {
        let boards = plan.boards.iter().map(BoardView::new).collect();
        Self { name: plain(&plan.name), own: own(&plan.name), boards }
    }

    /// The first board, and its first device, for examples.
    pub(super) fn example(&self) -> Option<(&BoardView, &DeviceView)> {
        self.boards.iter().find_map(|board| Some((board, board.devices.first()?)))
    }
}

/// A function's name behind `plot_`: digits may stand first there, and keywords too.
fn own(name: &str) -> String {
    field(&format!("p{name}")).split_off(1)
}

impl BoardView {
    fn new(plan: &BoardPlan) -> Self {
        let mut fields = Fields::default();
        let devices = plan.devices.iter().filter_map(|device| {
            let is_it =
                |one: &&MessagePlan| (one.id, one.direction) == (device.id, device.direction);
            plan.messages().find(is_it)
        });
        let devices: Vec<DeviceView> = devices
            .enumerate()
            .map(|(place, one)| DeviceView::new(place + 1, fields.take(&one.name), one))
            .collect();
        // A column has up to six plots.
        let columns = devices.len().div_ceil(6).max(1);
        Self {
            field: field(&plan.name),
            name: literal(&plan.name),
            rows: devices.len().div_ceil(columns),
            columns,
            devices,
        }
    }
}

impl DeviceView {
    fn new(place: usize, field: String, plan: &MessagePlan) -> Self {
        let unit = plan.quantity.as_deref().unwrap_or_default();
        Self {
            field,
            place,
            title: literal(plan.label.as_deref().unwrap_or(&plan.name)),
            unit: literal(unit),
            table_type: plan.value.to_string(),
            table_unit: plain(unit).replace('|', "\\|"),
        }
    }
}

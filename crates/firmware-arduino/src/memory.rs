//! How much memory a sketch takes: what its tables and buffers come to, and the code that they need.
//!
//! In: the plan of a board. Out: the sum, what the MCU has, and what takes how much. The numbers are upper bounds by a
//! few percent; tests build sketches and compare.

use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::e0574_does_not_fit;

use crate::context::Context;
use crate::costs;
use crate::section::Cost;

/// What the framework takes without a port: its clock. Larger MCUs have more interrupts, and longer jumps.
const FRAMEWORK: (u32, u32) = (9, 1_300);
const FRAMEWORK_OF_LARGE_FLASH_BYTES: u32 = 2_700;
const LARGE_BYTES: u32 = 65_536;
/// An object of a port with its pointers, besides its buffers.
const PORT: (u32, u32) = (29, 900);
/// What a USB port of the framework takes: its object, and the state of the device.
const USB: (u32, u32) = (80 + 60, 3_200);
/// The loop, the values' store, the reporter and the decoder, without what grows with the design.
const RUNTIME: (u32, u32) = (88, 3_000);
/// An `up_health_device_t`, two bits of each of three bitmaps.
const FIELD_BYTES: u32 = 14;
/// A field's row in the schema, its name, its packing and unpacking.
const FIELD_FLASH_BYTES: u32 = 75;
/// The times of a task.
const TASK_BYTES: u32 = 8;
/// The stack: the deepest call of a task with an interrupt on top.
const STACK_BYTES: u32 = 260;

/// The memory of a sketch.
#[derive(Clone, Debug, Default)]
pub(crate) struct Memory {
    /// By what takes it, the largest first.
    pub(crate) costs: Vec<Cost>,
    pub(crate) ram_bytes: u32,
    pub(crate) flash_bytes: u32,
}

/// What grows with the design besides the sections.
pub(crate) struct Sizes {
    pub(crate) fields: usize,
    pub(crate) tasks: usize,
    pub(crate) values_bytes: usize,
    pub(crate) report_frame_bytes: usize,
    pub(crate) command_buffer_bytes: usize,
    pub(crate) received_bytes: usize,
    pub(crate) work_bytes: usize,
    pub(crate) scratch_bytes: usize,
    pub(crate) is_usb: bool,
}

impl Memory {
    pub(crate) fn new<'a>(
        context: &Context<'_>,
        sizes: &Sizes,
        sections: impl Iterator<Item = &'a Cost>,
    ) -> Self {
        let count = |number: usize| u32::try_from(number).unwrap_or(u32::MAX);
        let (port_ram, port_flash) = if sizes.is_usb { USB } else { PORT };
        let buffers = if sizes.is_usb { 0 } else { context.names.uart_buffers_bytes };
        let frames = count(sizes.report_frame_bytes + sizes.command_buffer_bytes);
        let values = count(sizes.values_bytes + sizes.received_bytes + sizes.scratch_bytes);
        let fields = count(sizes.fields);
        let is_large = context.names.flash_bytes > LARGE_BYTES;
        let framework_flash_bytes =
            if is_large { FRAMEWORK_OF_LARGE_FLASH_BYTES } else { FRAMEWORK.1 };
        let mut costs = vec![
            Cost::new("the framework", FRAMEWORK.0, framework_flash_bytes),
            Cost::new("the port of the link", port_ram + buffers, port_flash),
            Cost::new("the runtime", RUNTIME.0, RUNTIME.1),
            Cost::new("the frames of the link", frames, 0),
            Cost::new("the values", values, fields * FIELD_FLASH_BYTES),
            Cost::new("the health of the devices", fields * FIELD_BYTES, 0),
            Cost::new("the tasks", count(sizes.tasks) * TASK_BYTES, count(sizes.tasks) * 14),
            Cost::new("the buffer of buses", count(sizes.work_bytes), 0),
            Cost::new("the stack", STACK_BYTES, 0),
        ];
        // Code that several sections need is there once.
        for one in sections.cloned().chain(costs::of_values(context.job)) {
            if !costs.contains(&one) {
                costs.push(one);
            }
        }
        let ram_bytes = costs.iter().map(|one| one.ram_bytes).sum();
        let flash_bytes = costs.iter().map(|one| one.flash_bytes).sum();
        costs.retain(|one| one.ram_bytes > 0 || one.flash_bytes > 0);
        costs.sort_by_key(|one| std::cmp::Reverse((one.ram_bytes, one.flash_bytes)));
        Self { costs, ram_bytes, flash_bytes }
    }

    /// The report for a sketch that the MCU has no room for.
    pub(crate) fn report(&self, context: &Context<'_>) -> Vec<Diagnostic> {
        let board = &context.job.board.name;
        let report = |what: &str, needed: u32, room: u32, bytes: fn(&Cost) -> u32| {
            let mut costs: Vec<&Cost> = self.costs.iter().collect();
            costs.sort_by_key(|one| std::cmp::Reverse(bytes(one)));
            let largest: Vec<(&str, u32)> =
                costs.iter().take(3).map(|one| (one.what.as_str(), bytes(one))).collect();
            (needed > room).then(|| {
                let name = &board.value;
                e0574_does_not_fit::does_not_fit(board.span, name, what, (needed, room), &largest)
            })
        };
        let ram = report("RAM", self.ram_bytes, context.names.ram_bytes, |one| one.ram_bytes);
        let flash =
            report("flash", self.flash_bytes, context.names.flash_bytes, |one| one.flash_bytes);
        ram.into_iter().chain(flash).collect()
    }
}

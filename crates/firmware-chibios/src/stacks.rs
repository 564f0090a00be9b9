//! The stack sizes of threads, from what each thread does, as `tests/timing/stacks.py` measures it.

use super::context::Context;
use sensedsl_job::JobDevice;

/// The deepest call path of a thread in bytes, in either mode, on a core with the small instruction set (Cortex-M0 and
/// M0+) and on the others. Interrupt frames and the kernel's saved context come on top; the kernel adds them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Depth {
    /// If no value of the board has a filter with memory.
    pub(super) plain: [u32; 2],
    /// If a value has a filter with `median`, `smooth` or `change`.
    pub(super) filtered: [u32; 2],
}

impl Depth {
    /// The bytes to reserve: a quarter more than the deepest path. They do not include a user's transform
    /// (`UP_TRANSFORM_BYTES`).
    pub(super) fn stack_bytes(&self, context: &Context<'_>) -> u32 {
        let [small, other] =
            if context.job.devices.iter().any(remembers) { self.filtered } else { self.plain };
        let is_small = context.names.tree.mcu.starts_with("cortex-m0");
        let deepest = if is_small { small } else { other };
        (deepest * 5).div_ceil(4).next_multiple_of(8)
    }
}

fn remembers(one: &JobDevice<'_>) -> bool {
    let filter = &one.device.filter;
    filter.median > 1 || filter.smooth_ms > 0 || filter.change.is_some()
}

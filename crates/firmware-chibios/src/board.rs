//! The files of the user's ChibiOS tree that the board is built from.

use super::context::Context;

/// Files of the tree, relative to its root, and the facts that they must agree with.
#[derive(Clone, Debug)]
pub(super) struct TreePlan {
    /// `21.11`
    pub(super) version: String,
    pub(super) mcu: String,
    /// The core's FPU, as a compiler option.
    pub(super) fpu: Option<String>,
    /// The stack sizes of the main thread and of interrupts.
    pub(super) process_stack_bytes: u32,
    pub(super) exceptions_stack_bytes: u32,
    /// The core's clock, which drives its cycle counter.
    pub(super) core_clock: String,
    pub(super) startup_mk: String,
    pub(super) platform_mk: String,
    pub(super) port_mk: String,
    pub(super) osal_mk: String,
    pub(super) rules_dir: String,
    pub(super) board_mk: String,
    pub(super) cfg_dir: String,
    pub(super) ldscript: String,
    /// Macros that the files need.
    pub(super) defines: Vec<String>,
    /// The macro with which `mcuconf.h` identifies its MCU.
    pub(super) mcuconf: String,
}

/// The stack sizes of the main thread and of interrupts.
const STACKS_BYTES: [u32; 2] = [1_536, 1_024];

pub(super) fn plan(context: &Context<'_>) -> TreePlan {
    let (profile, chibios) = (context.profile, &context.chibios);
    let tree = &context.names.tree;
    let [process_stack_bytes, exceptions_stack_bytes] =
        chibios.stacks_bytes.unwrap_or(STACKS_BYTES);
    TreePlan {
        version: profile.version().to_owned(),
        mcu: tree.mcu.clone(),
        fpu: tree.fpu.clone(),
        process_stack_bytes,
        exceptions_stack_bytes,
        core_clock: context.names.core_clock.clone(),
        startup_mk: tree.startup_mk.clone(),
        platform_mk: tree.platform_mk.clone(),
        port_mk: tree.port_mk.clone(),
        osal_mk: tree.osal_mk.clone(),
        rules_dir: tree.rules_dir.clone(),
        board_mk: format!("os/hal/boards/{}/board.mk", chibios.board),
        cfg_dir: format!("{}/{}", chibios.demo, chibios.cfg),
        ldscript: chibios.ldscript.clone(),
        defines: chibios.defines.clone(),
        mcuconf: chibios.mcuconf.clone(),
    }
}

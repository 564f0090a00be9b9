//! Which files of the user's ChibiOS tree the board is built from.

use super::context::Context;

/// Files of the tree, relative to its root, and what they must say.
#[derive(Clone, Debug)]
pub(super) struct TreePlan {
    /// `21.11`
    pub(super) version: String,
    pub(super) mcu: String,
    pub(super) startup_mk: String,
    pub(super) platform_mk: String,
    pub(super) port_mk: String,
    pub(super) osal_mk: String,
    pub(super) rules_dir: String,
    pub(super) board_mk: String,
    pub(super) cfg_dir: String,
    pub(super) ldscript: String,
    /// The macro by which `mcuconf.h` tells its MCU.
    pub(super) mcuconf: String,
}

pub(super) fn plan(context: &Context<'_>) -> TreePlan {
    let (profile, chibios) = (context.profile, context.chibios);
    let tree = &context.names.tree;
    TreePlan {
        version: profile.version().to_owned(),
        mcu: tree.mcu.clone(),
        startup_mk: tree.startup_mk.clone(),
        platform_mk: tree.platform_mk.clone(),
        port_mk: tree.port_mk.clone(),
        osal_mk: tree.osal_mk.clone(),
        rules_dir: tree.rules_dir.clone(),
        board_mk: format!("os/hal/boards/{}/board.mk", chibios.board),
        cfg_dir: format!("{}/{}", chibios.demo, chibios.cfg),
        ldscript: chibios.ldscript.clone(),
        mcuconf: chibios.mcuconf.clone(),
    }
}

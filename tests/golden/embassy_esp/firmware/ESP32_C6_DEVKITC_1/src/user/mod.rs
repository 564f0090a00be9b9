//! Your own code. This file is made once and never touched again.

use embassy_executor::Spawner;

/// Called once, after all tasks have been started: start your own here.
pub fn start(_spawner: Spawner) {}

//! The plants of the bench's world: they follow the outputs of the board, and its sensors follow them.

use sensedsl_model::design::DeviceIndex;

use super::Bench;
use crate::plants::{Process, Trouble};

impl Bench {
    /// Lets the plants go on to a moment, in whole milliseconds. A board calls it before it measures there.
    pub fn advance(&mut self, now_ns: u64) {
        if let Some(plants) = &self.plants {
            plants.advance(now_ns, self.is_off(now_ns), self.recorder.outputs(), &self.codes);
        }
    }

    /// Whether anything follows what the board does.
    #[must_use]
    pub const fn has_plants(&self) -> bool {
        self.plants.is_some()
    }

    /// Gives a plant its program. It says at once what its sensors are at the start.
    pub fn attach(&mut self, plant: &str, program: Box<dyn Process>) {
        if let Some(plants) = &self.plants {
            plants.attach(plant, program);
        }
    }

    /// What went wrong with a program of the world, said once.
    #[must_use]
    pub fn trouble(&self) -> Option<Trouble> {
        self.plants.as_ref().and_then(crate::plants::SharedPlants::trouble)
    }

    /// The actuators that drive plants and that only the board itself can say something of.
    #[must_use]
    pub fn told(&self) -> Vec<DeviceIndex> {
        self.plants.as_ref().map(crate::plants::SharedPlants::told).unwrap_or_default()
    }

    /// The board has told an actuator these codes, an element each.
    pub(crate) fn tell(&mut self, device: DeviceIndex, codes: Vec<f64>) {
        if self.plants.is_some() {
            self.codes.insert(device, codes);
        }
    }
}

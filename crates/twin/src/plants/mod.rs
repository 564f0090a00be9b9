//! Plants: what turns the board's outputs into what its sensors measure. Motors turn wheels, heaters warm, a robot
//! drives over a map; a program of the user's does anything else.
//!
//! In: what the board's wires do, in steps of a millisecond. Out: a course for each sensor, which the bench, the judge
//! and pictures share. A world describes them (`world/plants`); the engines are in `sensedsl-plants`. Values of a step
//! are known before the board measures in it, so that edges within it are found; an output takes effect in the
//! millisecond after it.

mod drives;
mod facts;
mod on_wheels;
mod process;
mod run;
mod story;

pub(crate) use drives::Drive;
pub use facts::Plant;
pub(crate) use facts::{
    BalancerPlant, BatteryPlant, Feed, Goal, HeaterPlant, LineSensors, MotorPlant, ProcessPlant,
    Ranger, RobotPlant, ServoPlant, Shows, Source, Vector, What,
};
pub use process::{Process, Value};
pub(crate) use run::SharedPlants;
pub use run::Trouble;
pub use story::{Floor, Path, Stand, Story, Told};

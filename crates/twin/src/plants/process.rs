//! A program as a plant: the values that it is told and gives. How they travel is the caller's business.

/// A value of a device as it is shown: a number, or one for each element of an array.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A device of one number.
    One(f64),
    /// An array.
    Many(Vec<f64>),
}

/// A program that is stepped with the world.
pub trait Process: Send {
    /// Goes on to a moment, in seconds. `set` has the actuators with what they were last set to, `None` before that.
    /// Gives the sensors at that moment, by their names.
    ///
    /// # Errors
    /// Why there is no answer, as a sentence without its end.
    fn step(
        &mut self,
        seconds: f64,
        set: &[(String, Option<Value>)],
    ) -> Result<Vec<(String, Value)>, String>;
}

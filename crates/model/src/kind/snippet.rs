//! A device of a kind as somebody would begin to write it.

use sensedsl_wire::Direction;

use super::KindName;

impl KindName {
    /// A device of the kind with what it cannot do without. `place` writes what somebody will want to change, from its
    /// number, which counts from 1, and what is usual there: the name is the first one.
    pub fn snippet(self, way: Direction, mut place: impl FnMut(u32, &str) -> String) -> String {
        let spec = self.spec();
        let (word, verb) = match way {
            Direction::Sensor => ("sensor", "returns"),
            Direction::Actuator => ("actuator", "accepts"),
        };
        let (name, value) = (place(1, "Name"), place(2, spec.natural.name()));
        let mut text = format!("{word} {name} {verb} {value} {{\n    type = {};\n", spec.name);
        let examples = spec.example.split_inclusive(';');
        let examples =
            examples.filter_map(|line| line.trim().trim_end_matches(';').split_once(" = "));
        for ((property, usual), number) in examples.zip(3..) {
            text.push_str(&format!("    {property} = {};\n", place(number, usual)));
        }
        text + &place(0, "") + "}"
    }
}

//! Choices in, a device or a driver out.

use super::words::{
    COMMON, COMMON_PLAIN, CONTROLLER, KINDS, Kind, PINS, PRINTED, Property, WITH_FIRMWARE,
};
use super::{Manner, Writer, wish};
use crate::draw::Draw;

/// Names that mean something somewhere; the first stands for one with the device's number.
const NAMES: &[&str] = &[
    "", "", "", "", "", "", "", "", "int", "class", "Sensor", "sensor", "frame", "on", "x__y",
    "NULL", "main", "errno", "d_0", "id",
];

impl Writer {
    /// A device, each line with the indentation in front.
    pub(super) fn device(&mut self, draw: &mut Draw<'_>, indent: &str) -> String {
        let kind = draw.pick(self.manner.some(KINDS, WITH_FIRMWARE));
        let is_odd = self.manner == Manner::Odd;
        let is_sensor = if draw.chance(48) && (is_odd || kind.is_actuator) {
            !kind.is_sensor
        } else {
            kind.is_sensor
        };
        let name = if self.manner == Manner::Plain { "" } else { draw.word(NAMES) };
        let number = self.devices;
        self.devices += 1;
        let name = if name.is_empty() { format!("D{number}") } else { name.to_owned() };
        // What a bus brings has the length of the value.
        let types = if kind.name == "i2c" { self.manner.some(kind.types, 1) } else { kind.types };
        let value = if self.wrong(draw) { "string" } else { draw.word(types) };
        let head = if is_sensor { "sensor" } else { "actuator" };
        let verb = if is_sensor { "returns" } else { "accepts" };
        let mut text = format!("{indent}{head} {name} {verb} {value} {{\n");
        self.ids += 1;
        let id = if self.wrong(draw) { draw.word(&["0", "255", "1", "-1"]) } else { "" };
        let id = if id.is_empty() { self.ids.to_string() } else { id.to_owned() };
        let mut line = |line: String| text.push_str(&format!("{indent}    {line}\n"));
        line(format!("id = {id};"));
        line(format!("type = {};", kind.name));
        self.properties(draw, kind, &mut line);
        if draw.chance(16) && !kind.roles.is_empty() {
            let role = draw.word(self.manner.some(kind.roles, 1));
            let pins = if is_odd && draw.chance(64) { PRINTED } else { PINS };
            line(format!("{role} = {};", draw.word(pins)));
        }
        if draw.chance(48) {
            line(wish(draw).trim().to_owned());
        }
        text.push_str(&format!("{indent}}}\n"));
        text
    }

    fn properties(&mut self, draw: &mut Draw<'_>, kind: &Kind, line: &mut impl FnMut(String)) {
        let has_driver = draw.chance(64) && !kind.drivers.is_empty();
        // A part answers to its own addresses only, which stand with its driver.
        for property in kind.needs {
            if !has_driver && !self.wrong(draw) {
                line(self.property(draw, property));
            }
        }
        if has_driver {
            line(draw.word(kind.drivers).to_owned());
        } else if self.manner != Manner::Plain && draw.chance(16) {
            self.own = (self.own + 1).min(2);
            line(format!("driver = Own{};", self.own - 1));
        }
        let mut rest: Vec<&Property> = kind.may.iter().collect();
        for _ in 0..draw.below(8).saturating_sub(4) {
            if !rest.is_empty() {
                let property = rest.swap_remove(draw.below(rest.len()));
                line(self.property(draw, property));
            }
        }
        let mut common: Vec<&Property> = self.manner.some(COMMON, COMMON_PLAIN).iter().collect();
        // What the kind has itself means something else there.
        common.retain(|(name, ..)| !kind.may.iter().any(|(own, ..)| own == name));
        for _ in 0..draw.below(8).saturating_sub(5) {
            if !common.is_empty() {
                let property = common.swap_remove(draw.below(common.len()));
                line(self.property(draw, property));
            }
        }
    }

    fn property(&self, draw: &mut Draw<'_>, (name, right, wrong): &Property) -> String {
        let value = if self.wrong(draw) { draw.word(wrong) } else { draw.word(right) };
        format!("{name} = {value};")
    }

    /// Code of the user on a board, whose devices are those from `first` on; sets what may be a sensor or not there.
    pub(super) fn controller(&self, draw: &mut Draw<'_>, first: usize) -> String {
        let cycle = draw.word(&["5 ms", "1 ms", "20 ms", "1 s"]);
        let cycle = if self.wrong(draw) { draw.word(&["0", "1 Hz", "61 s"]) } else { cycle };
        let mut text = format!("    controller C{} every {cycle} {{\n", draw.below(3));
        let reads: Vec<String> = (first..self.devices).take(2).map(|at| format!("D{at}")).collect();
        text.push_str(&format!("        reads = [{}];\n", reads.join(", ")));
        if self.manner != Manner::Plain && draw.chance(128) {
            text.push_str(&format!("        sets = D{};\n", draw.below(self.devices + 1)));
        }
        if draw.chance(96) {
            let property = draw.pick(CONTROLLER);
            text.push_str(&format!("        {}\n", self.property(draw, property)));
        }
        text + "    }\n"
    }

    /// A driver of the file's own.
    pub(super) fn driver(&mut self, draw: &mut Draw<'_>) -> String {
        self.own = self.own.saturating_sub(1);
        let kind = draw.pick(self.manner.some(KINDS, WITH_FIRMWARE));
        let mut text = format!("driver Own{} for {} {{\n", self.own, kind.name);
        for _ in 0..draw.below(4) {
            if !kind.may.is_empty() {
                let property = &kind.may[draw.below(kind.may.len())];
                text.push_str(&format!("    {}\n", self.property(draw, property)));
            }
        }
        text.push_str("}\n");
        text
    }

    fn wrong(&self, draw: &mut Draw<'_>) -> bool {
        self.manner == Manner::Odd && draw.chance(16)
    }
}

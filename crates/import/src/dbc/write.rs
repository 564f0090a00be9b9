//! From the messages of a bus to devices, as text.

use std::collections::BTreeSet;

use sensedsl_model::kind::can::BitField;
use sensedsl_model::kind::i2c::ByteOrder;

use super::read::{Message, Mux, Network, Number, Signal};
use crate::devices::{IDS_MAX, WORDS};
use crate::log::Log;
use crate::project::{identifier, one_line};

struct Writer<'a> {
    text: String,
    bitrate_hz: Option<u32>,
    node: Option<&'a str>,
    /// Names in use, without case and underscores.
    names: BTreeSet<String>,
    count: usize,
    /// The first signal beyond the limit on devices, and the number of such signals.
    beyond: Option<(&'a Signal, usize)>,
}

/// The devices of a node; none if it neither sends nor receives anything.
pub(super) fn program<'a>(
    network: &'a Network,
    name: &str,
    node: Option<&'a str>,
    log: &mut Log,
) -> Option<String> {
    let whose = match node {
        Some(node) => format!("what {} sends (actuators) and receives (sensors)", one_line(node)),
        None => "all that is on the bus, as sensors: `--node` takes a node's place".to_owned(),
    };
    let text = format!(
        "// Texts of {} by `sensedsl import`: {whose}.\n// `use` it in a file with a board that has CAN.\n",
        one_line(name)
    );
    let (bitrate_hz, names) = (network.bitrate_hz, BTreeSet::new());
    let mut writer = Writer { text, bitrate_hz, node, names, count: 0, beyond: None };
    for message in &network.messages {
        writer.message(message, log);
    }
    if let Some((first, count)) = writer.beyond {
        let more = if count > 1 {
            format!(" and {} more signals are", count - 1)
        } else {
            " is".to_owned()
        };
        let way = if node.is_none() { "; `--node` takes those of one node" } else { "" };
        let what =
            format!("{}{more} left out: a file has at most {IDS_MAX} devices{way}", first.name);
        log.dropped(first.span, "", &what);
    }
    if writer.count == 0
        && let Some(first) = network.messages.first()
    {
        log.unreadable(first.span, name, "none of its signals can be a device of this node");
        return None;
    }
    Some(writer.text)
}

impl<'a> Writer<'a> {
    fn message(&mut self, message: &'a Message, log: &mut Log) {
        let is_sent = self.node == Some(message.sender.as_str());
        let is_wanted = |signal: &&'a Signal| {
            is_sent || self.node.is_none_or(|node| signal.receivers.iter().any(|one| one == node))
        };
        let mut wanted: Vec<&'a Signal> = message.signals.iter().filter(is_wanted).collect();
        let selector = message.signals.iter().find(|signal| signal.mux == Mux::Selector);
        if let Some(selector) = selector
            && wanted.iter().any(|signal| matches!(signal.mux, Mux::Only(_)))
            && !wanted.iter().any(|signal| signal.name == selector.name)
        {
            wanted.insert(0, selector);
        }
        if wanted.is_empty() {
            return;
        }
        if message.bytes > 8 || message.bytes == 0 {
            let what = format!(
                "{} is left out: it has {} bytes, and a frame has 1 to 8",
                message.name, message.bytes
            );
            log.dropped(message.span, "", &what);
            return;
        }
        self.text.push_str(&format!("\n// {}\n", one_line(&message.name)));
        let mut selected_by = None;
        // The selector comes first, because the others name it.
        wanted.sort_by_key(|signal| signal.mux != Mux::Selector);
        for signal in wanted {
            let name = self.signal(message, signal, is_sent, selected_by.as_deref(), log);
            if signal.mux == Mux::Selector {
                selected_by = name;
            }
        }
    }

    /// Writes a signal; returns the name of its device.
    fn signal(
        &mut self,
        message: &Message,
        signal: &'a Signal,
        is_sent: bool,
        selected_by: Option<&str>,
        log: &mut Log,
    ) -> Option<String> {
        if self.count == IDS_MAX {
            let (first, before) = self.beyond.unwrap_or((signal, 0));
            self.beyond = Some((first, before + 1));
            return None;
        }
        let lines = match lines(message, signal, selected_by) {
            Ok(lines) => lines,
            Err(why) => {
                log.dropped(signal.span, "", &format!("{} is left out: {why}", signal.name));
                return None;
            }
        };
        let name = self.name(message, signal);
        let (direction, verb) =
            if is_sent { ("actuator", "accepts") } else { ("sensor", "returns") };
        self.text.push_str(&format!(
            "{direction} {name} {verb} {} {{\n    type = can;\n",
            value(signal)
        ));
        if let Some(hz) = self.bitrate_hz {
            self.text.push_str(&format!("    bitrate = {hz} Hz;\n"));
        }
        for line in lines {
            self.text.push_str(&format!("    {line}\n"));
        }
        if is_sent {
            self.text.push_str(&format!("    length = {};\n", message.bytes));
        }
        let pace = if is_sent { "resend" } else { "delay" };
        if let Some(ms) = message.cycle_ms {
            self.text.push_str(&format!("    {pace} = {ms} ms;\n"));
        }
        for (number, word) in &signal.words {
            self.text.push_str(&format!("    // {number}: {}\n", one_line(word)));
        }
        self.text.push_str("}\n");
        self.count += 1;
        Some(name)
    }

    /// A name that no other device has.
    fn name(&mut self, message: &Message, signal: &Signal) -> String {
        let wanted = identifier(&signal.name).unwrap_or_else(|| "Signal".to_owned());
        let of = identifier(&message.name).unwrap_or_else(|| "Message".to_owned());
        let next = self.count + 1;
        let more = format!("{of}_{wanted}");
        for option in [wanted.clone(), more, format!("{wanted}_n{next}")] {
            let folded: String = option.chars().filter(|c| *c != '_').collect();
            let is_word = WORDS.contains(&option.as_str());
            if !is_word && self.names.insert(folded.to_ascii_lowercase()) {
                return option;
            }
        }
        format!("Device{next}")
    }
}

/// The properties of a signal's device, or why it cannot be one.
fn lines(
    message: &Message,
    signal: &Signal,
    selected_by: Option<&str>,
) -> Result<Vec<String>, String> {
    let order = if signal.is_little { ByteOrder::Little } else { ByteOrder::Big };
    let place = u8::try_from(signal.bit).ok().zip(u8::try_from(signal.bits).ok());
    let place = place.filter(|(bit, bits)| *bit < 64 && *bits <= 64);
    let end = place.and_then(|(bit, bits)| BitField::at(bit, bits, order));
    let end = end.map(|(byte, field)| u32::from(byte) + u32::from(field.word_bytes));
    if end.is_none_or(|end| end > message.bytes) {
        return Err(format!("its bits are not in the {} bytes of its message", message.bytes));
    }
    let real = match signal.kind {
        Number::Float => Some(32),
        Number::Double => Some(64),
        Number::Unsigned | Number::Signed => None,
    };
    if real.is_some_and(|bits| {
        bits != signal.bits || signal.bit % 8 != if signal.is_little { 0 } else { 7 }
    }) {
        return Err(
            "a number with an exponent has 32 or 64 bits from the edge of a byte on".to_owned()
        );
    }
    let mut lines = vec![format!("frame = 0x{:X};", message.id)];
    if message.is_extended && message.id <= 0x7FF {
        lines.push("extended = true;".to_owned());
    }
    let order = if signal.is_little { "little" } else { "big" };
    lines.push(format!("order = {order};"));
    lines.push(format!("bit = {};", signal.bit));
    lines.push(format!("bits = {};", signal.bits));
    match (signal.mux, selected_by) {
        (Mux::Only(number), Some(selector)) => lines.push(format!("mux = {selector} = {number};")),
        (Mux::Only(_), None) => return Err("nothing in its message selects it (`M`)".to_owned()),
        (Mux::Nested, _) => {
            return Err("a value that selects and is selected is not served".to_owned());
        }
        (Mux::Open, _) => return Err("its `m` has no number".to_owned()),
        (Mux::Always | Mux::Selector, _) => {}
    }
    lines.extend(shown(signal));
    Ok(lines)
}

/// How a host shows the value.
#[expect(clippy::float_cmp, reason = "1 and 0 are what a file says where it means nothing")]
fn shown(signal: &Signal) -> Vec<String> {
    let mut lines = Vec::new();
    let is_scaled = signal.factor != 1.0 || signal.offset != 0.0;
    if signal.factor != 1.0 {
        lines.push(format!("scale = {};", number(signal.factor)));
    }
    if signal.offset != 0.0 {
        lines.push(format!("offset = {};", number(signal.offset)));
    }
    let unit = one_line(&signal.unit).replace(['"', '\\'], "");
    if !unit.is_empty() {
        lines.push(format!("quantity = \"{unit}\";"));
    }
    // A bound that the bits cannot reach anyway is left out.
    let (least, most) = reach(signal);
    let is_bool = value(signal) == "bool" && !is_scaled;
    if signal.least < signal.most && !is_bool {
        let slack = (most - least) * 1e-9;
        if signal.least > least + slack && signal.least < most {
            lines.push(format!("min = {};", number(signal.least)));
        }
        if signal.most < most - slack && signal.most > least {
            lines.push(format!("max = {};", number(signal.most)));
        }
    }
    lines
}

/// The range of values that the bits of a signal can show.
fn reach(signal: &Signal) -> (f64, f64) {
    let full = |bits: u32| 2_f64.powi(i32::try_from(bits).unwrap_or(64));
    let (from, to) = match signal.kind {
        Number::Unsigned => (0.0, full(signal.bits) - 1.0),
        Number::Signed => (-full(signal.bits) / 2.0, full(signal.bits) / 2.0 - 1.0),
        Number::Float => (f64::from(f32::MIN), f64::from(f32::MAX)),
        Number::Double => (f64::MIN / 2.0, f64::MAX / 2.0),
    };
    let ends = [from, to].map(|raw| raw * signal.factor + signal.offset);
    (ends[0].min(ends[1]), ends[0].max(ends[1]))
}

/// The type of its device, which is the smallest that holds its bits.
fn value(signal: &Signal) -> &'static str {
    match (signal.kind, signal.bits) {
        (Number::Float, _) => "float32",
        (Number::Double, _) => "float64",
        (Number::Unsigned, 1) => "bool",
        (Number::Unsigned, ..=8) => "uint8",
        (Number::Unsigned, ..=16) => "uint16",
        (Number::Unsigned, ..=32) => "uint32",
        (Number::Unsigned, _) => "uint64",
        (Number::Signed, ..=8) => "int8",
        (Number::Signed, ..=16) => "int16",
        (Number::Signed, ..=32) => "int32",
        (Number::Signed, _) => "int64",
    }
}

/// A number in the syntax of the language.
fn number(number: f64) -> String {
    format!("{number}")
}

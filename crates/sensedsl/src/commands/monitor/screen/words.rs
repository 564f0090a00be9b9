//! Numbers and times in few characters, and texts in few columns.

use std::time::Duration;

use ratatui_core::buffer::Buffer;
use ratatui_core::layout::Rect;
use ratatui_core::style::Style;
use ratatui_core::text::Span;
use sensedsl_host::Device;
use sensedsl_wire::{Scalar, ScalarType};

/// The most digits behind the point.
const DECIMALS_MAX: usize = 9;

/// The columns that a text takes.
pub(super) fn width(text: &str) -> usize {
    Span::raw(text).width()
}

/// A text within so many columns; `…` stands for what is cut off.
pub(super) fn cut(text: &str, columns: usize) -> String {
    if width(text) <= columns {
        return text.to_owned();
    }
    let mut kept = String::new();
    let mut used = 0;
    for letter in text.chars() {
        used += width(letter.encode_utf8(&mut [0; 4]));
        if used + 1 > columns {
            break;
        }
        kept.push(letter);
    }
    if columns > 0 {
        kept.push('…');
    }
    kept
}

/// A text in lines of so many columns, between words where that can be.
pub(super) fn wrapped(text: &str, columns: usize) -> Vec<String> {
    let columns = columns.max(1);
    let mut lines = vec![String::new()];
    for word in text.split(' ') {
        let Some(line) = lines.last_mut() else { break };
        let space = usize::from(!line.is_empty());
        if width(line) + space + width(word) <= columns {
            if space > 0 {
                line.push(' ');
            }
            line.push_str(word);
            continue;
        }
        let mut rest = String::new();
        for letter in word.chars() {
            if width(&rest) >= columns {
                lines.push(std::mem::take(&mut rest));
            }
            rest.push(letter);
        }
        lines.push(rest);
    }
    lines.retain(|line| !line.is_empty());
    lines
}

/// Writes a text into a row of an area, and gives the column after it.
pub(super) fn put(
    buffer: &mut Buffer,
    area: Rect,
    at: (u16, u16),
    text: &str,
    style: Style,
) -> u16 {
    let (x, y) = at;
    let area = area.intersection(buffer.area);
    if !area.contains((x, y).into()) {
        return x;
    }
    let room = usize::from(area.right() - x);
    buffer.set_stringn(x, y, text, room, style).0
}

/// A number with so many digits behind the point, without a sign before zero.
fn fixed(number: f64, decimals: usize) -> String {
    let text = format!("{number:.decimals$}");
    let is_zero = text.trim_start_matches('-').chars().all(|letter| matches!(letter, '0' | '.'));
    if is_zero { text.trim_start_matches('-').to_owned() } else { text }
}

/// The digits behind the point that a step needs.
fn decimals(step: f64) -> usize {
    let mut scaled = step.abs();
    let found = (0..DECIMALS_MAX).find(|_| {
        let is_enough = scaled >= 0.999;
        scaled *= 10.0;
        is_enough
    });
    found.unwrap_or(DECIMALS_MAX)
}

/// A shown number of a device, with as many digits as a code more or less would change.
pub(super) fn number(device: &Device, shown: f64) -> String {
    if device.value.scalar == ScalarType::Bool {
        return if shown == 0.0 { "false".to_owned() } else { "true".to_owned() };
    }
    let is_real = matches!(device.value.scalar, ScalarType::Float32 | ScalarType::Float64);
    let step = device.scale.shown_step(device.scale.raw(shown));
    if is_real || !step.is_finite() || step <= 0.0 {
        return significant(shown);
    }
    fixed(shown, decimals(step))
}

/// A value within so many columns: an array with fewer digits, or without its last elements, before its unit is cut.
pub(super) fn short_value(device: &Device, value: &[Scalar], columns: usize) -> String {
    let whole = device.brief(value);
    if width(&whole) <= columns || device.value.length.is_none() {
        return whole;
    }
    let unit = device.quantity.as_ref().map_or(String::new(), |unit| format!(" {unit}"));
    let shown: Vec<f64> = value.iter().map(|raw| device.shown(*raw)).collect();
    let most = shown.iter().map(|shown| number(device, *shown)).map(|text| digits(&text)).max();
    let is_bool = device.value.scalar == ScalarType::Bool;
    let written = |decimals: usize| -> Vec<String> {
        let one =
            |shown: &f64| if is_bool { number(device, *shown) } else { fixed(*shown, decimals) };
        shown.iter().map(one).collect()
    };
    let mut fitting = (0..most.unwrap_or(0))
        .rev()
        .map(|decimals| format!("[{}]{unit}", written(decimals).join(", ")));
    fitting.find(|text| width(text) <= columns).unwrap_or_else(|| {
        let mut words = written(0);
        while words.len() > 1 && width(&words.join(", ")) + width(&unit) + 5 > columns {
            let _ = words.pop();
        }
        format!("[{}, …]{unit}", words.join(", "))
    })
}

/// The digits behind the point of a text.
fn digits(text: &str) -> usize {
    text.split_once('.').map_or(0, |(_, digits)| digits.len())
}

/// A number with five digits that mean something.
fn significant(number: f64) -> String {
    let text = format!("{number:.4e}");
    text.parse::<f64>().map_or(text, |rounded| rounded.to_string())
}

/// A place on an axis whose labels are that far apart.
pub(super) fn label(number: f64, step: f64) -> String {
    if number.abs() >= 1e7 {
        return format!("{number:.2e}");
    }
    fixed(number, decimals(step))
}

/// How long something took.
pub(super) fn short(time: Duration) -> String {
    let us = time.as_micros();
    let seconds = time.as_secs_f64();
    match us {
        0..1_000 => format!("{us} us"),
        1_000..10_000 => format!("{:.1} ms", seconds * 1e3),
        10_000..1_000_000 => format!("{:.0} ms", seconds * 1e3),
        1_000_000..100_000_000 => format!("{seconds:.1} s"),
        100_000_000..6_000_000_000 => format!("{:.0} min", seconds / 60.0),
        _ => format!("{:.0} h", seconds / 3600.0),
    }
}

/// How long ago something was: that changes with every look, so it has no more digits than people read.
pub(super) fn age(time: Duration) -> String {
    if time < Duration::from_secs(1) { format!("{} ms", time.as_millis()) } else { short(time) }
}

/// A rate.
pub(super) fn rate(hz: f64) -> String {
    let decimals = match hz {
        _ if hz >= 100.0 => 0,
        _ if hz >= 10.0 => 1,
        _ => 2,
    };
    format!("{hz:.decimals$} Hz")
}

/// A moment of the run.
pub(super) fn moment(time: Duration) -> String {
    let seconds = time.as_secs();
    match seconds {
        0..60 => format!("{:.1} s", time.as_secs_f64()),
        60..3600 => format!("{}:{:02}", seconds / 60, seconds % 60),
        _ => format!("{}:{:02}:{:02}", seconds / 3600, seconds / 60 % 60, seconds % 60),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sensedsl_host::Scale;
    use sensedsl_wire::{Direction, ValueType};

    #[test]
    fn texts_fit_their_columns() {
        assert_eq!(
            (cut("Servo", 5), cut("Servo", 4), cut("Servo", 1)),
            ("Servo".into(), "Ser…".into(), "…".into())
        );
        assert_eq!(cut("Servo", 0), "");
        assert_eq!(cut("温度計", 5), "温度…");
        assert_eq!(wrapped("the device is gone", 8), ["the", "device", "is gone"]);
        assert_eq!(wrapped("abcdefgh ij", 3), ["abc", "def", "gh", "ij"]);
        assert_eq!(wrapped("", 3), Vec::<String>::new());
    }

    #[test]
    fn numbers_are_short() {
        let ms = Duration::from_millis;
        let all = [0, 9, 120, 1_500, 130_000, 7_200_000].map(|time| short(ms(time)));
        assert_eq!(all, ["0 us", "9.0 ms", "120 ms", "1.5 s", "2 min", "2 h"]);
        assert_eq!((age(ms(4)), age(ms(2_000))), ("4 ms".into(), "2.0 s".into()));
        assert_eq!([1_000.4, 50.0, 0.2].map(rate), ["1000 Hz", "50.0 Hz", "0.20 Hz"]);
        assert_eq!(
            [900, 61_000, 3_661_000].map(|time| moment(ms(time))),
            ["0.9 s", "1:01", "1:01:01"]
        );
        assert_eq!(
            (label(-0.001, 0.5), label(12.5, 0.5), label(4e9, 1e9)),
            ("0.0".into(), "12.5".into(), "4.00e9".into())
        );
    }
    #[test]
    fn arrays_lose_digits_before_their_unit() {
        let device = Device {
            name: "Rate".into(),
            id: 1,
            direction: Direction::Sensor,
            value: ValueType { scalar: ScalarType::Int16, length: Some(3) },
            kind: String::new(),
            quantity: Some("deg/s".into()),
            scale: Scale::new(Some(0.001), None, Vec::new()),
            min: None,
            max: None,
            cycle_ms: None,
            obeys: None,
        };
        let value = [-17_649, 58_267 - 65_536, 9_328].map(Scalar::Signed);
        let all = [40, 30, 26, 22, 18, 10].map(|columns| short_value(&device, &value, columns));
        let expected = [
            "[-17.649, -7.269, 9.328] deg/s",
            "[-17.649, -7.269, 9.328] deg/s",
            "[-17.6, -7.3, 9.3] deg/s",
            "[-18, -7, 9] deg/s",
            "[-18, -7, 9] deg/s",
            "[-18, …] deg/s",
        ];
        assert_eq!(all, expected);
    }
}

//! A complete configuration with comments: boards and the sinks that somebody wants in, TOML out.
//!
//! All else is commented out, so that the file is taken as it is and does nothing that nobody asked for.

use std::fmt::Write as _;

use sensedsl_host::Board;

use super::example::examples;
use super::{BOARD_KEYS, Config, DEVICE_KEYS, Key, SINKS, Setting, Sort};

const HEAD: &str = "\
# Who gets the values of these boards: sensedsl monitor --config FILE
# Remove `#` before the table of a program, and before the keys that you change.
";

/// A file for the given boards, with the sinks of a configuration.
#[must_use]
pub fn sample(boards: &[Board], wanted: &Config) -> String {
    let mut text = HEAD.to_owned();
    for spec in SINKS {
        let needs = if spec.is_built {
            String::new()
        } else {
            format!(" (not in this program: it needs the feature `{}`)", spec.name)
        };
        let own = wanted.sinks.iter().find(|settings| settings.spec.name == spec.name);
        let mark = if own.is_some() { "" } else { "# " };
        line(
            &mut text,
            &format!("\n# {}: {}{needs}\n{mark}[{}]", spec.title, spec.about, spec.name),
        );
        for key in spec.keys {
            let usual_value = usual(key.sort);
            let value =
                own.and_then(|own| written(own.get(key.name)?)).filter(|it| *it != usual_value);
            let mark = if value.is_some() { "" } else { "# " };
            let value = value.unwrap_or(usual_value);
            line(&mut text, &format!("{mark}{} = {value}  # {}", key.name, key.about));
        }
    }
    for board in boards {
        line(
            &mut text,
            &format!("\n# All devices of the board {}\n# [boards.{}]", board.name, board.name),
        );
        keys(&mut text, BOARD_KEYS, |key| match key {
            "topic" | "frame" => Some(format!("\"{}\"", board.name)),
            _ => None,
        });
        for (place, device) in board.devices.iter().enumerate() {
            let name = format!("{}/{}", board.name, device.name);
            let unit = device.quantity.clone().unwrap_or_default();
            let of = if unit.is_empty() { String::new() } else { format!(" in {unit}") };
            let sort = device.direction.name();
            line(
                &mut text,
                &format!("\n# {sort} {} {}{of}\n# [devices.\"{name}\"]", device.name, device.value),
            );
            // Once is enough: more would hide what the file is for.
            let some = if place == 0 { DEVICE_KEYS } else { &[] };
            keys(&mut text, some, |key| match key {
                "topic" => Some(format!("\"{name}\"")),
                "frame" => Some(format!("\"{}\"", board.name)),
                "unit" => Some(quoted(&unit)),
                "scale" => Some("1".to_owned()),
                _ => None,
            });
        }
    }
    text.push_str(&examples(boards));
    text
}

fn keys(text: &mut String, keys: &[Key], given: impl Fn(&str) -> Option<String>) {
    for key in keys {
        let value = given(key.name).unwrap_or_else(|| usual(key.sort));
        line(text, &format!("# {} = {value}  # {}", key.name, key.about));
    }
}

fn line(text: &mut String, line: &str) {
    // A text takes all that is written to it.
    let _ = writeln!(text, "{line}");
}

/// A value as the file has it; none for what is not set.
fn written(value: &Setting) -> Option<String> {
    match value {
        Setting::Text(text) => Some(quoted(text)),
        Setting::Texts(all) => {
            let all: Vec<String> = all.iter().map(|one| quoted(one)).collect();
            Some(format!("[{}]", all.join(", ")))
        }
        Setting::Flag(flag) => Some(flag.to_string()),
        Setting::Number(number) => Some(number.to_string()),
        Setting::Unset => None,
    }
}

fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\""))
}

fn usual(sort: Sort) -> String {
    match sort {
        Sort::Text(text) | Sort::Remote(text) | Sort::Listen(text) => quoted(text),
        Sort::Word(words) => quoted(words.first().unwrap_or(&"")),
        Sort::Texts => "[]".to_owned(),
        Sort::Flag(flag) => flag.to_string(),
        Sort::Whole(usual, ..) => usual.to_string(),
        Sort::Positive(rate) => rate.unwrap_or(100.0).to_string(),
    }
}

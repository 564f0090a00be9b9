//! Code that several tests share: designs written in one line, and the file beside them.

use sensedsl_model::design::Design;
use sensedsl_model::{FileRequest, Files, ReadError, Request, Resolved, resolve};

/// The content of every other file; `None` if there are no other files.
struct OneFile(Option<&'static str>);

impl Files for OneFile {
    fn read(&self, _: &FileRequest<'_>) -> Result<String, ReadError> {
        self.0.map(str::to_owned).ok_or(ReadError::Missing)
    }
}

/// The meaning of a text if every file that it names reads as `beside`.
pub(crate) fn resolved(text: &str, target: Option<&str>, beside: Option<&'static str>) -> Resolved {
    let request = Request { path: "x.sense", text, board: None, target };
    resolve(&request, &OneFile(beside))
}

/// The design of a text that needs no other file; a text with a mistake fails the test.
pub(crate) fn of_text(text: &str, target: Option<&str>) -> Design {
    let resolved = resolved(text, target, None);
    resolved.design.unwrap_or_else(|| panic!("{text}{:#?}", resolved.diagnostics))
}

/// Devices on a part: `KIND PROPERTIES`, with `;` between the devices and `,` between properties.
/// Properties that a kind requires are added. `opening` comes before the devices.
pub(crate) fn of_devices(part: &str, target: &str, opening: &str, devices: &str) -> Design {
    let mut text = format!("board X on {part} {{\n{opening}");
    for (id, device) in (1..).zip(devices.split(';').map(str::trim)) {
        let (kind, rest) = device.split_once(' ').unwrap_or((device, ""));
        let own = match kind {
            "i2c" => format!("address = {}; register = 0;", 0x10 + id),
            "uart" => "start = 0x0A; length = 4;".to_owned(),
            "spi" => "read = [0x80]; length = 2;".to_owned(),
            "can" => format!("bitrate = 500 kHz; frame = {id};"),
            "pwm" => "frequency = 50 Hz;".to_owned(),
            _ => String::new(),
        };
        let head = match kind {
            "pwm" | "dac" => format!("actuator D{id} accepts uint16"),
            "digital" => format!("sensor D{id} returns bool"),
            "icu" | "encoder" => format!("sensor D{id} returns int32"),
            _ => format!("sensor D{id} returns uint16"),
        };
        let rest: String = rest
            .split(',')
            .map(str::trim)
            .filter(|one| !one.is_empty())
            .map(|one| format!("{one};"))
            .collect();
        text.push_str(&format!("{head} {{ id = {id}; type = {kind}; {own} {rest} }}\n"));
    }
    text.push_str("}\n");
    of_text(&text, Some(target))
}

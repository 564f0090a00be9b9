//! What Home Assistant is told of a device, so that it shows it without being configured: a device in, retained
//! messages out, as its MQTT integration defines them.

use serde_json::{Map, Value, json};

use super::{Mqtt, OFFLINE, ONLINE, elements};
use crate::plan::Place;

/// Elements of an array that are told one by one; Home Assistant shows no longer ones.
const ELEMENTS_MAX: usize = 16;

/// The bound of numbers of floating point that have none.
const REAL_MAX: f64 = 1e6;

/// The topics and texts that announce a device.
pub(super) fn messages(mqtt: &Mqtt, place: &Place<'_>) -> Vec<(String, String)> {
    if mqtt.discovery.is_empty() {
        return Vec::new();
    }
    let count = place.device.value.count();
    match place.device.value.length {
        None => vec![message(mqtt, place, None)],
        Some(_) if count > ELEMENTS_MAX => Vec::new(),
        // An array of numbers is set as a whole, for which Home Assistant has nothing.
        Some(_) if place.is_actuator() && !elements::are_set(place) => Vec::new(),
        Some(_) => (0..count).map(|element| message(mqtt, place, Some(element))).collect(),
    }
}

fn message(mqtt: &Mqtt, place: &Place<'_>, element: Option<usize>) -> (String, String) {
    let suffix = element.map_or(String::new(), |element| format!("_{element}"));
    let id = format!("{}_{}{suffix}", mqtt.topics.prefix, place.route.topic).replace('/', "_");
    let is_set = place.is_actuator() && mqtt.takes_commands;
    let component = match (is_set, place.is_bool()) {
        (true, true) => "switch",
        (true, false) => "number",
        (false, true) => "binary_sensor",
        (false, false) => "sensor",
    };
    let mut about = Map::new();
    let name = element
        .map_or(place.device.name.clone(), |element| format!("{} {element}", place.device.name));
    about.insert("name".into(), name.into());
    about.insert("unique_id".into(), id.clone().into());
    about.insert("state_topic".into(), mqtt.topics.state(place).into());
    let of = if mqtt.is_json { "value_json.value" } else { "value_json" };
    if mqtt.is_json || element.is_some() {
        let index = element.map_or(String::new(), |element| format!("[{element}]"));
        let lower = if place.is_bool() { " | lower" } else { "" };
        about.insert("value_template".into(), format!("{{{{ {of}{index}{lower} }}}}").into());
    }
    let availability = [mqtt.topics.host_status(), mqtt.topics.board_status(&place.on.topic)];
    let availability = availability.map(|topic| {
        json!({ "topic": topic, "payload_available": ONLINE, "payload_not_available": OFFLINE })
    });
    about.insert("availability".into(), availability.to_vec().into());
    about.insert("availability_mode".into(), "all".into());
    about.insert(
        "device".into(),
        json!({
            "identifiers": [format!("{}_{}", mqtt.topics.prefix, place.on.topic).replace('/', "_")],
            "name": place.on.board.name,
            "manufacturer": "SenseDSL",
        }),
    );
    shape(&mut about, place, is_set);
    if is_set {
        let topics = &mqtt.topics;
        let topic = element.map_or(topics.set(place), |element| topics.set_element(place, element));
        about.insert("command_topic".into(), topic.into());
    }
    (format!("{}/{component}/{id}/config", mqtt.discovery), Value::Object(about).to_string())
}

/// Unit, class and bounds.
fn shape(about: &mut Map<String, Value>, place: &Place<'_>, is_set: bool) {
    if place.is_bool() {
        about.insert("payload_on".into(), "true".into());
        about.insert("payload_off".into(), "false".into());
        return;
    }
    let (unit, class) = place.route.unit.as_deref().map_or((None, None), unit);
    if let Some(unit) = unit {
        about.insert("unit_of_measurement".into(), unit.into());
    }
    if let Some(class) = class {
        about.insert("device_class".into(), class.into());
    }
    if is_set {
        // Without bounds Home Assistant takes 1 and 100.
        let (least, most) = bounds(place);
        about.insert("min".into(), place.scaled(place.device.min.unwrap_or(least)).into());
        about.insert("max".into(), place.scaled(place.device.max.unwrap_or(most)).into());
        let step = (place.device.scale.shown_step(0.0) * place.route.factor).abs();
        if step.is_finite() && step >= 0.001 {
            about.insert("step".into(), step.into());
        }
        about.insert("mode".into(), "box".into());
    } else {
        about.insert("state_class".into(), "measurement".into());
    }
}

/// The least and the greatest shown number of a device's type.
fn bounds(place: &Place<'_>) -> (f64, f64) {
    let Some((least, most)) = place.device.value.scalar.integer_range() else {
        return (-REAL_MAX, REAL_MAX);
    };
    #[expect(clippy::cast_precision_loss, reason = "a bound for people")]
    let ends = [least, most].map(|end| place.device.scale.shown(end as f64));
    (
        ends.into_iter().fold(f64::INFINITY, f64::min),
        ends.into_iter().fold(f64::NEG_INFINITY, f64::max),
    )
}

/// The unit as Home Assistant spells it, and the class that has it.
fn unit(unit: &str) -> (Option<&str>, Option<&'static str>) {
    let class = match unit {
        "degC" | "°C" | "C" => return (Some("°C"), Some("temperature")),
        "degF" => return (Some("°F"), Some("temperature")),
        "K" => return (Some("K"), Some("temperature")),
        "deg" => return (Some("°"), None),
        "ohm" => return (Some("Ω"), None),
        "uV" => return (Some("µV"), Some("voltage")),
        "%RH" | "%rh" => return (Some("%"), Some("humidity")),
        "m" | "cm" | "mm" | "km" => "distance",
        "V" | "mV" => "voltage",
        "A" | "mA" => "current",
        "W" | "kW" | "mW" => "power",
        "Wh" | "kWh" => "energy_storage",
        "Pa" | "hPa" | "kPa" | "bar" | "mbar" => "pressure",
        "lx" => "illuminance",
        "Hz" | "kHz" | "MHz" => "frequency",
        "s" | "ms" | "min" | "h" => "duration",
        "m/s" | "km/h" => "speed",
        "g" | "kg" | "mg" => "weight",
        "dB" => "signal_strength",
        "ppm" => return (Some("ppm"), None),
        other => return (Some(other), None),
    };
    (Some(unit), Some(class))
}

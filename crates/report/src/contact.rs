//! What is printed beside the contacts of modules: a wire of a driver in, the contact out.

use sensedsl_model::facts::{ConnectionFacts, PartFacts};
use sensedsl_model::kind::{Kind, Role};

/// The tool's name for a wire: `scl`, `pwm_a`, `encoder.a`.
pub(crate) fn wire(connection: &ConnectionFacts, role: Role) -> String {
    match &connection.name {
        None => role.name().to_owned(),
        Some(name) if connection.roles.len() == 1 => name.clone(),
        Some(name) => format!("{name}.{role}"),
    }
}

/// The contact of the usual module that a wire goes to, by the wire's name in a design: `TRIG` for
/// `trigger`.
pub(crate) fn of_wire<'a>(part: &'a PartFacts, name: &str) -> Option<&'a str> {
    part.connections.iter().find_map(|connection| {
        let role = connection.roles.iter().find(|role| wire(connection, **role) == name)?;
        contact(part, connection, *role)
    })
}

/// The contact of the usual module that the wire goes to: the one that the driver states, or that its name tells.
pub(crate) fn contact<'a>(
    part: &'a PartFacts,
    connection: &ConnectionFacts,
    role: Role,
) -> Option<&'a str> {
    if let Some(stated) = stated(part, &wire(connection, role)) {
        return Some(stated);
    }
    let own = connection.name.as_deref().filter(|_| connection.roles.len() == 1);
    let own = own.map(spelled).unwrap_or_default();
    let known = names_of(&connection.kind, role).iter().filter(|_| own.is_empty());
    let names = own.iter().map(String::as_str).chain(known.copied());
    names.into_iter().find_map(|wanted| {
        let mut found = called(part, wanted);
        let first = found.next()?;
        found.next().is_none().then_some(first)
    })
}

/// The contact for the part's supply.
pub(crate) fn supply(part: &PartFacts) -> Option<&str> {
    const NAMES: [&str; 10] =
        ["VCC", "VIN", "VDD", "5V", "3V3", "3.3V", "+5V", "+5", "3.3v-5v", "6 V+"];
    let known = || NAMES.iter().find_map(|name| whole(part, name));
    stated(part, "supply").or_else(known)
}

/// The contact for the part's ground.
pub(crate) fn ground(part: &PartFacts) -> Option<&str> {
    let known = || called(part, "GND").next().or_else(|| called(part, "0V").next());
    stated(part, "ground").or_else(known)
}

/// The contact that the driver states.
fn stated<'a>(part: &'a PartFacts, wire: &str) -> Option<&'a str> {
    let found = part.contacts.iter().find(|(name, _)| name == wire)?;
    Some(&found.1)
}

/// The contacts that have a word in their names.
fn called<'a>(part: &'a PartFacts, wanted: &str) -> impl Iterator<Item = &'a str> {
    let is_called = move |entry: &&str| {
        let mut words = entry.split(|letter: char| !letter.is_ascii_alphanumeric());
        words.any(|word| word.eq_ignore_ascii_case(wanted))
    };
    part.connector.iter().map(String::as_str).filter(is_called)
}

/// The contact of that very name.
fn whole<'a>(part: &'a PartFacts, name: &str) -> Option<&'a str> {
    part.connector.iter().map(String::as_str).find(|entry| entry.eq_ignore_ascii_case(name))
}

/// How modules print the name of a connection: `in1_a` as `IN1A` or `AIN1`, `standby` as `STBY`.
fn spelled(name: &str) -> Vec<String> {
    let name = name.to_uppercase().replace("STANDBY", "STBY").replace("ENABLE", "EN");
    let moved = match name.rsplit_once('_') {
        Some((rest, side)) if side.len() == 1 => Some(format!("{side}{rest}").replace('_', "")),
        Some(_) | None => None,
    };
    std::iter::once(name.replace('_', "")).chain(moved).collect()
}

/// The names that modules print beside the contact of a wire, the surest first.
fn names_of(kind: &Kind, role: Role) -> &'static [&'static str] {
    match role {
        Role::Scl => &["SCL"],
        Role::Sda => &["SDA"],
        // What one end sends, the other receives.
        Role::Tx => &["RX", "RXD"],
        Role::Rx => &["TX", "TXD", "SIGNAL"],
        Role::Sck => &["SCK", "CLK"],
        Role::Miso => &["MISO", "DOUT", "DO"],
        Role::Mosi => &["MOSI", "DIN"],
        Role::Cs => &["CS", "CSN", "NCS"],
        Role::A => &["A"],
        Role::B => &["B"],
        Role::Trigger => &["TRIG"],
        Role::In if kind.is_sampled() => {
            &["AOUT", "VO", "AN", "OUT", "WIPER", "SIGNAL", "S", "PIN"]
        }
        Role::In => &["ECHO", "PW", "DO", "OUT", "SIGNAL", "S", "PIN"],
        Role::Out => &["IN", "IN1", "SIGNAL", "S", "PIN"],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn connections_are_spelled_as_on_modules() {
        assert_eq!(spelled("in1_a"), ["IN1A", "AIN1"]);
        assert_eq!(spelled("standby"), ["STBY"]);
        assert_eq!(spelled("enable_forward"), ["ENFORWARD"]);
    }

    /// Wires of the MCU's port that these parts have no use for.
    const NOT_AT_THE_PART: [&str; 2] = ["hc595_pins miso", "mt6701_ssi mosi"];

    /// Parts that get their supply from elsewhere: over a resistor, from a pin, from the robot's battery.
    const WITHOUT_SUPPLY: [&str; 5] = ["ntc", "buzzer", "vesc", "vesc_duty", "vesc_current"];

    /// Every wire of every driver of the library has a contact, and so have supply and ground where the part has them.
    #[test]
    fn every_contact_is_known() {
        let mut unknown = Vec::new();
        for part in sensedsl_model::facts::all() {
            for connection in &part.connections {
                for role in &connection.roles {
                    // The wires of a CAN controller go to a transceiver.
                    let is_can = connection.kind.name().name() == "can";
                    let name = format!("{} {}", part.name, wire(connection, *role));
                    if !is_can
                        && !NOT_AT_THE_PART.contains(&name.as_str())
                        && contact(&part, connection, *role).is_none()
                    {
                        unknown.push(name);
                    }
                }
            }
            if ground(&part).is_none() {
                unknown.push(format!("{} ground: {:?}", part.name, part.connector));
            }
            let has_supply =
                part.supply_mv.is_some() && !WITHOUT_SUPPLY.contains(&part.name.as_str());
            if has_supply && supply(&part).is_none() {
                unknown.push(format!("{} supply: {:?}", part.name, part.connector));
            }
        }
        assert!(unknown.is_empty(), "{unknown:#?}");
    }
}

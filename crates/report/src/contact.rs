//! What is printed beside the contacts of modules: a wire of a driver in, the contact out.

use sensedsl_model::design::{Connection, Module};
use sensedsl_model::facts::ConnectionFacts;
use sensedsl_model::kind::{Kind, Role};

/// Wires of a part: the driver's name for them, their kind, and how many they are.
#[derive(Clone, Copy)]
pub(crate) struct Wires<'a> {
    name: Option<&'a str>,
    kind: &'a Kind,
    count: usize,
}

impl<'a> Wires<'a> {
    /// Those of a driver.
    pub(crate) fn of_driver(facts: &'a ConnectionFacts) -> Self {
        Self { name: facts.name.as_deref(), kind: &facts.kind, count: facts.roles.len() }
    }

    /// Those of a design.
    pub(crate) fn of_design(own: &'a Connection) -> Self {
        let count = own.kind.roles(own.direction).len();
        Self { name: own.name.as_deref(), kind: &own.kind, count }
    }

    /// The tool's name for one: `scl`, `pwm_a`, `encoder.a`.
    pub(crate) fn wire(self, role: Role) -> String {
        match self.name {
            None => role.name().to_owned(),
            Some(name) if self.count == 1 => name.to_owned(),
            Some(name) => format!("{name}.{role}"),
        }
    }

    /// The contact of the module that one goes to: the one that the driver states, or that its name tells.
    pub(crate) fn contact(self, module: &Module, role: Role) -> Option<&str> {
        if let Some(stated) = stated(module, &self.wire(role)) {
            return Some(stated);
        }
        let own = self.name.filter(|_| self.count == 1).map(spelled).unwrap_or_default();
        let known = names_of(self.kind, role).iter().filter(|_| own.is_empty());
        let names = own.iter().map(String::as_str).chain(known.copied());
        names.into_iter().find_map(|wanted| {
            // What the driver states for another wire is not this one's: the clock of an HX711 is at MOSI.
            let is_free = |entry: &&str| module.contacts.iter().all(|(_, other)| other != entry);
            let mut found = called(module, wanted).filter(is_free);
            let first = found.next()?;
            found.next().is_none().then_some(first)
        })
    }
}

/// The contact for the part's supply.
pub(crate) fn supply(module: &Module) -> Option<&str> {
    const NAMES: [&str; 10] =
        ["VCC", "VIN", "VDD", "5V", "3V3", "3.3V", "+5V", "+5", "3.3v-5v", "6 V+"];
    let known = || NAMES.iter().find_map(|name| whole(module, name));
    stated(module, "supply").or_else(known)
}

/// The contact for the part's ground.
pub(crate) fn ground(module: &Module) -> Option<&str> {
    let known = || called(module, "GND").next().or_else(|| called(module, "0V").next());
    stated(module, "ground").or_else(known)
}

/// The contact that the driver states.
fn stated<'a>(module: &'a Module, wire: &str) -> Option<&'a str> {
    let found = module.contacts.iter().find(|(name, _)| name == wire)?;
    Some(&found.1)
}

/// The contacts that have a word in their names.
fn called<'a>(module: &'a Module, wanted: &str) -> impl Iterator<Item = &'a str> {
    let is_called = move |entry: &&str| {
        let mut words = entry.split(|letter: char| !letter.is_ascii_alphanumeric());
        words.any(|word| word.eq_ignore_ascii_case(wanted))
    };
    module.connector.iter().map(String::as_str).filter(is_called)
}

/// The contact of that very name.
fn whole<'a>(module: &'a Module, name: &str) -> Option<&'a str> {
    module.connector.iter().map(String::as_str).find(|entry| entry.eq_ignore_ascii_case(name))
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
        Role::Direction => &["DE", "DIR", "EN"],
        Role::Trigger => &["TRIG"],
        Role::Data => &["DATA", "DQ", "OUT", "SIGNAL", "S", "PIN"],
        Role::Step => &["STEP", "STP", "PUL", "PUL+"],
        Role::Dir => &["DIR", "DIR+"],
        Role::Enable => &["EN", "ENABLE", "ENA", "ENA+"],
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
    const NOT_AT_THE_PART: [&str; 7] = [
        "hc595_pins miso",
        "mt6701_ssi mosi",
        "sabertooth rx",
        "max31855 mosi",
        "max6675 mosi",
        "hx711 sck",
        "hx711 cs",
    ];

    /// Parts that get their supply from elsewhere: over a resistor, from a pin, from the robot's battery.
    const WITHOUT_SUPPLY: [&str; 19] = [
        "ntc",
        "buzzer",
        "vesc",
        "vesc_duty",
        "vesc_current",
        "vesc_uart",
        "odrive",
        "odrive_position",
        "odrive_torque",
        "wind_vane",
        "roboclaw",
        "sabertooth",
        "kangaroo",
        "xl330",
        "xl430",
        "xl430_wheel",
        "ax12",
        "sts3215",
        "lx16a",
    ];

    /// Every wire of every driver of the library has a contact, and so have supply and ground where the part has them.
    #[test]
    fn every_contact_is_known() {
        let mut unknown = Vec::new();
        for part in sensedsl_model::facts::all() {
            for connection in &part.connections {
                let wires = Wires::of_driver(connection);
                for role in &connection.roles {
                    // The wires of a CAN controller go to a transceiver.
                    let is_can = connection.kind.name().name() == "can";
                    let name = format!("{} {}", part.name, wires.wire(*role));
                    if !is_can
                        && !NOT_AT_THE_PART.contains(&name.as_str())
                        && wires.contact(&part.module, *role).is_none()
                    {
                        unknown.push(name);
                    }
                }
            }
            if ground(&part.module).is_none() {
                unknown.push(format!("{} ground: {:?}", part.name, part.module.connector));
            }
            let has_supply =
                part.supply_mv.is_some() && !WITHOUT_SUPPLY.contains(&part.name.as_str());
            if has_supply && supply(&part.module).is_none() {
                unknown.push(format!("{} supply: {:?}", part.name, part.module.connector));
            }
        }
        assert!(unknown.is_empty(), "{unknown:#?}");
    }
}

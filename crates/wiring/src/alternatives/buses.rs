//! Buses and serial ports.

use sensedsl_board::pin::natural;
use sensedsl_board::signal::{CanLine, Function, I2cLine, SpiLine, UartLine};
use sensedsl_board::table::Usage;
use sensedsl_model::kind::{Kind, Role};

use super::candidates::Need;
use super::{Made, Maker, unit_fits};
use crate::names::{Group, Resource};

impl Maker<'_, '_> {
    /// Buses and serial ports: all wires of one instance.
    pub(super) fn units(&mut self) -> Vec<Made> {
        let mut made = Vec::new();
        for unit in self.unit_names() {
            let known = self.profile().is_none_or(|profile| profile.unit(&unit).is_some());
            if known && unit_fits(self.offer, self.wanted, &unit) {
                made.extend(self.unit(&unit));
            }
        }
        made
    }

    pub(super) fn unit(&mut self, unit: &str) -> Vec<Made> {
        let board = self.offer.index;
        let resource = Resource::Unit(board, unit.to_owned());
        let names = &mut self.builder.names;
        let mut claims = Vec::new();
        let sharing = match self.wanted.kind {
            Kind::I2c(i2c) => {
                let address = Resource::Address(board, unit.to_owned(), i2c.address);
                claims.push(names.own(address));
                if i2c.exclusive { Sharing::Exclusive } else { Sharing::Bus(0) }
            }
            Kind::Spi(_) => Sharing::Bus(0),
            Kind::Can(can) => Sharing::Bus(can.bitrate_hz),
            Kind::Uart(_)
            | Kind::Analog(_)
            | Kind::Icu(_)
            | Kind::Encoder(_)
            | Kind::Digital(_)
            | Kind::Pwm(_)
            | Kind::Dac(_) => Sharing::Exclusive,
        };
        let bus = match sharing {
            Sharing::Exclusive => {
                claims.push(names.own(resource));
                None
            }
            Sharing::Bus(setting) => {
                let group = Group::Bus(board, unit.to_owned(), setting);
                claims.push(names.shared(resource, group.clone()));
                Some(group)
            }
        };
        let roles = self.wanted.kind.roles(self.wanted.direction);
        let roles = roles.into_iter().map(|role| {
            let serves = |usage: &Usage| is_wire(usage, unit, role);
            if role == Role::Cs {
                return self.role(role, &Need::Gpio, None);
            }
            self.role(role, &Need::Usage(&serves), bus.as_ref().map(|bus| (unit, bus)))
        });
        let roles: Vec<_> = roles.collect();
        self.finish(Some(unit), &claims, roles)
    }

    /// The instances of the device's kind that the offered pins name, in natural order.
    pub(super) fn unit_names(&self) -> Vec<String> {
        let roles = self.wanted.kind.roles(self.wanted.direction);
        let usages = self.offer.pins().flat_map(|(_, pin)| &pin.usages);
        let named = usages.filter_map(|usage| {
            let unit = wire_unit(usage, self.wanted.kind)?;
            roles.iter().any(|role| is_wire(usage, &unit, *role)).then_some(unit)
        });
        let mut names: Vec<String> = named.collect();
        names.sort_by(|a, b| natural(a, b));
        names.dedup();
        names
    }
}

/// How the devices on one peripheral instance share it.
pub(super) enum Sharing {
    /// Not at all.
    Exclusive,
    /// As a bus; the number is a setting they must agree on.
    Bus(u32),
}

/// The instance whose wire the usage is, when it is of the device's kind.
pub(super) fn wire_unit(usage: &Usage, kind: &Kind) -> Option<String> {
    match (usage.signal.function(), kind) {
        (Function::I2c { unit, .. }, Kind::I2c(_))
        | (Function::Spi { unit, .. }, Kind::Spi(_))
        | (Function::Uart { unit, .. }, Kind::Uart(_))
        | (Function::Can { unit, .. }, Kind::Can(_)) => Some(unit.to_string()),
        _ => None,
    }
}

/// Whether the usage is that wire of that instance.
pub(super) fn is_wire(usage: &Usage, unit: &str, role: Role) -> bool {
    match (usage.signal.function(), role) {
        (Function::I2c { unit: of, line: I2cLine::Scl }, Role::Scl)
        | (Function::I2c { unit: of, line: I2cLine::Sda }, Role::Sda)
        | (Function::Spi { unit: of, line: SpiLine::Sck }, Role::Sck)
        | (Function::Spi { unit: of, line: SpiLine::Miso }, Role::Miso)
        | (Function::Spi { unit: of, line: SpiLine::Mosi }, Role::Mosi)
        | (Function::Uart { unit: of, line: UartLine::Tx }, Role::Tx)
        | (Function::Uart { unit: of, line: UartLine::Rx }, Role::Rx)
        | (Function::Can { unit: of, line: CanLine::Tx }, Role::Tx)
        | (Function::Can { unit: of, line: CanLine::Rx }, Role::Rx) => unit == of.as_str(),
        _ => false,
    }
}

//! `i2c`: SCL and SDA of one unit, shared by devices with different addresses.

use sensedsl_board::signal::{Function, I2cLine, UnitName};
use sensedsl_board::table::Usage;
use sensedsl_model::kind::i2c::I2c;
use sensedsl_model::kind::{Kind, Role};

use super::buses::{Bus, Sharing};
use super::{Alternatives, Maker, Served};

impl Served for I2c {
    fn ways(&self, maker: &mut Maker<'_, '_>) -> Vec<Alternatives> {
        let sharing = if self.exclusive { Sharing::Exclusive } else { Sharing::Bus(0) };
        maker.units(&Bus { wire, sharing, address: Some(self.address) })
    }

    fn is_exclusive(&self) -> bool {
        self.exclusive
    }

    fn sharing(&self) -> Option<Kind> {
        self.exclusive.then(|| Kind::I2c(I2c { exclusive: false, ..self.clone() }))
    }
}

fn wire(usage: &Usage) -> Option<(&UnitName, Role)> {
    let Function::I2c { unit, line } = usage.signal.function() else { return None };
    let role = match line {
        I2cLine::Scl => Role::Scl,
        I2cLine::Sda => Role::Sda,
    };
    Some((unit, role))
}

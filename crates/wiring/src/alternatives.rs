//! The ways to connect one device: the peripheral instances that it may take, and the pins for
//! each.

mod buses;
mod candidates;
mod cases;
mod edges;
mod pio;
pub(crate) mod timers;

// One file for each kind.
mod analog;
mod can;
mod code;
mod dac;
mod digital;
mod encoder;
mod i2c;
mod icu;
mod onewire;
mod pwm;
mod spi;
mod stepper;
mod uart;

use sensedsl_board::profile::TargetProfile;
use sensedsl_board::silicon::Ability;
use sensedsl_model::design::Board;
use sensedsl_model::kind::Kind;
use sensedsl_solve::problem::Alternative;

use crate::builder::{Builder, Meaning};
use crate::offer::Offer;
use crate::requested::RequestedWires;
use crate::wishes;

/// All ways to connect a device, with their meanings.
pub(crate) fn alternatives<'a>(
    builder: &mut Builder<'a>,
    offers: &[Offer<'a>],
    wanted: &RequestedWires<'a>,
) -> (Vec<Alternative>, Vec<Meaning>) {
    let rules = wishes::rules(builder, wanted);
    let mut list = Vec::new();
    let mut meanings = Vec::new();
    for offer in offers.iter().filter(|offer| wanted.boards.contains(&offer.index)) {
        if builder.cancel.is_over() {
            break;
        }
        let mut maker = Maker { builder, offer, wanted, rules: &rules };
        for (alternative, meaning) in served(wanted.kind).ways(&mut maker) {
            list.push(alternative);
            meanings.push(meaning);
        }
    }
    (list, meanings)
}

pub(crate) struct Maker<'b, 'a> {
    builder: &'b mut Builder<'a>,
    offer: &'b Offer<'a>,
    wanted: &'b RequestedWires<'a>,
    rules: &'b wishes::Rules<'a>,
}

pub(crate) type Alternatives = (Alternative, Meaning);

impl Maker<'_, '_> {
    fn profile(&self) -> Option<&TargetProfile> {
        self.offer.board.profile()
    }
}

/// The pins that can serve a kind; each kind implements this in a file of its own.
pub(crate) trait Served {
    /// All ways to connect the device to the board in question.
    fn ways(&self, maker: &mut Maker<'_, '_>) -> Vec<Alternatives>;

    /// The abilities of the board's timer channels for the kind, if its silicon differs from most.
    fn ability(&self, _board: &Board) -> Option<&'static Ability> {
        None
    }

    /// Whether handlers of pin interrupts can serve the device, where a system has them.
    fn takes_handlers(&self) -> bool {
        false
    }

    /// Whether a programmable state machine can serve the device.
    fn takes_machines(&self) -> bool {
        false
    }

    /// Whether no other device may be on the bus because the file says so.
    fn is_exclusive(&self) -> bool {
        false
    }

    /// The same device without that; `None` if the file does not say so.
    fn sharing(&self) -> Option<Kind> {
        None
    }

    /// The frequency that the outputs of a timer share.
    fn frequency_hz(&self) -> Option<u32> {
        None
    }

    /// The same device at another frequency; `None` if it has none.
    fn retuned(&self, _hz: u32) -> Option<Kind> {
        None
    }

    /// Whether the kind needs several channels of one timer.
    fn takes_whole_timer(&self) -> bool {
        false
    }
}

/// The implementation that knows which pins can serve a kind.
pub(crate) fn served(kind: &Kind) -> &dyn Served {
    match kind {
        Kind::Analog(analog) => analog,
        Kind::I2c(i2c) => i2c,
        Kind::Icu(icu) => icu,
        Kind::Encoder(encoder) => encoder,
        Kind::Digital(digital) => digital,
        Kind::Uart(uart) => uart,
        Kind::Spi(spi) => spi,
        Kind::Pwm(pwm) => pwm,
        Kind::Dac(dac) => dac,
        Kind::Can(can) => can,
        Kind::OneWire(onewire) => onewire,
        Kind::Stepper(stepper) => stepper,
        Kind::Code(code) => code,
    }
}

/// Whether the instance is not reserved and is the fixed one, if one is fixed.
fn unit_fits(offer: &Offer<'_>, wanted: &RequestedWires<'_>, unit: &str) -> bool {
    wanted.unit.is_none_or(|fixed| offer.same_unit(fixed, unit)) && !offer.unit_reserved(unit)
}

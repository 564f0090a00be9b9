//! The decoder of encoders with two tracks.

use core::cell::Cell;

use embassy_nrf::Peri;
use embassy_nrf::gpio::{AnyPin, Input, Pin as _, Pull};
use embassy_nrf::pac::QDEC as UNIT;
use embassy_nrf::pac::qdec::vals::Sampleper;
use embassy_nrf::peripherals::QDEC;

/// The decoder, which samples both tracks every 128 µs.
pub struct Qdec {
    _unit: Peri<'static, QDEC>,
    _tracks: [Input<'static>; 2],
    total: Cell<u16>,
}

impl Qdec {
    /// It counts from now on. Tracks that nothing drives are high.
    #[must_use]
    pub fn new(
        unit: Peri<'static, QDEC>,
        a: Peri<'static, AnyPin>,
        b: Peri<'static, AnyPin>,
    ) -> Self {
        UNIT.psel().a().write_value(a.psel_bits());
        UNIT.psel().b().write_value(b.psel_bits());
        let tracks = [a, b].map(|track| Input::new(track, Pull::Up));
        UNIT.sampleper().write(|register| register.set_sampleper(Sampleper::_128us));
        UNIT.enable().write(|register| register.set_enable(true));
        UNIT.tasks_start().write_value(1);
        Self { _unit: unit, _tracks: tracks, total: Cell::new(0) }
    }

    /// Steps so far; wraps.
    pub fn count(&self) -> u16 {
        // The unit hands its steps over, and begins with none.
        UNIT.tasks_readclracc().write_value(1);
        let steps = UNIT.accread().read();
        let total = self.total.get().wrapping_add(steps as u16);
        self.total.set(total);
        total
    }
}

//! Slices of the PWM unit as inputs: they count while their pin is active, or its edges.

use embassy_rp::Peri;
use embassy_rp::gpio::{Input, Pull};
use embassy_rp::pac;
use embassy_rp::pac::io::vals::Inover;
use embassy_rp::pwm::{ChannelBPin, Config, InputMode, Pwm, Slice};
use fixed::FixedU16;

use crate::capture::{SharedCapture, note};

/// A slice that counts edges.
pub struct Edges(Pwm<'static>);

impl Edges {
    /// The slice counts the edges of its pin B that `mode` names.
    pub fn new<T: Slice>(
        slice: Peri<'static, T>,
        pin: Peri<'static, impl ChannelBPin<T>>,
        mode: InputMode,
    ) -> Self {
        Self(Pwm::new_input(slice, pin, Pull::None, mode, Config::default()))
    }

    /// Edges so far; wraps.
    pub fn count(&self) -> u16 {
        self.0.counter()
    }
}

/// A slice that counts while its pin is active.
pub struct Gate {
    slice: Pwm<'static>,
    /// The same pin, whose edges are waited for.
    edges: Input<'static>,
    pin: usize,
    /// The level that counts.
    active: bool,
}

impl Gate {
    /// `sixteenths`: of clocks in a tick.
    pub fn new<T: Slice, P: ChannelBPin<T>>(
        slice: Peri<'static, T>,
        pin: Peri<'static, P>,
        sixteenths: u16,
        active: bool,
    ) -> Self {
        let mut config = Config::default();
        config.divider = FixedU16::from_bits(sixteenths);
        let number = usize::from(pin.pin());
        // SAFETY: the slice takes the pin over, and leaves its interrupt alone.
        let edges = Input::new(unsafe { pin.clone_unchecked() }, Pull::None);
        let slice = Pwm::new_input(slice, pin, Pull::None, InputMode::Level, config);
        if !active {
            // The slice only knows high; the interrupt sees the pin as it is.
            pac::IO_BANK0.gpio(number).ctrl().modify(|control| control.set_inover(Inover::INVERT));
        }
        Self { slice, edges, pin: number, active }
    }

    fn is_active(&self) -> bool {
        pac::IO_BANK0.gpio(self.pin).status().read().infrompad() == self.active
    }

    /// The ticks that were counted, from which on it counts anew; none where the counter had not enough bits.
    fn take(&mut self) -> Option<u16> {
        let ticks = self.slice.counter();
        self.slice.set_counter(0);
        let is_whole = !self.slice.wrapped();
        self.slice.clear_wrapped();
        is_whole.then_some(ticks)
    }
}

/// Measures widths, for ever. What is longer than the slice counts is left out, and so is a pulse that was under way
/// when the one before it was looked at, with that one: the slice counts them as one.
pub async fn measure(mut gate: Gate, seen: &SharedCapture) -> ! {
    let mut is_whole = false;
    loop {
        if gate.active {
            gate.edges.wait_for_falling_edge().await;
        } else {
            gate.edges.wait_for_rising_edge().await;
        }
        let is_over = !gate.is_active();
        let ticks = gate.take();
        if let (true, true, Some(ticks)) = (is_whole, is_over, ticks) {
            note(seen, |captured| captured.on_width(ticks.into(), false));
        }
        is_whole = !gate.is_active();
    }
}

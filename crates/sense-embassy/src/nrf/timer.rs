//! Timers as inputs: an edge makes one keep its count, or count one more, without the processor.

use embassy_nrf::Peri;
use embassy_nrf::gpio::{AnyPin, Pull};
use embassy_nrf::gpiote::{self, InputChannel, InputChannelPolarity};
use embassy_nrf::ppi::{ConfigurableChannel, Ppi};
use embassy_nrf::timer::{Cc, Frequency, Instance, Timer};

use crate::capture::{Edges, Timed};

const fn polarity(edges: Edges) -> InputChannelPolarity {
    match edges {
        Edges::Rising => InputChannelPolarity::LoToHi,
        Edges::Falling => InputChannelPolarity::HiToLo,
        Edges::Both => InputChannelPolarity::Toggle,
    }
}

/// A timer that counts edges.
pub struct Count {
    /// It has the pin.
    _input: InputChannel<'static>,
    count: Cc<'static>,
}

impl Count {
    /// It counts from now on. `channel` and `route` lead an edge at the pin to the timer.
    pub fn new<T: Instance>(
        timer: Peri<'static, T>,
        channel: Peri<'static, impl gpiote::Channel>,
        route: Peri<'static, impl ConfigurableChannel>,
        pin: Peri<'static, AnyPin>,
        edges: Edges,
    ) -> Self {
        let input = InputChannel::new(channel, pin, Pull::None, polarity(edges));
        let timer = Timer::new_counter(timer);
        let mut route = Ppi::new_one_to_one(route, input.event_in(), timer.task_count());
        route.enable();
        route.persist();
        timer.start();
        let count = timer.cc(0);
        timer.persist();
        Self { _input: input, count }
    }

    /// Edges so far; wraps.
    pub fn count(&self) -> u16 {
        self.count.capture() as u16
    }
}

/// A timer that keeps the time of the last edge.
pub struct Stopwatch {
    input: InputChannel<'static>,
    time: Cc<'static>,
}

impl Stopwatch {
    /// It runs from now on, with 16 MHz that are divided by `1 << power`.
    pub fn new<T: Instance>(
        timer: Peri<'static, T>,
        channel: Peri<'static, impl gpiote::Channel>,
        route: Peri<'static, impl ConfigurableChannel>,
        pin: Peri<'static, AnyPin>,
        edges: Edges,
        power: u8,
    ) -> Self {
        let input = InputChannel::new(channel, pin, Pull::None, polarity(edges));
        let timer = Timer::new(timer);
        timer.set_frequency(frequency(power));
        let time = timer.cc(0);
        let mut route = Ppi::new_one_to_one(route, input.event_in(), time.task_capture());
        route.enable();
        route.persist();
        timer.start();
        timer.persist();
        Self { input, time }
    }
}

impl Timed for Stopwatch {
    async fn edge(&mut self) -> (u32, bool) {
        self.input.wait().await;
        (self.time.read(), self.input.pin().is_high())
    }
}

fn frequency(power: u8) -> Frequency {
    match power {
        0 => Frequency::F16MHz,
        1 => Frequency::F8MHz,
        2 => Frequency::F4MHz,
        3 => Frequency::F2MHz,
        4 => Frequency::F1MHz,
        5 => Frequency::F500kHz,
        6 => Frequency::F250kHz,
        7 => Frequency::F125kHz,
        8 => Frequency::F62500Hz,
        _ => Frequency::F31250Hz,
    }
}

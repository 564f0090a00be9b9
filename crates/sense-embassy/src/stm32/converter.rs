//! Converters of STM32F2, F4 and F7, which the HAL reads by waiting in a loop: here their interrupt takes the samples
//! and starts the next conversions, so that the processor does something else meanwhile.
//!
//! The conversions are the injected ones, which have a register for each of four results: one interrupt for four
//! samples, and none is lost however late it is taken.

use core::cell::Cell;

use embassy_stm32::adc::SampleTime;
use embassy_stm32::pac::adc::Adc;
use embassy_sync::blocking_mutex::Mutex;
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::signal::Signal;

/// Conversions that are started together.
const GROUP: usize = 4;

/// The conversions of one input that go on; they have ended when `next` is behind the slots.
struct Conversions {
    slots: &'static mut [u16],
    next: usize,
    step: usize,
}

/// Fills the samples of a task, one input after the other. The HAL has set the converter up, and one task at a time
/// uses it.
pub struct Sampler {
    converter: Adc,
    present: Mutex<CriticalSectionRawMutex, Cell<Option<Conversions>>>,
    full: Signal<CriticalSectionRawMutex, &'static mut [u16]>,
}

impl Sampler {
    /// The sampler of a converter.
    pub const fn new(converter: Adc) -> Self {
        Self { converter, present: Mutex::new(Cell::new(None)), full: Signal::new() }
    }

    /// Converts an input for each `step`th slot from `first` on, and gives the slots back.
    pub async fn fill(
        &self,
        channel: u8,
        time: SampleTime,
        slots: &'static mut [u16],
        first: usize,
        step: usize,
    ) -> &'static mut [u16] {
        let converter = self.converter;
        match channel {
            0..=9 => converter.smpr2().write(|times| times.set_smp(usize::from(channel), time)),
            _ => converter.smpr1().write(|times| times.set_smp(usize::from(channel - 10), time)),
        }
        converter.jsqr().write(|sequence| {
            sequence.set_jl(3);
            (0..GROUP).for_each(|at| sequence.set_jsq(at, channel));
        });
        converter.cr1().write(|control| {
            control.set_scan(true);
            control.set_jeocie(true);
        });
        self.present.lock(|cell| cell.set(Some(Conversions { slots, next: first, step })));
        self.start();
        self.full.wait().await
    }

    fn start(&self) {
        self.converter.cr2().write(|control| {
            control.set_adon(true);
            control.set_jswstart(true);
        });
    }

    /// Takes the samples if the interrupt is this converter's, which shares it with others.
    pub fn on_interrupt(&self) {
        let converter = self.converter;
        if !converter.sr().read().jeoc() {
            return;
        }
        // Flags that are written as 1 stay as they are.
        converter.sr().write(|flags| {
            flags.0 = u32::MAX;
            flags.set_jeoc(false);
        });
        let full = self.present.lock(|cell| {
            let mut now = cell.take()?;
            for at in 0..GROUP {
                let Some(slot) = now.slots.get_mut(now.next) else { break };
                *slot = converter.jdr(at).read().jdata();
                now.next += now.step;
            }
            if now.next >= now.slots.len() {
                return Some(now.slots);
            }
            cell.set(Some(now));
            self.start();
            None
        });
        if let Some(slots) = full {
            self.full.signal(slots);
        }
    }
}

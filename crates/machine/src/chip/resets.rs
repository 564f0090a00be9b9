//! Resets: of everything, and of the peripherals that belong to a bit of the clock control. With the multiplexer of the
//! DMA, which a reset of either side concerns.

use super::Chip;
use crate::adc;
use crate::dac::Dac;
use crate::dma;
use crate::exti::Exti;
use crate::iwdg::Iwdg;
use crate::map::Device;
use crate::plain::Plain;
use crate::registers::merge;
use crate::timer::Timer;
use crate::wires::ResetCause;

impl Chip {
    /// Puts all peripherals into their state after a reset; the backup domain keeps its contents unless power was lost.
    pub(crate) fn restart(&mut self, cause: ResetCause) {
        self.rcc.reset(cause);
        for register in self.rcc.enables() {
            self.reset_behind(*register, u32::MAX);
        }
        if cause == ResetCause::Power {
            self.backup = Plain::new(self.mcu.block("BKP"));
        }
        self.iwdg = Iwdg::new(self.wires.clocks.lsi);
        self.exti = Exti::new(self.mcu);
        self.wires.gpio.reset();
        self.take_clocks();
        self.settle();
    }

    /// Writes the register of a channel of the multiplexer.
    pub(super) fn multiplex(&mut self, channel: usize, value: u32, mask: u32) {
        if self.mcu.multiplexed(channel).is_none() {
            return;
        }
        self.selected.resize(self.selected.len().max(channel + 1), 0);
        self.selected[channel] = merge(self.selected[channel], value, mask);
        self.select_all();
    }

    /// Tells the controllers what the multiplexer has selected.
    fn select_all(&mut self) {
        for (channel, selected) in self.selected.iter().enumerate() {
            if let Some((controller, stream)) = self.mcu.multiplexed(channel) {
                self.dmas[controller].select(stream, selected & 0x7F);
            }
        }
    }

    /// Resets the peripherals that belong to clock bits.
    pub(super) fn reset_behind(&mut self, register: u32, bits: u32) {
        for device in self.mcu.behind(register, bits) {
            match device {
                Device::Gpio(port) => self.wires.gpio.reset_port(port),
                Device::Timer(unit) => {
                    self.timers[unit] = Timer::new(unit, self.mcu);
                    self.timers[unit].settle(&mut self.wires);
                }
                Device::Usart(unit) => self.usarts[unit].restart(&mut self.wires),
                Device::Spi(unit) => self.spis[unit].restart(&mut self.wires),
                Device::I2c(unit) => self.i2cs[unit].restart(&mut self.wires),
                Device::Can(unit) => self.cans[unit].restart(&mut self.wires),
                Device::Fdcan(unit) => self.fdcans[unit].restart(&mut self.wires),
                Device::Dac(unit) => {
                    let number = u8::try_from(unit + 1).unwrap_or(1);
                    self.dacs[unit] = Dac::new(number, self.mcu);
                }
                Device::Dma(controller) => {
                    self.dmas[controller] = dma::new(self.mcu.block("DMA1"));
                    self.select_all();
                }
                Device::Multiplexer => {
                    self.selected.fill(0);
                    self.select_all();
                }
                Device::Adc(unit) => self.reset_adc(unit),
                Device::Afio => {
                    self.wires.gpio.reset_afio();
                    self.wires.version += 1;
                }
                Device::Usb => self.usb.restart(&mut self.wires),
                _ => {}
            }
        }
    }

    /// Resets a converter. Those that share registers have the first one's reset.
    fn reset_adc(&mut self, unit: usize) {
        let block = self.mcu.block("ADC1");
        let mut commons = self.adc_commons.values_mut();
        match commons.find(|own| own.members.contains(&unit)) {
            Some(own) if own.members.first() == Some(&unit) => own.restart(block, &mut self.adcs),
            Some(_) => {}
            None => self.adcs[unit] = adc::new(block, u8::try_from(unit + 1).unwrap_or(1)),
        }
    }
}

//! Parts on I²C.

use embassy_rp::i2c::{AbortReason, Async, Error, I2c, Instance};
use embassy_rp::pac;
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::mutex::Mutex;
use embassy_time::{Duration, with_timeout};
use sense_rt::{Outcome, Step};

use crate::bus::Line;

/// A bus that several tasks share.
pub type I2cBus<T> = Mutex<CriticalSectionRawMutex, I2c<'static, T, Async>>;

/// A part that is chosen by its address: its bus, and the registers of the bus.
pub struct I2cLine<T: Instance + 'static>(pub &'static I2cBus<T>, pub pac::i2c::I2c);

/// The outcome of a transfer.
fn outcome(result: &Result<Result<(), Error>, embassy_time::TimeoutError>) -> Outcome {
    match result {
        Ok(Ok(())) => Outcome::Fresh,
        Ok(Err(Error::Abort(AbortReason::NoAcknowledge))) => Outcome::NotAcknowledged,
        Ok(Err(Error::Abort(AbortReason::ArbitrationLoss))) => Outcome::ArbitrationLost,
        Ok(Err(_)) => Outcome::BusError,
        Err(_) => Outcome::TimedOut,
    }
}

impl<T: Instance> Line for I2cLine<T> {
    async fn transfer(&mut self, address: u8, step: Step<'_>, timeout: Duration) -> Outcome {
        let mut bus = self.0.lock().await;
        let outcome = outcome(&match step {
            Step::Write(bytes) => {
                with_timeout(timeout, bus.write_async(address, bytes.iter().copied())).await
            }
            Step::WriteRead([], bytes) => {
                with_timeout(timeout, bus.read_async(address, bytes)).await
            }
            Step::WriteRead(select, bytes) => {
                let select = select.iter().copied();
                with_timeout(timeout, bus.write_read_async(address, select, bytes)).await
            }
            // Of SPI only.
            Step::Exchange(..) | Step::Wait(_) => return Outcome::BusError,
        });
        // What a transfer that did not end has left in the unit would stop each one that follows.
        if matches!(outcome, Outcome::TimedOut | Outcome::ArbitrationLost | Outcome::BusError) {
            reset(self.1);
        }
        outcome
    }
}

/// Resets a unit, which keeps its clock.
fn reset(unit: pac::i2c::I2c) {
    let (high, low) = (unit.ic_fs_scl_hcnt().read(), unit.ic_fs_scl_lcnt().read());
    let (spikes, hold) = (unit.ic_fs_spklen().read(), unit.ic_sda_hold().read());
    let mut own = pac::resets::regs::Peripherals::default();
    own.set_i2c0(unit == pac::I2C0);
    own.set_i2c1(unit == pac::I2C1);
    // Others reset their units in the same register.
    cortex_m::interrupt::free(|_| {
        pac::RESETS.reset().modify(|units| units.0 |= own.0);
        pac::RESETS.reset().modify(|units| units.0 &= !own.0);
    });
    while pac::RESETS.reset_done().read().0 & own.0 != own.0 {}
    // It takes them while it is not enabled, as it is until the next transfer.
    unit.ic_enable().write(|register| register.set_enable(false));
    unit.ic_fs_scl_hcnt().write_value(high);
    unit.ic_fs_scl_lcnt().write_value(low);
    unit.ic_fs_spklen().write_value(spikes);
    unit.ic_sda_hold().write_value(hold);
}

/// A bus at a clock.
pub fn config(clock_hz: u32) -> embassy_rp::i2c::Config {
    let mut config = embassy_rp::i2c::Config::default();
    config.frequency = clock_hz;
    config
}

//! Parts on I²C.

use embassy_stm32::i2c::{self, I2c, Master};
use embassy_stm32::mode::Async;
use embassy_stm32::time::hz;
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::mutex::Mutex;
use embassy_time::{Duration, with_timeout};
use sense_rt::{Outcome, Step};

use crate::bus::Line;

#[cfg(feature = "i2c-v1")]
mod v1;
#[cfg(feature = "i2c-v2")]
mod v2;
#[cfg(feature = "i2c-v1")]
use v1::reset;
#[cfg(feature = "i2c-v2")]
use v2::reset;

/// How a bus is set: its clock, and pull-ups where the pins have them while a unit uses them.
#[must_use]
pub fn config(clock_hz: u32) -> i2c::Config {
    let mut config = i2c::Config::default();
    config.frequency = hz(clock_hz);
    #[cfg(feature = "gpio-v2")]
    {
        config.scl_pullup = true;
        config.sda_pullup = true;
    }
    config
}

/// A bus that several tasks share.
pub type I2cBus = Mutex<CriticalSectionRawMutex, I2c<'static, Async, Master>>;

/// A part that is chosen by its address: its bus, and the registers of the bus.
pub struct I2cLine(pub &'static I2cBus, pub embassy_stm32::pac::i2c::I2c);

/// The outcome of a transfer.
fn outcome(result: &Result<Result<(), i2c::Error>, embassy_time::TimeoutError>) -> Outcome {
    match result {
        Ok(Ok(())) => Outcome::Fresh,
        Ok(Err(i2c::Error::Nack)) => Outcome::NotAcknowledged,
        Ok(Err(i2c::Error::Arbitration)) => Outcome::ArbitrationLost,
        Ok(Err(i2c::Error::Timeout)) | Err(_) => Outcome::TimedOut,
        Ok(Err(_)) => Outcome::BusError,
    }
}

impl Line for I2cLine {
    async fn transfer(&mut self, address: u8, step: Step<'_>, timeout: Duration) -> Outcome {
        let mut bus = self.0.lock().await;
        let outcome = outcome(&match step {
            Step::Write(bytes) => with_timeout(timeout, bus.write(address, bytes)).await,
            Step::WriteRead([], bytes) => with_timeout(timeout, bus.read(address, bytes)).await,
            Step::WriteRead(select, bytes) => {
                with_timeout(timeout, bus.write_read(address, select, bytes)).await
            }
            // Of SPI only.
            Step::Exchange(..) | Step::Wait(_) => return Outcome::BusError,
        });
        // What a transfer that did not end has left in the unit would go on, or stop each one that follows.
        if matches!(outcome, Outcome::TimedOut | Outcome::ArbitrationLost | Outcome::BusError) {
            reset(self.1);
        }
        outcome
    }
}

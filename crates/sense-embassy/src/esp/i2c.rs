//! Parts on I²C.

use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::mutex::Mutex;
use embassy_time::{Duration, with_timeout};
use esp_hal::Async;
use esp_hal::gpio::interconnect::{PeripheralInput, PeripheralOutput};
use esp_hal::i2c::master::{Config, Error, I2c, Instance};
use esp_hal::time::Rate;
use sense_rt::{Outcome, Step};

use super::OneCore;
use crate::bus::Line;

/// A unit as master.
pub type Master = OneCore<I2c<'static, Async>>;

/// A bus that several tasks share.
pub type I2cBus = Mutex<CriticalSectionRawMutex, Master>;

/// A part that is chosen by its address: its bus. A transfer that does not end by itself is ended by the HAL.
pub struct I2cLine(pub &'static I2cBus, pub ());

/// A bus at a clock. One that the unit cannot make does not start.
pub fn bus<P>(
    unit: impl Instance + 'static,
    clock_hz: u32,
    sda: P,
    scl: impl PeripheralInput<'static> + PeripheralOutput<'static>,
) -> Master
where
    P: PeripheralInput<'static> + PeripheralOutput<'static>,
{
    let config = Config::default().with_frequency(Rate::from_hz(clock_hz));
    match I2c::new(unit, config) {
        Ok(bus) => OneCore(bus.with_sda(sda).with_scl(scl).into_async()),
        Err(_) => crate::restart(),
    }
}

/// The outcome of a transfer.
fn outcome(result: &Result<Result<(), Error>, embassy_time::TimeoutError>) -> Outcome {
    match result {
        Ok(Ok(())) => Outcome::Fresh,
        Ok(Err(Error::AcknowledgeCheckFailed(_))) => Outcome::NotAcknowledged,
        Ok(Err(_)) => Outcome::BusError,
        Err(_) => Outcome::TimedOut,
    }
}

impl Line for I2cLine {
    async fn transfer(&mut self, address: u8, step: Step<'_>, timeout: Duration) -> Outcome {
        let mut bus = self.0.lock().await;
        let bus = &mut bus.0;
        outcome(&match step {
            Step::Write(bytes) => with_timeout(timeout, bus.write_async(address, bytes)).await,
            Step::WriteRead([], bytes) => {
                with_timeout(timeout, bus.read_async(address, bytes)).await
            }
            Step::WriteRead(select, bytes) => {
                with_timeout(timeout, bus.write_read_async(address, select, bytes)).await
            }
            // Of SPI only.
            Step::Exchange(..) | Step::Wait(_) => return Outcome::BusError,
        })
    }
}

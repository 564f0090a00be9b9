//! Parts on I²C.

use embassy_nrf::pac;
use embassy_nrf::twim::{Config, Error, Frequency, Twim};
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::mutex::Mutex;
use embassy_time::{Duration, with_timeout};
use sense_rt::{Outcome, Step};

use crate::bus::Line;

/// A bus that several tasks share.
pub type I2cBus = Mutex<CriticalSectionRawMutex, Twim<'static>>;

/// A part that is chosen by its address: its bus, and the registers of the bus.
pub struct I2cLine(pub &'static I2cBus, pub pac::twim::Twim);

/// The outcome of a transfer.
fn outcome(result: &Result<Result<(), Error>, embassy_time::TimeoutError>) -> Outcome {
    match result {
        Ok(Ok(())) => Outcome::Fresh,
        Ok(Err(Error::AddressNack | Error::DataNack)) => Outcome::NotAcknowledged,
        Ok(Err(_)) => Outcome::BusError,
        Err(_) => Outcome::TimedOut,
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
        // A transfer that did not end still has the buffers of this one, which are gone with it.
        if matches!(outcome, Outcome::TimedOut | Outcome::BusError) {
            reset(self.1);
        }
        outcome
    }
}

/// Ends whatever a unit does; it keeps its pins and its clock.
fn reset(unit: pac::twim::Twim) {
    unit.tasks_stop().write_value(1);
    unit.enable().write(|register| register.set_enable(pac::twim::vals::Enable::Disabled));
    unit.enable().write(|register| register.set_enable(pac::twim::vals::Enable::Enabled));
}

/// A bus at the fastest clock that is not above this one.
#[must_use]
pub fn config(clock_hz: u32) -> Config {
    let mut config = Config::default();
    config.frequency = match clock_hz {
        0..250_000 => Frequency::K100,
        250_000..400_000 => Frequency::K250,
        _ => Frequency::K400,
    };
    config
}

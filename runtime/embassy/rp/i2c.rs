//! Parts on I²C.

use embassy_rp::i2c::{AbortReason, Async, Error, I2c, Instance};
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::mutex::Mutex;
use embassy_time::{Duration, with_timeout};
use sense_rt::{Outcome, Step};

use super::bus::Line;

/// A bus that several tasks share.
pub type I2cBus<T> = Mutex<CriticalSectionRawMutex, I2c<'static, T, Async>>;

/// A part that its address chooses.
pub struct I2cLine<T: Instance + 'static>(pub &'static I2cBus<T>);

/// What came of a transfer.
fn outcome(result: Result<Result<(), Error>, embassy_time::TimeoutError>) -> Outcome {
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
        outcome(match step {
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
        })
    }
}

/// A bus at a clock.
pub fn config(clock_hz: u32) -> embassy_rp::i2c::Config {
    let mut config = embassy_rp::i2c::Config::default();
    config.frequency = clock_hz;
    config
}

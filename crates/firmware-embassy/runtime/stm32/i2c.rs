//! Parts on I²C.

use embassy_stm32::i2c::{self, I2c, Master};
use embassy_stm32::mode::Async;
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::mutex::Mutex;
use embassy_time::{Duration, with_timeout};
use sense_rt::{Outcome, Step};

use super::bus::Line;
use super::reset::reset;

/// A bus that several tasks share.
pub type I2cBus = Mutex<CriticalSectionRawMutex, I2c<'static, Async, Master>>;

/// A part that its address chooses, and the registers of its bus.
pub struct I2cLine(pub &'static I2cBus, pub embassy_stm32::pac::i2c::I2c);

/// What came of a transfer.
fn outcome(result: Result<Result<(), i2c::Error>, embassy_time::TimeoutError>) -> Outcome {
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
        let outcome = outcome(match step {
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

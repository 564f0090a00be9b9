//! Devices on register buses: the runtime says what is to be sent and read, and the bus does it.

use embassy_stm32::i2c::{self, I2c, Master};
use embassy_stm32::mode::Async;
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::mutex::Mutex;
use embassy_time::{Duration, with_timeout};
use sense_rt::{Chip, Outcome, Sink, Step};

use super::now_ms;

/// A bus that several tasks share.
pub type I2cBus = Mutex<CriticalSectionRawMutex, I2c<'static, Async, Master>>;

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

/// Makes all transfers of a chip that are due; returns how many milliseconds there is nothing to do.
pub async fn serve_i2c(bus: &I2cBus, chip: &mut Chip, timeout: Duration, sink: &mut Sink<'_>) -> u32 {
    let address = chip.table().address;
    loop {
        let mut bus = bus.lock().await;
        let outcome = match chip.next(now_ms()) {
            Step::Wait(ms) => return ms,
            Step::Write(bytes) => outcome(with_timeout(timeout, bus.write(address, bytes)).await),
            Step::WriteRead([], bytes) => {
                outcome(with_timeout(timeout, bus.read(address, bytes)).await)
            }
            Step::WriteRead(select, bytes) => {
                outcome(with_timeout(timeout, bus.write_read(address, select, bytes)).await)
            }
            // Of SPI only.
            Step::Exchange(..) => Outcome::BusError,
        };
        drop(bus);
        chip.done(outcome, sink);
    }
}

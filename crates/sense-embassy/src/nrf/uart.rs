//! Serial ports. They carry bytes by DMA alone, so each transfer has one byte: the runtime takes what comes at once,
//! and need not know how long a message is.

use core::sync::atomic::{AtomicU8, Ordering, compiler_fence};

use embassy_nrf::Peri;
use embassy_nrf::gpio::{AnyPin, Input, Level, Output, OutputDrive, Pin as _, Pull};
use embassy_nrf::pac::uarte::Uarte as Registers;
use embassy_nrf::pac::uarte::regs::Errorsrc;
use embassy_nrf::pac::uarte::vals::{Baudrate, ConfigParity, Enable};
use embassy_nrf::uarte::Instance;

use crate::serial::{self, RxQueue, TxQueue};

/// The bytes that ports are sending and receiving, by the number of the port.
static SENT: [AtomicU8; 2] = [const { AtomicU8::new(0) }; 2];
static RECEIVED: [AtomicU8; 2] = [const { AtomicU8::new(0) }; 2];

/// The clock of the ports.
const CLOCK_HZ: u64 = 16_000_000;

/// What a port sends with.
pub struct UartTx {
    port: Registers,
    /// Its pin; `None` if it does not send.
    _pin: Option<Output<'static>>,
    byte: &'static AtomicU8,
    is_sending: bool,
}

/// What keeps a port's receiving pin; `None` if it does not receive.
pub struct UartRx {
    _pin: Option<Input<'static>>,
}

/// A port with both directions.
pub struct Uart {
    tx: UartTx,
    rx: UartRx,
}

/// How a port is set.
pub struct Config {
    /// Bits per second.
    pub baud: u32,
    /// Whether there is a bit that makes the number of ones even.
    pub has_parity: bool,
    /// 1 or 2.
    pub stop_bits: u8,
}

impl Uart {
    /// A port with the pins that it has.
    pub fn new<T: Instance>(
        _unit: Peri<'static, T>,
        port: Registers,
        rx: Option<Peri<'static, AnyPin>>,
        tx: Option<Peri<'static, AnyPin>>,
        config: &Config,
    ) -> Self {
        let rx = rx.map(|pin| {
            port.psel().rxd().write_value(pin.psel_bits());
            // A wire that nothing drives rests.
            Input::new(pin, Pull::Up)
        });
        let tx = tx.map(|pin| {
            port.psel().txd().write_value(pin.psel_bits());
            Output::new(pin, Level::High, OutputDrive::Standard)
        });
        set_up(port, config);
        let byte = buffer(&SENT, port);
        Self { tx: UartTx { port, _pin: tx, byte, is_sending: false }, rx: UartRx { _pin: rx } }
    }

    /// Its directions.
    #[must_use]
    pub fn split(self) -> (UartTx, UartRx) {
        (self.tx, self.rx)
    }
}

impl UartTx {
    /// A port that only sends.
    pub fn new<T: Instance>(
        unit: Peri<'static, T>,
        port: Registers,
        tx: Peri<'static, AnyPin>,
        config: &Config,
    ) -> Self {
        Uart::new(unit, port, None, Some(tx), config).tx
    }

    /// Sends bytes, and waits for all but the last.
    fn put(&mut self, bytes: &[u8]) {
        for byte in bytes {
            while self.is_sending && self.port.events_dma().tx().end().read() == 0 {}
            self.byte.store(*byte, Ordering::Relaxed);
            compiler_fence(Ordering::SeqCst);
            self.port.events_dma().tx().end().write_value(0);
            self.port.tasks_dma().tx().start().write_value(1);
            self.is_sending = true;
        }
    }
}

impl UartRx {
    /// A port that only receives.
    pub fn new<T: Instance>(
        unit: Peri<'static, T>,
        port: Registers,
        rx: Peri<'static, AnyPin>,
        config: &Config,
    ) -> Self {
        Uart::new(unit, port, Some(rx), None, config).rx
    }
}

/// The byte of a port.
fn buffer(bytes: &'static [AtomicU8; 2], port: Registers) -> &'static AtomicU8 {
    let [first, second] = bytes;
    if port == embassy_nrf::pac::UARTE0 { first } else { second }
}

fn set_up(port: Registers, config: &Config) {
    port.baudrate().write(|register| register.set_baudrate(baudrate(config.baud)));
    port.config().write(|register| {
        let parity =
            if config.has_parity { ConfigParity::Included } else { ConfigParity::Excluded };
        register.set_parity(parity);
        // nRF52832 has not this bit, nor a name for it.
        register.0 |= u32::from(config.stop_bits == 2) << 4;
    });
    port.enable().write(|register| register.set_enable(Enable::Enabled));
    let sent = buffer(&SENT, port).as_ptr() as u32;
    port.dma().tx().ptr().write_value(sent);
    port.dma().tx().maxcnt().write(|register| register.set_maxcnt(1));
}

/// The register's value for a rate, of which the unit has the upper 20 bits.
#[must_use]
pub fn baudrate(baud: u32) -> Baudrate {
    let exact = (u64::from(baud) << 32) / CLOCK_HZ;
    Baudrate::from_bits(u32::try_from((exact + 0x800) & 0xFFFF_F000).unwrap_or(u32::MAX))
}

/// The HAL's configuration of a link.
#[must_use]
pub fn link_config(baud: u32) -> embassy_nrf::uarte::Config {
    let mut config = embassy_nrf::uarte::Config::default();
    config.baudrate = baudrate(baud);
    config
}

/// In the port's interrupt: takes the byte that has come. `mask` has the bits that are data.
pub fn on_interrupt<const BYTES: usize>(queue: &RxQueue<BYTES>, port: Registers, mask: u8) {
    if port.events_error().read() != 0 {
        port.events_error().write_value(0);
        let source = port.errorsrc().read();
        port.errorsrc().write_value(source);
        if source != Errorsrc(0) {
            queue.take(None, false, mask);
        }
    }
    if port.events_dma().rx().end().read() != 0 {
        port.events_dma().rx().end().write_value(0);
        queue.take(Some(buffer(&RECEIVED, port).load(Ordering::Relaxed)), true, mask);
    }
}

/// Lets a port interrupt when a byte has come; by itself it waits for the next one.
pub fn listen(port: Registers) {
    let received = buffer(&RECEIVED, port).as_ptr() as u32;
    port.dma().rx().ptr().write_value(received);
    port.dma().rx().maxcnt().write(|register| register.set_maxcnt(1));
    port.shorts().write(|register| register.set_endrx_startrx(true));
    port.intenset().write(|register| {
        register.set_dmarxend(true);
        register.set_error(true);
    });
    port.tasks_dma().rx().start().write_value(1);
}

/// Sends queued bytes, for ever.
pub async fn transmit<const BYTES: usize>(
    mut port: UartTx,
    queue: &'static TxQueue<BYTES>,
    baud: u32,
) -> ! {
    serial::transmit(|bytes| port.put(bytes), queue, baud).await
}

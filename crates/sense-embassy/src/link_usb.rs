//! The link over USB, as a serial port of the host.

use core::sync::atomic::Ordering;

use embassy_futures::join::{join, join3};
use embassy_usb::class::cdc_acm::{CdcAcmClass, State};
use embassy_usb::driver::{Driver, EndpointError};
use embassy_usb::{Builder, Config};
use static_cell::StaticCell;

use crate::link::Link;

/// Bytes of a packet at full speed.
const PACKET: usize = 64;
/// What descriptors and requests are put together in.
const DESCRIPTORS: usize = 128;

struct Memory {
    config: [u8; DESCRIPTORS],
    bos: [u8; 32],
    control: [u8; PACKET],
}

/// Moves bytes both ways, for ever. A host that has the port open says so by DTR.
pub async fn run<D: Driver<'static>, const TX_BYTES: usize>(
    driver: D,
    product: &'static str,
    link: &'static Link<TX_BYTES>,
) {
    static MEMORY: StaticCell<Memory> = StaticCell::new();
    static STATE: StaticCell<State<'static>> = StaticCell::new();
    let memory =
        MEMORY.init(Memory { config: [0; DESCRIPTORS], bos: [0; 32], control: [0; PACKET] });
    // pid.codes' number for tests: no product of anybody.
    let mut config = Config::new(0x1209, 0x0001);
    config.manufacturer = Some("SenseDSL");
    config.product = Some(product);
    let mut builder = Builder::new(
        driver,
        config,
        &mut memory.config,
        &mut memory.bos,
        &mut [],
        &mut memory.control,
    );
    let class = CdcAcmClass::new(&mut builder, STATE.init(State::new()), PACKET as u16);
    let mut device = builder.build();
    let (mut tx, mut rx, control) = class.split_with_control();
    let send = async {
        loop {
            tx.wait_connection().await;
            let _: Result<(), EndpointError> = async {
                let mut bytes = [0; PACKET - 1];
                loop {
                    let size = link.tx.read(&mut bytes).await;
                    link.is_sending.store(true, Ordering::Relaxed);
                    tx.write_packet(bytes.get(..size).unwrap_or_default()).await?;
                    link.is_sending.store(false, Ordering::Relaxed);
                }
            }
            .await;
            link.is_sending.store(false, Ordering::Relaxed);
        }
    };
    let receive = async {
        loop {
            rx.wait_connection().await;
            let mut bytes = [0; PACKET];
            while let Ok(size) = rx.read_packet(&mut bytes).await {
                link.rx.write_all(bytes.get(..size).unwrap_or_default()).await;
            }
        }
    };
    let watch = async {
        loop {
            control.control_changed().await;
            let is_open = control.dtr();
            if !is_open {
                // Unread bytes are not kept for the next host.
                link.tx.clear();
            }
            link.is_open.store(is_open, Ordering::Relaxed);
        }
    };
    join(device.run(), join3(send, receive, watch)).await;
}

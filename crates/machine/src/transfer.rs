//! The transfers of the DMA: items from peripherals to memory, and back.

use std::sync::Arc;

use rsemu::core::space::RamStore;

use super::chip::Chip;
use super::dma::{Direction, Dma, Item, STREAMS};
use super::map::Request;
use super::mcu::Mcu;

/// The most items that one request moves at once; a request that never ends is a mistake in a model.
const ITEMS_MAX: usize = 70_000;

/// Memory that the DMA can reach.
#[derive(Clone)]
pub(super) struct Memory {
    pub flash: Arc<RamStore>,
    pub sram: Arc<RamStore>,
}

/// The start addresses of memory.
pub(super) const FLASH_BASE: u32 = 0x0800_0000;
pub(super) const SRAM_BASE: u32 = 0x2000_0000;
/// The core-coupled memory, which the DMA does not reach.
pub(super) const CCM_BASE: u32 = 0x1000_0000;

impl Memory {
    pub(super) fn new(mcu: &Mcu) -> Self {
        let store = |bytes: u32| Arc::new(RamStore::new(u64::from(bytes)));
        Self { flash: store(mcu.flash_bytes), sram: store(mcu.sram_bytes) }
    }

    fn place(&self, address: u32) -> Option<(&RamStore, u64)> {
        let within = |store: &RamStore, base: u32| {
            let offset = u64::from(address.wrapping_sub(base));
            (offset < store.len()).then_some(offset)
        };
        if let Some(offset) = within(&self.sram, SRAM_BASE) {
            return Some((&self.sram, offset));
        }
        within(&self.flash, FLASH_BASE).map(|offset| (&*self.flash, offset))
    }

    /// A word of the SRAM.
    pub(super) fn word(&self, address: u32) -> Option<u32> {
        let mut bytes = [0; 4];
        self.sram.read_at(u64::from(address.checked_sub(SRAM_BASE)?), &mut bytes).ok()?;
        Some(u32::from_le_bytes(bytes))
    }

    /// Writes a word of the SRAM.
    pub(super) fn put_word(&self, address: u32, word: u32) {
        for (at, byte) in (address..).zip(word.to_le_bytes()) {
            // Only addresses in the SRAM have any effect.
            self.write(at, byte);
        }
    }

    fn read(&self, address: u32) -> Option<u8> {
        let (store, offset) = self.place(address)?;
        store.read_u8(offset).ok()
    }

    fn write(&self, address: u32, byte: u8) -> bool {
        let Some((store, offset)) = self.place(address) else { return false };
        address >= SRAM_BASE && store.write_u8(offset, byte).is_ok()
    }
}

impl Chip {
    pub(super) fn serve_dma(&mut self) {
        for controller in 0..self.dmas.len() {
            for stream in members(self.dmas[controller].enabled()) {
                self.serve_stream(controller, stream);
            }
            let held = self.dmas[controller].held();
            for (stream, irq) in self.dma_irqs[controller].iter().enumerate() {
                self.wires.interrupt(*irq, 0, held >> stream & 1 == 1);
            }
        }
    }

    fn serve_stream(&mut self, controller: usize, stream: usize) {
        for _ in 0..ITEMS_MAX {
            let dma = &self.dmas[controller];
            if dma.enabled() >> stream & 1 == 0 {
                return;
            }
            let item = dma.item(stream);
            if item.direction != Direction::Memory {
                let may_ask = self.mcu.requests(controller, stream, item.channel).iter();
                let Some(request) = may_ask.copied().find(|one| self.asks(*one)) else { return };
                self.served(request, item.left);
            }
            if self.move_item(item).is_none() {
                self.dmas[controller].fail(stream);
                return;
            }
            self.dmas[controller].count(stream);
        }
    }

    fn asks(&self, request: Request) -> bool {
        match request {
            Request::Adc(unit) => self.adcs[unit].asks(),
            Request::I2cRx(unit) => self.i2cs[unit].asks(false),
            Request::I2cTx(unit) => self.i2cs[unit].asks(true),
            Request::SpiRx(unit) => self.spis[unit].asks(false),
            Request::SpiTx(unit) => self.spis[unit].asks(true),
            Request::UsartRx(unit) => self.usarts[unit].asks(false),
            Request::UsartTx(unit) => self.usarts[unit].asks(true),
            Request::Timer(unit, channel) => self.timers[unit].asks(channel),
            // No firmware of this generator feeds its DAC by DMA.
            Request::Dac(_) => false,
        }
    }

    fn served(&mut self, request: Request, left: u32) {
        match request {
            Request::Timer(unit, channel) => self.timers[unit].was_served(channel),
            Request::Adc(unit) if left == 1 => self.adcs[unit].dma_ended(),
            Request::I2cRx(unit) => self.wires.i2c_left[unit] = Some(left.saturating_sub(1)),
            Request::Adc(_)
            | Request::I2cTx(_)
            | Request::SpiRx(_)
            | Request::SpiTx(_)
            | Request::UsartRx(_)
            | Request::UsartTx(_)
            | Request::Dac(_) => {}
        }
    }

    /// Moves an item; `None` if there is nothing at an address. Only the low bytes of a longer item fit into a shorter
    /// one.
    fn move_item(&mut self, Item { direction, peripheral, memory, .. }: Item) -> Option<()> {
        match direction {
            Direction::FromPeripheral => {
                let value = self.fetch(peripheral.address, peripheral.bytes)?;
                self.store_bytes(memory.address, value, memory.bytes)
            }
            Direction::ToPeripheral => {
                let value = self.load_bytes(memory.address, memory.bytes)?;
                self.put(peripheral.address, value, peripheral.bytes)
            }
            Direction::Memory => {
                let value = self.load_bytes(peripheral.address, peripheral.bytes)?;
                self.store_bytes(memory.address, value, memory.bytes)
            }
        }
    }

    fn load_bytes(&self, address: u32, size: u32) -> Option<u32> {
        (0..size).rev().try_fold(0, |value, at| {
            Some(value << 8 | u32::from(self.memory.read(address.wrapping_add(at))?))
        })
    }

    fn store_bytes(&self, address: u32, value: u32, size: u32) -> Option<()> {
        let bytes = value.to_le_bytes();
        let mut places = (0..size).zip(bytes);
        places.all(|(at, byte)| self.memory.write(address.wrapping_add(at), byte)).then_some(())
    }
}

/// The number of items left in the stream that serves a request.
pub(super) fn left_of(mcu: &Mcu, dmas: &[Box<dyn Dma>], wanted: Request) -> Option<u32> {
    for (controller, dma) in dmas.iter().enumerate() {
        for stream in members(dma.enabled()) {
            let item = dma.item(stream);
            if mcu.requests(controller, stream, item.channel).contains(&wanted) {
                return Some(item.left);
            }
        }
    }
    None
}

/// The numbers of the streams in a set.
fn members(set: u32) -> impl Iterator<Item = usize> {
    (0..STREAMS).filter(move |stream| set >> stream & 1 == 1)
}

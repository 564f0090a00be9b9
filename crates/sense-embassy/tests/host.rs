//! The parts without hardware, on a computer: the clock is one that the tests move.
#![allow(clippy::unwrap_used, clippy::panic, clippy::indexing_slicing, reason = "a test may panic")]

use std::cell::{Cell, RefCell};
use std::collections::VecDeque;
use std::convert::Infallible;
use std::sync::{Mutex, MutexGuard, PoisonError};

// The lock, for a computer.
use critical_section as _;
use embassy_futures::block_on;
use embassy_time::{Duration, Instant, MockDriver};
use embedded_io_async::{ErrorType, Read, Write};
use sense_embassy::bus::{self, Line, Written};
use sense_embassy::contact::{Level, Reported, Watched};
use sense_embassy::devices::{Devices, Report as _};
use sense_embassy::link_uart::Port;
use sense_embassy::serial::{self, Device, RxQueue, TxQueue};
use sense_embassy::{analog, queue};
use sense_rt::{
    Channel as _, Checksum, Chip, ChipTable, Coding, Command, Compose, ContactConfig, Edge,
    InitStep, Item, MessageField, MessageStream, MessageTable, NTC, Outcome, Reading, Scalar,
    Schema, Step, Transfer,
};

/// One test at a time has the clock, which begins anew.
fn clock() -> (MutexGuard<'static, ()>, &'static MockDriver) {
    static TURN: Mutex<()> = Mutex::new(());
    let turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
    let driver = MockDriver::get();
    driver.reset();
    (turn, driver)
}

static SCHEMA: Schema = Schema {
    items: &[Item::sensor(1, Scalar::Uint16, 1), Item::actuator(2, Scalar::Uint16, 1)],
    hash: 7,
    stamp: false,
    checksum: Checksum::Crc16,
};
const VALUES: usize = 4;

type Board = Devices<VALUES, 2>;

fn board() -> Board {
    Devices::new(&SCHEMA, &[10, 0])
}

fn value(board: &Board, index: usize) -> Option<Vec<u8>> {
    board.with(|store, _| store.get(index).map(<[u8]>::to_vec))
}

/// Faults of an item so far, of whatever sort.
fn faults(board: &Board, index: usize) -> u32 {
    board.with(|_, health| health.row(index, 0).counts.iter().copied().map(u32::from).sum())
}

#[test]
fn a_report_is_stored_and_a_fault_is_counted() {
    let _clock = clock();
    let board = board();
    assert_eq!(value(&board, 0), None);
    board.report(None, 0, Outcome::Fresh, &mut [1, 2]);
    assert_eq!(value(&board, 0), Some(vec![1, 2]));
    board.report(None, 0, Outcome::TimedOut, &mut []);
    let faults = faults(&board, 0);
    assert_eq!(faults, 1);
}

#[test]
fn each_value_of_the_host_has_a_number() {
    let _clock = clock();
    let board = board();
    let mut value = [0; 2];
    assert_eq!(board.requested(1, &mut value), 0);
    board.set(1, &[3, 4]);
    assert_eq!((board.requested(1, &mut value), value), (1, [3, 4]));
    board.set(1, &[3, 4]);
    assert_eq!(board.requested(1, &mut value), 2);
}

#[test]
fn samples_become_a_mean_or_are_invalid() {
    let _clock = clock();
    let board = board();
    analog::report(
        &board,
        None,
        0,
        Scalar::Uint16,
        &analog::Value::Mean,
        &[10, 20, 30, 41],
        1,
        &mut [0; 2],
    );
    assert_eq!(value(&board, 0), Some(vec![0, 25]));
    // No resistance gives a converter that is at its end.
    let ntc = analog::Value::Computed(&NTC, 0, &[3950, 10_000, 10_000]);
    analog::report(&board, None, 0, Scalar::Uint16, &ntc, &[0], 1, &mut [0; 2]);
    let faults = faults(&board, 0);
    assert_eq!(faults, 1);
}

/// A bus that notes what is written, and fails when it is told to.
#[derive(Default)]
struct Registers {
    written: Vec<Vec<u8>>,
    failure: Option<Outcome>,
}

impl Line for Registers {
    async fn transfer(&mut self, address: u8, step: Step<'_>, _: Duration) -> Outcome {
        assert_eq!(address, 0x20);
        if let Some(failure) = self.failure {
            return failure;
        }
        match step {
            Step::Write(bytes) => self.written.push(bytes.to_vec()),
            Step::WriteRead(select, answer) => {
                assert_eq!(select, [5]);
                answer.copy_from_slice(&[0x12, 0x34]);
            }
            Step::Exchange(..) | Step::Wait(_) => panic!("not on this bus"),
        }
        Outcome::Fresh
    }
}

static COMMANDS: [Command; 1] = [Command {
    prefix: &[9],
    item: 1,
    value: Coding { word_bytes: 2, ..Coding::NEW },
    ..Command::NEW
}];
static CHIP: ChipTable = ChipTable {
    init: &[InitStep { bytes: &[1], pause_ms: 0 }],
    transfers: &[Transfer { select: &[5], length: 2, cycle_ms: 10, ..Transfer::NEW }],
    readings: &[Reading {
        item: 0,
        value: Coding { word_bytes: 2, ..Coding::NEW },
        ..Reading::NEW
    }],
    commands: &COMMANDS,
    cycle_ms: 10,
    address: 0x20,
    ..ChipTable::NEW
};

#[test]
fn a_chip_is_served_and_what_it_forgot_is_written_again() {
    let (_turn, clock) = clock();
    let board = board();
    let mut line = Registers::default();
    let mut chip: Chip<[u8; 64]> = Chip::new(&CHIP, &SCHEMA);
    let mut written = [Written::NEW; 1];
    let timeout = Duration::from_millis(5);
    let mut cycle = |line: &mut Registers| {
        let mut sink =
            |index: usize, outcome, value: &mut [u8]| board.report(None, index, outcome, value);
        let idle_ms = block_on(bus::serve(line, &mut chip, timeout, &mut sink));
        block_on(bus::write(line, &mut chip, &mut written, timeout, &board, &mut [0; 2]));
        idle_ms
    };
    assert_eq!(cycle(&mut line), 10);
    assert_eq!((value(&board, 0), &line.written), (Some(vec![0x12, 0x34]), &vec![vec![1]]));
    board.set(1, &[7, 8]);
    clock.advance(Duration::from_millis(10));
    let _ = cycle(&mut line);
    // Once, however often it is served.
    let _ = cycle(&mut line);
    assert_eq!(line.written, [vec![1], vec![9, 7, 8]]);
    line.failure = Some(Outcome::NotAcknowledged);
    clock.advance(Duration::from_millis(10));
    let _ = cycle(&mut line);
    line.failure = None;
    clock.advance(Duration::from_millis(10));
    let _ = cycle(&mut line);
    assert_eq!(line.written, [vec![1], vec![9, 7, 8], vec![1], vec![9, 7, 8]]);
}

/// A pin that the test moves, which others see as well.
struct Pin<'a>(&'a Cell<bool>);

impl Level for Pin<'_> {
    fn level(&self) -> bool {
        self.0.get()
    }
}

#[test]
fn a_contact_is_debounced_and_counted() {
    let (_turn, clock) = clock();
    let level = Cell::new(false);
    let contact = Watched::new(ContactConfig { lasting: 5_000, edge: Edge::Rising });
    contact.begin(Pin(&level));
    clock.advance(Duration::from_millis(20));
    let _ = contact.look();
    assert!(!contact.level());
    level.set(true);
    contact.on_interrupt();
    clock.advance(Duration::from_millis(2));
    let _ = contact.look();
    assert!(!contact.level(), "it has not lasted");
    clock.advance(Duration::from_millis(4));
    let _ = contact.look();
    assert!(contact.level());
    let (mut reported, mut element) = (Reported::NEW, [0; 4]);
    assert!(contact.take(&mut reported, Scalar::Uint32, false, &mut element));
    assert_eq!(element, [0, 0, 0, 1]);
    assert!(!contact.take(&mut reported, Scalar::Uint32, false, &mut element), "it is no news");
}

static MESSAGE: MessageTable = MessageTable {
    start: &[0x42],
    length: 2,
    bytes_max: 3,
    fields: &[MessageField {
        item: 0,
        byte: 0,
        value: Coding { word_bytes: 2, ..Coding::NEW },
        ..MessageField::NEW
    }],
    ..MessageTable::NEW
};

#[test]
fn bytes_of_a_port_become_messages() {
    let (_turn, clock) = clock();
    static QUEUE: RxQueue<32> = RxQueue::new();
    let mut stream: MessageStream<[u8; 64]> = MessageStream::new(&MESSAGE, &SCHEMA);
    let mut device = Device::new(&QUEUE, &mut stream, 0, &[0]);
    for byte in [0x42, 0x81, 0x02] {
        QUEUE.take(Some(byte), true, 0x7F);
    }
    let mut seen = Vec::new();
    let mut cycle = |device: &mut Device<'_, 32>| {
        let until = Instant::now() + Duration::from_millis(1);
        let sink = |index: usize, outcome, value: &mut [u8]| {
            seen.push((index, outcome, value.to_vec()));
            clock.advance(Duration::from_millis(1));
        };
        block_on(device.cycle(until, sink));
    };
    cycle(&mut device);
    QUEUE.take(None, false, 0xFF);
    cycle(&mut device);
    assert_eq!(seen, [(0, Outcome::Fresh, vec![1, 2]), (0, Outcome::BusError, vec![])]);
    assert!(!device.is_forgotten(10));
    clock.advance(Duration::from_secs(6));
    assert!(device.is_forgotten(10) && !device.is_forgotten(10));
}

#[test]
fn a_message_is_queued_whole_or_not_at_all() {
    let _clock = clock();
    let board = board();
    let queue: TxQueue<5> = TxQueue::new();
    let how =
        Compose { start: &[0x55], value: Coding { word_bytes: 2, ..Coding::NEW }, ..Compose::NEW };
    let send = || serial::send(&queue, &how, &SCHEMA, 1, &[1, 2], &mut [0; 8], &board);
    send();
    assert_eq!(queue.len(), 3);
    send();
    assert_eq!(queue.len(), 3);
    let faults = faults(&board, 1);
    assert_eq!(faults, 1);
}

#[test]
fn a_queue_takes_what_there_is_room_for() {
    let ring: TxQueue<4> = TxQueue::new();
    assert!(queue(&ring, &[1, 2, 3]));
    assert_eq!(ring.try_read(&mut [0; 2]), Ok(2));
    // Around the end of the ring.
    assert!(queue(&ring, &[4, 5, 6]) && !queue(&ring, &[7]));
}

/// A port whose queue takes some bytes at a time.
#[derive(Default)]
struct Serial {
    taken: RefCell<Vec<u8>>,
    given: VecDeque<u8>,
}

impl ErrorType for Serial {
    type Error = Infallible;
}

impl Read for Serial {
    async fn read(&mut self, bytes: &mut [u8]) -> Result<usize, Infallible> {
        let Some(byte) = self.given.pop_front() else { return std::future::pending().await };
        bytes[0] = byte;
        Ok(1)
    }
}

impl Write for Serial {
    async fn write(&mut self, bytes: &[u8]) -> Result<usize, Infallible> {
        let size = bytes.len().min(2);
        self.taken.borrow_mut().extend(&bytes[..size]);
        Ok(size)
    }

    async fn flush(&mut self) -> Result<(), Infallible> {
        Ok(())
    }
}

#[test]
fn the_link_never_waits() {
    let mut port = Port::new(Serial { given: VecDeque::from([8, 9]), ..Serial::default() }, 300);
    assert!(port.is_open() && port.is_empty() && port.room() == 300);
    let mut bytes = [0; 4];
    assert_eq!((port.read(&mut bytes), port.read(&mut bytes), port.read(&mut bytes)), (1, 1, 0));
    assert_eq!(port.write(&[1, 2, 3, 4, 5]), 5);
}

//! What has no counterpart in C, or a different one: the watch over tasks, the setup of a serial
//! device, a store with its filter, too little memory.
#![allow(clippy::unwrap_used, clippy::panic, clippy::indexing_slicing, reason = "a test may panic")]

use sense_rt::{
    Channel, Checksum, Chip, ChipTable, Coding, Command, Decoder, Direction, Filter, FilterTable,
    Health, Host, InitStep, Item, MessageStart, Number, Outcome, Record, Reporter, ReporterConfig,
    Requests, Scalar, Schema, Status, Step, Store, Turn, Watch, encode_health_request,
    encode_hello_request,
};

static SCHEMA: Schema = Schema {
    items: &[Item::sensor(17, Scalar::Uint16, 1), Item::actuator(33, Scalar::Int16, 1)],
    hash: 1,
    stamp: false,
    checksum: Checksum::None,
};

#[test]
fn a_task_that_hangs_is_found() {
    let watch = Watch::new(&[10, 500]);
    assert_eq!(watch.hanging(1010), None);
    assert_eq!(watch.hanging(1011), Some(0));
    watch.beat(0, 1500);
    assert_eq!(watch.hanging(1500), None);
    assert_eq!(watch.hanging(1501), Some(1));
    // A beat that came during the call, and a clock that has wrapped.
    watch.beat(1, 1600);
    watch.beat(0, 1600);
    assert_eq!(watch.hanging(1599), None);
    watch.beat(0, u32::MAX);
    watch.beat(1, u32::MAX);
    assert_eq!(watch.hanging(900), None);
    assert_eq!(watch.hanging(1010), Some(0));
}

#[test]
fn a_serial_device_is_set_up_with_its_pauses() {
    const INIT: &[InitStep] = &[
        InitStep { bytes: b"a", pause_ms: 0 },
        InitStep { bytes: b"b", pause_ms: 20 },
        InitStep { bytes: b"c", pause_ms: 0 },
    ];
    let mut start = MessageStart::NEW;
    let sent = |start: &mut MessageStart, now_ms: u32| -> Vec<u8> {
        let mut all = Vec::new();
        while let Some(step) = start.next(INIT, now_ms) {
            all.extend(step.bytes);
        }
        all
    };
    // The clock wraps within the pause.
    let now_ms = u32::MAX - 5;
    assert_eq!(sent(&mut start, now_ms), b"ab");
    assert_eq!(sent(&mut start, now_ms.wrapping_add(20)), b"");
    assert_eq!(sent(&mut start, now_ms.wrapping_add(21)), b"c");
    assert_eq!(sent(&mut start, now_ms.wrapping_add(5000)), b"");
}

#[test]
fn what_a_filter_keeps_back_is_a_measurement_all_the_same() {
    static TABLE: FilterTable =
        FilterTable { change: Some(Number::unsigned(5)), ..FilterTable::NEW };
    const BYTES: usize = FilterTable { change: Some(Number::unsigned(5)), ..FilterTable::NEW }
        .bytes(&Item::sensor(17, Scalar::Uint16, 1));
    let mut filter = Filter::<[u8; BYTES]>::new(&TABLE);
    let mut store = Store::<[u8; 4]>::new(&SCHEMA);
    let mut health = Health::<[Record; 2]>::new(&[100]);
    let mut record = |value: u16, now_ms| {
        let mut value = value.to_be_bytes();
        let outcome = Outcome::Fresh;
        store.record(&mut health, Some(&mut filter), 0, outcome, &mut value, now_ms);
        let reported = store.get(0).unwrap().to_vec();
        let is_due = store.has_due(0);
        store.forget(0);
        (reported, is_due, health.row(0, now_ms).status, health.row(0, now_ms).age_ms)
    };
    assert_eq!(record(300, 0), (vec![1, 44], true, Status::Good, 0));
    assert_eq!(record(302, 1000), (vec![1, 44], false, Status::Good, 0));
    assert_eq!(record(305, 2000), (vec![1, 49], true, Status::Good, 0));
}

#[test]
fn a_transfer_whose_end_nobody_told_is_lost() {
    static COMMANDS: [Command; 1] = [Command {
        prefix: &[7],
        item: 1,
        value: Coding { word_bytes: 2, ..Coding::NEW },
        ..Command::NEW
    }];
    static TABLE: ChipTable = ChipTable {
        init: &[InitStep { bytes: &[1, 2], pause_ms: 0 }],
        commands: &COMMANDS,
        cycle_ms: 10,
        ..ChipTable::NEW
    };
    let mut chip = Chip::<[u8; 64]>::new(&TABLE, &SCHEMA);
    let none = &mut |_: usize, _: Outcome, _: &mut [u8]| panic!("it has no readings");
    assert_eq!(chip.write(&COMMANDS[0], &[0, 5]).err(), Some(Outcome::Nothing));
    assert_eq!(chip.next(0), Step::Write(&[1, 2]));
    // Called again without reporting the outcome: it starts over.
    assert_eq!(chip.next(3), Step::Write(&[1, 2]));
    chip.done(Outcome::Fresh, none);
    assert_eq!(chip.next(3), Step::Wait(10));
    assert_eq!(chip.write(&COMMANDS[0], &[0, 5]), Ok(Step::Write(&[7, 0, 5])));
    chip.done(Outcome::NotAcknowledged, none);
    assert!(!chip.is_running() && chip.fault() == Outcome::NotAcknowledged);
    // At once, not a cycle later.
    assert_eq!(chip.next(4), Step::Write(&[1, 2]));
    chip.done(Outcome::Fresh, none);
    assert_eq!(chip.next(4), Step::Wait(10));
    assert_eq!((chip.counts().starts, chip.counts().written), (2, 0));
}

#[test]
fn a_pause_is_counted_from_the_end_of_the_transfer_before_it() {
    static TABLE: ChipTable = ChipTable {
        init: &[
            InitStep { bytes: &[1], pause_ms: 0 },
            InitStep { bytes: &[2], pause_ms: 10 },
            InitStep { bytes: &[3], pause_ms: 0 },
        ],
        cycle_ms: 10,
        ..ChipTable::NEW
    };
    let mut chip = Chip::<[u8; 64]>::new(&TABLE, &SCHEMA);
    let none = &mut |_: usize, _: Outcome, _: &mut [u8]| panic!("it has no readings");
    assert_eq!(chip.next(0), Step::Write(&[1]));
    chip.done(Outcome::Fresh, none);
    assert_eq!(chip.next(3), Step::Write(&[2]));
    chip.done(Outcome::Fresh, none);
    assert_eq!(chip.next(6), Step::Wait(11));
    assert_eq!(chip.next(16), Step::Wait(1));
    assert_eq!(chip.next(17), Step::Write(&[3]));
}

/// Each command changes only its own bits of a register, whatever the others have written; a new
/// start changes nothing.
#[test]
fn commands_share_a_register() {
    static SCHEMA: Schema = Schema {
        items: &[Item::actuator(1, Scalar::Bool, 1), Item::actuator(2, Scalar::Uint8, 1)],
        hash: 0,
        stamp: false,
        checksum: Checksum::None,
    };
    const BIT: Coding = Coding { word_bytes: 1, low: 3, bits: 1, ..Coding::NEW };
    const REST: Coding = Coding { word_bytes: 1, low: 4, bits: 2, ..Coding::NEW };
    static COMMANDS: [Command; 2] = [
        Command { prefix: &[0x15], item: 0, value: BIT, own: &[0x08], kept: 1 },
        Command { prefix: &[0x15], item: 1, value: REST, own: &[0x30], kept: 1 },
    ];
    static TABLE: ChipTable =
        ChipTable { commands: &COMMANDS, kept: &[0xEE, 0x81], cycle_ms: 10, ..ChipTable::NEW };
    let mut chip = Chip::<[u8; 64]>::new(&TABLE, &SCHEMA);
    let none = &mut |_: usize, _: Outcome, _: &mut [u8]| panic!("it has no readings");
    let steps = [(0, 1, 0x89), (1, 3, 0xB9), (0, 0, 0xB1), (1, 1, 0x91), (0, 1, 0x99)];
    for (at, (command, value, byte)) in steps.into_iter().enumerate() {
        let _ = chip.next(at as u32);
        assert_eq!(chip.write(&COMMANDS[command], &[value]), Ok(Step::Write(&[0x15, byte])));
        // A value is remembered even if its write failed.
        chip.done(if at == 2 { Outcome::TimedOut } else { Outcome::Fresh }, none);
    }
}

/// A channel that accepts everything, and a board without outputs.
struct Line(Vec<u8>, Vec<u8>);

impl Channel for Line {
    fn is_open(&mut self) -> bool {
        true
    }

    fn read(&mut self, bytes: &mut [u8]) -> usize {
        let size = bytes.len().min(self.0.len());
        bytes[..size].copy_from_slice(&self.0[..size]);
        self.0.drain(..size);
        size
    }

    fn room(&mut self) -> usize {
        64
    }

    fn is_empty(&mut self) -> bool {
        true
    }

    fn write(&mut self, bytes: &[u8]) -> usize {
        self.1.extend(bytes);
        bytes.len()
    }
}

struct Board(Store<[u8; 4]>, Health<[Record; 2]>, usize);

impl Host for Board {
    fn with(&mut self, task: &mut dyn FnMut(&mut Store, &mut Health)) {
        task(&mut self.0, &mut self.1);
    }

    fn apply(&mut self, _: usize, _: &[u8]) {
        self.2 += 1;
    }
}

#[test]
fn with_too_little_memory_nothing_is_said_and_nothing_breaks() {
    let config = ReporterConfig { schema: &SCHEMA, cycle_ms: 10, silence_ms: 0 };
    let mut board = Board(Store::new(&SCHEMA), Health::new(&[]), 0);
    board.0.put(0, &[1, 2]);
    let mut line = Line(b"3:!\x00\x05,".repeat(3), Vec::new());
    let mut small = Reporter::<[u8; 9]>::new(config);
    small.cycle(0, &mut line, &mut board);
    assert!(line.0.is_empty() && line.1.is_empty() && board.2 == 0);
    line.0 = b"3:!\x00\x05,".repeat(3);
    let mut enough = Reporter::<[u8; SCHEMA.reporter_bytes()]>::new(config);
    enough.cycle(0, &mut line, &mut board);
    assert!(line.1.starts_with(b"5:\0") && board.2 == 3);
}

/// A host masks interrupts while it holds the store, and a port loses characters if that takes as
/// long as one of them; so a report takes the values out one at a time.
#[test]
fn a_host_has_the_store_for_one_value_at_a_time() {
    const ITEMS: &[Item] = &[
        Item::sensor(17, Scalar::Uint16, 1),
        Item::sensor(18, Scalar::Uint16, 1),
        Item::sensor(19, Scalar::Uint16, 1),
    ];
    static THREE: Schema = Schema { items: ITEMS, hash: 1, stamp: false, checksum: Checksum::None };
    struct Locked(Store<[u8; 6]>, Health<[Record; 3]>, usize);
    impl Host for Locked {
        fn with(&mut self, task: &mut dyn FnMut(&mut Store, &mut Health)) {
            let due = |store: &Store| (0..3).filter(|index| store.has_due(*index)).count();
            let before = due(&self.0);
            task(&mut self.0, &mut self.1);
            self.2 = self.2.max(before - due(&self.0));
        }

        fn apply(&mut self, _: usize, _: &[u8]) {}
    }
    let mut board = Locked(Store::new(&THREE), Health::new(&[]), 0);
    for index in 0..3 {
        board.0.put(index, &[index as u8, 7]);
    }
    let config = ReporterConfig { schema: &THREE, cycle_ms: 10, silence_ms: 0 };
    let mut line = Line(Vec::new(), Vec::new());
    let mut reporter = Reporter::<[u8; THREE.reporter_bytes()]>::new(config);
    for cycle in 0..3 {
        reporter.cycle(cycle * 10_000, &mut line, &mut board);
    }
    let report: &[u8] = b"9:\x11\x00\x07\x12\x01\x07\x13\x02\x07,";
    assert!(line.1.ends_with(report), "{:?}", line.1);
    assert_eq!(board.2, 1);
}

/// Sensors only: streams of pieces of requests, and of bytes that only look like one.
#[test]
fn requests_are_what_a_decoder_finds() {
    const fn schema(checksum: Checksum) -> Schema {
        const ITEMS: &[Item] = &[Item::sensor(17, Scalar::Uint16, 1)];
        Schema { items: ITEMS, hash: 1, stamp: false, checksum }
    }
    static SCHEMAS: [Schema; 3] =
        [schema(Checksum::None), schema(Checksum::Crc16), schema(Checksum::Crc32)];
    for schema in &SCHEMAS {
        let mut pieces =
            vec![b"4".to_vec(), b"5:".to_vec(), b"6:".to_vec(), b":\0\x01".to_vec(), b",".to_vec()];
        for encode in [encode_hello_request, encode_health_request] {
            let mut frame = [0; 10];
            let size = encode(schema, &mut frame);
            pieces.push(frame[..size].to_vec());
            pieces.push(frame[..size - 1].to_vec());
            pieces.push(frame[1..size].to_vec());
        }
        let mut requests = Requests::new(schema);
        let mut decoder: Decoder<[u8; 10]> = Decoder::new(schema, Direction::ToBoard);
        let mut seed = 1_u64;
        for _ in 0..20_000 {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            let piece = &pieces[(seed >> 33) as usize % pieces.len()];
            let (mut received, mut decoded) = (String::new(), String::new());
            requests.feed(piece, &mut |frame| received += &format!("{frame:?}"));
            decoder.feed(piece, &mut |frame| decoded += &format!("{frame:?}"));
            assert_eq!((&received, requests.frames()), (&decoded, decoder.frames()), "{piece:?}");
            assert!(requests.is_idle() || !decoder.is_idle());
        }
        assert!(requests.frames() > 3_000);
    }
}

/// How many values of a minute are taken, if they come so far apart by a clock that is so many thousandths fast.
fn taken(cycle_ms: u32, apart_us: u64, fast_per_mille: u64) -> usize {
    let mut turn = Turn::NEW;
    let times = (0..60_000_000 / apart_us)
        .map(|place| 300 + place * apart_us * (1000 - fast_per_mille) / 1000);
    // Just before the clock of milliseconds begins anew.
    times
        .filter(|us| turn.is_next(cycle_ms, (u32::MAX - 30_000).wrapping_add((us / 1000) as u32)))
        .count()
}

#[test]
fn of_values_that_come_at_any_rate_one_in_each_cycle_is_taken() {
    for fast_per_mille in [0, 1, 5] {
        let (same, twice) =
            (taken(100, 100_000, fast_per_mille), taken(100, 50_000, fast_per_mille));
        assert!((597..=600).contains(&same) && (597..=601).contains(&twice), "{same} {twice}");
    }
    let often = [3_000, 7_000, 30_000, 33_300].map(|apart_us| taken(100, apart_us, 0));
    assert!(often.iter().all(|count| (599..=601).contains(count)), "{often:?}");
    // Who sends more seldom is heard each time, and not twice after a silence.
    assert_eq!([taken(100, 150_000, 0), taken(100, 1_000_000, 1)], [400, 60]);
    let mut turn = Turn::NEW;
    let times = [0, 1_000, 1_040, 1_080, 1_180];
    assert_eq!(times.map(|ms| turn.is_next(100, ms)), [true, true, false, true, true]);
    // Without a cycle, all.
    assert_eq!(taken(0, 3_000, 0), 20_000);
}

//! Any bytes are decoded, in any pieces to the same events; what is decoded encodes to a frame that
//! decodes to the same, and what was dropped is counted.
#![no_main]

use libfuzzer_sys::fuzz_target;
use sensedsl_wire::{
    Checksum, Decoder, Direction, Event, Item, ScalarType, Schema, ValueType, encode_hello,
    encode_hello_request, encode_report,
};

fn schema(checksum: Checksum) -> Schema {
    let items = ScalarType::ALL.into_iter().zip(17_u8..).map(|(scalar, id)| Item {
        id,
        name: format!("S{id}"),
        direction: if id % 5 == 0 { Direction::Actuator } else { Direction::Sensor },
        value: ValueType { scalar, length: (id % 3 == 0).then_some(3) },
    });
    Schema { checksum, items: items.collect() }
}

fn decode(schema: &Schema, direction: Direction, pieces: &[&[u8]]) -> (Vec<Event>, u64, u64) {
    let mut decoder = Decoder::new(schema, direction);
    let mut events = Vec::new();
    for piece in pieces {
        decoder.feed(piece, |event| events.push(event));
    }
    (events, decoder.frames(), decoder.dropped_bytes())
}

fuzz_target!(|input: (bool, bool, u8, &[u8])| {
    let (crc, to_board, cut, bytes) = input;
    let schema = schema(if crc { Checksum::Crc16 } else { Checksum::None });
    let direction = if to_board { Direction::Actuator } else { Direction::Sensor };
    let whole = decode(&schema, direction, &[bytes]);
    let (first, second) = bytes.split_at(usize::from(cut).min(bytes.len()));
    let in_pieces = decode(&schema, direction, &[first, second]);
    // In words: a value that is no number is not equal to itself.
    assert_eq!(format!("{whole:?}"), format!("{in_pieces:?}"), "pieces make a difference");
    let (events, frames, dropped) = whole;
    assert_eq!(frames, events.len() as u64);
    assert!(dropped <= bytes.len() as u64);
    for event in events {
        let frame = match &event {
            Event::Report(values) => encode_report(&schema, direction, values).unwrap(),
            Event::Hello(_) => encode_hello(&schema),
            Event::HelloRequest => encode_hello_request(&schema),
        };
        let (again, frames, dropped) = decode(&schema, direction, &[&frame]);
        assert_eq!((frames, dropped), (1, 0), "a frame of our own is lost");
        if !matches!(event, Event::Hello(_)) {
            assert_eq!(format!("{again:?}"), format!("{:?}", [event]));
        }
    }
});

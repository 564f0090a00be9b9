//! Times this crate's decoder for `benches/decode.py`. It takes the same requests as
//! `tests/decoders/main.c`, but answers only `rust time`. The schema comes in the form that
//! `tests/decoders/decoders.h` describes.
#![expect(clippy::print_stdout, clippy::disallowed_methods, reason = "a program of a benchmark")]

use std::io::{self, BufRead as _, Read as _, Write as _};
use std::time::Instant;

use sensedsl_wire::{Checksum, Decoder, Direction, Frame, Item, ScalarType, Schema, ValueType};

fn main() -> io::Result<()> {
    let mut input = io::stdin().lock();
    let mut line = String::new();
    while input.read_line(&mut line)? > 0 {
        let sizes: Vec<usize> =
            line.split(' ').filter_map(|word| word.trim().parse().ok()).collect();
        let [repeats, schema_bytes, pieces, stream_bytes] = sizes[..] else {
            return Err(io::Error::other(line));
        };
        let mut block = |size: usize| -> io::Result<Vec<u8>> {
            let mut bytes = vec![0; size];
            input.read_exact(&mut bytes)?;
            Ok(bytes)
        };
        let schema = read_schema(&block(schema_bytes)?);
        let piece = block(4 * pieces)?;
        let piece = piece.first_chunk().map_or(0, |bytes| u32::from_ne_bytes(*bytes) as usize);
        let stream = block(stream_bytes)?;
        let (start, cpu_start_ns) = (Instant::now(), cpu_ns());
        for _ in 0..repeats {
            std::hint::black_box(decode(&schema, &stream, piece));
        }
        let cpu_ns = cpu_ns().and_then(|end| Some(u128::from(end - cpu_start_ns?)));
        println!("{}", cpu_ns.unwrap_or_else(|| start.elapsed().as_nanos()));
        io::stdout().flush()?;
        line.clear();
    }
    Ok(())
}

/// The processor time that this program has used, if Linux reports it.
fn cpu_ns() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/self/schedstat").ok()?;
    text.split(' ').next()?.parse().ok()
}

fn read_schema(bytes: &[u8]) -> Schema {
    let (flags, items) = bytes.split_first().unwrap_or((&0, &[]));
    let checksum = match flags & 9 {
        0 => Checksum::None,
        1 => Checksum::Crc16,
        _ => Checksum::Crc32,
    };
    let items = items.as_chunks::<5>().0.iter().map(|&[id, scalar, direction, high, low]| Item {
        id,
        name: String::new(),
        direction: if direction == 0 { Direction::Sensor } else { Direction::Actuator },
        value: ValueType {
            scalar: ScalarType::ALL.get(usize::from(scalar)).copied().unwrap_or(ScalarType::Uint8),
            length: Some(u16::from_be_bytes([high, low])),
        },
    });
    Schema { checksum, stamp: false, items: items.collect() }
}

/// Does as much as a user of the values: reads the first byte of each.
fn decode(schema: &Schema, stream: &[u8], piece: usize) -> u64 {
    let mut decoder = Decoder::new(schema, Direction::Sensor);
    let mut sum = 0_u64;
    for chunk in stream.chunks(if piece == 0 { stream.len().max(1) } else { piece }) {
        decoder.feed_frames(chunk, |frame| {
            if let Frame::Report(report) = frame {
                let firsts = report.values().filter_map(|value| value.bytes.first().copied());
                sum ^= firsts.fold(0, |sum, byte| sum ^ u64::from(byte));
            }
        });
    }
    sum ^ decoder.frames()
}

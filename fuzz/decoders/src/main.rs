//! The fuzzer's entry for the three decoders: what crate `wire`, `crates/firmware-c/runtime` in C and
//! `crates/host-cpp/runtime` in C++ make of one stream is compared.
#![allow(clippy::disallowed_methods, reason = "what the macro of the engine makes writes files")]
#![no_main]

// The body is that of the tests; taken by path, it does not wait for the rest of the compiler.
#[allow(dead_code, reason = "the tests use more of it")]
#[path = "../../../tests/fuzz/src/decoders.rs"]
mod decoders;
#[allow(dead_code, reason = "other targets use more of it")]
#[path = "../../../tests/fuzz/src/draw.rs"]
mod draw;

use decoders::{Decoded, STREAMS, Stream, run};
use libfuzzer_sys::fuzz_target;
use sensedsl_wire::{Direction, ScalarType};

/// A decoder in another language.
type Other = fn(&Stream) -> Decoded;

#[repr(C)]
struct CItem {
    id: u8,
    scalar: u8,
    to_board: u8,
    count: u16,
}

#[repr(C)]
struct CStream {
    items: *const CItem,
    items_count: usize,
    checksum: u8,
    stamp: u8,
    to_board: u8,
    bytes: *const u8,
    size: usize,
    cuts: *const usize,
    cuts_count: usize,
}

#[repr(C)]
struct CDecoded {
    log: *mut u8,
    log_size: usize,
    log_bytes_max: usize,
    frames: u64,
    dropped_bytes: u64,
}

unsafe extern "C" {
    fn sense_decode_c(stream: *const CStream, decoded: *mut CDecoded);
    fn sense_decode_cpp(stream: *const CStream, decoded: *mut CDecoded);
    fn atexit(last: extern "C" fn()) -> i32;
}

fn foreign(
    stream: &Stream,
    decode: unsafe extern "C" fn(*const CStream, *mut CDecoded),
) -> Decoded {
    let to_board = |direction: Direction| u8::from(direction == Direction::Actuator);
    let scalar = |of: ScalarType| ScalarType::ALL.iter().position(|one| *one == of);
    let items: Vec<CItem> = stream
        .schema
        .items
        .iter()
        .map(|item| CItem {
            id: item.id,
            scalar: scalar(item.value.scalar).unwrap_or_default() as u8,
            to_board: to_board(item.direction),
            count: item.value.count() as u16,
        })
        .collect();
    // What is logged of a frame is no longer than the frame.
    let mut log = vec![0; stream.bytes.len()];
    let given = CStream {
        items: items.as_ptr(),
        items_count: items.len(),
        checksum: (stream.schema.checksum.bits() / 8) as u8,
        stamp: u8::from(stream.schema.stamp),
        to_board: to_board(stream.direction),
        bytes: stream.bytes.as_ptr(),
        size: stream.bytes.len(),
        cuts: stream.cuts.as_ptr(),
        cuts_count: stream.cuts.len(),
    };
    let mut decoded = CDecoded {
        log: log.as_mut_ptr(),
        log_size: 0,
        log_bytes_max: log.len(),
        frames: 0,
        dropped_bytes: 0,
    };
    // SAFETY: all pointers are to vectors that live until the end of this function, with their
    // lengths beside them; the callee keeps none of them.
    unsafe { decode(&given, &mut decoded) };
    log.truncate(decoded.log_size);
    Decoded { log, frames: decoded.frames, dropped_bytes: decoded.dropped_bytes }
}

static STREAMS_RUN: std::sync::atomic::AtomicU64 = std::sync::atomic::AtomicU64::new(0);

extern "C" fn record() {
    let streams = STREAMS_RUN.load(std::sync::atomic::Ordering::Relaxed);
    eprintln!("stages: {streams} streams, each decoded in Rust, C and C++");
}

fuzz_target!(|bytes: &[u8]| {
    if STREAMS_RUN.fetch_add(STREAMS, std::sync::atomic::Ordering::Relaxed) == 0 {
        // SAFETY: `record` takes nothing, gives nothing and does not unwind.
        unsafe { atexit(record) };
    }
    let others: [(&str, Other); 2] = [
        ("C", |stream| foreign(stream, sense_decode_c)),
        ("C++", |stream| foreign(stream, sense_decode_cpp)),
    ];
    run(bytes, &others);
});

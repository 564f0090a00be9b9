//! The sources of this crate, for a generator that copies them into a project.

/// Path and text.
macro_rules! files {
    ($($path:literal,)*) => {
        &[$(($path, include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/src/", $path))),)*]
    };
}

/// All files below `src`: path and text.
pub const SOURCES: &[(&str, &str)] = files![
    "bits.rs",
    "bytes.rs",
    "capture.rs",
    "checksum.rs",
    "chip/ask.rs",
    "chip/memory.rs",
    "chip/mod.rs",
    "chip/say.rs",
    "chip/table.rs",
    "chip/time.rs",
    "coding.rs",
    "compose.rs",
    "contact.rs",
    "convert.rs",
    "count.rs",
    "decode.rs",
    "drive.rs",
    "elements.rs",
    "encode.rs",
    "exchange.rs",
    "filter.rs",
    "filter/real.rs",
    "filter/smooth.rs",
    "formula/bosch.rs",
    "formula/hx711.rs",
    "formula/mod.rs",
    "formula/ntc.rs",
    "formula/tsl2561.rs",
    "health.rs",
    "lamps.rs",
    "letters.rs",
    "lib.rs",
    "listener.rs",
    "message.rs",
    "message/start.rs",
    "message/table.rs",
    "onewire.rs",
    "outcome.rs",
    "parse.rs",
    "pulse_width.rs",
    "reporter.rs",
    "requests.rs",
    "scalar.rs",
    "schema.rs",
    "silence.rs",
    "stepper.rs",
    "store.rs",
    "train.rs",
    "uses.rs",
    "watch.rs",
];

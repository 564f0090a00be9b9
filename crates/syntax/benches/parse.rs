//! How fast a file is parsed and laid out: the paper's example and one with a thousand devices.

use divan::{Bencher, counter::BytesCount};
use std::fmt::Write as _;

const FIG2: &str = include_str!("../../../examples/fig2.sense");

fn main() {
    divan::main();
}

/// A board with a thousand devices of six properties each.
fn thousand_devices() -> String {
    let mut text = String::from("board Large {\n");
    for number in 0..1_000 {
        write!(
            text,
            "    // device {number}\n    sensor S{number} returns uint16[4] {{\n        id = {number};\n        \
             type = i2c; // ranging\n        address = 0xE6;\n        delay = 60 ms;\n        \
             trigger = [0x00, 0x51];\n        label = \"number {number}\";\n    }}\n\n"
        )
        .unwrap_or_default();
    }
    text.push_str("}\n");
    text
}

fn text(name: &str) -> String {
    if name == "fig2" { FIG2.to_owned() } else { thousand_devices() }
}

#[divan::bench(args = ["fig2", "thousand_devices"])]
fn parse(bencher: Bencher<'_, '_>, name: &str) {
    let text = text(name);
    bencher.counter(BytesCount::of_str(&text)).bench(|| sensedsl_syntax::parse(&text));
}

#[divan::bench(args = ["fig2", "thousand_devices"])]
fn format(bencher: Bencher<'_, '_>, name: &str) {
    let text = text(name);
    bencher.counter(BytesCount::of_str(&text)).bench(|| sensedsl_syntax::format(&text));
}

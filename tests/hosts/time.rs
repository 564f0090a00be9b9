//! Times the decoder of a generated crate for `benches/hosts.py`, on a stream of Fig. 2's frames.
//!
//! Arguments: the stream's file, and bytes a piece. Prints the nanoseconds of processor time, the messages and a sum of
//! their values, which the script compares.

use sense_fig2::{Event, Link, STM32F4DiscoveryBoard, STM32F4DiscoveryBoardMessage as Message};

/// The processor time that this program has used, as Linux reports it.
fn cpu_ns() -> u64 {
    let text = std::fs::read_to_string("/proc/self/schedstat").unwrap();
    text.split(' ').next().unwrap().parse().unwrap()
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let stream = std::fs::read(&arguments[1]).unwrap();
    let piece = arguments[2].parse().unwrap();
    let start = cpu_ns();
    let mut link = Link::<STM32F4DiscoveryBoard>::recording();
    let (mut messages, mut sum) = (0_u64, 0_u64);
    for bytes in stream.chunks(piece) {
        link.feed(bytes, |event| {
            if let Event::Message(message, _) = event {
                messages += 1;
                sum += match message {
                    Message::IRFront(one) => u64::from(one.raw),
                    Message::IRFrontRight(one) => u64::from(one.raw),
                    Message::USRear(one) => u64::from(one.raw),
                    Message::WheelEncoder(one) => u64::from(one.raw),
                };
            }
        });
    }
    println!("{} {messages} {sum}", cpu_ns() - start);
}

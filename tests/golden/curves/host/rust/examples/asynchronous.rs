//! Prints what Rover says, as a task: `cargo run --example asynchronous -- DEVICE`. Generated: copy it to
//! start a program of your own.
//!
//! The executor is the smallest there can be; any other one does as well.

use std::future::Future;
use std::io::Write as _;
use std::pin::pin;
use std::sync::Arc;
use std::task::{Context, Poll, Wake, Waker};
use std::thread::Thread;

use sense_curves::{Rover, Error};

async fn print(path: &str) -> Result<(), Error> {
    let mut stream = Rover::open(path)?.into_stream();
    while let Some(received) = stream.next().await {
        // Whoever reads this may have enough.
        if writeln!(std::io::stdout(), "{}", received?.message).is_err() {
            break;
        }
    }
    Ok(())
}

struct Unpark(Thread);

impl Wake for Unpark {
    fn wake(self: Arc<Self>) {
        self.0.unpark();
    }
}

fn block_on<T>(future: impl Future<Output = T>) -> T {
    let waker = Waker::from(Arc::new(Unpark(std::thread::current())));
    let mut future = pin!(future);
    loop {
        if let Poll::Ready(value) = future.as_mut().poll(&mut Context::from_waker(&waker)) {
            return value;
        }
        std::thread::park();
    }
}

fn main() {
    let Some(path) = std::env::args().nth(1) else {
        eprintln!("which device? for example /dev/ttyACM0");
        std::process::exit(2);
    };
    if let Err(error) = block_on(print(&path)) {
        eprintln!("{error}");
        std::process::exit(1);
    }
}

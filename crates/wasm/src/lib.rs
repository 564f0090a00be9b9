//! The WebAssembly module for pages and Node: `sensedsl.mjs` calls it. `cargo xtask web` builds it.
//!
//! Numbers go in and out, texts through one buffer. A call is: [`reserve`] as many bytes as the request
//! has, write them where it says, [`answer`], read as many bytes as that says from [`buffer`].
//!
//! This crate has lints of its own: names that are exported count as unsafe, which is forbidden
//! everywhere else. It has no unsafe block.

use std::cell::RefCell;

thread_local! {
    /// The request, then its answer.
    static BUFFER: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
}

/// Makes room for a request of so many bytes, and says where.
#[unsafe(no_mangle)]
pub extern "C" fn reserve(length: usize) -> *const u8 {
    BUFFER.replace(vec![0; length]);
    buffer()
}

/// Answers the request in the buffer; the number of bytes of the answer, which is there now.
#[unsafe(no_mangle)]
pub extern "C" fn answer() -> usize {
    let request = BUFFER.take();
    let answer = sensedsl_web::ask(&String::from_utf8_lossy(&request)).into_bytes();
    let length = answer.len();
    BUFFER.replace(answer);
    length
}

/// Where the buffer is.
#[unsafe(no_mangle)]
pub extern "C" fn buffer() -> *const u8 {
    BUFFER.with_borrow(Vec::as_ptr)
}

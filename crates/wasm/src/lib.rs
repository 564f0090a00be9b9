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
    kept(sensedsl_web::ask(&String::from_utf8_lossy(&request)))
}

thread_local! {
    /// The language server.
    static EDITOR: RefCell<sensedsl_web::Editor> = RefCell::default();
}

/// Gives the message in the buffer to the language server; the number of bytes of its messages, which are there now.
#[unsafe(no_mangle)]
pub extern "C" fn message() -> usize {
    let message = BUFFER.take();
    let text = String::from_utf8_lossy(&message);
    kept(EDITOR.with_borrow_mut(|editor| editor.message(&text)))
}

/// Gives the language server time to look for wirings; the number of bytes of its messages, which are there now.
#[unsafe(no_mangle)]
pub extern "C" fn settle() -> usize {
    kept(EDITOR.with_borrow_mut(sensedsl_web::Editor::settle))
}

thread_local! {
    /// Everything else, and the board that runs or is connected.
    static STUDIO: RefCell<sensedsl_web::Studio> = RefCell::default();
}

/// Answers the call in the buffer; the number of bytes of the answer, which is there now.
#[unsafe(no_mangle)]
pub extern "C" fn call() -> usize {
    let call = BUFFER.take();
    let text = String::from_utf8_lossy(&call);
    kept(STUDIO.with_borrow_mut(|studio| studio.call(&text)))
}

/// Gives the bytes in the buffer, which a board has sent, to its host; the number of bytes of what that has seen, which is
/// there now.
#[unsafe(no_mangle)]
pub extern "C" fn feed(now_ms: f64) -> usize {
    let bytes = BUFFER.take();
    kept(STUDIO.with_borrow_mut(|studio| studio.feed(&bytes, now_ms)))
}

/// The number of bytes that a board must get now; they are in the buffer.
#[unsafe(no_mangle)]
pub extern "C" fn to_send(now_ms: f64) -> usize {
    kept_bytes(STUDIO.with_borrow_mut(|studio| studio.due(now_ms)))
}

fn kept(text: String) -> usize {
    kept_bytes(text.into_bytes())
}

fn kept_bytes(bytes: Vec<u8>) -> usize {
    let length = bytes.len();
    BUFFER.replace(bytes);
    length
}

/// Where the buffer is.
#[unsafe(no_mangle)]
pub extern "C" fn buffer() -> *const u8 {
    BUFFER.with_borrow(Vec::as_ptr)
}

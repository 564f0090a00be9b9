//! A board in a thread, for programs with an executor: any, because nothing but `std` is needed here.
//!
//! No portable way lets an executor poll a serial port, so a thread blocks on it and wakes the task: one wake-up a read,
//! which is cheap at the speed of a serial line.

use std::collections::VecDeque;
use std::future::poll_fn;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::task::{Context, Poll, Waker};
use std::thread::JoinHandle;
use std::time::Duration;

use super::board::Board;
use super::message::AnyMessage;
use super::outcome::{Error, Received};
use super::wire::Schema;

/// How long a command waits at most.
const STEP: Duration = Duration::from_millis(5);
/// The most messages that wait; older ones are dropped when nobody takes them.
const WAITING_MAX: usize = 65_536;

struct Shared<S: Schema> {
    messages: VecDeque<Received<S::Message>>,
    commands: Vec<S::Message>,
    end: Option<Error>,
    is_over: bool,
    is_dropped: bool,
    waker: Option<Waker>,
}

/// The messages of a board that a thread reads.
pub struct Stream<S: Schema> {
    shared: Arc<Mutex<Shared<S>>>,
    thread: Option<JoinHandle<()>>,
}

fn locked<S: Schema>(shared: &Mutex<Shared<S>>) -> MutexGuard<'_, Shared<S>> {
    shared.lock().unwrap_or_else(PoisonError::into_inner)
}

impl<S: Schema> Board<S> {
    /// Hands the board to a thread of its own.
    #[must_use]
    pub fn into_stream(self) -> Stream<S> {
        let shared = Arc::new(Mutex::new(Shared {
            messages: VecDeque::new(),
            commands: Vec::new(),
            end: None,
            is_over: false,
            is_dropped: false,
            waker: None,
        }));
        let thread = std::thread::spawn({
            let shared = Arc::clone(&shared);
            move || serve(self, &shared)
        });
        Stream { shared, thread: Some(thread) }
    }
}

fn serve<S: Schema>(mut board: Board<S>, shared: &Mutex<Shared<S>>) {
    loop {
        let commands = {
            let mut shared = locked(shared);
            if shared.is_dropped {
                return;
            }
            std::mem::take(&mut shared.commands)
        };
        let sent = if commands.is_empty() { Ok(()) } else { board.send_all(&commands) };
        let next = sent.and_then(|()| board.next_within(STEP));
        let mut shared = locked(shared);
        match next {
            Ok(Some(message)) => {
                if shared.messages.len() == WAITING_MAX {
                    shared.messages.pop_front();
                }
                shared.messages.push_back(message);
            }
            Ok(None) => shared.is_over = board.is_over(),
            Err(error) => (shared.end, shared.is_over) = (Some(error), true),
        }
        if let Some(waker) = shared.waker.take() {
            waker.wake();
        }
        if shared.is_over {
            return;
        }
    }
}

impl<S: Schema> Stream<S> {
    /// The next message. None when a recording is over, and after an error.
    ///
    /// # Errors
    /// Fails as [`Board::next_within`] does.
    pub async fn next(&mut self) -> Option<Result<Received<S::Message>, Error>> {
        poll_fn(|context| self.poll_next(context)).await
    }

    /// The same for a `Stream` of another crate.
    pub fn poll_next(&mut self, context: &mut Context<'_>) -> Poll<Option<Result<Received<S::Message>, Error>>> {
        let mut shared = locked(&self.shared);
        if let Some(message) = shared.messages.pop_front() {
            return Poll::Ready(Some(Ok(message)));
        }
        if shared.is_over {
            return Poll::Ready(shared.end.take().map(Err));
        }
        shared.waker = Some(context.waker().clone());
        Poll::Pending
    }

    /// Sets an actuator; an error of sending it comes from [`Stream::next`]. Does not wait.
    ///
    /// # Errors
    /// Fails beyond limits of the design.
    pub fn send(&self, message: impl Into<S::Message>) -> Result<(), Error> {
        let message = message.into();
        if let Some(refused) = message.refused() {
            return Err(refused.into());
        }
        let mut shared = locked(&self.shared);
        // The last word on an actuator counts.
        shared.commands.retain(|earlier| earlier.facts().id != message.facts().id);
        shared.commands.push(message);
        Ok(())
    }
}

impl<S: Schema> Drop for Stream<S> {
    fn drop(&mut self) {
        locked(&self.shared).is_dropped = true;
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

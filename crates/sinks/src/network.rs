//! What sinks have in common that join a network of others: it is joined, and tried again while that fails; it is told
//! what happens, and asked for commands.

use std::time::{Duration, Instant};

use crate::command::Command;
use crate::event::{Event, Inbox, Next, Outbox, Refusals};

/// How long the sink waits for an event before it looks for commands.
const WAIT: Duration = Duration::from_millis(5);
/// How often a network that cannot be joined is tried again.
const JOIN_EVERY: Duration = Duration::from_secs(2);

/// A network, and what this program is called in it.
pub(crate) trait Network {
    /// This program's place in the network.
    type Joined;
    /// What helps when it cannot be joined.
    const HELP: &'static str;

    /// Joins it.
    fn join(&self) -> Result<Self::Joined, String>;
    /// Tells the others what happened.
    fn tell(&self, joined: &mut Self::Joined, event: &Event) -> Result<(), String>;
    /// What the others want to be set since the last call: the actuator's name, and the command or why it is none.
    fn heard(&self, joined: &mut Self::Joined) -> Vec<(String, Result<Command, String>)>;
    /// Leaves it, with goodbyes where the network has such.
    fn leave(&self, joined: Self::Joined);
}

/// Serves a network until there are no more events.
pub(crate) fn serve<N: Network>(network: &N, inbox: &Inbox, outbox: &Outbox) {
    let (mut joined, mut tried) = (None, None::<Instant>);
    let mut refusals = Refusals::default();
    loop {
        if joined.is_none() && tried.is_none_or(|tried| tried.elapsed() >= JOIN_EVERY) {
            tried = Some(Instant::now());
            match network.join() {
                Ok(made) => {
                    outbox.works();
                    joined = Some(made);
                }
                Err(why) => outbox.broken(&why, N::HELP),
            }
        }
        let next = inbox.next(WAIT);
        if matches!(next, Next::Over) {
            return joined.into_iter().for_each(|joined| network.leave(joined));
        }
        let Some(joined) = &mut joined else { continue };
        if let Next::Event(event) = next {
            match network.tell(joined, &event) {
                Ok(()) => outbox.works(),
                Err(why) => outbox.broken(&why, N::HELP),
            }
        }
        for (name, command) in network.heard(joined) {
            if let Err(why) = command.and_then(|command| outbox.set(command)) {
                refusals.tell(outbox, format!("{name} not set: {why}"));
            }
        }
        refusals.look(outbox);
    }
}

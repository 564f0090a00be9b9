//! The thread of a connection to a broker: it connects, again and again, and says what came.

use std::sync::mpsc::{Receiver, TrySendError, sync_channel};
use std::thread::JoinHandle;
use std::time::Duration;

use rumqttc::{ConnectReturnCode, Connection, ConnectionError, Event, Incoming};

/// How long a broker that is not there is left alone.
const CONNECT_EVERY: Duration = Duration::from_secs(1);
/// Messages of the broker that wait for the sink; more are lost.
const HEARD_MAX: usize = 256;
const POLL: Duration = Duration::from_millis(5);

/// What the network says.
#[derive(Debug)]
pub(super) enum Said {
    /// The broker took the connection.
    Connected,
    /// There is no connection: what is wrong, and what helps.
    Lost(String, &'static str),
    /// A message came.
    Message {
        /// Its topic.
        topic: String,
        /// What it says.
        payload: Vec<u8>,
        /// Whether it lay there before.
        is_retained: bool,
    },
}

/// The thread.
pub(super) struct Network {
    heard: Receiver<Said>,
    thread: JoinHandle<()>,
}

impl Network {
    pub(super) fn start(mut connection: Connection) -> Self {
        let (tell, heard) = sync_channel(HEARD_MAX);
        let thread = std::thread::spawn(move || {
            for event in connection.iter() {
                let said = match event {
                    Ok(Event::Incoming(Incoming::ConnAck(_))) => Said::Connected,
                    Ok(Event::Incoming(Incoming::Publish(message))) => Said::Message {
                        topic: message.topic,
                        payload: message.payload.to_vec(),
                        is_retained: message.retain,
                    },
                    Ok(_) => continue,
                    Err(error) => {
                        let (why, help) = words(&error);
                        std::thread::sleep(CONNECT_EVERY);
                        Said::Lost(why, help)
                    }
                };
                if let Err(TrySendError::Disconnected(_)) = tell.try_send(said) {
                    return;
                }
            }
        });
        Self { heard, thread }
    }

    /// What was said since the last call.
    pub(super) fn heard(&self) -> impl Iterator<Item = Said> {
        self.heard.try_iter().take(HEARD_MAX)
    }

    /// Waits for the goodbye to go out.
    pub(super) fn end(self, within: Duration) {
        let mut waited = Duration::ZERO;
        while !self.thread.is_finished() && waited < within {
            if self.heard.try_iter().any(|said| matches!(said, Said::Lost(..))) {
                return;
            }
            std::thread::sleep(POLL);
            waited += POLL;
        }
    }
}

/// What went wrong, and what helps.
fn words(error: &ConnectionError) -> (String, &'static str) {
    const AGAIN: &str = "start the broker, or name another with `broker`; trying again";
    match error {
        ConnectionError::ConnectionRefused(
            ConnectReturnCode::BadUserNamePassword | ConnectReturnCode::NotAuthorized,
        ) => ("the broker does not know the user".to_owned(), "set `user` and `password`"),
        ConnectionError::ConnectionRefused(code) => {
            (format!("the broker refuses: {code:?}"), "look at the broker's log")
        }
        ConnectionError::Io(error) => (error.to_string(), AGAIN),
        ConnectionError::NetworkTimeout | ConnectionError::FlushTimeout => {
            ("no answer".to_owned(), AGAIN)
        }
        ConnectionError::MqttState(rumqttc::StateError::Io(error)) => (error.to_string(), AGAIN),
        ConnectionError::MqttState(rumqttc::StateError::ConnectionAborted) => {
            ("the broker ended the connection".to_owned(), AGAIN)
        }
        other @ (ConnectionError::MqttState(_)
        | ConnectionError::NotConnAck(_)
        | ConnectionError::RequestsDone) => (other.to_string(), AGAIN),
    }
}

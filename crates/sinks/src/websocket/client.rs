//! One client of the WebSocket server: a thread between its connection and the hub.

use std::io;
use std::net::TcpStream;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::time::{Duration, Instant};

use sensedsl_limits::MESSAGE_BYTES_MAX;
use tungstenite::handshake::server::{ErrorResponse, Request as Head, Response};
use tungstenite::http::{HeaderValue, StatusCode};
use tungstenite::protocol::WebSocketConfig;
use tungstenite::{Error, Message, WebSocket, accept_hdr_with_config};

use super::head::{Wanted, answer, wanted};
use super::origin::is_allowed;
use super::{CLIENT_QUEUE_MAX, Request};

/// How long a client may take to say what it wants.
const GREETS_WITHIN: Duration = Duration::from_secs(3);
/// How long the thread waits for a message before it listens to the client.
const WAIT: Duration = Duration::from_millis(5);
/// Bytes that may wait in the connection; a client that has more waiting is slow.
const BUFFER_BYTES_MAX: usize = 1 << 20;
/// How often a client that says nothing is asked whether it is there.
const PING_EVERY: Duration = Duration::from_secs(20);
/// How many of a client's messages are taken before it gets its values again.
const MESSAGES_AT_ONCE: usize = 16;

/// Who may come in, and what for.
pub(crate) struct Terms {
    /// Origins of pages that may connect, besides those of this machine.
    pub(crate) origins: Vec<String>,
    /// The protocol that clients must name; none for the one of this project, which has no name, and a page.
    pub(crate) protocol: Option<&'static str>,
}

/// Serves a client until it goes.
pub(super) fn start(
    number: u64,
    stream: TcpStream,
    terms: Arc<Terms>,
    hub: SyncSender<Request>,
    alive: Arc<AtomicUsize>,
) {
    alive.fetch_add(1, Ordering::Relaxed);
    // It ends with its connection, or with its queue.
    let _ = std::thread::spawn(move || {
        let (to, messages) = sync_channel(CLIENT_QUEUE_MAX);
        if let Ok(mut socket) = greet(stream, &terms)
            && hub.send(Request::Open(number, to)).is_ok()
        {
            let served = serve(number, &mut socket, &messages, &hub);
            let is_slow = matches!(served, Err(Error::WriteBufferFull(_)));
            let _ = socket.close(None);
            let _ = socket.flush();
            let _ = hub.send(Request::Closed(number, is_slow));
        }
        alive.fetch_sub(1, Ordering::Relaxed);
    });
}

fn greet(mut stream: TcpStream, terms: &Terms) -> Result<WebSocket<TcpStream>, Error> {
    stream.set_nonblocking(false)?;
    stream.set_nodelay(true)?;
    stream.set_read_timeout(Some(GREETS_WITHIN))?;
    stream.set_write_timeout(Some(GREETS_WITHIN))?;
    let wanted = wanted(&stream, GREETS_WITHIN)?;
    if wanted != Wanted::Socket {
        let has_page = terms.protocol.is_none();
        answer(&mut stream, if has_page { wanted } else { Wanted::Other })?;
        return Err(Error::ConnectionClosed);
    }
    let config = WebSocketConfig::default()
        .read_buffer_size(8 << 10)
        .write_buffer_size(0)
        .max_write_buffer_size(BUFFER_BYTES_MAX)
        .max_message_size(Some(MESSAGE_BYTES_MAX))
        .max_frame_size(Some(MESSAGE_BYTES_MAX));
    #[expect(clippy::result_large_err, reason = "the type of an answer is the crate's")]
    let judge = |head: &Head, mut response: Response| {
        let field = |name| head.headers().get(name).map(|one| one.to_str().unwrap_or("unreadable"));
        if !is_allowed(field("origin"), field("host"), &terms.origins) {
            let why = "pages of this origin may not connect: name it in `origins`\n";
            return Err(refused(StatusCode::FORBIDDEN, why));
        }
        let Some(protocol) = terms.protocol else { return Ok(response) };
        let named = field("sec-websocket-protocol").unwrap_or_default();
        if !named.split(',').any(|one| one.trim() == protocol) {
            return Err(refused(StatusCode::BAD_REQUEST, "this server has another protocol\n"));
        }
        let protocol = HeaderValue::from_static(protocol);
        response.headers_mut().insert("sec-websocket-protocol", protocol);
        Ok(response)
    };
    let began = Instant::now();
    let socket = accept_hdr_with_config(stream, judge, Some(config));
    let socket = socket.map_err(|_| Error::ConnectionClosed)?;
    // One that sends a byte now and then is not waited for either.
    if began.elapsed() > 2 * GREETS_WITHIN {
        return Err(Error::ConnectionClosed);
    }
    socket.get_ref().set_nonblocking(true)?;
    Ok(socket)
}

fn refused(status: StatusCode, why: &str) -> ErrorResponse {
    let mut refused = ErrorResponse::new(Some(why.to_owned()));
    *refused.status_mut() = status;
    refused
}

fn serve(
    number: u64,
    socket: &mut WebSocket<TcpStream>,
    messages: &Receiver<Message>,
    hub: &SyncSender<Request>,
) -> Result<(), Error> {
    let mut pinged = Instant::now();
    loop {
        match messages.recv_timeout(WAIT) {
            Ok(message) => write(socket, message)?,
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => return Ok(()),
        }
        while let Ok(message) = messages.try_recv() {
            write(socket, message)?;
        }
        if pinged.elapsed() >= PING_EVERY {
            pinged = Instant::now();
            write(socket, Message::Ping(Vec::new().into()))?;
        }
        match socket.flush() {
            Ok(()) => {}
            Err(error) if would_block(&error) => {}
            Err(error) => return Err(error),
        }
        for _ in 0..MESSAGES_AT_ONCE {
            let request = match socket.read() {
                Ok(Message::Text(text)) => Request::Text(number, text.as_str().to_owned()),
                Ok(Message::Binary(bytes)) => Request::Binary(number, bytes.to_vec()),
                Ok(Message::Close(_)) => return Ok(()),
                Ok(Message::Ping(_) | Message::Pong(_) | Message::Frame(_)) => continue,
                Err(error) if would_block(&error) => break,
                Err(error) => return Err(error),
            };
            // The hub is slower than this client: it waits here, and its connection with it.
            if hub.send(request).is_err() {
                return Ok(());
            }
        }
    }
}

fn write(socket: &mut WebSocket<TcpStream>, message: Message) -> Result<(), Error> {
    match socket.write(message) {
        Ok(()) => Ok(()),
        Err(error) if would_block(&error) => Ok(()),
        Err(error) => Err(error),
    }
}

fn would_block(error: &Error) -> bool {
    matches!(error, Error::Io(error) if error.kind() == io::ErrorKind::WouldBlock)
}

//! Who is let in: the page that this server gave, opened with the address that was printed.

use anyhow::{Result, anyhow};
use tiny_http::Request;

use super::answer::{Answer, header};

/// Random bytes of a token.
const TOKEN_BYTES: usize = 16;

/// Knows the server's own names, and the token.
pub(super) struct Guard {
    hosts: [String; 2],
    token: String,
}

impl Guard {
    /// For a server at a port of this machine.
    ///
    /// # Errors
    /// The system has no random numbers.
    pub(super) fn new(port: u16) -> Result<Self> {
        let mut bytes = [0; TOKEN_BYTES];
        getrandom::fill(&mut bytes).map_err(|why| anyhow!("no random numbers: {why}"))?;
        let token = bytes.iter().map(|byte| format!("{byte:02x}")).collect();
        Ok(Self { hosts: ["127.0.0.1", "localhost"].map(|host| format!("{host}:{port}")), token })
    }

    /// The address for people.
    pub(super) fn url(&self) -> String {
        let [host, _] = &self.hosts;
        format!("http://{host}/?token={}", self.token)
    }

    pub(super) fn token(&self) -> &str {
        &self.token
    }

    /// Whether a request is one of the page's own: it names this server, and no other page has sent it.
    pub(super) fn admits(&self, request: &Request) -> Result<(), Answer> {
        let host = header(request, "Host").unwrap_or_default();
        // Another name that leads here is that of a web site that wants to be taken for this server.
        let Some(host) = self.hosts.iter().find(|own| own.eq_ignore_ascii_case(host)) else {
            return Err(Answer::refused(421, "unknown host name"));
        };
        let origin = header(request, "Origin");
        let is_own =
            origin.is_none_or(|origin| origin.eq_ignore_ascii_case(&format!("http://{host}")));
        let site = header(request, "Sec-Fetch-Site").unwrap_or("none");
        let is_opened = header(request, "Sec-Fetch-Mode") == Some("navigate");
        if is_own && (is_opened || matches!(site, "none" | "same-origin")) {
            Ok(())
        } else {
            Err(Answer::refused(403, "only the studio's own page may use this server"))
        }
    }

    /// Whether the page has sent its token.
    pub(super) fn has_token(&self, request: &Request) -> bool {
        header(request, "X-Sensedsl-Token").is_some_and(|token| self.is_same(token))
    }

    /// Whether a query has the token.
    pub(super) fn is_token(&self, query: &str) -> bool {
        let tokens = query.split('&').filter_map(|one| one.strip_prefix("token="));
        let mut tokens = tokens.map(|token| self.is_same(token));
        tokens.any(|is_same| is_same)
    }

    /// Compares in a time that does not tell how much of it is right.
    fn is_same(&self, token: &str) -> bool {
        let (own, other) = (self.token.as_bytes(), token.as_bytes());
        own.len() == other.len()
            && own.iter().zip(other).fold(0, |sum, (one, other)| sum | (one ^ other)) == 0
    }
}

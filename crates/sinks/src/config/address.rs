//! Addresses: a host and a port in, the same checked out.

use std::fmt;
use std::net::SocketAddr;

/// Where a program is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Address {
    /// A name or a number, without brackets.
    pub host: String,
    /// The port.
    pub port: u16,
}

impl fmt::Display for Address {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.host.contains(':') {
            write!(f, "[{}]:{}", self.host, self.port)
        } else {
            write!(f, "{}:{}", self.host, self.port)
        }
    }
}

/// What is wrong with an address.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AddressError {
    /// It has no port.
    NoPort,
    /// Its port is not one.
    Port,
    /// It has no host, or one that cannot be.
    Host,
    /// The host of an interface is not a number.
    NotANumber,
}

impl fmt::Display for AddressError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NoPort => "it has no port",
            Self::Port => "its port is not a number from 1 to 65535",
            Self::Host => "its host is not a name or a number",
            Self::NotANumber => {
                "its host must be the number of an interface, such as 127.0.0.1 or 0.0.0.0"
            }
        })
    }
}

/// Where another program is; `port` counts where the text has none.
///
/// # Errors
/// Fails if host or port are missing or cannot be one.
pub fn remote(text: &str, port: Option<u16>) -> Result<Address, AddressError> {
    let (host, after) = match text.strip_prefix('[') {
        Some(rest) => {
            let (host, after) = rest.split_once(']').ok_or(AddressError::Host)?;
            let is_number = host.parse::<std::net::Ipv6Addr>().is_ok();
            (is_number.then_some(host).ok_or(AddressError::Host)?, after.strip_prefix(':'))
        }
        None => match text.rsplit_once(':') {
            Some((host, after)) => (host, Some(after)),
            None => (text, None),
        },
    };
    let is_word = |c: char| c.is_ascii_alphanumeric() || matches!(c, '.' | '-' | '_');
    let is_host = host.chars().all(is_word) || text.starts_with('[');
    if host.is_empty() || host.len() > 253 || !is_host {
        return Err(AddressError::Host);
    }
    let port = match after {
        None => port.ok_or(AddressError::NoPort)?,
        Some(after) => after.parse().ok().filter(|port| *port != 0).ok_or(AddressError::Port)?,
    };
    Ok(Address { host: host.to_owned(), port })
}

/// Where this program listens. The port 0 leaves the choice to the system.
///
/// # Errors
/// Fails if the host is not a number, or the port is not one.
pub fn listening(text: &str) -> Result<SocketAddr, AddressError> {
    if let Ok(address) = text.parse() {
        return Ok(address);
    }
    match text.strip_suffix(":0").map_or_else(|| remote(text, None), |host| remote(host, Some(1))) {
        Ok(_) => Err(AddressError::NotANumber),
        Err(why) => Err(why),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_are_read() {
        let at = |text| remote(text, None).map(|one| one.to_string());
        assert_eq!(at("localhost:1883"), Ok("localhost:1883".to_owned()));
        assert_eq!(at("[::1]:80"), Ok("[::1]:80".to_owned()));
        assert_eq!(remote("pi.local", Some(7)).unwrap().port, 7);
        for (text, why) in [
            ("localhost", AddressError::NoPort),
            ("localhost:0", AddressError::Port),
            ("localhost:70000", AddressError::Port),
            (":1883", AddressError::Host),
            ("mqtt://host:1883", AddressError::Host),
            ("[x]:1", AddressError::Host),
            ("[::1", AddressError::Host),
            ("", AddressError::Host),
        ] {
            assert_eq!(remote(text, None), Err(why), "{text}");
        }
        assert_eq!(listening("127.0.0.1:0").unwrap().port(), 0);
        assert_eq!(listening("localhost:80"), Err(AddressError::NotANumber));
        assert_eq!(listening("localhost:0"), Err(AddressError::NotANumber));
        assert_eq!(listening("127.0.0.1"), Err(AddressError::NoPort));
    }
}

//! Which pages may connect: the origin that a browser states in, yes or no out.
//!
//! Any page that somebody opens can connect to this machine, and a browser only says where the page is from. So pages
//! of this machine may, and this server's own; others must be named, and programs that are no browser state no origin.

use std::net::IpAddr;

/// Whether a client that states this origin may connect; `asked` is the host that it has asked for.
#[must_use]
pub(super) fn is_allowed(origin: Option<&str>, asked: Option<&str>, allowed: &[String]) -> bool {
    let Some(origin) = origin else { return true };
    if allowed.iter().any(|one| one == "*" || one.eq_ignore_ascii_case(origin)) {
        return true;
    }
    let rest = origin.strip_prefix("http://").or_else(|| origin.strip_prefix("https://"));
    let Some(rest) = rest else { return false };
    let host = match rest.strip_prefix('[') {
        Some(inner) => inner.split(']').next().unwrap_or_default(),
        None => rest.split(':').next().unwrap_or_default(),
    };
    // A stranger's name may lead here as well, but not a number.
    let is_own = asked == Some(rest) && host.parse::<IpAddr>().is_ok();
    is_own || matches!(host, "localhost" | "127.0.0.1" | "::1")
}

#[cfg(test)]
mod tests {
    use super::is_allowed;

    #[test]
    fn strangers_pages_are_refused() {
        for origin in ["http://localhost:3000", "https://127.0.0.1", "http://[::1]:80"] {
            assert!(is_allowed(Some(origin), None, &[]), "{origin}");
        }
        assert!(is_allowed(None, None, &[]));
        for origin in ["null", "https://example.org", "http://localhost.example.org", "file://", ""]
        {
            assert!(!is_allowed(Some(origin), None, &[]), "{origin}");
        }
        let is_own = |host: &str| is_allowed(Some(&format!("http://{host}")), Some(host), &[]);
        assert!(is_own("192.168.1.20:8765") && is_own("[fe80::1]:8765"));
        assert!(!is_own("example.org:8765") && !is_own("192.168.1.20.example.org"));
        assert!(!is_allowed(Some("http://192.168.1.21:8765"), Some("192.168.1.20:8765"), &[]));
        let named = ["https://example.org".to_owned(), "null".to_owned()];
        assert!(
            is_allowed(Some("https://EXAMPLE.org"), None, &named)
                && is_allowed(Some("null"), None, &named)
        );
        assert!(!is_allowed(Some("https://example.org:8443"), None, &named));
        assert!(is_allowed(Some("https://any.where"), None, &["*".to_owned()]));
    }
}

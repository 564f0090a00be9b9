//! Which pages may connect: the origin that a browser states in, yes or no out.
//!
//! Any page that somebody opens can connect to this machine, and a browser only says where the page is from. So pages
//! of this machine may, others must be named, and programs that are no browser state no origin.

/// Whether a client that states this origin may connect.
#[must_use]
pub(super) fn is_allowed(origin: Option<&str>, allowed: &[String]) -> bool {
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
    matches!(host, "localhost" | "127.0.0.1" | "::1")
}

#[cfg(test)]
mod tests {
    use super::is_allowed;

    #[test]
    fn strangers_pages_are_refused() {
        for origin in ["http://localhost:3000", "https://127.0.0.1", "http://[::1]:80"] {
            assert!(is_allowed(Some(origin), &[]), "{origin}");
        }
        assert!(is_allowed(None, &[]));
        for origin in ["null", "https://example.org", "http://localhost.example.org", "file://", ""]
        {
            assert!(!is_allowed(Some(origin), &[]), "{origin}");
        }
        let named = ["https://example.org".to_owned(), "null".to_owned()];
        assert!(
            is_allowed(Some("https://EXAMPLE.org"), &named) && is_allowed(Some("null"), &named)
        );
        assert!(!is_allowed(Some("https://example.org:8443"), &named));
        assert!(is_allowed(Some("https://any.where"), &["*".to_owned()]));
    }
}

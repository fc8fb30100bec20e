//! Who may come in: this machine's own page, by the address with the token, and no page of anybody else's.

use super::http::{Asked, Reply};
use std::fmt::Write as _;

/// Bytes of a token.
const TOKEN: usize = 16;

/// Requirements that a request must meet.
#[derive(Debug)]
pub(super) struct Door {
    /// The only name that this server answers to: others may lead here by a name of theirs.
    host: String,
    token: String,
}

impl Door {
    /// Creates a door with a token that nobody can guess.
    pub(super) fn new(port: u16) -> std::io::Result<Door> {
        let mut bytes = [0; TOKEN];
        getrandom::fill(&mut bytes).map_err(std::io::Error::other)?;
        let token = bytes.iter().fold(String::new(), |mut text, b| {
            let _ = write!(text, "{b:02x}");
            text
        });
        Ok(Door {
            host: format!("127.0.0.1:{port}"),
            token,
        })
    }

    /// Returns the address of the page.
    pub(super) fn address(&self) -> String {
        format!("http://{}/{}/", self.host, self.token)
    }

    /// Returns the path after the token, or a refusal if the request is not from our page.
    pub(super) fn admit_request<'a>(&self, asked: &'a Asked) -> Result<&'a str, Reply> {
        let refused = |why| Err(Reply::refusal_reply(403, why));
        if asked.header_once("host") != Some(self.host.as_str()) {
            return refused("this server answers only to 127.0.0.1 and its port");
        }
        let own = format!("http://{}", self.host);
        let origin = asked.header_once("origin");
        let writes = asked.method != "GET";
        if (asked.has_header("origin") || writes) && origin != Some(own.as_str()) {
            return refused("requests from other pages are refused");
        }
        // "none" is an address that a person typed or clicked outside of any page.
        let site = asked.header_once("sec-fetch-site");
        if asked.has_header("sec-fetch-site") && !matches!(site, Some("same-origin" | "none")) {
            return refused("requests from other pages are refused");
        }
        if writes && asked.header_once("content-type") != Some("application/json") {
            return Err(Reply::refusal_reply(415, "requests must be JSON"));
        }
        let path = asked.path.split('?').next().unwrap_or_default();
        let inside = path.strip_prefix('/').and_then(|p| p.split_once('/'));
        match inside {
            Some((token, rest)) if same_text(token, &self.token) => Ok(rest),
            _ => refused("the address lacks the token that `ozols studio` printed"),
        }
    }
}

/// Returns true if two texts are the same. The time does not depend on how much of them is the same.
fn same_text(a: &str, b: &str) -> bool {
    let differ = a.bytes().zip(b.bytes()).fold(0, |d, (x, y)| d | (x ^ y));
    a.len() == b.len() && differ == 0
}

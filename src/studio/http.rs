//! HTTP/1.1 as far as one page on the same machine needs it: one request a connection, everything bounded.

use flate2::Compression;
use flate2::write::GzEncoder;
use std::io::{self, Read, Write};
use std::net::TcpStream;
use std::time::{Duration, Instant};

/// Most bytes of the first line and the headers, and most headers.
const HEAD: usize = 16 << 10;
const HEADERS: usize = 64;
/// Most bytes of a body: the largest file, escaped as text of JSON.
pub(super) const BODY: usize = 9 << 20;
/// So long the head of a request may take as a whole, and its body as well; so long an answer may wait for who asked.
const PATIENCE: Duration = Duration::from_secs(10);

/// A request.
#[derive(Debug)]
pub(super) struct Asked {
    pub(super) method: String,
    pub(super) path: String,
    headers: Vec<(String, String)>,
    /// The part of the body that has come; all of it once [`read_body`] has returned.
    pub(super) body: Vec<u8>,
}

impl Asked {
    /// Returns the value of a header, or `None` if the request has it never or several times, which no browser does.
    pub(super) fn header_once(&self, name: &str) -> Option<&str> {
        let mut all = self.headers.iter().filter(|(n, _)| n == name);
        let first = all.next().map(|(_, v)| v.as_str());
        first.filter(|_| all.next().is_none())
    }

    /// Returns true if the request has a header.
    pub(super) fn has_header(&self, name: &str) -> bool {
        self.headers.iter().any(|(n, _)| n == name)
    }
}

/// A reply.
#[derive(Debug)]
pub(super) struct Reply {
    pub(super) status: u16,
    pub(super) kind: &'static str,
    pub(super) body: Vec<u8>,
    /// The name under which a browser saves it, where it is to.
    pub(super) saved_as: Option<String>,
    /// Whether the body is compressed.
    pub(super) packed: bool,
}

/// A shorter body is not compressed, since it fits in one packet.
const SHORT: usize = 1400;

impl Reply {
    pub(super) fn new(kind: &'static str, body: impl Into<Vec<u8>>) -> Reply {
        Reply {
            status: 200,
            kind,
            body: body.into(),
            saved_as: None,
            packed: false,
        }
    }

    /// Returns the reply, compressed if the client accepts that and the body is not [`SHORT`].
    pub(super) fn packed_for(mut self, asked: &Asked) -> io::Result<Reply> {
        let can = asked.header_once("accept-encoding");
        if self.body.len() > SHORT && can.is_some_and(|c| c.contains("gzip")) {
            let mut packer = GzEncoder::new(Vec::new(), Compression::fast());
            packer.write_all(&self.body)?;
            (self.body, self.packed) = (packer.finish()?, true);
        }
        Ok(self)
    }

    pub(super) fn json_reply(value: &serde_json::Value) -> Reply {
        Reply::new("application/json", value.to_string())
    }

    /// Returns the reason for a refusal, for a person.
    pub(super) fn refusal_reply(status: u16, why: &str) -> Reply {
        Reply {
            status,
            ..Reply::json_reply(&serde_json::json!({ "refused": why }))
        }
    }
}

fn refuse<T>(status: u16, why: &str) -> io::Result<Result<T, Reply>> {
    Ok(Err(Reply::refusal_reply(status, why)))
}

/// Reads the head of a request; an answer instead where it is none that is served.
pub(super) fn read_head(stream: &mut TcpStream) -> io::Result<Result<Asked, Reply>> {
    stream.set_write_timeout(Some(PATIENCE))?;
    let until = Instant::now() + PATIENCE;
    let mut bytes = Vec::new();
    let end = loop {
        if let Some(at) = bytes.windows(4).position(|w| w == b"\r\n\r\n") {
            break at + 4;
        }
        if bytes.len() > HEAD {
            return refuse(431, "the head of the request is too large");
        }
        if read_more(stream, &mut bytes, HEAD, until)? == 0 {
            return refuse(400, "the request is incomplete");
        }
    };
    let mut list = [httparse::EMPTY_HEADER; HEADERS];
    let mut parsed = httparse::Request::new(&mut list);
    let whole = parsed.parse(&bytes[..end]).is_ok_and(|s| s.is_complete());
    let (Some(method), Some(path), true) = (parsed.method, parsed.path, whole) else {
        return refuse(400, "not an HTTP/1.1 request");
    };
    let header = |h: &httparse::Header<'_>| {
        let value = std::str::from_utf8(h.value).ok()?.trim().to_owned();
        Some((h.name.to_ascii_lowercase(), value))
    };
    let Some(headers) = parsed.headers.iter().map(header).collect() else {
        return refuse(400, "a header is not text");
    };
    Ok(Ok(Asked {
        method: method.to_owned(),
        path: path.to_owned(),
        headers,
        body: bytes[end..].to_vec(),
    }))
}

/// Reads the rest of the body of a request; an answer instead where it is none that is served.
pub(super) fn read_body(
    stream: &mut TcpStream,
    asked: &mut Asked,
) -> io::Result<Result<(), Reply>> {
    let until = Instant::now() + PATIENCE;
    if asked.has_header("transfer-encoding") {
        return refuse(501, "a body needs its length");
    }
    let length = match (
        asked.has_header("content-length"),
        asked.header_once("content-length"),
    ) {
        (false, _) => Some(0),
        (true, said) => said.and_then(|l| l.parse::<usize>().ok()),
    };
    match length {
        None => return refuse(400, "the length of the body is not a number"),
        Some(l) if l > BODY => return refuse(413, "the body of the request is too large"),
        Some(l) => {
            while asked.body.len() < l {
                if read_more(stream, &mut asked.body, l, until)? == 0 {
                    return refuse(400, "the request is incomplete");
                }
            }
            asked.body.truncate(l);
        }
    }
    Ok(Ok(()))
}

/// Reads some bytes more and returns how many. It waits for them until a given time, so that a sender of one byte now and then has no
/// more time than a silent one.
fn read_more(
    stream: &mut TcpStream,
    to: &mut Vec<u8>,
    most: usize,
    until: Instant,
) -> io::Result<usize> {
    let left = until.saturating_duration_since(Instant::now());
    if left.is_zero() {
        return Err(io::ErrorKind::TimedOut.into());
    }
    stream.set_read_timeout(Some(left))?;
    let mut piece = [0; 8 << 10];
    let room = piece.len().min(most.saturating_sub(to.len()).max(1));
    let n = stream.read(&mut piece[..room])?;
    to.extend_from_slice(&piece[..n]);
    Ok(n)
}

/// What every answer says: a page of this program alone, which nobody else may show, keep or look into.
const RULES: &str = "Content-Security-Policy: default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; \
connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'\r\n\
X-Content-Type-Options: nosniff\r\nReferrer-Policy: no-referrer\r\nCache-Control: no-store\r\n\
Cross-Origin-Resource-Policy: same-origin\r\nCross-Origin-Opener-Policy: same-origin\r\nConnection: close\r\n";

/// A picture by itself may have its own style, and nothing else.
const PICTURE: &str = "Content-Security-Policy: default-src 'none'; style-src 'unsafe-inline'\r\n\
X-Content-Type-Options: nosniff\r\nReferrer-Policy: no-referrer\r\nCache-Control: max-age=3600\r\n\
Cross-Origin-Resource-Policy: same-origin\r\nConnection: close\r\n";

/// Writes the head of an answer without end, such as events.
pub(super) fn begin_stream(stream: &mut TcpStream, kind: &str) -> io::Result<()> {
    write!(
        stream,
        "HTTP/1.1 200 OK\r\nContent-Type: {kind}\r\n{RULES}\r\n"
    )?;
    stream.flush()
}

/// Writes an answer.
pub(super) fn write_reply(stream: &mut TcpStream, answer: &Reply) -> io::Result<()> {
    let rules = match answer.kind {
        "image/svg+xml" => PICTURE,
        _ => RULES,
    };
    let saved = answer.saved_as.as_ref().map_or(String::new(), |name| {
        format!("Content-Disposition: attachment; filename=\"{name}\"\r\n")
    });
    let packed = if answer.packed {
        "Content-Encoding: gzip\r\n"
    } else {
        ""
    };
    let head = format!(
        "HTTP/1.1 {} \r\nContent-Type: {}\r\nContent-Length: {}\r\n{packed}{saved}{rules}\r\n",
        answer.status,
        answer.kind,
        answer.body.len()
    );
    stream.write_all(head.as_bytes())?;
    stream.write_all(&answer.body)?;
    stream.flush()
}

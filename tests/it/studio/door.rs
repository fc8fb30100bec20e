//! The door: the token, the host, pages of others, sizes and paths.

use super::served::Served;
use crate::common::*;
use std::io::Write;
use std::net::TcpStream;

fn status(s: &Served, request: &str) -> u16 {
    s.raw(request.as_bytes()).0
}

/// A studio of the four-bar, and the empty folder that it runs in.
fn served() -> (Folder, Served) {
    let folder = Folder::new();
    let s = Served::new(&folder, &["four-bar"]);
    (folder, s)
}

#[test]
fn who_has_not_the_token_or_comes_from_elsewhere_is_refused() {
    let (_folder, s) = served();
    let (host, token) = (&s.host, &s.token);
    let get =
        |path: &str, headers: &str| status(&s, &format!("GET {path} HTTP/1.1\r\n{headers}\r\n"));
    let page = format!("/{token}/status");
    let own = format!("Host: {host}\r\n");
    assert_eq!(get(&page, &own), 200);
    assert_eq!(get(&page, &format!("{own}Origin: http://{host}\r\n")), 200);
    assert_eq!(get(&page, &format!("{own}Sec-Fetch-Site: none\r\n")), 200);
    let port = host.split(':').nth(1).unwrap();
    for headers in [
        String::new(),
        format!("Host: localhost:{port}\r\n"),
        format!("Host: evil.example:{port}\r\n"),
        "Host: 127.0.0.1\r\n".to_owned(),
        format!("{own}Host: evil.example\r\n"),
        format!("{own}Origin: http://evil.example\r\n"),
        format!("{own}Origin: null\r\n"),
        format!("{own}Origin: http://{host}\r\nOrigin: http://evil.example\r\n"),
        format!("{own}Sec-Fetch-Site: cross-site\r\n"),
        format!("{own}Sec-Fetch-Site: same-site\r\n"),
    ] {
        assert_eq!(get(&page, &headers), 403, "{headers}");
    }
    let other = format!("/{}/status", "0".repeat(32));
    for path in ["/", "/status", &other, &format!("/{}/status", &token[..31])] {
        assert_eq!(get(path, &own), 403, "{path}");
    }
    // What writes has to say where it comes from, and is JSON.
    let post = |headers: &str| {
        let head =
            format!("POST /{token}/undo HTTP/1.1\r\n{own}Content-Length: 2\r\n{headers}\r\n{{}}");
        status(&s, &head)
    };
    let json = "Content-Type: application/json\r\n";
    let own_page = format!("Origin: http://{host}");
    for (code, headers) in [
        (200, format!("{json}{own_page}\r\n")),
        (403, json.to_owned()),
        (403, format!("{json}{own_page}.evil.example\r\n")),
        (415, format!("Content-Type: text/plain\r\n{own_page}\r\n")),
    ] {
        assert_eq!(post(&headers), code, "{headers}");
    }
    let delete = format!("DELETE /{token}/ HTTP/1.1\r\n{own}{own_page}\r\n{json}\r\n");
    assert_eq!(status(&s, &delete), 405);
}

#[test]
fn requests_are_bounded() {
    let (_folder, s) = served();
    let head = s.head("POST", "edit");
    let long = format!("{head}X: {}\r\n\r\n", "x".repeat(40 << 10));
    assert_eq!(status(&s, &long), 431);
    let many: String = (0..100).map(|n| format!("X-{n}: 1\r\n")).collect();
    assert_eq!(status(&s, &format!("{head}{many}\r\n")), 400);
    for (code, more) in [
        (413, "Content-Length: 999999999\r\n\r\n"),
        (400, "Content-Length: -1\r\n\r\n"),
        (400, "Content-Length: 2\r\nContent-Length: 3\r\n\r\n{}"),
        (501, "Transfer-Encoding: chunked\r\n\r\n0\r\n\r\n"),
    ] {
        assert_eq!(status(&s, &format!("{head}{more}")), code, "{more}");
    }
    assert_eq!(status(&s, "\u{1}\r\n\r\n"), 400);
    assert_eq!(status(&s, "GET / HTTP/2.7\r\n\r\n"), 400);
    // A text as large as no file may be, within what a request may hold.
    let text = "#".repeat(5 << 20);
    let (code, told) = s.post(
        "edit",
        &json!({ "edits": [{ "do": "text", "text": text }], "revision": 1 }),
    );
    assert_eq!(code, 422, "{told}");
    for body in [
        json!([]),
        json!({ "edits": [{ "do": "format-disk" }] }),
        json!({ "edits": [], "more": 1 }),
    ] {
        assert_eq!(s.post("edit", &body).0, 422, "{body}");
    }
    assert_eq!(s.get("status").0, 200);
}

#[test]
fn no_path_leads_out_of_the_file() {
    let folder = Folder::with("secret.toml", "name = \"secret\"\n");
    let s = Served::new(&folder, &["four-bar"]);
    for path in split_words(
        "secret.toml ../secret.toml ..%2fsecret.toml picture/../../secret.toml picture/secret.svg
         export/../secret.toml //etc/passwd",
    ) {
        let (code, body) = s.get(path);
        assert_eq!(code, 404, "{path}");
        lacks(&body, "secret\"");
    }
    let names = "../out.toml|/tmp/out.toml|sub/out.toml|out.txt|.out.toml|secret.toml||.toml|a\nb.toml|c:\\out.toml";
    for name in names.split('|') {
        let (code, told) = s.post("save", &json!({ "name": name }));
        assert_eq!(code, 422, "{name}: {told}");
    }
    assert_eq!(s.post("begin", &json!({ "name": "../secret" })).0, 422);
    assert_eq!(folder.names(), ["secret.toml"]);
    s.done("save", &json!({ "name": "fine name.toml" }));
    assert!(folder.path("fine name.toml").is_file());
}

#[test]
fn every_answer_keeps_others_out() {
    let (_folder, s) = served();
    let mut stream = TcpStream::connect(&s.host).unwrap();
    let asked = format!("{}\r\n", s.head("GET", ""));
    stream.write_all(asked.as_bytes()).unwrap();
    let mut page = String::new();
    stream.read_to_string(&mut page).unwrap();
    for part in [
        "default-src 'none'; script-src 'self'; style-src 'self'",
        "frame-ancestors 'none'",
        "X-Content-Type-Options: nosniff",
        "Referrer-Policy: no-referrer",
        "Cache-Control: no-store",
        "Cross-Origin-Resource-Policy: same-origin",
    ] {
        has(&page, part);
    }
    // Nothing is run that does not come from an address of its own, and nothing comes from elsewhere.
    for part in "<script>|<style| onclick=| onload=|javascript:|http-equiv|https://".split('|') {
        lacks(&page, part);
    }
    lacks(&s.get("studio.js").1, "https://");
}

/// Who sends a byte now and then is let go as early as who sends none.
#[test]
fn a_head_that_never_ends_is_let_go() {
    let (_folder, s) = served();
    let mut stream = TcpStream::connect(&s.host).unwrap();
    stream
        .set_read_timeout(Some(Duration::from_millis(250)))
        .unwrap();
    let head = s.head("GET", "status");
    // With a byte each quarter of a second the head alone would take more than half a minute; what would follow, over an hour.
    let bytes = head.bytes().chain(std::iter::repeat(b'x'));
    let is_let_go = bytes.take(400).any(|byte| {
        let is_closed = stream.write_all(&[byte]).is_err();
        is_closed || matches!(stream.read(&mut [0; 64]), Ok(0))
    });
    assert!(is_let_go);
    assert_eq!(s.get("status").0, 200);
}

/// Connections of others take no place of the windows, however many there are, and whether they say something or not.
#[test]
fn a_crowd_at_the_door_keeps_nobody_out() {
    let (_folder, s) = served();
    let mut window = s.window();
    window.next("look");
    let other = format!(
        "GET /{}/status HTTP/1.1\r\nHost: {}\r\n",
        "0".repeat(32),
        s.host
    );
    let crowd: Vec<TcpStream> = (0..300)
        .map(|n| {
            let mut stream = TcpStream::connect(&s.host).unwrap();
            // Some are silent, some begin a request and do not end it.
            if n % 2 == 0 {
                let _ = stream.write_all(other.as_bytes());
            }
            stream
        })
        .collect();
    for _ in 0..20 {
        assert_eq!(s.get("status").0, 200);
    }
    assert_eq!(s.status()["windows"], 1, "the window that was there stays");
    s.done(
        "edit",
        &json!({ "edits": [{ "do": "set", "what": "joint", "id": "1-2", "key": "type", "value": "spherical" }], "revision": null }),
    );
    assert_eq!(window.next("look")["desk"]["saved"], false);
    s.window().next("look");
    drop(crowd);
}

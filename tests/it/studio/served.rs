//! The program, served, and a plain client of it.

use crate::common::*;
use std::io::Write;
use std::net::TcpStream;
use std::process::{Child, Command};

/// Longer than any machine takes.
const LONG: Duration = Duration::from_secs(120);

/// A studio that is served; it is ended with the value.
pub(super) struct Served {
    child: Child,
    pub(super) host: String,
    pub(super) token: String,
}

impl Drop for Served {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl Served {
    pub(super) fn new(folder: impl AsRef<Path>, args: &[&str]) -> Served {
        Served::run_by(Command::new(env!("CARGO_BIN_EXE_ozols")), folder, args)
    }

    /// The same by a command that runs the program with the arguments that follow.
    pub(super) fn run_by(mut command: Command, folder: impl AsRef<Path>, args: &[&str]) -> Served {
        let mut child = command
            .args(["studio", "--no-open", "--quiet"])
            .args(args)
            .current_dir(folder)
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let mut line = String::new();
        let mut out = BufReader::new(child.stdout.take().unwrap());
        out.read_line(&mut line).unwrap();
        let rest = line.trim().strip_prefix("http://").unwrap();
        let (host, token) = rest.strip_suffix('/').unwrap().split_once('/').unwrap();
        assert!(host.starts_with("127.0.0.1:"), "{line}");
        assert_eq!(token.len(), 32, "{line}");
        Served {
            child,
            host: host.to_owned(),
            token: token.to_owned(),
        }
    }

    /// Sends bytes as they are; the status and the body of the answer.
    pub(super) fn raw(&self, bytes: &[u8]) -> (u16, Vec<u8>) {
        let mut stream = TcpStream::connect(&self.host).unwrap();
        stream.set_read_timeout(Some(LONG)).unwrap();
        // What is refused early need not be read to its end.
        let _ = stream.write_all(bytes);
        let mut all = Vec::new();
        let _ = stream.read_to_end(&mut all);
        let text = String::from_utf8_lossy(&all);
        let status = text.split(' ').nth(1).and_then(|s| s.parse().ok());
        let body = all.windows(4).position(|w| w == b"\r\n\r\n");
        (
            status.unwrap_or(0),
            body.map_or(Vec::new(), |at| all[at + 4..].to_vec()),
        )
    }

    /// A request of the page itself.
    pub(super) fn head(&self, method: &str, path: &str) -> String {
        format!(
            "{method} /{}/{path} HTTP/1.1\r\nHost: {}\r\nOrigin: http://{}\r\nContent-Type: application/json\r\n",
            self.token, self.host, self.host
        )
    }

    pub(super) fn get(&self, path: &str) -> (u16, String) {
        let (status, body) = self.raw(format!("{}\r\n", self.head("GET", path)).as_bytes());
        (status, String::from_utf8(body).unwrap())
    }

    pub(super) fn post(&self, path: &str, body: &Value) -> (u16, Value) {
        let body = body.to_string();
        let head = format!(
            "{}Content-Length: {}\r\n\r\n{body}",
            self.head("POST", path),
            body.len()
        );
        let (status, body) = self.raw(head.as_bytes());
        (status, serde_json::from_slice(&body).unwrap_or_default())
    }

    /// A request that is done.
    pub(super) fn done(&self, path: &str, body: &Value) -> Value {
        let (status, value) = self.post(path, body);
        assert_eq!(status, 200, "{path}: {value}");
        value
    }

    pub(super) fn status(&self) -> Value {
        serde_json::from_str(&self.get("status").1).unwrap()
    }

    /// Opens a window, which hears events until it is dropped.
    pub(super) fn window(&self) -> Window {
        let mut stream = TcpStream::connect(&self.host).unwrap();
        stream.set_read_timeout(Some(LONG)).unwrap();
        let asked = format!("{}\r\n", self.head("GET", "events"));
        stream.write_all(asked.as_bytes()).unwrap();
        Window(BufReader::new(stream))
    }

    /// Waits until something is so.
    pub(super) fn until(&self, so: impl Fn(&Value) -> bool) -> Value {
        let begun = Instant::now();
        loop {
            let status = self.status();
            if so(&status) {
                return status;
            }
            assert!(begun.elapsed() < LONG, "never: {status}");
            std::thread::sleep(Duration::from_millis(50));
        }
    }

    /// The number of its process.
    pub(super) fn process(&self) -> String {
        self.child.id().to_string()
    }

    /// Whether it still runs.
    pub(super) fn runs(&mut self) -> bool {
        self.child.try_wait().unwrap().is_none()
    }

    /// Ends it with a signal, or waits for it to end; the exit code.
    pub(super) fn end(&mut self, signal: Option<&str>) -> Option<i32> {
        if let Some(signal) = signal {
            let id = self.process();
            let sent = Command::new("kill").args([signal, &id]).status().unwrap();
            assert!(sent.success());
        }
        self.child.wait().unwrap().code()
    }
}

/// An open window.
pub(super) struct Window(BufReader<TcpStream>);

impl Window {
    /// The next event of a name; those before it are passed over.
    pub(super) fn next(&mut self, name: &str) -> Value {
        let mut line = String::new();
        let mut found = false;
        let begun = Instant::now();
        loop {
            // Heartbeats go on for ever.
            assert!(begun.elapsed() < LONG, "never: {name}");
            line.clear();
            assert!(self.0.read_line(&mut line).unwrap() > 0, "no more events");
            let line = line.trim_end();
            if let Some(event) = line.strip_prefix("event: ") {
                found = event == name;
            } else if let (true, Some(data)) = (found, line.strip_prefix("data: ")) {
                return serde_json::from_str(data).unwrap();
            }
        }
    }
}

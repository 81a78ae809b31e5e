//! A headless Chromium that tests can drive: the DevTools protocol over a web socket on this machine (RFC 6455), nothing more of
//! it than is needed. Everything has an end in time, and the browser is stopped when its value goes.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};
use std::collections::VecDeque;
use std::io::{Read, Write};
use std::net::TcpStream;
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Longest wait for anything.
const PATIENCE: Duration = Duration::from_secs(120);

/// Software rendering, no network, nothing that phones home.
const FLAGS: [&str; 14] = [
    "--headless",
    "--no-sandbox",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--disable-dev-shm-usage",
    "--hide-scrollbars",
    "--host-resolver-rules=MAP * ~NOTFOUND",
    "--remote-debugging-port=0",
];

pub(crate) struct Browser {
    child: Child,
    /// The browser's own files.
    _profile: tempfile::TempDir,
    stream: TcpStream,
    session: Option<String>,
    calls: u64,
    events: VecDeque<Value>,
    /// One browser at a time: each takes all there is of a small machine.
    _alone: MutexGuard<'static, ()>,
}

static ONE_AT_A_TIME: Mutex<()> = Mutex::new(());

/// A picture, RGB.
#[derive(PartialEq, Eq)]
pub(crate) struct Picture {
    bytes: Vec<u8>,
}

impl Picture {
    pub(crate) fn pixels(&self) -> impl Iterator<Item = [u8; 3]> + '_ {
        self.bytes.chunks_exact(3).map(|p| [p[0], p[1], p[2]])
    }

    pub(crate) fn colours(&self) -> usize {
        self.pixels().collect::<std::collections::BTreeSet<_>>().len()
    }
}

/// The browser's program, or `None` with a loud note.
fn program() -> Option<PathBuf> {
    let named = std::env::var_os("CHROMIUM").map(PathBuf::from);
    let found = named.or_else(|| {
        let path = std::env::var_os("PATH")?;
        let names = ["chromium", "chromium-browser", "google-chrome"];
        std::env::split_paths(&path).flat_map(|folder| names.map(|name| folder.join(name))).find(|file| file.is_file())
    });
    if found.is_none() {
        eprintln!(
            "SKIPPED: there is no chromium, chromium-browser or google-chrome, and CHROMIUM is not set: no page was opened"
        );
    }
    found
}

impl Browser {
    /// Starts a browser; `None` if there is none on this machine.
    pub(crate) fn start(more: &[&str]) -> Option<Self> {
        let program = program()?;
        let alone = ONE_AT_A_TIME.lock().unwrap_or_else(PoisonError::into_inner);
        let profile = tempfile::tempdir().unwrap();
        let folder = format!("--user-data-dir={}", profile.path().display());
        let mut child = Command::new(&program)
            .args(FLAGS)
            .arg(folder)
            .args(more)
            .arg("about:blank")
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap_or_else(|error| panic!("{} does not start: {error}", program.display()));
        let port = profile.path().join("DevToolsActivePort");
        let begun = Instant::now();
        let address = loop {
            let text = std::fs::read_to_string(&port).unwrap_or_default();
            if let Some((port, path)) = text.trim().split_once('\n') {
                break (port.parse::<u16>().unwrap(), path.to_owned());
            }
            let gone = child.try_wait().unwrap();
            if gone.is_some() || begun.elapsed() > PATIENCE {
                let _ = child.kill();
                panic!("{} was started and cannot be reached ({gone:?})", program.display());
            }
            std::thread::sleep(Duration::from_millis(50));
        };
        let mut stream = TcpStream::connect(("127.0.0.1", address.0)).unwrap();
        stream.set_read_timeout(Some(PATIENCE)).unwrap();
        stream.set_write_timeout(Some(PATIENCE)).unwrap();
        let key = STANDARD.encode([0; 16]);
        write!(
            stream,
            "GET {} HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Key: {key}\r\n\
             Sec-WebSocket-Version: 13\r\n\r\n",
            address.1
        )
        .unwrap();
        let mut head = Vec::new();
        while !head.ends_with(b"\r\n\r\n") {
            let mut byte = [0];
            stream.read_exact(&mut byte).unwrap();
            head.push(byte[0]);
        }
        assert!(head.starts_with(b"HTTP/1.1 101"), "{}", String::from_utf8_lossy(&head));
        let mut browser =
            Self { child, _profile: profile, stream, session: None, calls: 0, events: VecDeque::new(), _alone: alone };
        let targets = browser.call("Target.getTargets", json!({}));
        let page = targets["targetInfos"].as_array().unwrap().iter().find(|t| t["type"] == "page").unwrap()["targetId"].clone();
        let session = browser.call("Target.attachToTarget", json!({ "targetId": page, "flatten": true }));
        browser.session = Some(session["sessionId"].as_str().unwrap().to_owned());
        for domain in ["Page", "Runtime", "Log", "Network"] {
            browser.call(&format!("{domain}.enable"), json!({}));
        }
        Some(browser)
    }

    /// Calls a method and waits for its result.
    fn call(&mut self, method: &str, parameters: Value) -> Value {
        self.calls += 1;
        let mut message = json!({ "id": self.calls, "method": method, "params": parameters });
        if let Some(session) = &self.session {
            message["sessionId"] = session.as_str().into();
        }
        self.send(message.to_string().as_bytes());
        let begun = Instant::now();
        loop {
            assert!(begun.elapsed() < PATIENCE, "{method} does not end");
            let answer = self.receive();
            if answer["id"] == json!(self.calls) {
                assert!(answer.get("error").is_none(), "{method}: {}", answer["error"]);
                return answer["result"].clone();
            }
            self.events.push_back(answer);
        }
    }

    fn send(&mut self, text: &[u8]) {
        // One frame of text, masked with noughts.
        let mut frame = vec![0x81];
        match text.len() {
            n @ 0..126 => frame.push(0x80 | n as u8),
            n @ 126..=0xffff => {
                frame.push(0xfe);
                frame.extend((n as u16).to_be_bytes());
            }
            n => {
                frame.push(0xff);
                frame.extend((n as u64).to_be_bytes());
            }
        }
        frame.extend([0; 4]);
        frame.extend(text);
        self.stream.write_all(&frame).unwrap();
    }

    fn receive(&mut self) -> Value {
        let mut text = Vec::new();
        loop {
            let mut head = [0; 2];
            self.stream.read_exact(&mut head).expect("the browser answers in time");
            let mut size = [0; 8];
            let extra = match head[1] & 0x7f {
                126 => 2,
                127 => 8,
                _ => 0,
            };
            self.stream.read_exact(&mut size[8 - extra..]).unwrap();
            let length = if extra == 0 { u64::from(head[1] & 0x7f) } else { u64::from_be_bytes(size) };
            let begin = text.len();
            text.resize(begin + length as usize, 0);
            self.stream.read_exact(&mut text[begin..]).unwrap();
            if head[0] & 0x80 != 0 {
                return serde_json::from_slice(&text).unwrap();
            }
        }
    }

    /// Sets size, colours and medium (`print`, or nothing for the screen).
    pub(crate) fn window(&mut self, width: u64, height: u64, dark: bool, medium: &str) {
        let size = json!({ "width": width, "height": height, "deviceScaleFactor": 1, "mobile": false });
        self.call("Emulation.setDeviceMetricsOverride", size);
        let scheme = json!([{ "name": "prefers-color-scheme", "value": if dark { "dark" } else { "light" } }]);
        self.call("Emulation.setEmulatedMedia", json!({ "media": medium, "features": scheme }));
    }

    /// Opens a page and waits until it is there, and its view drawn or given up. What was said before is forgotten.
    pub(crate) fn open(&mut self, url: &str) {
        self.events.clear();
        let answer = self.call("Page.navigate", json!({ "url": url }));
        assert!(answer.get("errorText").is_none(), "{url}: {answer}");
        let begun = Instant::now();
        let settled = "document.readyState === 'complete' && location.href !== 'about:blank'";
        while self.evaluate(settled) != json!(true) {
            assert!(begun.elapsed() < PATIENCE, "{url} is not there in time");
            std::thread::sleep(Duration::from_millis(30));
        }
        let waiting = "document.getElementById('view')?.dataset.state === 'waiting'";
        let begun = Instant::now();
        // Without scripts it stays so.
        while self.evaluate(waiting) == json!(true) && begun.elapsed() < Duration::from_secs(10) {
            std::thread::sleep(Duration::from_millis(30));
        }
    }

    /// The value of an expression in the page.
    pub(crate) fn evaluate(&mut self, expression: &str) -> Value {
        let parameters = json!({ "expression": expression, "awaitPromise": true, "returnByValue": true });
        let answer = self.call("Runtime.evaluate", parameters);
        assert!(answer.get("exceptionDetails").is_none(), "{expression}: {answer}");
        answer["result"]["value"].clone()
    }

    /// Waits until an expression has a value.
    pub(crate) fn wait_for(&mut self, expression: &str, value: &str) {
        let begun = Instant::now();
        while self.evaluate(expression) != json!(value) {
            assert!(begun.elapsed() < PATIENCE, "{expression} is not {value} in time");
            std::thread::sleep(Duration::from_millis(30));
        }
    }

    /// Whether pages may run scripts.
    pub(crate) fn scripts(&mut self, on: bool) {
        self.call("Emulation.setScriptExecutionDisabled", json!({ "value": !on }));
    }

    /// Runs a script before those of every page from now on.
    pub(crate) fn before_pages(&mut self, script: &str) {
        self.call("Page.addScriptToEvaluateOnNewDocument", json!({ "source": script }));
    }

    /// Errors and other words on the console since the page was opened.
    pub(crate) fn complaints(&mut self) -> Vec<String> {
        let said = ["Runtime.exceptionThrown", "Runtime.consoleAPICalled", "Log.entryAdded"];
        self.events.iter().filter(|e| said.iter().any(|s| e["method"] == *s)).map(|e| e["params"].to_string()).collect()
    }

    /// Addresses asked for since the page was opened.
    pub(crate) fn requests(&mut self) -> Vec<String> {
        let asked = self.events.iter().filter(|e| e["method"] == "Network.requestWillBeSent");
        asked.map(|e| e["params"]["request"]["url"].as_str().unwrap().to_owned()).collect()
    }

    fn frame(&mut self, selector: &str) -> [f64; 4] {
        let script = format!(
            "(() => {{ const e = document.querySelector({}); e.scrollIntoView({{ block: 'center' }}); const r = e.getBoundingClientRect(); \
             return [r.x, r.y, r.width, r.height]; }})()",
            json!(selector)
        );
        let frame = self.evaluate(&script);
        std::array::from_fn(|i| frame[i].as_f64().unwrap())
    }

    /// What an element looks like on the screen.
    pub(crate) fn picture(&mut self, selector: &str) -> Picture {
        let [x, y, width, height] = self.frame(selector);
        let scroll = self.evaluate("[scrollX, scrollY]");
        let (x, y) = (x + scroll[0].as_f64().unwrap(), y + scroll[1].as_f64().unwrap());
        let clip =
            json!({ "x": x.ceil(), "y": y.ceil(), "width": width.floor() - 1.0, "height": height.floor() - 1.0, "scale": 1 });
        let answer = self.call("Page.captureScreenshot", json!({ "format": "png", "clip": clip, "captureBeyondViewport": true }));
        let bytes = STANDARD.decode(answer["data"].as_str().unwrap()).unwrap();
        let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut pixels).unwrap();
        let channels = info.color_type.samples();
        let bytes = pixels[..info.buffer_size()].chunks_exact(channels).flat_map(|p| [p[0], p[1], p[2]]).collect();
        Picture { bytes }
    }

    /// Centre of an element on the screen.
    pub(crate) fn centre(&mut self, selector: &str) -> (f64, f64) {
        let [x, y, width, height] = self.frame(selector);
        ((x + 0.5 * width).round(), (y + 0.5 * height).round())
    }

    fn mouse(&mut self, kind: &str, at: (f64, f64), held: bool) {
        let buttons = i32::from(held);
        let parameters = json!({ "type": kind, "x": at.0, "y": at.1, "button": "left", "buttons": buttons, "clickCount": 1 });
        self.call("Input.dispatchMouseEvent", parameters);
    }

    pub(crate) fn click(&mut self, at: (f64, f64)) {
        self.mouse("mouseMoved", at, false);
        self.mouse("mousePressed", at, true);
        self.mouse("mouseReleased", at, false);
    }

    pub(crate) fn drag(&mut self, from: (f64, f64), to: (f64, f64)) {
        self.mouse("mouseMoved", from, false);
        self.mouse("mousePressed", from, true);
        self.mouse("mouseMoved", to, true);
        self.mouse("mouseReleased", to, false);
    }

    /// Presses and lets go a key.
    pub(crate) fn key(&mut self, key: &str) {
        for kind in ["keyDown", "keyUp"] {
            self.call("Input.dispatchKeyEvent", json!({ "type": kind, "key": key }));
        }
    }

    /// The page on paper.
    pub(crate) fn pdf(&mut self) -> Vec<u8> {
        let answer = self.call("Page.printToPDF", json!({ "preferCSSPageSize": true }));
        STANDARD.decode(answer["data"].as_str().unwrap()).unwrap()
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        self.session = None;
        self.calls += 1;
        let close = json!({ "id": self.calls, "method": "Browser.close" }).to_string();
        if !std::thread::panicking() {
            self.send(close.as_bytes());
            let begun = Instant::now();
            while begun.elapsed() < Duration::from_secs(10) && matches!(self.child.try_wait(), Ok(None)) {
                std::thread::sleep(Duration::from_millis(20));
            }
        }
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

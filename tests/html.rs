//! The report as a page: well formed, closed in itself, and right in a real browser.
//!
//! The browser is `chromium`, `chromium-browser` or `google-chrome` of the path, or what the variable `CHROMIUM` names. Without
//! one the tests that need it say so and pass.

#![allow(clippy::print_stderr, reason = "tells what was skipped")]

mod browser;

use browser::{Browser, Picture};
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

/// A name no page may run, in a feature and in a path.
const HOSTILE: &str = "</script><script>document.title='gone'</script><img src=x onerror=alert(1)>\" & '";

/// Pages of all kinds, made by the program once.
struct Pages {
    folder: PathBuf,
}

impl Pages {
    fn path(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap()
    }

    fn url(&self, name: &str) -> String {
        format!("file://{}", self.path(name).display())
    }
}

const ROAD: &str = "build fixtures/hill_road.geojson --width 7 --terrain fixtures/ground.obj --cut-slope 1:1 --fill-slope 1:1.5 \
                    --stations 20 --swell 25% --shrink 10%";

/// Command lines and the page each makes.
fn commands(pages: &Pages) -> Vec<(&'static str, String)> {
    let file = |name: &str| pages.path(name).display().to_string();
    let hostile = file("hostile.geojson");
    vec![
        ("road.html", format!("{ROAD} -o {} --finished {}", file("road.obj"), file("finished.obj"))),
        (
            "pad.html",
            format!("build fixtures/hill_pad.geojson --slope 1:1.5 --terrain fixtures/ground.obj -o {}", file("pad.obj")),
        ),
        (
            "pit.html",
            format!("build fixtures/pit.csv --closed --side inside --slope 45deg --to-elevation 402 -o {}", file("pit.obj")),
        ),
        (
            "hostile.html",
            format!("build {hostile} --width 7 --slope 1:1 --terrain fixtures/ground.obj -o {}", file("hostile.obj")),
        ),
        ("volume.html", format!("volume {} fixtures/ground.obj", file("finished.obj"))),
        ("level.html", "volume fixtures/ground.obj --to-elevation 625".to_owned()),
        ("check.html", format!("check {} --slope 1:1.5", file("pad.obj"))),
    ]
}

fn run(arguments: &[&str]) -> std::process::Output {
    assert_cmd::Command::cargo_bin("slopegen").unwrap().current_dir(env!("CARGO_MANIFEST_DIR")).args(arguments).output().unwrap()
}

fn pages() -> &'static Pages {
    static PAGES: OnceLock<Pages> = OnceLock::new();
    PAGES.get_or_init(make_pages)
}

fn make_pages() -> Pages {
    let pages = Pages { folder: Path::new(env!("CARGO_TARGET_TMPDIR")).join("pages") };
    fs::create_dir_all(&pages.folder).unwrap();
    let mut line: Value = serde_json::from_str(&fs::read_to_string("fixtures/hill_road.geojson").unwrap()).unwrap();
    let feature = if line["features"].is_array() { &mut line["features"][0] } else { &mut line };
    feature["properties"]["name"] = HOSTILE.into();
    feature.as_object_mut().unwrap().remove("id");
    fs::write(pages.path("hostile.geojson"), line.to_string()).unwrap();
    for (name, command) in commands(&pages) {
        let report = pages.path(name).display().to_string();
        let mut arguments: Vec<&str> = command.split_whitespace().collect();
        arguments.extend(["--quiet", "--report", &report]);
        let output = run(&arguments);
        assert!(output.status.success(), "{command}\n{}", String::from_utf8_lossy(&output.stderr));
    }
    pages
}

/// Elements that have no end tag in HTML.
const VOID: [&str; 4] = ["meta", "link", "input", "br"];

/// Start tags with their attributes. Fails where tags do not nest, or an attribute is not quoted or there twice.
fn tags(page: &str) -> Vec<(String, BTreeMap<String, String>)> {
    let mut open: Vec<String> = Vec::new();
    let mut found = Vec::new();
    let mut rest = page.strip_prefix("<!DOCTYPE html>").expect("a document type");
    while let Some(at) = rest.find('<') {
        rest = &rest[at + 1..];
        if let Some(end) = rest.strip_prefix('/') {
            let (name, after) = end.split_once('>').unwrap();
            assert_eq!(open.pop().as_deref(), Some(name), "an end tag that does not fit");
            rest = after;
            continue;
        }
        let name: String = rest.chars().take_while(|c| c.is_ascii_alphanumeric()).collect();
        assert!(!name.is_empty(), "a bare `<` before {:?}", rest.chars().take(40).collect::<String>());
        rest = &rest[name.len()..];
        let mut attributes = BTreeMap::new();
        loop {
            rest = rest.trim_start();
            if let Some(after) = rest.strip_prefix("/>") {
                rest = after;
                break;
            }
            if let Some(after) = rest.strip_prefix('>') {
                rest = after;
                if !VOID.contains(&name.as_str()) {
                    open.push(name.clone());
                }
                break;
            }
            let key: String = rest.chars().take_while(|c| !" =>/".contains(*c)).collect();
            assert!(!key.is_empty(), "no attribute: {:?}", rest.chars().take(40).collect::<String>());
            rest = &rest[key.len()..];
            let mut value = String::new();
            if let Some(quoted) = rest.strip_prefix("=\"") {
                let (text, after) = quoted.split_once('"').unwrap();
                (value, rest) = (text.to_owned(), after);
            }
            assert!(attributes.insert(key.clone(), value).is_none(), "`{key}` twice in a {name}");
        }
        // Their text is not markup.
        if ["script", "style"].contains(&name.as_str()) {
            let (_, after) = rest.split_once(&format!("</{name}>")).unwrap();
            open.pop();
            rest = after;
        }
        found.push((name, attributes));
    }
    assert_eq!(open, Vec::<String>::new(), "elements that do not end");
    found
}

#[test]
fn pages_are_well_formed_and_closed_in_themselves() {
    let pages = pages();
    for (name, _) in commands(pages) {
        let page = pages.read(name);
        let tags = tags(&page);
        let ids: Vec<&String> = tags.iter().filter_map(|(_, a)| a.get("id")).collect();
        assert_eq!(ids.len(), ids.iter().collect::<BTreeSet<_>>().len(), "{name}: an id is there twice: {ids:?}");
        for (tag, attributes) in &tags {
            for (key, value) in attributes {
                let fetches = ["src", "href", "xlink:href", "action", "data", "srcset", "poster"].contains(&key.as_str());
                assert!(!fetches || value.starts_with('#') || value.starts_with("data:"), "{name}: {tag} {key}={value}");
                assert!(!key.starts_with("on"), "{name}: a script in {key}");
                for reference in ["aria-labelledby", "aria-describedby"] {
                    let known = |id: &str| ids.iter().any(|i| *i == id);
                    assert!(key != reference || value.split(' ').all(known), "{name}: {key}={value}");
                }
                if key == "href" && value.starts_with('#') {
                    assert!(ids.iter().any(|id| **id == value[1..]), "{name}: {value} leads nowhere");
                }
            }
        }
        let scripts: Vec<_> = tags.iter().filter(|(tag, a)| tag == "script" && !a.contains_key("type")).collect();
        let views = ["road.html", "pad.html", "pit.html", "hostile.html"];
        assert_eq!(scripts.len(), usize::from(views.contains(&name)), "{name}");
        assert!(
            !tags.iter().any(|(tag, _)| ["img", "iframe", "object", "embed", "form", "base"].contains(&tag.as_str())),
            "{name}"
        );
        assert!(page.contains("default-src 'none'") && page.contains("<html lang=\"en\">"), "{name}");
        // Nothing that could be fetched: the only addresses are names of namespaces.
        for (at, _) in page.match_indices("://") {
            let before = &page[..at];
            assert!(
                before.ends_with("xmlns=\"http") || before.ends_with("xmlns:xlink=\"http"),
                "{name}: {:?}",
                &page[at.saturating_sub(60)..at + 40]
            );
        }
        // Exactly one heading of the page, and no level left out.
        let levels: Vec<u8> = tags.iter().filter_map(|(t, _)| t.strip_prefix('h')?.parse().ok()).collect();
        assert_eq!(levels.iter().filter(|l| **l == 1).count(), 1, "{name}");
        assert!(levels.windows(2).all(|w| w[1] <= w[0] + 1), "{name}: {levels:?}");
        // Every table has a caption, every heading of one a scope.
        let count = |tag: &str| tags.iter().filter(|(t, _)| t == tag).count();
        assert_eq!(count("table"), count("caption"), "{name}");
        assert!(tags.iter().all(|(t, a)| t != "th" || a.contains_key("scope")), "{name}");
        assert!(page.contains("not a survey certificate") && page.contains("slopegen "), "{name}");
    }
}

#[test]
fn names_from_files_stay_text() {
    let pages = pages();
    let page = pages.read("hostile.html");
    assert!(!page.contains("<img") && !page.contains("onerror=alert(1)>\""), "markup from a file");
    assert!(page.contains("&lt;/script&gt;&lt;script&gt;document.title="), "the name is shown as it is");
    assert_eq!(page.matches("<script").count(), 2);
    assert_eq!(page.matches("</script").count(), 2);
}

#[test]
fn the_same_run_gives_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let make = |name: &str, threads: &str| {
        let (report, mesh) = (folder.path().join(name), folder.path().join("m.obj"));
        let mut arguments: Vec<&str> = ROAD.split_whitespace().collect();
        arguments.extend(["-q", "--threads", threads, "-o", mesh.to_str().unwrap(), "--report", report.to_str().unwrap()]);
        assert!(run(&arguments).status.success());
        fs::read(report).unwrap()
    };
    assert!(make("a.html", "1") == make("b.html", "3"));
}

/// The page says what the report for machines says.
#[test]
fn the_page_has_the_figures_of_the_report() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name).display().to_string();
    let (html, machine, mesh) = (file("r.html"), file("r.json"), file("r.obj"));
    let mut arguments: Vec<&str> = ROAD.split_whitespace().collect();
    arguments.extend(["-q", "-o", &mesh, "--report", &html, "--report", &machine]);
    assert!(run(&arguments).status.success());
    // Figures without the marks between thousands.
    let page = fs::read_to_string(&html).unwrap();
    let mut text = String::new();
    let mut inside = false;
    for c in page.split("<body>").nth(1).unwrap().split("<script").next().unwrap().chars() {
        match c {
            '<' => inside = true,
            '>' => inside = false,
            _ if !inside => text.push(c),
            _ => {}
        }
    }
    let report: Value = serde_json::from_str(&fs::read_to_string(&machine).unwrap()).unwrap();
    let figure = |pointer: &str| report.pointer(pointer).unwrap_or_else(|| panic!("{pointer}")).as_f64().unwrap();
    for (pointer, decimals) in [
        ("/volumes/cut", 2),
        ("/volumes/fill", 2),
        ("/volumes/net", 2),
        ("/volumes/error_bound", 2),
        ("/volumes/parts/platform/cut", 2),
        ("/volumes/parts/slopes/fill", 2),
        ("/volumes/bulking/cut_loose", 2),
        ("/volumes/bulking/fill_bank", 2),
        ("/volumes/bulking/net_bank", 2),
        ("/volumes/end_area/cut", 2),
        ("/volumes/prismoidal/fill", 2),
        ("/areas/cut", 2),
        ("/areas/unaffected", 2),
        ("/depths/cut_max", 3),
        ("/depths/fill_max_at/x", 3),
        ("/depths/fill_max_at/station", 3),
        ("/daylight/length", 3),
        ("/line/length", 3),
        ("/line/z_max", 3),
        ("/surface/slope_area", 2),
        ("/terrain/z_min", 3),
        ("/stations/3/cut", 2),
        ("/stations/7/net_cumulative_compacted", 2),
        ("/stations/11/prismoidal/fill", 2),
    ] {
        let shown = format!("{:.decimals$}", figure(pointer)).replace('-', "−");
        assert!(text.contains(&shown), "{pointer} = {shown} is not on the page");
    }
    for input in report["inputs"].as_array().unwrap() {
        assert!(text.contains(input["sha256"].as_str().unwrap()) && text.contains(input["path"].as_str().unwrap()));
    }
    for word in ["surplus", "Certificate passed", "1V:1.5H · 1.5H:1V · 66.7 % · 33.69°", "1V:1.001H to 1V:1H", "Complete"] {
        assert!(text.contains(word), "{word}");
    }
}

/// Corners of the triangles of an OBJ file.
fn mesh(path: &Path) -> Vec<[[f64; 3]; 3]> {
    let text = fs::read_to_string(path).unwrap();
    let fields = |line: &str| line.split_whitespace().skip(1).map(str::to_owned).collect::<Vec<_>>();
    let vertices: Vec<[f64; 3]> = text
        .lines()
        .filter(|line| line.starts_with("v "))
        .map(|line| <[f64; 3]>::try_from(fields(line).iter().map(|f| f.parse().unwrap()).collect::<Vec<f64>>()).unwrap())
        .collect();
    let corner = |field: &String| vertices[field.parse::<usize>().unwrap() - 1];
    text.lines()
        .filter(|line| line.starts_with("f "))
        .map(|line| <[[f64; 3]; 3]>::try_from(fields(line).iter().map(corner).collect::<Vec<_>>()).unwrap())
        .collect()
}

/// Height of a mesh at a place in plan.
fn height(mesh: &[[[f64; 3]; 3]], x: f64, y: f64) -> Option<f64> {
    mesh.iter().find_map(|[a, b, c]| {
        let area = |p: &[f64; 3], q: &[f64; 3]| (p[0] - x) * (q[1] - y) - (p[1] - y) * (q[0] - x);
        let (u, v, w) = (area(b, c), area(c, a), area(a, b));
        (u >= 0.0 && v >= 0.0 && w >= 0.0 && u + v + w > 0.0).then(|| (u * a[2] + v * b[2] + w * c[2]) / (u + v + w))
    })
}

fn canvas(browser: &mut Browser) -> Picture {
    // Two frames: one to draw, one to show.
    browser.evaluate("new Promise(r => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(r, 60))))");
    browser.picture("#view canvas")
}

/// Pixels that are clearly red, and clearly blue.
fn red_and_blue(picture: &Picture) -> (usize, usize) {
    let count = |pick: fn(i32, i32, i32) -> bool| {
        picture.pixels().filter(|[r, g, b]| pick((*r).into(), (*g).into(), (*b).into())).count()
    };
    (count(|r, g, b| r > g + 50 && r > b + 40), count(|r, _, b| b > r + 50))
}

#[test]
fn pages_work_in_a_browser() {
    let Some(mut browser) = Browser::start(&[]) else { return };
    let pages = pages();
    for (name, _) in commands(pages) {
        for (width, dark) in [(1200, false), (360, true)] {
            browser.window(width, 800, dark, "");
            browser.open(&pages.url(name));
            let place = format!("{name} at {width}, dark: {dark}");
            assert_eq!(browser.complaints(), Vec::<String>::new(), "{place}");
            for url in browser.requests() {
                assert!(url == pages.url(name) || url.starts_with("data:"), "{place}: {url}");
            }
            let across = browser.evaluate("document.documentElement.scrollWidth").as_u64().unwrap();
            assert!(across <= width, "{place}: the page is {across} wide");
            let low = browser.evaluate(LOW_CONTRAST);
            assert_eq!(low, json!([]), "{place}: contrast below 4.5");
            if browser.evaluate("!!document.getElementById('view')") == json!(true) {
                assert_eq!(browser.evaluate("document.getElementById('view').dataset.state"), "drawn", "{place}");
                let picture = canvas(&mut browser);
                assert!(picture.colours() > 200, "{place}: {} colours", picture.colours());
                let (red, blue) = red_and_blue(&picture);
                let ground = !name.starts_with("pit");
                assert!(blue > 100 && (red > 100 || !ground), "{place}: {red} red pixels, {blue} blue ones");
            }
        }
    }
    assert_ne!(browser.evaluate("document.title"), "gone");
}

/// Texts of the page, drawings aside, with a contrast below 4.5 : 1 (WCAG 2.2, success criterion 1.4.3; relative luminance as
/// there).
const LOW_CONTRAST: &str = r"(() => {
  const rgba = (text) => text.match(/[\d.]+/g).map(Number);
  const luminance = (c) => {
    const [r, g, b] = c.slice(0, 3).map((v) => v / 255).map((v) => v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4);
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const found = [];
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  for (let node = walker.nextNode(); node; node = walker.nextNode()) {
    const element = node.parentElement;
    if (!node.textContent.trim() || element.closest('svg,script,style,option') || !element.checkVisibility()) continue;
    let under = element;
    while (under && (rgba(getComputedStyle(under).backgroundColor)[3] ?? 1) === 0) under = under.parentElement;
    const [a, b] = [rgba(getComputedStyle(element).color), rgba(getComputedStyle(under || document.body).backgroundColor)].map(luminance);
    const ratio = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
    if (ratio < 4.5) found.push([node.textContent.trim().slice(0, 40), ratio]);
  }
  return found;
})()";

#[test]
fn drawings_are_on_the_page() {
    let Some(mut browser) = Browser::start(&[]) else { return };
    let pages = pages();
    browser.window(1200, 800, false, "");
    let mut drawn = |page: &str, section: &str| -> u64 {
        browser.open(&pages.url(page));
        let script = format!(
            "[...document.querySelectorAll('#{section} svg.plot')].filter(s => {{ const b = s.getBBox(), r = s.getBoundingClientRect(); \
             return s.querySelectorAll('path,polyline,line').length > 3 && b.width > 100 && b.height > 50 && r.height > 50; }}).length"
        );
        browser.evaluate(&script).as_u64().unwrap()
    };
    assert_eq!(["plan", "haul", "profile"].map(|section| drawn("road.html", section)), [1, 1, 1]);
    assert!(drawn("road.html", "sections") >= 8);
    assert_eq!(["plan", "haul", "profile"].map(|section| drawn("pad.html", section)), [1, 0, 1]);
    assert_eq!(drawn("pit.html", "plan"), 1);
}

#[test]
fn the_view_can_be_turned_and_asked() {
    let Some(mut browser) = Browser::start(&[]) else { return };
    let pages = pages();
    browser.window(1000, 900, false, "");
    browser.open(&pages.url("road.html"));
    browser.evaluate("document.querySelector('#view canvas').focus()");
    browser.key("0");
    let home = canvas(&mut browser);

    // Every way of moving changes the picture, and `0` brings it back.
    for key in ["ArrowLeft", "ArrowUp", "+", "-", "t", "f"] {
        browser.key(key);
        assert!(canvas(&mut browser) != home, "{key} changes nothing");
        browser.key("0");
        assert!(canvas(&mut browser) == home, "0 after {key} does not bring the view back");
    }
    for part in ["above", "front", "show-works", "show-ground", "show-before", "show-lines"] {
        let click = format!("document.querySelector('[data-part={part}]').click()");
        browser.evaluate(&click);
        assert!(canvas(&mut browser) != home, "{part} changes nothing");
        browser.evaluate(if part.starts_with("show") { &click } else { "document.querySelector('[data-part=home]').click()" });
        assert!(canvas(&mut browser) == home, "{part} cannot be undone");
    }
    let centre = browser.centre("#view canvas");
    browser.drag(centre, (centre.0 + 80.0, centre.1 + 10.0));
    assert!(canvas(&mut browser) != home, "dragging changes nothing");

    // Without the works there are no reds and blues; the daylight line is reddish, too.
    browser.key("0");
    let mut colours = |click: &str| {
        browser.evaluate(&format!("document.querySelector('[data-part={click}]').click()"));
        red_and_blue(&canvas(&mut browser))
    };
    let works = colours("show-lines");
    assert!(works.0 > 1000 && works.1 > 1000, "{works:?}");
    assert_eq!(colours("show-works"), (0, 0));
    colours("show-works");

    // From above, clicks tell the place clicked: heights as in the mesh that was written, whatever heights are drawn.
    let finished = mesh(&pages.path("finished.obj"));
    for heights in ["1", "5"] {
        let choose = format!(
            "(() => {{ const s = document.querySelector('[data-part=height]'); s.value = '{heights}'; \
             s.dispatchEvent(new Event('change')); document.querySelector('[data-part=above]').click(); }})()"
        );
        browser.evaluate(&choose);
        canvas(&mut browser);
        let mut told = 0;
        for (dx, dy) in [(0.0, 0.0), (-150.0, 5.0), (60.0, -8.0), (120.0, 12.0), (-60.0, -40.0), (30.0, 70.0)] {
            browser.click((centre.0 + dx, centre.1 + dy));
            let text = browser.evaluate("document.querySelector('[data-part=readout]').textContent");
            let numbers: Vec<f64> = text.as_str().unwrap().split_whitespace().filter_map(|word| word.parse().ok()).collect();
            let [x, y, z, ..] = numbers[..] else { panic!("{text}") };
            let truth = height(&finished, x, y).expect("a place on the ground");
            // The place is rounded to centimetres, on slopes no steeper than 1:1.
            assert!((truth - z).abs() < 0.03, "{text}: {truth}");
            told += usize::from(text.as_str().unwrap().contains("cut") || text.as_str().unwrap().contains("fill"));
        }
        assert!(told > 0, "no click met the works");
    }
    assert_eq!(browser.complaints(), Vec::<String>::new());
}

#[test]
fn without_scripts_or_webgl_the_page_says_so() {
    let Some(mut browser) = Browser::start(&[]) else { return };
    let pages = pages();
    let seen = "(() => { const seen = (p) => document.querySelector(`[data-part=${p}]`).checkVisibility(); \
                return [document.getElementById('view').dataset.state, seen('hint'), seen('stage'), \
                document.querySelector('[data-part=hint]').textContent] })()";
    browser.scripts(false);
    browser.open(&pages.url("pad.html"));
    let off = browser.evaluate(seen);
    assert_eq!((&off[0], &off[1], &off[2]), (&json!("waiting"), &json!(true), &json!(false)));
    assert!(off[3].as_str().unwrap().contains("needs scripts"));
    browser.scripts(true);
    browser.before_pages("HTMLCanvasElement.prototype.getContext = () => null;");
    browser.open(&pages.url("pad.html"));
    let none = browser.evaluate(seen);
    assert_eq!((&none[0], &none[1], &none[2]), (&json!("unavailable"), &json!(true), &json!(false)));
    assert!(none[3].as_str().unwrap().contains("no WebGL 2"));
    assert_eq!(browser.complaints(), Vec::<String>::new());
}

#[test]
fn a_lost_graphics_card_comes_back() {
    let Some(mut browser) = Browser::start(&[]) else { return };
    let pages = pages();
    browser.window(800, 700, false, "");
    browser.open(&pages.url("pad.html"));
    let before = canvas(&mut browser);
    browser.evaluate("window.lose = document.querySelector('#view canvas').getContext('webgl2').getExtension('WEBGL_lose_context'); lose.loseContext()");
    let state = "document.getElementById('view').dataset.state";
    browser.wait_for(state, "lost");
    browser.evaluate("lose.restoreContext()");
    browser.wait_for(state, "drawn");
    assert!(canvas(&mut browser) == before, "the picture is another one");
}

#[test]
fn on_paper_colours_are_light_and_the_view_is_there() {
    let Some(mut browser) = Browser::start(&[]) else { return };
    let pages = pages();
    browser.window(800, 700, true, "");
    browser.open(&pages.url("road.html"));
    browser.window(800, 700, true, "print");
    let paper = browser.evaluate("getComputedStyle(document.body).backgroundColor");
    assert_eq!(paper, "rgb(255, 255, 255)");
    let hidden = browser.evaluate("['nav', '.bar', '#view-keys'].map(s => document.querySelector(s).checkVisibility())");
    assert_eq!(hidden, json!([false, false, false]));
    let still = browser.picture("#view canvas.still");
    let (red, blue) = red_and_blue(&still);
    assert!(red > 100 && blue > 100, "{red} red pixels, {blue} blue ones");
    let white = still.pixels().filter(|p| p.iter().all(|c| *c > 250)).count();
    assert!(white * 10 > still.pixels().count(), "the sky is not white on paper");
    assert!(browser.pdf().starts_with(b"%PDF"));
}

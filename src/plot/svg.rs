//! SVG as text: elements with classes, escaped text, numbers of few digits.

use super::labels::fitted;
use super::style::{MARGIN, SMALL, Style, TITLE, file_css};
use glam::DVec2;
use std::fmt::Write as _;

/// Steps of coordinates in 1 px: all are rounded to a hundredth.
pub(super) const STEPS: f64 = 100.0;

/// Coordinates stay within this many px, whatever is drawn.
const FARTHEST: f64 = 1e6;

/// A drawing as it grows.
#[derive(Debug)]
pub(super) struct Svg {
    text: String,
    size: DVec2,
}

impl Svg {
    /// Begins a drawing. `title` names it, `desc` tells its content, both also to those who cannot see it.
    pub(super) fn new(style: &Style, size: DVec2, title: &str, desc: &str) -> Self {
        let mut svg = Self { text: String::new(), size };
        let (width, height) = (number(size.x), number(size.y));
        if style.standalone {
            svg.text.push_str("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
        }
        let _ = writeln!(
            svg.text,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"plot\" role=\"img\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\"><title>{}</title><desc>{}</desc>",
            escaped(title),
            escaped(desc)
        );
        if style.standalone {
            let _ = writeln!(svg.text, "<style>\n{}</style>", file_css());
            svg.rect("paper", DVec2::ZERO, size);
        }
        svg
    }

    /// Opens a window: what is drawn in it is cut off at its edge, and has its origin in the upper left corner.
    pub(super) fn window(&mut self, at: DVec2, size: DVec2) {
        let [x, y, w, h] = [at.x, at.y, size.x, size.y].map(number);
        let _ = writeln!(self.text, "<svg x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\" viewBox=\"0 0 {w} {h}\">");
    }

    /// Closes a window.
    pub(super) fn end_window(&mut self) {
        self.text.push_str("</svg>\n");
    }

    /// A rectangle.
    pub(super) fn rect(&mut self, class: &str, at: DVec2, size: DVec2) {
        let [x, y, w, h] = [at.x, at.y, size.x.max(0.0), size.y.max(0.0)].map(number);
        let _ = writeln!(self.text, "<rect class=\"{class}\" x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\"/>");
    }

    /// A circle.
    pub(super) fn circle(&mut self, class: &str, at: DVec2, radius: f64) {
        let [x, y, r] = [at.x, at.y, radius].map(number);
        let _ = writeln!(self.text, "<circle class=\"{class}\" cx=\"{x}\" cy=\"{y}\" r=\"{r}\"/>");
    }

    /// A straight line.
    pub(super) fn line(&mut self, class: &str, a: DVec2, b: DVec2) {
        let mut path = Path::default();
        path.add(&[a, b], false);
        self.path(class, &path);
    }

    /// Lines and outlines; nothing for an empty path.
    pub(super) fn path(&mut self, class: &str, path: &Path) {
        if !path.text.is_empty() {
            let _ = writeln!(self.text, "<path class=\"{class}\" d=\"{}\"/>", path.text);
        }
    }

    /// Text; `class` says where it is anchored, `turn` by how many degrees clockwise it is turned about that point.
    pub(super) fn text(&mut self, class: &str, at: DVec2, turn: f64, text: &str) {
        let [x, y] = [at.x, at.y].map(number);
        let _ = write!(self.text, "<text class=\"{class}\"");
        if turn == 0.0 {
            let _ = write!(self.text, " x=\"{x}\" y=\"{y}\"");
        } else {
            let _ = write!(self.text, " transform=\"translate({x} {y})rotate({})\"", number(turn));
        }
        let _ = writeln!(self.text, ">{}</text>", escaped(text));
    }

    /// The title of a drawing and a line below it, from `x` on, cut off where there is no more `room`.
    pub(super) fn heading(&mut self, title: &str, below: &str, x: f64, room: f64) {
        self.text("h1", DVec2::new(x, 24.0), 0.0, &fitted(title, TITLE, room));
        self.text("s soft", DVec2::new(x, 43.0), 0.0, &fitted(below, SMALL, room));
    }

    /// The whole drawing.
    pub(super) fn finish(mut self) -> Drawn {
        self.text.push_str("</svg>\n");
        Drawn { text: self.text, size: self.size }
    }
}

/// A finished drawing.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Drawn {
    pub(super) text: String,
    /// Its size in px.
    pub(super) size: DVec2,
}

/// Drawings below each other in one file, below their title if it is `headed`. They are parts, not standalone.
pub(super) fn sheet(parts: &[Drawn], title: &str, headed: bool, note: Option<&str>) -> String {
    /// Room for a line of text.
    const LINE: f64 = 34.0;
    let head = if headed { LINE } else { 0.0 };
    let rows = head + parts.iter().map(|part| part.size.y).sum::<f64>();
    let width = parts.iter().map(|part| part.size.x).fold(Style::FILE.width, f64::max);
    let size = DVec2::new(width, rows + if note.is_some() { LINE } else { 0.0 });
    let mut svg = Svg::new(&Style::FILE, size, title, note.unwrap_or(title));
    let mut y = head;
    if headed {
        svg.text("h1", DVec2::new(MARGIN, 24.0), 0.0, &fitted(title, TITLE, size.x - 2.0 * MARGIN));
    }
    for part in parts {
        svg.text.push_str(&part.text.replacen("<svg ", &format!("<svg y=\"{}\" ", number(y)), 1));
        y += part.size.y;
    }
    if let Some(note) = note {
        svg.text("soft", DVec2::new(MARGIN, y + 20.0), 0.0, note);
    }
    svg.finish().text
}

/// A place in hundredths of a px.
fn steps(p: DVec2) -> (i64, i64) {
    let one = |v: f64| if v.is_nan() { 0 } else { (v.clamp(-FARTHEST, FARTHEST) * STEPS).round() as i64 };
    (one(p.x), one(p.y))
}

/// Data of a path: polylines and outlines, each point relative to the one before.
#[derive(Debug, Default)]
pub(super) struct Path {
    text: String,
    /// Where the pen is, in hundredths.
    pen: (i64, i64),
}

impl Path {
    /// Adds a polyline, or an outline that is closed. One that is a single place after rounding is left out.
    pub(super) fn add(&mut self, points: &[DVec2], closed: bool) {
        let mut places: Vec<(i64, i64)> = points.iter().map(|p| steps(*p)).collect();
        places.dedup();
        if closed && places.len() > 1 && places.first() == places.last() {
            places.pop();
        }
        if places.len() < 2 || closed && places.len() < 3 {
            return;
        }
        let first = places[0];
        self.text.push(if self.text.is_empty() { 'M' } else { 'm' });
        for (i, place) in places.into_iter().enumerate() {
            if i == 1 {
                self.text.push('l');
            }
            push(&mut self.text, place.0 - self.pen.0, i > 1);
            push(&mut self.text, place.1 - self.pen.1, true);
            self.pen = place;
        }
        if closed {
            self.text.push('z');
            self.pen = first;
        }
    }
}

/// Appends hundredths as a number without needless digits; `apart` puts a blank where the number before would run into it.
fn push(text: &mut String, hundredths: i64, apart: bool) {
    if hundredths < 0 {
        text.push('-');
    } else if apart {
        text.push(' ');
    }
    let (whole, part) = (hundredths.unsigned_abs() / 100, hundredths.unsigned_abs() % 100);
    if whole > 0 || part == 0 {
        let _ = write!(text, "{whole}");
    }
    if part > 0 {
        let digits = if part % 10 == 0 { part / 10 } else { part };
        let _ = if part % 10 == 0 { write!(text, ".{digits}") } else { write!(text, ".{digits:02}") };
    }
}

/// A coordinate or size as text.
pub(super) fn number(value: f64) -> String {
    let mut text = String::new();
    push(&mut text, steps(DVec2::new(value, 0.0)).0, false);
    text
}

/// Text as XML 1.0 may hold it: markup escaped, characters it knows no way to write replaced.
pub(super) fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            '\t' | '\n' | '\r' => out.push(' '),
            '\0'..='\x1f' | '\u{fffe}' | '\u{ffff}' => out.push('\u{fffd}'),
            c => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        for (value, text) in [
            (0.0, "0"),
            (-0.004, "0"),
            (0.5, ".5"),
            (-0.05, "-.05"),
            (12.3456, "12.35"),
            (-7.1, "-7.1"),
            (100.0, "100"),
            (f64::NAN, "0"),
            (f64::INFINITY, "1000000"),
        ] {
            assert_eq!(number(value), text);
        }
    }

    #[test]
    fn paths_are_relative_and_leave_out_what_is_nothing() {
        let mut path = Path::default();
        path.add(&[DVec2::new(1.0, 2.0), DVec2::new(1.5, 2.0), DVec2::new(1.5, 1.0)], false);
        path.add(&[DVec2::ZERO, DVec2::new(0.001, 0.0)], false);
        path.add(&[DVec2::ZERO, DVec2::X, DVec2::Y, DVec2::ZERO], true);
        path.add(&[DVec2::X, DVec2::Y], false);
        assert_eq!(path.text, "M1 2l.5 0 0-1m-1.5-1l1 0-1 1zm1 0l-1 1");
    }

    #[test]
    fn text_is_escaped() {
        assert_eq!(escaped("a<b> & \"c\" 'd'\n\u{1}\u{ffff}ß"), "a&lt;b&gt; &amp; &quot;c&quot; &#39;d&#39; \u{fffd}\u{fffd}ß");
    }
}

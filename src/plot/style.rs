//! How drawings look: sizes, colours for light and dark, and the style sheet.
//!
//! Depths go from pale to strong, cut in red, fill in blue, with nought the colour of the paper: red and blue are told apart with
//! any of the common colour deficiencies, and strength says the same where there is no colour at all. All text has a contrast of
//! at least 4.5 : 1 with its ground (WCAG 2.2, success criterion 1.4.3).

/// How a drawing is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    /// A file of its own, with head, style sheet and background. Otherwise a fragment for a page that has [`css`] in its head.
    pub standalone: bool,
    /// Width in px, from [`LEAST_WIDTH`] to [`MOST_WIDTH`]; the height follows.
    pub width: f64,
}

/// The narrowest drawing, in px: furniture and figures need as much.
pub const LEAST_WIDTH: f64 = 360.0;

/// The widest drawing, in px.
pub const MOST_WIDTH: f64 = 4000.0;

/// Width unless another is asked for, in px.
const WIDTH: f64 = 1000.0;

impl Style {
    /// Of a file of its own.
    pub const FILE: Self = Self { standalone: true, width: WIDTH };

    /// Of a part of a page.
    pub const INLINE: Self = Self { standalone: false, width: WIDTH };

    /// Width within its limits.
    pub(super) fn width(&self) -> f64 {
        if self.width.is_finite() { self.width.clamp(LEAST_WIDTH, MOST_WIDTH) } else { WIDTH }
    }
}

/// Classes of depth of cut, and as many of fill.
pub(super) const CLASSES: usize = 6;

/// Size of the smallest text, in px.
pub(super) const SMALL: f64 = 11.0;

/// Size of titles, in px: that of the class `h1`.
pub(super) const TITLE: f64 = 17.0;

/// Room beside titles, in px.
pub(super) const MARGIN: f64 = 20.0;

/// Colours by name, on light and on dark paper.
const PALETTE: [(&str, &str, &str); 29] = [
    ("paper", "#ffffff", "#14171b"),
    ("ink", "#1b2027", "#e8eaed"),
    ("soft", "#59626d", "#a4adb8"),
    ("rule", "#cdd2d8", "#3d444d"),
    ("land", "#f6f5f1", "#1c2025"),
    ("contour", "#b3a58c", "#6d6450"),
    ("ground", "#8a6d3b", "#c9a765"),
    ("level", "#3f4954", "#c3cad2"),
    ("crease", "#6b7480", "#9aa3ae"),
    ("daylight", "#9c4a12", "#f0a260"),
    ("zero", "#117a4b", "#5fd39b"),
    ("open", "#8e24aa", "#d78bec"),
    ("platform", "#e3e5e8", "#353b43"),
    ("nought", "#fbfbfa", "#262b31"),
    ("cut", "#b3261e", "#ff8d7d"),
    ("fill", "#1f5fae", "#7fb4ff"),
    ("spread", "#fff3c4", "#4a4020"),
    ("c1", "#fde0d6", "#46241f"),
    ("c2", "#f9c0ae", "#672f27"),
    ("c3", "#f09a84", "#8b3b30"),
    ("c4", "#e0705c", "#b24a3c"),
    ("c5", "#c6473a", "#da6351"),
    ("c6", "#a1201d", "#ff8571"),
    ("f1", "#dceaf7", "#1d2f45"),
    ("f2", "#b9d6ef", "#234468"),
    ("f3", "#90bde3", "#2a5b8e"),
    ("f4", "#629fd2", "#3474b3"),
    ("f5", "#3a7dbb", "#4b92d9"),
    ("f6", "#1c5796", "#74b3fb"),
];

/// What does not depend on colours.
const SHAPES: &str = "\
.plot{font-family:system-ui,'Segoe UI','Helvetica Neue',Arial,'DejaVu Sans',sans-serif;font-size:12px;font-variant-numeric:tabular-nums}
.plot path,.plot line,.plot polyline,.plot rect{vector-effect:none}
.plot .no{fill:none}
.plot .h1{font-size:17px;font-weight:600}
.plot .b{font-weight:600}
.plot .s{font-size:11px}
.plot .m{text-anchor:middle}
.plot .e{text-anchor:end}
.plot .halo{stroke-width:3;stroke-linejoin:round;paint-order:stroke}
.plot .ln{fill:none;stroke-linejoin:round;stroke-linecap:round}
.plot .frame{fill:none;stroke-width:1}
.plot .grid{fill:none;stroke-width:1}
.plot .tick{fill:none;stroke-width:1}
.plot .contour{stroke-width:.6}
.plot .contour.i{stroke-width:1.1}
.plot .level{stroke-width:.7}
.plot .level.i{stroke-width:1.2}
.plot .crease{stroke-width:.8;stroke-dasharray:1 3}
.plot .breakline{stroke-width:.9}
.plot .axis{stroke-width:1;stroke-dasharray:12 3 2 3}
.plot .daylight{stroke-width:1.7;stroke-dasharray:7 3;stroke-linecap:butt}
.plot .zero{stroke-width:1.6;stroke-dasharray:2 3}
.plot .open{stroke-width:1.8;stroke-dasharray:2 4}
.plot .hinge{stroke-width:2.4}
.plot .ground{stroke-width:1.6}
.plot .design{stroke-width:2.4}
.plot .edge{stroke-width:1}
.plot .edge.right{stroke-dasharray:5 3}
.plot .thin{stroke-width:1}
.plot .lead{fill:none;stroke-width:.6}
.plot .dot{stroke-width:1.6}
.plot .gap{stroke-width:1}
";

/// What does; `$name` stands for a colour of the palette.
const COLOURS: &str = "\
.plot{background:$paper}
.plot text{fill:$ink}
.plot .paper{fill:$paper}
.plot .land{fill:$land}
.plot .plate{fill:$paper;fill-opacity:.86}
.plot .soft{fill:$soft}
.plot .halo{stroke:$paper}
.plot .solid{fill:$ink}
.plot .frame{stroke:$soft}
.plot .grid{stroke:$rule}
.plot .tick{stroke:$soft}
.plot .contour{stroke:$contour}
.plot text.tc{fill:$ground}
.plot .ground{stroke:$ground}
.plot .level{stroke:$level}
.plot .crease{stroke:$crease}
.plot .breakline{stroke:$crease}
.plot .axis{stroke:$ink}
.plot .daylight{stroke:$daylight}
.plot .zero{stroke:$zero}
.plot .open{stroke:$open}
.plot .hinge{stroke:$ink}
.plot .design{stroke:$ink}
.plot .platform{fill:$platform}
.plot .nought{fill:$nought}
.plot text.cut{fill:$cut}
.plot text.fill{fill:$fill}
.plot .edge{stroke:$ink}
.plot .thin{stroke:$ink}
.plot .lead{stroke:$ink}
.plot .dot{fill:$paper;stroke:$ink}
.plot .gap{stroke:$paper}
";

/// Rules for the classes of depth.
fn classes(colour: &impl Fn(&str) -> String) -> String {
    let rule = |letter: char, i: usize| format!(".plot .{letter}{i}{{fill:{}}}\n", colour(&format!("{letter}{i}")));
    (1..=CLASSES).map(|i| rule('c', i)).chain((1..=CLASSES).map(|i| rule('f', i))).collect()
}

/// The rules of colour, each colour as `colour` writes it.
fn coloured(colour: impl Fn(&str) -> String) -> String {
    let mut pieces = COLOURS.split('$');
    let mut text = pieces.next().unwrap_or_default().to_owned();
    for piece in pieces {
        let end = piece.find(|c: char| !c.is_ascii_alphanumeric()).unwrap_or(piece.len());
        text.push_str(&colour(&piece[..end]));
        text.push_str(&piece[end..]);
    }
    text.push_str(&classes(&colour));
    text
}

fn pick(name: &str, of: fn(&(&'static str, &'static str, &'static str)) -> &'static str) -> String {
    PALETTE.iter().find(|entry| entry.0 == name).map_or_else(|| "currentColor".to_owned(), |entry| of(entry).to_owned())
}

/// The style sheet of a page with drawings in it. All rules begin with `.plot`. Colours are custom properties `--plot-…` of
/// `.plot`, which a later rule may set anew; they follow `prefers-color-scheme`.
pub fn css() -> String {
    let properties = |of: fn(&(&'static str, &'static str, &'static str)) -> &'static str| {
        PALETTE.iter().map(|entry| format!("--plot-{}:{};", entry.0, of(entry))).collect::<String>()
    };
    let (light, dark) = (properties(|entry| entry.1), properties(|entry| entry.2));
    let rules = coloured(|name| format!("var(--plot-{name})"));
    format!(".plot{{{light}}}\n@media (prefers-color-scheme:dark){{.plot{{{dark}}}}}\n{SHAPES}{rules}")
}

/// The style sheet of a file of its own: without custom properties, which programs other than browsers do not know.
pub(super) fn file_css() -> String {
    let (light, dark) = (coloured(|name| pick(name, |entry| entry.1)), coloured(|name| pick(name, |entry| entry.2)));
    format!("{SHAPES}{light}@media (prefers-color-scheme:dark){{\n{dark}}}\n")
}

//! Legends: symbols, scales, scale bars, in rows.

use super::labels::width;
use super::scale::{decimals, figure, round_step};
use super::style::SMALL;
use super::svg::Svg;
use crate::model::LengthUnit;
use glam::DVec2;

/// Half the length of the arms of a cross, in px.
const ARM: f64 = 4.0;

/// What a line or patch of the legend looks like.
#[derive(Clone, Copy, Debug)]
pub(super) enum Sample {
    /// A line of this class.
    Line(&'static str),
    /// A patch of this class.
    Patch(&'static str),
    /// A cross.
    Cross,
    /// A dot with an outline.
    Dot,
}

#[derive(Clone, Debug)]
enum Kind {
    Symbol { sample: Sample, text: String },
    Scale { classes: Vec<String>, ends: Vec<String>, unit: &'static str },
    Bar { step: f64, count: u32, scale: f64, unit: LengthUnit },
}

/// One block of the legend.
#[derive(Clone, Debug)]
pub(super) struct Block {
    kind: Kind,
    size: DVec2,
}

/// Length of the sample of a line, in px.
const SAMPLE: f64 = 34.0;

/// Height of the bar of the scale of depths.
const STRIP: f64 = 14.0;

/// Longest and shortest cell of the scale of depths.
const CELL: (f64, f64) = (46.0, 20.0);

/// Room for `cut` and `fill` at the ends of the scale of depths.
const WORD: f64 = 30.0;

impl Block {
    /// A symbol and what it stands for.
    pub(super) fn symbol(sample: Sample, text: &str) -> Self {
        let size = DVec2::new(SAMPLE + 8.0 + width(text, SMALL) + 22.0, 20.0);
        Self { kind: Kind::Symbol { sample, text: text.to_owned() }, size }
    }

    /// A scale of colours with figures between its cells.
    pub(super) fn scale(classes: Vec<String>, ends: Vec<String>, unit: &'static str) -> Self {
        let cell = cell(&classes);
        let size = DVec2::new(2.0 * WORD + cell * classes.len() as f64 + 40.0, 58.0);
        Self { kind: Kind::Scale { classes, ends, unit }, size }
    }

    /// The scale bar of a drawing `room` wide with `scale` px per unit: a round length of about a quarter of it, in four parts or
    /// five.
    pub(super) fn bar(room: f64, scale: f64, unit: LengthUnit) -> Self {
        let part = round_step(0.04 * room / scale);
        let count = if 5.0 * part * scale < 0.3 * room { 5 } else { 4 };
        let length = part * f64::from(count) * scale;
        Self { kind: Kind::Bar { step: part, count, scale, unit }, size: DVec2::new(length + 70.0, 58.0) }
    }

    /// Draws the block, its upper left corner at `at`.
    fn draw(&self, svg: &mut Svg, at: DVec2) {
        match &self.kind {
            Kind::Symbol { sample, text } => {
                let middle = at + DVec2::new(0.0, 8.0);
                match sample {
                    Sample::Line(class) => svg.line(class, middle, middle + DVec2::new(SAMPLE, 0.0)),
                    Sample::Patch(class) => svg.rect(class, middle - DVec2::new(0.0, 6.0), DVec2::new(SAMPLE, 12.0)),
                    Sample::Dot => svg.circle("dot", middle + DVec2::new(0.5 * SAMPLE, 0.0), 4.0),
                    Sample::Cross => {
                        let c = middle + DVec2::new(0.5 * SAMPLE, 0.0);
                        svg.line("thin", c - DVec2::X * ARM, c + DVec2::X * ARM);
                        svg.line("thin", c - DVec2::Y * ARM, c + DVec2::Y * ARM);
                    }
                }
                svg.text("s", at + DVec2::new(SAMPLE + 8.0, 12.0), 0.0, text);
            }
            Kind::Scale { classes, ends, unit } => {
                svg.text("s soft", at + DVec2::new(0.0, 12.0), 0.0, &format!("depth in {unit}"));
                let cell = cell(classes);
                let strip = at + DVec2::new(WORD, 20.0);
                svg.text("s b cut", at + DVec2::new(0.0, 31.0), 0.0, "cut");
                for (i, class) in classes.iter().enumerate() {
                    svg.rect(class, strip + DVec2::new(i as f64 * cell, 0.0), DVec2::new(cell, STRIP));
                }
                let all = DVec2::new(cell * classes.len() as f64, STRIP);
                svg.rect("frame", strip, all);
                svg.text("s b fill", strip + DVec2::new(all.x + 8.0, 11.0), 0.0, "fill");
                for (i, text) in ends.iter().enumerate() {
                    svg.text("s m", strip + DVec2::new(i as f64 * cell, STRIP + 13.0), 0.0, text);
                }
            }
            Kind::Bar { step, count, scale, unit } => {
                let long = step * scale;
                let strip = at + DVec2::new(8.0, 24.0);
                svg.text("s soft", at + DVec2::new(8.0, 12.0), 0.0, "scale");
                for i in 0..*count {
                    let class = if i % 2 == 0 { "solid" } else { "paper" };
                    svg.rect(class, strip + DVec2::new(f64::from(i) * long, 0.0), DVec2::new(long, 6.0));
                }
                svg.rect("frame", strip, DVec2::new(long * f64::from(*count), 6.0));
                let digits = decimals(*step);
                // Figures where they have room: at each part, else at both ends.
                let room = width(&figure(step * f64::from(*count), digits), SMALL) + 8.0;
                let every = if long >= room {
                    1
                } else if count % 2 == 0 && 2.0 * long >= room {
                    2
                } else {
                    *count
                };
                for i in (0..=*count).step_by(every as usize) {
                    let last = if i == *count { format!(" {unit}") } else { String::new() };
                    let text = figure(step * f64::from(i), digits);
                    let x = f64::from(i) * long - 0.5 * width(&text, SMALL);
                    svg.text("s", strip + DVec2::new(x, 20.0), 0.0, &format!("{text}{last}"));
                }
            }
        }
    }
}

/// Width of a cell of a scale.
fn cell(classes: &[String]) -> f64 {
    (280.0 / classes.len() as f64).clamp(CELL.1, CELL.0)
}

/// Blocks in rows.
#[derive(Clone, Debug)]
pub(super) struct Legend {
    blocks: Vec<Block>,
    rows: Vec<Row>,
}

#[derive(Clone, Debug)]
struct Row {
    height: f64,
    /// Where each block begins, and its number.
    blocks: Vec<(f64, usize)>,
}

impl Legend {
    /// Puts blocks into rows of a width, in their order, those of one height together.
    pub(super) fn new(blocks: Vec<Block>, room: f64) -> Self {
        let mut rows: Vec<Row> = Vec::new();
        let mut x = 0.0;
        for (i, block) in blocks.iter().enumerate() {
            let fits = |row: &&mut Row| row.height == block.size.y && x + block.size.x <= room;
            match rows.last_mut().filter(fits) {
                Some(row) => row.blocks.push((x, i)),
                None => {
                    rows.push(Row { height: block.size.y, blocks: vec![(0.0, i)] });
                    x = 0.0;
                }
            }
            x += block.size.x;
        }
        Self { blocks, rows }
    }

    /// Height of all rows.
    pub(super) fn height(&self) -> f64 {
        self.rows.iter().map(|row| row.height).sum()
    }

    /// Draws the blocks, the upper left corner of the first at `at`.
    pub(super) fn draw(&self, svg: &mut Svg, at: DVec2) {
        let mut y = at.y;
        for row in &self.rows {
            for &(x, i) in &row.blocks {
                self.blocks[i].draw(svg, DVec2::new(at.x + x, y));
            }
            y += row.height;
        }
    }
}

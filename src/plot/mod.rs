//! Drawings of a design as SVG: plan, long profile, cross-sections, mass haul.
//!
//! All are drawn in px, as wide as the [`Style`] says, and scale with the page. Lines are within about a tenth of a px; the size
//! of a drawing is bounded, whatever is drawn. The same input gives the same bytes.

mod bands;
mod between;
mod chart;
mod contours;
mod course;
mod drawing;
mod haul;
mod labels;
mod legend;
mod lines;
mod plan;
mod profile;
mod scale;
mod scene;
mod sections;
mod stations;
mod style;
mod svg;

pub use drawing::{Drawing, UnknownDrawing, file};
pub use haul::mass_haul;
pub use plan::plan;
pub use profile::profile;
pub use scale::round_step;
pub use scene::{OnGround, Scene};
pub use sections::{MOST_SECTIONS, sections};
pub use style::{LEAST_WIDTH, MOST_WIDTH, Style, css};

#[cfg(test)]
mod testing;
#[cfg(test)]
mod tests;

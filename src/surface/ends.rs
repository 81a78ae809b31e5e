//! Where the slopes end, and what is counted from there: levels, and the plane for volumes.

use super::SurfaceError;
use crate::model::{Design, Extent, Line, Sheet};
use crate::slope::levels::{self, Levels};
use crate::slope::network::Network;

/// How far beyond the outer distance the sheet is followed, relative to its depth there and at least this many length units.
const BEYOND_REACH: f64 = 1e-3;

/// The end of the slope is taken this much lower (length units): a crease that runs exactly there is then the end on both of its
/// sides alike.
pub(super) const END_TIE: f64 = 1e-11;

/// Where the sheet stops, heights of the falling sheet.
pub(super) struct Ends {
    /// Plane down to which facets are closed.
    pub(super) closure: f64,
    /// Lowest height of the surface.
    pub(super) lowest: f64,
    /// Highest height of the line.
    top: f64,
    /// Length of rulings, where that is limited.
    pub(super) reach: Option<f64>,
}

impl Ends {
    pub(super) fn new(network: &Network, line: &Line, design: &Design) -> Result<Self, SurfaceError> {
        let k = design.slope.ratio();
        let (low, high) = line.elevation_range();
        let (bottom, top) = if network.sign > 0.0 { (low, high) } else { (-high, -low) };
        let at_reach = |reach: f64| {
            let lowest = bottom - k * reach;
            let closure = lowest - BEYOND_REACH * (k * reach).max(1.0);
            Self { closure, lowest, top, reach: Some(reach) }
        };
        Ok(match design.extent {
            Extent::Elevation(z) => {
                let end = network.sign * z;
                if end >= top {
                    return Err(SurfaceError::NothingToBuild { end: z, low, high, rising: design.sheet == Sheet::Rising });
                }
                // Where the line itself ends on that elevation, the elevation must stay what it is.
                let touches = network.nodes.iter().any(|p| (p.z - end).abs() <= levels::LEVEL_SNAP);
                Self { closure: if touches { end } else { end - END_TIE }, lowest: end, top, reach: None }
            }
            Extent::Height(h) => at_reach(h / k),
            Extent::Distance(d) => at_reach(d),
        })
    }

    /// `sign`: what heights of the falling sheet are multiplied with to get elevations.
    pub(super) fn levels(&self, design: &Design, sign: f64) -> Result<Levels, SurfaceError> {
        let chosen: Vec<f64> = design.levels.iter().map(|z| sign * z).collect();
        if design.interval.is_none() && !chosen.is_empty() {
            return Ok(Levels { heights: Vec::new() }.with(&chosen, self.lowest, self.top));
        }
        let range = self.top - self.lowest;
        let interval = design.interval.unwrap_or_else(|| levels::round_interval(range));
        let count = (range / interval).floor();
        if count > levels::MAX_LEVELS as f64 {
            let least = range / levels::MAX_LEVELS as f64;
            // Two digits, rounded up.
            let unit = 10_f64.powf(least.log10().floor() - 1.0);
            return Err(SurfaceError::TooManyLevels { interval, count, least: (least / unit).ceil() * unit });
        }
        Ok(Levels::between(self.lowest, self.top, interval).with(&chosen, self.lowest, self.top))
    }

    /// The plane that volumes are measured from, where none is given: the elevation the slopes end at, inside rings that of the rim.
    pub(super) fn reference(&self, line: &Line, design: &Design) -> f64 {
        let falling = design.sheet == Sheet::Falling;
        let (low, high) = line.elevation_range();
        let inside = design.only_inside(line);
        match design.extent {
            _ if inside && falling => high,
            _ if inside => low,
            Extent::Elevation(z) => z,
            _ if falling => self.lowest,
            _ => -self.lowest,
        }
    }
}

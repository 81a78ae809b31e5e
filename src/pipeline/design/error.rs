//! Why a line and what is wanted do not go together, in words.

use super::{FURTHEST_REACH, LEAST_DEPTH, LEAST_INTERVAL, MOST_ARC_POINTS, MOST_LEVELS};
use crate::model::Sheet;

/// Why a line and what is wanted do not go together.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DesignError {
    /// The slope would end before it begins.
    #[error(
        "the slope would end before it begins\n  --> {label}\n   = {}; `--to-elevation` {end}\n   = help: {}",
        line_against(*.sheet, *.nearest), beyond(*.sheet, *.nearest)
    )]
    WrongSide {
        /// The input.
        label: String,
        /// Which sheet.
        sheet: Sheet,
        /// Highest (lowest, for the rising sheet) elevation of the line.
        nearest: f64,
        /// The end asked for.
        end: f64,
    },
    /// Inside or outside of something that is no ring.
    #[error(
        "`--side {side}` needs rings, and `{chain}` is open\n  --> {at}\n   \
         = help: ask for `left`, `right` or `both`, or close the line with `--closed`"
    )]
    OpenLine {
        /// `inside` or `outside`.
        side: &'static str,
        /// The first open chain.
        chain: String,
        /// Where it stands.
        at: String,
    },
    /// More level curves than [`MOST_LEVELS`], or closer than [`LEAST_INTERVAL`].
    #[error(
        "the interval {interval} is too small\n  --> {label}\n   = {height} from the highest to the lowest; at most {MOST_LEVELS} \
         level curves, at least {LEAST_INTERVAL} apart\n   = help: give `--interval {smallest}` or more"
    )]
    IntervalTooSmall {
        /// The input.
        label: String,
        /// The interval asked for.
        interval: f64,
        /// Height between the highest and the lowest point of the surface.
        height: f64,
        /// Smallest interval that is accepted.
        smallest: f64,
    },
    /// Less high than [`LEAST_DEPTH`].
    #[error(
        "the slope is too low to be one\n  --> {label}\n   = {depth:.1e} high at most; at least {LEAST_DEPTH}\n   = help: end it further away"
    )]
    TooLow {
        /// The input.
        label: String,
        /// Greatest height of the slope over one point of the line.
        depth: f64,
    },
    /// Further than [`FURTHEST_REACH`].
    #[error(
        "the slope would reach too far\n  --> {label}\n   = {reach:.0} in plan and {height:.0} in height, against a limit of \
         {FURTHEST_REACH:.0}\n   = help: end it sooner"
    )]
    TooFar {
        /// The input.
        label: String,
        /// Plan distance.
        reach: f64,
        /// Height.
        height: f64,
    },
    /// More than [`MOST_ARC_POINTS`].
    #[error(
        "the surface would have too many points\n  --> {label}\n   = about {points:.0e} round a single corner, against a limit of \
         {MOST_ARC_POINTS:.0e}\n   = help: raise `--tolerance` ({tolerance}) or `--interval`, or end the slope sooner"
    )]
    TooFine {
        /// The input.
        label: String,
        /// Points expected.
        points: f64,
        /// The tolerance asked for.
        tolerance: f64,
    },
}

fn line_against(sheet: Sheet, nearest: f64) -> String {
    match sheet {
        Sheet::Falling => format!("highest vertex at {nearest}"),
        Sheet::Rising => format!("lowest vertex at {nearest}"),
    }
}

fn beyond(sheet: Sheet, nearest: f64) -> String {
    match sheet {
        Sheet::Falling => format!("a falling slope ends below {nearest}; for one that rises give `--direction up`"),
        Sheet::Rising => format!("a rising slope ends above {nearest}; for one that falls give `--direction down`"),
    }
}

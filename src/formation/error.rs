//! Why there is no formation.

use crate::model::{Defects, digits};

/// Why a line has no formation. `Display` gives the whole message with places and cures, without the leading `error: `.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FormationError {
    /// A width was asked for, and there is no centre line.
    #[error(
        "`--width` needs an open line, the centre line of a road\n  --> {label}\n   = {rings} rings, no open line\n   \
         = help: leave `--width` out, or give the centre line as a line that does not end where it begins"
    )]
    NoCentreLine {
        /// The input.
        label: String,
        /// How many rings it has.
        rings: usize,
    },
    /// Two legs of a centre line lie closer together than the width.
    #[error(
        "the road of `{name}` lies on itself\n  --> {at}\n   = near stations {:.3} and {:.3} the centre line is {distance:.3} apart, \
         the width is {width}\n   = help: {}",
        .stations[0], .stations[1], narrow_cure(*.distance, *.width)
    )]
    Narrow {
        /// Name of the centre line.
        name: String,
        /// Place.
        at: String,
        /// The two stations.
        stations: [f64; 2],
        /// Distance of the centre line from itself between them.
        distance: f64,
        /// The width asked for.
        width: f64,
    },
    /// A centre line turns straight back.
    #[error(
        "the centre line `{name}` runs out and straight back\n  --> {at}\n   = at station {station:.3}\n   \
         = help: take the spike out, or split the line there"
    )]
    TurnsBack {
        /// Name of the centre line.
        name: String,
        /// Place.
        at: String,
        /// Station of the turn.
        station: f64,
    },
    /// A bend leaves no room for an edge on its inside.
    #[error(
        "the road of `{name}` has no inner edge\n  --> {at}\n   = from the bend at station {station:.3} of {length:.3} on, \
         the inside lies within half the width of {width}\n   = help: ease the bend, take small zigzags out of the line, make it \
         longer at its ends, or give a smaller `--width`"
    )]
    NoRoom {
        /// Name of the centre line.
        name: String,
        /// Place.
        at: String,
        /// Station of the bend.
        station: f64,
        /// Length of the centre line.
        length: f64,
        /// The width asked for.
        width: f64,
    },
    /// A ring lies on a road.
    #[error(
        "ring `{ring}` lies inside the road of `{name}`\n  --> {at}\n   = at x {x:.3}, y {y:.3}\n   \
         = help: take one of them out, or build them one by one; for a line that shapes the road, set its `role` to `breakline`"
    )]
    RingInside {
        /// Name of the ring.
        ring: String,
        /// Name of the centre line.
        name: String,
        /// Place of the ring.
        at: String,
        /// Its first vertex.
        x: f64,
        /// Its first vertex.
        y: f64,
    },
    /// A road lies on the platform of a ring, or of another road.
    #[error(
        "the road of `{name}` lies inside {} `{ring}`\n  --> {at}\n   = its edge begins at x {x:.3}, y {y:.3}\n   \
         = help: build them one by one: the ring first, and the road on that as `--terrain` (see `--finished`); for a line that \
         shapes the platform of the ring, set its `role` to `breakline`",
        if *.of_road { "the road of" } else { "ring" }
    )]
    RoadInside {
        /// Name of the centre line.
        name: String,
        /// Whether what it lies on is a road.
        of_road: bool,
        /// Name of the ring, or of the centre line of the road, around it.
        ring: String,
        /// Place of the centre line.
        at: String,
        /// First vertex of its edge.
        x: f64,
        /// First vertex of its edge.
        y: f64,
    },
    /// Rings, those of roads among them, cross; or breaklines have no place.
    #[error(transparent)]
    Invalid(#[from] Defects),
}

fn narrow_cure(distance: f64, width: f64) -> String {
    /// Digits of a suggested width: three, rounded down to less.
    fn down(value: f64) -> f64 {
        let unit = 10_f64.powi(value.log10().floor() as i32 - 2);
        ((value / unit).ceil() - 1.0) * unit
    }
    /// Legs just one width apart touch; legs that cross leave no width at all. Parts of the width.
    const USEFUL: std::ops::Range<f64> = 1e-3..1.0 + 1e-9;
    if USEFUL.contains(&(distance / width)) {
        let most = digits::fixed(down(distance), 3);
        return format!("give `--width` {most} or less, move the legs apart, or build them one by one");
    }
    "move the legs apart, take loops and small zigzags out of the line, or build the legs one by one".to_owned()
}

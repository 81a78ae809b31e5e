//! Alignments: straights, arcs and clothoids in plan, grades and vertical curves in profile, and the polylines that stand for
//! them within a chord error. Numbers only: what a file calls these things is the business of its reader.
//!
//! Plan coordinates are easting and northing; turns to the left (counter-clockwise) are positive. Stations are plan distances.

mod clothoid;
mod element;
mod profile;
mod sample;

pub(super) use element::{Element, Misfit};
pub(super) use profile::{Curve, Profile, ProfileError, Pvi};
pub(super) use sample::{Heights, MOST_POINTS, Piece, TooMany, sample};

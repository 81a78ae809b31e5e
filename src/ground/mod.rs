//! Existing ground and the design together: where the slopes meet the ground, the finished ground, cut and fill.

mod cell;
mod finished;
mod nodes;
mod patch;
mod reach;
mod shape;
mod trimmed;
mod works;

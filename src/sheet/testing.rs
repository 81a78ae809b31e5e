//! What the tests of this folder share.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use super::Segment;
pub(crate) use crate::kernel::testing::Random;

/// Sets of segments with their slope: loose ones, lines that wander, clusters, one straight line, tiny beside huge.
pub(crate) fn sets(random: &mut Random) -> Vec<(f64, Vec<Segment>)> {
    let mut sets = Vec::new();
    for round in 0..36 {
        let k = random.between(0.2, 2.0);
        let count = [1, 2, 5, 40, 700][round % 5];
        let mut segments = Vec::new();
        let mut start = DVec3::ZERO;
        for i in 0..count {
            let (mut length, mut turn) = (random.between(0.1, 20.0), random.between(0.0, TAU));
            match round % 6 {
                0 => start = DVec3::new(random.between(-300.0, 300.0), random.between(-300.0, 300.0), random.between(-9.0, 9.0)),
                1 => turn = 0.3 * (0.05 * f64::from(i)).sin() + random.between(-0.1, 0.1),
                2 if i % 10 == 0 => start += DVec3::new(random.between(-500.0, 500.0), random.between(-500.0, 500.0), 0.0),
                2 => length *= 0.01,
                3 => turn = 0.7,
                4 => length = [1e-4, 1e3][usize::from(i % 7 == 0)],
                _ => {}
            }
            let gradient = k * random.between(-0.98, 0.98) * if round % 4 == 0 { 0.0 } else { 1.0 };
            let end = start + (length * DVec2::from_angle(turn)).extend(length * gradient);
            segments.push(Segment::new(start, end, k));
            start = end;
        }
        sets.push((k, segments));
    }
    sets
}

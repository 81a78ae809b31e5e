//! What the figures of the certificate must be for a mesh to be written.

use crate::report::Certificate;

/// Greatest deviation of a triangle in a planar strip from the slope asked for, in degrees: what rounding leaves.
pub const STRIP_LIMIT_DEG: f64 = 0.01;

/// The same for cone sectors, whose triangles are chords.
pub const SECTOR_LIMIT_DEG: f64 = 0.1;

/// A check that was not passed: figures and limit in words.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct FailedCheck(pub String);

/// The checks a mesh does not pass; none for a mesh that may be written. `tolerance` bounds the heights.
pub fn failed_checks(certificate: &Certificate, tolerance: f64) -> Vec<FailedCheck> {
    let c = certificate;
    // Written so that a figure that is no number fails.
    let within = |value: f64, limit: f64| value <= limit;
    [
        (c.paired, "the facets do not pair along their ridges".to_owned()),
        (c.manifold, "the mesh is not a manifold".to_owned()),
        (c.input_edges_kept, "not every segment of the line is a chain of mesh edges".to_owned()),
        (c.overlaps == 0, format!("{} pairs of triangles overlap in plan", c.overlaps)),
        (
            within(c.height_max_deviation, tolerance),
            format!(
                "heights deviate by up to {:.3e} from the closed form, against a tolerance of {tolerance}",
                c.height_max_deviation
            ),
        ),
        (
            within(c.strip_max_deviation_deg, STRIP_LIMIT_DEG),
            format!(
                "planar strips deviate by up to {:.4}° from the slope, against {STRIP_LIMIT_DEG}°",
                c.strip_max_deviation_deg
            ),
        ),
        (
            within(c.sector_max_deviation_deg, SECTOR_LIMIT_DEG),
            format!(
                "cone sectors deviate by up to {:.4}° from the slope, against {SECTOR_LIMIT_DEG}°",
                c.sector_max_deviation_deg
            ),
        ),
        (
            c.triangles_beyond_0_1deg == 0,
            format!("{} triangles deviate by more than 0.1° from the slope", c.triangles_beyond_0_1deg),
        ),
    ]
    .into_iter()
    .filter(|(passed, _)| !passed)
    .map(|(_, text)| FailedCheck(text))
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: Certificate = Certificate {
        paired: true,
        slope_max_deviation_deg: 0.1,
        strip_max_deviation_deg: 0.01,
        sector_max_deviation_deg: 0.1,
        triangles_beyond_0_1deg: 0,
        height_max_deviation: 0.01,
        manifold: true,
        overlaps: 0,
        input_edges_kept: true,
    };

    #[test]
    fn every_check_counts() {
        assert_eq!(failed_checks(&GOOD, 0.01), []);
        for (bad, part) in [
            (Certificate { paired: false, ..GOOD }, "pair"),
            (Certificate { manifold: false, ..GOOD }, "manifold"),
            (Certificate { input_edges_kept: false, ..GOOD }, "segment"),
            (Certificate { overlaps: 3, ..GOOD }, "3 pairs"),
            (Certificate { height_max_deviation: 0.0101, ..GOOD }, "1.010e-2 from the closed form, against a tolerance of 0.01"),
            (Certificate { height_max_deviation: f64::NAN, ..GOOD }, "NaN"),
            (Certificate { strip_max_deviation_deg: 0.011, ..GOOD }, "0.0110°"),
            (Certificate { sector_max_deviation_deg: 0.11, ..GOOD }, "0.1100°"),
            (Certificate { triangles_beyond_0_1deg: 7, ..GOOD }, "7 triangles"),
        ] {
            let failed = failed_checks(&bad, 0.01);
            assert_eq!(failed.len(), 1, "{failed:?}");
            assert!(failed[0].to_string().contains(part), "{failed:?}");
        }
    }
}

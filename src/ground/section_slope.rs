//! The side slope as other programs prescribe it: seen in a section perpendicular to the line.

use crate::model::{Chain, Line, Slope};

/// Flattest and steepest slope seen in sections.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SectionSlope {
    /// Flattest: where the line is steepest.
    pub min: Slope,
    /// Steepest: where the line is flattest.
    pub max: Slope,
}

/// The slope of the strips of a line in sections perpendicular to their segments: `√(k² − γ²)` for a segment of gradient `γ`.
///
/// The plane of a strip has the slope `k` in the direction of its rulings, which is perpendicular to the line only where that is
/// level. Of its gradient vector, of length `k`, the component along the line is `γ`, so the one across is `√(k² − γ²)`.
/// Segments as steep as the slope have no strip and are passed over, and so are the ends of roads, which lie across their axis;
/// `None` if there is no other. Sectors at corners have no section.
pub fn section_slope(line: &Line, slope: Slope) -> Option<SectionSlope> {
    let k = slope.ratio();
    let across_axis = |chain: &Chain, i: usize| {
        let stations = chain.axis.as_ref().map_or(&[][..], |axis| &axis.stations);
        stations.get(i).zip(stations.get(i + 1)).is_some_and(|(from, to)| from == to)
    };
    let along = |chain: &'_ Chain| (0..chain.segment_count()).filter(|&i| !across_axis(chain, i)).collect::<Vec<_>>();
    let segments = line.chains.iter().flat_map(|chain| along(chain).into_iter().map(|i| chain.segment(i)));
    let mut found: Option<SectionSlope> = None;
    for (a, b) in segments {
        let gradient = (b.z - a.z) / a.truncate().distance(b.truncate());
        // As a product: k² − γ² loses digits when both are near each other.
        let Some(across) = Slope::from_ratio(((k - gradient) * (k + gradient)).max(0.0).sqrt()) else { continue };
        let so_far = found.unwrap_or(SectionSlope { min: across, max: across });
        found = Some(SectionSlope {
            min: if across < so_far.min { across } else { so_far.min },
            max: if across > so_far.max { across } else { so_far.max },
        });
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Axis, Place, Role};
    use glam::DVec3;

    fn line(vertices: &[(f64, f64, f64)], role: Role) -> Line {
        let vertices: Vec<DVec3> = vertices.iter().map(|&v| v.into()).collect();
        let places = vec![Place::default(); vertices.len()];
        Line { chains: vec![Chain { name: "a".into(), role, vertices, places, axis: None }], ..Line::default() }
    }

    /// Slope 0.5: level gives 0.5; a gradient of 0.3 gives √(0.25 − 0.09) = 0.4; one of 0.14 gives 0.48.
    #[test]
    fn pythagorean_gradients() {
        let slope = Slope::from_ratio(0.5).unwrap();
        let open = line(&[(0.0, 0.0, 0.0), (30.0, 40.0, -15.0), (80.0, 40.0, -15.0), (80.0, 90.0, -8.0)], Role::Open);
        let found = section_slope(&open, slope).unwrap();
        assert!((found.min.ratio() - 0.4).abs() < 1e-15 && found.max == slope);
        let steep = line(&[(0.0, 0.0, 0.0), (50.0, 0.0, 7.0)], Role::Open);
        let found = section_slope(&steep, slope).unwrap();
        assert!((found.min.ratio() - 0.48).abs() < 1e-15 && found.min == found.max);
    }

    #[test]
    fn the_closing_segment_counts() {
        let ring = Role::Outer { polygon: 0 };
        let vertices = [(0.0, 0.0, 0.0), (40.0, 0.0, 0.0), (40.0, 30.0, 15.0)];
        // Gradients 0, 0.5 and 15/50 = 0.3: across, 1, √0.75 and √0.91.
        let found = section_slope(&line(&vertices, ring), Slope::from_ratio(1.0).unwrap()).unwrap();
        assert!((found.min.ratio() - 0.75f64.sqrt()).abs() < 1e-15 && found.max.ratio() == 1.0);
    }

    /// A road 8 wide on a grade of 0.1, its ends with a crossfall of 0.3: of slopes of 0.5 a section shows √(0.25 − 0.01) only, not
    /// √(0.25 − 0.09) = 0.4.
    #[test]
    fn ends_of_roads_have_no_section() {
        let vertices = [(0.0, 4.0, 0.0), (50.0, 4.0, 5.0), (50.0, -4.0, 7.4), (0.0, -4.0, 2.4)];
        let mut road = line(&vertices, Role::Outer { polygon: 0 });
        let stations = vec![0.0, 50.0, 50.0, 0.0, 0.0];
        road.chains[0].axis = Some(Axis { name: "a".into(), length: 50.0, stations, sagitta: 0.0 });
        let found = section_slope(&road, Slope::from_ratio(0.5).unwrap()).unwrap();
        assert!((found.min.ratio() - 0.24_f64.sqrt()).abs() < 1e-15 && found.min == found.max, "{found:?}");
    }

    #[test]
    fn segments_without_a_strip() {
        let up = line(&[(0.0, 0.0, 0.0), (10.0, 0.0, 5.0), (20.0, 0.0, 15.0)], Role::Open);
        assert_eq!(section_slope(&up, Slope::from_ratio(0.5).unwrap()), None);
        assert_eq!(section_slope(&Line::default(), Slope::from_ratio(0.5).unwrap()), None);
    }
}

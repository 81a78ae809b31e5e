//! Readers of ground.

use super::choices::Choices;
use super::messages::telling;
use super::written;
use glam::{DVec2, DVec3};
use slopegen::model::LengthUnit;
use slopegen::read::terrain::{RawFaces, RawGround, RawTerrain, TerrainOptions, parse_terrain};
use slopegen::read::{ColumnOrder, InputFormat, Pick};
use slopegen::terrain;
use slopegen::validate::INPUT_LIMIT;

/// Column orders to choose from; the first: none.
const ORDERS: [&str; 6] = ["", "xyz", "yxz", "pnezd", "enz", "xy"];

/// The first bytes are options, the rest is the file.
pub(crate) fn read(bytes: &[u8], format: InputFormat) {
    let mut choices = Choices::new(bytes);
    let flags = choices.byte();
    let csv_order: Option<ColumnOrder> = choices.of(&ORDERS).parse().ok();
    let pick = match format {
        InputFormat::LandXml => Pick { surface: (flags & 1 != 0).then(|| "a".to_owned()), ..Pick::default() },
        InputFormat::Dxf => Pick { layers: if flags & 1 != 0 { vec!["0".to_owned()] } else { Vec::new() }, ..Pick::default() },
        InputFormat::Las => Pick { classes: if flags & 1 != 0 { vec![0, 1, 2] } else { Vec::new() }, ..Pick::default() },
        _ => Pick::default(),
    };
    let unit =
        [None, Some(LengthUnit::Metre), Some(LengthUnit::Foot), Some(LengthUnit::UsSurveyFoot)][usize::from(flags >> 2 & 3)];
    // Without a format, it is told from the content.
    let format = Some(format).filter(|_| flags & 16 == 0);
    match parse_terrain("a", choices.rest(), &TerrainOptions { format, csv_order, pick, unit, ..TerrainOptions::default() }) {
        Err(error) => telling(&error.to_string()),
        Ok(raw) => look(raw, choices.rest()),
    }
}

fn look(raw: RawTerrain, file: &[u8]) {
    assert_eq!(raw.source.bytes, file.len() as u64);
    match &raw.ground {
        RawGround::Mesh { vertices, faces } => {
            assert!(vertices.iter().all(|v| v.is_finite()));
            assert!(!faces.is_empty(), "nothing was read, and nothing said");
            let corners = match faces {
                RawFaces::Triangles(triangles) => triangles.as_flattened(),
                RawFaces::Polygons { corners, ends } => {
                    assert!(ends.is_sorted() && ends.last() == Some(&corners.len()));
                    corners
                }
            };
            assert!(corners.iter().all(|&v| (v as usize) < vertices.len()));
        }
        RawGround::Points(points) => assert!(!points.is_empty() && points.iter().all(|p| p.is_finite())),
        RawGround::Grid(grid) => {
            assert_eq!(grid.heights.len(), grid.columns * grid.rows);
            assert!(grid.origin.is_finite() && grid.step.is_finite() && grid.step.min_element() > 0.0);
            assert!(!grid.heights.iter().any(|z| z.is_infinite()));
        }
    }
    match terrain::prepare(raw) {
        Err(defects) => telling(&defects.to_string()),
        Ok(prepared) => {
            let ground = prepared.terrain;
            assert!(!ground.triangles.is_empty());
            let plan = |v: DVec3| -> DVec2 { v.truncate() };
            for t in 0..ground.triangles.len() {
                let corners = ground.corners(t);
                assert!(corners.iter().all(|v| ground.frame.to_world(*v).abs().max_element() <= INPUT_LIMIT), "{corners:?}");
                let [a, b, c] = corners.map(plan);
                // The sign is exact in the program; here, what rounding can turn is left out.
                let (across, size) = ((b - a).perp_dot(c - a), (b - a).length() * (c - a).length());
                assert!(across > -4.0 * f64::EPSILON * size, "turned: {corners:?}");
            }
            written::ground_again(&ground);
        }
    }
}

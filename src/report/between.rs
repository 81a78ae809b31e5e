//! The report of `slopegen volume`: two surfaces, or a surface and a plane.

use super::model::{Input, Tool, Units, Warning};
use super::volumes::Balance;
use crate::overlay::{Areas, Between, Depth};
use serde::Serialize;

/// Everything a comparison has to tell. Keys that mean the same as in [`super::Report`] have the same names.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BetweenReport {
    /// [`super::SCHEMA`].
    pub schema: &'static str,
    /// The program.
    pub tool: Tool,
    /// The files read: `design`, `existing`, `within`.
    pub inputs: Vec<Input>,
    /// Units of the figures.
    pub units: Units,
    /// The meshes compared.
    pub meshes: Vec<MeshFigures>,
    /// Cut and fill.
    pub volumes: BetweenVolumes,
    /// Plan areas.
    pub areas: BetweenAreas,
    /// Greatest depths.
    pub depths: BetweenDepths,
    /// What the reader should know.
    pub warnings: Vec<Warning>,
    /// Seconds spent. The one part that differs from run to run.
    pub timing: BetweenTiming,
}

/// A mesh as read.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MeshFigures {
    /// `design` or `existing`.
    pub role: &'static str,
    /// Its vertices.
    pub vertices: usize,
    /// Its triangles.
    pub triangles: usize,
}

/// Cut and fill.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BetweenVolumes {
    /// `prisms`: exact for the triangles given.
    pub method: &'static str,
    /// Volume to be dug away; not negative.
    pub cut: f64,
    /// Volume to be brought; not negative.
    pub fill: f64,
    /// `cut − fill`.
    pub net: f64,
    /// The sign of `net` in a word.
    pub balance: Balance,
    /// Prisms summed up: cells of the common refinement; none against a plane.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cells: Option<usize>,
    /// What the volumes are taken against.
    pub reference: BetweenReference,
}

/// What the volumes are taken against.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum BetweenReference {
    /// The existing surface of a file.
    Terrain {
        /// Its path as given.
        path: String,
    },
    /// A horizontal plane, to which the existing surface is brought.
    Plane {
        /// Its elevation.
        elevation: f64,
    },
}

/// Plan areas; not negative.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct BetweenAreas {
    /// Where the existing surface is higher.
    pub cut: f64,
    /// Where the design is higher.
    pub fill: f64,
    /// Where both are the same.
    pub unaffected: f64,
    /// Design that does not lie over the existing surface: not in the volumes.
    pub uncovered: f64,
    /// Existing surface not under the design.
    pub existing_uncovered: f64,
    /// Area of the rings the comparison was restricted to.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub within: Option<f64>,
}

impl From<Areas> for BetweenAreas {
    fn from(a: Areas) -> Self {
        Self {
            cut: a.cut,
            fill: a.fill,
            unaffected: a.unaffected,
            uncovered: a.design_uncovered,
            existing_uncovered: a.existing_uncovered,
            within: a.within,
        }
    }
}

/// Greatest vertical depths, not negative, and where they are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct BetweenDepths {
    /// Of cut.
    pub cut_max: f64,
    /// Of fill.
    pub fill_max: f64,
    /// Where that of cut is found.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cut_max_at: Option<Spot>,
    /// Where that of fill is found.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fill_max_at: Option<Spot>,
}

/// A point of the design, in world coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Spot {
    /// Easting.
    pub x: f64,
    /// Northing.
    pub y: f64,
    /// Elevation.
    pub z: f64,
}

impl From<&Between> for BetweenDepths {
    fn from(b: &Between) -> Self {
        let depth = |d: Option<Depth>| d.map_or(0.0, |d| d.depth);
        let spot = |d: Option<Depth>| d.map(|d| Spot { x: d.place.x, y: d.place.y, z: d.place.z });
        Self {
            cut_max: depth(b.deepest_cut),
            fill_max: depth(b.deepest_fill),
            cut_max_at: spot(b.deepest_cut),
            fill_max_at: spot(b.deepest_fill),
        }
    }
}

/// Seconds spent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct BetweenTiming {
    /// Reading and checking.
    pub read: f64,
    /// Areas and volumes.
    pub volume: f64,
    /// All of it, up to the report.
    pub total: f64,
}

/// For tests: a report with every key, or with as few as there can be.
#[cfg(test)]
pub(super) mod testing {
    use super::*;
    use std::collections::BTreeMap;

    pub(crate) fn full() -> BetweenReport {
        let input = |role: &str, path: &str, format: &str| Input {
            role: role.into(),
            path: path.into(),
            sha256: "9f86d081884c7d659a2feaa0c55ad015a3bf4f1b2b0b822cd15d6c15b0f00a08".into(),
            format: format.into(),
            crs: None,
        };
        BetweenReport {
            schema: crate::report::SCHEMA,
            tool: Tool { name: "slopegen", version: "0.0.0" },
            inputs: vec![
                input("design", "out/road.obj", "obj"),
                input("existing", "site/ground.ply", "ply"),
                input("within", "lot.geojson", "geojson"),
            ],
            units: Units::default(),
            meshes: vec![
                MeshFigures { role: "design", vertices: 1200, triangles: 2100 },
                MeshFigures { role: "existing", vertices: 500_000, triangles: 999_990 },
            ],
            volumes: BetweenVolumes {
                method: "prisms",
                cut: 7395.802,
                fill: 11_623.03,
                net: 7395.802 - 11_623.03,
                balance: Balance::of(7395.802, 11_623.03),
                cells: Some(12_345),
                reference: BetweenReference::Terrain { path: "site/ground.ply".into() },
            },
            areas: BetweenAreas {
                cut: 4956.81,
                fill: 7013.9,
                unaffected: 12.5,
                uncovered: 3.25,
                existing_uncovered: 1000.0,
                within: Some(15_000.0),
            },
            depths: BetweenDepths {
                cut_max: 2.5,
                fill_max: 4.75,
                cut_max_at: Some(Spot { x: 500_010.5, y: 5_400_020.25, z: 31.5 }),
                fill_max_at: Some(Spot { x: 500_110.5, y: 5_400_120.25, z: 27.5 }),
            },
            warnings: vec![Warning {
                code: "design-uncovered".into(),
                message: "3.25 square units of the design do not lie over the existing surface".into(),
                details: BTreeMap::new(),
            }],
            timing: BetweenTiming { read: 0.125, volume: 0.5, total: 0.75 },
        }
    }

    pub(crate) fn least() -> BetweenReport {
        let mut report = full();
        report.inputs.truncate(1);
        report.meshes.truncate(1);
        report.volumes.cells = None;
        report.volumes.reference = BetweenReference::Plane { elevation: 30.5 };
        report.areas = BetweenAreas { cut: 1.0, ..BetweenAreas::default() };
        report.depths = BetweenDepths::default();
        report.warnings.clear();
        report
    }
}

//! The report of `slopegen volume`: two surfaces, or a surface and a plane.

use super::SCHEMA;
use super::common::{Input, Tool, Units, Warning};
use super::result::{ResultFigures, RunRecord};
use super::volumes::{Balance, METHOD, METHOD_TEXT, SIGN_RULE, mean};
use crate::overlay::{Areas, Between, Depth};
use schemars::JsonSchema;
use serde::Serialize;

/// The report of `slopegen volume`. Keys that mean the same as in the report of `build` have the same names.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[schemars(rename = "VolumeReport")]
pub struct BetweenReport {
    /// Name of the schema.
    #[schemars(extend("const" = SCHEMA))]
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
    /// What was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub run: Option<RunRecord>,
    /// Hashes of what came out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub result: Option<ResultFigures>,
    /// Seconds spent. The one part that differs from run to run.
    pub timing: BetweenTiming,
}

/// A mesh as read.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct MeshFigures {
    /// What it was read for.
    #[schemars(extend("enum" = ["design", "existing"]))]
    pub role: &'static str,
    /// Vertices of the mesh.
    pub vertices: usize,
    /// Triangles of the mesh.
    pub triangles: usize,
    /// Lowest elevation.
    pub z_min: f64,
    /// Highest elevation.
    pub z_max: f64,
    /// Area in plan.
    #[schemars(range(min = 0))]
    pub plan_area: f64,
    /// Area of the surface, measured in its triangles.
    #[schemars(range(min = 0))]
    pub surface_area: f64,
}

/// Cut and fill between two surfaces.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[schemars(rename = "ComparedVolumes")]
pub struct BetweenVolumes {
    /// How they were computed; `prisms`: exact for the triangles given.
    #[schemars(extend("const" = METHOD))]
    pub method: &'static str,
    /// The method in words.
    #[schemars(extend("const" = METHOD_TEXT))]
    pub method_text: &'static str,
    /// Volume to be dug away; not negative.
    #[schemars(range(min = 0))]
    pub cut: f64,
    /// Volume to be brought; not negative.
    #[schemars(range(min = 0))]
    pub fill: f64,
    /// `cut − fill`: see `sign_rule`.
    pub net: f64,
    /// What the sign of `net` says.
    #[schemars(extend("const" = SIGN_RULE))]
    pub sign_rule: &'static str,
    /// The sign of `net` in a word.
    pub balance: Balance,
    /// Whether all of the design lies over the existing surface; what does not has no volume: see `areas.uncovered`.
    pub complete: bool,
    /// Prisms summed up: cells of the common refinement; none against a plane.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cells: Option<usize>,
    /// What the volumes are taken against.
    pub reference: BetweenReference,
}

/// What the volumes are taken against.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case")]
#[schemars(rename = "ComparedReference")]
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
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, JsonSchema)]
#[schemars(rename = "ComparedAreas")]
pub struct BetweenAreas {
    /// Area where the existing surface is higher.
    #[schemars(range(min = 0))]
    pub cut: f64,
    /// Area where the design is higher.
    #[schemars(range(min = 0))]
    pub fill: f64,
    /// Area where both are the same.
    #[schemars(range(min = 0))]
    pub unaffected: f64,
    /// Area of the design that does not lie over the existing surface: not in the volumes.
    #[schemars(range(min = 0))]
    pub uncovered: f64,
    /// Area of the existing surface not under the design.
    #[schemars(range(min = 0))]
    pub existing_uncovered: f64,
    /// Area of the rings the comparison was restricted to.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0))]
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
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, JsonSchema)]
#[schemars(rename = "ComparedDepths")]
pub struct BetweenDepths {
    /// Greatest depth of cut.
    #[schemars(range(min = 0))]
    pub cut_max: f64,
    /// Greatest depth of fill.
    #[schemars(range(min = 0))]
    pub fill_max: f64,
    /// Mean depth of cut: its volume over its area; left out where there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0))]
    pub cut_mean: Option<f64>,
    /// Mean depth of fill: its volume over its area; left out where there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0))]
    pub fill_mean: Option<f64>,
    /// Where the greatest depth of cut is found.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cut_max_at: Option<Spot>,
    /// Where the greatest depth of fill is found.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fill_max_at: Option<Spot>,
}

/// A point of the design, in world coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
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
            cut_mean: mean(b.cut, b.areas.cut),
            fill_mean: mean(b.fill, b.areas.fill),
            cut_max_at: spot(b.deepest_cut),
            fill_max_at: spot(b.deepest_fill),
        }
    }
}

/// Seconds spent. The one part that differs from run to run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, JsonSchema)]
#[schemars(rename = "ComparedTiming")]
pub struct BetweenTiming {
    /// Reading and checking.
    #[schemars(range(min = 0))]
    pub read: f64,
    /// Areas and volumes.
    #[schemars(range(min = 0))]
    pub volume: f64,
    /// All of it, up to the report.
    #[schemars(range(min = 0))]
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
            bytes: 12_345,
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
                MeshFigures {
                    role: "design",
                    vertices: 1200,
                    triangles: 2100,
                    z_min: 24.5,
                    z_max: 33.25,
                    plan_area: 11_986.46,
                    surface_area: 12_345.5,
                },
                MeshFigures {
                    role: "existing",
                    vertices: 500_000,
                    triangles: 999_990,
                    z_min: -3.0,
                    z_max: 61.5,
                    plan_area: 12_983.21,
                    surface_area: 13_000.0,
                },
            ],
            volumes: BetweenVolumes {
                method: METHOD,
                method_text: METHOD_TEXT,
                cut: 7395.802,
                fill: 11_623.03,
                net: 7395.802 - 11_623.03,
                sign_rule: SIGN_RULE,
                balance: Balance::of(7395.802, 11_623.03),
                complete: false,
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
                cut_mean: mean(7395.802, 4956.81),
                fill_mean: mean(11_623.03, 7013.9),
                cut_max_at: Some(Spot { x: 500_010.5, y: 5_400_020.25, z: 31.5 }),
                fill_max_at: Some(Spot { x: 500_110.5, y: 5_400_120.25, z: 27.5 }),
            },
            warnings: vec![Warning {
                code: "design-uncovered".into(),
                kind: crate::report::WarningKind::Warning,
                message: "3.25 square units of the design do not lie over the existing surface".into(),
                details: BTreeMap::new(),
            }],
            run: Some(crate::report::result::testing::run("volume")),
            result: Some(crate::report::result::testing::result(false)),
            timing: BetweenTiming { read: 0.125, volume: 0.5, total: 0.75 },
        }
    }

    pub(crate) fn least() -> BetweenReport {
        let mut report = full();
        report.inputs.truncate(1);
        report.meshes.truncate(1);
        report.volumes.cells = None;
        report.volumes.complete = true;
        report.volumes.reference = BetweenReference::Plane { elevation: 30.5 };
        report.areas = BetweenAreas { cut: 1.0, ..BetweenAreas::default() };
        report.depths = BetweenDepths::default();
        report.warnings.clear();
        (report.run, report.result) = (None, None);
        report
    }
}

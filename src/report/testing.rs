//! For tests: reports filled by hand.

use super::*;
use crate::model::{Extent, Slope};

/// A report with every key.
pub(super) fn full() -> Report {
    let slope = |ratio| Slope::from_ratio(ratio).map(SlopeFigures::from);
    let buried = |chain: &str, from, to, depth, free_slope| BuriedStretch {
        chain: chain.into(),
        from,
        to,
        depth,
        by_chain: "Rampe süd".into(),
        by_station: 1234.5,
        free_slope,
    };
    Report {
        schema: SCHEMA,
        tool: Tool { name: "slopegen", version: "0.0.0" },
        inputs: vec![Input {
            role: "line".into(),
            path: "site/road.geojson".into(),
            sha256: "9f86d081884c7d659a2feaa0c55ad015a3bf4f1b2b0b822cd15d6c15b0f00a08".into(),
            format: "geojson".into(),
            crs: Some("EPSG:25832".into()),
        }],
        units: Units::default(),
        slopes: Slopes { cut: slope(1.0), fill: slope(1.0 / 1.5) },
        line: LineFigures {
            chains: 2,
            vertices: 1200,
            simplified: 300,
            simplified_max: 0.0031,
            length: 2345.678,
            width: None,
            crossfall: None,
            breaklines: 0,
            z_min: 398.5,
            z_max: 431.25,
            gradient_max: 0.0825,
            buried: vec![buried("line 1", 0.0, 12.5, 0.75, Some(0.8)), buried("Rampe süd", 1010.125, 1100.0, 13.0, None)],
        },
        extent: Extent::Elevation(390.0).into(),
        levels: vec![392.0, 394.0, 396.0, 398.0],
        surface: SurfaceFigures {
            vertices: 54_321,
            triangles: 98_765,
            plan_area: 123_456.789,
            slope_area: 100_000.5,
            fill_slope_area: 80_000.25,
            cut_slope_area: 20_000.25,
            platform_area: 40_000.0,
        },
        certificate: Certificate {
            paired: true,
            slope_max_deviation_deg: 0.0412,
            strip_max_deviation_deg: 1.3e-6,
            sector_max_deviation_deg: 0.0412,
            triangles_beyond_0_1deg: 0,
            height_max_deviation: 0.0043,
            manifold: true,
            overlaps: 0,
            input_edges_kept: true,
        },
        volumes: Some(Volumes {
            method: "prisms".into(),
            cut: 0.0,
            fill: 1_234_567.891,
            net: -1_234_567.891,
            balance: Balance::of(0.0, 1_234_567.891),
            error_bound: 81.5,
            complete: true,
            reference: Reference { kind: "plane".into(), elevation: Some(390.0) },
        }),
        depths: Some(Depths { cut_max: 0.0, fill_max: 41.25 }),
        warnings: vec![Warning {
            code: "buried".into(),
            message: "2 stretches of the line lie under the slope of another part".into(),
            details: [("count", Detail::Count(2)), ("depth", Detail::Number(13.0)), ("chain", Detail::Text("Rampe süd".into()))]
                .into_iter()
                .collect(),
        }],
        timing: Timing { read: 0.001, surface: 0.25, volume: 0.002, write: 0.0625, total: 0.3155 },
    }
}

/// A report with no key more than needed.
pub(super) fn least() -> Report {
    let mut report = full();
    report.inputs[0].crs = None;
    report.slopes.cut = None;
    report.line.buried.clear();
    (report.line.simplified, report.line.simplified_max) = (0, 0.0);
    report.line.chains = 1;
    report.levels.clear();
    report.extent = Extent::Distance(12.5).into();
    (report.volumes, report.depths) = (None, None);
    report.warnings.clear();
    report
}

/// Compares with a golden file under `tests/golden`; with `UPDATE_GOLDEN` set writes it instead.
pub(super) fn compare(actual: &str, golden: &str, name: &str) {
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        std::fs::write(format!("{}/tests/golden/{name}", env!("CARGO_MANIFEST_DIR")), actual).unwrap();
    } else {
        assert_eq!(actual, golden, "tests/golden/{name}; after a change that is meant run the test with UPDATE_GOLDEN=1");
    }
}

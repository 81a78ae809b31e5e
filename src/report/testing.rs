//! For tests: reports filled by hand.

use super::*;
use crate::ground::{Axis, Corner, Piece, Sections, Stations, Tally};
use crate::kernel::frame::Frame;
use crate::model::{Bulking, Extent, Part, Slope};
use glam::DVec2;

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
            bytes: 123_456,
            sha256: "9f86d081884c7d659a2feaa0c55ad015a3bf4f1b2b0b822cd15d6c15b0f00a08".into(),
            format: "geojson".into(),
            crs: Some("EPSG:25832".into()),
        }],
        units: Units::default(),
        design: DesignFigures { tolerance: 0.01, interval: Some(2.0) },
        slopes: Slopes { cut: slope(1.0), fill: slope(1.0 / 1.5), ..Slopes::default() },
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
            method: METHOD,
            method_text: METHOD_TEXT,
            cut: 0.0,
            fill: 1_234_567.891,
            net: -1_234_567.891,
            sign_rule: SIGN_RULE,
            balance: Balance::of(0.0, 1_234_567.891),
            error_bound: 81.5,
            complete: true,
            reference: Reference::plane(390.0),
            parts: None,
            bulking: None,
            end_area: None,
            prismoidal: None,
        }),
        areas: None,
        depths: Some(Depths { cut_max: 0.0, fill_max: 41.25, ..Depths::default() }),
        daylight: None,
        stations: None,
        pads: None,
        section_slope: None,
        terrain: None,
        finished: None,
        warnings: vec![Warning {
            code: "buried".into(),
            kind: crate::report::WarningKind::Warning,
            message: "2 stretches of the line lie under the slope of another part".into(),
            details: [("count", Detail::Count(2)), ("depth", Detail::Number(13.0)), ("chain", Detail::Text("Rampe süd".into()))]
                .into_iter()
                .collect(),
        }],
        run: Some(crate::report::result::testing::run("build")),
        result: Some(crate::report::result::testing::result(true)),
        timing: Timing { read: 0.001, terrain: None, surface: 0.25, volume: 0.002, write: 0.0625, total: 0.3155 },
    }
}

/// A report on a road of 50 in two kinds of ground, with every key that needs existing ground. Figures from a platform
/// 10 wide that rises against the ground from −1 to 1.5, a side slope of which only the fill counts, and a pad apart.
pub(super) fn on_ground() -> Report {
    let mut report = full();
    let stations = Stations::new(vec![axis()], Some(20.0)).unwrap();
    let (mut tally, mut sections) = (Tally::new(&stations), Sections::new(&stations));
    let mut add = |part, axis, [x0, x1]: [f64; 2], [y0, y1]: [f64; 2]| {
        let corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)];
        let corners = corners.map(|at| Corner { at: at.into(), height: at.0 / 20.0 - 1.0, station: at.0 });
        let piece = Piece { part, axis, corners: &corners };
        tally.add(&piece);
        sections.add(&piece);
    };
    add(Part::Platform, Some(0), [0.0, 50.0], [-5.0, 5.0]);
    add(Part::FillSlope, Some(0), [20.0, 50.0], [5.0, 7.0]);
    add(Part::Platform, None, [70.0, 75.0], [-1.0, 1.0]);
    let (tallied, sections) = (tally.finish(), sections.finish());
    let soil = Bulking::new(0.25, 0.1).unwrap();
    let total = tallied.total;
    report.inputs.push(Input {
        role: "terrain".into(),
        path: "site/ground.obj".into(),
        format: "obj".into(),
        crs: None,
        ..report.inputs[0].clone()
    });
    report.extent = ExtentFigures::GROUND;
    report.volumes = Some(Volumes {
        cut: total.cut,
        fill: total.fill,
        net: total.net(),
        sign_rule: SIGN_RULE,
        balance: Balance::of(total.cut, total.fill),
        error_bound: 0.5,
        complete: false,
        reference: Reference::terrain("site/ground.obj"),
        parts: Some(VolumeParts::of(&tallied)),
        bulking: Some(BulkingFigures::of(total.cut, total.fill, soil)),
        end_area: Some(sections.average_end_area.into()),
        prismoidal: Some(sections.prismoidal.into()),
        method: METHOD,
        method_text: METHOD_TEXT,
    });
    report.areas = Some(GroundAreas { cut: total.cut_area, fill: total.fill_area, unaffected: 4_000_000.0 });
    let mut depths = Depths::of(&tallied, &stations, Frame::WORLD);
    depths.fill_max_at.as_mut().unwrap().z = Some(400.5);
    report.depths = Some(depths);
    report.daylight = Some(Daylight { loops: 3, length: 120.5, open_length: 12.25, cut_length: 50.25, fill_length: 70.25 });
    report.stations = Some(station_rows(&stations, &tallied, Some(&sections), Some(soil)));
    report.pads = Some(tallied.pads.into());
    let range = |min, max| Some(SlopeRange { min: SlopeFigures::from(Slope::from_ratio(min).unwrap()), max });
    report.section_slope =
        Some(SectionSlopes { cut: range(0.98, report.slopes.cut.unwrap()), fill: range(1.0 / 1.5, report.slopes.fill.unwrap()) });
    report.terrain =
        Some(TerrainFigures { vertices: 1_000_000, triangles: 1_998_000, triangles_used: 4321, z_min: 380.0, z_max: 455.125 });
    report.finished = Some(FinishedFigures { vertices: 1_012_345, triangles: 2_022_690 });
    report.timing.terrain = Some(0.75);
    report
}

fn axis() -> Axis {
    Axis { name: "road".into(), length: 50.0, closed: false, line: vec![(DVec2::ZERO, 0.0), (DVec2::new(50.0, 0.0), 50.0)] }
}

/// A report with no key more than needed.
pub(super) fn least() -> Report {
    let mut report = full();
    report.inputs[0].crs = None;
    report.slopes.cut = None;
    report.design.interval = None;
    report.line.buried.clear();
    (report.line.simplified, report.line.simplified_max) = (0, 0.0);
    report.line.chains = 1;
    report.levels.clear();
    report.extent = Extent::Distance(12.5).into();
    (report.volumes, report.depths) = (None, None);
    report.warnings.clear();
    (report.run, report.result) = (None, None);
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

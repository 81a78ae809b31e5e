use super::*;
use crate::mesh::quality::{Bound, Kind, Mesh, Options, examine};
use crate::model::Slope;
use std::collections::BTreeMap;

/// Two slopes of 1V:2H over a level floor, one of which has a corner lifted; a triangle above, one twice, one upright.
pub(in crate::report) fn report() -> CheckReport {
    let corners = [
        (0.0, 0.0, 1.0),
        (10.0, 0.0, 1.0),
        (10.0, 4.0, 3.0),
        (0.0, 4.0, 3.0),
        (10.0, -5.0, 1.0),
        (0.0, -5.0, 1.0),
        (2.0, 1.0, 9.0),
        (3.0, 1.0, 9.0),
        (2.0, 2.0, 9.5),
    ];
    let vertices: Vec<DVec3> = corners.iter().map(|&(x, y, z)| DVec3::new(500_000.0 + x, 5_400_000.0 + y, z)).collect();
    let triangles = [[0, 1, 2], [0, 2, 3], [0, 5, 4], [0, 4, 1], [6, 7, 8], [0, 1, 2]];
    let names = ["fill_slope".to_owned(), "platform\u{1b}".to_owned()];
    let bound = Bound { slope: Slope::from_ratio(0.5).unwrap(), tolerance_deg: 0.1, most_off: 0.05, groups: Some(vec![0]) };
    let options = Options { gap: None, places: 2, bound: Some(bound) };
    let mesh = Mesh { vertices: &vertices, triangles: &triangles, faces: &[], groups: &[0, 0, 1, 1, 0, 0], names: &names };
    let quality = examine(&mesh, &options);
    let checked = Checked { vertices: 9, faces: 6, triangles: 6, names: &names, options: &options };
    let input = Input {
        role: "mesh".into(),
        path: "site/design.obj".into(),
        bytes: 4321,
        sha256: "9f86d081884c7d659a2feaa0c55ad015a3bf4f1b2b0b822cd15d6c15b0f00a08".into(),
        format: "obj".into(),
        crs: None,
    };
    let note = Warning::of(&crate::model::Note::new("obj-lines-ignored", "3 lines\nx"), BTreeMap::new());
    let mut report = CheckReport::new(input, &checked, &quality, vec![note]);
    report.tool.version = "0.0.0";
    report
}

fn written(format: ReportFormat, report: &CheckReport) -> String {
    let mut bytes = Vec::new();
    format.write_check(&mut bytes, report).unwrap();
    String::from_utf8(bytes).unwrap()
}

#[test]
fn all_forms_are_pinned() {
    let report = report();
    crate::report::testing::compare(
        &written(ReportFormat::Json, &report),
        include_str!("../../../tests/golden/check.json"),
        "check.json",
    );
    crate::report::testing::compare(
        &written(ReportFormat::Text, &report),
        include_str!("../../../tests/golden/check.txt"),
        "check.txt",
    );
    crate::report::testing::compare(
        &written(ReportFormat::Markdown, &report),
        include_str!("../../../tests/golden/check.md"),
        "check.md",
    );
}

#[test]
fn figures_are_those_of_the_mesh() {
    let report = report();
    assert_eq!(report.verdict, Verdict { passed: false, sound: false, slope_kept: Some(true) });
    let found: Vec<(&str, usize)> = report.findings.iter().map(|f| (f.code, f.count)).collect();
    // The triangle above lies across the diagonal of the slope.
    assert_eq!(found, [("duplicate", 1), ("overlap", 2), ("pieces", 2)]);
    // The slopes: 10 by 4 in plan, and half a square above it; the floor: 10 by 5.
    assert!((report.parts[0].slopes.plan_area - 40.5).abs() < 1e-9 && (report.parts[1].slopes.plan_area - 50.0).abs() < 1e-9);
    let bound = report.slope_bound.unwrap();
    assert_eq!((bound.within.triangles, bound.off.triangles, bound.parts), (3, 0, vec!["fill_slope".to_owned()]));
    assert!((bound.within.area - 40.5 * 1.25_f64.sqrt()).abs() < 1e-9);
    // Around floor and slopes 10 by 9, around the triangle above 2 + √2.
    assert!((report.boundary.length - 38.0 - 2.0 - 2_f64.sqrt()).abs() < 1e-9);
    assert_eq!(report.boundary.loops.iter().map(|l| (l.kind, l.edges)).collect::<Vec<_>>(), [("outer", 6), ("outer", 3)]);
}

#[test]
fn nothing_in_the_text_moves_the_cursor() {
    assert!(written(ReportFormat::Text, &report()).chars().all(|c| c == '\n' || !c.is_control()));
}

#[test]
fn all_codes_are_documented() {
    let document = include_str!("../../../docs/report.md");
    for kind in Kind::ALL {
        assert!(document.contains(&format!("| `{}` |", kind.code())), "docs/report.md does not list `{}`", kind.code());
    }
}

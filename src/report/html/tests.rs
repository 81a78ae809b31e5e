//! Pages of reports filled by hand, about a small scene; `tests/html.rs` opens real ones.

use super::view::view;
use super::{between, build, check};
use crate::kernel::frame::Frame;
use crate::model::{Chain, CurveKind, LengthUnit, Line, LineFeature, Part, Place, Role, Tin};
use crate::plot::Scene;
use crate::report::Report;
use crate::report::testing::{full, least, on_ground};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use glam::{DVec2, DVec3};
use serde_json::Value;

/// A platform of 20 × 10 with a slope along one side, far from the origin.
struct Small {
    line: Line,
    design: Tin,
    lines: Vec<LineFeature>,
}

const CORNER: DVec2 = DVec2::new(500_000.25, 5_400_000.5);

impl Small {
    fn new() -> Self {
        let frame = Frame::around(CORNER, CORNER + DVec2::new(20.0, 16.0));
        let world = |x: f64, y: f64, z: f64| CORNER.extend(0.0) + DVec3::new(x, y, z);
        let vertices =
            [(0.0, 0.0, 40.0), (20.0, 0.0, 40.0), (20.0, 10.0, 41.0), (0.0, 10.0, 41.0), (20.0, 16.0, 38.0), (0.0, 16.0, 38.0)];
        let vertices: Vec<DVec3> = vertices.into_iter().map(|(x, y, z)| world(x, y, z)).collect();
        let ring = Chain {
            name: "pad".into(),
            role: Role::Outer { polygon: 0 },
            vertices: vertices[..4].to_vec(),
            places: vec![Place::default(); 4],
            axis: None,
        };
        let hinge = [0, 1, 2, 3, 0].map(|i: usize| vertices[i]).to_vec();
        Self {
            line: Line { chains: vec![ring], breaklines: Vec::new() },
            design: Tin {
                frame,
                vertices: vertices.iter().map(|v| frame.to_local(*v)).collect(),
                triangles: vec![[0, 1, 2], [0, 2, 3], [3, 2, 4], [3, 4, 5]],
                parts: vec![Part::Platform, Part::Platform, Part::FillSlope, Part::FillSlope],
            },
            lines: vec![LineFeature {
                kind: CurveKind::Hinge,
                points: hinge,
                elevation: None,
                chain: Some("pad".into()),
                part: None,
            }],
        }
    }

    fn scene(&self) -> Scene<'_> {
        Scene {
            title: "pad.geojson",
            unit: LengthUnit::Metre,
            crs: None,
            line: &self.line,
            design: &self.design,
            lines: &self.lines,
            bulking: None,
            ground: None,
        }
    }
}

fn page(report: &Report) -> String {
    build::render(report, &Small::new().scene(), &[]).unwrap()
}

/// Headings from the first to the last.
fn headings(page: &str) -> Vec<String> {
    let text = |part: &str| part.split_once('>').map(|(_, rest)| rest.split("</h2>").next().unwrap_or_default().to_owned());
    page.split("<h2").skip(1).filter_map(text).collect()
}

#[test]
fn sections_stand_in_the_order_a_reader_wants() {
    let all = [
        "Warnings",
        "Plan",
        "3D view",
        "Volumes",
        "Volumes by station",
        "Long profile",
        "Cross-sections",
        "Slopes",
        "Depths and areas",
        "Daylight line",
        "Certificate",
        "Line and surface",
        "Inputs",
        "Method and rule of signs",
    ];
    assert_eq!(headings(&page(&on_ground())), all);
    // What does not apply is left out.
    let without: Vec<&str> = all
        .into_iter()
        .filter(|t| !["Warnings", "Volumes", "Volumes by station", "Depths and areas", "Daylight line"].contains(t))
        .collect();
    assert_eq!(headings(&page(&least())), without);
}

/// What only tells how the input was read stands at the end and gives no alarm.
#[test]
fn notes_are_no_warnings() {
    let mut report = on_ground();
    report.warnings.iter_mut().for_each(|warning| warning.kind = crate::report::WarningKind::Note);
    let page = page(&report);
    let found = headings(&page);
    assert_eq!(found.last().map(String::as_str), Some("Notes"));
    assert!(!found.contains(&"Warnings".to_owned()) && !page.contains("href=\"#warnings\""));
}

#[test]
fn what_is_wrong_stands_out() {
    let good = page(&full());
    assert!(
        good.contains(">Certificate passed<")
            && good.contains("Complete: all slopes reach their end")
            && !good.contains("FAILED")
    );
    let failing: [fn(&mut Report); 6] = [
        |r| r.certificate.paired = false,
        |r| r.certificate.manifold = false,
        |r| r.certificate.overlaps = 1,
        |r| r.certificate.strip_max_deviation_deg = 0.011,
        |r| r.certificate.sector_max_deviation_deg = 0.11,
        |r| r.certificate.height_max_deviation = 1.01 * r.design.tolerance,
    ];
    for change in failing {
        let mut report = full();
        change(&mut report);
        let page = page(&report);
        assert!(page.contains(">Certificate NOT passed<") && page.matches(">FAILED<").count() == 1, "{:?}", report.certificate);
    }
    let mut report = full();
    report.volumes.as_mut().unwrap().complete = false;
    assert!(page(&report).contains("NOT complete"));
}

#[test]
fn units_are_those_given() {
    let mut report = full();
    report.units = LengthUnit::UsSurveyFoot.into();
    let page = page(&report);
    assert!(page.contains(" us-ft³") && page.contains("1 us-ft = 1200/3937 m") && !page.contains(" m³"));
}

#[test]
fn figures_that_are_none_are_no_page() {
    let mut report = full();
    report.line.length = f64::NAN;
    let mut bytes = Vec::new();
    let error = super::write_html(&mut bytes, &report, &Small::new().scene(), &[]).unwrap_err();
    assert!(bytes.is_empty() && error.to_string().contains("`line.length`"), "{error}");
}

#[test]
fn long_tables_end_with_a_note() {
    let mut report = on_ground();
    let rows = report.stations.as_mut().unwrap();
    let row = rows[0].clone();
    rows.resize(6000, row);
    let page = page(&report);
    assert!(page.contains("The first 5000 of 6000 rows"));
    assert!(page.matches("<tr>").count() < 5200);
}

#[test]
fn names_from_files_are_text() {
    let mut report = on_ground();
    let name = "</script><b onclick=x>&\"\u{1b}[2J";
    report.stations.as_mut().unwrap()[1].chain = name.into();
    report.line.buried[0].chain = name.into();
    report.warnings[0].message = format!("{name}\nsecond");
    report.inputs[0].path = name.into();
    report.inputs[0].crs = Some(name.into());
    report.depths.as_mut().unwrap().cut_max_at.as_mut().unwrap().chain = Some(name.into());
    let page = page(&report);
    assert!(!page.contains("<b ") && !page.contains('\u{1b}'));
    assert!(page.matches("&lt;/script&gt;&lt;b onclick=x&gt;&amp;").count() >= 6);
}

#[test]
fn comparisons_and_checks_have_pages() {
    let full = between::render(&crate::report::between::testing::full());
    for text in [
        "Cut 7395.80 m³",
        "deficit",
        "NOT complete",
        "Inside the rings asked for",
        "E 500010.500, N 5400020.250",
        "design-uncovered",
    ] {
        assert!(full.replace("<span class=\"d\">", "").replace("</span>", "").contains(text), "{text}");
    }
    assert!(!full.contains("<script"));
    let least = between::render(&crate::report::between::testing::least());
    assert!(least.contains("A surface brought to elevation 30.5") && least.contains(">Complete") && !least.contains("Warnings"));
    let report = crate::report::check::tests::report();
    let page = check::render(&report);
    assert!(page.contains(if report.verdict.passed { ">PASSED<" } else { ">FAILED<" }));
    assert!(report.findings.iter().all(|f| page.contains(f.code)));
}

/// Numbers of a block of data.
fn singles(value: &Value) -> Vec<f64> {
    let bytes = STANDARD.decode(value.as_str().unwrap()).unwrap();
    bytes.chunks_exact(4).map(|b| crate::write::from_single_precision(b.try_into().unwrap())).collect()
}

#[test]
fn the_view_holds_the_mesh_by_part() {
    let small = Small::new();
    let view = view(&small.scene(), [0.0; 2], [1000, 1000]).unwrap().unwrap();
    assert!(view.notes.is_empty() && !view.data.contains('<'));
    let data: Value = serde_json::from_str(&view.data).unwrap();
    let origin: Vec<f64> = data["origin"].as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect();
    let (position, part) = (singles(&data["works"]["position"]), singles(&data["works"]["value"]));
    // Six vertices, two of them once for each of their parts.
    assert_eq!((position.len(), part.len()), (24, 8));
    let mut world: Vec<[f64; 4]> = position
        .chunks_exact(3)
        .zip(part)
        .map(|(p, part)| [p[0] + origin[0], p[1] + origin[1], p[2] + origin[2], part])
        .collect();
    world.sort_by(|a, b| a.partial_cmp(b).unwrap());
    let mut expected: Vec<[f64; 4]> = Vec::new();
    for (t, part) in small.design.triangles.iter().zip(&small.design.parts) {
        expected.extend(t.map(|v| {
            let p = small.design.world(v as usize);
            [p.x, p.y, p.z, f64::from(*part as u8)]
        }));
    }
    expected.sort_by(|a, b| a.partial_cmp(b).unwrap());
    expected.dedup();
    assert_eq!(world, expected);
    // Four segments of the hinge, six numbers each.
    assert_eq!(data["lines"][0]["kind"], "hinge");
    assert_eq!(singles(&data["lines"][0]["ends"]).len(), 24);
    assert_eq!(data["onGround"], false);
}

#[test]
fn too_much_is_thinned_and_told() {
    let mut small = Small::new();
    let view = view(&small.scene(), [0.0; 2], [3, 3]).unwrap().unwrap();
    assert!(
        view.notes[0].contains("is thinned to cells of") && view.notes[0].contains("it has 4 triangles here"),
        "{:?}",
        view.notes
    );
    // Line work goes kind by kind.
    let point = small.lines[0].points[0];
    let many =
        |kind, count: usize| LineFeature { kind, points: vec![point; count + 1], elevation: None, chain: None, part: None };
    small.lines.extend([many(CurveKind::LevelCurve, 149_000), many(CurveKind::Valley, 2000), many(CurveKind::Ridge, 10)]);
    let view = super::view::view(&small.scene(), [0.0; 2], [1000, 1000]).unwrap().unwrap();
    assert!(view.notes[0].ends_with("too much of it: valleys. The file of `--lines` has all."), "{:?}", view.notes);
    assert_eq!(serde_json::from_str::<Value>(&view.data).unwrap()["lines"].as_array().unwrap().len(), 3);
}

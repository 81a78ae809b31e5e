//! Drawings against the figures of the ground and the heights of the meshes.

use super::between::{self, Between};
use super::course::courses;
use super::lines::Stroke;
use super::plan::band_outlines;
use super::testing::{self, Kit, kit, road, yard};
use super::*;
use crate::formation::Crossfall;
use crate::ground::place;
use crate::mesh::drape::Drape;
use crate::model::{Bulking, Tin};

fn area(strokes: &[Stroke]) -> f64 {
    let twice = |s: &Stroke| {
        let o = s.points[0];
        (0..s.points.len()).map(|i| (s.points[i] - o).perp_dot(s.points[(i + 1) % s.points.len()] - o)).sum::<f64>()
    };
    // On paper `y` goes down.
    -0.5 * strokes.iter().map(twice).sum::<f64>()
}

/// The outlines of the bands, before they are simplified, have the areas of cut and fill; deeper ones lie in shallower ones.
#[test]
fn bands_have_the_areas_of_cut_and_fill() {
    for kit in [road(), yard()] {
        let scene = kit.scene();
        let (scale, [all, cut, fill]) = band_outlines(&scene).unwrap();
        let total = &kit.built.tallied.total;
        let near = |found: f64, expected: f64| {
            let found = found / (scale * scale);
            assert!((found - expected).abs() < 1e-6 * (1.0 + expected), "{found} for {expected}");
        };
        near(area(&all[0]), total.plan_area());
        near(area(&cut[0]), total.cut_area);
        near(area(&fill[0]), total.fill_area);
        assert!(total.cut_area > 100.0 && total.fill_area > 100.0);
        for bands in [cut, fill] {
            assert!(bands.windows(2).all(|pair| area(&pair[1]) <= area(&pair[0]) + 1e-9));
        }
    }
}

/// Along the axis the line is the height of the design, and the ground is the ground.
#[test]
fn profiles_are_heights_of_the_meshes() {
    let kit = road();
    let scene = kit.scene();
    let course = courses(&scene).remove(0);
    let ground = profile::ground_along(&scene, &course);
    assert_eq!(ground.len(), 1);
    let terrain = scene.ground.unwrap().terrain;
    let on_ground = Drape::new(&terrain.vertices, &terrain.triangles, None);
    let on_design = Drape::new(&scene.design.vertices, &scene.design.triangles, None);
    for i in 1..400 {
        let station = course.axis.length * f64::from(i) / 400.0;
        let (at, _) = place(&course.axis, station).unwrap();
        let z = between::height(&ground[0], station).unwrap();
        assert!((z - on_ground.at(at).unwrap().0).abs() < 1e-8);
        let z = between::height(&course.heights, station).unwrap();
        assert!((z - on_design.at(at).unwrap().0).abs() < 0.01, "{station}");
    }
}

/// A road that falls 2 % to the left and rises 3 % to the right, half of it 3 wide: edges 0.06 below and 0.09 above the centre
/// line.
#[test]
fn profiles_have_the_edges_of_roads() {
    let points = [[-50.0, 0.0, 100.0], [0.0, 0.0, 102.0], [50.0, 0.0, 102.0]];
    let edges = |left: f64, right: f64| {
        let kit = testing::road_with(&points, 6.0, Crossfall { left, right });
        let scene = kit.scene();
        let course = courses(&scene).remove(0);
        let text = profile(&scene, 0, &Style::INLINE).unwrap();
        (course, text.contains("left edge") && text.contains("ln edge right"))
    };
    let (course, drawn) = edges(0.02, -0.03);
    assert!(drawn);
    for (edge, offset) in course.edges.iter().zip([-0.06, 0.09]) {
        assert!(edge.first().unwrap().x < 1e-9 && edge.last().unwrap().x > 100.0 - 1e-9 && edge.len() == 3, "{edge:?}");
        assert!(edge.windows(2).all(|pair| pair[0].x <= pair[1].x));
        for p in edge {
            let z = between::height(&course.heights, p.x).unwrap() + offset;
            assert!((p.y - z).abs() < 1e-9, "{p}: {z}");
        }
    }
    // Without crossfall they lie on the line of the centre.
    assert!(!edges(0.0, 0.0).1);
}

/// The shaded areas of a section are those the figures of the ground have for it.
#[test]
fn sections_have_the_areas_of_the_figures() {
    let kit = road();
    let scene = kit.scene();
    let course = courses(&scene).remove(0);
    let figures = kit.built.sections.as_ref().unwrap();
    let mut seen = 0;
    for section in figures.axes[0].iter().flat_map(|interval| interval.sections) {
        // At the ends the slopes about the end of the road begin.
        if section.station <= 0.0 || section.station >= course.axis.length {
            continue;
        }
        let (_, views) = sections::views(&scene, &course, 0, &[section.station], 900.0);
        let mut between = Between::default();
        let (_, view) = &views[0];
        view.ground.iter().for_each(|ground| between.add(&view.design.points, ground, view.counted.0, view.counted.1));
        for (found, expected) in [(between.cut_area, section.area.cut), (between.fill_area, section.area.fill)] {
            assert!((found - expected).abs() < 1e-6 * (1.0 + expected), "{}: {found} for {expected}", section.station);
        }
        seen += 1;
    }
    assert!(seen > 10);
}

#[test]
fn the_haul_ends_with_the_net() {
    let mut kit = road();
    let net = |kit: &Kit| {
        let scene = kit.scene();
        let (net, compacted) = haul::curves(&scene, 0).unwrap();
        (*net.last().unwrap(), compacted.map(|curve| *curve.last().unwrap()))
    };
    let total = kit.built.tallied.total;
    let (end, compacted) = net(&kit);
    assert!((end.y - total.net()).abs() < 1e-9 * (total.cut + total.fill) && compacted.is_none());
    kit.bulking = Bulking::new(0.25, 0.1);
    let expected = 0.9 * total.cut - total.fill;
    assert!((net(&kit).1.unwrap().y - expected).abs() < 1e-9 * (total.cut + total.fill));
}

/// All drawings of a scene.
fn drawings(scene: &Scene<'_>, style: &Style) -> Vec<String> {
    let single = [plan(scene, style), profile(scene, 0, style), mass_haul(scene, 0, style)];
    let sections = sections(scene, 0, &[20.0, 33.3], style).into_iter().map(|(_, text)| text);
    let files = Drawing::ALL.into_iter().map(|drawing| file(scene, drawing, &[]));
    single.into_iter().flatten().chain(sections).chain(files).collect()
}

/// Every drawing is well-formed XML, whatever names are in it, and no number in it is none.
#[test]
fn drawings_are_xml() {
    let mut kit = road();
    kit.title = "a<b> & \"c\" ]]> \u{1}\u{fffe}'ü'".repeat(20);
    for chain in &mut kit.line.chains {
        chain.axis.as_mut().unwrap().name = "<script>&amp;\0".repeat(30);
    }
    for width in [0.0, 360.0, 1000.0, f64::NAN, 1e9] {
        for standalone in [true, false] {
            let all = drawings(&kit.scene(), &Style { standalone, width });
            assert_eq!(all.len(), 9);
            for text in all {
                let mut reader = quick_xml::Reader::from_str(&text);
                loop {
                    match reader.read_event().unwrap() {
                        quick_xml::events::Event::Eof => break,
                        quick_xml::events::Event::Start(tag) | quick_xml::events::Event::Empty(tag) => {
                            assert!(tag.attributes().all(|attribute| attribute.is_ok()));
                            assert!(
                                ["svg", "title", "desc", "style", "rect", "path", "text", "circle"]
                                    .contains(&tag.name().as_ref())
                            );
                        }
                        _ => {}
                    }
                }
                assert!(!text.contains("NaN") && !text.contains("inf\"") && !text.contains("<script"));
                assert!(text.contains("role=\"img\"") && text.contains("<title>") && text.contains("<desc>"));
                assert!(text.len() < 200_000, "{}", text.len());
            }
        }
    }
}

/// Nothing to draw is nothing drawn; a file says so.
#[test]
fn empty_scenes() {
    let mut kit = road();
    kit.built.pieces = None;
    kit.built.design = Tin { vertices: vec![], triangles: vec![], parts: vec![], ..kit.built.design };
    kit.built.lines.clear();
    let scene = kit.scene();
    assert_eq!(mass_haul(&scene, 0, &Style::INLINE), None);
    assert!(sections(&scene, 0, &[20.0], &Style::INLINE).is_empty());
    assert!(profile(&scene, 0, &Style::INLINE).is_some() && profile(&scene, 7, &Style::INLINE).is_none());
    assert!(plan(&scene, &Style::INLINE).is_some());
    assert!(file(&scene, Drawing::Haul, &[]).contains("There is nothing to draw"));
    kit.line.chains.clear();
    assert_eq!(plan(&kit.scene(), &Style::INLINE), None);
}

/// The size of a plan is bounded, however rough the ground is: here every triangle of it has cut and fill.
#[test]
fn rough_ground_does_not_fill_the_disk() {
    let points = [[-60.0, -60.0, 100.0], [60.0, -60.0, 100.0], [60.0, 60.0, 100.0], [-60.0, 60.0, 100.0]];
    let rough = kit("rough", &points, true, None, |x, y| 100.0 + ((x * 12.9898 + y * 78.233).sin() * 43_758.545_3).fract());
    let text = plan(&rough.scene(), &Style::FILE).unwrap();
    assert!(text.len() < 500_000, "{}", text.len());
}

/// Classes of all elements have a rule in the style sheet, and all colours have a light and a dark value.
#[test]
fn classes_have_rules() {
    let sheet = css();
    assert!(!sheet.contains('$') && !style::file_css().contains("var(") && !style::file_css().contains('$'));
    for text in drawings(&road().scene(), &Style::INLINE).into_iter().take(5) {
        for classes in text.split("class=\"").skip(1).filter_map(|rest| rest.split('"').next()) {
            for class in classes.split(' ').filter(|class| !["plot", "i"].contains(class)) {
                assert!(sheet.contains(&format!(".{class}{{")), "{class}");
            }
        }
    }
}

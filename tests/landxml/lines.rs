//! Alignments, plan features, parcels and breaklines as lines.

use super::{CHORD, codes, file, lines};
use glam::{DVec2, DVec3};
use slopegen::model::LengthUnit;
use slopegen::read::{self, InputFormat, RawLine, ReadOptions};
use slopegen::validate;
use std::f64::consts::PI;

/// A curve in plan: its curvature changes linearly with the length. Integrated here by Simpson's rule, in steps of a centimetre.
struct Run {
    length: f64,
    from: f64,
    to: f64,
}

fn walk(mut at: DVec2, mut angle: f64, run: &Run, visit: &mut impl FnMut(DVec2)) -> (DVec2, f64) {
    let steps = (run.length / 0.01).ceil() as usize;
    let h = run.length / steps as f64;
    let begin = angle;
    let direction = |s: f64| begin + s * (run.from + 0.5 * s * (run.to - run.from) / run.length);
    visit(at);
    for i in 0..steps {
        let s = h * i as f64;
        let [a, b, c] = [s, s + 0.5 * h, s + h].map(|s| DVec2::from_angle(direction(s)));
        at += h / 6.0 * (a + 4.0 * b + c);
        visit(at);
    }
    angle = direction(run.length);
    (at, angle)
}

/// Straight, clothoid into a left bend of 120, arc, clothoid into a right bend of 90 of the same length, arc, clothoid, straight.
const RUNS: [Run; 8] = [
    Run { length: 40.0, from: 0.0, to: 0.0 },
    Run { length: 50.0, from: 0.0, to: 1.0 / 120.0 },
    Run { length: 60.0, from: 1.0 / 120.0, to: 1.0 / 120.0 },
    Run { length: 25.0, from: 1.0 / 120.0, to: 1.0 / 60.0 },
    Run { length: 30.0, from: 1.0 / 60.0, to: 0.0 },
    Run { length: 35.0, from: 0.0, to: -1.0 / 90.0 },
    Run { length: 55.0, from: -1.0 / 90.0, to: -1.0 / 90.0 },
    Run { length: 20.0, from: 0.0, to: 0.0 },
];
pub(super) const START: DVec2 = DVec2::new(500_000.0, 5_400_000.0);
const ANGLE: f64 = 0.4;
/// Station of the beginning.
const STATION: f64 = 1250.0;

fn radius(curvature: f64) -> String {
    if curvature == 0.0 { "INF".into() } else { format!("{}", 1.0 / curvature.abs()) }
}

fn ne(p: DVec2) -> String {
    format!("{:.9} {:.9}", p.y, p.x)
}

/// The alignment as LandXML.
pub(super) fn alignment() -> String {
    let (mut at, mut angle) = (START, ANGLE);
    let mut text = String::new();
    for run in &RUNS {
        let (to, next) = walk(at, angle, run, &mut |_| {});
        let rot = if run.from + run.to > 0.0 { "ccw" } else { "cw" };
        let (start, end) = (format!("<Start>{}</Start>", ne(at)), format!("<End>{}</End>", ne(to)));
        let length = run.length;
        if run.from == 0.0 && run.to == 0.0 {
            text += &format!("<Line length=\"{length}\">{start}{end}</Line>\n");
        } else if run.from == run.to {
            let centre = at + DVec2::from_angle(angle).perp() / run.from;
            text += &format!(
                "<Curve rot=\"{rot}\" radius=\"{}\" length=\"{length}\">{start}<Center>{}</Center>{end}</Curve>\n",
                radius(run.from),
                ne(centre)
            );
        } else {
            // Tangents meet where at + a·u = to − b·v.
            let (u, v) = (DVec2::from_angle(angle), DVec2::from_angle(next));
            let corner = at + u * ((to - at).perp_dot(v) / u.perp_dot(v));
            text += &format!(
                "<Spiral rot=\"{rot}\" spiType=\"clothoid\" length=\"{length}\" radiusStart=\"{}\" radiusEnd=\"{}\">{start}<PI>{}</PI>{end}</Spiral>\n",
                radius(run.from),
                radius(run.to),
                ne(corner)
            );
        }
        (at, angle) = (to, next);
    }
    format!(
        "<Alignments><Alignment name=\"axis\" length=\"{}\" staStart=\"{STATION}\"><CoordGeom>\n{text}</CoordGeom>\n<Profile>\
         <ProfAlign name=\"grade\">\n<PVI>1250 400</PVI>\n<ParaCurve length=\"80\">1330 404</ParaCurve>\n<CircCurve length=\"59.98\" \
         radius=\"1000\">1450 402.8</CircCurve>\n<PVI>1565 408.55</PVI></ProfAlign></Profile></Alignment></Alignments>",
        RUNS.iter().map(|run| run.length).sum::<f64>()
    )
}

/// Height at a station: +5 %, a parabola to −1 % over 1290 to 1370, a circle of radius 1000 to +5 % about 1450.
fn height(station: f64) -> f64 {
    let tangent = 1000.0 * (0.5 * (0.05_f64.atan() + 0.01_f64.atan())).tan();
    let begin = 1450.0 - tangent * 0.01_f64.atan().cos();
    let end = 1450.0 + tangent * 0.05_f64.atan().cos();
    match station {
        s if s < 1290.0 => 400.0 + 0.05 * (s - 1250.0),
        s if s < 1370.0 => 402.0 + 0.05 * (s - 1290.0) - 0.06 / 160.0 * (s - 1290.0).powi(2),
        s if s < begin => 404.0 - 0.01 * (s - 1330.0),
        s if s < end => {
            // Centre above the point where the tangent touches, at right angles to it.
            let along = 0.01_f64.atan();
            let (x, z) = (begin + 1000.0 * along.sin(), 404.0 - 0.01 * (begin - 1330.0) + 1000.0 * along.cos());
            z - (1e6 - (s - x).powi(2)).sqrt()
        }
        s => 402.8 + 0.05 * (s - 1450.0),
    }
}

fn vertices(line: &RawLine) -> Vec<DVec3> {
    line.vertices.iter().map(|v| DVec3::new(v.x, v.y, v.z.unwrap_or(f64::NAN))).collect()
}

fn distance(p: DVec3, line: &[DVec3]) -> f64 {
    let to = |a: DVec3, b: DVec3| {
        let d = b - a;
        (p - a - d * ((p - a).dot(d) / d.length_squared()).clamp(0.0, 1.0)).length()
    };
    line.windows(2).map(|w| to(w[0], w[1])).fold(f64::INFINITY, f64::min)
}

#[test]
fn an_alignment_is_followed_within_its_chords() {
    let raw = lines(file(&alignment()), &[]).unwrap();
    assert_eq!(codes(&raw.notes), ["landxml-stations"]);
    assert!(raw.notes[0].message.contains("begins at its station 1250.000"), "{}", raw.notes[0].message);
    assert_eq!((raw.lines.len(), raw.lines[0].name.as_deref()), (1, Some("axis")));
    let line: Vec<DVec3> = vertices(&raw.lines[0]).iter().map(|v| *v - START.extend(0.0)).collect();
    // The true curve, every centimetre.
    let mut curve = Vec::new();
    let (mut at, mut angle, mut station) = (START, ANGLE, STATION);
    for run in &RUNS {
        let mut along = 0.0;
        let step = run.length / (run.length / 0.01).ceil();
        let next = walk(at, angle, run, &mut |p| {
            curve.push((p - START).extend(height(station + along)));
            along += step;
        });
        (at, angle) = next;
        station += run.length;
        // Every element ends in a vertex.
        let end = (at - START).extend(height(station));
        assert!(line.iter().any(|v| v.distance(end) < 1e-6), "{station}");
    }
    let worst = curve.iter().step_by(7).map(|p| distance(*p, &line)).fold(0.0, f64::max);
    assert!(worst < 1.01 * CHORD && worst > 0.3 * CHORD, "{worst}");
    // Vertices lie on the curve itself.
    let off = line.iter().map(|v| distance(*v, &curve)).fold(0.0, f64::max);
    assert!(off < 2e-6, "{off}");
    assert!((150..320).contains(&line.len()), "{}", line.len());
    // Where the vertical curves begin and end.
    for station in [1290.0, 1370.0] {
        assert!(line.iter().any(|v| (v.z - height(station)).abs() < 1e-7), "{station}");
    }
}

#[test]
fn stations_may_start_anywhere() {
    let here = lines(file(&alignment()), &[]).unwrap();
    let mut text = alignment().replace("staStart=\"1250\"", "staStart=\"-100.5\"");
    for (station, moved) in [
        ("1250 400<", "-100.5 400<"),
        ("1330 404<", "-20.5 404<"),
        ("1450 402.8<", "99.5 402.8<"),
        ("1565 408.55<", "214.5 408.55<"),
    ] {
        assert!(text.contains(station));
        text = text.replace(station, moved);
    }
    let there = lines(file(&text), &[]).unwrap();
    assert_eq!(here.lines[0].vertices.len(), there.lines[0].vertices.len());
    for (a, b) in vertices(&here.lines[0]).iter().zip(vertices(&there.lines[0])) {
        assert!(a.distance(b) < 1e-6);
    }
    // A profile that is shorter than the elements.
    let short = lines(file(&alignment().replace("1565 408.55<", "1555 408.05<")), &[]).unwrap();
    assert_eq!(codes(&short.notes), ["landxml-profile-short", "landxml-stations"]);
    let length: f64 = vertices(&short.lines[0]).windows(2).map(|w| (w[1] - w[0]).truncate().length()).sum();
    assert!((length - 305.0).abs() < 0.02, "{length}");
    // One that lies elsewhere.
    let message = lines(file(&alignment().replace("staStart=\"1250\"", "staStart=\"0\"")), &[]).unwrap_err();
    assert!(message.contains("lies beside its elements") && message.contains("0.0000 to 315.0000"), "{message}");
}

#[test]
fn other_units_and_chords() {
    let feet = file(&alignment()).replace("Metric linearUnit=\"meter\"", "Imperial linearUnit=\"USSurveyFoot\"");
    let raw = lines(&feet, &[]).unwrap();
    let metres = lines(file(&alignment()), &[]).unwrap();
    assert_eq!((raw.source.unit, &raw.lines), (Some(LengthUnit::UsSurveyFoot), &metres.lines));
    // A chord in metres is 3.28 times as many feet.
    let options = ReadOptions { chord: CHORD, unit: Some(LengthUnit::Metre), ..ReadOptions::of(InputFormat::LandXml) };
    let coarse = read::parse_line("a.xml", feet.as_bytes(), &options).unwrap();
    let ratio = raw.lines[0].vertices.len() as f64 / coarse.lines[0].vertices.len() as f64;
    assert!((ratio - (3937.0_f64 / 1200.0).sqrt()).abs() < 0.06, "{ratio}");
    // Millimetres, lengths and radii too.
    let small = alignment();
    let raw = lines(file(&small).replace("\"meter\"", "\"millimeter\""), &[]).unwrap();
    let v = raw.lines[0].vertices[0];
    assert!((v.x - 500.0).abs() < 1e-9 && (v.z.unwrap() - 0.4).abs() < 1e-12);
}

fn feature(elements: &str) -> String {
    file(&format!("<PlanFeatures><PlanFeature name=\"edge\"><CoordGeom>{elements}</CoordGeom></PlanFeature></PlanFeatures>"))
}

#[test]
fn arcs_of_plan_features() {
    // Three quarters of a circle of 50 about (100, 200), to the right, climbing by 6.
    let text = feature(
        "<Line><Start>150 90 4</Start><End>150 100 5</End></Line>\
         <Curve rot=\"cw\" crvType=\"arc\"><Start>250 100 5</Start><Center>200 100</Center><End>200 50 11</End></Curve>",
    )
    .replace("150 100 5</End>", "250 100 5</End>")
    .replace("150 90 4", "250 90 4");
    let raw = lines(&text, &[]).unwrap();
    let line = vertices(&raw.lines[0]);
    let centre = DVec2::new(100.0, 200.0);
    for v in &line[1..] {
        let out = v.truncate() - centre;
        assert!((out.length() - 50.0).abs() < 1e-9);
        // From north, clockwise.
        let turned = out.x.atan2(out.y).rem_euclid(2.0 * PI);
        assert!((v.z - (5.0 + 6.0 * turned / (1.5 * PI))).abs() < 1e-9, "{v}");
    }
    let parts = (75.0 * PI / (8.0 * 50.0 * CHORD).sqrt()).ceil() as usize;
    assert_eq!(line.len(), 2 + parts);
    assert_eq!((line[0], line[line.len() - 1]), (DVec3::new(90.0, 250.0, 4.0), DVec3::new(50.0, 200.0, 11.0)));
    // The same by its radius and its length.
    let by_radius =
        text.replace("<Center>200 100</Center>", "").replace("rot=\"cw\"", "rot=\"cw\" radius=\"50\" length=\"235.6194\"");
    for (a, b) in vertices(&lines(by_radius, &[]).unwrap().lines[0]).iter().zip(&line) {
        assert!(a.distance(*b) < 1e-9);
    }
}

#[test]
fn named_points() {
    let element = "<Line><Start pntRef=\"A 1\"/><End pntRef=\"B\"></End></Line><Chain>B C D</Chain>\
                   <IrregularLine><Start pntRef=\"D\"/><End>40 9 4</End><PntList3D>40 8 3 41 8.5 3.5 40 9 4</PntList3D></IrregularLine>";
    let points = "<CgPoints><CgPoint name=\"A 1\" desc=\"x\">10 5 1</CgPoint><CgPoint name=\"B\"> 20 6 2 </CgPoint>\
                  <CgPoints><CgPoint name=\"C\" pntRef=\"E\"/><CgPoint name=\"D\">40 8 3</CgPoint></CgPoints>\
                  <CgPoint name=\"E\">30 7 2.5</CgPoint><CgPoint name=\"unused\"/></CgPoints>";
    let expected = [[5.0, 10.0, 1.0], [6.0, 20.0, 2.0], [7.0, 30.0, 2.5], [8.0, 40.0, 3.0], [8.5, 41.0, 3.5], [9.0, 40.0, 4.0]];
    let text = feature(element);
    for text in [
        text.replace("<PlanFeatures>", &format!("{points}<PlanFeatures>")),
        text.replace("</LandXML>", &format!("{points}</LandXML>")),
    ] {
        let raw = lines(&text, &[]).unwrap();
        let mut found = vertices(&raw.lines[0]);
        found.dedup();
        assert_eq!(found, expected.map(DVec3::from_array));
        assert_eq!(raw.lines[0].feature, Some(1));
        for (from, to, words) in [
            ("name=\"E\"", "name=\"F\"", "no point `E`"),
            ("<CgPoint name=\"E\">30 7 2.5</CgPoint>", "<CgPoint name=\"E\" pntRef=\"C\"/>", "only name each other"),
            ("name=\"unused\"/>", "name=\"B\">20 6 2.5</CgPoint>", "several points at different places are named `B`"),
            ("> 20 6 2 <", "> 20 <", "does not have three numbers"),
        ] {
            let message = lines(text.replace(from, to), &[]).unwrap_err();
            assert!(message.contains(words) && message.contains("a.xml, line"), "{to}: {message}");
        }
        // Given twice at the same place: no matter.
        assert!(lines(text.replace("name=\"unused\"/>", "name=\"B\">20 6 2</CgPoint>"), &[]).is_ok());
    }
}

#[test]
fn elements_that_do_not_join() {
    let two = "<Line><Start>0 0 1</Start><End>0 10 1</End></Line><Line><Start>0 {} 1</Start><End>0 20 1</End></Line>";
    let joined = lines(feature(&two.replace("{}", "10.001")), &[]).unwrap();
    assert_eq!((joined.lines.len(), joined.lines[0].vertices.len(), joined.notes.len()), (1, 3, 0));
    let apart = lines(feature(&two.replace("{}", "10.1")), &[]).unwrap();
    assert_eq!((apart.lines.len(), codes(&apart.notes)), (2, vec!["landxml-parts"]));
    let text = feature(&two.replace("{}", "10.1")).replace("PlanFeature", "Alignment");
    let message = lines(text, &[]).unwrap_err();
    assert!(message.contains("has a gap") && message.contains("lies 0.1000 from the end"), "{message}");
}

#[test]
fn contradictions_are_told() {
    let text = file(&alignment());
    for (from, to, words) in [
        ("spiType=\"clothoid\"", "spiType=\"bloss\"", "spiType=\"bloss\""),
        ("rot=\"ccw\" spiType", "rot=\"cw\" spiType", "the line to its <PI>"),
        ("rot=\"ccw\" radius=\"120\"", "rot=\"cw\" radius=\"120\"", "the length of a curve by its coordinates"),
        ("rot=\"ccw\" radius=\"120\"", "radius=\"120\"", "does not say which way it turns"),
        ("rot=\"ccw\" radius=\"120\"", "rot=\"ccw\" radius=\"130\"", "is 120.0000, by its other figures 130.0000"),
        ("radiusStart=\"INF\"", "radiusStart=\"0\"", "radiusStart is missing or nought"),
        ("length=\"50\" radiusStart", "length=\"55\" radiusStart", "the chord of a spiral"),
        ("length=\"50\" radiusStart", "radiusStart", "no clothoid goes through"),
        ("length=\"80\"", "length=\"280\"", "needs 140.0000 on one side, where there is 80.0000"),
        ("1330 404<", "1230 404<", "station 1230 comes behind 1250"),
        ("1330 404<", "1330<", "<ParaCurve> does not have two numbers"),
        ("radius=\"1000\">1450", "radius=\"0\">1450", "the curve at station 1450 has no length or radius"),
        ("<Start>", "<Begin>", "damaged"),
    ] {
        assert!(text.contains(from), "{from}");
        let message = lines(text.replace(from, to), &[]).unwrap_err();
        assert!(message.contains(words) && message.contains("a.xml, line"), "{to}: {message}");
    }
    // Small ones get a note.
    for (from, to, code) in [
        ("rot=\"ccw\" radius=\"120\"", "rot=\"ccw\" radius=\"120.05\"", "landxml-misfit"),
        ("length=\"315\"", "length=\"315.5\"", "landxml-length"),
        ("<Profile>", "<StaEquation staAhead=\"2000\" staInternal=\"1300\" staBack=\"1300\"/><Profile>", "landxml-equations"),
    ] {
        let raw = lines(text.replace(from, to), &[]).unwrap();
        assert_eq!(codes(&raw.notes), [code, "landxml-stations"], "{to}");
    }
    let message = lines(text.replace("CoordGeom", "AlignPIs"), &[]).unwrap_err();
    assert!(message.contains("points of intersection only"), "{message}");
}

fn several() -> String {
    let breakline = |name: &str, list: &str| format!("<Breakline name=\"{name}\" brkType=\"standard\">{list}</Breakline>");
    let parcel =
        "<Parcels><Parcel name=\"Lot 1\"><CoordGeom><Line><Start>0 0</Start><End>0 9</End></Line></CoordGeom></Parcel></Parcels>";
    let surface = format!(
        "<Surfaces><Surface name=\"EG\"><SourceData><Breaklines>{}{}</Breaklines></SourceData><Definition><Pnts><P>x</P></Pnts></Definition></Surface></Surfaces>",
        breakline("toe", "<PntList3D>0 0 1 0 10 2 5 10 3</PntList3D>"),
        breakline("flat", "<PntList2D>0 0 0 10</PntList2D>")
    );
    file(&format!("{parcel}{surface}"))
}

#[test]
fn which_lines_are_taken() {
    // Breaklines and parcels where there is nothing else, breaklines first.
    let raw = lines(several(), &[]).unwrap();
    let names = |lines: &[RawLine]| lines.iter().map(|line| line.name.clone().unwrap_or_default()).collect::<Vec<_>>();
    assert_eq!(names(&raw.lines), ["toe", "flat"]);
    assert_eq!(raw.notes[0].message, "taken from the file: breakline `toe`, breakline `flat`; left: 1 parcel, 1 surface");
    // No heights: found by validation, with the place.
    let message = validate::check(&lines(several(), &["flat"]).unwrap(), &validate::Options::default()).unwrap_err().to_string();
    assert!(message.contains("no elevations"), "{message}");
    assert_eq!(names(&lines(several(), &["Lot 1", "toe"]).unwrap().lines), ["Lot 1", "toe"]);
    let with = several().replace("<Parcels>", &format!("{}<Parcels>", alignment()));
    assert_eq!(names(&lines(&with, &[]).unwrap().lines), ["axis"]);
    let both = with.replace("Parcel", "PlanFeature");
    assert_eq!(
        lines(&both, &[]).unwrap_err(),
        "the file holds alignments and plan features\n  --> a.xml\n   = it holds alignment `axis`, plan feature `Lot 1`, breakline \
         `toe`, breakline `flat`\n   = help: say which ones with `--feature NAME`; it may be repeated"
    );
    assert_eq!(names(&lines(&both, &["axis"]).unwrap().lines), ["axis"]);
    // One that is empty does not stand in the way of others.
    let empty = both.replace("</Alignments>", "<Alignment name=\"draft\"/></Alignments>").replace("PlanFeature", "Parcel");
    let raw = lines(&empty, &[]).unwrap();
    assert_eq!(names(&raw.lines), ["axis"]);
    assert!(raw.notes[0].message.ends_with("left: 1 alignment, 2 breaklines, 1 parcel, 1 surface"), "{}", raw.notes[0].message);
    assert!(lines(&empty, &["draft"]).unwrap_err().contains("alignment `draft` has no elements"));
    // Any element with a CoordGeom is a line.
    assert_eq!(names(&lines(several().replace("Parcel", "FeatureLine"), &[]).unwrap().lines), ["Lot 1"]);
    let message = lines(&both, &["axis", "nix"]).unwrap_err();
    assert!(message.contains("there is no line `nix`"), "{message}");
    let message = lines(file("<Surfaces><Surface name=\"a\"/></Surfaces>"), &[]).unwrap_err();
    assert!(message.contains("holds no line") && message.contains("`--terrain`"), "{message}");
}

#[test]
fn which_profile_is_taken() {
    let ground = "<ProfSurf name=\"eg\"><PntList2D>1250 390 1400 395 1565 391</PntList2D></ProfSurf>";
    let text = file(&alignment());
    let with = text.replace("<Profile>", &format!("<Profile>{ground}"));
    assert_eq!(lines(&with, &[]).unwrap().lines, lines(&text, &[]).unwrap().lines);
    let of_ground = vertices(&lines(&with, &["axis/eg"]).unwrap().lines[0]);
    assert!(of_ground.iter().any(|v| (v.z - 395.0).abs() < 1e-6) && of_ground[0].z == 390.0);
    assert_eq!(lines(&with, &["axis/grade"]).unwrap().lines, lines(&text, &[]).unwrap().lines);
    // Two designs.
    let two = with.replace("ProfSurf", "ProfAlign");
    let message = lines(&two, &["axis"]).unwrap_err();
    assert!(
        message.contains("has several profiles") && message.contains("`eg`, `grade`") && message.contains("\"axis/PROFILE\""),
        "{message}"
    );
    assert_eq!(vertices(&lines(&two, &["axis/eg"]).unwrap().lines[0]), of_ground);
    // Both of them: two lines, each name once.
    let raw = lines(&two, &["axis/grade", "axis/eg", "axis/eg"]).unwrap();
    let found: Vec<_> = raw.lines.iter().map(vertices).collect();
    assert_eq!(found, [vertices(&lines(&text, &[]).unwrap().lines[0]), of_ground]);
    assert!(!codes(&raw.notes).contains(&"landxml-taken"), "{:?}", raw.notes);
    // None.
    let none = with.replace("ProfAlign", "Other");
    let message = lines(&none, &[]).unwrap_err();
    assert!(message.contains("has no design profile") && message.contains("`eg`"), "{message}");
    assert!(lines(&none, &["axis/grade"]).is_err());
    // A circle by its length only: 1000 · (0.0499584 + 0.0099997) = 59.958.
    let by_length = lines(text.replace("length=\"59.98\" radius=\"1000\"", "length=\"59.9581\""), &[]).unwrap();
    for (a, b) in vertices(&by_length.lines[0]).iter().zip(vertices(&lines(&text, &[]).unwrap().lines[0])) {
        assert!(a.distance(b) < 1e-3);
    }
}

/// Lines of all kinds are counted together, so that none is taken for a part of another.
#[test]
fn places_of_lines_of_several_kinds() {
    let line = |x: u32, z: u32| format!("<CoordGeom><Line><Start>{x} 0 5</Start><End>{x} 1 {z}</End></Line></CoordGeom>");
    let text = file(&format!(
        "<Alignments><Alignment name=\"a\">{}</Alignment></Alignments><PlanFeatures><PlanFeature name=\"b\">{}</PlanFeature></PlanFeatures>",
        line(0, 5),
        line(50, 500)
    ));
    let raw = lines(&text, &["a", "b"]).unwrap();
    let line = validate::check(&raw, &validate::Options::default()).unwrap().line;
    let slope = slopegen::model::Slope::from_ratio(1.0).unwrap();
    let message = validate::check_steepness(&line, "a.xml", slope).unwrap_err().to_string();
    assert!(message.contains("--> a.xml, feature 2, vertices 1 to 2\n"), "{message}");
}

/// Radii of a spiral are told in the unit of its ends.
#[test]
fn figures_of_a_spiral_are_in_the_unit_of_the_run() {
    let spiral = "<Spiral rot=\"cw\" radiusStart=\"2000\" radiusEnd=\"5000\"><Start>0 0 0</Start><End>900000 0 0</End></Spiral>";
    let text = file(&format!("<Alignments><Alignment name=\"a\"><CoordGeom>{spiral}</CoordGeom></Alignment></Alignments>"));
    let message = lines(text.replace("\"meter\"", "\"millimeter\""), &[]).unwrap_err();
    assert!(message.contains("length 0, radii 2 and 5, ends 900.0000 apart"), "{message}");
}

#[test]
fn heights_of_nought_are_noticed() {
    let raw = lines(feature("<Line><Start>0 0 0.000</Start><End>0 10 0.000</End></Line>"), &[]).unwrap();
    assert_eq!(codes(&raw.notes), ["landxml-flat"]);
}

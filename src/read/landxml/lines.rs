//! Lines as polylines: elements joined, heights from profiles, curves resolved.

use super::choose::Chosen;
use super::coord_geom::{Part, Point, Shape};
use super::features::{Feature, Features, Heights, Kind, RawCurve, RawPvi};
use super::units::Scale;
use super::xml::place;
use crate::model::Note;
use crate::read::alignment::{self, Curve, Element, MOST_POINTS, Misfit, Piece, Profile, ProfileError, Pvi, TooMany};
use crate::read::error::{clip, refuse};
use crate::read::{RawLine, RawShape, RawVertex, ReadError};
use glam::DVec2;

/// Ends of elements nearer to each other than this, in the length unit, are the same point.
pub(super) const JOIN: f64 = 0.01;

/// Coordinates and lengths that differ by more than this, in the length unit, do so by more than their rounding to the third
/// decimal; a note tells.
const TOLD: f64 = 0.002;

/// They are refused if they differ by more than this, and by more than this share.
const REFUSED: (f64, f64) = (0.1, 0.01);

/// Least cosine of the angle between the tangent of a spiral and the line to its point of intersection: one degree.
const TANGENT: f64 = 0.999_847_695_156_391_3;

/// Places told in notes.
const MOST_PLACES: usize = 20;

/// Points that name points that name points: no further than this.
const MOST_NAMES: usize = 16;

/// Makes polylines of the lines of a file.
pub(super) struct Maker<'a> {
    pub(super) label: &'a str,
    pub(super) text: &'a str,
    pub(super) features: &'a Features,
    pub(super) scale: Scale,
    /// Greatest chord error, in the unit of the scale.
    pub(super) chord: f64,
    /// Points that curves may still be resolved into.
    left: usize,
    /// Places that may still be told in notes: finding the line of one takes a look through the whole file.
    places: usize,
}

/// A point in plan, and its height if it has one.
type Placed = (DVec2, Option<f64>);

/// An element that does not fit what is declared of it.
struct Worst {
    misfit: Misfit,
    what: &'static str,
    at: usize,
}

impl<'a> Maker<'a> {
    pub(super) fn new(label: &'a str, text: &'a str, features: &'a Features, scale: Scale, chord: f64) -> Self {
        Self { label, text, features, scale, chord, left: MOST_POINTS, places: MOST_PLACES }
    }

    fn refuse(&self, what: &str, at: usize, figures: impl Into<String>, help: &str) -> ReadError {
        refuse(what, place(self.label, self.text, at), figures, help)
    }

    /// The polylines of one line of the file: one, or one for each part where its elements do not join.
    ///
    /// # Errors
    /// For points that are not there, elements that contradict themselves, alignments with gaps, profiles that are none.
    pub(super) fn make(&mut self, chosen: &Chosen<'_>, notes: &mut Vec<Note>) -> Result<Vec<RawLine>, ReadError> {
        let feature = chosen.feature;
        if feature.parts.is_empty() {
            let figures =
                if feature.road.by_corners { "it has points of intersection only (AlignPIs)" } else { "it has no CoordGeom" };
            let what = format!("{} has no elements", feature.text());
            return Err(self.refuse(&what, feature.at, figures, "export it with its CoordGeom"));
        }
        let mut worst = None;
        let runs = self.runs(feature, &mut worst, notes)?;
        if let Some(Worst { misfit, what, at }) = worst {
            let at = match self.places {
                0 => String::new(),
                _ => format!(" ({})", place(self.label, self.text, at)),
            };
            self.places = self.places.saturating_sub(1);
            let message = format!(
                "{}: {what} by its coordinates is {:.4}, by its other figures {:.4}{at}",
                feature.text(),
                misfit.given,
                misfit.computed
            );
            notes.push(Note::new("landxml-misfit", message));
        }
        let raw =
            RawLine { name: feature.name.clone(), feature: Some(feature.position), shape: RawShape::Line, vertices: Vec::new() };
        let profile = self.profile(chosen, &runs)?;
        let mut lines = Vec::new();
        for run in &runs {
            let start = feature.road.start * self.scale.plan;
            let mut begin = start;
            let points = match &profile {
                None => alignment::sample(run, alignment::Heights::Own, self.chord, &mut self.left),
                Some((profile, at)) => {
                    let [from, to] = self.common(feature, run, profile, *at, notes)?;
                    begin = from;
                    let heights = alignment::Heights::Profile { profile, start, from, to };
                    alignment::sample(run, heights, self.chord, &mut self.left)
                }
            };
            let points = points.map_err(|TooMany(count)| {
                let figures = format!("{count:.0} points for a chord error of {}; at most {MOST_POINTS} for all", self.chord);
                self.refuse(
                    &format!("the curves of {} take too many points", feature.text()),
                    feature.at,
                    figures,
                    "give a greater `--tolerance`, or check the radii",
                )
            })?;
            if feature.kind == Kind::Alignment && begin != 0.0 {
                let begin = begin / self.scale.plan;
                let message = format!("{}: begins at its station {begin:.3}; stations are counted from 0 there", feature.text());
                notes.push(Note::new("landxml-stations", message));
            }
            let vertices: Vec<RawVertex> = points.into_iter().map(|(p, z)| RawVertex { x: p.x, y: p.y, z, row: None }).collect();
            lines.push(RawLine { vertices, ..raw.clone() });
        }
        if lines.iter().flat_map(|line| &line.vertices).all(|v| v.z == Some(0.0)) {
            let message = format!("{}: all elevations are 0, which may stand for none", feature.text());
            notes.push(Note::new("landxml-flat", message));
        }
        Ok(lines)
    }

    /// The elements, in runs without gaps.
    fn runs(&self, feature: &Feature, worst: &mut Option<Worst>, notes: &mut Vec<Note>) -> Result<Vec<Vec<Piece>>, ReadError> {
        let mut runs: Vec<Vec<Piece>> = Vec::new();
        let mut length = 0.0;
        for part in &feature.parts {
            for (i, piece) in self.pieces(part, worst)?.into_iter().enumerate() {
                length += piece.element.length();
                let gap = runs.last().and_then(|run| run.last()).map(|last| last.element.to().distance(piece.element.from()));
                match (gap, runs.last_mut()) {
                    (Some(gap), Some(run)) if i > 0 || gap <= JOIN => run.push(piece),
                    (Some(gap), _) if feature.kind == Kind::Alignment => {
                        let what = format!("{} has a gap between two elements", feature.text());
                        let figures = format!("the one that begins here lies {gap:.4} from the end of the one before");
                        return Err(self.refuse(&what, part.at, figures, "mend the alignment: its stations cannot be told"));
                    }
                    _ => runs.push(vec![piece]),
                }
            }
        }
        if runs.len() > 1 {
            let message = format!("{}: its elements do not join, and it was taken as {} lines", feature.text(), runs.len());
            notes.push(Note::new("landxml-parts", message));
        }
        if let Some(declared) = feature.road.length.map(|declared| declared * self.scale.plan)
            && (declared - length).abs() > TOLD
        {
            let message = format!("{}: its elements are {length:.4} long, but it declares {declared:.4}", feature.text());
            notes.push(Note::new("landxml-length", message));
        }
        if feature.road.equations > 0 {
            let message = format!("{}: station equations do not matter here, and were passed over", feature.text());
            notes.push(Note::new("landxml-equations", message));
        }
        Ok(runs)
    }

    /// One element of the file as pieces: several, if it is a list of points.
    fn pieces(&self, part: &Part, worst: &mut Option<Worst>) -> Result<Vec<Piece>, ReadError> {
        let ends = |from: &Point, to: &Point| Ok::<_, ReadError>([self.point(from, part.at)?, self.point(to, part.at)?]);
        let ([(_, a), (_, b)], element) = match &part.shape {
            Shape::Points(points) => return self.straights(part, points, worst),
            Shape::Curve { from, to, centre, radius, left } => {
                let ends = ends(from, to)?;
                (ends, self.curve(part, ends.map(|end| end.0), centre.as_ref(), *radius, *left, worst)?)
            }
            Shape::Spiral { from, to, corner, radii, left } => {
                let ends = ends(from, to)?;
                (ends, self.spiral(part, ends.map(|end| end.0), corner.as_ref(), *radii, *left, worst)?)
            }
        };
        Ok(vec![Piece { element, heights: [a, b] }])
    }

    fn straights(&self, part: &Part, points: &[Point], worst: &mut Option<Worst>) -> Result<Vec<Piece>, ReadError> {
        let points = points.iter().map(|point| self.point(point, part.at)).collect::<Result<Vec<_>, _>>()?;
        let straight = |(from, to): (&Placed, &Placed)| Piece {
            element: Element::Straight { from: from.0, to: to.0 },
            heights: [from.1, to.1],
        };
        let pieces: Vec<Piece> = points.iter().zip(points.iter().skip(1)).map(straight).collect();
        if let ([piece], Some(declared)) = (pieces.as_slice(), self.declared(part)) {
            let misfit = Misfit { given: piece.element.length(), computed: declared };
            self.judge(misfit, "the length of a line", part, worst)?;
        }
        Ok(pieces)
    }

    fn curve(
        &self,
        part: &Part,
        [from, to]: [DVec2; 2],
        centre: Option<&Point>,
        radius: Option<f64>,
        left: bool,
        worst: &mut Option<Worst>,
    ) -> Result<Element, ReadError> {
        let declared = self.declared(part);
        let radius = radius.map(|radius| radius.abs() * self.scale.plan);
        let half_turn = |radius: f64| declared.is_some_and(|length| length > std::f64::consts::PI * radius);
        let element = match (centre, radius) {
            (Some(centre), _) => {
                let (centre, _) = self.point(centre, part.at)?;
                let mean = 0.5 * (centre.distance(from) + centre.distance(to));
                let (element, misfit) = Element::arc(centre, from, to, left, half_turn(mean));
                self.judge(misfit, "the radius of a curve", part, worst)?;
                if let Some(radius) = radius {
                    self.judge(Misfit { given: mean, computed: radius }, "the radius of a curve", part, worst)?;
                }
                Some(element)
            }
            (None, Some(radius)) => Element::arc_of_radius(radius, from, to, left, half_turn(radius)),
            (None, None) => None,
        };
        let Some(element) = element else {
            let figures = format!("its ends are {:.4} apart, its radius is {:.4}", from.distance(to), radius.unwrap_or(0.0));
            return Err(self.refuse("no circle goes through a curve", part.at, figures, "check its points and its radius"));
        };
        if let Some(declared) = declared {
            let misfit = Misfit { given: element.length(), computed: declared };
            self.judge(misfit, "the length of a curve", part, worst)?;
        }
        Ok(element)
    }

    fn spiral(
        &self,
        part: &Part,
        [from, to]: [DVec2; 2],
        corner: Option<&Point>,
        radii: [f64; 2],
        left: bool,
        worst: &mut Option<Worst>,
    ) -> Result<Element, ReadError> {
        let turn = if left { 1.0 } else { -1.0 };
        let curvature = radii.map(|radius| turn / (radius * self.scale.plan));
        let length = self.declared(part).unwrap_or(0.0);
        let Some((element, misfit)) = Element::clothoid(from, to, length, curvature) else {
            let radii = radii.map(|radius| radius * self.scale.plan);
            let figures = format!("length {length}, radii {} and {}, ends {:.4} apart", radii[0], radii[1], from.distance(to));
            return Err(self.refuse("no clothoid goes through a spiral", part.at, figures, "check its points, radii and length"));
        };
        self.judge(misfit, "the chord of a spiral", part, worst)?;
        if let Some(corner) = corner {
            let (corner, _) = self.point(corner, part.at)?;
            let ahead = (corner - from).normalize_or_zero();
            if ahead != DVec2::ZERO && ahead.dot(element.direction(0.0)) < TANGENT {
                let angle = ahead.angle_to(element.direction(0.0)).to_degrees();
                let figures = format!("its tangent and the line to its <PI> are {:.3}° apart", angle.abs());
                return Err(self.contradicts(part, figures));
            }
        }
        Ok(element)
    }

    /// The length an element declares.
    fn declared(&self, part: &Part) -> Option<f64> {
        part.length.map(|length| length * self.scale.plan)
    }

    /// Refuses figures of an element that contradict each other; keeps the worst of those that nearly do.
    fn judge(&self, misfit: Misfit, what: &'static str, part: &Part, worst: &mut Option<Worst>) -> Result<(), ReadError> {
        if misfit.size() > REFUSED.0 && misfit.size() > REFUSED.1 * misfit.given {
            let (given, computed) = (misfit.given, misfit.computed);
            let figures = format!("{what} by its coordinates is {given:.4}, by its other figures {computed:.4}");
            return Err(self.contradicts(part, figures));
        }
        if misfit.size() > worst.as_ref().map_or(TOLD, |worst| worst.misfit.size()) {
            *worst = Some(Worst { misfit, what, at: part.at });
        }
        Ok(())
    }

    fn contradicts(&self, part: &Part, figures: String) -> ReadError {
        self.refuse("an element contradicts itself", part.at, figures, "check its points, radii, length and rot")
    }

    /// A point in the unit of the scale.
    fn point(&self, point: &Point, at: usize) -> Result<Placed, ReadError> {
        let mut point = point;
        for _ in 0..MOST_NAMES {
            match point {
                Point::Here(plan, height) => return Ok((*plan * self.scale.plan, height.map(|z| z * self.scale.height))),
                Point::Named(name) => match self.features.points.get(name) {
                    Some(Some(named)) => point = named,
                    known => {
                        let what = match known {
                            None => format!("there is no point `{}`", clip(name.as_bytes())),
                            Some(_) => format!("several points at different places are named `{}`", clip(name.as_bytes())),
                        };
                        let figures = format!("there are {} named points", self.features.points.len());
                        return Err(self.refuse(&what, at, figures, "export the line with the coordinates of its points"));
                    }
                },
            }
        }
        let figures = format!("more than {MOST_NAMES} names in a row");
        Err(self.refuse("points only name each other", at, figures, "export the line with the coordinates of its points"))
    }

    /// The profile of an alignment and where it stands; `None` if its elements have heights of their own, or nothing has.
    fn profile(&self, chosen: &Chosen<'_>, runs: &[Vec<Piece>]) -> Result<Option<(Profile, usize)>, ReadError> {
        let feature = chosen.feature;
        let designs: Vec<&Heights> = feature.road.profiles.iter().filter(|profile| !profile.ground).collect();
        let names = |ground: bool| {
            let profiles = feature.road.profiles.iter().filter(|profile| profile.ground == ground).take(super::surface::LISTED);
            profiles.map(|p| format!("`{}`", clip(p.name.as_deref().unwrap_or("").as_bytes()))).collect::<Vec<_>>().join(", ")
        };
        let help = format!("give `--feature \"{}/PROFILE\"`", clip(feature.name.as_deref().unwrap_or("").as_bytes()));
        let heights = match (chosen.profile, designs.as_slice()) {
            (Some(profile), _) => profile,
            (None, [only]) => only,
            (None, []) => {
                let flat = runs.iter().flatten().flat_map(|piece| piece.heights).any(|height| height.is_none());
                if flat && !feature.road.profiles.is_empty() {
                    let what = format!("{} has no design profile", feature.text());
                    return Err(self.refuse(&what, feature.at, format!("profiles of the ground: {}", names(true)), &help));
                }
                return Ok(None);
            }
            (None, _) => {
                let what = format!("{} has several profiles", feature.text());
                return Err(self.refuse(&what, feature.at, names(false), &help));
            }
        };
        let points: Vec<Pvi> = heights.points.iter().enumerate().map(|(i, pvi)| self.pvi(&heights.points, i, pvi)).collect();
        let profile = Profile::new(&points).map_err(|error| {
            let plan = self.scale.plan;
            let figures = match error {
                ProfileError::TooFew => format!("{} points", points.len()),
                ProfileError::Order(a, b) => format!("station {} comes behind {}", b / plan, a / plan),
                ProfileError::NoRoom { station, needs, room } => {
                    format!(
                        "the curve at station {} needs {:.4} on one side, where there is {:.4}",
                        station / plan,
                        needs / plan,
                        room / plan
                    )
                }
                ProfileError::NoCurve(station) => {
                    format!("the curve at station {} has no length or radius, or is at an end", station / plan)
                }
            };
            self.refuse(
                &format!("the profile of {} cannot be built", feature.text()),
                heights.at,
                figures,
                "check the points and curves of the profile, or take other lines with `--feature NAME`",
            )
        })?;
        Ok(Some((profile, heights.at)))
    }

    /// A point of the profile in the unit of the scale; circles without a radius get it from their length.
    fn pvi(&self, points: &[RawPvi], i: usize, pvi: &RawPvi) -> Pvi {
        let (plan, height) = (self.scale.plan, self.scale.height);
        let curve = match pvi.curve {
            RawCurve::None => Curve::Break,
            RawCurve::Parabola(before, behind) => Curve::Parabola(before * plan, behind * plan),
            RawCurve::Circle(Some(radius), _) => Curve::Circle(radius * plan),
            RawCurve::Circle(None, length) => {
                let angle = |a: &RawPvi, b: &RawPvi| ((b.height - a.height) * height).atan2((b.station - a.station) * plan);
                let turn = match (i.checked_sub(1).and_then(|i| points.get(i)), points.get(i + 1)) {
                    (Some(before), Some(behind)) => (angle(pvi, behind) - angle(before, pvi)).abs(),
                    _ => 0.0,
                };
                Curve::Circle(length.unwrap_or(0.0) * plan / turn)
            }
        };
        Pvi { station: pvi.station * plan, height: pvi.height * height, curve }
    }

    /// The stations that both the elements and the profile have; tells where one is longer.
    fn common(
        &self,
        feature: &Feature,
        run: &[Piece],
        profile: &Profile,
        at: usize,
        notes: &mut Vec<Note>,
    ) -> Result<[f64; 2], ReadError> {
        let begin = feature.road.start * self.scale.plan;
        let end = begin + run.iter().map(|piece| piece.element.length()).sum::<f64>();
        let (first, last) = (profile.begin(), profile.end());
        let plan = self.scale.plan;
        let figures = format!(
            "elements from station {:.4} to {:.4}, profile from {:.4} to {:.4}",
            begin / plan,
            end / plan,
            first / plan,
            last / plan
        );
        // What is missing to the digits of stations is the grade going on.
        let from = if first - begin > JOIN { first } else { begin };
        let to = if end - last > JOIN { last } else { end };
        if from >= to {
            let what = format!("the profile of {} lies beside its elements", feature.text());
            return Err(self.refuse(&what, at, figures, "check staStart and the stations of the profile"));
        }
        if from > begin || to < end {
            notes.push(Note::new(
                "landxml-profile-short",
                format!("{}: only where it has a profile is it a line: {figures}", feature.text()),
            ));
        }
        Ok([from, to])
    }
}

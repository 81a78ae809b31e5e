//! Segments as steep as the slope, or steeper, cannot lie on a surface of that slope.

use super::place::Locator;
use crate::model::digits::{fixed, rounded};
use crate::model::{Chain, Defect, Defects, Line, Slope};

/// Gradients of this part of the slope, or more, are as steep as it: rulings of such a segment run along it all but, and rounding
/// decides where they go.
const HOLDS: f64 = 1.0 - 1e-10;

/// Refuses every segment with `|Δz| ≥ k·L`, but for the part that rounding may lose. Neighbouring steep segments are reported as one stretch, with its stations and
/// its steepest gradient.
///
/// # Errors
/// All such stretches, with the flattest slope that would do for the whole line as the cure.
pub fn check_steepness(line: &Line, label: &str, slope: Slope) -> Result<(), Defects> {
    let k = HOLDS * slope.ratio();
    let mut defects = Defects::default();
    let mut steepest = 0.0f64;
    for chain in &line.chains {
        for i in 0..chain.segment_count() {
            steepest = steepest.max(gradient(chain.segment(i)).abs());
        }
    }
    let help = || match flattest(steepest) {
        Some(slope) => format!("flatten the line there, or ask for {slope} or steeper"),
        None => "flatten the line there: it is upright, or nearly so, and no slope holds it".to_owned(),
    };
    for (chain, locator) in line.chains.iter().zip(Locator::of_chains(label, &line.chains)) {
        let is_steep = |i: usize| {
            let (a, b) = chain.segment(i);
            (b.z - a.z).abs() >= k * a.truncate().distance(b.truncate())
        };
        let stations = chain.axis.as_ref().map_or_else(|| chain.stations(), |axis| axis.stations.clone());
        let n = chain.segment_count();
        let mut i = 0;
        while i < n {
            if !is_steep(i) {
                i += 1;
                continue;
            }
            let end = (i + 1..n).find(|&j| !is_steep(j)).unwrap_or(n);
            let from = std::mem::replace(&mut i, end);
            defects.push("too-steep", || {
                let worst = (from..end).map(|j| gradient(chain.segment(j)).abs()).fold(0.0, f64::max);
                let name = &chain.name;
                let (what, gradient) = if chain.axis.is_some() {
                    (format!("an edge of the road `{name}` is"), "steepest gradient")
                } else if end - from == 1 {
                    (format!("segment {} of `{name}` is", from + 1), "gradient")
                } else {
                    (format!("segments {} to {end} of `{name}` are", from + 1), "steepest gradient")
                };
                Defect {
                    code: "too-steep",
                    what: format!("{what} as steep as the slope asked for, or steeper"),
                    at: locator.pair(chain.places[from], chain.places[end % chain.places.len()]),
                    figures: Some(format!(
                        "stations {:.3} to {:.3}{}: {gradient} {} ({:.1} %, {:.2}°); slope asked for 1V:{}H ({:.1} %, {:.2}°)",
                        stations[from].min(if chain.axis.is_some() { stations[end] } else { stations[from] }),
                        stations[end].max(if chain.axis.is_some() { stations[from] } else { stations[end] }),
                        along_axis(chain, stations[from], stations[end]),
                        rounded(worst, 4),
                        100.0 * worst,
                        worst.atan().to_degrees(),
                        rounded(slope.one_in(), 4),
                        slope.percent(),
                        slope.degrees()
                    )),
                    help: help(),
                }
            });
        }
    }
    defects.into_result()
}

/// Where stations are those of a centre line: why its edge can be steeper than the line itself.
fn along_axis(chain: &Chain, from: f64, to: f64) -> &'static str {
    match &chain.axis {
        None => "",
        Some(_) if from == to => " of the centre line, across the road",
        Some(_) => " of the centre line (the inside of a bend is shorter than the centre line)",
    }
}

/// Rise per run; infinite only if a segment had no plan length, which the model excludes.
fn gradient((a, b): (glam::DVec3, glam::DVec3)) -> f64 {
    (b.z - a.z) / a.truncate().distance(b.truncate())
}

/// The flattest slope in three significant digits of its run that is steeper than `gradient`: `1:1.21`, or `1V:0.5H` where
/// `1:0.5` would be ambiguous. `None` beyond the slopes that can be asked for ([`Slope::ACCEPTED`]).
fn flattest(gradient: f64) -> Option<String> {
    // A gradient of up to 2 · INPUT_LIMIT over MERGE_DISTANCE needs 18 decimals.
    let limit = 1.0 / gradient;
    // A limit that is a power of ten counts as just below it: 0.999 follows 1, not 0.99.
    let decimals = (3 - limit.log10().ceil() as i32).clamp(0, 18);
    let scale = 10f64.powi(decimals);
    let mut digits = (limit * scale).floor();
    // Strictly steeper, also where the limit is a round number or rounding met it.
    while digits > 1.0 && HOLDS / (digits / scale) <= gradient {
        digits -= 1.0;
    }
    let n = digits / scale;
    let text = fixed(n, decimals as usize);
    let text = if n >= 1.0 { format!("1:{text}") } else { format!("1V:{text}H") };
    Some(text).filter(|text| text.parse::<Slope>().is_ok())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Place, Role};
    use glam::DVec3;

    fn line(points: &[[f64; 3]], role: Role) -> Line {
        let vertices: Vec<DVec3> = points.iter().map(|&p| p.into()).collect();
        let places = (0..points.len() as u32).map(|i| Place { feature: None, vertex: i + 1, row: Some(i + 2) }).collect();
        Line { chains: vec![Chain { name: "line 1".into(), role, vertices, places, axis: None }], ..Line::default() }
    }

    #[test]
    fn the_cure_is_steeper_and_the_next_flatter_is_not() {
        // 1 / 0.82 = 1.2195…
        let flattest = |gradient: f64| flattest(gradient).unwrap();
        assert_eq!(flattest(0.82), "1:1.21");
        // Round limits: the slope itself would be as steep as the gradient.
        assert_eq!(flattest(0.5), "1:1.99");
        assert_eq!(flattest(1.0), "1V:0.999H");
        assert_eq!(flattest(0.1), "1:9.99");
        assert_eq!(flattest(170.0), "1V:0.00588H");
        assert_eq!(flattest(0.0004), "1:2499");
        for i in 1..2000 {
            let gradient = f64::from(i) * 0.0137;
            let text = flattest(gradient);
            let n: f64 = text.trim_start_matches("1V:").trim_start_matches("1:").trim_end_matches('H').parse().unwrap();
            assert!(1.0 / n > gradient, "{gradient}: {text}");
            assert!(1.0 / (n * 1.02) <= gradient, "{gradient}: {text} is steeper than it need be");
        }
    }

    /// Rounding makes these a hair flatter than 1:10 and 1:1.5, which they are.
    #[test]
    fn equal_but_for_rounding_is_as_steep() {
        for (slope, flatter) in [("1:10", 1e-16), ("1:1.5", 1e-16), ("1:1.5", 1e-12)] {
            let slope: Slope = slope.parse().unwrap();
            let rise = 16.0 * slope.ratio() * (1.0 - flatter);
            for z in [-3.3, 0.0, 100.0] {
                let level = line(&[[4.0, -40.0, z], [4.0, -56.0, z - rise]], Role::Open);
                assert!(check_steepness(&level, "a", slope).is_err());
            }
            let less = line(&[[4.0, -40.0, 0.0], [4.0, -56.0, -rise * (1.0 - 1e-9)]], Role::Open);
            assert!(check_steepness(&less, "a", slope).is_ok());
        }
    }

    #[test]
    fn a_cure_can_be_asked_for_or_is_not_given() {
        assert_eq!(flattest(9_000.0).as_deref(), Some("1V:0.000111H"));
        assert_eq!((flattest(9_999.9).as_deref(), flattest(10_000.0), flattest(250_000.0)), (Some("1V:0.0001H"), None, None));
        let upright = line(&[[0., 0., 0.], [1e-5, 0., 5.]], Role::Open);
        let message = check_steepness(&upright, "a.csv", Slope::from_ratio(0.8).unwrap()).unwrap_err().to_string();
        assert!(
            message.ends_with("help: flatten the line there: it is upright, or nearly so, and no slope holds it"),
            "{message}"
        );
    }

    #[test]
    fn names_every_steep_stretch() {
        // Plan lengths 5 (3-4-5 triangle), 10, 10, 10; rises 5, 0, 8, −20.
        let points = [[0., 0., 0.], [3., 4., 5.], [13., 4., 5.], [23., 4., 13.], [33., 4., -7.]];
        let slope = Slope::from_ratio(0.8).unwrap();
        let error = check_steepness(&line(&points, Role::Open), "a.csv", slope).unwrap_err();
        assert_eq!(
            error.to_string(),
            "segment 1 of `line 1` is as steep as the slope asked for, or steeper\n  --> a.csv, rows 2 to 3\n   \
             = stations 0.000 to 5.000: gradient 1 (100.0 %, 45.00°); slope asked for 1V:1.25H (80.0 %, 38.66°)\n\
             error: segments 3 to 4 of `line 1` are as steep as the slope asked for, or steeper\n  --> a.csv, rows 4 to 6\n   \
             = stations 15.000 to 35.000: steepest gradient 2 (200.0 %, 63.43°); slope asked for 1V:1.25H (80.0 %, 38.66°)\n   \
             = help: flatten the line there, or ask for 1V:0.499H or steeper"
        );
    }

    #[test]
    fn the_closing_segment_counts_and_below_the_slope_all_is_well() {
        let points = [[0., 0., 0.], [10., 0., 4.], [20., 10., 8.], [0., 10., 9.]];
        let slope = Slope::from_ratio(0.5).unwrap();
        assert!(check_steepness(&line(&points, Role::Open), "a", slope).is_ok());
        let error = check_steepness(&line(&points, Role::Outer { polygon: 0 }), "a", slope).unwrap_err();
        assert_eq!(error.list[0].at, "a, rows 5 to 2");
        assert!(check_steepness(&line(&points, Role::Outer { polygon: 0 }), "a", Slope::from_ratio(0.91).unwrap()).is_ok());
    }
}

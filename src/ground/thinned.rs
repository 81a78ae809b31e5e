//! The line with fewer vertices, where a bound is all that is asked of it.

use crate::model::{Axis, Chain, Line};

/// A line of vertices of `line` from which its own are no further than `step`, in plan and along the line; `None` if that
/// is not less than half of them. Its sheets of slope `k` are nowhere further than `2·k·step` from those of `line`, if `line` is
/// nowhere as steep as that.
///
/// Each point `p` of the line lies within `step` of a vertex `q` that is kept, so that `z(p) − k·|x − p| ≤ z(q) + k·step −
/// k·(|x − q| − step)`; the same holds for the chords between them.
pub(crate) fn thinned(line: &Line, step: f64) -> Option<Line> {
    let chains: Vec<Chain> = line.chains.iter().map(|chain| of_chain(chain, step)).collect();
    let thin = Line { chains, breaklines: Vec::new() };
    (2 * thin.vertex_count() <= line.vertex_count()).then_some(thin)
}

fn of_chain(chain: &Chain, step: f64) -> Chain {
    let plan = |i: usize| chain.vertices[i % chain.vertices.len()].truncate();
    let last = chain.vertices.len() - 1;
    let mut kept = vec![0];
    let mut way = 0.0;
    for i in 1..=last {
        way += plan(i - 1).distance(plan(i));
        let is_end = i == last && !chain.closed();
        if is_end || way + plan(i).distance(plan(i + 1)) > step {
            kept.push(i);
            way = 0.0;
        }
    }
    let well_closed = !chain.closed() || plan(kept[kept.len() - 1]) != plan(0);
    let apart = well_closed && kept.windows(2).all(|w| plan(w[0]) != plan(w[1]));
    if kept.len() < 3 || !apart {
        // Too small to be thinned, or wound up.
        return chain.clone();
    }
    let stations = |axis: &Axis| {
        let of_kept = kept.iter().map(|&i| axis.stations[i]);
        Axis { stations: of_kept.chain(axis.stations.get(last + 1).copied()).collect(), ..axis.clone() }
    };
    Chain {
        name: chain.name.clone(),
        role: chain.role,
        vertices: kept.iter().map(|&i| chain.vertices[i]).collect(),
        places: kept.iter().map(|&i| chain.places[i]).collect(),
        axis: chain.axis.as_ref().map(stations),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Place, Role, Sheet, Slope};
    use crate::sheet::Heights;
    use glam::{DVec2, DVec3};

    fn line(role: Role, vertices: Vec<DVec3>) -> Line {
        let places = vec![Place::default(); vertices.len()];
        let stations = vec![0.0; vertices.len() + 1];
        let axis = Some(Axis { name: "a".into(), length: 1.0, stations, sagitta: 0.0 });
        Line { chains: vec![Chain { name: "line 1".into(), role, vertices, places, axis }], breaklines: Vec::new() }
    }

    #[test]
    fn sheets_move_no_further_than_said() {
        // A wave of 2000 vertices, and the same as a ring.
        let vertices: Vec<DVec3> = (0..2000)
            .map(|i| f64::from(i) * std::f64::consts::TAU / 2000.0)
            .map(|w| DVec3::new(40.0 * w.cos(), (30.0 + (9.0 * w).sin()) * w.sin(), 100.0 + 5.0 * (2.0 * w).sin()))
            .collect();
        let (k, step) = (0.5, 0.8);
        let slope = Slope::from_ratio(k).unwrap();
        for role in [Role::Open, Role::Outer { polygon: 0 }] {
            let given = line(role, vertices.clone());
            let thin = thinned(&given, step).unwrap();
            let chain = &thin.chains[0];
            assert!(chain.vertices.len() < 500 && chain.places.len() == chain.vertices.len());
            assert_eq!(chain.axis.as_ref().unwrap().stations.len(), chain.vertices.len() + 1);
            assert_eq!(chain.vertices[0], vertices[0]);
            if role == Role::Open {
                assert_eq!(chain.vertices.last(), vertices.last());
            }
            for sheet in [Sheet::Falling, Sheet::Rising] {
                let (a, b) = (Heights::new(&given, slope, sheet), Heights::new(&thin, slope, sheet));
                for i in 0..400 {
                    let p = DVec2::new(f64::from(i % 20) * 6.0 - 60.0, f64::from(i / 20) * 5.0 - 50.0);
                    assert!((a.at(p) - b.at(p)).abs() <= 2.0 * k * step, "{p}");
                }
            }
        }
    }

    #[test]
    fn lines_of_few_vertices_stay() {
        let vertices: Vec<DVec3> = (0..50).map(|i| DVec3::new(f64::from(i), 0.0, 1.0)).collect();
        assert_eq!(thinned(&line(Role::Open, vertices.clone()), 0.5), None);
        // All of it is smaller than the step.
        assert_eq!(thinned(&line(Role::Open, vertices), 200.0), None);
    }
}

//! Cutting a piece at a station.

use crate::ground::Corner;

/// Splits a convex polygon at a station into what lies `before` and what lies `behind`; both are overwritten, and each has fewer
/// than three corners where nothing of it lies there. Corners at the station belong to both.
pub(in crate::ground) fn split(corners: &[Corner], station: f64, before: &mut Vec<Corner>, behind: &mut Vec<Corner>) {
    before.clear();
    behind.clear();
    let Some(mut from) = corners.last() else { return };
    for to in corners {
        if (from.station < station && to.station > station) || (from.station > station && to.station < station) {
            let cut = between(from, to, station);
            before.push(cut);
            behind.push(cut);
        }
        if to.station <= station {
            before.push(*to);
        }
        if to.station >= station {
            behind.push(*to);
        }
        from = to;
    }
}

/// The point of an edge at a station. From the lower to the higher end, whichever way the edge runs: neighbours get the same
/// bits.
fn between(a: &Corner, b: &Corner, station: f64) -> Corner {
    let (low, high) = if a.station < b.station { (a, b) } else { (b, a) };
    let share = (station - low.station) / (high.station - low.station);
    Corner { at: low.at.lerp(high.at, share), height: low.height + (high.height - low.height) * share, station }
}

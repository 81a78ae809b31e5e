//! Where three facets meet: first along the boundary of one of them, then exactly.

use super::closure::twin_strip;
use super::facet::{Crossing, FacetId};
use super::trim::Sheet;
use crate::kernel::dd::DdVec2;

/// Crossing of ruling `τ` of `f` with partner `k`, so that the nearer partner has the smaller quotient. Covered stretches
/// (partner: the twin) count from where the other partner's crossing has reached the foot.
fn crossing(sheet: &Sheet, f: FacetId, k: FacetId, tau: f64) -> Crossing {
    let facet = sheet.facet(f);
    sheet.crossing(facet.foot(tau), facet.ruling(tau), k)
}

/// Parameter between `lo` and `hi` at which `f` meets `ka` (nearer at `lo`) and `kb` (nearer at `hi`) at once.
pub(super) fn root(sheet: &Sheet, f: FacetId, ka: FacetId, kb: FacetId, lo: f64, hi: f64) -> Option<f64> {
    let hidden = twin_strip(sheet, f);
    let strip = sheet.facet(f).is_strip();
    let excess = |tau: f64| {
        if strip && kb == hidden {
            return -crossing(sheet, f, ka, tau).num;
        }
        if strip && ka == hidden {
            return crossing(sheet, f, kb, tau).num;
        }
        let (a, b) = (crossing(sheet, f, ka, tau), crossing(sheet, f, kb, tau));
        a.num * b.den - b.num * a.den
    };
    bracket(excess, lo, hi)
}

/// The point where `f`, `ka` and `kb` have the same height, in double-double, from a first guess on ruling `τ`.
pub(super) fn polish(sheet: &Sheet, f: FacetId, ka: FacetId, kb: FacetId, tau: f64) -> DdVec2 {
    const STEPS: usize = 8;
    let facet = sheet.facet(f);
    let foot = facet.foot(tau);
    let covered = twin_strip(sheet, f);
    let length = |k: FacetId| {
        if facet.is_strip() && k == covered { 0.0 } else { crossing(sheet, f, k, tau).length() }
    };
    let (ra, rb) = (length(ka), length(kb));
    let reach = ((foot.z - sheet.end) / sheet.k).max(0.0);
    let r = if ra.is_finite() && rb.is_finite() { 0.5 * (ra + rb) } else { ra.min(rb) };
    let mut x = DdVec2::from(facet.point(tau, r.min(2.0 * reach)).truncate());
    for _ in 0..STEPS {
        let own = sheet.height_dd(f, x);
        let (fa, fb) = (own - sheet.height_dd(ka, x), own - sheet.height_dd(kb, x));
        let gradient = sheet.gradient_dd(f, x);
        let (ga, gb) = ((gradient - sheet.gradient_dd(ka, x)).to_f64(), (gradient - sheet.gradient_dd(kb, x)).to_f64());
        let det = ga.perp_dot(gb);
        let (ra, rb) = (fa.to_f64(), fb.to_f64());
        let step = glam::DVec2::new(ra * gb.y - rb * ga.y, rb * ga.x - ra * gb.x) / det;
        if !step.is_finite() {
            break;
        }
        x = x - DdVec2::from(step);
        if step.abs().max_element() <= 1e-24 * (1.0 + x.to_f64().abs().max_element()) {
            break;
        }
    }
    x
}

/// A zero of `f` between `lo`, where it must not be positive, and `hi`, where it must not be negative; `None` without that
/// change of sign. Illinois steps with bisection every fourth; ends when the bracket cannot shrink.
fn bracket(f: impl Fn(f64) -> f64, mut lo: f64, mut hi: f64) -> Option<f64> {
    const STEPS: usize = 100;
    let (mut at_lo, mut at_hi) = (f(lo), f(hi));
    if at_lo > 0.0 || at_hi < 0.0 {
        return None;
    }
    if at_lo == 0.0 || at_hi == 0.0 {
        return Some(if at_lo == 0.0 { lo } else { hi });
    }
    let width = hi - lo;
    let mut last_side = 0;
    for step in 0..STEPS {
        let mut mid = (lo * at_hi - hi * at_lo) / (at_hi - at_lo);
        if step % 4 == 3 || !(mid > lo && mid < hi) {
            mid = 0.5 * (lo + hi);
        }
        if !(mid > lo && mid < hi) || hi - lo <= f64::EPSILON * width {
            break;
        }
        let value = f(mid);
        if value == 0.0 {
            return Some(mid);
        }
        if value < 0.0 {
            (lo, at_lo) = (mid, value);
            if last_side == -1 {
                at_hi *= 0.5;
            }
            last_side = -1;
        } else {
            (hi, at_hi) = (mid, value);
            if last_side == 1 {
                at_lo *= 0.5;
            }
            last_side = 1;
        }
    }
    Some(0.5 * (lo + hi))
}

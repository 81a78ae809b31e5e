//! Mass haul: what is left over, or lacking, from the beginning of an axis up to each station.

use super::Interval;
use crate::kernel::sum::Sum;
use crate::model::Bulking;

/// Running net up to the end of one interval. Positive is left over, negative is lacking.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Haul {
    /// Cut − fill as measured.
    pub net: f64,
    /// Cut − fill where all soil is compacted: what the cut gives, less the fill.
    pub compacted: Option<f64>,
}

/// The running net over the intervals of one axis, at the end of each; compacted where the bulking of the soil is known.
pub fn mass_haul(intervals: &[Interval], bulking: Option<Bulking>) -> Vec<Haul> {
    let (mut net, mut compacted) = (Sum::default(), Sum::default());
    let step = |interval: &Interval| {
        let amounts = &interval.amounts;
        net.add(amounts.cut);
        net.add(-amounts.fill);
        let compacted = bulking.map(|soil| {
            compacted.add(soil.compacted(amounts.cut));
            compacted.add(-amounts.fill);
            compacted.value()
        });
        Haul { net: net.value(), compacted }
    };
    intervals.iter().map(step).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ground::Amounts;

    /// Cut 100, 0, 50 against fill 0, 95, 40: net 100, 5, 15. At 10 % shrink the cuts give 90 and 45: 90, −5, 0.
    #[test]
    fn surplus_can_be_deficit_when_compacted() {
        let interval = |(cut, fill)| Interval { amounts: Amounts { cut, fill, ..Amounts::default() }, ..Interval::default() };
        let intervals = [(100.0, 0.0), (0.0, 95.0), (50.0, 40.0)].map(interval);
        let raw = mass_haul(&intervals, None);
        assert_eq!(raw.iter().map(|h| h.net).collect::<Vec<_>>(), [100.0, 5.0, 15.0]);
        assert!(raw.iter().all(|h| h.compacted.is_none()));
        let soil = Bulking::new(0.25, 0.1).unwrap();
        let found = mass_haul(&intervals, Some(soil));
        for (haul, expected) in found.iter().zip([90.0, -5.0, 0.0]) {
            assert!((haul.compacted.unwrap() - expected).abs() < 1e-13, "{haul:?}");
        }
        assert_eq!(found[2].net, 15.0);
    }
}

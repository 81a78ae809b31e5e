//! Places in messages.

use crate::model::{Chain, Place};

/// Says where vertices of one line stand: `road.geojson, feature 2, vertices 7 to 8` or `road.csv, row 34`.
#[derive(Clone, Copy, Debug)]
pub struct Locator<'a> {
    label: &'a str,
    /// Number of the line within its feature, where the feature has several.
    part: Option<u32>,
}

impl<'a> Locator<'a> {
    /// A locator for each of a sequence of lines, given the feature each belongs to.
    pub fn of_features(label: &'a str, features: &[Option<u32>]) -> Vec<Self> {
        let mut part = 0;
        (0..features.len())
            .map(|i| {
                let same = |j: Option<usize>| j.and_then(|j| features.get(j)) == Some(&features[i]);
                let (before, after) = (same(i.checked_sub(1)), same(Some(i + 1)));
                part = if before { part + 1 } else { 1 };
                Self { label, part: (before || after).then_some(part) }
            })
            .collect()
    }

    /// A locator for each chain.
    pub fn of_chains(label: &'a str, chains: &[Chain]) -> Vec<Self> {
        let features: Vec<_> = chains.iter().map(|chain| chain.places.first().and_then(|p| p.feature)).collect();
        Self::of_features(label, &features)
    }

    /// The line as a whole.
    pub fn line(&self, feature: Option<u32>) -> String {
        let mut text = self.label.to_owned();
        if let Some(feature) = feature {
            text.push_str(&format!(", feature {feature}"));
        }
        if let Some(part) = self.part {
            text.push_str(&format!(", part {part}"));
        }
        text
    }

    /// One vertex.
    pub fn vertex(&self, place: Place) -> String {
        match place.row {
            Some(row) => format!("{}, row {row}", self.label),
            None => format!("{}, vertex {}", self.line(place.feature), place.vertex),
        }
    }

    /// A pair of vertices, e.g. the ends of a segment.
    pub fn pair(&self, a: Place, b: Place) -> String {
        match (a.row, b.row) {
            (Some(a), Some(b)) => format!("{}, rows {a} to {b}", self.label),
            _ => format!("{}, vertices {} to {}", self.line(a.feature), a.vertex, b.vertex),
        }
    }

    /// A segment, without the file: for messages that name two.
    pub fn segment(&self, a: Place, b: Place) -> String {
        let part = match (a.feature, self.part) {
            (Some(feature), Some(part)) => format!("feature {feature}, part {part}, "),
            (Some(feature), None) => format!("feature {feature}, "),
            (None, Some(part)) => format!("part {part}, "),
            (None, None) => String::new(),
        };
        match (a.row, b.row) {
            (Some(a), Some(b)) => format!("rows {a} to {b}"),
            _ => format!("{part}vertices {} to {}", a.vertex, b.vertex),
        }
    }
}

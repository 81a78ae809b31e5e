//! Words and figures on paper: how wide they are, and which of them have room.

use glam::DVec2;

/// Width of a letter, as a share of the size of the text: a little more than the digits of common sans-serif fonts are wide
/// (DejaVu Sans, the widest of them: 0.636).
const LETTER: f64 = 0.6;

/// Letters of writing systems without spaces, as wide as they are high.
const WIDE: f64 = 1.05;

/// About how wide a text is, in px.
pub(super) fn width(text: &str, size: f64) -> f64 {
    let is_wide = |c: char| matches!(c, '\u{1100}'..='\u{115f}' | '\u{2e80}'..);
    text.chars().map(|c| if is_wide(c) { WIDE } else { LETTER }).sum::<f64>() * size
}

/// A text that fits into a width, the end cut off where it must be.
pub(super) fn fitted(text: &str, size: f64, room: f64) -> String {
    let text = text.trim();
    if width(text, size) <= room {
        return text.to_owned();
    }
    let mut kept = String::new();
    let mut used = width("…", size);
    for c in text.chars() {
        used += width(c.encode_utf8(&mut [0; 4]), size);
        if used > room {
            break;
        }
        kept.push(c);
    }
    kept.truncate(kept.trim_end().len());
    kept.push('…');
    kept
}

/// A rectangle at any angle.
#[derive(Clone, Copy, Debug)]
struct Plate {
    centre: DVec2,
    along: DVec2,
    half: DVec2,
}

impl Plate {
    fn meets(&self, other: &Self) -> bool {
        let between = other.centre - self.centre;
        if between.length() > self.half.length() + other.half.length() {
            return false;
        }
        // Two rectangles are apart if and only if one of their four directions parts them.
        let reach = |plate: &Self, axis: DVec2| {
            plate.half.x * plate.along.dot(axis).abs() + plate.half.y * plate.along.perp().dot(axis).abs()
        };
        let parts = |axis: DVec2| between.dot(axis).abs() > reach(self, axis) + reach(other, axis);
        ![self.along, self.along.perp(), other.along, other.along.perp()].into_iter().any(parts)
    }
}

/// Most labels of one drawing: each is compared with all before it.
const MOST: usize = 600;

/// Labels that have been set.
#[derive(Debug, Default)]
pub(super) struct Labels {
    taken: Vec<Plate>,
}

impl Labels {
    /// Keeps a rectangle free of labels.
    pub(super) fn block(&mut self, lo: DVec2, hi: DVec2) {
        self.taken.push(Plate { centre: 0.5 * (lo + hi), along: DVec2::X, half: 0.5 * (hi - lo) });
    }

    /// Takes room for a rectangle; false if there is none.
    pub(super) fn take_box(&mut self, lo: DVec2, hi: DVec2) -> bool {
        self.take_plate(Plate { centre: 0.5 * (lo + hi), along: DVec2::X, half: 0.5 * (hi - lo) })
    }

    /// Takes room for a text about a point, turned by `turn` degrees clockwise on paper; false if there is none.
    pub(super) fn take(&mut self, centre: DVec2, turn: f64, text: &str, size: f64) -> bool {
        let half = DVec2::new(0.5 * width(text, size) + 2.0, 0.5 * size + 1.0);
        self.take_plate(Plate { centre, along: DVec2::from_angle(turn.to_radians()), half })
    }

    fn take_plate(&mut self, plate: Plate) -> bool {
        let free = self.taken.len() < MOST && !self.taken.iter().any(|other| plate.meets(other));
        if free {
            self.taken.push(plate);
        }
        free
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_do_not_lie_on_each_other() {
        let mut labels = Labels::default();
        labels.block(DVec2::new(0.0, 0.0), DVec2::new(10.0, 10.0));
        assert!(!labels.take(DVec2::new(12.0, 5.0), 0.0, "100", 11.0));
        assert!(labels.take(DVec2::new(40.0, 5.0), 0.0, "100", 11.0));
        assert!(!labels.take(DVec2::new(40.0, 14.0), 90.0, "100", 11.0));
        assert!(labels.take(DVec2::new(40.0, 30.0), 90.0, "100", 11.0));
        // Their boxes meet, they do not.
        assert!(labels.take(DVec2::new(100.0, 100.0), 45.0, "1000000", 11.0));
        assert!(labels.take(DVec2::new(112.0, 88.0), 45.0, "1000000", 11.0));
    }

    #[test]
    fn texts_are_cut_to_fit() {
        assert_eq!(fitted("short ", 10.0, 100.0), "short");
        assert_eq!(fitted("a rather long name", 10.0, 60.0), "a rather…");
        assert_eq!(fitted("測測測測測測測", 10.0, 40.0), "測測測…");
    }
}

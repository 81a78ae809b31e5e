//! The word that was meant.

/// Letters that may differ for each three there are, so that short words are not taken for others.
const LETTERS_PER_SLIP: usize = 3;

/// The word of a list nearest to another by letters changed, left out and put in (Levenshtein); `None` if none is near. Of
/// several the first.
pub(super) fn nearest<'a>(word: &str, list: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let longest = word.chars().count();
    let most = (longest / LETTERS_PER_SLIP).max(1);
    let near = |other: &&str| other.chars().count() <= longest + most;
    let by_distance = list.into_iter().filter(near).map(|other| (distance(word, other), other));
    by_distance.min_by_key(|(distance, _)| *distance).filter(|(distance, _)| *distance <= most).map(|(_, other)| other)
}

/// Letters to be changed, left out and put in.
fn distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.chars().enumerate() {
        let mut diagonal = std::mem::replace(&mut row[0], i + 1);
        for (j, y) in b.iter().enumerate() {
            let changed = diagonal + usize::from(x != *y);
            diagonal = row[j + 1];
            row[j + 1] = changed.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row.last().copied().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances() {
        for (a, b, expected) in [("", "", 0), ("abc", "", 3), ("", "ab", 2), ("kitten", "sitting", 3), ("flaw", "lawn", 2)] {
            assert_eq!((distance(a, b), distance(b, a)), (expected, expected), "{a} {b}");
        }
    }

    #[test]
    fn only_what_is_near_is_offered() {
        let list = ["slope", "cut-slope", "side"];
        assert_eq!(nearest("slop", list), Some("slope"));
        assert_eq!(nearest("cutslope", list), Some("cut-slope"));
        assert_eq!(nearest("sid", list), Some("side"));
        assert_eq!(nearest("colour", list), None);
        assert_eq!(nearest(&"x".repeat(1000), list), None);
    }
}

//! Notes and defects: what the reader and the checks have to say about an input.

use std::fmt;

/// Notes on the result itself rather than on how the input was read.
const WARNINGS: [&str; 20] = [
    "buried",
    "line-beyond-end",
    "ground-single-precision",
    "ground-points-conflict",
    "ground-holes",
    "ground-pieces",
    "ground-spikes",
    "design-uncovered",
    "platform-uncovered",
    "line-uncovered",
    "line-too-dense",
    "open-ends",
    "walls",
    "level-missed",
    "crs-differ",
    "origin-stale",
    "meshes-swapped",
    "lies-double",
    "single-precision",
    "units-differ",
];

/// Something worth knowing that does not stop the work.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Note {
    /// Stable short name, e.g. `duplicates-merged`.
    pub code: &'static str,
    /// The message, with counts and figures.
    pub message: String,
}

impl Note {
    /// A note.
    pub fn new(code: &'static str, message: impl Into<String>) -> Self {
        Self { code, message: message.into() }
    }

    /// Whether it is about the result itself rather than about how the input was read.
    pub fn is_warning(&self) -> bool {
        WARNINGS.contains(&self.code)
    }
}

/// One thing wrong with an input.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Defect {
    /// Stable short name of the kind of defect, e.g. `no-elevation`.
    pub code: &'static str,
    /// What is wrong, in one line.
    pub what: String,
    /// Where: path with feature, vertex, row.
    pub at: String,
    /// The figures that show it.
    pub figures: Option<String>,
    /// What mends it. The same for all defects of one code.
    pub help: String,
}

/// How many defects of one code are listed one by one; the rest is counted.
const LISTED: usize = 20;

/// All defects of one input: never empty when returned as an error.
///
/// `Display` writes one block per defect, without the leading `error: ` of the first (whoever prints it puts that), blocks of
/// one code together in the order of first occurrence, what is wrong once for blocks that say the same, the help once under
/// the last block of its code:
/// ```text
/// error: <what>
///   --> <path>, feature 2, vertices 7 to 8
///    = <figures>
///   --> <path>, feature 3, vertices 1 to 2
///    = <figures>
///    = help: <cure>
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Defects {
    /// The listed defects, at most twenty of each code.
    pub list: Vec<Defect>,
    /// How many more there are of each code that overflowed.
    pub more: Vec<(&'static str, usize)>,
    /// How many of each code were listed, in the order of first occurrence.
    counts: Vec<(&'static str, usize)>,
}

impl Defects {
    /// Adds a defect; `make` is called only while the list of that code is not full.
    pub fn push(&mut self, code: &'static str, make: impl FnOnce() -> Defect) {
        let listed = match self.counts.iter_mut().find(|(c, _)| *c == code) {
            Some((_, n)) => n,
            None => {
                self.counts.push((code, 0));
                // Just pushed, so there is a last one; the fallback is never reached.
                match self.counts.last_mut() {
                    Some((_, n)) => n,
                    None => return,
                }
            }
        };
        if *listed < LISTED {
            *listed += 1;
            self.list.push(make());
        } else {
            match self.more.iter_mut().find(|(c, _)| *c == code) {
                Some((_, n)) => *n += 1,
                None => self.more.push((code, 1)),
            }
        }
    }

    /// Adds all of `other`.
    pub fn extend(&mut self, other: Self) {
        for defect in other.list {
            self.push(defect.code, || defect);
        }
        for (code, n) in other.more {
            match self.more.iter_mut().find(|(c, _)| *c == code) {
                Some((_, m)) => *m += n,
                None => self.more.push((code, n)),
            }
        }
    }

    /// Whether nothing is wrong.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// Number of defects, listed or not.
    pub fn count(&self) -> usize {
        self.list.len() + self.more.iter().map(|(_, n)| n).sum::<usize>()
    }

    /// Whether there is a defect of this code.
    pub fn has(&self, code: &str) -> bool {
        self.list.iter().any(|defect| defect.code == code)
    }

    /// `Ok` if nothing is wrong.
    ///
    /// # Errors
    /// The defects themselves, if there are any.
    pub fn into_result(self) -> Result<(), Self> {
        if self.is_empty() { Ok(()) } else { Err(self) }
    }
}

impl fmt::Display for Defects {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut first = true;
        for (code, _) in &self.counts {
            let mut help = "";
            let mut said = "";
            for defect in self.list.iter().filter(|d| d.code == *code) {
                if said != defect.what {
                    let separator = if std::mem::take(&mut first) { "" } else { "\nerror: " };
                    write!(f, "{separator}{}", defect.what)?;
                    said = &defect.what;
                }
                write!(f, "\n  --> {}", defect.at)?;
                if let Some(figures) = &defect.figures {
                    write!(f, "\n   = {figures}")?;
                }
                help = &defect.help;
            }
            if let Some((_, n)) = self.more.iter().find(|(c, _)| c == code) {
                write!(f, "\n   = and {n} more of this kind")?;
            }
            if !help.is_empty() {
                write!(f, "\n   = help: {help}")?;
            }
        }
        Ok(())
    }
}

impl std::error::Error for Defects {}

#[cfg(test)]
mod tests {
    use super::*;

    fn defect(code: &'static str, n: usize) -> Defect {
        Defect { code, what: format!("bad {n}"), at: format!("a.csv, row {n}"), figures: None, help: "mend it".into() }
    }

    #[test]
    fn lists_twenty_and_counts_the_rest() {
        let mut defects = Defects::default();
        for n in 0..1254 {
            defects.push("a", || defect("a", n));
        }
        defects.push("b", || Defect { figures: Some("1 against 2".into()), help: "other".into(), ..defect("b", 7) });
        assert_eq!(defects.count(), 1255);
        assert_eq!(defects.list.len(), 21);
        let text = defects.to_string();
        assert!(text.starts_with("bad 0\n  --> a.csv, row 0\nerror: bad 1\n"));
        assert!(text.ends_with(
            "error: bad 19\n  --> a.csv, row 19\n   = and 1234 more of this kind\n   = help: mend it\n\
             error: bad 7\n  --> a.csv, row 7\n   = 1 against 2\n   = help: other"
        ));
    }
}

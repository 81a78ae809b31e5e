use super::*;
use crate::report::render_selftest;

#[test]
fn all_cases_pass() {
    let cases = cases::all();
    let report = run(&cases, |_, _| ());
    assert!(report.passed, "{}", render_selftest(&report));
    assert!(report.figures >= 100 && report.failed == 0, "{}", report.figures);
    let mut groups: Vec<&str> = report.cases.iter().map(|case| case.group).collect();
    groups.dedup();
    assert_eq!(groups.len(), 7, "groups stand together");
    // Names tell cases apart.
    let mut names: Vec<&str> = report.cases.iter().map(|case| case.case).collect();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), cases.len());
}

/// A figure that is off, by as little as twice its bound, fails its row and no other.
#[test]
fn a_wrong_figure_fails() {
    let count = cases::all().len();
    for broken in 0..count {
        let mut cases: Vec<Case> = cases::all().into_iter().skip(broken).take(1).collect();
        let row = cases[0].rows.len() - 1;
        match &mut cases[0].rows[row].expected {
            Expected::Number { value, bound: Bound::Fixed(bound), .. } => *value += 2.0 * *bound + 1e-6,
            Expected::Number { value, .. } => *value += 100.0,
            Expected::Refusal { words, .. } => *words = "words of no message",
        }
        let report = run(&cases, |_, _| ());
        let name = report.cases[0].case;
        assert!(!report.passed && report.failed == 1 && !report.cases[0].rows[row].passed, "{name}");
        let expected = format!("{}, {name}: {} is ", report.cases[0].group, report.cases[0].rows[row].figure);
        assert!(report.failures()[0].starts_with(&expected), "{:?}", report.failures());
    }
}

/// A refusal without words would pass for any error.
#[test]
fn refusals_have_words() {
    for row in cases::all().iter().flat_map(|case| &case.rows) {
        if let Expected::Refusal { words, .. } = row.expected {
            assert!(words.len() >= 5, "{}", row.formula);
        }
    }
}

/// A job that is refused, and should not be; one that should be, and is not.
#[test]
fn refusals_that_are_wrong_fail() {
    let mut cases: Vec<Case> =
        cases::all().into_iter().filter(|case| ["wedge on one side of a level line"].contains(&case.name)).collect();
    cases[0].files[0].1 = "no line at all".to_owned();
    let report = run(&cases, |_, _| ());
    assert!(!report.passed && report.failed == 3 && report.cases[0].error.is_some(), "{}", render_selftest(&report));

    let mut cases = cases::all();
    let sound = cases.iter().position(|case| case.name == "cone").unwrap();
    let refused = cases.iter().position(|case| case.name == "ring that crosses itself").unwrap();
    let files = std::mem::take(&mut cases[sound].files);
    cases[refused].files = files;
    let report = run(&cases[refused..=refused], |_, _| ());
    assert_eq!((report.passed, report.failed, report.cases[0].rows[0].message.clone()), (false, 1, None));
}

/// A case says whether it is the same on all systems: without cones there is no bound but rounding.
#[test]
fn exact_cases_have_no_cone() {
    for case in cases::all().iter().filter(|case| case.exact) {
        for outcome in work(case) {
            let bound = outcome.number("volumes.error_bound");
            assert!(bound.is_none_or(|bound| bound == 0.0), "{}: {bound:?}", case.name);
        }
    }
}

/// The file of hashes is that of this version: `cargo run --example selftest_hashes` writes it.
#[test]
fn hashes_are_known() {
    assert_eq!(HASHES.lines().map(|line| line.split(' ').next().unwrap()).collect::<Vec<_>>(), ["exact", "all"]);
    let report = run(&cases::all(), |_, _| ());
    let here = report.platform == REFERENCE && cfg!(target_env = "gnu");
    for hash in report.hashes.iter().filter(|hash| hash.required || here) {
        let help = "after a change that is meant, run `cargo run --example selftest_hashes`";
        assert_eq!(hash.same, Some(true), "{} {}: {help}", hash.of, hash.sha256);
    }
}

//! What is typed as options.

use super::choices::Choices;
use slopegen::formation::Crossfall;
use slopegen::model::{LengthUnit, Share, Slope};
use slopegen::read::ColumnOrder;

pub(crate) fn run(bytes: &[u8]) {
    let mut choices = Choices::new(bytes);
    let kind = choices.below(6);
    let Ok(text) = std::str::from_utf8(choices.rest()) else { return };
    match kind {
        0 => slope(text),
        1 => shown(choices.rest()),
        2 => crossfall(text),
        3 => share(text),
        4 => order(text),
        _ => unit(text),
    }
}

/// The meaning of a notation, by the words of the manual and with code of its own.
fn meaning(text: &str) -> Option<f64> {
    let text: String = text.chars().filter(|c| !c.is_whitespace()).flat_map(char::to_lowercase).collect();
    let number = |text: &str| {
        let point = text.replace(',', ".");
        let fits = point.matches('.').count() < 2 && point.chars().all(|c| matches!(c, '0'..='9' | '.' | '+' | '-' | 'e'));
        point.parse::<f64>().ok().filter(|v| fits && *v > 0.0 && v.is_finite())
    };
    let pair = |text: &str, between: &str| text.split_once(between).and_then(|(a, b)| number(a).zip(number(b)));
    if let Some(percent) = text.strip_suffix('%') {
        return number(percent).map(|p| p / 100.0);
    }
    if let Some(degrees) = text.strip_suffix("deg").or_else(|| text.strip_suffix('°')) {
        return number(degrees).filter(|d| *d < 90.0).map(|d| d.to_radians().tan());
    }
    if let Some((rise, run)) = pair(&text, "in") {
        return Some(rise / run);
    }
    let (first, second) = text.split_once(':')?;
    match (first.strip_suffix('v'), first.strip_suffix('h'), second.strip_suffix('v'), second.strip_suffix('h')) {
        (Some(rise), None, None, Some(run)) | (None, Some(run), Some(rise), None) => Some(number(rise)? / number(run)?),
        (None, None, None, None) => match (number(first)?, number(second)?) {
            // One of the two is 1, and the other the run: 1:n and n:1 mean the same for n of 1 and more.
            (1.0, n) | (n, 1.0) if n >= 1.0 => Some(1.0 / n),
            _ => None,
        },
        _ => None,
    }
}

fn slope(text: &str) {
    match text.parse::<Slope>() {
        Ok(slope) => {
            let ratio = slope.ratio();
            assert!(Slope::ACCEPTED.contains(&ratio));
            assert_eq!(meaning(text), Some(ratio), "{text:?} was taken for {ratio}");
        }
        Err(error) => {
            let message = error.to_string();
            assert!(message.contains("\n   = help: "), "{message}");
            assert!(meaning(text).is_none_or(|ratio| !Slope::ACCEPTED.contains(&ratio)), "{text:?}: {message}");
            // What is suggested can be typed.
            if message.contains("is ambiguous") || message.contains("which kind") {
                let help = message.rsplit("help: write ").next().unwrap_or_default();
                let known = help.split('`').skip(1).step_by(2).filter(|s| s.parse::<Slope>().is_ok()).count();
                assert!(
                    known > 0
                        || !help.split('`').skip(1).step_by(2).any(|s| meaning(s).is_some_and(|m| Slope::ACCEPTED.contains(&m))),
                    "{message}"
                );
            }
        }
    }
}

/// All forms of a slope read as the slope, as far as they have digits; a steeper slope is never shown flatter.
fn shown(bytes: &[u8]) {
    let mut choices = Choices::new(bytes);
    let ratio = |choices: &mut Choices<'_>| 10_f64.powf(choices.between(-4.0, 4.0) + choices.part() / 65536.0).clamp(1e-4, 1e4);
    let (a, b) = (ratio(&mut choices), ratio(&mut choices));
    let [a, b] = [a.min(b), a.max(b)].map(|r| Slope::from_ratio(r).expect("positive"));
    for slope in [a, b] {
        for (form, digits) in slope.forms().split(" · ").zip([4, 4, 3, 4]) {
            let Some(back) = meaning(form) else {
                // 90.00° and the like.
                assert!(form.ends_with('°') && slope.degrees() > 89.9, "{form}");
                continue;
            };
            // Degrees near the vertical are coarser: d tan = (1 + tan²) dα.
            let r = slope.ratio();
            let coarse = if form.ends_with('°') { (r + 1.0 / r) * slope.degrees().to_radians() } else { 1.0 };
            let relative = 0.5 * 10_f64.powi(1 - digits) * coarse.max(1.0);
            assert!(relative > 0.1 || (back / r - 1.0).abs() < 1.2 * relative, "{form} for {r}");
        }
        let back = meaning(&slope.not_flatter()).expect("it can be typed");
        assert!(back >= slope.ratio() * (1.0 - 1e-14), "{} for {}", slope.not_flatter(), slope.ratio());
    }
    let steep = |slope: Slope| meaning(&slope.short()).expect("it can be typed");
    assert!(steep(a) <= steep(b), "{} and {}", a.short(), b.short());
}

fn crossfall(text: &str) {
    match text.parse::<Crossfall>() {
        Ok(fall) => {
            assert!(fall.left.abs() < 1.0 && fall.right.abs() < 1.0, "{text:?}: {fall:?}");
            let back = format!("{:e}V:1H;{:e}V:1H", fall.left.abs(), fall.right.abs());
            if fall.left != 0.0 && fall.right != 0.0 {
                let back: Crossfall = back.parse().unwrap_or_else(|e| panic!("{back}: {e}"));
                assert_eq!((back.left, back.right), (fall.left.abs(), fall.right.abs()));
            }
        }
        Err(error) => assert!(error.to_string().contains("\n   = help: "), "{error}"),
    }
}

fn share(text: &str) {
    match text.parse::<Share>() {
        Ok(Share(share)) => {
            assert!(share.is_finite(), "{text:?}");
            if let Some(percent) = text.trim().strip_suffix('%') {
                let number = percent.trim().replace(',', ".").parse::<f64>().expect("digits were read");
                assert!((number / 100.0 - share).abs() <= 1e-15 * share.abs(), "{text:?}: {share}");
            }
        }
        Err(error) => assert!(!error.what.is_empty() && !error.help.is_empty()),
    }
}

fn order(text: &str) {
    if let Ok(order) = text.parse::<ColumnOrder>() {
        assert_eq!(order.to_string().parse(), Ok(order));
    }
}

fn unit(text: &str) {
    if let Ok(unit) = text.parse::<LengthUnit>() {
        assert_eq!(unit.label(), text);
    }
}

//! Lists of numbers in the content of elements.

use super::xml::Xml;
use crate::read::error::clip;
use crate::read::{ReadError, decimal};

/// The numbers of a text, separated by blanks.
///
/// # Errors
/// For anything that is no finite number; `at` is where the element stands.
pub(super) fn list(xml: &Xml<'_>, name: &str, text: &str, at: usize) -> Result<Vec<f64>, ReadError> {
    let mut numbers = Vec::new();
    for field in fields(text) {
        numbers.push(number(xml, name, field, at)?);
    }
    Ok(numbers)
}

/// The first three numbers of a text and how many there are; those that are missing are nought.
///
/// # Errors
/// As [`list`].
#[inline]
pub(super) fn few(xml: &Xml<'_>, name: &str, text: &str, at: usize) -> Result<([f64; 3], usize), ReadError> {
    let mut numbers = [0.0; 3];
    let mut count = 0;
    for field in fields(text) {
        let value = number(xml, name, field, at)?;
        if let Some(slot) = numbers.get_mut(count) {
            *slot = value;
        }
        count += 1;
    }
    Ok((numbers, count))
}

/// Northing, easting and elevation lists are long: split by hand.
#[inline]
pub(super) fn fields(text: &str) -> impl Iterator<Item = &[u8]> {
    text.as_bytes().split(|&b| b <= b' ').filter(|field| !field.is_empty())
}

#[inline]
fn number(xml: &Xml<'_>, name: &str, field: &[u8], at: usize) -> Result<f64, ReadError> {
    match decimal::number(field) {
        Some(value) if value.is_finite() => Ok(value),
        _ => {
            let what = format!("there is something else than finite numbers in <{name}>");
            let help = if field.contains(&b',') {
                "write decimals behind a point, and blanks between the numbers"
            } else {
                "correct the value, or take the element out"
            };
            Err(xml.refuse(&what, at, format!("`{}`", clip(field)), help))
        }
    }
}

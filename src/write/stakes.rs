//! Slope stakes as CSV.

use super::EncodeError;
use super::fields::{push_field, push_figure};
use super::obj::flush_if_full;
use crate::model::Part;
use crate::setout::Stake;
use std::io::Write;

/// The columns; what they mean stands in `docs/cli.md`.
pub const STAKE_COLUMNS: &str = "chain,station,side,along,offset,hinge_x,hinge_y,hinge_z,part,catch_x,catch_y,catch_z,\
                                 catch_offset,catch_ahead,distance,height,slope_distance,one_in,bearing,ends";

/// Writes slope stakes as CSV (RFC 4180, but with plain line feeds): a header, then a row each, in world coordinates with the
/// shortest digits that read back to the same bits. What does not apply is empty.
///
/// # Errors
/// [`EncodeError::Io`] from the sink, [`EncodeError::NotFinite`] for a figure that is no number.
pub fn write_stakes(out: &mut (impl Write + ?Sized), stakes: &[Stake]) -> Result<(), EncodeError> {
    let mut bytes = STAKE_COLUMNS.as_bytes().to_vec();
    bytes.push(b'\n');
    for (i, stake) in stakes.iter().enumerate() {
        let number = |bytes: &mut Vec<u8>, value: Option<f64>| {
            bytes.push(b',');
            match value {
                Some(value) if !value.is_finite() => Err(EncodeError::NotFinite { what: "slope stake", index: i + 1, value }),
                Some(value) => {
                    push_figure(bytes, value);
                    Ok(())
                }
                None => Ok(()),
            }
        };
        let word = |bytes: &mut Vec<u8>, word: &str| {
            bytes.push(b',');
            bytes.extend_from_slice(word.as_bytes());
        };
        push_field(&mut bytes, &stake.chain);
        number(&mut bytes, Some(stake.station))?;
        word(&mut bytes, stake.hand.word());
        word(&mut bytes, stake.along.word());
        number(&mut bytes, Some(stake.offset))?;
        for value in stake.hinge.to_array() {
            number(&mut bytes, Some(value))?;
        }
        let part = match stake.part {
            Some(Part::CutSlope) => "cut",
            Some(_) => "fill",
            None => "",
        };
        word(&mut bytes, part);
        for value in stake.catch.to_array() {
            number(&mut bytes, Some(value))?;
        }
        let figures = [stake.catch_offset, stake.catch_ahead, stake.distance(), stake.height(), stake.slope_distance()];
        for value in figures.map(Some).into_iter().chain([stake.one_in(), stake.bearing()]) {
            number(&mut bytes, value)?;
        }
        word(&mut bytes, stake.ends.word());
        bytes.push(b'\n');
        flush_if_full(out, &mut bytes)?;
    }
    out.write_all(&bytes)?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::setout::{Along, Ends, Hand};
    use glam::DVec3;

    #[test]
    fn rows_are_as_documented() {
        let stake = Stake {
            chain: "a \"b\", c".into(),
            station: 20.0,
            hand: Hand::Left,
            along: Along::Ruling,
            offset: 3.5,
            hinge: DVec3::new(100.0, 200.0, 10.0),
            part: Some(Part::FillSlope),
            catch: DVec3::new(103.0, 200.0, 6.0),
            catch_offset: 6.5,
            catch_ahead: 0.0,
            ends: Ends::Ground,
        };
        let none =
            Stake { chain: "d".into(), part: None, catch: stake.hinge, hand: Hand::Right, catch_offset: 3.5, ..stake.clone() };
        let mut bytes = Vec::new();
        write_stakes(&mut bytes, &[stake.clone(), none]).unwrap();
        let expected = format!(
            "{STAKE_COLUMNS}\n\"a \"\"b\"\", c\",20,left,ruling,3.5,100,200,10,fill,103,200,6,6.5,0,3,-4,5,0.75,90,ground\n\
             d,20,right,ruling,3.5,100,200,10,,100,200,10,3.5,0,0,0,0,,,ground\n"
        );
        assert_eq!(String::from_utf8(bytes).unwrap(), expected);
        assert_eq!(STAKE_COLUMNS.split(',').count(), 20);
        let bad = Stake { station: f64::NAN, ..stake };
        assert!(matches!(write_stakes(&mut Vec::new(), &[bad]), Err(EncodeError::NotFinite { index: 1, .. })));
    }
}

//! Numbers one after the other, from text or from bytes.

use super::super::single::single;
use super::header::{Encoding, Scalar};
use crate::read::decimal;

/// Why there is no number.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Miss {
    /// The data end.
    End,
    /// Not a number: the text.
    Text(Vec<u8>),
    /// Not a whole number of the needed size: the number.
    Whole(f64),
}

/// A place in the data.
pub(super) struct Scan<'a> {
    pub(super) rest: &'a [u8],
    encoding: Encoding,
}

impl<'a> Scan<'a> {
    pub(super) fn new(rest: &'a [u8], encoding: Encoding) -> Self {
        Self { rest, encoding }
    }

    pub(super) fn number(&mut self, scalar: Scalar) -> Result<f64, Miss> {
        if self.encoding == Encoding::Ascii {
            let token = self.token()?;
            return decimal::number(token).ok_or_else(|| Miss::Text(token.to_vec()));
        }
        let (bytes, rest) = self.rest.split_at_checked(scalar.size()).ok_or(Miss::End)?;
        self.rest = rest;
        Ok(value(bytes, scalar, self.encoding == Encoding::Little))
    }

    /// A whole number from 0.
    pub(super) fn whole(&mut self, scalar: Scalar) -> Result<u32, Miss> {
        let value = self.number(scalar)?;
        let whole = value as u32;
        if f64::from(whole) == value { Ok(whole) } else { Err(Miss::Whole(value)) }
    }

    /// Passes over `count` numbers.
    pub(super) fn skip(&mut self, count: usize, scalar: Scalar) -> Result<(), Miss> {
        if self.encoding == Encoding::Ascii {
            return (0..count).try_for_each(|_| self.token().map(drop));
        }
        let size = count.checked_mul(scalar.size()).ok_or(Miss::End)?;
        self.rest = self.rest.get(size..).ok_or(Miss::End)?;
        Ok(())
    }

    fn token(&mut self) -> Result<&'a [u8], Miss> {
        let begin = self.rest.iter().position(|b| !b.is_ascii_whitespace()).ok_or(Miss::End)?;
        let text = &self.rest[begin..];
        let end = text.iter().position(u8::is_ascii_whitespace).unwrap_or(text.len());
        self.rest = &text[end..];
        Ok(&text[..end])
    }
}

/// A binary number of any type as a double, exact for all. `bytes` are as many as its type has.
#[inline]
pub(super) fn value(bytes: &[u8], scalar: Scalar, little: bool) -> f64 {
    let mut raw = [0_u8; 8];
    if little {
        raw[..bytes.len()].copy_from_slice(bytes);
    } else {
        for (to, from) in raw.iter_mut().zip(bytes.iter().rev()) {
            *to = *from;
        }
    }
    let bits = u64::from_le_bytes(raw);
    match scalar {
        Scalar::I8 => f64::from(bits as u8 as i8),
        Scalar::U8 => f64::from(bits as u8),
        Scalar::I16 => f64::from(bits as u16 as i16),
        Scalar::U16 => f64::from(bits as u16),
        Scalar::I32 => f64::from(bits as u32 as i32),
        Scalar::U32 => f64::from(bits as u32),
        Scalar::Single => single(bits as u32),
        Scalar::Double => f64::from_bits(bits),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_type_in_both_byte_orders() {
        for (scalar, bytes, expected) in [
            (Scalar::I8, &[0xFE][..], -2.0),
            (Scalar::U8, &[0xFE], 254.0),
            (Scalar::I16, &[0xFF, 0xFE], -2.0),
            (Scalar::U16, &[0x01, 0x02], 258.0),
            (Scalar::I32, &[0xFF, 0xFF, 0xFF, 0xFE], -2.0),
            (Scalar::U32, &[0xFF, 0xFF, 0xFF, 0xFE], 4_294_967_294.0),
            (Scalar::Single, &[0xC0, 0x20, 0, 0], -2.5),
            (Scalar::Double, &[0xC0, 0x04, 0, 0, 0, 0, 0, 0], -2.5),
        ] {
            let reversed: Vec<u8> = bytes.iter().rev().copied().collect();
            assert_eq!((value(bytes, scalar, false), value(&reversed, scalar, true)), (expected, expected));
        }
    }

    #[test]
    fn whole_numbers_only() {
        let mut scan = Scan::new(b"3 3.0 -1 2.5 x", Encoding::Ascii);
        let whole: Vec<_> = (0..6).map(|_| scan.whole(Scalar::U8)).collect();
        assert_eq!(whole[..4], [Ok(3), Ok(3), Err(Miss::Whole(-1.0)), Err(Miss::Whole(2.5))]);
        assert_eq!(whole[4..], [Err(Miss::Text(b"x".to_vec())), Err(Miss::End)]);
    }
}

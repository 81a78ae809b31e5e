//! What several tests share: lines made from a seed, and a brute force that shares no code with the library.

#![allow(dead_code, reason = "each test binary uses its part")]

pub(crate) mod lines;
pub(crate) mod oracle;

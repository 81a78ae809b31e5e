//! What several tests share: lines made from a seed, a brute force that shares no code with the library, and measures of
//! finished surfaces.

#![allow(dead_code, reason = "each test binary uses its part")]

pub(crate) mod build;
pub(crate) mod lines;
pub(crate) mod measure;
pub(crate) mod oracle;
#[path = "../../src/kernel/testing.rs"]
pub(crate) mod random;
pub(crate) mod schema;

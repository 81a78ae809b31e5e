//! The report as one page that needs nothing else: no network, no file beside it.
//!
//! All text passes the escaping of `maud`; a policy in the head lets no script run but the viewer's and nothing be fetched.
//! Without scripts all figures and drawings are there, only the 3D view is not. There is no clock in it: the same report gives
//! the same bytes.

mod between;
mod build;
mod bytes;
mod check;
mod drawings;
mod parts;
mod proof;
mod shell;
mod soup;
#[cfg(test)]
mod tests;
mod view;
mod volumes;

pub use between::write_between_html;
pub use build::write_html;
pub use check::write_check_html;

//! What happens on Ctrl-C.

use super::exit_code::Code;
use crate::write::discard_unfinished;

/// On an interrupt, or when asked to end: removes files not yet finished and ends the process.
pub(super) fn install() -> Result<(), ctrlc::Error> {
    ctrlc::set_handler(|| {
        discard_unfinished();
        std::process::exit(Code::Interrupted as i32);
    })
}

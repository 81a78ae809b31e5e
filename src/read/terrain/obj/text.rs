//! Lines of an OBJ file: where they end, which belong together, where they stand.

use memchr::{memchr, memchr_iter, memrchr};
use std::borrow::Cow;

/// A text with line feeds where it had single carriage returns, and with lines joined that end in a backslash.
pub(super) fn with_line_ends(bytes: &[u8]) -> Cow<'_, [u8]> {
    let lone = memchr(b'\r', bytes).is_some_and(|at| bytes.get(at + 1) != Some(&b'\n'));
    let joined = memchr_iter(b'\\', bytes).any(|at| matches!(bytes.get(at + 1), Some(b'\n' | b'\r')));
    if !lone && !joined {
        return Cow::Borrowed(bytes);
    }
    let mut text = bytes.to_vec();
    for at in 0..text.len() {
        if text[at] == b'\r' {
            text[at] = if text.get(at + 1) == Some(&b'\n') { b' ' } else { b'\n' };
        }
    }
    // A joined line stands where its first part stood; the line ends taken away are put behind it, to keep the numbers.
    let mut out = Vec::with_capacity(text.len());
    let mut owed = 0;
    for line in text.split_inclusive(|&b| b == b'\n') {
        let bare = line.trim_ascii_end();
        if let Some(part) = bare.strip_suffix(b"\\") {
            out.extend_from_slice(part);
            out.push(b' ');
            owed += 1;
        } else {
            out.extend_from_slice(line);
            out.extend(std::iter::repeat_n(b'\n', std::mem::take(&mut owed)));
        }
    }
    Cow::Owned(out)
}

/// What stands before a comment.
pub(super) fn without_comment(line: &[u8]) -> &[u8] {
    memchr(b'#', line).map_or(line, |at| &line[..at])
}

/// Number of the line that begins at or before `at`, counted from 1, and its text.
pub(super) fn line_at(bytes: &[u8], at: usize) -> (usize, &[u8]) {
    let begin = memrchr(b'\n', &bytes[..at]).map_or(0, |n| n + 1);
    let end = memchr(b'\n', &bytes[at..]).map_or(bytes.len(), |n| at + n);
    (memchr_iter(b'\n', &bytes[..begin]).count() + 1, &bytes[begin..end])
}

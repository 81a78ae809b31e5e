//! The memory of the program: that of the system, except that running out of it ends in a message and an exit code.
//!
//! The only place with unsafe code. Without it, Rust ends a process that gets no memory with an abort: a core dump, no exit code
//! of ours, and temporary files left behind. See "Memory" in `docs/architecture.md`.
#![allow(unsafe_code, reason = "a global allocator cannot be had without")]

use std::alloc::{GlobalAlloc, Layout, System};

/// The system's allocator, which never returns null to the program.
pub(crate) struct Heap;

// SAFETY: everything goes on to `System` with the arguments as they came, and its pointers come back as they are. For null this
// does not return: `out_of_memory` ends the process, and does not unwind.
unsafe impl GlobalAlloc for Heap {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        held(unsafe { System.alloc(layout) }, layout.size())
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        held(unsafe { System.alloc_zeroed(layout) }, layout.size())
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        held(unsafe { System.realloc(pointer, layout, size) }, size)
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[inline]
fn held(pointer: *mut u8, bytes: usize) -> *mut u8 {
    if pointer.is_null() { slopegen::cli::out_of_memory(bytes) } else { pointer }
}

//! Memory that is asked for, whether or not it is ever touched: a count read from a file is not believed.

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicUsize, Ordering};

/// The most that may be asked for at once, for files of the lengths that fuzzers make.
const FILES: usize = 64 << 20;

/// The same where surfaces are built: a few vertices far up on flat slopes have large meshes.
const SURFACES: usize = 512 << 20;

static MOST: AtomicUsize = AtomicUsize::new(FILES);

/// Allows what meshes take.
pub(crate) fn allow_surfaces() {
    MOST.store(SURFACES, Ordering::Relaxed);
}

struct Bounded;

#[global_allocator]
static ALLOCATOR: Bounded = Bounded;

// SAFETY: everything is passed on to the allocator of the system.
unsafe impl GlobalAlloc for Bounded {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        bound(layout.size());
        unsafe { System.alloc(layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        bound(layout.size());
        unsafe { System.alloc_zeroed(layout) }
    }

    unsafe fn realloc(&self, memory: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        bound(size);
        unsafe { System.realloc(memory, layout, size) }
    }

    unsafe fn dealloc(&self, memory: *mut u8, layout: Layout) {
        unsafe { System.dealloc(memory, layout) }
    }
}

fn bound(size: usize) {
    if size > MOST.load(Ordering::Relaxed) {
        eprintln!("{size} bytes of memory were asked for at once");
        std::process::abort();
    }
}

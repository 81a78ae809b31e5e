//! Setting out: what a crew needs to build the design.

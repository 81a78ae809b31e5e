//! Line and existing ground, from outside: command line, report and written files against closed forms, against a brute force
//! that shares no code with the program, and against each other.

#[path = "../common/mod.rs"]
mod common;

mod again;
mod clip;
mod closed;
mod connected;
mod data;
mod degenerate;
mod edges;
mod figures;
mod finished;
mod fixtures;
mod hostile;
mod invariance;
mod lattice;
mod oracle;
mod planar;
mod random;
mod run;
mod site;
mod tin;
mod wedges;

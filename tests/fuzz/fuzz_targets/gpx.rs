#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| slopegen_fuzz::run("gpx", bytes));

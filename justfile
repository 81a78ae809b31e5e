# Commands of the project. `just` lists them; each is one line of cargo that can be typed without it.

# List the recipes
default:
    @just --list --unsorted

# Everything continuous integration does
ci:
    .ci/run

# Format the code
fmt:
    cargo fmt

# Warnings are errors
lint:
    cargo fmt --check
    cargo clippy --all-targets -- -D warnings

# All tests, with optimised code and every check on
test:
    cargo test

# The documentation of the library, as a browser shows it
doc:
    RUSTDOCFLAGS="-D warnings" cargo doc --no-deps

# Figures of speed; see docs/performance.md
bench:
    cargo bench --bench engine
    cargo bench --bench overlay
    cargo bench --bench reading
    cargo bench --bench ground

# The pictures of the README, from fixtures
picture:
    mkdir -p out
    cargo run --release -- build fixtures/road.geojson --slope 1:1.5 -o out/road.obj --lines out/road_lines.geojson
    cargo run --release -- build fixtures/pad.geojson --slope 1:2 --to-elevation 405 -o out/pad.obj --lines out/pad_lines.geojson
    cargo run --release --example picture -- out/road.obj docs/road.png --lines out/road_lines.geojson
    cargo run --release --example picture -- out/pad.obj docs/pad.png --lines out/pad_lines.geojson --width 800

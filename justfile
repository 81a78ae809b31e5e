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

# Fuzz a target until it finds something, or as long as `-max_total_time=60` says; see docs/testing.md
fuzz target *options:
    mkdir -p tests/fuzz/corpus/{{target}}
    cd tests/fuzz && cargo run --release --bin {{target}} -- corpus/{{target}} ../../fixtures/fuzz/{{target}} {{options}}

# The documentation of the library, as a browser shows it
doc:
    RUSTDOCFLAGS="-D warnings" cargo doc --no-deps

# The schemas of the JSON reports under docs/, from the program; tests compare them
schema:
    cargo run --example schema

# The hashes of results that `slopegen selftest` expects of this version, on x86_64 Linux with glibc
hashes:
    cargo run --example selftest_hashes

# Figures of speed; see docs/performance.md
bench:
    cargo bench --bench engine
    cargo bench --bench overlay
    cargo bench --bench reading
    cargo bench --bench writing
    cargo bench --bench ground

# slopegen beside other tools, which are installed into target/peers; see tests/peers/README.md. `just peers --quick`
peers *OPTIONS:
    tests/peers/run {{OPTIONS}}

# The picture of how times grow, see docs/performance.md; some minutes
growth:
    mkdir -p out
    cargo bench --bench growth > out/growth.txt
    cargo run --example growth -- docs/growth.svg < out/growth.txt

# The pictures of the README, from fixtures
picture:
    mkdir -p out
    cargo run --release -- build fixtures/hill_road.geojson --width 7 --terrain fixtures/ground.obj --cut-slope 1:1 --fill-slope 1:1.5 -o out/road.obj --finished out/road_ground.obj --lines out/road_lines.geojson
    cargo run --release -- build fixtures/hill_pad.geojson --slope 1:1.5 --terrain fixtures/ground.obj -o out/pad.obj --finished out/pad_ground.obj --lines out/pad_lines.geojson
    cargo run --release --example picture -- out/road_ground.obj docs/hill_road.png --lines out/road_lines.geojson --crop 14 --contours 1 --azimuth 350 --tilt 54
    cargo run --release --example picture -- out/pad_ground.obj docs/hill_pad.png --lines out/pad_lines.geojson --crop 6 --contours 1 --azimuth 352 --tilt 46 --width 800
    cargo run --release -- build fixtures/hill_road.geojson --width 7 --terrain fixtures/ground.obj --cut-slope 1:1 --fill-slope 1:1.5 --stations 20 --plot docs/hill_road_plan.svg -o out/road.obj

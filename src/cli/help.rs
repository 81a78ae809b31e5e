//! Longer texts of the help.

pub(super) const INPUT: &str = "Input";
pub(super) const SURFACE: &str = "Surface";
pub(super) const PLACES: &str = "Places";
pub(super) const CHECKS: &str = "Checks";
pub(super) const OUTPUT: &str = "Output";
pub(super) const RUNNING: &str = "Running";

pub(super) const AFTER: &str = "\
Exit codes:
  0  done
  1  the work could not be done: bad geometry, nothing to build
  2  wrong usage
  3  an input could not be read
  4  an output could not be written
  5  the result did not pass its checks

All lengths are in the unit of the input, which must be projected. `slopegen build --help` has examples.";

pub(super) const AFTER_BUILD: &str = "\
Examples:
  slopegen build road.geojson --width 7 --terrain ground.obj --cut-slope 1:1 --fill-slope 1:1.5 --finished finished.obj
      cuttings and embankments of a road on existing ground: the works, volumes, and the whole ground with the works in it
  slopegen build pad.geojson --slope 1:2 --terrain ground.ply --stations 20 --swell 25% --shrink 10% --report pad.html
      the same for a building pad, with figures along its edge and the change in volume of the soil, on a page with drawings
  slopegen build pad.geojson --slope 1:2 --terrain ground.obj -o pad.xml -o pad.dxf --finished after.glb
      the design for a rover (LandXML, DXF), the ground after the works for a viewer
  slopegen build road.geojson --slope 1:1.5
      embankment on both sides of a road, 10 below its lowest vertex: road.obj, report on standard output
  slopegen build road.geojson --slope 1:1.5 --width 8 --crossfall 2.5%
      the same for a road 8 wide: platform with a crown, slopes from its edges
  slopegen build pad.geojson --slope 1:2 --to-elevation 405 -o pad.ply --lines pad_lines.geojson --report pad.json
      building pad above level ground, with line work and report
  slopegen build pit.csv --closed --side inside --slope 45deg --height 6 -o pit.obj
      excavation inside a rim of surveyed points, 6 deep
  slopegen build road.geojson --direction up --cut-slope 1:1 --distance 20 --interval 0.5 -o cut.obj
      cutting along a road, 20 wide on either side
  cat road.geojson | slopegen build - --input-format geojson --slope 1:1.5 -o - > road.obj

1:1.5 is one vertical to 1.5 horizontal. 1:0.5 could be read either way and is refused: write 1V:0.5H or 1H:0.5V.";

pub(super) const AFTER_VOLUME: &str = "\
Examples:
  slopegen volume design.obj ground.obj --report volume.json
  slopegen volume may.xyz april.xyz --within lot.geojson
      between two surveys, inside the boundary of a lot
  slopegen volume stockpile.ply --to-elevation 102.5
      what lies above a level (cut), and what is missing below it (fill)

Cut is where DESIGN lies below EXISTING, fill where it lies above; only where both are. Faces are taken as they are given.";

pub(super) const AFTER_SAMPLE: &str = "\
Examples:
  slopegen sample road.geojson --slope 1:1.5 --at points.csv -o heights.csv
  slopegen sample road.geojson --slope 1:1.5 --raster road.asc --cell 0.5
  slopegen sample pit.csv --closed --slope 1:1 --raster pit.asc --cell 1 --box 500290,5400420,500390,5400500
  echo 500100,5400200 | slopegen sample road.geojson --slope 1:1.5 --at - --at-order xy

Heights are those of the closed form of the given line, on both sides of it and as far as you ask: nothing is simplified.";

pub(super) const AFTER_CHECK: &str = "\
Examples:
  slopegen check ground.obj
      is it a sound surface: oriented, without overlaps, cracks and T-junctions? With places, slopes and angles
  slopegen check road.obj --slope 1:1.5
      and do its slopes keep 1V:1.5H within 0.1 degrees?
  slopegen check design.ply --slope 1:2 --tolerance-deg 0.5 --max-off 2% --part batter --report check.json
      the group `batter` of another program's mesh: 2 % of its area may be off by more than half a degree

The mesh is taken as it is in the file; vertices at exactly the same place are taken as one. Exits with 5 when the surface is
not sound or does not keep the slope, with 0 when there are only remarks.";

//! Local origins: for formats and viewers that hold single-precision numbers.

use super::number::push_f64;
use super::{EncodeError, Head};
use crate::kernel::plan_box::PlanBox;
use crate::model::Tin;
use glam::DVec3;
use std::ffi::OsString;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Origins are whole multiples of this.
pub const ROUND: f64 = 100.0;

/// A local origin for meshes: the south-west corner of their plan box, rounded down to whole hundreds, at elevation 0.
///
/// Along an axis on which the box does not lie further from zero than it is long, the origin is 0. So `origin + (p − origin)`
/// is `p` bit for bit for every vertex `p`: with `|p − origin| ≤ |p|` the difference is a multiple of the unit in the last
/// place of `p` that fits the digits of a double.
pub fn around<'a>(meshes: impl IntoIterator<Item = &'a Tin>) -> DVec3 {
    let places = meshes.into_iter().flat_map(|tin| (0..tin.vertices.len()).map(|i| tin.world(i).truncate()));
    let PlanBox { lo: min, hi: max } = PlanBox::of(places);
    let pick = |lo: f64, hi: f64| {
        let nearest = if lo <= 0.0 && hi >= 0.0 { 0.0 } else { lo.abs().min(hi.abs()) };
        if nearest.is_finite() && nearest > hi - lo + ROUND { (lo / ROUND).floor() * ROUND } else { 0.0 }
    };
    DVec3::new(pick(min.x, max.x), pick(min.y, max.y), 0.0)
}

/// The file beside a mesh that tells its origin: the name of the mesh with `.origin.json` after it.
pub fn sidecar(mesh: &Path) -> PathBuf {
    let mut name: OsString = mesh.into();
    name.push(".origin.json");
    name.into()
}

/// Writes what has to be added to the coordinates of `file` to get world coordinates, with unit and reference system.
///
/// # Errors
/// [`EncodeError::Io`] from the sink.
pub fn write_origin(out: &mut (impl Write + ?Sized), file: &Path, head: &Head<'_>) -> Result<(), EncodeError> {
    let name = file.file_name().unwrap_or_default().to_string_lossy();
    let mut bytes = b"{\"origin\":[".to_vec();
    push_point(&mut bytes, head.origin.unwrap_or_default(), b",");
    bytes.extend_from_slice(b"],\"unit\":");
    serde_json::to_writer(&mut bytes, head.unit.label())?;
    if let Some(crs) = head.crs {
        bytes.extend_from_slice(b",\"crs\":");
        serde_json::to_writer(&mut bytes, crs)?;
    }
    bytes.extend_from_slice(b",\"file\":");
    serde_json::to_writer(&mut bytes, name.as_ref())?;
    bytes.extend_from_slice(b"}\n");
    out.write_all(&bytes)?;
    Ok(())
}

/// Appends three numbers with `between` between them.
pub(super) fn push_point(bytes: &mut Vec<u8>, point: DVec3, between: &[u8]) {
    for (k, value) in point.to_array().into_iter().enumerate() {
        if k > 0 {
            bytes.extend_from_slice(between);
        }
        push_f64(bytes, value);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::frame::Frame;

    fn tin(points: &[(f64, f64)]) -> Tin {
        let vertices = points.iter().map(|p| DVec3::new(p.0, p.1, 12.345)).collect();
        Tin { frame: Frame::WORLD, vertices, triangles: Vec::new(), parts: Vec::new() }
    }

    #[test]
    fn whole_hundreds_below_the_box() {
        let (a, b) = (tin(&[(500_123.4, 5_400_099.9), (500_500.0, 5_400_700.0)]), tin(&[(499_999.0, 5_400_800.0)]));
        assert_eq!(around([&a]), DVec3::new(500_100.0, 5_400_000.0, 0.0));
        assert_eq!(around([&a, &b]), DVec3::new(499_900.0, 5_400_000.0, 0.0));
        assert_eq!(around([&tin(&[(-500_123.4, 12.0), (-500_050.0, 80.0)])]), DVec3::new(-500_200.0, 0.0, 0.0));
        assert_eq!(around([]), DVec3::ZERO);
    }

    /// Boxes of all sizes near and far from zero, on both sides of it.
    #[test]
    fn origin_and_local_coordinates_add_up_to_the_bits() {
        for base in [0.1, 57.3, 333.3, 4_321.1, 85_227.7, 5_400_123.456, 21_530_242.1] {
            for length in [0.1, 99.9, 512.3, 40_000.7] {
                for sign in [1.0, -1.0] {
                    let points: Vec<(f64, f64)> = (0..200)
                        .map(|i| f64::from(i) / 199.0)
                        .map(|t| (sign * (base + length * t), -0.3 * length + length * t * t))
                        .collect();
                    let origin = around([&tin(&points)]);
                    for (x, y) in points {
                        let p = DVec3::new(x, y, 1.0);
                        assert_eq!(origin + (p - origin), p, "{base} {length} {sign}");
                    }
                }
            }
        }
    }

    #[test]
    fn the_sidecar_says_all() {
        let head = Head { crs: Some("EPSG:\"1\"\n"), origin: Some(DVec3::new(5e5, 5.4e6, 0.0)), ..Head::default() };
        let mut bytes = Vec::new();
        write_origin(&mut bytes, Path::new("out/a.stl"), &head).unwrap();
        let expected = "{\"origin\":[500000,5400000,0],\"unit\":\"m\",\"crs\":\"EPSG:\\\"1\\\"\\n\",\"file\":\"a.stl\"}\n";
        assert_eq!(String::from_utf8(bytes).unwrap(), expected);
        assert_eq!(sidecar(Path::new("out/a.stl")), Path::new("out/a.stl.origin.json"));
    }
}

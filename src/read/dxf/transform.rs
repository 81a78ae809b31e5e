//! Places in the world: the systems of entities, inserted blocks.

use glam::{DAffine3, DMat3, DVec2, DVec3};

/// Axes of the system of an entity with this extrusion direction ("arbitrary axis algorithm": Autodesk, DXF Reference, object
/// coordinate systems). The world's where the direction is up, or none.
pub(super) fn axes(extrusion: DVec3) -> DMat3 {
    /// Within this of the world's z the y axis is taken for help, by definition.
    const NEAR: f64 = 1.0 / 64.0;
    let z = extrusion.normalize_or(DVec3::Z);
    if z == DVec3::Z {
        return DMat3::IDENTITY;
    }
    let help = if z.x.abs() < NEAR && z.y.abs() < NEAR { DVec3::Y } else { DVec3::Z };
    let x = help.cross(z).normalize_or(DVec3::X);
    DMat3::from_cols(x, z.cross(x), z)
}

/// Sine and cosine of an angle in degrees; exact for right angles, so that blocks turned by them keep their coordinates.
pub(super) fn sin_cos(degrees: f64) -> (f64, f64) {
    let turned = degrees.rem_euclid(360.0);
    match turned {
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        _ => turned.to_radians().sin_cos(),
    }
}

/// How a block is inserted.
#[derive(Clone, Copy, Debug)]
pub(super) struct Insertion {
    /// In the system of the insert.
    pub(super) at: DVec3,
    pub(super) scale: DVec3,
    /// Degrees, counter-clockwise.
    pub(super) rotation: f64,
    /// Distances of columns and rows, along the turned axes and not scaled.
    pub(super) step: DVec2,
    pub(super) extrusion: DVec3,
}

impl Insertion {
    /// From the block with this base point to where the copy in this column and row stands.
    pub(super) fn place(&self, base: DVec3, column: f64, row: f64) -> DAffine3 {
        let (sin, cos) = sin_cos(self.rotation);
        let turn = DMat3::from_cols(DVec3::new(cos, sin, 0.0), DVec3::new(-sin, cos, 0.0), DVec3::Z);
        let axes = axes(self.extrusion);
        let matrix = axes * turn * DMat3::from_diagonal(self.scale);
        let offset = turn * (self.step * DVec2::new(column, row)).extend(0.0);
        DAffine3 { matrix3: matrix, translation: axes * (self.at + offset) - matrix * base }
    }
}

/// How much longer a plan vector of a system can become in the world: the greater singular value of its first two axes.
pub(super) fn stretch(system: &DAffine3) -> f64 {
    let (u, v) = (system.matrix3.x_axis, system.matrix3.y_axis);
    let (uu, vv, uv) = (u.length_squared(), v.length_squared(), u.dot(v));
    (0.5 * (uu + vv) + (0.5 * (uu - vv)).hypot(uv)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: DVec3, b: DVec3) {
        assert!((a - b).length() < 1e-12 * b.length().max(1.0), "{a} {b}");
    }

    #[test]
    fn axes_of_the_definition() {
        assert_eq!(axes(DVec3::ZERO), DMat3::IDENTITY);
        assert_eq!(axes(DVec3::new(0.0, 0.0, 2.0)), DMat3::IDENTITY);
        // Downwards: x is turned round, y stays.
        close(axes(-DVec3::Z) * DVec3::new(3.0, 4.0, 5.0), DVec3::new(-3.0, 4.0, -5.0));
        // Towards x: y takes the place of x, z that of y.
        close(axes(DVec3::X) * DVec3::new(1.0, 2.0, 3.0), DVec3::new(3.0, 1.0, 2.0));
        for n in [DVec3::new(1.0, 2.0, 3.0), DVec3::new(0.01, -0.01, 1.0), DVec3::new(0.0, 0.1, -1.0)] {
            let a = axes(n);
            close(a.x_axis.cross(a.y_axis), a.z_axis);
            close(a.z_axis, n.normalize());
            assert!((a.determinant() - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn a_plain_insertion_changes_no_bit() {
        let plain = Insertion { at: DVec3::ZERO, scale: DVec3::ONE, rotation: 0.0, step: DVec2::ZERO, extrusion: DVec3::Z };
        let p = DVec3::new(1_757_392.123_456_789, 5_917_442.987_654_321, 138.440_000_1);
        assert_eq!(plain.place(DVec3::ZERO, 0.0, 0.0).transform_point3(p), p);
        let turned = Insertion { rotation: -270.0, ..plain };
        assert_eq!(turned.place(DVec3::ZERO, 0.0, 0.0).transform_point3(p), DVec3::new(-p.y, p.x, p.z));
    }

    #[test]
    fn stretch_is_that_of_the_longest_vector() {
        let insertion = Insertion {
            at: DVec3::new(1.0, 2.0, 3.0),
            scale: DVec3::new(3.0, -0.5, 7.0),
            rotation: 33.0,
            step: DVec2::ZERO,
            extrusion: DVec3::new(0.3, 0.2, 0.9),
        };
        let inner = Insertion { rotation: 10.0, scale: DVec3::new(1.0, 2.0, 1.0), ..insertion };
        for system in
            [insertion.place(DVec3::ZERO, 0.0, 0.0), insertion.place(DVec3::ONE, 1.0, 0.0) * inner.place(DVec3::X, 0.0, 0.0)]
        {
            let longest = (0..3600)
                .map(|i| f64::from(i) * std::f64::consts::TAU / 3600.0)
                .map(|a| system.transform_vector3(DVec3::new(a.cos(), a.sin(), 0.0)).length())
                .fold(0.0, f64::max);
            let bound = stretch(&system);
            assert!(longest <= bound * (1.0 + 1e-12) && longest > bound * (1.0 - 1e-5), "{longest} {bound}");
        }
    }
}

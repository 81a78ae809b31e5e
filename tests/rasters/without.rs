//! Programs built without a format refuse it by name.

use crate::ground;
use slopegen::read::InputFormat;

#[test]
fn what_was_left_out_is_named() {
    for (format, bytes, name, there) in [
        (InputFormat::GeoTiff, &b"II*\0\x08\0\0\0"[..], "GeoTIFF", cfg!(feature = "geotiff")),
        (InputFormat::Las, b"LASF", "LAS", cfg!(feature = "las")),
    ] {
        let message = ground(format, bytes, &[]).unwrap_err();
        assert_eq!(message.starts_with(&format!("this program was built without {name}")), !there, "{message}");
        assert!(message.contains("help"), "{message}");
    }
}

//! What a ground file is, by its first bytes.

use crate::read::error::{clip, refuse};
use crate::read::{InputFormat, ReadError};

/// What a file looks like.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Looks {
    /// One of the formats that can be read.
    Like(InputFormat),
    /// Another known one: its name, and what turns it into ground that can be read.
    Other(&'static str, &'static str),
    /// Nothing known.
    Unknown,
}

const FROM_RASTER: &str = "convert it, e.g. `gdal_translate -of AAIGrid in.tif ground.asc`";
const FROM_SURFACE: &str = "export the surface as OBJ or PLY";
const UNPACK: &str = "unpack it first";
const FROM_MESH: &str = "export the mesh as OBJ or PLY with double coordinates";

/// First bytes of binary formats that are read.
const BINARY: [(&[u8], InputFormat); 8] = [
    (b"ply\n", InputFormat::Ply),
    (b"ply\r", InputFormat::Ply),
    (b"II*\0", InputFormat::GeoTiff),
    (b"MM\0*", InputFormat::GeoTiff),
    (b"II+\0", InputFormat::GeoTiff),
    (b"MM\0+", InputFormat::GeoTiff),
    (b"LASF", InputFormat::Las),
    (crate::read::dxf::SENTINEL, InputFormat::Dxf),
];

/// First bytes of formats that are known but not read.
const SIGNATURES: [(&[u8], &str, &str); 14] = [
    (b"\x89PNG", "a PNG image", FROM_RASTER),
    (b"\xFF\xD8\xFF", "a JPEG image", "give the elevations, not a picture of them"),
    (b"DSAA", "a Surfer grid", FROM_RASTER),
    (b"DSBB", "a Surfer grid", FROM_RASTER),
    (b"DSRB", "a Surfer grid", FROM_RASTER),
    (b"\x89HDF", "an HDF file", FROM_RASTER),
    (b"PK\x03\x04", "a ZIP archive", UNPACK),
    (b"\x1F\x8B", "a gzip archive", UNPACK),
    (b"7z\xBC\xAF", "a 7z archive", UNPACK),
    (b"glTF", "a binary glTF mesh", FROM_MESH),
    (b"solid ", "an STL mesh", FROM_MESH),
    (b"OFF", "an OFF mesh", FROM_MESH),
    (b"AC10", "a DWG drawing", FROM_SURFACE),
    (b"%PDF", "a PDF document", FROM_SURFACE),
];

fn looks(bytes: &[u8]) -> Looks {
    let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    if let Some((_, format)) = BINARY.iter().find(|(signature, _)| bytes.starts_with(signature)) {
        return Looks::Like(*format);
    }
    if let Some((_, name, help)) = SIGNATURES.iter().find(|(signature, ..)| bytes.starts_with(signature)) {
        return Looks::Other(name, help);
    }
    let head = &bytes[..bytes.len().min(4096)];
    let has = |word: &[u8]| head.windows(word.len()).any(|w| w.eq_ignore_ascii_case(word));
    let mut lines = head.split(|&b| b == b'\n' || b == b'\r').map(<[u8]>::trim_ascii).filter(|line| !line.is_empty());
    let data: Vec<&[u8]> = lines.by_ref().filter(|line| !line.starts_with(b"#")).take(2).collect();
    let Some(&first) = data.first() else { return Looks::Unknown };
    let word = first.split(u8::is_ascii_whitespace).next().unwrap_or(first);
    let is = |words: &[&[u8]]| words.iter().any(|w| w.eq_ignore_ascii_case(word));
    if first.starts_with(b"<") {
        let html = has(b"<html") || has(b"<!doctype html");
        return match (has(b"landxml"), html) {
            (true, _) => Looks::Like(InputFormat::LandXml),
            _ if has(b"<gpx") => Looks::Like(InputFormat::Gpx),
            (_, true) => Looks::Other("a web page", "download the file itself"),
            _ => Looks::Other("XML", FROM_SURFACE),
        };
    }
    if first.starts_with(b"{") || first.starts_with(b"[") {
        return Looks::Other("JSON", "give it in a format that is read as ground, such as LandXML, OBJ or points as text");
    }
    if is(&[b"ncols", b"nrows", b"xllcorner", b"xllcenter", b"yllcorner", b"yllcenter"]) {
        return Looks::Like(InputFormat::Asc);
    }
    if (word == b"0" && data.get(1).is_some_and(|line| *line == b"SECTION")) || word == b"999" && has(b"SECTION") {
        return Looks::Like(InputFormat::Dxf);
    }
    let next = first[word.len()..].trim_ascii_start().first();
    let figure = next.is_some_and(|b| b.is_ascii_digit() || b"+-.".contains(b));
    let names: [&[u8]; 4] = [b"o", b"g", b"mtllib", b"usemtl"];
    let figures: [&[u8]; 4] = [b"v", b"vn", b"vt", b"f"];
    if (figures.contains(&word) && figure) || (names.contains(&word) && next.is_some() && !first.contains(&b',')) {
        return Looks::Like(InputFormat::Obj);
    }
    let numbers = first
        .split(|b| matches!(b, b' ' | b'\t' | b',' | b';'))
        .filter(|field| !field.is_empty())
        .filter(|field| crate::read::decimal::number(field).is_some())
        .count();
    if numbers >= 2 { Looks::Like(InputFormat::Csv) } else { Looks::Unknown }
}

/// Human name of a format.
fn name(format: InputFormat) -> &'static str {
    match format {
        InputFormat::GeoJson => "GeoJSON",
        InputFormat::Csv => "points as text",
        InputFormat::Obj => "an OBJ mesh",
        InputFormat::Ply => "a PLY mesh",
        InputFormat::Asc => "an ESRI ASCII grid",
        InputFormat::LandXml => "LandXML",
        InputFormat::Dxf => "a DXF drawing",
        InputFormat::GeoTiff => "a GeoTIFF",
        InputFormat::Las => "a LAS point cloud",
        InputFormat::Gpx => "a GPS track",
    }
}

fn extension(format: InputFormat) -> &'static str {
    match format {
        InputFormat::GeoJson => ".geojson",
        InputFormat::Csv => ".csv",
        InputFormat::Obj => ".obj",
        InputFormat::Ply => ".ply",
        InputFormat::Asc => ".asc",
        InputFormat::LandXml => ".xml",
        InputFormat::Dxf => ".dxf",
        InputFormat::GeoTiff => ".tif",
        InputFormat::Las => ".las",
        InputFormat::Gpx => ".gpx",
    }
}

/// Refuses a file whose content is clearly not of the format asked for.
pub(super) fn check(label: &str, bytes: &[u8], format: InputFormat) -> Result<(), ReadError> {
    if format == InputFormat::GeoJson {
        let help = "give it in a format that is read as ground, such as LandXML, OBJ or points as text";
        return Err(refuse("ground is not read from GeoJSON", label, "format: geojson", help));
    }
    if format == InputFormat::Gpx {
        return Err(crate::read::gpx::refuse(label, bytes));
    }
    if bytes.iter().all(u8::is_ascii_whitespace) {
        return Err(refuse("the ground file is empty", label, format!("{} bytes", bytes.len()), "give a file with ground in it"));
    }
    let what = format!("the ground file is not {}", name(format));
    match looks(bytes) {
        // Its root may stand beyond the first bytes, behind comments.
        Looks::Other("XML", _) if format == InputFormat::LandXml => Ok(()),
        Looks::Other(found, help) => Err(refuse(&what, label, format!("its content looks like {found}"), help)),
        Looks::Like(found) if found != format => {
            let figures = format!("its content looks like {}", name(found));
            Err(refuse(&what, label, figures, &format!("name it `{}`", extension(found))))
        }
        Looks::Unknown if format == InputFormat::Ply => {
            let figures = format!("it begins with `{}`, not with `ply`", clip(bytes));
            Err(refuse(&what, label, figures, "check the file"))
        }
        _ => Ok(()),
    }
}

/// The format of a file whose name says nothing.
pub(in crate::read) fn only_by_content(label: &str, bytes: &[u8]) -> Result<InputFormat, ReadError> {
    let what = "the extension does not say what format the ground has";
    match looks(bytes) {
        Looks::Like(format) => Ok(format),
        Looks::Other(found, help) => Err(refuse(what, label, format!("its content looks like {found}"), help)),
        Looks::Unknown => {
            let help = "give LandXML (.xml), DXF (.dxf), OBJ (.obj), PLY (.ply), GeoTIFF (.tif), LAS (.las, .laz), points as text \
                        (.csv, .txt, .xyz), or ESRI ASCII grid (.asc)";
            Err(refuse(what, label, format!("it begins with `{}`", clip(bytes)), help))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn first_bytes_tell() {
        for (bytes, format) in [
            (&b"# made by hand\no ground\nv 1 2 3\n"[..], InputFormat::Obj),
            (b"\xEF\xBB\xBFv 1 2 3\n", InputFormat::Obj),
            (b"ply\r\nformat", InputFormat::Ply),
            (b"NCOLS 4\n", InputFormat::Asc),
            (b"II*\0rest", InputFormat::GeoTiff),
            (b"LASF", InputFormat::Las),
            (crate::read::dxf::SENTINEL, InputFormat::Dxf),
            (b"<?xml version=\"1.0\"?>\n<LandXML>", InputFormat::LandXml),
            (b"<?xml version=\"1.0\"?>\n<gpx version=\"1.1\">", InputFormat::Gpx),
            (b"  0\nSECTION\n", InputFormat::Dxf),
            (b"1.5 2.5 3\n", InputFormat::Csv),
            (b"#x y z\n1;2;3\n", InputFormat::Csv),
        ] {
            assert_eq!(looks(bytes), Looks::Like(format), "{}", clip(bytes));
        }
        for (bytes, found) in [(&b"\x89PNG"[..], "a PNG image"), (b"{\"type\":1}", "JSON")] {
            assert!(matches!(looks(bytes), Looks::Other(name, _) if name == found), "{}", clip(bytes));
        }
        assert_eq!(looks(b"x,y,z\n1,2,3"), Looks::Unknown);
        assert_eq!(looks(b"v,e,r\n1,2,3"), Looks::Unknown);
    }

    #[test]
    fn a_wrong_name_is_told() {
        let error = check("a.obj", b"II*\0", InputFormat::Obj).unwrap_err().to_string();
        assert!(error.contains("not an OBJ mesh") && error.contains("looks like a GeoTIFF"), "{error}");
        let error = check("a.csv", b"v 1 2 3\n", InputFormat::Csv).unwrap_err().to_string();
        assert!(error.contains("looks like an OBJ mesh") && error.contains("`.obj`"), "{error}");
        assert!(check("a.csv", b"x,y,z\n1,2,3", InputFormat::Csv).is_ok());
    }
}

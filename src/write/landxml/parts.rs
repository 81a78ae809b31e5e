//! What files of surfaces and of lines have alike: the beginning, points and text; volumes.

use crate::model::LengthUnit;
use crate::write::crs::{epsg, is_wkt};
use crate::write::head::{finite, plain};
use crate::write::number::push_f64;
use crate::write::{Earthworks, EncodeError, Head};

const NAMESPACE: &str = "http://www.landxml.org/schema/LandXML-1.2";

/// Everything before the units. The schema demands a date and a time; that of the run would make the same input give other
/// bytes.
const ROOT: &str = "xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" version=\"1.2\" date=\"1970-01-01\" \
                    time=\"00:00:00\" language=\"English\" readOnly=\"false\"";

/// The root element opened, units, coordinate system and program.
pub(super) fn start(head: &Head<'_>) -> Vec<u8> {
    let units = match head.unit {
        LengthUnit::Metre => {
            "<Metric areaUnit=\"squareMeter\" linearUnit=\"meter\" volumeUnit=\"cubicMeter\" temperatureUnit=\"celsius\" \
             pressureUnit=\"milliBars\" angularUnit=\"decimal degrees\" directionUnit=\"decimal degrees\"/>"
        }
        LengthUnit::Foot => {
            "<Imperial areaUnit=\"squareFoot\" linearUnit=\"foot\" volumeUnit=\"cubicFeet\" temperatureUnit=\"fahrenheit\" \
             pressureUnit=\"inchHG\" angularUnit=\"decimal degrees\" directionUnit=\"decimal degrees\"/>"
        }
        LengthUnit::UsSurveyFoot => {
            "<Imperial areaUnit=\"squareFoot\" linearUnit=\"USSurveyFoot\" volumeUnit=\"cubicFeet\" \
             temperatureUnit=\"fahrenheit\" pressureUnit=\"inchHG\" angularUnit=\"decimal degrees\" \
             directionUnit=\"decimal degrees\"/>"
        }
    };
    let mut bytes = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<LandXML xmlns=\"{NAMESPACE}\" {ROOT} \
         xsi:schemaLocation=\"{NAMESPACE} {NAMESPACE}/LandXML-1.2.xsd\">\n<Units>{units}</Units>\n"
    )
    .into_bytes();
    if let Some(crs) = head.crs {
        bytes.extend_from_slice(b"<CoordinateSystem ");
        let (key, value) = match epsg(crs) {
            Some(code) => ("epsgCode", code),
            None if is_wkt(crs) => ("ogcWktCode", crs),
            None => ("name", crs),
        };
        bytes.extend_from_slice(format!("{key}=\"").as_bytes());
        push_escaped(&mut bytes, value);
        bytes.extend_from_slice(b"\"/>\n");
    }
    let (name, version) = (env!("CARGO_PKG_NAME"), env!("CARGO_PKG_VERSION"));
    bytes.extend_from_slice(format!("<Application name=\"{name}\" version=\"{version}\"/>\n").as_bytes());
    bytes
}

/// Cut and fill between the ground and the surface of this name.
pub(super) fn volumes(bytes: &mut Vec<u8>, earthworks: &Earthworks<'_>, name: &str) -> Result<(), EncodeError> {
    bytes.extend_from_slice(b"<SurfVolumes surfVolCalcMethod=\"composite\">\n<SurfVolume surfBase=\"");
    push_escaped(bytes, earthworks.ground);
    bytes.extend_from_slice(b"\" surfCompare=\"");
    push_escaped(bytes, name);
    let (cut, fill) = (finite(earthworks.cut, "volume", 1)?, finite(earthworks.fill, "volume", 2)?);
    for (key, value) in [("volCut", cut), ("volFill", fill), ("volTotal", cut - fill)] {
        bytes.extend_from_slice(format!("\" {key}=\"").as_bytes());
        push_f64(bytes, value);
    }
    bytes.extend_from_slice(b"\" desc=\"volTotal is volCut - volFill\"/>\n</SurfVolumes>\n");
    Ok(())
}

/// Appends a point in the order of the format.
pub(super) fn push_northing_first(bytes: &mut Vec<u8>, [east, north, up]: [f64; 3]) {
    push_f64(bytes, north);
    bytes.push(b' ');
    push_f64(bytes, east);
    bytes.push(b' ');
    push_f64(bytes, up);
}

/// Appends text for an attribute in double quotes.
pub(super) fn push_escaped(bytes: &mut Vec<u8>, text: &str) {
    for byte in plain(text).bytes() {
        match byte {
            b'&' => bytes.extend_from_slice(b"&amp;"),
            b'<' => bytes.extend_from_slice(b"&lt;"),
            b'>' => bytes.extend_from_slice(b"&gt;"),
            b'"' => bytes.extend_from_slice(b"&quot;"),
            _ => bytes.push(byte),
        }
    }
}

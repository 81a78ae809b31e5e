//! What the program talks about: lines, slopes, designs, meshes. Plain data with checked constructors.

pub mod bulking;
pub mod design;
pub(crate) mod digits;
pub mod line;
pub mod memory;
pub mod message;
pub mod notation;
pub mod note;
pub mod slope;
pub mod terrain;
pub mod tin;
pub mod unit;

pub use bulking::{Bulking, Share, ShareError};
pub use design::{Design, Extent, Joggle, Sheet, Side};
pub use line::{Axis, Breakline, Chain, Line, Place, Role};
pub use memory::{LimitedBy, Memory, Need, TooLarge};
pub use notation::SlopeError;
pub use note::{Defect, Defects, Note};
pub use slope::Slope;
pub use terrain::Terrain;
pub use tin::{CurveKind, LineFeature, Part, Tin};
pub use unit::LengthUnit;

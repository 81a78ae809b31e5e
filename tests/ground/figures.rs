//! Cut and fill, and how they are compared.

/// Volumes and plan areas, of the platform and of both slopes together.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Figures {
    pub(crate) cut: f64,
    pub(crate) fill: f64,
    pub(crate) cut_area: f64,
    pub(crate) fill_area: f64,
}

impl Figures {
    /// Names and values.
    pub(crate) fn named(&self) -> [(&'static str, f64); 4] {
        [("cut", self.cut), ("fill", self.fill), ("area of cut", self.cut_area), ("area of fill", self.fill_area)]
    }

    /// Cut for fill.
    pub(crate) fn swapped(&self) -> Self {
        Self { cut: self.fill, fill: self.cut, cut_area: self.fill_area, fill_area: self.cut_area }
    }

    /// Fails unless volumes and plan areas are within `relative` of the larger of their kind.
    #[track_caller]
    pub(crate) fn near(&self, expected: &Self, relative: f64, what: &str) {
        self.volumes_near(expected, relative, what);
        self.areas_near(expected, relative, what);
    }

    /// The same for brute force: the rim is as coarse as its cells, so areas are ten times as far off.
    #[track_caller]
    pub(crate) fn roughly(&self, expected: &Self, relative: f64, what: &str) {
        self.volumes_near(expected, relative, what);
        self.areas_near(expected, 10.0 * relative, what);
    }

    #[track_caller]
    pub(crate) fn volumes_near(&self, expected: &Self, relative: f64, what: &str) {
        let scale = expected.cut.max(expected.fill);
        compare(self, expected, &self.named()[..2], &expected.named()[..2], relative * scale, what);
    }

    #[track_caller]
    pub(crate) fn areas_near(&self, expected: &Self, relative: f64, what: &str) {
        let scale = expected.cut_area.max(expected.fill_area);
        compare(self, expected, &self.named()[2..], &expected.named()[2..], relative * scale, what);
    }
}

#[track_caller]
fn compare(found: &Figures, expected: &Figures, a: &[(&'static str, f64)], b: &[(&'static str, f64)], within: f64, what: &str) {
    for ((name, value), (_, wanted)) in a.iter().zip(b) {
        let off = (value - wanted).abs();
        assert!(off <= within, "{what}: {name} {value} for {wanted}\nfound {found:?}\nwanted {expected:?}");
    }
}

impl std::ops::Add for Figures {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self {
            cut: self.cut + other.cut,
            fill: self.fill + other.fill,
            cut_area: self.cut_area + other.cut_area,
            fill_area: self.fill_area + other.fill_area,
        }
    }
}

impl std::ops::Sub for Figures {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self {
            cut: self.cut - other.cut,
            fill: self.fill - other.fill,
            cut_area: self.cut_area - other.cut_area,
            fill_area: self.fill_area - other.fill_area,
        }
    }
}

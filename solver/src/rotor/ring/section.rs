//! The cross-section of a ring: what a person draws, checked.
//!
//! Coordinates are (r, z): the radius from the ring's axis and the height along it. The stator is below: the ring
//! touches it with the lowest face of its section.

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// An isotropic elastic material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Its name in presets.
    pub name: &'static str,
    /// Young's modulus E \[Pa\], positive.
    pub youngs_modulus: f64,
    /// Poisson's ratio ν, 0 to 0.49.
    pub poisson_ratio: f64,
    /// Density ρ \[kg/m³\], positive.
    pub density: f64,
    /// Yield stress in tension \[Pa\].
    pub yield_stress: f64,
}

/// Typical values at 20 °C. Sources, in this order: 6061-T6, typical properties of the Aluminum Association (as in
/// ASM Handbook 2); structural steel S235, EN 1993-1-1, 3.2.6, EN 1991-1-1, table A.4, and EN 10025-2; free-cutting brass C36000,
/// half-hard, Copper Development Association; PEEK 450G without filler, data sheet of Victrex (E and yield by ISO 527, ρ by ISO 1183) and
/// its properties guide (ν).
pub const MATERIALS: &[Material] = &[
    Material { name: "aluminium", youngs_modulus: 68.9e9, poisson_ratio: 0.33, density: 2700.0, yield_stress: 276e6 },
    Material { name: "steel", youngs_modulus: 210e9, poisson_ratio: 0.30, density: 7850.0, yield_stress: 235e6 },
    Material { name: "brass", youngs_modulus: 97e9, poisson_ratio: 0.31, density: 8490.0, yield_stress: 310e6 },
    Material { name: "peek", youngs_modulus: 4.0e9, poisson_ratio: 0.40, density: 1300.0, yield_stress: 98e6 },
];

/// In bytes a material is its name.
impl Serialize for Material {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        self.name.serialize(to)
    }
}

impl<'de> Deserialize<'de> for Material {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let name = String::deserialize(from)?;
        MATERIALS.iter().find(|known| known.name == name).copied().ok_or_else(|| D::Error::custom(name))
    }
}

/// A rectangle of one material, turned round the axis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Part {
    /// Name used in messages and drawings.
    pub name: String,
    /// Inner radius \[m\], positive.
    pub inner_radius: f64,
    /// Outer radius \[m\].
    pub outer_radius: f64,
    /// Height of its lower face \[m\].
    pub bottom: f64,
    /// Height of its upper face \[m\].
    pub top: f64,
    /// Material of the part.
    pub material: Material,
}

/// Where the ring is held: what of it lies within this box, edges included, cannot move in the directions that are
/// fixed. A box without width or height is a line or a point.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Support {
    /// Inner radius \[m\].
    pub inner_radius: f64,
    /// Outer radius \[m\].
    pub outer_radius: f64,
    /// Height of its lower edge \[m\].
    pub bottom: f64,
    /// Height of its upper edge \[m\].
    pub top: f64,
    /// No displacement along r.
    pub radial: bool,
    /// No displacement along z.
    pub axial: bool,
    /// No displacement along θ.
    pub circumferential: bool,
}

/// Where the stator touches the ring: a band of the lowest face of the section.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Band {
    /// Contact radius r, the middle of the band \[m\].
    pub radius: f64,
    /// Radial width w of the band \[m\].
    pub width: f64,
}

impl Band {
    /// Inner and outer radius \[m\].
    pub(super) fn radii(self) -> (f64, f64) {
        (self.radius - 0.5 * self.width, self.radius + 0.5 * self.width)
    }
}

/// Why a ring cannot be computed. Lengths in the messages are in millimetres, as people draw them.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RingError {
    /// A section without parts.
    #[error("the section has no part: allowed one or more")]
    NoPart,
    /// A part whose faces are not in order, or whose dimensions are not finite.
    #[error("part {part}: {what}")]
    Part {
        /// Its name.
        part: String,
        /// The fault, and what is allowed.
        what: String,
    },
    /// Two parts share more than an edge.
    #[error("parts {first} and {second} overlap: parts may share an edge, and no more")]
    Overlap {
        /// The first of the two.
        first: String,
        /// The second.
        second: String,
    },
    /// A part that shares no edge with the rest.
    #[error(
        "part {part} is not connected with part {first}: allowed are parts that share an edge, of which a corner is not enough"
    )]
    Disconnected {
        /// The part that is on its own.
        part: String,
        /// The first part of the section.
        first: String,
    },
    /// A support that is not in order.
    #[error("support {number}: {what}")]
    Support {
        /// Which of the supports, from 1.
        number: usize,
        /// The fault, and what is allowed.
        what: String,
    },
    /// The stator touches where the section has no face.
    #[error(
        "the contact from r = {inner_mm} to {outer_mm} mm is not within the lowest face of the section: allowed {allowed}; make the part that it touches as wide, or the contact narrower"
    )]
    Band {
        /// Inner radius of the contact \[mm\].
        inner_mm: f64,
        /// Outer radius of the contact \[mm\].
        outer_mm: f64,
        /// The lowest faces, as "28.5 to 29.5 mm".
        allowed: String,
    },
    /// Nothing holds the ring against a rigid motion of this order.
    #[error("no support holds the ring against {motion}: {allowed}")]
    Free {
        /// The motion in words.
        motion: &'static str,
        /// Supports that would hold it, in words.
        allowed: &'static str,
    },
    /// The mesh would be too large.
    #[error(
        "the section needs a mesh of {elements} elements, allowed up to {most}: its smallest dimensions are too small beside its largest"
    )]
    Elements {
        /// Elements that it needs.
        elements: usize,
        /// The most that are allowed.
        most: usize,
    },
    /// The equations of this order have no solution to working precision.
    #[error(
        "the equations of the section cannot be solved to working precision for order {order}: its parts are too unequal"
    )]
    Singular {
        /// The order m.
        order: u32,
    },
    /// Cancelled.
    #[error("cancelled")]
    Cancelled,
    /// There is not enough memory for the equations.
    #[error("not enough memory for the equations of the section")]
    Memory,
}

/// A checked cross-section: connected parts that do not overlap, and supports that hold something.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Section {
    parts: Vec<Part>,
    supports: Vec<Support>,
    /// Whose elements its mesh has, moved with the lines of this one, and the band that they are made for.
    pattern: Option<Box<(Section, Band)>>,
}

impl Section {
    /// Checks the parts and supports.
    ///
    /// # Errors
    /// [`RingError`] names the first part or support that is not in order, and what is allowed.
    pub fn new(parts: Vec<Part>, supports: Vec<Support>) -> Result<Self, RingError> {
        if parts.is_empty() {
            return Err(RingError::NoPart);
        }
        parts.iter().try_for_each(Part::check)?;
        for (i, first) in parts.iter().enumerate() {
            if let Some(second) = parts[i + 1..].iter().find(|second| first.overlaps(second)) {
                return Err(RingError::Overlap { first: first.name.clone(), second: second.name.clone() });
            }
        }
        let mut reached = vec![0];
        let mut next = 0;
        while let Some(&from) = reached.get(next) {
            let beside = |i: &usize| !reached.contains(i) && parts[*i].shares_edge(&parts[from]);
            let found: Vec<usize> = (0..parts.len()).filter(beside).collect();
            reached.extend(found);
            next += 1;
        }
        if let Some(alone) = (0..parts.len()).find(|i| !reached.contains(i)) {
            return Err(RingError::Disconnected { part: parts[alone].name.clone(), first: parts[0].name.clone() });
        }
        for (i, support) in supports.iter().enumerate() {
            support.check(&parts).map_err(|what| RingError::Support { number: i + 1, what })?;
        }
        Ok(Self { parts, supports, pattern: None })
    }

    /// The same section whose mesh has the elements of `other` under its contact `band`, moved as its edges are, if both hang together alike: what
    /// the elements leave of a compliance then changes smoothly from one to the other, and cancels in their difference.
    pub fn meshed_as(&self, other: &Self, band: Band) -> Self {
        Self { pattern: Some(Box::new((Self { pattern: None, ..other.clone() }, band))), ..self.clone() }
    }

    /// Whose elements its mesh has, if not its own, and the band that they are made for.
    pub(super) fn pattern(&self) -> Option<(&Self, Band)> {
        self.pattern.as_deref().map(|(section, band)| (section, *band))
    }

    /// The parts, in the order given.
    pub fn parts(&self) -> &[Part] {
        &self.parts
    }

    /// The supports, in the order given.
    pub fn supports(&self) -> &[Support] {
        &self.supports
    }

    /// Height of the lowest face, which the stator touches \[m\].
    pub fn contact_height(&self) -> f64 {
        self.parts.iter().map(|part| part.bottom).fold(f64::INFINITY, f64::min)
    }

    /// The lowest faces, as intervals of the radius \[m\], ascending; neighbours that touch are one.
    pub fn contact_faces(&self) -> Vec<(f64, f64)> {
        let height = self.contact_height();
        let mut lowest: Vec<_> = self.parts.iter().filter(|part| same(part.bottom, height)).collect();
        lowest.sort_by(|a, b| a.inner_radius.total_cmp(&b.inner_radius));
        let mut faces: Vec<(f64, f64)> = Vec::new();
        for part in lowest {
            match faces.last_mut() {
                Some(face) if same(face.1, part.inner_radius) => face.1 = part.outer_radius,
                _ => faces.push((part.inner_radius, part.outer_radius)),
            }
        }
        faces
    }
}

/// Lengths that differ by less than this are one \[m\].
pub(super) const SAME: f64 = 1e-9;

/// Whether two coordinates are one.
pub(super) fn same(a: f64, b: f64) -> bool {
    (a - b).abs() < SAME
}

/// A length for people, in millimetres.
pub(super) fn mm(length: f64) -> f64 {
    crate::digits::as_given(1e3 * length)
}

/// The length that two intervals have in common, negative if they are apart.
pub(super) fn common(a: (f64, f64), b: (f64, f64)) -> f64 {
    a.1.min(b.1) - a.0.max(b.0)
}

impl Part {
    fn check(&self) -> Result<(), RingError> {
        let fault = |what: String| Err(RingError::Part { part: self.name.clone(), what });
        let (inner, outer, bottom, top) = (mm(self.inner_radius), mm(self.outer_radius), mm(self.bottom), mm(self.top));
        if ![inner, outer, bottom, top].iter().all(|length| length.is_finite()) {
            return fault("a dimension is not a number".to_owned());
        }
        if self.inner_radius < SAME {
            return fault(format!("inner radius = {inner} mm: allowed above 0"));
        }
        if self.outer_radius - self.inner_radius < 1e3 * SAME {
            return fault(format!(
                "outer radius = {outer} mm: allowed above its inner radius, {inner} mm, by 0.001 mm or more"
            ));
        }
        if self.top - self.bottom < 1e3 * SAME {
            return fault(format!("top = {top} mm: allowed above its bottom, {bottom} mm, by 0.001 mm or more"));
        }
        let Material { youngs_modulus, poisson_ratio, density, .. } = self.material;
        if !(youngs_modulus > 0.0 && youngs_modulus.is_finite()) {
            return fault(format!("Young's modulus = {youngs_modulus} Pa: allowed above 0"));
        }
        if !(0.0..=0.49).contains(&poisson_ratio) {
            return fault(format!("Poisson's ratio = {poisson_ratio}: allowed 0 to 0.49"));
        }
        if !(density > 0.0 && density.is_finite()) {
            return fault(format!("density = {density} kg/m³: allowed above 0"));
        }
        Ok(())
    }

    pub(super) fn radii(&self) -> (f64, f64) {
        (self.inner_radius, self.outer_radius)
    }

    pub(super) fn heights(&self) -> (f64, f64) {
        (self.bottom, self.top)
    }

    fn overlaps(&self, other: &Self) -> bool {
        common(self.radii(), other.radii()) > SAME && common(self.heights(), other.heights()) > SAME
    }

    fn shares_edge(&self, other: &Self) -> bool {
        let (along, up) = (common(self.radii(), other.radii()), common(self.heights(), other.heights()));
        (along > SAME && up > -SAME) || (up > SAME && along > -SAME)
    }
}

impl Support {
    fn check(&self, parts: &[Part]) -> Result<(), String> {
        let (inner, outer) = (mm(self.inner_radius), mm(self.outer_radius));
        let (bottom, top) = (mm(self.bottom), mm(self.top));
        if ![inner, outer, bottom, top].iter().all(|length| length.is_finite()) {
            return Err("a dimension is not a number".to_owned());
        }
        if self.outer_radius < self.inner_radius {
            return Err(format!("outer radius = {outer} mm: allowed from its inner radius, {inner} mm"));
        }
        if self.top < self.bottom {
            return Err(format!("top = {top} mm: allowed from its bottom, {bottom} mm"));
        }
        if !(self.radial || self.axial || self.circumferential) {
            return Err("it fixes no direction: allowed radial, axial, circumferential, or several of them".to_owned());
        }
        let holds = |part: &Part| {
            common((self.inner_radius, self.outer_radius), part.radii()) > -SAME
                && common((self.bottom, self.top), part.heights()) > -SAME
        };
        if !parts.iter().any(holds) {
            return Err(format!(
                "no part is within r = {inner} to {outer} mm, z = {bottom} to {top} mm: allowed is a box that touches a part"
            ));
        }
        Ok(())
    }
}

#[cfg(test)]
impl Section {
    /// One rectangle.
    pub(super) fn rectangle(
        radii: (f64, f64),
        heights: (f64, f64),
        material: Material,
        supports: Vec<Support>,
    ) -> Self {
        Self::new(vec![Part::of("ring", radii, heights, material)], supports).unwrap()
    }
}

#[cfg(test)]
impl Part {
    /// Of these radii and heights \[m\].
    pub(super) fn of(name: &str, radii: (f64, f64), heights: (f64, f64), material: Material) -> Self {
        let ((inner_radius, outer_radius), (bottom, top)) = (radii, heights);
        Self { name: name.to_owned(), inner_radius, outer_radius, bottom, top, material }
    }

    /// Of aluminium, with radii and heights in millimetres.
    pub(super) fn in_mm(name: &str, radii: (f64, f64), heights: (f64, f64)) -> Self {
        let metres = |(from, to): (f64, f64)| (1e-3 * from, 1e-3 * to);
        Self::of(name, metres(radii), metres(heights), MATERIALS[0])
    }
}

#[cfg(test)]
impl Support {
    /// All of the section at one height, held in the given directions of r, z and θ.
    pub(super) fn at_height(height: f64, [radial, axial, circumferential]: [bool; 3]) -> Self {
        Self { inner_radius: 0.0, outer_radius: 1e3, bottom: height, top: height, radial, axial, circumferential }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_section_that_is_not_in_order_is_refused_with_what_is_allowed() {
        let web = |radii, heights| Part::in_mm("web", radii, heights);
        let flange = || Part::in_mm("flange", (25.0, 30.0), (1.0, 2.0));
        let at = Support::at_height(0.0, [false, true, false]);
        let held = Support { inner_radius: 20e-3, outer_radius: 21e-3, top: 1e-3, ..at };
        for (parts, supports, expected) in [
            (vec![], vec![], "no part"),
            (
                vec![web((29.0, 28.0), (0.0, 1.0))],
                vec![],
                "part web: outer radius = 28 mm: allowed above its inner radius, 29 mm",
            ),
            (vec![web((0.0, 28.0), (0.0, 1.0))], vec![], "inner radius = 0 mm: allowed above 0"),
            (vec![web((27.0, 28.0), (f64::NAN, 1.0))], vec![], "not a number"),
            (vec![flange(), web((28.0, 29.0), (0.0, 1.5))], vec![], "parts flange and web overlap"),
            (vec![flange(), web((30.0, 31.0), (0.0, 1.0))], vec![], "part web is not connected with part flange"),
            (vec![flange()], vec![held], "support 1: no part is within r = 20 to 21 mm"),
            (vec![flange()], vec![Support { axial: false, ..held }], "support 1: it fixes no direction"),
        ] {
            let text = Section::new(parts, supports).unwrap_err().to_string();
            assert!(text.contains(expected), "{text}");
        }
        let touching = Support { outer_radius: 25e-3, bottom: 2e-3, top: 2e-3, ..held };
        assert!(Section::new(vec![flange(), web((28.0, 29.0), (0.0, 1.0))], vec![touching]).is_ok());
    }

    #[test]
    fn contact_faces_are_the_lowest_and_neighbours_are_one() {
        let parts = vec![
            Part::in_mm("flange", (25.0, 31.0), (1.0, 2.0)),
            Part::in_mm("second", (29.0, 29.5), (0.0, 1.0)),
            Part::in_mm("first", (28.0, 29.0), (0.0, 1.0)),
            Part::in_mm("apart", (30.0, 30.5), (0.0, 1.0)),
        ];
        let section = Section::new(parts, Vec::new()).unwrap();
        let faces: Vec<_> = section.contact_faces().iter().map(|face| (mm(face.0), mm(face.1))).collect();
        assert_eq!(faces, [(28.0, 29.5), (30.0, 30.5)]);
    }
}

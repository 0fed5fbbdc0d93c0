//! Linear systems of a film's nodes.
//!
//! Unknown k = row × columns + column couples to every node of its own row, by a matrix A that is the same for all rows except for a factor
//! of each column, and to the same column of the rows on either side (west, east: k ∓ columns). [`super::rows`] solves such systems.

/// The coefficients of a system, one value for each unknown.
#[derive(Clone, Debug, Default)]
pub struct Coupling {
    /// Coefficient of the node itself, in addition to that in A.
    pub centre: Vec<f64>,
    /// Coefficient of the node at smaller x.
    pub west: Vec<f64>,
    /// Coefficient of the node at larger x.
    pub east: Vec<f64>,
    /// Factor of the node's column of A.
    pub within: Vec<f64>,
}

impl Coupling {
    /// All zero, for `unknowns` nodes.
    pub fn new(unknowns: usize) -> Self {
        let zero = vec![0.0; unknowns];
        Self { centre: zero.clone(), west: zero.clone(), east: zero.clone(), within: zero }
    }

    /// Centre, west, east and within.
    pub fn fields(&mut self) -> [&mut Vec<f64>; 4] {
        [&mut self.centre, &mut self.west, &mut self.east, &mut self.within]
    }

    /// Sets every entry to zero.
    pub fn clear(&mut self) {
        self.fields().into_iter().for_each(|values| values.fill(0.0));
    }
}

/// The matrix A.
#[derive(Clone, Debug)]
pub enum Across {
    /// All entries, column by column.
    Full(Vec<f64>),
    /// Tridiagonal, with so many nodes that this structure is worth using.
    Neighbours(Tridiagonal),
}

/// Number of columns from which a tridiagonal A is stored as such.
pub const MANY_COLUMNS: usize = 20;

impl Across {
    /// From `matrix[row][column]`.
    pub fn new(columns: usize, matrix: &[f64]) -> Self {
        let entry = |row: usize, column: usize| matrix[row * columns + column];
        let places = || (0..columns).flat_map(|row| (0..columns).map(move |column| (row, column)));
        if columns < MANY_COLUMNS || places().any(|(i, j)| i.abs_diff(j) > 1 && entry(i, j) != 0.0) {
            return Self::Full(places().map(|(column, row)| entry(row, column)).collect());
        }
        Self::Neighbours(Tridiagonal {
            below: (0..columns).map(|i| if i > 0 { entry(i, i - 1) } else { 0.0 }).collect(),
            diagonal: (0..columns).map(|i| entry(i, i)).collect(),
            above: (0..columns).map(|i| if i + 1 < columns { entry(i, i + 1) } else { 0.0 }).collect(),
        })
    }

    /// Diagonal entry of node `j` in a matrix of so many columns.
    #[inline(always)]
    pub fn diagonal(&self, j: usize, columns: usize) -> f64 {
        match self {
            Self::Full(matrix) => matrix[j * columns + j],
            Self::Neighbours(bands) => bands.diagonal[j],
        }
    }

    /// `product` = A × `values`. `B` is the number of columns, or 0 to take it at run time.
    #[inline(always)]
    pub fn multiply<const B: usize>(&self, values: &[f64], product: &mut [f64]) {
        let b = if B == 0 { values.len() } else { B };
        let (values, product) = (&values[..b], &mut product[..b]);
        match self {
            Self::Full(matrix) => {
                product.fill(0.0);
                for (column, value) in matrix[..b * b].chunks_exact(b).zip(values) {
                    product.iter_mut().zip(column).for_each(|(product, entry)| *product += entry * value);
                }
            }
            Self::Neighbours(Tridiagonal { below, diagonal, above }) => {
                for ((product, value), entry) in product.iter_mut().zip(values).zip(diagonal) {
                    *product = entry * value;
                }
                let lower = product[1..].iter_mut().zip(values).zip(&below[1..]);
                lower.for_each(|((product, value), entry)| *product += entry * value);
                let upper = product.iter_mut().zip(&values[1..]).zip(above);
                upper.for_each(|((product, value), entry)| *product += entry * value);
            }
        }
    }
}

/// A tridiagonal matrix, which couples neighbours only.
#[derive(Clone, Debug)]
pub struct Tridiagonal {
    /// Coefficient of the node before each one; 0 for the first.
    pub below: Vec<f64>,
    /// Coefficient of the node itself.
    pub diagonal: Vec<f64>,
    /// Coefficient of the node after each one; 0 for the last.
    pub above: Vec<f64>,
}

impl Tridiagonal {
    /// How many nodes.
    pub fn columns(&self) -> usize {
        self.diagonal.len()
    }

    /// The coefficients of the rows of the even and of the odd nodes.
    pub fn apart(&self) -> [Self; 2] {
        [0, 1].map(|first| {
            let every_other = |band: &[f64]| band.iter().skip(first).step_by(2).copied().collect();
            Self {
                below: every_other(&self.below),
                diagonal: every_other(&self.diagonal),
                above: every_other(&self.above),
            }
        })
    }

    /// The same diffusion between the even nodes only, and the ratio of each of their widths here to that on the coarser grid. The widths
    /// follow from the matrix, which is a symmetric conductance matrix divided by them.
    pub fn every_other(&self) -> (Self, Vec<f64>) {
        let n = self.columns();
        let mut width = vec![1.0; n];
        for j in 1..n {
            width[j] = width[j - 1] * self.above[j - 1] / self.below[j];
        }
        // Conductance after each node; for the last node that to the edge.
        let total = |j: usize| width[j] * (self.diagonal[j] + self.below[j] + self.above[j]);
        let conductance: Vec<f64> =
            (0..n).map(|j| if j + 1 < n { -width[j] * self.above[j] } else { total(j) }).collect();
        let first = if n > 1 { total(0) } else { 0.0 };
        let few = n.div_ceil(2);
        let behind: Vec<f64> = (0..few)
            .map(|m| match conductance.get(2 * m + 1) {
                Some(next) => conductance[2 * m] * next / (conductance[2 * m] + next),
                None => conductance[2 * m],
            })
            .collect();
        let half = |j: Option<usize>| j.and_then(|j| width.get(j)).map_or(0.0, |width| 0.5 * width);
        let wide: Vec<f64> =
            (0..few).map(|m| width[2 * m] + half((2 * m).checked_sub(1)) + half(Some(2 * m + 1))).collect();
        let before = |m: usize| if m > 0 { behind[m - 1] } else { first };
        let fewer = Self {
            below: (0..few).map(|m| if m > 0 { -before(m) / wide[m] } else { 0.0 }).collect(),
            diagonal: (0..few).map(|m| (before(m) + behind[m]) / wide[m]).collect(),
            above: (0..few).map(|m| if m + 1 < few { -behind[m] / wide[m] } else { 0.0 }).collect(),
        };
        (fewer, (0..few).map(|m| width[2 * m] / wide[m]).collect())
    }
}

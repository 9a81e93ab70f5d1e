//! A tableau made ready for machines.
//!
//! The state of a machine is `y = (q, v)` with `q' = v`, `v' = a(t, q, v)`. Put the stages of `q'`
//! into those of `q`, and a Runge–Kutta method needs the accelerations `kⱼ` alone:
//!
//! ```text
//! vᵢ = v + h Σⱼ aᵢⱼ kⱼ
//! qᵢ = q + cᵢ h v + h² Σⱼ āᵢⱼ kⱼ,   Ā = A A
//! ```
//!
//! the same numbers up to roundoff, with half of the storage and one pass over the stages for both.
//! E. Hairer, S. P. Nørsett, G. Wanner, *Solving Ordinary Differential Equations I*, 2nd ed., 1993,
//! section II.14.

use super::{MAX_STAGES, Tableau};

/// The most rows that dense output may have beyond its cubic.
pub(super) const MAX_DENSE: usize = 4;

/// A weighted sum of stages, for velocities and for positions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Row {
    terms: [Term; MAX_STAGES],
    length: usize,
}

/// What one stage contributes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Term {
    /// Which stage.
    pub stage: usize,
    /// Its weight in the velocity, times `h`.
    pub velocity: f64,
    /// Its weight in the position, times `h²`.
    pub position: f64,
}

/// The rows of a method, zeros left out.
#[derive(Debug)]
pub(crate) struct Scheme {
    /// The stages, the new point (row `stages`) and the stages of dense output.
    pub rows: [Row; MAX_STAGES],
    /// How many rows there are.
    pub length: usize,
    /// The estimate of the error.
    pub error: Row,
    /// The coarser estimate; empty in methods that have none.
    pub coarse_error: Row,
    /// Whether an estimate needs the acceleration at the new point.
    pub error_needs_end: bool,
    /// Coefficients of dense output beyond the cubic's.
    pub dense: [Row; MAX_DENSE],
    /// How many of them.
    pub dense_length: usize,
}

impl Row {
    const EMPTY: Self = Self {
        terms: [Term {
            stage: 0,
            velocity: 0.0,
            position: 0.0,
        }; MAX_STAGES],
        length: 0,
    };

    /// The terms that are not zero.
    #[inline(always)]
    pub fn terms(&self) -> &[Term] {
        &self.terms[..self.length]
    }

    /// `weights` for velocities, `weights · A` for positions.
    const fn new(weights: &[f64], a: &[&[f64]]) -> Self {
        let mut row = Self::EMPTY;
        let mut j = 0;
        while j < weights.len() {
            let (mut sum, mut size) = (0.0, 0.0);
            let mut i = 0;
            while i < weights.len() {
                // A row may leave out the zeros at its end.
                if j < a[i].len() {
                    let product = weights[i] * a[i][j];
                    sum += product;
                    size += product.abs();
                }
                i += 1;
            }
            // A sum of at most 16 rounded products: what is no larger than their roundoff stands
            // for 0.
            let position = if sum.abs() <= 16.0 * f64::EPSILON * size {
                0.0
            } else {
                sum
            };
            if weights[j] != 0.0 || position != 0.0 {
                row.terms[row.length] = Term {
                    stage: j,
                    velocity: weights[j],
                    position,
                };
                row.length += 1;
            }
            j += 1;
        }
        row
    }

    /// Whether a stage has a part in it.
    pub const fn uses(&self, stage: usize) -> bool {
        let mut i = 0;
        while i < self.length {
            if self.terms[i].stage == stage {
                return true;
            }
            i += 1;
        }
        false
    }
}

impl Scheme {
    pub const fn new(tableau: &Tableau) -> Self {
        let (a, stages) = (tableau.a, tableau.stages);
        assert!(a.len() <= MAX_STAGES && tableau.c.len() == a.len() && stages < a.len());
        assert!(tableau.dense.len() <= MAX_DENSE);

        let mut rows = [Row::EMPTY; MAX_STAGES];
        let mut i = 0;
        while i < a.len() {
            rows[i] = Row::new(a[i], a);
            i += 1;
        }
        let error = Row::new(tableau.error, a);
        let coarse_error = match tableau.coarse_error {
            Some(weights) => Row::new(weights, a),
            None => Row::EMPTY,
        };
        let mut dense = [Row::EMPTY; MAX_DENSE];
        let mut i = 0;
        while i < tableau.dense.len() {
            dense[i] = Row::new(tableau.dense[i], a);
            i += 1;
        }

        Self {
            rows,
            length: a.len(),
            error_needs_end: error.uses(stages) || coarse_error.uses(stages),
            error,
            coarse_error,
            dense,
            dense_length: tableau.dense.len(),
        }
    }
}

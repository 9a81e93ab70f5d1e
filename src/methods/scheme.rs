//! Adapts a tableau to second-order systems.
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

use super::digits::{Beyond, Pair};
use super::{MAX_STAGES, Tableau};

/// The largest number of rows of dense output beyond its cubic.
pub(super) const MAX_DENSE: usize = 5;

/// A weighted sum of stages, for velocities and for positions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Row {
    terms: [Term; MAX_STAGES],
    length: usize,
    /// The remainders after the `f64` weights of each term, as far as they are known. They are stored separately, since `f64`
    /// does not use them.
    beyond: [Beyonds; MAX_STAGES],
}

/// The remainders after the `f64` weights of a [`Term`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Beyonds {
    /// That of the weight in the velocity.
    pub velocity: f64,
    /// That of the weight in the position.
    pub position: f64,
}

/// The contribution of one stage.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Term {
    /// The index of the stage.
    pub stage: usize,
    /// Its weight in the velocity, times `h`.
    pub velocity: f64,
    /// Its weight in the position, times `h²`.
    pub position: f64,
}

/// The rows of a method without zeros.
#[derive(Debug)]
pub(crate) struct Scheme {
    /// The stages, the new point (row `stages`) and the stages of dense output.
    pub rows: [Row; MAX_STAGES],
    /// The number of rows.
    pub length: usize,
    /// The error estimate.
    pub error: Row,
    /// The coarser estimate; empty in methods that have none.
    pub coarse_error: Row,
    /// Whether an estimate needs the acceleration at the new point.
    pub error_needs_end: bool,
    /// Coefficients of dense output beyond the cubic.
    pub dense: [Row; MAX_DENSE],
    /// The number of these.
    pub dense_length: usize,
    /// The remainders after the `f64` nodes.
    pub c_beyond: [f64; MAX_STAGES],
    /// Whether the remainders after the `f64` nodes and weights are known, so that a step keeps its order in numbers
    /// with more digits.
    pub is_wide: bool,
}

impl Row {
    const EMPTY: Self = Self {
        terms: [Term {
            stage: 0,
            velocity: 0.0,
            position: 0.0,
        }; MAX_STAGES],
        length: 0,
        beyond: [Beyonds {
            velocity: 0.0,
            position: 0.0,
        }; MAX_STAGES],
    };

    /// The nonzero terms.
    #[inline(always)]
    pub fn terms(&self) -> &[Term] {
        &self.terms[..self.length]
    }

    /// The nonzero terms, each with the remainders after its weights.
    #[inline(always)]
    pub fn wide_terms(&self) -> impl Iterator<Item = (&Term, &Beyonds)> {
        self.terms().iter().zip(&self.beyond)
    }

    /// [`new`](Self::new) with the remainders after the `f64` coefficients.
    const fn wide(
        [weights, more]: [&[f64]; 2],
        [a, a_more]: [&'static [&'static [f64]]; 2],
    ) -> Self {
        let mut row = Self::new(weights, a);
        let mut term = 0;
        while term < row.length {
            let Term {
                stage, position, ..
            } = row.terms[term];
            let mut sum = Pair(0.0, 0.0);
            let mut i = 0;
            while i < weights.len() {
                if stage < a[i].len() {
                    let factors = [
                        Pair(weights[i], more[i]),
                        Pair(a[i][stage], a_more[i][stage]),
                    ];
                    sum = sum.plus(factors[0].times(factors[1]));
                }
                i += 1;
            }
            row.beyond[term] = Beyonds {
                velocity: if stage < more.len() { more[stage] } else { 0.0 },
                // A weight that represents 0 is 0 in all digits.
                position: if position == 0.0 {
                    0.0
                } else {
                    sum.beyond(position)
                },
            };
            term += 1;
        }
        row
    }

    /// `weights` for velocities, `weights · A` for positions.
    const fn new(weights: &[f64], a: &[&[f64]]) -> Self {
        let mut row = Self::EMPTY;
        let mut j = 0;
        while j < weights.len() {
            let (mut sum, mut size) = (0.0, 0.0);
            let mut i = 0;
            while i < weights.len() {
                // A row may omit zeros at its end.
                if j < a[i].len() {
                    let product = weights[i] * a[i][j];
                    sum += product;
                    size += product.abs();
                }
                i += 1;
            }
            // A sum of at most 16 rounded products that is no larger than their round-off represents 0.
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

    /// Whether a stage contributes to it.
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
    /// `beyond` holds the remainders after the coefficients of the tableau, if they are known.
    pub const fn new(tableau: &Tableau, beyond: Option<Beyond>) -> Self {
        let (a, stages) = (tableau.a, tableau.stages);
        assert!(a.len() <= MAX_STAGES && tableau.c.len() == a.len() && stages < a.len());
        assert!(tableau.dense.len() <= MAX_DENSE);

        let mut rows = [Row::EMPTY; MAX_STAGES];
        let mut c_beyond = [0.0; MAX_STAGES];
        let mut i = 0;
        while i < a.len() {
            rows[i] = match beyond {
                Some(beyond) => {
                    c_beyond[i] = beyond.c[i];
                    Row::wide([a[i], beyond.a[i]], [a, beyond.a])
                }
                None => Row::new(a[i], a),
            };
            i += 1;
        }
        let error = match beyond {
            Some(beyond) => Row::wide([tableau.error, beyond.error], [a, beyond.a]),
            None => Row::new(tableau.error, a),
        };
        let coarse_error = match (tableau.coarse_error, beyond) {
            (Some(weights), Some(beyond)) => {
                Row::wide([weights, beyond.coarse_error], [a, beyond.a])
            }
            (Some(weights), None) => Row::new(weights, a),
            (None, _) => Row::EMPTY,
        };
        let mut dense = [Row::EMPTY; MAX_DENSE];
        let mut i = 0;
        while i < tableau.dense.len() {
            dense[i] = match beyond {
                Some(beyond) => Row::wide([tableau.dense[i], beyond.dense[i]], [a, beyond.a]),
                None => Row::new(tableau.dense[i], a),
            };
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
            c_beyond,
            is_wide: beyond.is_some(),
        }
    }
}

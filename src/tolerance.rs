//! Tolerances of a run.

/// Safety factor in the choice of the next step.
pub(crate) const SAFETY: f64 = 0.9;

/// Smaller relative tolerances require more digits than `f64` has.
pub const LEAST_RELATIVE_TOLERANCE: f64 = 10.0 * f64::EPSILON;

/// The tolerance of a run: the error of each step in a number `y` is kept below
/// `absolute + relative · |y|`, in the mean over all coordinates and rates.
#[derive(Clone, Debug)]
pub struct Tolerance<V> {
    /// Relative to the size of each number.
    pub relative: f64,
    /// For each coordinate, in its unit; its rate has the same, per second.
    pub absolute: V,
}

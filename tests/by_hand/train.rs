//! Balls on a line, of which any two may meet, and how often each pair is asked for its gap.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use lagrangian::{
    Compliance, ContactQuantity, ImpactLaw, ImpactOrder, Machine, Painleve, Quantity, Singular,
    State, System, UnilateralContact,
};

/// The number of balls.
pub const BALLS: usize = 12;

/// Of each two balls.
pub const PAIRS: usize = BALLS * (BALLS - 1) / 2;

const DIAMETER: f64 = 0.2;

/// Equal balls of 1 kg, 1 m apart, of which the first moves at 1 m/s. They bounce without loss, or each two have a layer between them.
#[derive(Clone, Debug, Default)]
pub struct Train {
    /// Whether pairs can be evaluated one by one.
    pub is_single: bool,
    /// The stiffness of the layers in loading and in unloading, if there are any.
    pub layers: Option<[f64; 2]>,
    pub asked: Arc<Asked>,
}

/// How often gaps were evaluated: all together, each pair by itself, and bounds of all.
#[derive(Debug, Default)]
pub struct Asked {
    pub together: AtomicUsize,
    pub each: [[AtomicUsize; BALLS]; BALLS],
    pub bounds: AtomicUsize,
}

/// The two balls of each pair.
fn pairs() -> impl Iterator<Item = (usize, usize)> {
    (0..BALLS).flat_map(|i| (i + 1..BALLS).map(move |j| (i, j)))
}

impl Machine for Train {
    type System = Self;

    fn name(&self) -> &str {
        "Train"
    }

    fn parameters(&self) -> impl ExactSizeIterator<Item = (Quantity<'_>, f64)> {
        std::iter::empty()
    }

    fn prepare(&self) -> Self {
        self.clone()
    }

    fn start(&self) -> State<[f64; BALLS]> {
        State {
            t: 0.0,
            q: std::array::from_fn(|i| i as f64),
            v: std::array::from_fn(|i| if i == 0 { 1.0 } else { 0.0 }),
        }
    }
}

impl System for Train {
    type Vector = [f64; BALLS];
    type Matrix = [f64; BALLS * BALLS];
    type Coordinates = [f64; BALLS];
    type Inputs = ();
    type Outputs = ();
    const MAY_BE_CONSTRAINED: bool = false;
    const MAY_SLIDE: bool = false;

    fn coordinates(&self) -> impl ExactSizeIterator<Item = Quantity<'_>> {
        [Quantity {
            name: "x",
            unit: "m",
        }; BALLS]
            .into_iter()
    }

    fn to_coordinates(&self, vector: &Self::Vector) -> Self::Vector {
        *vector
    }

    fn to_vector(&self, coordinates: &Self::Vector) -> Self::Vector {
        *coordinates
    }

    fn accelerations(
        &self,
        _: f64,
        _: &Self::Vector,
        _: &Self::Vector,
        (): &(),
        a: &mut Self::Vector,
    ) -> Result<(), Singular> {
        a.fill(0.0);
        Ok(())
    }

    fn mass_matrix(&self, _: f64, _: &Self::Vector, matrix: &mut Self::Matrix) {
        matrix.fill(0.0);
        matrix.iter_mut().step_by(BALLS + 1).for_each(|m| *m = 1.0);
    }

    fn bias(&self, _: f64, _: &Self::Vector, _: &Self::Vector, bias: &mut Self::Vector) {
        bias.fill(0.0);
    }

    fn applied(&self, _: f64, _: &Self::Vector, _: &Self::Vector, (): &(), to: &mut Self::Vector) {
        to.fill(0.0);
    }

    fn forces(&self, _: f64, _: &Self::Vector, _: &Self::Vector, (): &(), to: &mut Self::Vector) {
        to.fill(0.0);
    }

    fn kinetic_energy(&self, _: f64, _: &Self::Vector, v: &Self::Vector) -> f64 {
        0.5 * v.iter().map(|v| v * v).sum::<f64>()
    }

    fn potential_energy(&self, _: f64, _: &Self::Vector, (): &()) -> f64 {
        0.0
    }

    fn dissipation(&self, _: f64, _: &Self::Vector, _: &Self::Vector, (): &()) -> f64 {
        0.0
    }

    fn work_rate(
        &self,
        _: f64,
        _: &Self::Vector,
        _: &Self::Vector,
        _: &Self::Vector,
        (): &(),
    ) -> f64 {
        0.0
    }

    fn dissipation_rate(&self, _: f64, _: &Self::Vector, _: &Self::Vector, (): &()) -> f64 {
        0.0
    }

    fn default_inputs(&self) {}

    fn input_values(&self, (): &()) -> impl ExactSizeIterator<Item = (Quantity<'_>, f64)> {
        std::iter::empty()
    }

    fn outputs(&self, _: f64, _: &Self::Vector, _: &Self::Vector, _: &Self::Vector, (): &()) {}

    fn output_values(&self, (): &()) -> impl ExactSizeIterator<Item = (Quantity<'_>, f64)> {
        std::iter::empty()
    }

    fn unilateral_contacts(&self) -> impl ExactSizeIterator<Item = UnilateralContact<'_>> {
        let contact = UnilateralContact {
            name: "pair",
            law: ImpactLaw::Newton,
            order: ImpactOrder::AtOnce,
            painleve: Painleve::Error,
            compliance: self.layers.map(|_| Compliance::Layer),
            has_friction: false,
            is_rolling_resistance: false,
            is_second_tangent: false,
            has_face: false,
        };
        [contact; PAIRS].into_iter()
    }

    fn gaps(&self, _: f64, q: &Self::Vector, gaps: &mut [f64]) {
        self.asked.together.fetch_add(1, Ordering::Relaxed);
        for (gap, (i, j)) in gaps.iter_mut().zip(pairs()) {
            *gap = q[j] - q[i] - DIAMETER;
        }
    }

    fn contact_rates(&self, _: f64, _: &Self::Vector, v: &Self::Vector, rates: &mut [f64]) {
        for (rates, (i, j)) in rates.chunks_exact_mut(2).zip(pairs()) {
            rates.copy_from_slice(&[v[j] - v[i], 0.0]);
        }
    }

    fn contact_matrix(&self, _: f64, _: &Self::Vector, matrix: &mut [f64]) {
        matrix.fill(0.0);
        for (rows, (i, j)) in matrix.chunks_exact_mut(2 * BALLS).zip(pairs()) {
            (rows[i], rows[j]) = (-1.0, 1.0);
        }
    }

    fn contact_bias(&self, _: f64, _: &Self::Vector, _: &Self::Vector, bias: &mut [f64]) {
        bias.fill(0.0);
    }

    fn contact_coefficients(&self, _: f64, _: &Self::Vector, _: &Self::Vector, to: &mut [f64]) {
        for own in to.chunks_exact_mut(4) {
            let [first, second] = self.layers.unwrap_or([1.0, 0.0]);
            own.copy_from_slice(&[first, second, 0.0, 0.0]);
        }
    }

    fn single_contacts(&self) -> Option<&[bool]> {
        const ARGUMENTS: &[bool; BALLS + 1] = &{
            let mut all = [true; BALLS + 1];
            all[BALLS] = false;
            all
        };
        self.is_single.then_some(ARGUMENTS)
    }

    fn of_contacts(
        &self,
        quantity: ContactQuantity,
        which: &[usize],
        (_, q, v): (f64, &Self::Vector, &Self::Vector),
        numbers: &mut [f64],
    ) {
        let width = numbers.len() / which.len().max(1);
        for (numbers, k) in numbers.chunks_exact_mut(width.max(1)).zip(which) {
            let (i, j) = pairs().nth(*k).expect("a pair");
            numbers.fill(0.0);
            match quantity {
                ContactQuantity::Gap => {
                    self.asked.each[i][j].fetch_add(1, Ordering::Relaxed);
                    numbers[0] = q[j] - q[i] - DIAMETER;
                }
                ContactQuantity::Rates => numbers[0] = v[j] - v[i],
                ContactQuantity::Rows => (numbers[i], numbers[j]) = (-1.0, 1.0),
                ContactQuantity::Coefficients => {
                    numbers[..2].copy_from_slice(&self.layers.unwrap_or([1.0, 0.0]));
                }
                _ => {}
            }
        }
    }

    fn least_gaps(&self, _: [f64; 2], [low, high]: [&Self::Vector; 2], least: &mut [f64]) {
        self.asked.bounds.fetch_add(1, Ordering::Relaxed);
        for (least, (i, j)) in least.iter_mut().zip(pairs()) {
            *least = (low[j] - high[i]).next_down() - DIAMETER;
        }
    }
}

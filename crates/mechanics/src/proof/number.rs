//! The numbers in which a program is compared with Lagrange's equations.

use lagrangian_scalar::{Ball, Residue, Scalar};
use lagrangian_symbolic::{Expr, nearest};

use crate::equations::literal::{Lagrange, State};
use crate::states::of_length_one;
use lagrangian_program::rounding::SplitMix;

/// The result of testing a number that ought to be 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ZeroTest {
    Zero,
    NotZero,
    /// Round-off hides it.
    Undecided,
}

/// A number in which values can be compared.
pub(crate) trait Number: Scalar<Stored = Self> {
    /// Whether numbers have signs. A field has two roots of every square, and cannot say which of
    /// them is meant.
    const IS_ORDERED: bool;

    /// A random number, the same for the same `seed` and `index`.
    fn random(seed: u64, index: u64) -> Self;

    /// Whether it is 0, given the size of the numbers that it was computed from.
    fn test_zero(self, size: f64) -> ZeroTest;

    /// Whether it is positive, or the analogue of that in a field.
    fn is_positive(self) -> bool;

    /// State number `number` of a machine.
    fn state(number: u64, machine: &Lagrange<'_, '_>) -> State<Self>;

    /// Its magnitude.
    fn size(self) -> f64 {
        self.to_f64().abs()
    }
}

impl Number for Residue {
    const IS_ORDERED: bool = false;

    fn random(seed: u64, index: u64) -> Residue {
        Residue::random(seed, index)
    }

    fn test_zero(self, _: f64) -> ZeroTest {
        if self == Residue::ZERO {
            ZeroTest::Zero
        } else {
            ZeroTest::NotZero
        }
    }

    /// In a field, being a square takes the place of being positive.
    fn is_positive(self) -> bool {
        self.sqrt().is_finite()
    }

    fn state(number: u64, machine: &Lagrange<'_, '_>) -> State<Residue> {
        let model = machine.model;
        let mut index = 0;
        let mut many = |len: usize| -> Vec<Residue> {
            let next = |_| {
                index += 1;
                Residue::random(number, index)
            };
            (0..len).map(next).collect()
        };
        let n = model.coordinates.len();
        State {
            parameters: many(model.parameters.len()),
            t: many(1)[0],
            q: many(n),
            v: many(n),
            u: many(model.inputs.len()),
            a: many(n),
        }
    }
}

impl Number for Ball {
    const IS_ORDERED: bool = true;

    fn random(seed: u64, index: u64) -> Ball {
        let mut random = SplitMix(seed.wrapping_mul(0x9e37_79b9) ^ index);
        Ball::from_f64(random.uniform(-1.0, 1.0))
    }

    /// Different numbers are detected whatever their radii are. Equal ones are accepted up to
    /// round-off, if that is far below the effect of a wrong sign or factor.
    fn test_zero(self, size: f64) -> ZeroTest {
        const SHARE: f64 = 1.0 / (1u64 << 40) as f64;
        if !self.is_finite() {
            return ZeroTest::Undecided;
        }
        if !self.contains(0.0) {
            return ZeroTest::NotZero;
        }
        if self.radius() <= SHARE * size.max(SHARE) {
            ZeroTest::Zero
        } else {
            ZeroTest::Undecided
        }
    }

    fn is_positive(self) -> bool {
        self.exceeds(Ball::ZERO)
    }

    /// A random state about the start. Angles and other pure numbers vary by a full turn, lengths by half of themselves plus 2 cm, first-order states by
    /// half of themselves plus one half, and all less and less from try to try. Parameters are up to a hundredth or a twentieth off their defaults, so
    /// that none is 0; one without a default is between ½ and 2.
    fn state(number: u64, machine: &Lagrange<'_, '_>) -> State<Ball> {
        let model = machine.model;
        let mut random = SplitMix(number.wrapping_add(1).wrapping_mul(0x5851_f42d_4c95_7f2d));
        let share = if number.is_multiple_of(2) { 0.01 } else { 0.05 };
        let mut known = |default: Option<Expr<'_>>| match default.map(nearest) {
            Some(0.0) => random.uniform(-share, share),
            Some(default) => default * (1.0 + random.uniform(-share, share)),
            None => random.uniform(0.5, 2.0),
        };
        let parameters: Vec<f64> = model.parameters.iter().map(|p| known(p.default)).collect();
        let u: Vec<f64> = model.inputs.iter().map(|i| nearest(i.default)).collect();
        let u = u.iter().map(|u| u + random.uniform(-1.0, 1.0)).collect();
        let n = model.coordinates.len();
        let nothing = State {
            t: 0.0,
            q: vec![0.0; n],
            v: vec![0.0; n],
            a: vec![0.0; n],
            u,
            parameters,
        };
        let starts = model.coordinates.iter().map(|c| c.start);
        let starts: Vec<Expr<'_>> = starts
            .chain(model.coordinates.iter().map(|c| c.start_rate))
            .collect();
        let starts = machine.values(&starts, &nothing);
        let width = 0.5f64.powi((number / 6) as i32);
        let places = model.coordinates.iter().zip(&starts);
        let q = places.map(|(coordinate, &start)| {
            let half = if coordinate.unit.is_one() {
                3.2
            } else {
                0.02 + 0.5 * start.abs()
            };
            start + width * random.uniform(-half, half)
        });
        let mut q: Vec<f64> = q.collect();
        for four in &model.quaternions {
            of_length_one(&mut q, four.coordinates(model));
        }
        let mut rates = || -> Vec<Ball> {
            let one = |_| Ball::from_f64(random.uniform(-2.0, 2.0));
            (0..n).map(one).collect()
        };
        let (mut v, a) = (rates(), rates());
        for (i, v) in v.iter_mut().enumerate() {
            let start = starts[n + i];
            if model.coordinates[i].rate.is_some() {
                let half = width * (0.5 + 0.5 * start.abs());
                *v = Ball::from_f64(start + random.uniform(-half, half));
            }
        }
        let exact = |list: Vec<f64>| list.into_iter().map(Ball::from_f64).collect();
        State {
            t: Ball::from_f64(random.uniform(0.0, 10.0)),
            q: exact(q),
            v,
            a,
            u: exact(nothing.u),
            parameters: exact(nothing.parameters),
        }
    }
}

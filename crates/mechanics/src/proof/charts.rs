//! Proves that a machine in Cartesian coordinates is the same machine as in the polar ones of its spec.
//!
//! Each of the two programs is proved against Lagrange's equations of its own model. That both models are of one machine is proved here,
//! by comparison of the programs at random states in numbers with error bounds ([`Ball`]). A state `q, v, a` in polar coordinates is
//! mapped to Cartesian ones, `x = s cos φ`, `y = s sin φ` with their first and second derivatives by time, which are typed by hand and
//! share nothing with the rewriting of the model. Then
//!
//! * the residuals `M a − f` of the equations of motion are those of the other chart times the matrix of the map, for any `a`;
//! * residuals, rates and their derivatives of constraints, guides and unilateral contacts are equal, and so are all energies, powers
//!   and coefficients;
//! * along the motion, powers, outputs, multipliers and reactions of guides are equal;
//! * the start is the image of the start.

use std::fmt;

use super::number::{Number, ZeroTest};
use super::{MOST_STATES, STATES, Sum};
use lagrangian_program::quantity::{Extent, ItemKind, Needs, Sizes, Use};
use lagrangian_program::rounding::SplitMix;
use lagrangian_program::{Arguments, Interpreter, Program, Role, Shape};
use lagrangian_scalar::{Ball, Scalar};
use lagrangian_spec::diagnostic::{Code, Diagnostic};
use lagrangian_spec::model::Model;

/// Why the programs of two charts are not emitted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Uncharted {
    /// A quantity differs.
    Differs {
        /// The quantity.
        role: Role,
        /// The index of its number.
        index: usize,
        /// The number of the state.
        state: u64,
    },
    /// No state was found at which everything has a value in both charts.
    Undefined,
}

impl Uncharted {
    /// The message for the user, at the name of the machine.
    pub fn diagnostic(&self, model: &Model<'_>) -> Diagnostic {
        let diagnostic = |code| Diagnostic::new(code, model.span, self.to_string());
        match self {
            Uncharted::Undefined => diagnostic(Code::Undefined).help(
                "give the coordinates start values near a state at which all that the spec states has a value, or leave `charts` out",
            ),
            Uncharted::Differs { .. } => diagnostic(Code::Internal).help(
                "this is a defect of lagrangian, not of the spec: nothing was emitted; please report it together with the spec",
            ),
        }
    }
}

impl fmt::Display for Uncharted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Uncharted::Undefined => write!(
                f,
                "no state was found at which the machine can be compared in the two charts that `charts` names"
            ),
            Uncharted::Differs { role, index, state } => write!(
                f,
                "the machine in Cartesian coordinates is not that in polar ones: number {index} of `{}` differs (random state {state})",
                role.name()
            ),
        }
    }
}

impl std::error::Error for Uncharted {}

/// Proves that two programs are of one machine: in polar coordinates, and in Cartesian ones in their places. For each point the indices
/// of its distance and its angle are given.
///
/// # Errors
/// The first difference, or that there are too few states with values.
pub fn prove_charts(
    polar: &Program,
    cartesian: &Program,
    points: &[[usize; 2]],
) -> Result<(), Uncharted> {
    let parameters = vec![Ball::ONE; polar.parameters.len()];
    let mut comparison = Comparison {
        sizes: polar.sizes(),
        outputs: polar.outputs.len(),
        assumptions: polar.assumptions.len(),
        points,
        polar: Interpreter::new(polar, &parameters),
        cartesian: Interpreter::new(cartesian, &parameters),
        number: 0,
    };
    let mut good = 0;
    for number in 0..MOST_STATES {
        comparison.number = number;
        let Some(state) = comparison.state(polar) else {
            continue;
        };
        match comparison.compare(&state) {
            Ok(()) => good += 1,
            Err(Trouble::Undefined) => {}
            Err(Trouble::Differs(role, index)) => {
                return Err(Uncharted::Differs {
                    role,
                    index,
                    state: number,
                });
            }
        }
        if good == STATES {
            return Ok(());
        }
    }
    Err(Uncharted::Undefined)
}

/// Why a comparison at a state gave nothing, or what differs.
enum Trouble {
    Undefined,
    Differs(Role, usize),
}

/// A state in one of the charts.
#[derive(Clone)]
struct Here {
    t: Ball,
    q: Vec<Ball>,
    v: Vec<Ball>,
    u: Vec<Ball>,
}

struct Comparison<'a> {
    sizes: Sizes,
    outputs: usize,
    assumptions: usize,
    points: &'a [[usize; 2]],
    polar: Interpreter<Ball>,
    cartesian: Interpreter<Ball>,
    number: u64,
}

impl Comparison<'_> {
    /// A random state about the start, with parameters about their defaults; `None` if the assumptions of the spec do not hold there.
    fn state(&mut self, program: &Program) -> Option<Here> {
        let number = self.number;
        let mut random = SplitMix(number.wrapping_add(1).wrapping_mul(0x5851_f42d_4c95_7f2d));
        let share = 0.02;
        let defaults = program.parameters.iter().map(|slot| &slot.default);
        let parameters = defaults.map(|default| match default {
            Some(default) if default.value != 0.0 => {
                default.value * (1.0 + random.uniform(-share, share))
            }
            Some(_) => random.uniform(-share, share),
            None => random.uniform(0.5, 2.0),
        });
        let parameters: Vec<Ball> = parameters.map(Ball::from_f64).collect();
        self.polar.prepare(&parameters);
        self.cartesian.prepare(&parameters);
        let n = program.dimension();
        let (mut q, mut v) = (vec![Ball::ZERO; n], vec![Ball::ZERO; n]);
        self.polar.start(&mut q, &mut v);
        let width = 0.5f64.powi((number / 6) as i32);
        for (q, slot) in q.iter_mut().zip(&program.coordinates) {
            let start = q.to_f64();
            let half = if slot.unit.is_one() {
                3.2
            } else {
                0.02 + 0.5 * start.abs()
            };
            *q = Ball::from_f64(start + width * random.uniform(-half, half));
        }
        for [s, _] in self.points {
            // The chart of the spec does not contain its centre.
            q[*s] = Ball::from_f64(q[*s].to_f64().abs() + 0.01);
        }
        for v in &mut v {
            *v = Ball::from_f64(v.to_f64() + width * random.uniform(-2.0, 2.0));
        }
        let inputs = program.inputs.iter().map(|slot| &slot.default);
        let u = inputs.map(|default| default.as_ref().map_or(0.0, |default| default.value));
        let u = u.map(|u| Ball::from_f64(u + random.uniform(-1.0, 1.0)));
        let here = Here {
            u: u.collect(),
            t: Ball::from_f64(random.uniform(0.0, 10.0)),
            q,
            v,
        };
        let a = vec![Ball::ZERO; n];
        let holds = |role| {
            let fact = call(&mut self.polar, role, (&here, &a), 1);
            fact.is_ok_and(|fact| fact[0].is_positive())
        };
        (0..self.assumptions)
            .map(Role::Assumption)
            .all(holds)
            .then_some(here)
    }

    /// Compares everything at a state.
    fn compare(&mut self, here: &Here) -> Result<(), Trouble> {
        let n = here.q.len();
        let random = |index: usize| Ball::random(self.number, index as u64 + 1);
        let a: Vec<Ball> = (0..n).map(random).collect();
        let (there, there_a) = self.mapped(here, &a);
        self.compare_equations((here, &a), (&there, &there_a))?;
        for (rows, bias, sign) in [
            (Role::ConstraintMatrix, Role::ConstraintBias, -1.0),
            (Role::SlipMatrix, Role::SlipBias, 1.0),
            (Role::ContactMatrix, Role::ContactBias, 1.0),
        ] {
            self.compare_rates((rows, bias, sign), (here, &a), (&there, &there_a))?;
        }
        // Powers and outputs may contain multipliers, which belong to the accelerations of the motion.
        let moves = self.sizes.contacts == 0;
        let a = if moves {
            call(&mut self.polar, Role::Accelerations, (here, &a), n)?
        } else {
            a
        };
        let (there, there_a) = self.mapped(here, &a);
        let sizes = self.sizes;
        let is_compared = |role: &Role| {
            let row = role.row();
            let of_each = match row.extent {
                Extent::Number => true,
                Extent::Each(kind) => kind != ItemKind::Coordinate,
                _ => false,
            };
            let is_bias = matches!(
                role,
                Role::ConstraintBias | Role::SlipBias | Role::ContactBias
            );
            let is_there = row.needs != Needs::Request && row.needs.are_met(sizes);
            let is_solved = row.called == Use::Solves && !moves;
            of_each && is_there && !is_bias && !is_solved
        };
        let outputs = (0..self.outputs).map(Role::Output);
        for role in Role::all().filter(is_compared).chain(outputs) {
            let len = role.row().extent.shape(sizes).map_or(0, Shape::len);
            let own = call(&mut self.polar, role, (here, &a), len);
            let other = call(&mut self.cartesian, role, (&there, &there_a), len);
            match (own, other) {
                (Ok(own), Ok(other)) => {
                    for (index, (own, other)) in own.into_iter().zip(other).enumerate() {
                        equal(role, index, Sum::of([own, -other]))?;
                    }
                }
                // An output may have a value only where another quantity is positive.
                (Err(_), Err(_)) if matches!(role, Role::Output(_)) => {}
                _ => return Err(Trouble::Undefined),
            }
        }
        if !moves {
            self.compare_reactions((here, &a), (&there, &there_a))?;
        }
        self.compare_start()
    }

    /// A state and accelerations in Cartesian coordinates.
    fn mapped(&self, here: &Here, a: &[Ball]) -> (Here, Vec<Ball>) {
        let (mut there, mut there_a) = (here.clone(), a.to_vec());
        let two = Ball::from_f64(2.0);
        for &[i, j] in self.points {
            let ([s, phi], [ds, dphi]) = ([here.q[i], here.q[j]], [here.v[i], here.v[j]]);
            let (sin, cos) = phi.sin_cos();
            let (radial, across) = (a[i] - s * dphi * dphi, s * a[j] + two * ds * dphi);
            (there.q[i], there.q[j]) = (s * cos, s * sin);
            there.v[i] = ds * cos - s * dphi * sin;
            there.v[j] = ds * sin + s * dphi * cos;
            there_a[i] = radial * cos - across * sin;
            there_a[j] = radial * sin + across * cos;
        }
        (there, there_a)
    }

    /// Compares `M a − f`: what it says of each polar coordinate follows from what it says of the components.
    fn compare_equations(
        &mut self,
        here: (&Here, &[Ball]),
        there: (&Here, &[Ball]),
    ) -> Result<(), Trouble> {
        let own = residuals(&mut self.polar, here)?;
        let other = residuals(&mut self.cartesian, there)?;
        let mut mapped = other.clone();
        for &[i, j] in self.points {
            let (s, (sin, cos)) = (here.0.q[i], here.0.q[j].sin_cos());
            let ([x, y], [x_size, y_size]) = (
                [other[i].value, other[j].value],
                [other[i].size, other[j].size],
            );
            mapped[i] = Sum {
                value: cos * x + sin * y,
                size: x_size + y_size,
            };
            mapped[j] = Sum {
                value: s * (cos * y - sin * x),
                size: s.size() * (x_size + y_size),
            };
        }
        for (index, (own, other)) in own.into_iter().zip(mapped).enumerate() {
            let difference = Sum {
                value: own.value - other.value,
                size: own.size + other.size,
            };
            equal(Role::Forces, index, difference)?;
        }
        Ok(())
    }

    /// Compares the derivatives of rates by time, `W a + b`, of constraints, guides or contacts.
    fn compare_rates(
        &mut self,
        (rows, bias, sign): (Role, Role, f64),
        here: (&Here, &[Ball]),
        there: (&Here, &[Ball]),
    ) -> Result<(), Trouble> {
        if !rows.row().needs.are_met(self.sizes) {
            return Ok(());
        }
        let count = bias.row().extent.shape(self.sizes).map_or(0, Shape::len);
        let n = here.1.len();
        let rates = |interpreter: &mut Interpreter<Ball>, at: (&Here, &[Ball])| {
            let rows = call(interpreter, rows, at, count * n)?;
            let bias = call(interpreter, bias, at, count)?;
            let of = |(row, bias): (&[Ball], Ball)| {
                Sum::products(row, at.1).plus(bias * Ball::from_f64(sign))
            };
            Ok::<Vec<_>, Trouble>(rows.chunks(n).zip(bias).map(of).collect())
        };
        let own = rates(&mut self.polar, here)?;
        let other = rates(&mut self.cartesian, there)?;
        for (index, (own, other)) in own.into_iter().zip(other).enumerate() {
            let difference = Sum {
                value: own.value - other.value,
                size: own.size + other.size,
            };
            equal(bias, index, difference)?;
        }
        Ok(())
    }

    /// Compares what friction at guides does: multipliers, slip rates, normal reactions and coefficients are the same in both charts, and
    /// accelerations belong to each.
    fn compare_reactions(
        &mut self,
        here: (&Here, &[Ball]),
        there: (&Here, &[Ball]),
    ) -> Result<(), Trouble> {
        let layout = self.sizes.friction_layout();
        let own = call(&mut self.polar, Role::Friction, here, layout.len())?;
        let other = call(&mut self.cartesian, Role::Friction, there, layout.len())?;
        let parts = (1 + self.sizes.contacts) * layout.part();
        for (index, (own, other)) in own.into_iter().zip(other).enumerate() {
            let is_acceleration = index < parts && index % layout.part() < self.sizes.coordinates;
            if !is_acceleration {
                equal(Role::Friction, index, Sum::of([own, -other]))?;
            }
        }
        Ok(())
    }

    /// Compares the starts.
    fn compare_start(&mut self) -> Result<(), Trouble> {
        let n = self.sizes.coordinates;
        let zeros = || vec![Ball::ZERO; n];
        let mut here = Here {
            t: Ball::ZERO,
            q: zeros(),
            v: zeros(),
            u: Vec::new(),
        };
        self.polar.start(&mut here.q, &mut here.v);
        let (expected, _) = self.mapped(&here, &zeros());
        let (mut q, mut v) = (zeros(), zeros());
        self.cartesian.start(&mut q, &mut v);
        let expected = expected.q.into_iter().chain(expected.v);
        for (index, (found, expected)) in q.into_iter().chain(v).zip(expected).enumerate() {
            equal(Role::Start, index, Sum::of([found, -expected]))?;
        }
        Ok(())
    }
}

/// The results of a function.
fn call(
    interpreter: &mut Interpreter<Ball>,
    role: Role,
    (at, a): (&Here, &[Ball]),
    len: usize,
) -> Result<Vec<Ball>, Trouble> {
    let arguments = Arguments {
        t: at.t,
        q: &at.q,
        v: &at.v,
        u: &at.u,
        a,
    };
    let mut results = vec![Ball::ZERO; len];
    match interpreter.call(role, arguments, &mut results) {
        Ok(()) if results.iter().all(|x| x.is_finite()) => Ok(results),
        _ => Err(Trouble::Undefined),
    }
}

/// `M a − f`, row by row.
fn residuals(
    interpreter: &mut Interpreter<Ball>,
    at: (&Here, &[Ball]),
) -> Result<Vec<Sum<Ball>>, Trouble> {
    let n = at.1.len();
    let mass = call(interpreter, Role::MassMatrix, at, Shape::Symmetric(n).len())?;
    let forces = call(interpreter, Role::Forces, at, n)?;
    let row = |(i, force): (usize, Ball)| {
        let row: Vec<Ball> = super::row(&mass, n, i).collect();
        Sum::products(&row, at.1).plus(-force)
    };
    Ok(forces.into_iter().enumerate().map(row).collect())
}

/// Checks that a difference is 0.
fn equal(role: Role, index: usize, difference: Sum<Ball>) -> Result<(), Trouble> {
    match difference.value.test_zero(difference.size) {
        ZeroTest::Zero => Ok(()),
        ZeroTest::NotZero => Err(Trouble::Differs(role, index)),
        ZeroTest::Undecided => Err(Trouble::Undefined),
    }
}

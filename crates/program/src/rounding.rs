//! Estimates the rounding errors of the results of a program, to choose between programs.
//!
//! A program is run at a few states of its machine, and every operation x that rounds is assumed to
//! have an independent error, uniformly distributed between half a unit in the last place below and
//! above. For 2ᵉ ≤ |x| < 2ᵉ⁺¹ its variance is (2ᵉu)²/3 with u = 2⁻⁵³; and since the leading digits
//! of results of arithmetic are distributed as if log |x| were uniform (R. W. Hamming, *On the
//! distribution of numbers*, Bell Syst. Tech. J. 49 (1970) 1609–1625), 2²ᵉ is x²·3/(8 ln 2) in the
//! mean. To first order the errors of the results are the sums of these errors, each times the
//! derivative of the result with respect to the operation; as the errors are independent, their
//! squares add up:
//!
//! ```text
//! E ‖Δr‖² = Σₖ ‖∂r/∂xₖ‖² (xₖu)²/(8 ln 2)
//! ```
//!
//! This is the linear rounding error analysis of F. L. Bauer, *Computational graphs and rounding
//! error*, SIAM J. Numer. Anal. 11 (1974) 87–96, with the sum of squares instead of the sum of
//! absolute values in a bound: independent errors grow like the square root of their number (N. J.
//! Higham and T. Mary, *A new approach to probabilistic rounding error analysis*, SIAM J. Sci.
//! Comput. 41 (2019) A2815–A2835), and two programs are distinguished by their typical error, not by
//! the worst one.
//!
//! All derivatives of one number come from a single reverse sweep. For many results, that number
//! is Σ wᵢ rᵢ with random signs wᵢ = ±1: (Σᵢ wᵢ ∂rᵢ/∂xₖ)² has the expectation ‖∂r/∂xₖ‖² (M. F.
//! Hutchinson, *A stochastic estimator of the trace of the influence matrix*, Commun. Stat.
//! Simul. Comput. 19 (1990) 433–450). Four simultaneous sweeps with orthogonal signs give the
//! mean of four, which is the expectation itself for up to four results. A state costs as much as
//! a few evaluations.
//!
//! The states come from a generator of their own, and all arithmetic is that of `f64` and `libm`,
//! so the estimate is the same on every computer. Products that are [contracted](super::fused())
//! are not rounded, as on a processor with a fused multiply-add.

use std::fmt;

use lagrangian_scalar::{DoubleDouble, Dual, Scalar};
use lagrangian_symbolic::sorting::sort_by;

use rustc_hash::FxHashMap;

use super::interpret::{binary, unary};
use super::{Arguments, Contractions, Function, Op, Source, Value};

/// The rounding error of the results of a function, relative to them: ‖Δr‖/‖r‖ in the Euclidean
/// norm, at the median of some states of the machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Rounding {
    /// In thousandths of 2⁻⁵³, the largest relative error of one rounding.
    thousandths: u64,
}

impl Rounding {
    /// An error in units of 2⁻⁵³.
    pub fn of_units(units: f64) -> Rounding {
        // The cast saturates, and maps NaN to 0.
        let thousandths = (1000.0 * units) as u64;
        Rounding { thousandths }
    }

    /// In units of 2⁻⁵³.
    pub fn units(self) -> f64 {
        self.thousandths as f64 / 1000.0
    }

    /// Whether it is at most `factor` times another.
    pub fn is_within(self, factor: u64, of: Rounding) -> bool {
        self.thousandths <= of.thousandths.saturating_mul(factor)
    }
}

/// `1.9`: in units of 2⁻⁵³.
impl fmt::Display for Rounding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:.1}", self.units())
    }
}

/// The variance of the rounding error of a number, over its square, in units of 2⁻¹⁰⁶: 1/(8 ln 2).
const VARIANCE: f64 = std::f64::consts::LOG2_E / 8.0;

/// The number of states that are examined.
pub const STATES: usize = 31;

/// The number of weighted sums of the results that are differentiated at once; a power of 2.
const SWEEPS: usize = 4;

/// Parameters of a machine and states that it may be in.
pub struct States {
    /// The parameters, in their order.
    pub parameters: Vec<f64>,
    /// The states, [`STATES`] of them if that many satisfy the assumptions of the machine.
    pub states: Vec<State>,
}

/// The arguments of a call, each list in the order of the program.
#[derive(Clone, Debug, PartialEq)]
pub struct State<N = f64> {
    /// The time, in s.
    pub t: N,
    /// Coordinates.
    pub q: Vec<N>,
    /// Their rates.
    pub v: Vec<N>,
    /// Inputs.
    pub u: Vec<N>,
    /// Accelerations.
    pub a: Vec<N>,
}

impl States {
    /// The rounding errors of the results of each function; nothing if too few states are regular.
    ///
    /// The prepared value k that a function reads is the result of `prepare` whose index is the
    /// k-th in the list that comes with the function.
    pub fn roundings(
        &self,
        prepare: &Function,
        functions: &[(&Function, Vec<usize>)],
    ) -> Option<Vec<Rounding>> {
        let prepare = Linear::new(prepare);
        let functions = functions.iter();
        let functions: Vec<(Linear<'_>, &[usize])> = functions
            .map(|(function, places)| (Linear::new(function), places.as_slice()))
            .collect();
        let no_state = State {
            t: 0.0,
            q: Vec::new(),
            v: Vec::new(),
            u: Vec::new(),
            a: Vec::new(),
        };
        let mut before = ErrorPropagation::default();
        prepare.run(&mut before, |source| match source {
            Source::Parameter(index) => self.parameters[index as usize],
            _ => no_state.read(source),
        });
        let prepared = prepare.function.results.iter();
        let prepared: Vec<f64> = prepared.map(|value| before.values[value.index()]).collect();
        let mut run = ErrorPropagation::default();
        let mut errors: Vec<Vec<f64>> =
            vec![Vec::with_capacity(self.states.len()); functions.len()];
        for (state, seed) in self.states.iter().zip(1..) {
            let all: Option<Vec<f64>> = functions
                .iter()
                .map(|(function, places)| {
                    let random = &mut SplitMix(seed);
                    function.run(&mut run, |source| match source {
                        Source::Prepared(index) => prepared[places[index as usize]],
                        _ => state.read(source),
                    });
                    function.error(&mut run, (&prepare, &mut before, places), random)
                })
                .collect();
            // A state counts for all of them or for none, since they are to be compared.
            for (errors, error) in errors.iter_mut().zip(all.into_iter().flatten()) {
                errors.push(error);
            }
        }
        let known = errors.first().map_or(0, Vec::len);
        if 2 * known < STATES {
            return None;
        }
        let median = |mut errors: Vec<f64>| {
            sort_by(&mut errors, f64::total_cmp);
            Rounding::of_units(errors[errors.len() / 2])
        };
        Some(errors.into_iter().map(median).collect())
    }
}

impl<N: Copy> State<N> {
    /// As the arguments of an interpreter.
    pub fn arguments(&self) -> Arguments<'_, N> {
        Arguments {
            t: self.t,
            q: &self.q,
            v: &self.v,
            u: &self.u,
            a: &self.a,
        }
    }
}

impl State {
    /// The state with its numbers converted, list by list.
    pub fn mapped<N: Copy>(&self, mut map: impl FnMut(&[f64]) -> Vec<N>) -> State<N> {
        State {
            t: map(&[self.t])[0],
            q: map(&self.q),
            v: map(&self.v),
            u: map(&self.u),
            a: map(&self.a),
        }
    }

    /// The value of an argument; NaN if it is not part of a state.
    pub fn read(&self, source: Source) -> f64 {
        let (list, index) = match source {
            Source::Time => return self.t,
            Source::Coordinate(index) => (&self.q, index),
            Source::Velocity(index) => (&self.v, index),
            Source::Input(index) => (&self.u, index),
            Source::Acceleration(index) => (&self.a, index),
            // The caller supplies these, or only stages read them, never the whole function.
            Source::Parameter(_)
            | Source::Prepared(_)
            | Source::AtTime(_)
            | Source::AtPosition(_) => return f64::NAN,
        };
        list.get(index as usize).copied().unwrap_or(f64::NAN)
    }
}

/// A function prepared for differentiation.
struct Linear<'f> {
    function: &'f Function,
    /// Whether the result of each operation generally has more than 53 bits.
    rounds: Vec<bool>,
    /// The results, each once: the index of the operation, and how often it is a result.
    results: Vec<(usize, f64)>,
    /// The products and sums whose errors the function computes: their indices, and those of the errors.
    corrected: Vec<(usize, usize)>,
}

/// The values of a function's operations, and the propagation of errors in them.
#[derive(Default)]
struct ErrorPropagation {
    values: Vec<f64>,
    /// The derivatives of each operation with respect to its operands.
    slopes: Vec<[f64; 2]>,
    /// The derivatives of the weighted sums of results with respect to each operation.
    adjoints: Vec<[f64; SWEEPS]>,
}

impl<'f> Linear<'f> {
    fn new(function: &'f Function) -> Linear<'f> {
        let code = &function.code;
        let is_error = |op: &Op| matches!(op, Op::ProductError(..) | Op::SumError(..));
        let mut corrected = Vec::new();
        if code.iter().any(is_error) {
            let index_of: FxHashMap<&Op, usize> = code.iter().zip(0..).collect();
            for (index, op) in code.iter().enumerate() {
                let of = match *op {
                    Op::ProductError(a, b) => index_of.get(&Op::Mul(a, b)),
                    Op::SumError(a, b) => match *function.op(b) {
                        Op::Neg(b) => index_of.get(&Op::Sub(a, b)),
                        _ => index_of.get(&Op::Add(a, b)),
                    },
                    _ => None,
                };
                corrected.extend(of.map(|of| (*of, index)));
            }
        }
        let contractions = Contractions::of(function);
        let rounds = (0..)
            .zip(code)
            .map(|(index, op)| !contractions.is_part(Value(index)) && rounds(function, op));
        let mut sorted: Vec<usize> = function.results.iter().map(|value| value.index()).collect();
        sorted.sort_unstable();
        let equal = sorted.chunk_by(|a, b| a == b);
        Linear {
            function,
            results: equal.map(|equal| (equal[0], equal.len() as f64)).collect(),
            rounds: rounds.collect(),
            corrected,
        }
    }

    /// Values and slopes of all operations.
    fn run(&self, run: &mut ErrorPropagation, read: impl Fn(Source) -> f64) {
        let ErrorPropagation { values, slopes, .. } = run;
        values.clear();
        slopes.clear();
        for op in &self.function.code {
            let at = |value: Value| values[value.index()];
            let (value, slope) = match *op {
                Op::Constant(ref value) => (value.evaluate(), [0.0; 2]),
                Op::Pi => (f64::pi(), [0.0; 2]),
                Op::Read(source) => (read(source), [0.0; 2]),
                Op::Add(a, b) => (at(a) + at(b), [1.0, 1.0]),
                Op::Sub(a, b) => (at(a) - at(b), [1.0, -1.0]),
                Op::Mul(a, b) => (at(a) * at(b), [at(b), at(a)]),
                Op::Div(a, b) => {
                    let quotient = at(a) / at(b);
                    (quotient, [1.0 / at(b), -quotient / at(b)])
                }
                Op::Neg(a) => (-at(a), [-1.0, 0.0]),
                // 0 in exact arithmetic, whatever the operands are.
                Op::ProductError(a, b) => (at(a).product_error(at(b)), [0.0; 2]),
                Op::SumError(a, b) => (at(a).sum_error(at(b)), [0.0; 2]),
                Op::Sin(a) => {
                    let (sin, cos) = at(a).sin_cos();
                    (sin, [cos, 0.0])
                }
                Op::Cos(a) => {
                    let (sin, cos) = at(a).sin_cos();
                    (cos, [-sin, 0.0])
                }
                Op::Unary(call, a) => {
                    let dual = unary(call, Dual::variable(at(a)));
                    (dual.value, [dual.derivative, 0.0])
                }
                Op::Binary(call, a, b) => {
                    let (x, y) = (at(a), at(b));
                    let by_first = binary(call, Dual::variable(x), Dual::constant(y));
                    let by_second = binary(call, Dual::constant(x), Dual::variable(y));
                    let slope = [by_first.derivative, by_second.derivative];
                    (by_first.value, slope)
                }
            };
            values.push(value);
            slopes.push(slope);
        }
    }

    /// The error of the results relative to them, in units of 2⁻⁵³; nothing if they have no value,
    /// or are all 0.
    ///
    /// `prepare` and the function must have been run.
    fn error(
        &self,
        run: &mut ErrorPropagation,
        (prepare, before, places): (&Linear<'_>, &mut ErrorPropagation, &[usize]),
        random: &mut SplitMix,
    ) -> Option<f64> {
        let function = self.function;
        let at = |value: Value| run.values[value.index()];
        let mut guards = function.guards.iter();
        if !guards.all(|guard| at(guard.pivot) > guard.tolerance * at(guard.scale)) {
            return None;
        }
        let results = function.results.iter().copied().map(at);
        let size: f64 = results.map(|result| result * result).sum();
        run.adjoints.clear();
        run.adjoints.resize(function.code.len(), [0.0; SWEEPS]);
        for (index, (result, times)) in self.results.iter().enumerate() {
            let weight = random.sign() * times.sqrt();
            // Rows of a Hadamard matrix.
            run.adjoints[*result] =
                std::array::from_fn(|sweep| match (index & sweep).count_ones() % 2 {
                    0 => weight,
                    _ => -weight,
                });
        }
        let of_function = self.sweep(run);
        before.adjoints.clear();
        before
            .adjoints
            .resize(prepare.function.code.len(), [0.0; SWEEPS]);
        for (op, adjoint) in function.code.iter().zip(&run.adjoints) {
            if let Op::Read(Source::Prepared(index)) = op {
                let value = prepare.function.results[places[*index as usize]];
                add(&mut before.adjoints[value.index()], 1.0, adjoint);
            }
        }
        let variance = of_function + prepare.sweep(before);
        let error = (variance / size).sqrt();
        (error.is_finite() && size > 0.0).then_some(error)
    }

    /// Propagates derivatives from the results to all operations, and returns the variance of a
    /// weighted sum of the results, averaged over the sweeps, in units of 2⁻¹⁰⁶.
    fn sweep(&self, run: &mut ErrorPropagation) -> f64 {
        let ErrorPropagation {
            values,
            slopes,
            adjoints,
        } = run;
        for (index, op) in self.function.code.iter().enumerate().rev() {
            let adjoint = adjoints[index];
            for (operand, slope) in op.operands().zip(slopes[index]) {
                add(&mut adjoints[operand.index()], slope, &adjoint);
            }
        }
        // A known error also enters the results through its correction, with the opposite sign.
        for &(of, error) in &self.corrected {
            let adjoint = adjoints[error];
            add(&mut adjoints[of], -1.0, &adjoint);
        }
        let all = self.rounds.iter().zip(values).zip(adjoints);
        let errors = all
            .filter(|((rounds, _), _)| **rounds)
            .flat_map(|((_, value), adjoint)| adjoint.map(|slope| slope * *value));
        let squares: f64 = errors.map(|error| error * error).sum();
        squares * VARIANCE / SWEEPS as f64
    }
}

/// to + slope·from, in every sweep.
fn add(to: &mut [f64; SWEEPS], slope: f64, from: &[f64; SWEEPS]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to += slope * from;
    }
}

/// Whether the result of an operation generally has more than 53 bits.
fn rounds(function: &Function, op: &Op) -> bool {
    use lagrangian_symbolic::Function::{Abs, Max, Min, Sign};
    let is_power_of_two = |value: &Value| match function.op(*value) {
        // All stored bits of the significand are 0.
        Op::Constant(value) => value.to_f64().to_bits() << 12 == 0,
        _ => false,
    };
    match op {
        Op::Constant(value) => value.evaluate::<DoubleDouble>().lo() != 0.0,
        Op::Read(_) | Op::Neg(_) | Op::ProductError(..) | Op::SumError(..) => false,
        Op::Unary(Abs | Sign, _) | Op::Binary(Min | Max, ..) => false,
        Op::Mul(a, b) => !is_power_of_two(a) && !is_power_of_two(b),
        Op::Div(_, b) => !is_power_of_two(b),
        Op::Add(a, b) => a != b,
        Op::Sub(..) | Op::Pi | Op::Sin(_) | Op::Cos(_) | Op::Unary(..) | Op::Binary(..) => true,
    }
}

/// SplitMix, the same numbers on every computer: G. L. Steele, D. Lea and C. H. Flood, *Fast
/// splittable pseudorandom number generators*, OOPSLA 2014.
#[derive(Clone, Debug)]
pub struct SplitMix(pub u64);

impl SplitMix {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number uniformly distributed between two others.
    pub fn uniform(&mut self, from: f64, to: f64) -> f64 {
        // 53 bits of a fraction.
        let unit = (self.next() >> 11) as f64 * (f64::EPSILON / 2.0);
        from + (to - from) * unit
    }

    fn sign(&mut self) -> f64 {
        if self.next() >> 63 == 0 { 1.0 } else { -1.0 }
    }
}

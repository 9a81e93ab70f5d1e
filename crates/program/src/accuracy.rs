//! Measures the accuracy of a program at given states, by comparison with the same program in double-doubles.
//!
//! An absolute error says little: if a result is a small difference of large terms, the data determine it only to many units in
//! its last place, whatever the program does. So an error is reported relative to the unavoidable error: half a unit in the last
//! place of the result itself, plus the effect of changing every argument and parameter at random by up to half a unit in its last
//! place, the largest effect of several draws. A ratio of a few units means that the program is as accurate as possible; a large
//! one is a loss of digits that a better formula would not have (N. J. Higham, *Accuracy and Stability of Numerical Algorithms*,
//! 2nd ed. 2002, section 1.5: forward error, backward error and condition).

use lagrangian_scalar::{DoubleDouble, Scalar};
use lagrangian_symbolic::sorting::sort_by;

use super::rounding::{SplitMix, State};
use super::{Arguments, Interpreter, Program, Role};

/// Half the distance between 1 and the next number: the bound of the relative error of a rounding.
const UNIT_ROUNDOFF: f64 = f64::EPSILON / 2.0;

/// The number of times that all data are perturbed by up to half a unit in their last place.
const PERTURBATIONS: usize = 8;

/// The number of times that the step towards a singular state is shortened before the search ends.
const BISECTIONS: usize = 16;

/// The rounding errors of one of a machine's quantities.
#[derive(Clone, Debug, PartialEq)]
pub struct Accuracy {
    /// The quantity.
    pub role: Role,
    /// The number of states at which it has a value.
    pub known: usize,
    /// The median over states of the largest ratio among its numbers.
    pub median: f64,
    /// The state and number with the largest ratio.
    pub worst: Worst,
}

/// The least accurate number of a quantity.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Worst {
    /// The error relative to the unavoidable error.
    pub share: f64,
    /// The error in units in the last place of the result.
    pub units: f64,
    /// The error, in the unit of the result.
    pub error: f64,
    /// The index of the number.
    pub index: usize,
    /// The index of the state, in the order in which states were examined.
    pub state: usize,
}

/// Computes the numbers of a quantity, and returns whether they have values.
pub type Compute<'a> = dyn FnMut(Role, Arguments<'_, f64>, &mut [f64]) -> bool + 'a;

/// Examines a program state by state.
#[derive(Debug)]
pub struct AccuracyTest<'p> {
    program: &'p Program,
    in_f64: Interpreter<f64>,
    exact: Interpreter<DoubleDouble>,
    /// Interpreters with perturbed parameters, each parameter by up to half a unit in its last place.
    perturbed: Vec<Interpreter<DoubleDouble>>,
    random: SplitMix,
    /// The number of states that were examined.
    states: usize,
    /// For each function its role, the largest ratio at each state, and the worst number.
    ratios: Vec<(Role, Vec<f64>, Worst)>,
}

impl<'p> AccuracyTest<'p> {
    /// A judge of a program with these parameters.
    ///
    /// # Panics
    /// If `parameters` is not as long as [`Program::parameters`].
    pub fn new(program: &'p Program, parameters: &[f64]) -> AccuracyTest<'p> {
        let mut random = SplitMix(2);
        let row: Vec<DoubleDouble> = parameters.iter().map(|&p| p.into()).collect();
        let exact = Interpreter::new(program, &row);
        let moved = (0..PERTURBATIONS).map(|_| {
            let mut other = exact.clone();
            other.prepare(&perturbed(parameters, &mut random));
            other
        });
        let moved = moved.collect();
        let functions = program.functions.iter().map(|function| function.role);
        // Stages compute parts of the accelerations that only other stages read.
        let candidates = functions.filter(|role| {
            !matches!(
                role,
                Role::AtTime | Role::AtPosition | Role::AccelerationsAt
            )
        });
        AccuracyTest {
            program,
            in_f64: Interpreter::new(program, parameters),
            exact,
            perturbed: moved,
            random,
            states: 0,
            ratios: candidates
                .map(|role| (role, Vec::new(), Worst::default()))
                .collect(),
        }
    }

    /// Whether all assumptions of the machine hold at a state.
    pub fn satisfies_assumptions(&mut self, state: &State) -> bool {
        let facts = self.program.assumptions.iter().zip(0..);
        let mut all = true;
        for (fact, index) in facts {
            let mut excess = [f64::NAN];
            let role = Role::Assumption(index);
            let called = self.in_f64.call(role, state.arguments(), &mut excess);
            all &= called.is_ok() && (excess[0] > 0.0 || !fact.strict && excess[0] == 0.0);
        }
        all
    }

    /// Examines a state. `fast` is the code that is judged: it computes a quantity in the arithmetic of compiled machines, and returns
    /// whether it has a value.
    pub fn examine(&mut self, state: &State, fast: &mut Compute<'_>) {
        let compute = fast;
        let number = self.states;
        self.states += 1;
        let draws: Vec<State<DoubleDouble>> = self
            .perturbed
            .iter()
            .map(|_| state.mapped(|row| perturbed(row, &mut self.random)))
            .collect();
        let exactly = state.mapped(|row| row.iter().map(|&x| x.into()).collect());
        for (role, shares, worst) in &mut self.ratios {
            let length = self
                .program
                .function(*role)
                .map_or(0, |of| of.results.len());
            let mut fast = vec![0.0; length];
            let mut exact = vec![DoubleDouble::ZERO; length];
            let known = compute(*role, state.arguments(), &mut fast)
                && self
                    .exact
                    .call(*role, exactly.arguments(), &mut exact)
                    .is_ok();
            if !known {
                continue;
            }
            let mut unavoidable: Vec<f64> =
                exact.iter().map(|x| UNIT_ROUNDOFF * x.hi().abs()).collect();
            for (interpreter, state) in self.perturbed.iter_mut().zip(&draws) {
                let mut other = vec![DoubleDouble::ZERO; length];
                if interpreter
                    .call(*role, state.arguments(), &mut other)
                    .is_err()
                {
                    continue;
                }
                for ((unavoidable, other), exact) in unavoidable.iter_mut().zip(other).zip(&exact) {
                    let by = (other - *exact).hi().abs() + UNIT_ROUNDOFF * exact.hi().abs();
                    *unavoidable = unavoidable.max(by);
                }
            }
            let mut greatest: Option<f64> = None;
            for (index, (fast, exact)) in fast.iter().zip(&exact).enumerate() {
                if !exact.is_finite() {
                    continue;
                }
                let error = (DoubleDouble::from(*fast) - *exact).hi().abs();
                let error = if fast.is_finite() {
                    error
                } else {
                    f64::INFINITY
                };
                let share = if error == 0.0 {
                    0.0
                } else {
                    error / unavoidable[index]
                };
                if share > worst.share {
                    let size = exact.hi().abs();
                    let unit = size.next_up() - size;
                    *worst = Worst {
                        share,
                        units: error / unit,
                        error,
                        index,
                        state: number,
                    };
                }
                greatest = Some(greatest.map_or(share, |greatest| greatest.max(share)));
            }
            shares.extend(greatest);
        }
    }

    /// A state near `from` at which the machine is nearly singular: where the smallest ratio of pivot to scale is smallest, as far
    /// as a search along one coordinate after the other finds it.
    pub fn towards_singular(&mut self, from: &State) -> State {
        let mut best = from.clone();
        let mut least = self.margin(&best);
        let sizes = from.q.iter().map(|q| 0.5 * (0.1 + q.abs()));
        let mut steps: Vec<f64> = sizes.collect();
        for _ in 0..BISECTIONS {
            for (i, step) in steps.iter_mut().enumerate() {
                let mut found = false;
                for by in [*step, -*step] {
                    let mut there = best.clone();
                    there.q[i] += by;
                    let margin = self.margin(&there);
                    // A NaN margin compares false and is rejected.
                    if margin < least && self.satisfies_assumptions(&there) {
                        (best, least, found) = (there, margin, true);
                        break;
                    }
                }
                *step *= if found { 1.5 } else { 0.5 };
            }
        }
        best
    }

    /// The smallest ratio of pivot to scale; infinite if there is no pivot, or if the machine is singular.
    fn margin(&mut self, state: &State) -> f64 {
        let role = self.program.solving();
        let length = self.program.function(role).map_or(0, |of| of.results.len());
        let mut results = vec![0.0; length];
        match self.in_f64.call(role, state.arguments(), &mut results) {
            Ok(()) => self.in_f64.margin(role),
            Err(_) => f64::INFINITY,
        }
    }

    /// The results, in the order of the program's functions, without those that have no value at any state.
    pub fn finish(self) -> Vec<Accuracy> {
        let ratios = self
            .ratios
            .into_iter()
            .filter(|(_, shares, _)| !shares.is_empty());
        ratios
            .map(|(role, mut shares, worst)| {
                sort_by(&mut shares, f64::total_cmp);
                Accuracy {
                    role,
                    known: shares.len(),
                    median: shares[shares.len() / 2],
                    worst,
                }
            })
            .collect()
    }
}

/// Numbers, each perturbed by up to half a unit in its last place.
fn perturbed(row: &[f64], random: &mut SplitMix) -> Vec<DoubleDouble> {
    let moved = |&x: &f64| {
        let by = x * random.uniform(-UNIT_ROUNDOFF, UNIT_ROUNDOFF);
        DoubleDouble::from(x) + DoubleDouble::from(by)
    };
    row.iter().map(moved).collect()
}

//! Compares machine code with the interpreter, bit for bit: every function of a program, for one state and in lanes.

use std::sync::Arc;

use lagrangian_jit::{Level, Library, Running, Several, SeveralArguments, When};
use lagrangian_native::{Lanes, Number};
use lagrangian_program::{Arguments, Interpreter, Program, Role, Singular};
use lagrangian_scalar::{Kernel, Scalar};

/// A stream of random numbers from a seed.
pub struct Numbers(pub u64);

impl Numbers {
    /// 64 random bits.
    pub fn bits(&mut self) -> u64 {
        // splitmix64, G. L. Steele, D. Lea, C. H. Flood, Fast splittable pseudorandom number generators, 2014.
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A random index less than n.
    pub fn below(&mut self, n: usize) -> usize {
        (self.bits() % n as u64) as usize
    }

    /// A random number between −2 and 2.
    pub fn small(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 51) as f64 - 2.0
    }

    /// A random number for a state; if `is_wild`, some are NaN, infinite, huge or tiny.
    pub fn of_state(&mut self, is_wild: bool) -> f64 {
        const WILD: [f64; 12] = [
            0.0,
            -0.0,
            1e300,
            -1e300,
            1e-310,
            f64::NAN,
            f64::INFINITY,
            f64::NEG_INFINITY,
            1e5,
            -3e6,
            1e22,
            std::f64::consts::FRAC_PI_2,
        ];
        if is_wild && self.below(3) == 0 {
            WILD[self.below(WILD.len())]
        } else {
            self.small()
        }
    }
}

/// A state, with everything that the functions read.
struct State {
    t: f64,
    q: Vec<f64>,
    v: Vec<f64>,
    u: Vec<f64>,
    a: Vec<f64>,
    /// The values that the stages of the accelerations have computed so far.
    left: [Vec<f64>; 2],
}

/// The result of a function at a state.
type Outcome = Result<Vec<f64>, Singular>;

/// A call of the interpreter in the arithmetic of compiled machines.
struct Call<'a> {
    interpreter: &'a mut Interpreter<f64>,
    role: Role,
    arguments: Arguments<'a, f64>,
    results: &'a mut [f64],
}

impl Kernel<f64> for Call<'_> {
    type Output = Result<(), Singular>;

    #[inline(always)]
    fn run<N: Scalar<Stored = f64>>(self) -> Self::Output {
        self.interpreter
            .call_in::<N>(self.role, self.arguments, self.results)
    }
}

const STAGES: [Role; 2] = [Role::AtTime, Role::AtPosition];

fn interpret(interpreter: &mut Interpreter<f64>, role: Role, len: usize, state: &State) -> Outcome {
    for (role, values) in STAGES.into_iter().zip(&state.left) {
        interpreter.set_stage_results(role, values);
    }
    let arguments = arguments(state);
    let mut results = vec![0.0; len];
    let called = if role.is_fast() {
        f64::run(Call {
            interpreter,
            role,
            arguments,
            results: &mut results,
        })
    } else {
        interpreter.call(role, arguments, &mut results)
    };
    called.map(|()| results)
}

fn arguments(state: &State) -> Arguments<'_, f64> {
    Arguments {
        t: state.t,
        q: &state.q,
        v: &state.v,
        u: &state.u,
        a: &state.a,
    }
}

/// Arithmetic does not determine the bits of a NaN; all other results must have the same bits.
fn is_same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan()
}

/// Compares two results of a function and returns how many of the numbers are finite.
fn compare(what: &str, expected: &Outcome, found: Option<&[f64]>) -> Result<usize, String> {
    match (expected, found) {
        (Err(_), None) => Ok(0),
        (Ok(expected), Some(found)) => {
            for (index, (expected, found)) in expected.iter().zip(found).enumerate() {
                if !is_same(*expected, *found) {
                    return Err(format!(
                        "{what}: result {index} is {found:e}, interpreted {expected:e}"
                    ));
                }
            }
            let are_numbers = expected.iter().filter(|result| result.is_finite());
            Ok(are_numbers.count())
        }
        (Ok(_), None) => Err(format!("{what}: refused, interpreted it has a value")),
        (Err(singular), Some(_)) => Err(format!("{what}: a value, interpreted {singular:?}")),
    }
}

/// Compares all code of a program with the interpreter at this many states (8, 16, …). Of every eight states the
/// last ones are ordinary; the others contain numbers that are huge, tiny, NaN or infinite. Returns how many
/// finite results were compared.
///
/// # Errors
/// The first difference.
pub fn agrees(
    program: &Arc<Program>,
    parameters: &[f64],
    seed: u64,
    states: usize,
) -> Result<usize, String> {
    let mut numbers = Numbers(seed);
    let mut interpreter = Interpreter::new(program, parameters);
    let n = program.dimension();
    let lens = STAGES.map(|role| program.function(role).map_or(0, |f| f.results.len()));
    let states: Vec<State> = (0..states)
        .map(|index| {
            let is_wild = index % 8 < 3;
            let mut take =
                |n: usize| -> Vec<f64> { (0..n).map(|_| numbers.of_state(is_wild)).collect() };
            State {
                t: take(1)[0],
                q: take(n),
                v: take(n),
                u: take(program.inputs.len()),
                a: take(n),
                left: lens.map(&mut take),
            }
        })
        .collect();
    // Parameters near the given ones, one set for each of eight lanes.
    let sets: Vec<Vec<f64>> = (0..8)
        .map(|_| {
            let near = parameters.iter();
            near.map(|p| p * (1.0 + numbers.small() / 8.0)).collect()
        })
        .collect();
    let mut others: Vec<Interpreter<f64>> = sets
        .iter()
        .map(|parameters| Interpreter::new(program, parameters))
        .collect();

    let mut compared = 0;
    for level in Level::all() {
        let library = Library::of(program.clone(), Library::one(level)).map_err(text)?;
        let mut running = Running::new(Arc::new(library), When::Always, &interpreter);
        for function in &program.functions {
            let (role, len) = (function.role, function.results.len());
            for (index, state) in states.iter().enumerate() {
                let what = format!("{level:?}, {}, seed {seed}, state {index}", role.name());
                let expected = interpret(&mut interpreter, role, len, state);
                for (role, values) in STAGES.into_iter().zip(&state.left) {
                    running.set_stage_results(role, values);
                }
                let mut results = vec![0.0; len];
                let is_run = running.call(role, arguments(state), &mut results);
                compared += compare(&what, &expected, is_run.then_some(&results))?;
            }
        }
        compared += in_lanes::<4>(
            program,
            level,
            &states,
            (&mut interpreter, &mut others),
            &sets,
        )?;
        compared += in_lanes::<8>(
            program,
            level,
            &states,
            (&mut interpreter, &mut others),
            &sets,
        )?;
    }
    Ok(compared)
}

fn in_lanes<const N: usize>(
    program: &Arc<Program>,
    level: Level,
    states: &[State],
    (interpreter, others): (&mut Interpreter<f64>, &mut [Interpreter<f64>]),
    sets: &[Vec<f64>],
) -> Result<usize, String> {
    let library = |is_shared: bool| -> Result<Arc<Library>, String> {
        let layout = Library::several(level, N, is_shared).ok_or("no such layout")?;
        let library = Library::of(program.clone(), layout).map_err(text)?;
        Ok(Arc::new(library))
    };
    let shared = Several::<N>::shared(library(true)?, interpreter).ok_or("not shared")?;
    let parameters: Vec<Lanes<N>> = (0..program.parameters.len())
        .map(|index| side_by_side(|lane| sets[lane][index]))
        .collect();
    let each = Several::<N>::each(library(false)?, &parameters).ok_or("not for each")?;
    let mut own = Several::<N>::each_from(library(false)?, interpreter).ok_or("not for each")?;
    for (lane, other) in others.iter().take(N).enumerate() {
        own.put(lane, other);
    }

    let mut compared = 0;
    for (mut several, is_shared) in [(shared, true), (each, false), (own, false)] {
        for function in &program.functions {
            let (role, len) = (function.role, function.results.len());
            for (group, states) in states.chunks_exact(N).enumerate() {
                let rows = |of: fn(&State) -> &[f64]| -> Vec<Lanes<N>> {
                    let count = of(&states[0]).len();
                    let row = |index| side_by_side(|lane| of(&states[lane])[index]);
                    (0..count).map(row).collect()
                };
                several.set_stage_results(Role::AtTime, &rows(|state| &state.left[0]));
                several.set_stage_results(Role::AtPosition, &rows(|state| &state.left[1]));
                let (q, v, u, a) = (
                    rows(|state| &state.q),
                    rows(|state| &state.v),
                    rows(|state| &state.u),
                    rows(|state| &state.a),
                );
                let arguments = SeveralArguments {
                    t: side_by_side(|lane| states[lane].t),
                    q: &q,
                    v: &v,
                    u: &u,
                    a: &a,
                };
                let mut results = vec![Lanes::splat(0.0); len];
                let held = several
                    .call(role, arguments, &mut results)
                    .ok_or_else(|| format!("{level:?}, {}: no code", role.name()))?;
                for (lane, state) in states.iter().enumerate() {
                    let what = format!(
                        "{level:?}, {}, {N} lanes, shared {is_shared}, states {group}, lane {lane}",
                        role.name()
                    );
                    let interpreter = if is_shared {
                        &mut *interpreter
                    } else {
                        &mut others[lane]
                    };
                    let expected = interpret(interpreter, role, len, state);
                    let own: Vec<f64> = results.iter().map(|lanes| lanes[lane]).collect();
                    let has_value = held >> lane & 1 == 1;
                    compared += compare(&what, &expected, has_value.then_some(&own))?;
                }
            }
        }
    }
    Ok(compared)
}

fn side_by_side<const N: usize>(of: impl Fn(usize) -> f64) -> Lanes<N> {
    Lanes(std::array::from_fn(of))
}

fn text(error: impl ToString) -> String {
    error.to_string()
}

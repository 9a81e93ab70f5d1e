//! `modes --vary` and `linearize --along`: continuation of a steady motion in a parameter or a rate, and the values at which its
//! modes change their kind.
//!
//! Each motion is sought from the one before it. If it moves far for a small change, or is lost, the step is halved, so that the
//! result is a single branch and does not jump between branches. Between two neighbours whose modes are of different kinds there is
//! a critical value; it is found by bisection to the limit of round-off.

use lagrangian::Machine as _;
use lagrangian::interpreted::InterpretedMachine;
use lagrangian_linear::Complex;
use lagrangian_linear::motion::SteadyMotion;
use lagrangian_linear::search::{self, Wanted};
use lagrangian_linear::spectrum::Modes;
use lagrangian_mechanics::Compiled;
use lagrangian_spec::diagnostic::Severity;

use super::{motion, number, refuse_drives, wanted};
use crate::call;
use crate::diagnostics;
use crate::evaluate::{ended_assumptions, set_start};
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::output;
use crate::progress;

/// The most Newton steps from one motion to the next.
const MOST_STEPS: usize = 40;

/// How many times the step to the next value may be halved.
const MOST_HALVINGS: usize = 8;

/// A motion belongs to another branch if a coordinate differs by more than this, in rad, m, or relative to it.
const NEAR: f64 = 0.25;

/// The most critical values between two neighbours.
const MOST_CRITICAL: usize = 8;

/// Changes closer together than this fraction of the distance of two values count as one: very near a critical
/// value the kind of a mode is subject to round-off.
const TOGETHER: f64 = 1e-7;

/// The varied quantity.
enum Subject {
    /// A parameter or an input.
    Parameter,
    /// The rates of these coordinates.
    Rates(Vec<usize>),
}

/// The result at one value.
pub struct Point {
    /// The value.
    pub value: f64,
    /// The motion, or why there is none.
    pub motion: Result<SteadyMotion, String>,
    /// Whether it continues the motion at the previous value.
    pub continues: bool,
}

/// A value at which modes change their kind.
pub struct Critical {
    /// The value.
    pub value: f64,
    /// The uncertainty of the value.
    pub error: f64,
    /// The number of growing modes before and after it.
    pub growing: [usize; 2],
    /// The number of oscillating modes before and after it.
    pub oscillating: [usize; 2],
    /// The eigenvalue that changes, if it can be identified.
    pub lambda: Option<Complex<f64>>,
}

/// Steady motions along a range of values.
pub struct Trace {
    /// The name of the varied quantity.
    pub name: String,
    /// Its unit; `1` for a pure number.
    pub unit: String,
    /// Which coordinates move steadily, and which rates are to be found.
    pub wanted: Wanted,
    /// The results in the order of the values.
    pub points: Vec<Point>,
    /// The critical values in the same order.
    pub critical: Vec<Critical>,
}

/// A critical value this close to one of the requested values, relative to their distance, is set to that value.
const AT_AN_END: f64 = 1e-9;

/// The number of modes of each kind.
#[derive(Clone, Copy, PartialEq)]
struct Kinds {
    growing: usize,
    oscillating: usize,
    /// Modes that are neither within round-off.
    lost: usize,
}

impl Kinds {
    fn of(modes: &Modes) -> Kinds {
        let count = |is: &dyn Fn(Complex<f64>) -> bool| {
            modes.modes.iter().filter(|mode| is(mode.lambda)).count()
        };
        Kinds {
            growing: count(&|lambda| lambda.re > 0.0),
            oscillating: count(&|lambda| lambda.im > 0.0),
            lost: modes.lost,
        }
    }
}

/// A value with its motion.
struct At {
    value: f64,
    motion: SteadyMotion,
}

/// The data for continuation.
struct Tracer<'a> {
    machine: &'a InterpretedMachine,
    search: &'a call::Search,
    name: &'a str,
    subject: Subject,
    wanted: Wanted,
}

/// Continues the steady motion of a call along the values of `--vary`, or of another option.
///
/// # Errors
/// If the call is invalid, or there is no motion at any value.
pub fn trace(
    search: &call::Search,
    (option, vary): (&str, &call::Vary),
    compiled: &Compiled<'_>,
    machine: &InterpretedMachine,
) -> Result<Trace, Failure> {
    let (tracer, unit) = Tracer::new(search, (option, vary), machine)?;
    let values = vary.values(option, &unit).map_err(Failure::Call)?;
    tracer.check(compiled, &values)?;
    progress::now("following the motion");
    let interrupt = Interrupt::watch();
    let mut points: Vec<Point> = Vec::with_capacity(values.len());
    let mut critical: Vec<Critical> = Vec::new();
    let mut before: Option<At> = None;
    for value in values {
        if interrupt.was_pressed() {
            output::print_error("interrupted: nothing is written or printed");
            return Err(Failure::Interrupted);
        }
        let followed = before
            .as_ref()
            .map(|before| tracer.continuation(before, value, MOST_HALVINGS));
        let continues = matches!(followed, Some(Ok(_)));
        let result = match (followed, &before) {
            (Some(Ok(motion)), _) => Ok(motion),
            // The branch has ended; there may be another one.
            (Some(Err(_)), Some(before)) => tracer.from(&before.motion, value),
            _ => tracer.solve_anew(value),
        };
        if let (Ok(motion), true, Some(before)) = (&result, continues, &before) {
            tracer.locate(before, value, motion, &mut critical);
        }
        if let Ok(motion) = &result {
            before = Some(At {
                value,
                motion: motion.clone(),
            });
        } else {
            // A branch that has ended is not continued across the gap.
            before = None;
        }
        points.push(Point {
            value,
            motion: result.map_err(Failure::message),
            continues,
        });
    }
    if points.iter().all(|point| point.motion.is_err()) {
        let why = points.into_iter().find_map(|point| point.motion.err());
        return Err(Failure::Run(why.unwrap_or_default()));
    }
    tracer.warn_of_ended(&points);
    Ok(Trace {
        name: vary.name.clone(),
        unit,
        wanted: tracer.wanted,
        points,
        critical,
    })
}

impl<'a> Tracer<'a> {
    fn new(
        search: &'a call::Search,
        (option, vary): (&str, &'a call::Vary),
        machine: &'a InterpretedMachine,
    ) -> Result<(Tracer<'a>, String), Failure> {
        let name = vary.name.as_str();
        let coordinate = name
            .strip_prefix("der(")
            .and_then(|name| name.strip_suffix(')'));
        let coordinate = coordinate.unwrap_or(name).trim();
        let mut start = machine.start();
        set_start(&mut start, &search.start)?;
        let mut wanted = wanted(search, &mut start.v)?;
        wanted.steps = MOST_STEPS;
        let mut probe = start.v.clone();
        probe.values.fill(0.0);
        if probe.set(coordinate, 1.0).is_ok() {
            let rates: Vec<usize> = (0..probe.values.len())
                .filter(|j| probe.values[*j] != 0.0)
                .collect();
            let steady = search
                .steady
                .iter()
                .find(|steady| steady.name == coordinate);
            match steady.map(|steady| &steady.rate) {
                Some(call::SteadyRate::Given(_)) => {
                    return Err(Failure::Call(format!(
                        "--steady {coordinate}=… and {option} {name} both give the rate of `{coordinate}`: leave out the first"
                    )));
                }
                Some(call::SteadyRate::Solved) => {
                    return Err(Failure::Call(format!(
                        "--steady {coordinate}=solve seeks the rate that {option} {name} gives: leave out one of them"
                    )));
                }
                _ => {}
            }
            for j in &rates {
                wanted.steady[*j] = true;
            }
            let unit = match start.q.unit(coordinate) {
                None | Some("1") => "1/s".to_owned(),
                Some(unit) => format!("{unit}/s"),
            };
            let tracer = Tracer {
                machine,
                search,
                name: coordinate,
                subject: Subject::Rates(rates),
                wanted,
            };
            return Ok((tracer, unit));
        }
        if let Err(unknown) = machine.clone().set(name, 0.0) {
            return Err(super::reading::name_error(
                "parameter, input or coordinate",
                &unknown,
            ));
        }
        if search.start.parameters.iter().any(|set| set.name == name) {
            return Err(Failure::Call(format!(
                "--set {name}=… and {option} {name} both give `{name}` a value: leave out the first"
            )));
        }
        let unit = machine.unit(name).unwrap_or("1").to_owned();
        let tracer = Tracer {
            machine,
            search,
            name,
            subject: Subject::Parameter,
            wanted,
        };
        Ok((tracer, unit))
    }

    /// Refuses values that the spec does not allow, and machines that are driven.
    fn check(&self, compiled: &Compiled<'_>, values: &[f64]) -> Result<(), Failure> {
        for (k, value) in values.iter().enumerate() {
            let machine = self.machine_at(*value);
            let mut diagnostics = compiled
                .model
                .parameter_diagnostics(machine.parameter_values());
            if k > 0 {
                // Warnings are printed only once.
                diagnostics.retain(|diagnostic| diagnostic.code.severity() == Severity::Error);
            }
            diagnostics::check(&diagnostics).map_err(Failure::Call)?;
            // The first value may happen to remove a time dependence, so other values are checked too.
            if k < 2 || k + 1 == values.len() {
                let (q, wanted) = self.start(&machine)?;
                refuse_drives(&machine, &q, &wanted)?;
            }
        }
        Ok(())
    }

    /// Prints a warning for each fact that the spec assumes and that does not hold at some of the values, with the first of them.
    fn warn_of_ended(&self, points: &[Point]) {
        let mut ended: Vec<(String, f64, usize)> = Vec::new();
        for point in points {
            let Ok(motion) = &point.motion else { continue };
            let machine = self.machine_at(point.value);
            let at = (0.0, &motion.found.place.q(), &motion.v);
            for warning in ended_assumptions(&machine.prepare(), at) {
                match ended.iter_mut().find(|(known, ..)| *known == warning) {
                    Some((_, _, count)) => *count += 1,
                    None => ended.push((warning, point.value, 1)),
                }
            }
        }
        for (warning, first, count) in ended {
            output::print_error(format_args!(
                "warning: at {count} of {} values, the first of which is {} = {}: {warning}",
                points.len(),
                self.name,
                number(first)
            ));
        }
    }

    /// The machine at a value.
    fn machine_at(&self, value: f64) -> InterpretedMachine {
        let mut machine = self.machine.clone();
        if let Subject::Parameter = self.subject {
            // The name has been checked.
            let _ = machine.set(self.name, value);
            crate::reading::set_members(&mut machine, &self.search.start, self.name);
        }
        machine
    }

    /// The start of a search that is not a continuation.
    fn start(&self, machine: &InterpretedMachine) -> Result<(Vec<f64>, Wanted), Failure> {
        let mut start = machine.start();
        set_start(&mut start, &self.search.start)?;
        let mut wanted = self.wanted.clone();
        wanted.rates = super::wanted(self.search, &mut start.v)?.rates;
        start.v.values = wanted.given();
        let from = super::on_constraints(machine, &self.search.keep, start)?;
        Ok((from, wanted))
    }

    fn find(
        &self,
        machine: &InterpretedMachine,
        q: &[f64],
        mut wanted: Wanted,
        value: f64,
    ) -> Result<SteadyMotion, Failure> {
        if let Subject::Rates(rates) = &self.subject {
            for j in rates {
                wanted.rates[*j] = value;
            }
        }
        motion(machine, q, &wanted)
    }

    fn solve_anew(&self, value: f64) -> Result<SteadyMotion, Failure> {
        let machine = self.machine_at(value);
        let (q, mut wanted) = self.start(&machine)?;
        wanted.steps = search::MOST_STEPS;
        self.find(&machine, &q, wanted, value)
    }

    /// The motion that the search reaches from another one.
    fn from(&self, other: &SteadyMotion, value: f64) -> Result<SteadyMotion, Failure> {
        let mut wanted = self.wanted.clone();
        for j in 0..wanted.rates.len() {
            if wanted.solved[j] {
                wanted.rates[j] = other.v[j];
            }
        }
        self.find(
            &self.machine_at(value),
            &other.found.place.q(),
            wanted,
            value,
        )
    }

    /// The continuation of a motion to another value of the parameter.
    fn continuation(
        &self,
        from: &At,
        value: f64,
        halvings: usize,
    ) -> Result<SteadyMotion, Failure> {
        let result = self.from(&from.motion, value);
        match result {
            Ok(motion) if is_near(&from.motion, &motion) => return Ok(motion),
            Err(Failure::Call(why)) => return Err(Failure::Call(why)),
            found if halvings == 0 => {
                return found.and(Err(Failure::run("the branch of motions ends")));
            }
            _ => {}
        }
        let middle = 0.5 * (from.value + value);
        let motion = self.continuation(from, middle, halvings - 1)?;
        let middle = At {
            value: middle,
            motion,
        };
        self.continuation(&middle, value, halvings - 1)
    }

    /// Finds the critical values between two neighbours.
    fn locate(&self, from: &At, to: f64, end: &SteadyMotion, critical: &mut Vec<Critical>) {
        let last = Kinds::of(&end.modes);
        let mut low = At {
            value: from.value,
            motion: from.motion.clone(),
        };
        let span = (to - from.value).abs();
        let mut changes: Vec<(f64, SteadyMotion, f64, SteadyMotion)> = Vec::new();
        'changes: while Kinds::of(&low.motion.modes) != last && changes.len() < MOST_CRITICAL {
            let kinds = Kinds::of(&low.motion.modes);
            let mut high = At {
                value: to,
                motion: end.clone(),
            };
            loop {
                let middle = 0.5 * (low.value + high.value);
                let width = (high.value - low.value).abs();
                if middle == low.value || middle == high.value || width <= f64::EPSILON * span {
                    break;
                }
                let Ok(motion) = self.continuation(&low, middle, 2) else {
                    break 'changes;
                };
                let at = At {
                    value: middle,
                    motion,
                };
                if Kinds::of(&at.motion.modes) == kinds {
                    low = at
                } else {
                    high = at
                }
            }
            changes.push((low.value, low.motion, high.value, high.motion.clone()));
            low = high;
        }
        let mut changes = changes.into_iter().peekable();
        while let Some((low, before, mut high, mut after)) = changes.next() {
            // Merges changes that are one change within round-off.
            while let Some((_, _, end, motion)) =
                changes.next_if(|(next, ..)| (next - high).abs() <= TOGETHER * span)
            {
                (high, after) = (end, motion);
            }
            let (first, then) = (Kinds::of(&before.modes), Kinds::of(&after.modes));
            if (first.growing, first.oscillating) == (then.growing, then.oscillating) {
                continue;
            }
            let (mut value, mut error) = (0.5 * (low + high), 0.5 * (high - low).abs());
            // If both kinds are round-off at one of the end values itself, that value is critical.
            for end in [from.value, to] {
                if (value - end).abs() <= AT_AN_END * span {
                    error += (value - end).abs();
                    value = end;
                }
            }
            critical.push(Critical {
                value,
                error,
                growing: [first.growing, then.growing],
                oscillating: [first.oscillating, then.oscillating],
                lambda: changing([&before.modes, &after.modes], [first, then]),
            });
        }
    }
}

/// The eigenvalue that changes its kind: the one closest to doing so.
fn changing(modes: [&Modes; 2], [first, then]: [Kinds; 2]) -> Option<Complex<f64>> {
    let nearest =
        |modes: &Modes, is: &dyn Fn(Complex<f64>) -> bool, size: &dyn Fn(Complex<f64>) -> f64| {
            let all = modes
                .modes
                .iter()
                .map(|mode| mode.lambda)
                .filter(|lambda| is(*lambda));
            all.min_by(|a, b| size(*a).total_cmp(&size(*b)))
        };
    if first.oscillating != then.oscillating {
        // A pair meets on the real axis and stops oscillating.
        let side = usize::from(then.oscillating > first.oscillating);
        let met = nearest(modes[side], &|lambda| lambda.im > 0.0, &|lambda| lambda.im)?;
        return Some(Complex::new(met.re, 0.0));
    }
    let side = usize::from(then.growing > first.growing);
    let met = nearest(modes[side], &|lambda| lambda.re > 0.0, &|lambda| lambda.re)?;
    Some(Complex::new(0.0, met.im))
}

fn is_near(one: &SteadyMotion, other: &SteadyMotion) -> bool {
    let (one, other) = (one.found.place.q(), other.found.place.q());
    let mut pairs = one.iter().zip(&other);
    pairs.all(|(a, b)| (a - b).abs() <= NEAR * a.abs().max(1.0))
}

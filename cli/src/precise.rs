//! `lagrangian simulate --precision dd` and `--validated`: runs with more digits, and proved bounds.

use lagrangian::interpreted::{
    Enclosure, InterpretedMachine, Named, PreciseEnd, PreciseRun, SeriesStepper,
};
use lagrangian::methods::{Method, TAYLOR};
use lagrangian::scalar::{DoubleDouble, Interval, Scalar};
use lagrangian::{Error, Machine, State, Work};
use lagrangian_mechanics::series::ProvedSeries;
use lagrangian_symbolic::Dag;
use lagrangian_units::state_of;
use num_bigint::{BigInt, Sign};
use serde_json::{Map, Value, json};

use crate::call;
use crate::evaluate::set_start;
use crate::failure::Failure;
use crate::methods::{self, AUTO};
use crate::numbers::shortest;
use crate::output;
use crate::progress;
use crate::reading::{self, Reading};

/// The number of printed digits.
const DIGITS: usize = 30;

/// The default tolerance of a step: ten times the finest.
const TOLERANCE: f64 = 5e-30;

/// The default tolerance of explicit methods, which would need too many steps for a finer one.
const EXPLICIT_TOLERANCE: f64 = 1e-24;

/// The factor by which the tolerance of the comparison run is coarser.
const COARSER: f64 = 100.0;

/// A machine with its series, if it has one, at the start of a call.
struct Ready {
    machine: InterpretedMachine,
    start: State<Named>,
}

/// The machine of a call that may only request the end of its run.
fn prepare(call: &call::Simulate, option: &str) -> Result<Ready, Failure> {
    let files = [
        ("--out", call.out.is_some()),
        ("--plot", call.plot.is_some()),
        ("--report", call.report.is_some()),
        ("--every", call.every.is_some()),
        ("--longest-step", call.longest_step.is_some()),
        ("--global-error", call.global_error),
        ("--keep", !call.keep.names.is_empty()),
    ];
    if let Some((other, _)) = files.iter().find(|(_, is_there)| *is_there) {
        return Err(Failure::Call(format!(
            "{option} computes only the end of a run and cannot be used with {other}"
        )));
    }
    if !call.inputs.is_empty() {
        return Err(Failure::Call(format!(
            "{option}: inputs keep the values given by --set; --input is not supported"
        )));
    }
    let dag = Dag::new();
    let compiled = Reading::open(&call.spec)?
        .with_values(&call.start)
        .compile(&dag)?;
    let machine = reading::machine(&compiled, &call.start)?;
    reading::check_parameters(&machine)?;
    let mut start = machine.start();
    set_start(&mut start, &call.start)?;
    progress::now("deriving the series");
    let machine = machine.with_series(ProvedSeries::derive(&compiled.model));
    Ok(Ready { machine, start })
}

/// `--precision dd`.
///
/// # Errors
/// If the spec or the call is invalid, or the run fails.
pub fn in_double_doubles(call: &call::Simulate) -> Result<(), Failure> {
    let requested_method = requested_method(call)?;
    let Ready { machine, start } = prepare(call, "--precision dd")?;
    machine.prepare_in::<DoubleDouble>().map_err(|none| {
        Failure::Run(format!(
            "--precision dd: only for machines without constraints and contacts; {none}; `--global-error` estimates the error of an ordinary run"
        ))
    })?;
    let has_series = SeriesStepper::<DoubleDouble>::new(&machine, TOLERANCE);
    let mut method = match (requested_method, has_series) {
        (None, Ok(_)) => &TAYLOR,
        (None, Err(_)) => <&Method>::default(),
        (Some(method), Err(none)) if std::ptr::eq(method, &TAYLOR) => {
            return Err(Failure::Run(format!(
                "--method taylor: no Taylor series: {none}"
            )));
        }
        (Some(method), _) => method,
    };
    progress::now("integrating in double-double");
    let end_by = |method: &'static Method, factor: f64| {
        let run = PreciseRun {
            method,
            tolerance: factor * tolerance_of(method, call.tolerance),
            max_steps: call.max_steps,
        };
        run.end(&machine, &start, call.until)
    };
    let mut found = end_by(method, 1.0);
    // A series has no numbers where a distance or a speed is zero, as the speed at a start from rest is, but accelerations may have.
    let has_no_numbers = matches!(
        found,
        Err(Error::NotFinite { .. } | Error::StepTooSmall { .. })
    );
    if has_no_numbers && requested_method.is_none() && std::ptr::eq(method, &TAYLOR) {
        method = <&Method>::default();
        found = end_by(method, 1.0);
    }
    let end = found.map_err(Failure::run)?;
    let tolerance = tolerance_of(method, call.tolerance);
    let coarser = end_by(method, COARSER).map_err(Failure::run)?;
    let differences = differences(&end, &coarser);
    let (_, greatest) = worst(&differences);
    let result = PreciseResult {
        machine: &machine,
        start: &start,
        until: call.until,
        method,
        tolerance,
        end: &end,
        difference: greatest,
    };
    if call.spec.json {
        output::line(format_args!("{:#}", result.document()));
    } else {
        result.print();
    }
    Ok(())
}

/// The method that the call names, if it names one; it must be known to the digits of double-doubles.
fn requested_method(call: &call::Simulate) -> Result<Option<&'static Method>, Failure> {
    let method = match call.method.as_str() {
        AUTO => return Ok(None),
        name => methods::named_or(name, &[])?,
    };
    if !std::ptr::eq(method, &TAYLOR)
        && (method.tableau.spectrum.is_some() || method.has_fixed_steps())
    {
        return Err(Failure::Call(format!(
            "--precision dd: the method `{}` is not available; there are taylor, dop853, dopri5 and bs32",
            method.tableau.name
        )));
    }
    Ok(Some(method))
}

/// A run in double-doubles, and how far a run at a coarser tolerance ends from it.
struct PreciseResult<'r> {
    machine: &'r InterpretedMachine,
    start: &'r State<Named>,
    until: f64,
    method: &'static Method,
    tolerance: f64,
    end: &'r PreciseEnd,
    difference: f64,
}

impl PreciseResult<'_> {
    fn names(&self) -> Vec<&str> {
        self.start.q.iter().map(|(name, _)| name).collect()
    }

    fn document(&self) -> Value {
        let end = self.end;
        let of = |numbers: &[DoubleDouble]| -> Value {
            let named = self.names().into_iter().zip(numbers);
            let named = named.map(|(name, x)| (name.to_owned(), decimal(*x, DIGITS).into()));
            Value::Object(named.collect::<Map<_, _>>())
        };
        json!({
            "t": self.until,
            "q": of(&end.q),
            "v": of(&end.v),
            "method": self.method.tableau.name,
            "precision": "dd",
            "tolerance": self.tolerance,
            "steps": end.work.steps,
            "rejected": end.work.rejected,
            "evaluations": end.work.evaluations,
            "difference": self.difference,
        })
    }

    fn print(&self) {
        output::line(format_args!(
            "{}: t = {} s to {} s, {} in double-double, tolerance {}",
            self.machine.name(),
            shortest(self.start.t),
            shortest(self.until),
            self.method.tableau.title,
            shortest(self.tolerance)
        ));
        let Work {
            steps,
            rejected,
            evaluations,
            ..
        } = self.end.work;
        output::line(format_args!(
            "  {steps} steps, {rejected} rejected, {evaluations} evaluations"
        ));
        output::line(format_args!("  at the end"));
        for (name, title, at) in printed_quantities(&self.names()) {
            let x = match at {
                (0, i) => self.end.q[i],
                (_, i) => self.end.v[i],
            };
            let pad = " ".repeat(title.saturating_sub(name.chars().count()));
            output::line(format_args!("    {name}{pad} = {}", decimal(x, DIGITS)));
        }
        output::line(format_args!(
            "  a run at a tolerance of {:.1e} ends within {:.1e} (1 + |y|) of it",
            COARSER * self.tolerance,
            self.difference
        ));
    }
}

/// The tolerance of a step by this method: that of the call, or its default.
fn tolerance_of(method: &'static Method, given: Option<f64>) -> f64 {
    let least = if std::ptr::eq(method, &TAYLOR) {
        TOLERANCE
    } else {
        EXPLICIT_TOLERANCE
    };
    given.unwrap_or(least)
}

/// The difference of two ends, relative to 1 + |y|: coordinates, then rates.
fn differences(end: &PreciseEnd, other: &PreciseEnd) -> Vec<f64> {
    let ends = end.q.iter().chain(&end.v);
    let others = other.q.iter().chain(&other.v);
    ends.zip(others).map(|(a, b)| relative(*a, *b)).collect()
}

/// The error of the end of a run in `f64`: coordinates, then rates, in their units.
pub fn errors(exact: &PreciseEnd, found: &State<Named>) -> Vec<f64> {
    let exact = exact.q.iter().chain(&exact.v);
    let found = found.q.values.iter().chain(&found.v.values);
    exact
        .zip(found)
        .map(|(exact, found)| (*exact - DoubleDouble::from_f64(*found)).abs().to_f64())
        .collect()
}

fn relative(exact: DoubleDouble, other: DoubleDouble) -> f64 {
    ((exact - other).abs() / (DoubleDouble::ONE + exact.abs())).to_f64()
}

/// The index of the greatest number, and the number; NaN counts as greatest.
pub fn worst(numbers: &[f64]) -> (usize, f64) {
    let start = (0, 0.0);
    let numbers = numbers.iter().enumerate();
    numbers.fold(
        start,
        |(at, most), (i, x)| if *x <= most { (at, most) } else { (i, *x) },
    )
}

/// The printed quantities of a state: names of coordinates and of their rates padded to equal width, and the index of each number.
/// Integrals of states of first order are left out, and their rates are the states.
fn printed_quantities(names: &[&str]) -> Vec<(String, usize, (usize, usize))> {
    let mut quantities: Vec<(String, (usize, usize))> = Vec::new();
    for (i, name) in names.iter().enumerate() {
        match state_of(name) {
            Some(state) => quantities.push((state.to_owned(), (1, i))),
            None => {
                quantities.push(((*name).to_owned(), (0, i)));
                quantities.push((format!("der({name})"), (1, i)));
            }
        }
    }
    let width = quantities
        .iter()
        .map(|(name, _)| name.chars().count())
        .max();
    let width = width.unwrap_or(0);
    quantities
        .into_iter()
        .map(|(name, at)| (name, width, at))
        .collect()
}

/// `--validated`.
///
/// # Errors
/// If the spec or the call is invalid, or the enclosure does not exist or ends early; how far it came is printed first.
pub fn validated(call: &call::Simulate) -> Result<(), Failure> {
    if call.method != AUTO && call.method != TAYLOR.tableau.name {
        return Err(Failure::Call(format!(
            "--validated integrates by Taylor series, not by `{}`",
            call.method
        )));
    }
    if call.tolerance.is_some() {
        return Err(Failure::Call(
            "--validated has no --tolerance: its bounds are as narrow as they can be shown to be"
                .into(),
        ));
    }
    let Ready { machine, start } = prepare(call, "--validated")?;
    let exactly =
        |values: &[f64]| -> Vec<_> { values.iter().map(|x| Interval::from(*x)).collect() };
    let (q, v) = (exactly(&start.q.values), exactly(&start.v.values));
    let enclosure = Enclosure::from_states(&machine, start.t, [&q, &v]);
    let mut enclosure = enclosure.map_err(|none| {
        Failure::Run(format!(
            "--validated: only for machines with a Taylor series and without constraints and contacts; {none}; `--global-error` \
             estimates the error of an ordinary run"
        ))
    })?;
    enclosure.set_max_steps(call.max_steps);
    progress::now("enclosing the motion");
    let ended = enclosure.advance_to(call.until);
    let names: Vec<&str> = start.q.iter().map(|(name, _)| name).collect();
    let bounds = |y: &Interval| [shortest(y.lo().next_down()), shortest(y.hi().next_up())];
    if call.spec.json {
        let of = |numbers: &[Interval]| -> Value {
            let named = names.iter().zip(numbers);
            let outward = |y: &Interval| json!([y.lo().next_down(), y.hi().next_up()]);
            let named = named.map(|(name, y)| ((*name).to_owned(), outward(y)));
            Value::Object(named.collect::<Map<_, _>>())
        };
        let mut document = json!({
            "t": enclosure.t(),
            "q": of(enclosure.q()),
            "v": of(enclosure.v()),
            "steps": enclosure.steps(),
        });
        if let (Err(error), Value::Object(fields)) = (&ended, &mut document) {
            fields.insert("error".into(), error.to_string().into());
        }
        output::line(format_args!("{document:#}"));
    } else {
        output::line(format_args!(
            "{}: t = {} s to {} s, enclosed in {} steps by Taylor series over intervals",
            machine.name(),
            shortest(start.t),
            shortest(enclosure.t()),
            enclosure.steps()
        ));
        output::line(format_args!("  proved to contain the end of the motion"));
        for (name, title, at) in printed_quantities(&names) {
            let y = match at {
                (0, i) => &enclosure.q()[i],
                (_, i) => &enclosure.v()[i],
            };
            let [lo, hi] = bounds(y);
            let pad = " ".repeat(title.saturating_sub(name.chars().count()));
            output::line(format_args!(
                "    {name}{pad} in [{lo}, {hi}], {:.1e} wide",
                y.width()
            ));
        }
    }
    match ended {
        Ok(()) => Ok(()),
        Err(error) => {
            output::print_error(format_args!("error: {error}"));
            Err(Failure::AlreadyReported)
        }
    }
}

/// A number rounded to the nearest with this many significant digits.
fn decimal(x: DoubleDouble, digits: usize) -> String {
    if !x.is_finite() {
        return "not a number".into();
    }
    // x = n 2^e exactly.
    let parts = [x.hi(), x.lo()].map(mantissa);
    let least = parts.iter().filter(|(m, _)| *m != 0).map(|(_, e)| *e).min();
    let Some(exponent) = least else {
        return "0".into();
    };
    let of = |(m, e): (i64, i32)| match m {
        0 => BigInt::ZERO,
        _ => BigInt::from(m) << (e - exponent),
    };
    let [high, low] = parts.map(of);
    let number = high + low;
    let is_negative = number.sign() == Sign::Minus;
    let number = BigInt::from(number.magnitude().clone());
    let ten = BigInt::from(10);
    let mut place = x.hi().abs().log10().floor() as i32;
    let text = loop {
        // x 10^(digits − 1 − place), rounded.
        let power = digits as i32 - 1 - place;
        let (mut above, mut below) = (number.clone(), BigInt::from(1));
        if exponent >= 0 {
            above <<= exponent
        } else {
            below <<= -exponent
        }
        if power >= 0 {
            above *= ten.pow(power.unsigned_abs())
        } else {
            below *= ten.pow(power.unsigned_abs())
        }
        let rounded: BigInt = (BigInt::from(2) * above + &below) / (BigInt::from(2) * below);
        let text = rounded.to_string();
        match text.len() {
            more if more > digits => place += 1,
            less if less < digits => place -= 1,
            _ => break text,
        }
    };
    let sign = if is_negative { "-" } else { "" };
    match place {
        0.. if (place as usize) < digits - 1 => {
            let (integer, part) = text.split_at(place as usize + 1);
            format!("{sign}{integer}.{part}")
        }
        -5..0 => format!("{sign}0.{}{text}", "0".repeat((-place - 1) as usize)),
        _ => format!("{sign}{}.{}e{place}", &text[..1], &text[1..]),
    }
}

/// An integer and an exponent of two whose product is a finite number.
fn mantissa(x: f64) -> (i64, i32) {
    let bits = x.to_bits();
    let exponent = ((bits >> 52) & 0x7ff) as i32;
    let fraction = (bits & ((1 << 52) - 1)) as i64;
    let (m, e) = match exponent {
        0 => (fraction, -1074),
        _ => (fraction | (1 << 52), exponent - 1075),
    };
    (if x.is_sign_negative() { -m } else { m }, e)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_are_those_of_the_number() {
        let third = DoubleDouble::from_ratio(1, 3);
        assert_eq!(decimal(third, 30), "0.333333333333333333333333333333");
        let two_thirds = DoubleDouble::from_ratio(-2, 3);
        assert_eq!(decimal(two_thirds, 30), "-0.666666666666666666666666666667");
        // The digits of the nearest f64: 0.1000000000000000055511151231257827…
        let tenth = DoubleDouble::from_f64(0.1);
        assert_eq!(decimal(tenth, 30), "0.100000000000000005551115123126");
        assert_eq!(
            decimal(DoubleDouble::pi(), 30),
            "3.14159265358979323846264338328"
        );
        assert_eq!(decimal(DoubleDouble::from_f64(1e23), 4), "1.000e23");
        assert_eq!(decimal(DoubleDouble::from_f64(9.9996), 4), "10.00");
        assert_eq!(decimal(DoubleDouble::from_f64(-0.0), 30), "0");
    }
}

//! The search tested against certified values: the Statistical Reference Datasets for nonlinear regression of the National Institute of
//! Standards and Technology, <https://www.itl.nist.gov/div898/strd/nls/nls_main.shtml>, as published (`data/nist`; works of the
//! government of the United States, in the public domain). Estimates, their standard deviations and the residual sum of squares are
//! certified to eleven digits, computed there with 128 bits.

use std::f64::consts::TAU;
use std::path::Path;

use lagrangian_fit::least_squares::{Options, Problem, Trouble, minimize};
use lagrangian_fit::statistics::{Standing, Statistics};
use lagrangian_scalar::{Dual, Scalar};
use nalgebra::DMatrix;

type D = Dual<f64>;

/// A problem as read from its file.
struct Dataset {
    model: fn(&[D], f64) -> D,
    starts: [Vec<f64>; 2],
    certified: Vec<f64>,
    deviations: Vec<f64>,
    sum: f64,
    /// x and y.
    data: Vec<(f64, f64)>,
}

impl Dataset {
    fn read(name: &'static str, model: fn(&[D], f64) -> D) -> Dataset {
        let path =
            Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/data/nist/{name}.dat"));
        let text = std::fs::read_to_string(path).expect("a dataset");
        let numbers = |line: &str| -> Vec<f64> {
            let words = line.split_whitespace();
            words.filter_map(|word| word.parse().ok()).collect()
        };
        let mut set = Dataset {
            model,
            starts: [Vec::new(), Vec::new()],
            certified: Vec::new(),
            deviations: Vec::new(),
            sum: f64::NAN,
            data: Vec::new(),
        };
        let mut is_data = false;
        for line in text.lines() {
            if let Some((b, rest)) = line.split_once(" = ")
                && b.trim().starts_with('b')
                && numbers(rest).len() == 4
            {
                let all = numbers(rest);
                set.starts[0].push(all[0]);
                set.starts[1].push(all[1]);
                set.certified.push(all[2]);
                set.deviations.push(all[3]);
            } else if let Some(sum) = line.strip_prefix("Residual Sum of Squares:") {
                set.sum = numbers(sum)[0];
            } else if line.starts_with("Data:") && line.contains(" y ") {
                is_data = true;
            } else if is_data && let [y, x] = numbers(line)[..] {
                set.data.push((x, y));
            }
        }
        assert!(set.data.len() > 5 && !set.certified.is_empty(), "{name}");
        set
    }

    fn at(&self, b: &[f64], seed: Option<usize>, x: f64) -> D {
        let one = |(j, b): (usize, &f64)| {
            if Some(j) == seed {
                D::variable(*b)
            } else {
                D::constant(*b)
            }
        };
        let b: Vec<D> = b.iter().enumerate().map(one).collect();
        (self.model)(&b, x)
    }
}

impl Problem for Dataset {
    fn residuals(&mut self, b: &[f64]) -> Result<Vec<f64>, Trouble> {
        let data = self.data.iter();
        Ok(data.map(|(x, y)| self.at(b, None, *x).value - y).collect())
    }

    fn jacobian(&mut self, b: &[f64]) -> Result<DMatrix<f64>, Trouble> {
        let entry = |i: usize, j: usize| self.at(b, Some(j), self.data[i].0).derivative;
        Ok(DMatrix::from_fn(self.data.len(), b.len(), entry))
    }
}

fn c(x: f64) -> D {
    D::constant(x)
}

fn exp(x: D) -> D {
    x.exp()
}

/// x to the power y, for x > 0.
fn power(x: D, y: D) -> D {
    (y * x.ln()).exp()
}

/// Starts from the published starts and checks the certified estimates, their standard deviations and the sum of squares.
///
/// A search that ends with an offset of 1e-9 is within 1e-9 √p standard errors of the minimum; the certified values have eleven digits.
/// Standard deviations change little over a standard error, and rounding of the derivatives costs digits by the condition of the
/// problem, which is below 1e7 with columns of unit length: a relative error of 1e-8.
fn check(name: &'static str, model: fn(&[D], f64) -> D, starts: &[usize]) {
    let mut set = Dataset::read(name, model);
    let free = vec![[f64::NEG_INFINITY, f64::INFINITY]; set.certified.len()];
    let options = Options {
        offset: 1e-9,
        most_steps: 2000,
        ..Options::default()
    };
    for start in starts {
        let from = set.starts[*start].clone();
        let found = minimize(&mut set, &from, &free, &options).expect("a minimum");
        let told = format!(
            "{name} from start {}: {:?}, {} steps, {} evaluations",
            start + 1,
            found.ending,
            found.steps,
            found.evaluations
        );
        println!("{told}");
        assert!(found.ending.is_minimum(), "{told}");
        let said = Statistics::of(
            &found,
            &free,
            &set.certified,
            (options.derivatives, true),
            |_| false,
        );
        let p = set.certified.len() as f64;
        assert_eq!(said.freedom, set.data.len() - set.certified.len(), "{told}");
        for (j, b) in set.certified.iter().enumerate() {
            let deviation = set.deviations[j];
            let off = (found.x[j] - b).abs();
            assert!(
                off <= 1e-9 * p.sqrt() * deviation + 6e-11 * b.abs(),
                "{told}: b{} is {:e}, not {b:e}",
                j + 1,
                found.x[j]
            );
            assert_eq!(said.standing[j], Standing::Estimated, "{told}");
            let error = said.standard_error(j).expect("told");
            assert!(
                (error - deviation).abs() <= 1e-8 * deviation,
                "{told}: the deviation of b{} is {error:e}, not {deviation:e}",
                j + 1
            );
        }
        // At the minimum, the sum changes by the square of the offset.
        let off = (said.chi_squared - set.sum).abs();
        assert!(off <= 6e-11 * set.sum, "{told}: {:e}", said.chi_squared);
    }
}

const BOTH: [usize; 2] = [0, 1];

#[test]
fn misra1a() {
    check("Misra1a", |b, x| b[0] * (c(1.0) - exp(-b[1] * c(x))), &BOTH);
}

#[test]
fn lanczos3() {
    let model = |b: &[D], x: f64| {
        let part = |a: D, rate: D| a * exp(-rate * c(x));
        part(b[0], b[1]) + part(b[2], b[3]) + part(b[4], b[5])
    };
    check("Lanczos3", model, &BOTH);
}

#[test]
fn enso() {
    let model = |b: &[D], x: f64| {
        let wave = |period: D, a: D, d: D| {
            let angle = c(TAU * x) / period;
            a * angle.cos() + d * angle.sin()
        };
        b[0] + wave(c(12.0), b[1], b[2]) + wave(b[3], b[4], b[5]) + wave(b[6], b[7], b[8])
    };
    check("ENSO", model, &BOTH);
}

fn cubics(b: &[D], x: f64) -> D {
    let x = c(x);
    let above = b[0] + x * (b[1] + x * (b[2] + x * b[3]));
    let below = c(1.0) + x * (b[4] + x * (b[5] + x * b[6]));
    above / below
}

#[test]
fn hahn1() {
    check("Hahn1", cubics, &BOTH);
}

#[test]
fn thurber() {
    check("Thurber", cubics, &BOTH);
}

#[test]
fn mgh09() {
    let model = |b: &[D], x: f64| {
        let x = c(x);
        b[0] * (x * x + x * b[1]) / (x * x + x * b[2] + b[3])
    };
    check("MGH09", model, &BOTH);
}

#[test]
fn mgh10() {
    check("MGH10", |b, x| b[0] * exp(b[1] / (c(x) + b[2])), &BOTH);
}

#[test]
fn mgh17() {
    let model = |b: &[D], x: f64| b[0] + b[1] * exp(-c(x) * b[3]) + b[2] * exp(-c(x) * b[4]);
    check("MGH17", model, &BOTH);
}

#[test]
fn boxbod() {
    check("BoxBOD", |b, x| b[0] * (c(1.0) - exp(-b[1] * c(x))), &BOTH);
}

#[test]
fn rat43() {
    let model = |b: &[D], x: f64| b[0] / power(c(1.0) + exp(b[1] - b[2] * c(x)), c(1.0) / b[3]);
    check("Rat43", model, &BOTH);
}

#[test]
fn eckerle4() {
    let model = |b: &[D], x: f64| {
        let z = (c(x) - b[2]) / b[1];
        b[0] / b[1] * exp(c(-0.5) * z * z)
    };
    check("Eckerle4", model, &BOTH);
}

#[test]
fn bennett5() {
    let model = |b: &[D], x: f64| b[0] * power(b[1] + c(x), c(-1.0) / b[2]);
    check("Bennett5", model, &BOTH);
}

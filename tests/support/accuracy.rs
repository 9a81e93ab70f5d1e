//! How accurate computed accelerations are, and how accurate they can be: rounding analysis of `M a = f`.

use lagrangian_program::{Arguments, Interpreter, Program, Role, Shape, Singular};
use lagrangian_scalar::{DoubleDouble, Interval, Scalar};

use super::references::greatest;

/// The unit roundoff: half the distance between 1 and the next number, the largest relative error of one rounding.
const U: f64 = f64::EPSILON / 2.0;

/// A program evaluated in more precise numbers, against which results in `f64` are judged.
pub struct Judge {
    /// Evaluates to 30 digits.
    exact: Interpreter<DoubleDouble>,
    /// Encloses all values that rounding may produce.
    enclosed: Interpreter<Interval>,
    /// Encloses the values for which a given number may stand.
    enclose: fn(f64) -> Interval,
    n: usize,
}

/// The effect of rounding on the accelerations at one state, in the norm `‖√Mᵢᵢ aᵢ‖₂`, which does not depend on units.
pub struct Accuracy {
    /// The norm of the accelerations.
    pub size: f64,
    /// The norm of their error.
    pub error: f64,
    /// The bound on the norm of the error.
    pub limit: f64,
    /// Condition number of the mass matrix with its diagonal scaled to 1.
    pub condition: f64,
    /// `√Mᵢᵢ`.
    scales: Vec<f64>,
}

impl Accuracy {
    /// The norm of the distance between two rows of accelerations.
    pub fn distance(&self, a: &[f64], b: &[f64]) -> f64 {
        norm(
            self.scales
                .iter()
                .zip(a)
                .zip(b)
                .map(|((scale, a), b)| scale * (a - b)),
        )
    }
}

impl Judge {
    /// Takes parameters and states to be exact.
    pub fn new(program: &Program, parameters: &[f64]) -> Self {
        Self::enclosing(program, parameters, Interval::from_f64)
    }

    /// Takes parameters and states to be decimal numbers rounded to `f64`, each with an error of at most
    /// half a unit in the last place.
    pub fn of_decimals(program: &Program, parameters: &[f64]) -> Self {
        Self::enclosing(program, parameters, |x| {
            Interval::new(x.next_down(), x.next_up())
        })
    }

    /// The largest error of an acceleration computed at a state, divided by the largest acceleration.
    pub fn relative_error(
        &mut self,
        (t, q, v, u): (f64, &[f64], &[f64], &[f64]),
        computed: &[f64],
    ) -> Result<f64, Singular> {
        let at = State { t, q, v, u };
        let exact = at.call(
            &mut self.exact,
            Role::Accelerations,
            self.n,
            DoubleDouble::from,
        )?;
        let errors = computed
            .iter()
            .zip(&exact)
            .map(|(&a, &exact)| (DoubleDouble::from(a) - exact).hi().abs());
        Ok(greatest(errors) / greatest(exact.iter().map(|a| a.hi().abs())))
    }

    fn enclosing(program: &Program, parameters: &[f64], enclose: fn(f64) -> Interval) -> Self {
        let enclosed: Vec<Interval> = parameters.iter().map(|&x| enclose(x)).collect();
        Self {
            exact: Interpreter::new(program, &over(parameters)),
            enclosed: Interpreter::new(program, &enclosed),
            enclose,
            n: program.dimension(),
        }
    }

    /// The accuracy of accelerations that were computed at a state.
    ///
    /// The computed solution satisfies `(M + ΔM) â = f + Δf`. The widths of the enclosures of `M` and `f` bound the
    /// effect of rounding on these. The solution by `M = L D Lᵀ` adds `|ΔM| ≤ γ₃ₙ₊₁ |L| |D| |Lᵀ|`, where `|L| |D| |Lᵀ|`
    /// is below `√(Mᵢᵢ Mⱼⱼ) / (1 − γₙ₊₁)` (N. J. Higham, *Accuracy and Stability of Numerical Algorithms*, 2nd ed. 2002,
    /// theorem 10.4 with eq. (10.8); `γₖ = k u / (1 − k u)`). With `S = diag √Mᵢᵢ`, `H = S⁻¹ M S⁻¹`, `z = S a`:
    ///
    /// ```text
    /// ẑ − z = H⁻¹ (S⁻¹ Δf − S⁻¹ ΔM S⁻¹ ẑ)
    /// ‖ẑ − z‖ ≤ ‖H⁻¹‖ (‖S⁻¹ Δf‖ + (‖S⁻¹ ΔM S⁻¹‖ + n γ₃ₙ₊₁ / (1 − γₙ₊₁)) ‖ẑ‖)
    /// ```
    ///
    /// The limit is twice that, since the accelerations add up `M` and `f` in an order of their own.
    pub fn accuracy(
        &mut self,
        (t, q, v, u): (f64, &[f64], &[f64], &[f64]),
        computed: &[f64],
    ) -> Result<Accuracy, Singular> {
        let n = self.n;
        let entries = Shape::Symmetric(n).len();
        let at = State { t, q, v, u };
        let exact = at.call(&mut self.exact, Role::Accelerations, n, DoubleDouble::from)?;
        let forces = at.call(&mut self.enclosed, Role::Forces, n, self.enclose)?;
        let matrix = at.call(&mut self.enclosed, Role::MassMatrix, entries, self.enclose)?;
        let middle = at.call(
            &mut self.exact,
            Role::MassMatrix,
            entries,
            DoubleDouble::from,
        )?;

        let scale = |i: usize| middle[Shape::index(i, i)].hi().sqrt();
        let size = norm((0..n).map(|i| scale(i) * exact[i].hi()));
        let size_computed = norm((0..n).map(|i| scale(i) * computed[i]));
        let error =
            norm((0..n).map(|i| scale(i) * (DoubleDouble::from(computed[i]) - exact[i]).hi()));

        let scaled = |i: usize, j: usize| {
            middle[Shape::index(i, j)] / DoubleDouble::from(scale(i) * scale(j))
        };
        let h: Vec<Vec<DoubleDouble>> = (0..n)
            .map(|i| (0..n).map(|j| scaled(i, j)).collect())
            .collect();
        let of_h = frobenius(&h);
        let of_inverse = frobenius(&inverse(h));

        let of_forces = norm((0..n).map(|i| forces[i].width() / scale(i)));
        let of_matrix = norm((0..n * n).map(|k| {
            let (i, j) = (k / n, k % n);
            matrix[Shape::index(i, j)].width() / (scale(i) * scale(j))
        }));
        let of_solution = n as f64 * gamma(3 * n + 1) / (1.0 - gamma(n + 1));
        let limit = 2.0 * of_inverse * (of_forces + (of_matrix + of_solution) * size_computed);
        let scales = (0..n).map(scale).collect();
        Ok(Accuracy {
            size,
            error,
            limit,
            condition: of_h * of_inverse,
            scales,
        })
    }
}

/// `γₖ`: the bound on the relative error of k successive roundings.
fn gamma(k: usize) -> f64 {
    let k = k as f64;
    k * U / (1.0 - k * U)
}

struct State<'a> {
    t: f64,
    q: &'a [f64],
    v: &'a [f64],
    u: &'a [f64],
}

impl State<'_> {
    fn call<S: Scalar<Stored = S>>(
        &self,
        interpreter: &mut Interpreter<S>,
        role: Role,
        length: usize,
        number: impl Fn(f64) -> S,
    ) -> Result<Vec<S>, Singular> {
        let row = |row: &[f64]| row.iter().map(|&x| number(x)).collect::<Vec<S>>();
        let [q, v, u] = [self.q, self.v, self.u].map(row);
        let mut results = vec![S::ZERO; length];
        let arguments = Arguments {
            t: number(self.t),
            q: &q,
            v: &v,
            u: &u,
            a: &[],
        };
        interpreter.call(role, arguments, &mut results)?;
        Ok(results)
    }
}

fn over<S: Scalar<Stored = S>>(numbers: &[f64]) -> Vec<S> {
    numbers.iter().map(|&number| S::from_f64(number)).collect()
}

fn norm(numbers: impl Iterator<Item = f64>) -> f64 {
    numbers.map(|number| number * number).sum::<f64>().sqrt()
}

fn frobenius(matrix: &[Vec<DoubleDouble>]) -> f64 {
    norm(matrix.iter().flatten().map(|entry| entry.hi()))
}

/// The inverse of a positive definite matrix by Gauss–Jordan elimination, which needs no pivoting for such a matrix.
fn inverse(mut matrix: Vec<Vec<DoubleDouble>>) -> Vec<Vec<DoubleDouble>> {
    let n = matrix.len();
    for k in 0..n {
        let pivot = matrix[k][k];
        matrix[k][k] = DoubleDouble::ONE;
        matrix[k]
            .iter_mut()
            .for_each(|entry| *entry = *entry / pivot);
        let row = matrix[k].clone();
        for (_, other) in matrix.iter_mut().enumerate().filter(|(i, _)| *i != k) {
            let factor = other[k];
            other[k] = DoubleDouble::ZERO;
            for (entry, above) in other.iter_mut().zip(&row) {
                *entry = *entry - factor * *above;
            }
        }
    }
    matrix
}

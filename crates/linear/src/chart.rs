//! Independent numbers that describe a state near another one: the coordinates z that may be displaced freely and the rates s of
//! I, as in (E39). Dependent coordinates follow from the constraints on positions, dependent rates from all constraints.

use lagrangian::interpreted::InterpretedMachine;
use lagrangian::{Machine, System};
use lagrangian_scalar::{DoubleDouble, Dual, Scalar};
use nalgebra::{DMatrix, DVector};

use crate::reduced::{Choice, Fault, Number, Reduced, ReducedState};

/// Which numbers of a state are independent; a state holds coordinates, then rates.
#[derive(Clone, Debug)]
pub(crate) struct Chart {
    /// The number of coordinates.
    n: usize,
    /// The indices of the independent numbers of a state, coordinates before rates.
    picked: Vec<usize>,
    /// Which coordinates follow from which constraints; `None` without constraints.
    choice: Option<Choice>,
}

impl Chart {
    /// Chooses independent numbers for states near `x`; numbers that are kept are among them. A coordinate that goes on and on
    /// which nothing depends, such as the integral of a state of first order, is not one of them, but its rate is.
    ///
    /// # Errors
    /// If kept numbers depend on others, or the constraints have no rows there.
    pub fn at(
        machine: &InterpretedMachine,
        x: &DVector<f64>,
        kept: &[bool],
        goes_on: &[bool],
    ) -> Result<Chart, Fault> {
        let n = x.len() / 2;
        let system = machine.prepare();
        if system.constraints().len() == 0 && machine.program().quaternions.is_empty() {
            let places = (0..n).filter(|j| !goes_on[*j]);
            return Ok(Chart {
                n,
                picked: places.chain(n..2 * n).collect(),
                choice: None,
            });
        }
        let inputs = system.default_inputs().values;
        let q = &x.as_slice()[..n];
        let reduced = Reduced::new(machine, &system, &inputs, &[]);
        let is_kept: Vec<bool> = (0..n).map(|j| kept[j] || kept[n + j]).collect();
        let choice = reduced.choose(q, &is_kept)?;
        let mut picked = choice.places();
        picked.retain(|j| !goes_on[*j]);
        picked.sort_unstable();
        picked.extend(choice.independent.iter().map(|j| n + j));
        Ok(Chart {
            n,
            picked,
            choice: Some(choice),
        })
    }

    /// How many independent numbers a state has.
    pub fn size(&self) -> usize {
        self.picked.len()
    }

    /// The indices of these numbers in a state.
    pub fn indices(&self) -> &[usize] {
        &self.picked
    }

    /// The rank of the constraints.
    pub fn rank(&self) -> usize {
        self.choice.as_ref().map_or(0, |choice| choice.rows.len())
    }

    /// These numbers of a state, or of a difference of states.
    pub fn of(&self, x: &DVector<f64>) -> DVector<f64> {
        DVector::from_iterator(self.size(), self.picked.iter().map(|k| x[*k]))
    }

    /// The derivative of all numbers of a state by these, a column for each.
    ///
    /// # Errors
    /// If the constraints do not determine the rates there.
    pub fn spread(
        &self,
        machine: &InterpretedMachine,
        t: f64,
        x: &DVector<f64>,
    ) -> Result<DMatrix<f64>, Fault> {
        let (n, size) = (self.n, self.size());
        let Some(choice) = &self.choice else {
            return Ok(DMatrix::from_fn(2 * n, size, |i, j| {
                f64::from(i == self.picked[j])
            }));
        };
        let system = machine.prepare();
        let inputs = system.default_inputs().values;
        let mut reduced = Reduced::new(machine, &system, &inputs, &[]);
        reduced.set_time(t);
        let constant = |x: f64| Number::from_f64(x);
        let mut q: Vec<Number> = x.as_slice()[..n].iter().copied().map(constant).collect();
        let mut s: Vec<Number> = choice
            .independent
            .iter()
            .map(|j| constant(x[n + j]))
            .collect();
        let tangent = reduced.tangent(choice, &q)?;
        let places = choice.places();
        let mut spread = DMatrix::zeros(2 * n, size);
        for (column, &of) in self.picked.iter().enumerate() {
            if of < n {
                let which = places.iter().position(|place| *place == of);
                let direction = &tangent[which.unwrap_or(0)];
                for (q, d) in q.iter_mut().zip(direction) {
                    q.derivative = *d;
                }
            } else {
                let which = choice.independent.iter().position(|j| n + j == of);
                s[which.unwrap_or(0)].derivative = DoubleDouble::ONE;
            }
            let there = reduced.evaluate(choice, &q, &s)?;
            for j in 0..n {
                spread[(j, column)] = q[j].derivative.hi();
                spread[(n + j, column)] = there.rates[j].derivative.hi();
            }
            for number in q.iter_mut().chain(&mut s) {
                *number = Dual::constant(number.value);
            }
        }
        Ok(spread)
    }

    /// The state near `x` whose independent numbers differ by `step`.
    ///
    /// # Errors
    /// If the constraints cannot be met there.
    pub fn moved(
        &self,
        machine: &InterpretedMachine,
        t: f64,
        x: &DVector<f64>,
        step: &DVector<f64>,
    ) -> Result<DVector<f64>, Fault> {
        let n = self.n;
        let mut moved = x.clone();
        for (of, step) in self.picked.iter().zip(step.iter()) {
            moved[*of] += step;
        }
        let Some(choice) = &self.choice else {
            return Ok(moved);
        };
        let system = machine.prepare();
        let inputs = system.default_inputs().values;
        let mut reduced = Reduced::new(machine, &system, &inputs, &[]);
        reduced.set_time(t);
        let mut q: Vec<DoubleDouble> = moved.as_slice()[..n].iter().map(|x| (*x).into()).collect();
        reduced.project(&mut q, &|j| choice.position_dependent.contains(&j))?;
        let place = ReducedState {
            s: choice
                .independent
                .iter()
                .map(|j| moved[n + j].into())
                .collect(),
            q,
        };
        let constant = |list: &[DoubleDouble]| -> Vec<Number> {
            list.iter().copied().map(Dual::constant).collect()
        };
        let there = reduced.evaluate(choice, &constant(&place.q), &constant(&place.s))?;
        for j in 0..n {
            moved[j] = place.q[j].hi();
            moved[n + j] = there.rates[j].value.hi();
        }
        Ok(moved)
    }
}

//! Derivatives of the accelerations of an interpreted machine.

use std::vec;
use std::vec::Vec;

use lagrangian_program::{Arguments, Interpreter, Role};
use lagrangian_scalar::Dual;
use lagrangian_spec::model::Variable;

use super::named::{Label, Named};
use super::system::{InterpretedSystem, singular_row};
use crate::{Differentiate, Linearize, Pivot, Quantity, Singular};

impl Linearize for InterpretedSystem {
    fn linearize(
        &self,
        t: f64,
        q: &Vec<f64>,
        v: &Vec<f64>,
        u: &Named,
        a: &mut Vec<f64>,
        by_coordinates: &mut Vec<f64>,
        by_rates: &mut Vec<f64>,
    ) -> Result<(), Singular> {
        let n = q.len();
        if !self.program.contacts.is_empty() {
            // Sticking contacts have no linearization, and the law of sliding ones is not differentiated. Those of unilateral
            // contacts are those with all of them open, as the accelerations are.
            return Err(Singular {
                at: Pivot::NotDifferentiated(0),
                ratio: 0.0,
            });
        }
        let u = &u.values;
        if !self.program.has_linearization() {
            return self.linearize_by_duals(t, [q, v, u], a, by_coordinates, by_rates);
        }
        let width = 1 + self.program.derivatives.len();
        let mut rows = vec![0.0; n * width];
        let arguments = Arguments { t, q, v, u, a: &[] };
        self.call(Role::Derivatives, arguments, &mut rows)?;
        for (i, row) in rows.chunks_exact(width).enumerate() {
            a[i] = row[0];
            by_coordinates[i * n..][..n].copy_from_slice(&row[1..][..n]);
            by_rates[i * n..][..n].copy_from_slice(&row[1 + n..][..n]);
        }
        Ok(())
    }
}

impl Differentiate for InterpretedSystem {
    fn variables(&self) -> impl ExactSizeIterator<Item = Quantity<'_>> {
        let own = if self.program.has_linearization() {
            &self.program.derivatives[2 * self.program.dimension()..]
        } else {
            &[]
        };
        own.iter().map(|variable| {
            let Label { name, unit } = match variable {
                Variable::Coordinate(i) | Variable::Rate(i) => &self.names.coordinates[*i],
                Variable::Input(i) => &self.names.inputs[*i],
                Variable::Parameter(i) => &self.names.parameters[*i],
            };
            Quantity { name, unit }
        })
    }

    fn differentiate(
        &self,
        t: f64,
        q: &Vec<f64>,
        v: &Vec<f64>,
        u: &Named,
        a: &mut Vec<f64>,
        by_coordinates: &mut Vec<f64>,
        by_rates: &mut Vec<f64>,
        by_variables: &mut [f64],
    ) -> Result<(), Singular> {
        let n = q.len();
        if !self.program.has_linearization() {
            return self.linearize(t, q, v, u, a, by_coordinates, by_rates);
        }
        let others = self.program.derivatives.len() - 2 * n;
        let width = 1 + 2 * n + others;
        let mut rows = vec![0.0; n * width];
        let u = &u.values;
        let arguments = Arguments { t, q, v, u, a: &[] };
        self.call(Role::Derivatives, arguments, &mut rows)?;
        for (i, row) in rows.chunks_exact(width).enumerate() {
            a[i] = row[0];
            by_coordinates[i * n..][..n].copy_from_slice(&row[1..][..n]);
            by_rates[i * n..][..n].copy_from_slice(&row[1 + n..][..n]);
            let places = by_variables.iter_mut().skip(i * others);
            for (to, from) in places.zip(&row[1 + 2 * n..]) {
                *to = *from;
            }
        }
        Ok(())
    }
}

impl InterpretedSystem {
    /// The derivatives if the description does not request any: the accelerations over dual numbers, evaluated once for each
    /// coordinate and each rate.
    fn linearize_by_duals(
        &self,
        t: f64,
        state: [&[f64]; 3],
        a: &mut [f64],
        by_coordinates: &mut [f64],
        by_rates: &mut [f64],
    ) -> Result<(), Singular> {
        let duals = |values: &[f64]| -> Vec<Dual<f64>> {
            values.iter().copied().map(Dual::constant).collect()
        };
        let parameters = duals(self.running.lock().interpreter.parameters());
        let mut interpreter = Interpreter::new(&self.program, &parameters);
        let [mut q, mut v, u] = state.map(duals);
        let n = q.len();
        let mut row = vec![Dual::constant(0.0); n];
        for j in 0..2 * n {
            let is_rate = j >= n;
            let variable = if is_rate { &mut v[j - n] } else { &mut q[j] };
            variable.derivative = 1.0;
            let arguments = Arguments {
                t: Dual::constant(t),
                q: &q,
                v: &v,
                u: &u,
                a: &[],
            };
            interpreter
                .call(Role::Accelerations, arguments, &mut row)
                .map_err(|singular| singular_row(&self.program, singular))?;
            let to = if is_rate {
                &mut *by_rates
            } else {
                &mut *by_coordinates
            };
            for (i, dual) in row.iter().enumerate() {
                a[i] = dual.value;
                to[i * n + j % n] = dual.derivative;
            }
            let variable = if is_rate { &mut v[j - n] } else { &mut q[j] };
            variable.derivative = 0.0;
        }
        Ok(())
    }
}

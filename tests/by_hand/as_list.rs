//! A machine whose vectors are lists.

use super::toy::Toy;
use lagrangian::{Assumption, Quantity, Singular, System};

/// A machine of one coordinate whose vectors are `Vec<f64>`.
pub struct AsList(pub Toy<1>);

type List = Vec<f64>;

impl System for AsList {
    type Vector = List;
    type Matrix = List;
    type Coordinates = List;
    type Inputs = ();
    type Outputs = ();
    // These compile out all code that handles constraints and contacts.
    const MAY_BE_CONSTRAINED: bool = false;
    const MAY_SLIDE: bool = false;
    const MAY_COLLIDE: bool = false;

    fn coordinates(&self) -> impl ExactSizeIterator<Item = Quantity<'_>> {
        self.0.coordinates()
    }

    fn to_coordinates(&self, vector: &List) -> List {
        vector.clone()
    }

    fn to_vector(&self, coordinates: &List) -> List {
        coordinates.clone()
    }

    fn accelerations(
        &self,
        t: f64,
        q: &List,
        v: &List,
        (): &(),
        a: &mut List,
    ) -> Result<(), Singular> {
        a.copy_from_slice(&(self.0.accelerations)(t, &[q[0]], &[v[0]], 0.0, self.0.p));
        Ok(())
    }

    fn mass_matrix(&self, _: f64, _: &List, _: &mut List) {}
    fn bias(&self, _: f64, _: &List, _: &List, _: &mut List) {}
    fn applied(&self, _: f64, _: &List, _: &List, (): &(), _: &mut List) {}
    fn forces(&self, _: f64, _: &List, _: &List, (): &(), _: &mut List) {}

    fn kinetic_energy(&self, _: f64, _: &List, _: &List) -> f64 {
        0.0
    }

    fn potential_energy(&self, _: f64, _: &List, (): &()) -> f64 {
        0.0
    }

    fn dissipation(&self, _: f64, _: &List, _: &List, (): &()) -> f64 {
        0.0
    }

    fn work_rate(&self, _: f64, _: &List, _: &List, _: &List, (): &()) -> f64 {
        0.0
    }

    fn dissipation_rate(&self, _: f64, _: &List, _: &List, (): &()) -> f64 {
        0.0
    }

    fn default_inputs(&self) {}

    fn input_values(&self, (): &()) -> impl ExactSizeIterator<Item = (Quantity<'_>, f64)> {
        core::iter::empty()
    }

    fn outputs(&self, _: f64, _: &List, _: &List, _: &List, (): &()) {}

    fn output_values(&self, (): &()) -> impl ExactSizeIterator<Item = (Quantity<'_>, f64)> {
        core::iter::empty()
    }

    fn assumptions(
        &self,
        _: f64,
        _: &List,
        _: &List,
        (): &(),
    ) -> impl ExactSizeIterator<Item = Assumption<'_>> {
        core::iter::empty()
    }
}

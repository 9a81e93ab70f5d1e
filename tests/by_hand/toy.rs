// Small machines whose equations fit into a line.

use lagrangian::{Assumption, Machine, Quantity, Singular, State, System};

/// Accelerations at `(t, q, v, u, p)`.
pub type Motion<const N: usize> = fn(f64, &[f64; N], &[f64; N], f64, f64) -> [f64; N];

/// A function of the coordinates `q`.
pub type OfPlace<const N: usize> = fn(&[f64; N]) -> f64;

/// A machine of `N` coordinates, given by its functions. Its only input is
/// `u`, its only parameter `p`.
#[derive(Clone, Copy, Debug)]
pub struct Toy<const N: usize> {
    pub names: [&'static str; N],
    pub p: f64,
    pub start: ([f64; N], [f64; N]),
    pub accelerations: Motion<N>,
    /// `(q, v, p)`.
    pub kinetic_energy: fn(&[f64; N], &[f64; N], f64) -> f64,
    /// `(q, p)`.
    pub potential_energy: fn(&[f64; N], f64) -> f64,
    /// `(t, q, v, u, p)`.
    pub work_rate: fn(f64, &[f64; N], &[f64; N], f64, f64) -> f64,
    /// `(v, p)`.
    pub dissipation_rate: fn(&[f64; N], f64) -> f64,
    /// A quantity that must stay above 0, as text and as a function of `q`.
    pub assumption: Option<(&'static str, OfPlace<N>)>,
    /// A function of `q` that stands for the inertia: `1 / M` is infinite where it is 0.
    pub inertia: OfPlace<N>,
}

impl<const N: usize> Toy<N> {
    pub fn new(start: ([f64; N], [f64; N]), accelerations: Motion<N>) -> Self {
        const NAMES: [&str; 8] = ["x", "y", "z", "x4", "x5", "x6", "x7", "x8"];
        Self {
            names: core::array::from_fn(|i| NAMES[i % 8]),
            p: 1.0,
            start,
            accelerations,
            kinetic_energy: |_, v, _| 0.5 * v.iter().map(|v| v * v).sum::<f64>(),
            potential_energy: |_, _| 0.0,
            work_rate: |_, _, _, _, _| 0.0,
            dissipation_rate: |_, _| 0.0,
            assumption: None,
            inertia: |_| 1.0,
        }
    }

    pub fn start(&self) -> State<[f64; N]> {
        State {
            t: 0.0,
            q: self.start.0,
            v: self.start.1,
        }
    }
}

impl<const N: usize> Machine for Toy<N> {
    type System = Self;

    fn name(&self) -> &str {
        "Toy"
    }

    fn parameters(&self) -> impl ExactSizeIterator<Item = (Quantity<'_>, f64)> {
        [(
            Quantity {
                name: "p",
                unit: "1",
            },
            self.p,
        )]
        .into_iter()
    }

    fn prepare(&self) -> Self {
        *self
    }

    fn start(&self) -> State<[f64; N]> {
        Toy::start(self)
    }
}

impl<const N: usize> System for Toy<N> {
    type Vector = [f64; N];
    type Matrix = [f64; 0];
    type Coordinates = [f64; N];
    type Inputs = f64;
    type Outputs = ();
    // These compile out all code that handles constraints and contacts.
    const MAY_BE_CONSTRAINED: bool = false;
    const MAY_SLIDE: bool = false;
    const MAY_COLLIDE: bool = false;

    fn coordinates(&self) -> impl ExactSizeIterator<Item = Quantity<'_>> {
        self.names.iter().map(|name| Quantity { name, unit: "m" })
    }

    fn to_coordinates(&self, vector: &[f64; N]) -> [f64; N] {
        *vector
    }

    fn to_vector(&self, coordinates: &[f64; N]) -> [f64; N] {
        *coordinates
    }

    fn accelerations(
        &self,
        t: f64,
        q: &[f64; N],
        v: &[f64; N],
        u: &f64,
        a: &mut [f64; N],
    ) -> Result<(), Singular> {
        if (self.inertia)(q) == 0.0 {
            return Err(Singular::new(N - 1, 0.0, 1.0));
        }
        *a = (self.accelerations)(t, q, v, *u, self.p);
        Ok(())
    }

    fn mass_matrix(&self, _: f64, _: &[f64; N], _: &mut [f64; 0]) {}
    fn bias(&self, _: f64, _: &[f64; N], _: &[f64; N], _: &mut [f64; N]) {}
    fn applied(&self, _: f64, _: &[f64; N], _: &[f64; N], _: &f64, _: &mut [f64; N]) {}
    fn forces(&self, _: f64, _: &[f64; N], _: &[f64; N], _: &f64, _: &mut [f64; N]) {}

    fn kinetic_energy(&self, _: f64, q: &[f64; N], v: &[f64; N]) -> f64 {
        (self.kinetic_energy)(q, v, self.p)
    }

    fn potential_energy(&self, _: f64, q: &[f64; N], _: &f64) -> f64 {
        (self.potential_energy)(q, self.p)
    }

    fn dissipation(&self, _: f64, _: &[f64; N], v: &[f64; N], _: &f64) -> f64 {
        0.5 * (self.dissipation_rate)(v, self.p)
    }

    fn work_rate(&self, t: f64, q: &[f64; N], v: &[f64; N], _: &[f64; N], u: &f64) -> f64 {
        (self.work_rate)(t, q, v, *u, self.p)
    }

    fn dissipation_rate(&self, _: f64, _: &[f64; N], v: &[f64; N], _: &f64) -> f64 {
        (self.dissipation_rate)(v, self.p)
    }

    fn default_inputs(&self) -> f64 {
        0.0
    }

    fn input_values(&self, u: &f64) -> impl ExactSizeIterator<Item = (Quantity<'_>, f64)> {
        [(
            Quantity {
                name: "u",
                unit: "N",
            },
            *u,
        )]
        .into_iter()
    }

    fn outputs(&self, _: f64, _: &[f64; N], _: &[f64; N], _: &[f64; N], _: &f64) {}

    fn output_values(&self, (): &()) -> impl ExactSizeIterator<Item = (Quantity<'_>, f64)> {
        core::iter::empty()
    }

    fn assumptions(
        &self,
        _: f64,
        q: &[f64; N],
        _: &[f64; N],
        _: &f64,
    ) -> impl ExactSizeIterator<Item = Assumption<'_>> {
        let assumption = self.assumption.map(|(text, margin)| Assumption {
            text,
            margin: margin(q),
            strict: true,
        });
        assumption.into_iter()
    }
}

/// `x'' = -p² x`.
pub fn oscillator() -> Toy<1> {
    Toy {
        potential_energy: |q, p| 0.5 * p * p * q[0] * q[0],
        ..Toy::new(([1.0], [0.0]), |_, q, _, _, p| [-p * p * q[0]])
    }
}

/// Mathematical pendulum of angular frequency `p`: `x'' = -p² sin x`.
pub fn pendulum(amplitude: f64) -> Toy<1> {
    Toy {
        potential_energy: |q, p| -p * p * q[0].cos(),
        ..Toy::new(([amplitude], [0.0]), |_, q, _, _, p| [-p * p * q[0].sin()])
    }
}

/// Free fall by 9.81 m/s² from height 2 m.
pub fn ball() -> Toy<1> {
    Toy {
        potential_energy: |q, _| 9.81 * q[0],
        ..Toy::new(([2.0], [0.0]), |_, _, _, _, _| [-9.81])
    }
}

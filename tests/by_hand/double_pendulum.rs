// A double pendulum typed in by hand: the code that `machine!`
// generates, as a person would write it.

use lagrangian::{Assumption, Machine, Quantity, Singular, State, System};

/// Two point masses on massless rods in a vertical plane; angles from the downward vertical.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DoublePendulum {
    /// Mass of the upper bob, in kg.
    pub m1: f64,
    /// Mass of the lower bob, in kg.
    pub m2: f64,
    /// Length of the upper rod, in m.
    pub l1: f64,
    /// Length of the lower rod, in m.
    pub l2: f64,
    /// Acceleration of gravity, in m/s².
    pub g: f64,
}

impl Default for DoublePendulum {
    fn default() -> Self {
        Self {
            m1: 1.0,
            m2: 1.0,
            l1: 1.0,
            l2: 1.0,
            g: 9.81,
        }
    }
}

/// The coordinates of [`DoublePendulum`], and their rates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DoublePendulumCoordinates {
    /// Angle of the upper rod, in rad.
    pub theta1: f64,
    /// Angle of the lower rod, in rad.
    pub theta2: f64,
}

/// The inputs of [`DoublePendulum`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DoublePendulumInputs {
    /// Torque on the upper rod, in N m.
    pub torque: f64,
}

/// The outputs of [`DoublePendulum`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DoublePendulumOutputs {
    /// Height of the lower bob over the hinge, in m.
    pub height: f64,
}

/// The equations of motion of [`DoublePendulum`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DoublePendulumSystem {
    parameters: DoublePendulum,
    /// (m₁ + m₂) l₁²
    m11: f64,
    /// m₂ l₁ l₂
    m12: f64,
    /// m₂ l₂²
    m22: f64,
}

const COORDINATES: [Quantity<'static>; 2] = [
    Quantity {
        name: "theta1",
        unit: "rad",
    },
    Quantity {
        name: "theta2",
        unit: "rad",
    },
];

impl Machine for DoublePendulum {
    type System = DoublePendulumSystem;

    fn name(&self) -> &str {
        "DoublePendulum"
    }

    fn parameters(&self) -> impl ExactSizeIterator<Item = (Quantity<'_>, f64)> {
        [
            (
                Quantity {
                    name: "m1",
                    unit: "kg",
                },
                self.m1,
            ),
            (
                Quantity {
                    name: "m2",
                    unit: "kg",
                },
                self.m2,
            ),
            (
                Quantity {
                    name: "l1",
                    unit: "m",
                },
                self.l1,
            ),
            (
                Quantity {
                    name: "l2",
                    unit: "m",
                },
                self.l2,
            ),
            (
                Quantity {
                    name: "g",
                    unit: "m/s^2",
                },
                self.g,
            ),
        ]
        .into_iter()
    }

    fn prepare(&self) -> DoublePendulumSystem {
        DoublePendulumSystem {
            parameters: *self,
            m11: (self.m1 + self.m2) * self.l1 * self.l1,
            m12: self.m2 * self.l1 * self.l2,
            m22: self.m2 * self.l2 * self.l2,
        }
    }

    fn start(&self) -> State<DoublePendulumCoordinates> {
        State {
            t: 0.0,
            q: DoublePendulumCoordinates {
                theta1: 0.1,
                theta2: 0.0,
            },
            v: DoublePendulumCoordinates {
                theta1: 0.0,
                theta2: 0.0,
            },
        }
    }
}

impl System for DoublePendulumSystem {
    type Vector = [f64; 2];
    type Matrix = [f64; 4];
    type Coordinates = DoublePendulumCoordinates;
    type Inputs = DoublePendulumInputs;
    type Outputs = DoublePendulumOutputs;
    // These compile out all code that handles constraints and contacts.
    const MAY_BE_CONSTRAINED: bool = false;
    const MAY_SLIDE: bool = false;
    const MAY_COLLIDE: bool = false;

    fn coordinates(&self) -> impl ExactSizeIterator<Item = Quantity<'_>> {
        COORDINATES.iter().copied()
    }

    fn to_coordinates(&self, &[theta1, theta2]: &[f64; 2]) -> DoublePendulumCoordinates {
        DoublePendulumCoordinates { theta1, theta2 }
    }

    fn to_vector(&self, q: &DoublePendulumCoordinates) -> [f64; 2] {
        [q.theta1, q.theta2]
    }

    #[inline]
    fn accelerations(
        &self,
        _t: f64,
        &[theta1, theta2]: &[f64; 2],
        &[v1, v2]: &[f64; 2],
        u: &DoublePendulumInputs,
        a: &mut [f64; 2],
    ) -> Result<(), Singular> {
        let DoublePendulum { m1, m2, l1, l2, g } = self.parameters;
        let (sin, cos) = (theta1 - theta2).sin_cos();
        let m12 = self.m12 * cos;
        let f1 = u.torque - self.m12 * sin * v2 * v2 - (m1 + m2) * g * l1 * theta1.sin();
        let f2 = self.m12 * sin * v1 * v1 - m2 * g * l2 * theta2.sin();
        let determinant = self.m11 * self.m22 - m12 * m12;
        // Twice the round-off of the difference.
        if determinant.abs() <= f64::EPSILON * (self.m11 * self.m22).abs() {
            return Err(Singular::new(1, determinant, self.m11 * self.m22));
        }
        *a = [
            (f1 * self.m22 - m12 * f2) / determinant,
            (self.m11 * f2 - m12 * f1) / determinant,
        ];
        Ok(())
    }

    fn mass_matrix(&self, _t: f64, &[theta1, theta2]: &[f64; 2], matrix: &mut [f64; 4]) {
        let m12 = self.m12 * (theta1 - theta2).cos();
        *matrix = [self.m11, m12, m12, self.m22];
    }

    fn bias(&self, _t: f64, &[theta1, theta2]: &[f64; 2], &[v1, v2]: &[f64; 2], h: &mut [f64; 2]) {
        let sin = (theta1 - theta2).sin();
        *h = [self.m12 * sin * v2 * v2, -self.m12 * sin * v1 * v1];
    }

    fn applied(
        &self,
        _t: f64,
        &[theta1, theta2]: &[f64; 2],
        _v: &[f64; 2],
        u: &DoublePendulumInputs,
        applied: &mut [f64; 2],
    ) {
        let DoublePendulum { m1, m2, l1, l2, g } = self.parameters;
        *applied = [
            u.torque - (m1 + m2) * g * l1 * theta1.sin(),
            -m2 * g * l2 * theta2.sin(),
        ];
    }

    fn forces(
        &self,
        t: f64,
        q: &[f64; 2],
        v: &[f64; 2],
        u: &DoublePendulumInputs,
        forces: &mut [f64; 2],
    ) {
        let mut bias = [0.0; 2];
        self.bias(t, q, v, &mut bias);
        self.applied(t, q, v, u, forces);
        forces[0] -= bias[0];
        forces[1] -= bias[1];
    }

    fn kinetic_energy(&self, _t: f64, &[theta1, theta2]: &[f64; 2], &[v1, v2]: &[f64; 2]) -> f64 {
        0.5 * self.m11 * v1 * v1
            + self.m12 * (theta1 - theta2).cos() * v1 * v2
            + 0.5 * self.m22 * v2 * v2
    }

    fn potential_energy(
        &self,
        _t: f64,
        &[theta1, theta2]: &[f64; 2],
        _u: &DoublePendulumInputs,
    ) -> f64 {
        let DoublePendulum { m1, m2, l1, l2, g } = self.parameters;
        -(m1 + m2) * g * l1 * theta1.cos() - m2 * g * l2 * theta2.cos()
    }

    fn dissipation(&self, _: f64, _: &[f64; 2], _: &[f64; 2], _: &DoublePendulumInputs) -> f64 {
        0.0
    }

    fn work_rate(
        &self,
        _t: f64,
        _q: &[f64; 2],
        v: &[f64; 2],
        _a: &[f64; 2],
        u: &DoublePendulumInputs,
    ) -> f64 {
        u.torque * v[0]
    }

    fn dissipation_rate(
        &self,
        _: f64,
        _: &[f64; 2],
        _: &[f64; 2],
        _: &DoublePendulumInputs,
    ) -> f64 {
        0.0
    }

    fn default_inputs(&self) -> DoublePendulumInputs {
        DoublePendulumInputs { torque: 0.0 }
    }

    fn input_values(
        &self,
        u: &DoublePendulumInputs,
    ) -> impl ExactSizeIterator<Item = (Quantity<'_>, f64)> {
        [(
            Quantity {
                name: "torque",
                unit: "N*m",
            },
            u.torque,
        )]
        .into_iter()
    }

    fn outputs(
        &self,
        _t: f64,
        &[theta1, theta2]: &[f64; 2],
        _v: &[f64; 2],
        _a: &[f64; 2],
        _u: &DoublePendulumInputs,
    ) -> DoublePendulumOutputs {
        let DoublePendulum { l1, l2, .. } = self.parameters;
        DoublePendulumOutputs {
            height: -l1 * theta1.cos() - l2 * theta2.cos(),
        }
    }

    fn output_values(
        &self,
        outputs: &DoublePendulumOutputs,
    ) -> impl ExactSizeIterator<Item = (Quantity<'_>, f64)> {
        [(
            Quantity {
                name: "height",
                unit: "m",
            },
            outputs.height,
        )]
        .into_iter()
    }

    fn assumptions(
        &self,
        _t: f64,
        _q: &[f64; 2],
        _v: &[f64; 2],
        _u: &DoublePendulumInputs,
    ) -> impl ExactSizeIterator<Item = Assumption<'_>> {
        core::iter::empty()
    }
}

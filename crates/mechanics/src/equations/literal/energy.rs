//! Kinetic and potential energy and dissipation, literally.

use super::angle;
use super::values::Values;
use super::vector;
use lagrangian_scalar::Scalar;
use lagrangian_spec::model::element::Energy;
use lagrangian_spec::model::{Inertia, Model, Rotation};

/// `T`, `V` and `D`.
pub(super) fn energies_of<S: Scalar>(model: &Model<'_>, x: &Values<'_, S>) -> [S; 3] {
    [
        kinetic_energy(model, x),
        potential_energy(model, x),
        dissipation(model, x),
    ]
}

/// `½ Σ m ẋ·ẋ + ½ Σ ωᵀI ω`, with the angular velocity of (E9).
pub(super) fn kinetic_energy<S: Scalar>(model: &Model<'_>, x: &Values<'_, S>) -> S {
    let mut twice_the_energy = S::ZERO;
    for body in &model.bodies {
        let mut square = S::ZERO;
        for &at in &body.at {
            let rate = x.rate(at);
            square = square + rate * rate;
        }
        twice_the_energy = twice_the_energy + x.value(body.mass) * square;
        match (&body.inertia, &body.rotation) {
            (&Inertia::Planar(inertia), _) => {
                if let Some(angle) = angle(model, body) {
                    let rate = x.rate(angle);
                    twice_the_energy = twice_the_energy + x.value(inertia) * rate * rate;
                }
            }
            (Inertia::Tensor(tensor), &Rotation::Frame(pose)) => {
                let e = &model.poses[pose.index()].axes;
                let dot = |k: usize, l: usize| {
                    let mut sum = S::ZERO;
                    for (&a, &b) in e[k].iter().zip(&e[l]) {
                        sum = sum + x.value(a) * x.rate(b);
                    }
                    sum
                };
                let w = [dot(2, 1), dot(0, 2), dot(1, 0)];
                let [xx, yy, zz, xy, xz, yz] = vector::value(x.vector(tensor));
                let twice = |e| e + e;
                twice_the_energy = twice_the_energy
                    + xx * w[0] * w[0]
                    + yy * w[1] * w[1]
                    + zz * w[2] * w[2]
                    + twice(xy * w[0] * w[1])
                    + twice(xz * w[0] * w[2])
                    + twice(yz * w[1] * w[2]);
            }
            (Inertia::Particle | Inertia::Tensor(_), _) => {}
        }
    }
    twice_the_energy * S::from_ratio(1, 2)
}

/// `Σ ½ c s² + Σ U − Σ m g·x`.
pub(super) fn potential_energy<S: Scalar>(model: &Model<'_>, x: &Values<'_, S>) -> S {
    let half = S::from_ratio(1, 2);
    let mut energy = S::ZERO;
    for stored in model.stored() {
        energy = energy
            + match stored {
                Energy::Quadratic(of) => {
                    let deformation = x.value(of.measure);
                    half * x.value(of.coefficient) * deformation * deformation
                }
                Energy::Given(value) => x.value(*value),
            };
    }
    if let Some(gravity) = model.gravity() {
        for body in &model.bodies {
            let mut along = S::ZERO;
            for (&g, &at) in gravity.iter().zip(&body.at) {
                along = along + x.value(g) * x.value(at);
            }
            energy = energy - x.value(body.mass) * along;
        }
    }
    energy
}

/// `Σ ½ b ṡ² + Σ R`.
pub(super) fn dissipation<S: Scalar>(model: &Model<'_>, x: &Values<'_, S>) -> S {
    let half = S::from_ratio(1, 2);
    let mut dissipation = S::ZERO;
    for dissipated in model.dissipated() {
        dissipation = dissipation
            + match dissipated {
                Energy::Quadratic(of) => {
                    let rate = x.rate(of.measure);
                    half * x.value(of.coefficient) * rate * rate
                }
                Energy::Given(value) => x.value(*value),
            };
    }
    dissipation
}

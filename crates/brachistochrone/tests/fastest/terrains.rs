//! The machines of these tests as one type. The search is generic over the machine, and would be compiled for each of them.

use lagrangian_brachistochrone::Unsolved;
use lagrangian_brachistochrone::direct::{self, Sought, Terrain};
use lagrangian_scalar::Scalar;

use crate::direct::friction::Whole;
use crate::direct::hill::Hill;
use crate::direct::{Central, Drag, Polar, Ridge, Scaled, Skew, Wire};
use crate::level::{Particle, Weight};

/// Any of them.
#[derive(Clone, Debug)]
pub enum Any {
    Central(Central),
    Drag(Drag),
    Hill(Hill),
    Particle(Particle),
    Polar(Polar),
    Ridge(Ridge),
    Scaled(Scaled),
    Skew(Skew),
    Weight(Weight),
    Whole(Whole),
    Wire(Wire),
}

/// Calls of the machine that it is.
macro_rules! of_each {
    ($($machine:ident)*) => {
        impl Terrain for Any {
            fn coordinates(&self) -> usize {
                match self {
                    $(Any::$machine(machine) => machine.coordinates(),)*
                }
            }
            fn inertia<N: Scalar>(&self, q: &[N]) -> Vec<N> {
                match self {
                    $(Any::$machine(machine) => machine.inertia(q),)*
                }
            }
            fn resistance<N: Scalar>(&self, q: &[N], v: &[N]) -> Vec<N> {
                match self {
                    $(Any::$machine(machine) => machine.resistance(q, v),)*
                }
            }
            fn with_friction(&self, share: f64) -> Option<Any> {
                match self {
                    $(Any::$machine(machine) => machine.with_friction(share).map(Any::$machine),)*
                }
            }
        }
        $(
            impl From<$machine> for Any {
                fn from(machine: $machine) -> Any {
                    Any::$machine(machine)
                }
            }
        )*
    };
}

of_each!(Central Drag Hill Particle Polar Ridge Scaled Skew Weight Whole Wire);

/// The fastest motion, by the default search.
pub fn solve(machine: impl Into<Any>, from: &[f64], to: &[f64]) -> Result<Sought<Any>, Unsolved> {
    direct::solve(machine.into(), from, to)
}

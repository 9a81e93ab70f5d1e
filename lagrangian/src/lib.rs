//! Integrates the equations of motion that `machine!` derives.
//!
//! ```
//! # #[cfg(all(feature = "std", feature = "macros"))]
//! # mod program {
//! use lagrangian::Simulation;
//!
//! lagrangian::machine! {
//!     /// A block on a spring.
//!     machine Oscillator in plane {
//!         parameters { m: kg = 2, k: N/m = 8 }
//!         coordinates { x: m = 0.1 }
//!         bodies { block { mass: m, at: (x, 0) } }
//!         springs { spring { stiffness: k, stretch: x } }
//!     }
//! }
//!
//! # pub
//! fn main() -> Result<(), lagrangian::Error> {
//!     let oscillator = Oscillator { k: 18.0, ..Default::default() };
//!     let run = Simulation::new(&oscillator).until(5.0).run(oscillator.start())?;
//!     let exact = 0.1 * (18.0_f64 / 2.0).sqrt().cos(); // x = x₀ cos √(k/m) t at t = 1
//!     assert!((run.at(1.0)?.q.x - exact).abs() < 1e-8);
//!     Ok(())
//! }
//! # }
//! # #[cfg(all(feature = "std", feature = "macros"))]
//! # fn main() -> Result<(), lagrangian::Error> { program::main() }
//! # #[cfg(not(all(feature = "std", feature = "macros")))]
//! # fn main() {}
//! ```
//!
//! The macro derives the equations of motion while the crate compiles. A spec can also be a file of its own,
//! `machine!(file = "machines/oscillator.machine")`, which the command `lagrangian` runs as it is. The tutorial, the language reference
//! and the equations are in `docs/`.
//!
//! The macro emits a struct with a public field for each parameter, which implements [`Machine`]; its [`prepare`](Machine::prepare) returns
//! a [`System`], the equations of motion for these parameters. [`Simulation`] integrates them and returns a [`Solution`]: the state at
//! every instant, events, and the energy balance. A [`Stepper`] takes single steps and needs no allocator.
//!
//! | feature | |
//! | --- | --- |
//! | `std` (default) | simulations, solutions, events, the implicit method `radau5`; without it the crate allocates nothing and needs no operating system |
//! | `macros` (default) | `machine!` |
//! | `interpreter` | specs that are read at run time |
//! | `jit` | specs that are read at run time, at compiled speed: they are compiled to machine code while the program runs |
//! | `strict-libm` | the same bits on every machine: no fused multiply-add, `libm`'s sines |
//! | `nalgebra` | vectors and matrices of that crate at the interface |
//! | `serde` | serialization of states, solutions, statistics, events, balances and messages |
#![no_std]

#[cfg(feature = "macros")]
pub use lagrangian_macros::machine;
#[doc(inline)]
pub use lagrangian_runtime::*;

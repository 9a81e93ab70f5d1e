//! The source text of modules of this crate, for libraries that are compiled from a single file.

/// Sines and cosines of several angles.
pub const CIRCULAR: &str = include_str!("circular.rs");
/// The parts that all functions for speed share.
pub const FAST_FUNCTION: &str = include_str!("fast_function.rs");
/// Numbers side by side.
pub const LANES: &str = include_str!("lanes.rs");
/// Numbers side by side, each with the arithmetic of one.
pub const PLAIN: &str = include_str!("plain.rs");
/// Registers.
pub const REGISTER: &str = include_str!("register.rs");
/// Sine and cosine.
pub const SINCOS: &str = include_str!("sincos.rs");
/// Vectors of registers.
pub const VECTOR: &str = include_str!("vector.rs");
/// Instructions of x86-64.
pub const X86: &str = include_str!("x86.rs");

//! Hash-consed expressions with exact coefficients.
//!
//! This crate is algebra only: it knows symbols, sums, products and functions, but nothing of
//! mechanics or of specs.
//!
//! ```
//! use lagrangian_symbolic::{Dag, Stage};
//!
//! let dag = Dag::new();
//! let m = dag.symbol("m", Stage::PARAMETER);
//! let v = dag.symbol("v", Stage(4));
//! let kinetic = m * v.square() / 2;
//! let momentum = kinetic.diff(v.as_symbol().expect("v is a symbol"));
//! assert_eq!(momentum, m * v);
//! ```
//!
//! - [`Dag`] holds all expressions; [`Expr`] is a handle that has the usual operators. Equal
//!   expressions are one node.
//! - [`dag`] describes what is simplified during construction; nothing is expanded unless the
//!   caller asks for it.
//! - [`Tangent`], [`reverse`] and [`substitute`] visit each node of a graph once, so shared parts
//!   stay shared.
//! - [`evaluate()`] gives numbers of any type, from `f64` to a prime field that proves identities.
//! - [`text`], [`latex`] and [`mathml`] write expressions down, [`normal`] multiplies out, compares
//!   and collects.

pub mod dag;
pub mod normal;
pub mod print;
pub mod sorting;

mod arena;
mod calculus;
mod construct;
mod evaluate;
mod expr;
mod measure;
mod node;
mod null_space;
mod rational;

pub use calculus::{Tangent, reverse, substitute};
pub use dag::{Dag, Expr, reachable};
pub use evaluate::{Evaluation, evaluate, evaluation_work, nearest};
pub use node::{Function, Id, Node, Stage, Symbol};
pub use null_space::null_space;
pub use print::{
    Math, Names, latex, latex_name, latex_words, markup_words, math, math_as_built, math_name,
    mathml, mathml_name, text,
};
pub use rational::{MAX_BITS, Rational};

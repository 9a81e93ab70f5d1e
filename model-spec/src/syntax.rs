//! The syntax tree of a spec, and its parser.
//!
//! Nothing is looked up here. Unknown names, conflicting units or huge families are detected by the next stage.
//!
//! The tokens are those of Rust (see [`token`](crate::token)), so that a file and the inside of
//! `machine! { … }` are the same text. In the grammar, `[x]` is optional, `{x}` repeats, and
//! `list(x)` is `[x {"," x} [","]]`. Documentation, `/// …`, may stand before every `item`, `fact`,
//! `print` and `entry`.
//!
//! ```text
//! source      = machine
//! machine     = "machine" NAME {"in" ("plane" | "space") | "extends" TEXT} "{" {entry} "}"
//! entry       = quantities | values | records | constraints | assume | approximations
//!             | derivatives | stages | methods | charts | keep | brachistochrone | gravity | published | remove
//!
//! quantities  = ("parameters" | "constants" | "coordinates" | "inputs" | "outputs")
//!               "{" list(declared [":" unit] ["=" expression]) "}"
//!             | "coordinates" "{" list("der" "(" declared ")" ":" unit "=" expression) "}"
//!             | "states" "{" list(declared ":" unit ["=" expression]
//!                                 | "der" "(" declared ")" [":" unit] "=" expression) "}"
//! values      = ("define" | "frames") "{" list(declared "=" expression) "}"
//!             | ("potentials" | "dissipations" | "energies" | "losses") "{" list(declared ":" expression) "}"
//! records     = ("bodies" | "rotors" | "springs" | "torsion_springs" | "dampers" | "bushings" | "stops"
//!               | "forces" | "torques" | "actuators" | "drag" | "transmissions" | "ropes"
//!               | "wheels" | "sliding" | "circles" | "spheres" | "rolling" | "contacts") "{" list(declared record) "}"
//! record      = "{" list(NAME ":" expression) "}"
//! constraints = "constraints" "{" list(declared ":" equation) "}"
//! assume      = "assume" "{" list(fact) "}"
//! fact        = expression (">" | ">=" | "<" | "<=") expression ["for" range]
//! approximations = "approximations" "{" list(declared ":" ("frozen" | "small")) "}"
//! derivatives = "derivatives" "{" list(declared) "}"
//! stages      = "stages" "{" list(declared) "}"
//! methods     = "methods" "{" list(declared) "}"
//! charts      = "charts" "{" list(declared ":" "polar" pair "|" "cartesian" pair) "}"
//! pair        = "(" NAME "," NAME ")"
//! keep        = "keep" "{" list(start) "}"
//! start       = declared | "der" "(" declared ")"
//! brachistochrone = "brachistochrone" "{" list(declared "=" expression) "}"
//! gravity     = "gravity" (expression | "none") ";"
//! published   = "published" TEXT "{" list(print) "}"
//! print       = ("potential_energy" | "dissipation" | "kinetic_energy" [declared]
//!               | ("position" | "velocity" | "force" | "friction") declared) "=" expression
//!             | "equation" declared ":" equation
//! remove      = "remove" SECTION ["." declared] ";" | "remove" "keep" "." start ";"
//!
//! declared    = NAME ["[" (expression | expression ".." expression | range) "]"]
//! range       = NAME "in" expression ".." expression
//! equation    = expression "=" expression
//!
//! expression  = product {("+" | "-") product}
//! product     = signed {("*" | "/") signed}
//! signed      = "-" signed | power
//! power       = chain ["^" signed]
//! chain       = operand {"." NAME ["(" list(expression) ")"]}
//! operand     = NUMBER | NAME ["[" expression "]"] | NAME "(" list(expression) ")"
//!             | "(" list(expression) ")" | "table" "(" TEXT "," expression ["," "hold"] ")"
//!
//! unit        = factor {("*" | "/") factor}
//! factor      = ("1" | NAME | "(" unit ")") ["^" (["-"] NUMBER | "(" ["-"] NUMBER ["/" "2"] ")")]
//! ```
//!
//! A parameter, a coordinate, a state, an input and an output need a unit; a constant and an output need a value.
//! [`SectionKind::fields`] lists the fields of a record. The sections of elements in the grammar are
//! those of the list that the parser receives, see [`Section`].

mod ast;
mod brackets;
mod expression;
mod item;
mod machine;
mod parse;
mod section;
mod unit;

/// The advice for a branch.
pub(crate) const NO_BRANCHES: &str =
    "expressions have no branches: write them with `max`, `min`, `abs` or `sign`";

/// The coordinate whose rate has this name.
pub(crate) fn coordinate_of_rate(name: &str) -> Option<&str> {
    name.strip_prefix("der(")?.strip_suffix(')')
}

pub(crate) use crate::unit::rate_name;
pub use ast::*;
pub use expression::NESTING_LIMIT;
pub use section::{Form, Section};

//! What a spec says, as written: the syntax tree, and the parser that makes it.
//!
//! Nothing is looked up here. Names may be unknown, units may disagree, a family may be huge; that
//! is for the stage after this one to find.
//!
//! The tokens are Rust's (see [`token`](crate::token)), so that a file and the inside of
//! `machine! { … }` are the same text. In the grammar, `[x]` may be left out, `{x}` repeats, and
//! `list(x)` is `[x {"," x} [","]]`. Documentation, `/// …`, may stand before every `item`, `fact`,
//! `print` and `entry`.
//!
//! ```text
//! source      = machine
//! machine     = "machine" NAME {"in" ("plane" | "space") | "extends" TEXT} "{" {entry} "}"
//! entry       = quantities | values | records | constraints | assume | approximations
//!             | derivatives | stages | methods | keep | brachistochrone | gravity | published | remove
//!
//! quantities  = ("parameters" | "constants" | "coordinates" | "inputs" | "outputs")
//!               "{" list(declared [":" unit] ["=" expression]) "}"
//!             | "coordinates" "{" list("der" "(" declared ")" ":" unit "=" expression) "}"
//!             | "states" "{" list(declared ":" unit ["=" expression]
//!                                 | "der" "(" declared ")" [":" unit] "=" expression) "}"
//! values      = ("define" | "frames") "{" list(declared "=" expression) "}"
//!             | ("potentials" | "dissipations") "{" list(declared ":" expression) "}"
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
//! factor      = ("1" | NAME | "(" unit ")") ["^" ["-"] NUMBER]
//! ```
//!
//! A parameter, a coordinate, an input and an output need their unit, a constant and an output
//! their value. Which fields a record may have says [`SectionKind::fields`]. Of the
//! sections whose items are elements the grammar shows those that there are: the parser is given their
//! list, see [`Section`].

mod ast;
mod brackets;
mod expression;
mod item;
mod machine;
mod parse;
mod section;
mod unit;

/// What to write instead of a branch.
pub(crate) const NO_BRANCHES: &str =
    "expressions have no branches: write them with `max`, `min`, `abs` or `sign`";

/// The coordinate whose rate has a name.
pub(crate) fn coordinate_of_rate(name: &str) -> Option<&str> {
    name.strip_prefix("der(")?.strip_suffix(')')
}

pub(crate) use crate::unit::rate_name;
pub use ast::*;
pub use expression::NESTING_LIMIT;
pub use section::{Form, Section};

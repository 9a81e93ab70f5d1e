//! The types of a module, and the fields of its structs.

use std::collections::BTreeMap;

use crate::layout::Layout;
use crate::names::{Field, Scope, fields, identifier, paths};
use lagrangian_program::quantity::Extent;
use lagrangian_program::{Role, Slot};

/// The emitted names, chosen not to collide with the user's machine.
#[derive(Clone)]
pub(super) struct Types {
    /// The machine itself.
    pub(super) machine: String,
    pub(super) coordinates: String,
    pub(super) inputs: String,
    pub(super) outputs: String,
    pub(super) prepared: String,
    /// The module of the second chart.
    pub(super) chart: String,
    /// Accelerations with their derivatives.
    pub(super) derivatives: String,
    /// For each function that is called often, the type of its call and the names of its pieces.
    pub(super) calls: BTreeMap<Role, [String; 2]>,
    /// The type of a call of the Taylor series, and the lists that it keeps from order to order.
    pub(super) series: String,
    pub(super) lists: String,
    /// The types of the values that stages of the accelerations pass on.
    pub(super) at_time: String,
    pub(super) at_position: String,
    /// The type parameter of the number.
    pub(super) scalar: String,
    /// The type parameter of another number.
    pub(super) other: String,
    /// The type parameter of the number in a register.
    pub(super) register: String,
    /// The name of the machine: if it is `f64`, `usize`, `Result` or the like, that is written by its full path.
    pub(super) shadowed: String,
}

impl Types {
    pub(super) fn new(machine: &str) -> Types {
        let mut scope = Scope::with(&[machine]);
        Types {
            machine: identifier(machine),
            coordinates: scope.take("Coordinates"),
            inputs: scope.take("Inputs"),
            outputs: scope.take("Outputs"),
            prepared: scope.take("Prepared"),
            chart: scope.take("cartesian"),
            derivatives: scope.take("Derivatives"),
            series: scope.take("Series"),
            lists: scope.take("Lists"),
            at_time: scope.take("AtTime"),
            at_position: scope.take("AtPosition"),
            calls: calls(&mut scope),
            scalar: scope.take("S"),
            other: scope.take("R"),
            register: scope.take("N"),
            shadowed: machine.to_owned(),
        }
    }

    /// A name of the standard prelude, by its full path where the machine hides it.
    pub(super) fn known(&self, name: &'static str) -> String {
        if name != self.shadowed {
            return name.to_owned();
        }
        match name {
            "Result" => "::core::result::Result".into(),
            "Option" => "::core::option::Option".into(),
            "Default" => "::core::default::Default".into(),
            "Copy" => "::core::marker::Copy".into(),
            "Fn" => "::core::ops::Fn".into(),
            "FnOnce" => "::core::ops::FnOnce".into(),
            "ExactSizeIterator" => "::core::iter::ExactSizeIterator".into(),
            _ => format!("::core::primitive::{name}"),
        }
    }
}

/// `AccelerationsAt` for `accelerations_at`; `AtTimeCall` where a result type has that name.
fn calls(scope: &mut Scope) -> BTreeMap<Role, [String; 2]> {
    let fast = Role::all().filter(|role| role.is_fast());
    fast.map(|role| {
        let row = role.row();
        let words = row.name.split('_').map(|word| {
            let (first, rest) = word.split_at(word.len().min(1));
            first.to_uppercase() + rest
        });
        let name: String = words.collect();
        let is_type = matches!(row.extent, Extent::Chosen | Extent::Differentials);
        let call = if is_type { "Call" } else { "" };
        let names = [format!("{name}{call}"), format!("{name}Piece")];
        (role, names.map(|name| scope.take(&name)))
    })
    .collect()
}

/// A struct of named numbers.
pub(super) struct Group<'a> {
    pub(super) slots: &'a [Slot],
    pub(super) fields: Vec<Field>,
    pub(super) paths: Vec<String>,
}

impl<'a> Group<'a> {
    pub(super) fn new(slots: &'a [Slot]) -> Group<'a> {
        let fields = fields(slots.iter().map(|slot| &slot.name));
        let paths = paths(&fields);
        Group {
            slots,
            fields,
            paths,
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.slots.is_empty()
    }

    /// A struct literal with each number written by `value`.
    pub(super) fn literal(&self, name: &str, value: impl Fn(usize) -> String) -> Layout {
        let field = |field: &Field| {
            let value = if field.is_family {
                Layout::array(field.slots.iter().map(|&slot| value(slot)))
            } else {
                Layout::Atom(value(field.slots[0]))
            };
            (field.ident.clone(), value)
        };
        literal(name, self.fields.iter().map(field).collect())
    }
}

/// A struct literal; one without fields states its number type.
pub(super) fn literal(name: &str, mut fields: Vec<(String, Layout)>) -> Layout {
    if fields.is_empty() {
        fields.push((
            "scalar".into(),
            Layout::Atom("::core::marker::PhantomData".into()),
        ));
    }
    Layout::Struct(name.to_owned(), fields)
}

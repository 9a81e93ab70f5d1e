//! The numbers of single contacts: a function for each kind of contact, and for each contact a row with its kind and its arguments.
//!
//! A machine with many contacts has no functions for all of them together: the runtime calls the function of each contact's kind with the arguments in its row.
//! Another contact of the same kind therefore adds a row and no code.

use super::Emitter;
use crate::layout::Layout;
use lagrangian_program::contact_parts::{ContactPart, ContactParts, QUANTITIES};
use lagrangian_program::{Function, Role, Source};

/// The index of the gaps among the quantities.
const GAPS: usize = 0;

impl Emitter<'_> {
    /// Whether a function is for all contacts of a machine that has functions for kinds of them in its place.
    pub(super) fn is_by_parts(&self, role: Role) -> bool {
        self.contact_parts.is_some() && QUANTITIES.contains(&role)
    }

    /// Whether the gaps of single contacts depend on prepared values, whose rounding counts in bounds.
    pub(super) fn parts_of_gaps_read_prepared(&self) -> bool {
        let (parts, contacts) = (self.contact_parts.iter(), self.program.unilateral.len());
        let mut gaps = parts.flat_map(|parts| (0..contacts).filter_map(|k| parts.part(GAPS, k)));
        let is_prepared = |source: &Source| matches!(source, Source::Prepared(_));
        gaps.any(|gap| gap.arguments.iter().any(is_prepared))
    }

    /// Writes the functions of the parts, the table that says which contact has which, and the function that calls one of them.
    pub(super) fn functions_of_contact_parts(&mut self) {
        let Some(parts) = self.contact_parts.clone() else {
            return;
        };
        let mut emitter = Emitter::new(&parts.program, self.options);
        emitter.writer = std::mem::take(&mut self.writer);
        for function in &parts.program.functions {
            emitter.function(function);
        }
        self.writer = std::mem::take(&mut emitter.writer);
        self.table_of_contact_parts(&parts);
        self.call_of_contact_part(&parts);
    }

    /// Writes the methods for single contacts.
    pub(super) fn rows_of_contact_parts(&mut self) {
        let Some(parts) = self.contact_parts.clone() else {
            return;
        };
        let arguments = parts.gap_arguments().iter().map(bool::to_string);
        let arguments = Layout::array(arguments);
        self.row("gap_arguments", "single_contacts", &["p"], Some(arguments));
        let prepared = self.prepared_arguments(&parts);
        let prepared = prepared.iter().map(|slot| {
            let path = &self.prepared[*slot as usize];
            Layout::Atom(format!("p.{path}"))
        });
        let prepared = Layout::List("&[".into(), prepared.collect(), "]");
        let of_contacts = self.value_of_contact_parts(prepared.clone());
        self.row("parts", "of_contacts", &["p"], Some(of_contacts));
        let (arguments, prepared): (&[&str], _) = if self.parts_of_gaps_read_prepared() {
            (&["p"], prepared)
        } else {
            (&[], Layout::Atom("&[]".into()))
        };
        let of_gaps = self.value_of_contact_parts(prepared);
        self.row("least", "least_gaps", arguments, Some(of_gaps));
    }

    /// The `ContactParts` of the runtime, with these prepared values.
    fn value_of_contact_parts(&self, prepared: Layout) -> Layout {
        let fields = [
            ("parts", Layout::Atom("CONTACT_PARTS".into())),
            ("prepared", prepared),
            ("call", Layout::Atom("contact_part".into())),
        ];
        let fields = fields.map(|(name, value)| (name.to_owned(), value));
        let runtime = &self.options.runtime;
        Layout::Struct(format!("{runtime}::ContactParts"), fields.to_vec())
    }

    /// The prepared values that are arguments of parts, each once.
    fn prepared_arguments(&self, parts: &ContactParts) -> Vec<u32> {
        let contacts = 0..self.program.unilateral.len();
        let all = (0..QUANTITIES.len())
            .flat_map(|quantity| contacts.clone().map(move |contact| (quantity, contact)));
        let all = all.filter_map(|(quantity, contact)| parts.part(quantity, contact));
        let slots = all.flat_map(|part| &part.arguments);
        let slots = slots.filter_map(|source| match source {
            Source::Prepared(slot) => Some(*slot),
            _ => None,
        });
        let mut slots: Vec<u32> = slots.collect();
        slots.sort_unstable();
        slots.dedup();
        slots
    }

    /// Writes for each quantity and contact the index of a function, the indices of its arguments, and the places of its results.
    fn table_of_contact_parts(&mut self, parts: &ContactParts) {
        let runtime = &self.options.runtime;
        let contacts = self.program.unilateral.len();
        let n = self.program.dimension() as u32;
        let prepared = self.prepared_arguments(parts);
        let argument = |source: &Source| match *source {
            Source::Coordinate(i) => i,
            Source::Velocity(i) => n + i,
            Source::Prepared(slot) => {
                let place = prepared.binary_search(&slot).unwrap_or_default();
                2 * n + place as u32
            }
            _ => unreachable!("quantities of contacts depend on nothing else"),
        };
        let list = |numbers: &[u32]| {
            let numbers: Vec<String> = numbers.iter().map(u32::to_string).collect();
            format!("&[{}]", numbers.join(", "))
        };
        let none = ContactPart::default();
        let part = |quantity: usize, contact: usize| {
            let own = parts.part(quantity, contact).unwrap_or(&none);
            let arguments: Vec<u32> = own.arguments.iter().map(argument).collect();
            let function = own.function.unwrap_or(0).to_string();
            let items = [function, list(&arguments), list(&own.places)];
            Layout::List("(".into(), items.map(Layout::Atom).to_vec(), ")")
        };
        let rows = (0..QUANTITIES.len()).map(|quantity| {
            let own = (0..contacts).map(|contact| part(quantity, contact));
            Layout::List("&[".into(), own.collect(), "]")
        });
        let rows = Layout::List("&[".into(), rows.collect(), "]");
        let head = format!("const CONTACT_PARTS: &[&[{runtime}::ContactPart]] = ");
        self.writer.gap();
        self.docs(
            "For each quantity of contacts and each contact: the function that computes it, of which arguments, and where its results stand.",
        );
        self.writer.expression(&head, &rows, ";");
    }

    /// Writes the function that calls a part by its index.
    fn call_of_contact_part(&mut self, parts: &ContactParts) {
        let (runtime, scalar) = (self.options.runtime.clone(), self.types.scalar.clone());
        self.writer.gap();
        self.docs("Calls a function of [`CONTACT_PARTS`] with its arguments, and puts its results into their places.");
        let arguments = [
            format!("function: {}", self.types.known("u32")),
            format!("t: {scalar}"),
            format!("q: &[{scalar}; {}]", parts.program.dimension()),
            format!("places: &[{}]", self.types.known("u32")),
            format!("numbers: &mut [{scalar}]"),
        ];
        let head = format!("fn contact_part<{scalar}: {runtime}::Scalar>");
        self.writer.line("#[allow(unused_variables)]");
        self.writer.signature(&head, &arguments, None);
        self.writer.open("match function {");
        for (index, function) in parts.program.functions.iter().enumerate() {
            let call = call_of(index, function);
            self.writer.line(format!(
                "{index} => {runtime}::put(&{call}, places, numbers),"
            ));
        }
        self.writer.line("_ => {}");
        self.writer.close("}");
        self.writer.close("}");
    }
}

/// The call of a part.
fn call_of(index: usize, function: &Function) -> String {
    let reads = function.reads();
    let arguments = [(reads.time, "t"), (reads.coordinates, "q")];
    let arguments = arguments.iter().filter(|(is_read, _)| *is_read);
    let arguments: Vec<&str> = arguments.map(|(_, name)| *name).collect();
    format!(
        "{}({})",
        Role::ContactPart(index).name(),
        arguments.join(", ")
    )
}

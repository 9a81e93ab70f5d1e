//! Numbers of single contacts: a function for each kind of contact, and the rows that say which contact has which, and of which arguments.

use super::Emitter;
use crate::layout::Layout;
use lagrangian_program::contact_parts::{ContactPart, ContactParts, QUANTITIES};
use lagrangian_program::{Role, Source};

impl Emitter<'_> {
    /// Writes the functions of the parts.
    pub(super) fn functions_of_contact_parts(&mut self) {
        let Some(parts) = self.contact_parts.take() else {
            return;
        };
        let mut emitter = Emitter::new(&parts.program, self.options);
        emitter.writer = std::mem::take(&mut self.writer);
        for function in &parts.program.functions {
            emitter.function(function);
        }
        self.writer = std::mem::take(&mut emitter.writer);
        drop(emitter);
        self.contact_parts = Some(parts);
    }

    /// Writes which numbers of single contacts are computed by which function, and the lower bounds of gaps.
    pub(super) fn rows_of_contact_parts(&mut self) {
        let Some(parts) = self.contact_parts.take() else {
            return;
        };
        let arguments = parts.gap_arguments().iter().map(bool::to_string);
        let arguments = Layout::array(arguments);
        self.row("gap_arguments", "single_contacts", &["p"], Some(arguments));
        let value = self.value_of_contact_parts(&parts);
        self.row("parts", "of_contacts", &["p"], Some(value));
        let gaps = self.emitted(Role::Gaps);
        let needs = gaps.map(|function| self.needs(function));
        let arguments = needs.map(|needs| self.arguments(needs)).unwrap_or_default();
        let arguments: Vec<&str> = arguments.iter().map(|(name, _)| *name).collect();
        // Gaps without a function are 0.
        let call = self
            .called_role(Role::Gaps)
            .unwrap_or(Layout::Atom("[]".into()));
        self.row("least", "least_gaps", &arguments, Some(call));
        self.contact_parts = Some(parts);
    }

    /// The `ContactParts` of the runtime.
    fn value_of_contact_parts(&self, parts: &ContactParts) -> Layout {
        let runtime = &self.options.runtime;
        let contacts = self.program.unilateral.len();
        let n = self.program.dimension() as u32;
        let mut prepared: Vec<u32> = Vec::new();
        let mut argument = |source: &Source| match *source {
            Source::Coordinate(i) => i,
            Source::Velocity(i) => n + i,
            Source::Prepared(slot) => {
                let known = prepared.iter().position(|known| *known == slot);
                let place = known.unwrap_or_else(|| {
                    prepared.push(slot);
                    prepared.len() - 1
                });
                2 * n + place as u32
            }
            _ => unreachable!("quantities of contacts depend on nothing else"),
        };
        let list = |numbers: &[u32]| {
            let numbers: Vec<String> = numbers.iter().map(u32::to_string).collect();
            format!("&[{}]", numbers.join(", "))
        };
        let none = ContactPart::default();
        let mut part = |quantity: usize, contact: usize| {
            let own = parts.part(quantity, contact).unwrap_or(&none);
            let arguments: Vec<u32> = own.arguments.iter().map(&mut argument).collect();
            let function = own.function.unwrap_or(0).to_string();
            let items = [function, list(&arguments), list(&own.places)];
            Layout::List("(".into(), items.map(Layout::Atom).to_vec(), ")")
        };
        let rows: Vec<Layout> = (0..QUANTITIES.len())
            .map(|quantity| {
                let own = (0..contacts).map(|contact| part(quantity, contact));
                Layout::List("&[".into(), own.collect(), "]")
            })
            .collect();
        let prepared = prepared.iter().map(|slot| {
            let path = &self.prepared[*slot as usize];
            Layout::Atom(format!("p.{path}"))
        });
        let functions = parts.program.functions.iter().enumerate();
        let arms = functions.map(|(index, function)| {
            let reads = function.reads();
            let arguments = [(reads.time, "t"), (reads.coordinates, "q")];
            let arguments = arguments.iter().filter(|(is_read, _)| *is_read);
            let arguments: Vec<&str> = arguments.map(|(_, name)| *name).collect();
            let call = format!("contact_part_{index}({})", arguments.join(", "));
            format!("{index} => {runtime}::put(&{call}, places, numbers),")
        });
        let arms: Vec<String> = arms.chain(["_ => {}".to_owned()]).collect();
        let call = format!(
            "|function, t, q, places, numbers| match function {{ {} }}",
            arms.join(" ")
        );
        let fields = [
            ("parts", Layout::List("&[".into(), rows, "]")),
            (
                "prepared",
                Layout::List("&[".into(), prepared.collect(), "]"),
            ),
            ("call", Layout::Atom(call)),
        ];
        let fields = fields.map(|(name, value)| (name.to_owned(), value));
        Layout::Struct(
            format!("{runtime}::ContactParts::<{}>", parts.program.dimension()),
            fields.to_vec(),
        )
    }
}

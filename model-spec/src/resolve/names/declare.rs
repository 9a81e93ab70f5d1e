//! The declarations and removals of all layers, as they are written.

use super::{Content, Declaration, Namespace, suggestion, with_help};
use crate::diagnostic::{Code, Diagnostic};
use crate::resolve::Resolver;
use crate::syntax::{Declared, ElementContent, Ident, Index, Item, Remove, SectionKind, Spec};

/// Words that are not identifiers in Rust, raw or not.
const NO_RUST_NAMES: [&str; 5] = ["self", "Self", "super", "crate", "_"];

impl<'a> Resolver<'a, '_, '_> {
    /// Collects the declarations and removals of every layer.
    pub fn declare_all(&mut self, layers: &'a [Spec]) {
        for (layer, spec) in layers.iter().enumerate() {
            self.declare_layer(layer, spec);
            for remove in &spec.remove {
                self.declare_removal(layers, layer, remove);
            }
        }
    }

    fn declare_layer(&mut self, layer: usize, spec: &'a Spec) {
        use SectionKind::*;
        // Symbols are made in this order: parameters before coordinates before inputs.
        for (section, items) in [
            (Constants, &spec.constants),
            (Parameters, &spec.parameters),
            (Coordinates, &spec.coordinates),
            (States, &spec.states),
            (Inputs, &spec.inputs),
            (Outputs, &spec.outputs),
            (Define, &spec.shared_outputs),
        ] {
            self.declare_section(layer, section, items, Content::Quantity);
        }
        for (section, items) in [
            (Define, &spec.define),
            (Frames, &spec.frames),
            (Brachistochrone, &spec.brachistochrone),
        ] {
            self.declare_section(layer, section, items, |content| {
                Content::Expression(content)
            });
        }
        for (section, items) in [
            (Bodies, &spec.bodies),
            (Circles, &spec.circles),
            (Spheres, &spec.spheres),
            (Contacts, &spec.contacts),
        ] {
            self.declare_section(layer, section, items, Content::Record);
        }
        for row in self.language.elements {
            let items = spec.elements.iter();
            let items = items.filter(|element| element.section == row.section);
            let items = items.map(|element| &element.item);
            let section = SectionKind::Element(row.section);
            self.declare_section(layer, section, items, |content| match content {
                ElementContent::Record(record) => Content::Record(record),
                ElementContent::Expression(expression) => Content::Expression(expression),
                ElementContent::Equation(equation) => Content::Equation(equation),
            });
        }
        self.declare_section(layer, Approximations, &spec.approximations, |content| {
            Content::Approximation(content)
        });
        self.declare_section(layer, Derivatives, &spec.derivatives, |()| Content::Nothing);
        self.declare_section(layer, Stages, &spec.stages, |()| Content::Nothing);
        self.declare_section(layer, Methods, &spec.methods, |()| Content::Nothing);
        self.declare_section(layer, SectionKind::Charts, &spec.charts, Content::Charts);
        self.declare_section(layer, Keep, &spec.keep, |()| Content::Nothing);
    }

    fn declare_section<C>(
        &mut self,
        layer: usize,
        section: SectionKind,
        items: impl IntoIterator<Item = &'a Item<C>>,
        content: impl Fn(&'a C) -> Content<'a>,
    ) where
        C: 'a,
    {
        for item in items {
            let base = &item.name.base;
            if base.text.is_empty() {
                continue; // the parser has reported the missing name
            }
            self.check_declared(section, &item.name);
            if Namespace::of(section) == Namespace::FRAMES && base.text == "ground" {
                continue; // references to it still mean the ground
            }
            let declaration = self.declarations.len();
            self.declarations.push(Declaration {
                layer,
                section,
                name: &item.name,
                docs: &item.docs,
                content: content(&item.content),
            });
            let group = self.group(Namespace::of(section), &base.text);
            self.groups[group].declarations.push(declaration);
        }
    }

    fn declare_removal(&mut self, layers: &'a [Spec], layer: usize, remove: &'a Remove) {
        let section = remove.section.value;
        let Some(name) = &remove.name else {
            let mut bases = layers[..layer].iter();
            if !self.incomplete && !bases.any(|base| base.section(section).is_some()) {
                let message = format!("the base has no `{section}`");
                self.error(Code::UnknownName, remove.span, message);
            }
            // `remove springs;` takes all of them.
            let namespace = Namespace::of(section);
            for group in self.groups.iter_mut().filter(|g| g.namespace == namespace) {
                group.removals.push((layer, remove));
            }
            return;
        };
        let known = self.find_group(Namespace::of(section), &name.base.text);
        let inherited = known.filter(|&group| {
            self.groups[group].declarations.iter().any(|&declaration| {
                let declaration = &self.declarations[declaration];
                declaration.layer < layer && declaration.section == section
            })
        });
        match inherited {
            Some(group) => self.groups[group].removals.push((layer, remove)),
            None => self.unknown_removal(layer, section, &name.base),
        }
    }

    fn unknown_removal(&mut self, layer: usize, section: SectionKind, name: &'a Ident) {
        if self.incomplete || name.text.is_empty() {
            return;
        }
        let message = format!("the base has no `{}` under `{section}`", name.text);
        let inherited = self
            .declarations
            .iter()
            .filter(|declaration| declaration.layer < layer && declaration.section == section);
        let help = suggestion(
            &name.text,
            inherited.map(|declaration| declaration.name.base.text.as_str()),
        );
        self.push(with_help(
            Diagnostic::new(Code::UnknownName, name.span, message),
            help,
        ));
    }

    /// Refuses names that have another meaning, or that are not allowed as Rust fields.
    fn check_declared(&mut self, section: SectionKind, name: &'a Declared) {
        let base = &name.base;
        if NO_RUST_NAMES.contains(&base.text.as_str()) {
            let message = format!("`{}` cannot be a name", base.text);
            let diagnostic = Diagnostic::new(Code::ReservedName, base.span, message);
            self.push(diagnostic.help("it becomes a name in Rust, where it means something else"));
        }
        match Namespace::of(section) {
            Namespace::Values => self.check_reserved(base),
            Namespace::FRAMES | Namespace::BODIES if base.text == "ground" => {
                let message = "`ground` is the fixed frame and cannot be declared";
                self.error(Code::ReservedName, base.span, message);
            }
            Namespace::Section(_) => {}
        }
        if let Index::Range(range) = &name.index {
            self.check_index_variable(range);
        }
    }
}

//! The fields of the prepared values: one for each value, but arrays for values that a loop counts through.

use std::collections::BTreeMap;

use super::Emitter;
use super::language::Rust;
use super::types::literal;
use crate::body::{self, Plan};
use crate::formula_names;
use crate::layout::Layout;
use crate::names::{Field, Scope};
use lagrangian_program::{Function, Op, Program, Role, Source};
use lagrangian_symbolic::sorting::{sort_by, sort_by_key};

/// The arrays of prepared values that the loops of a program count through.
///
/// Overlapping lists share an array if they have the same order; a value that needs other neighbours in another
/// list is stored twice.
pub(super) fn families(
    program: &Program,
    plans: &BTreeMap<Role, Plan>,
    scope: &mut Scope,
) -> Vec<Field> {
    let mut lists: Vec<Vec<usize>> = Vec::new();
    for (role, plan) in plans {
        let Some(function) = program.function(*role) else {
            continue;
        };
        for list in plan.prepared(function) {
            let mut list: Vec<usize> = list.into_iter().map(|slot| slot as usize).collect();
            if list.first() > list.last() {
                list.reverse();
            }
            lists.push(list);
        }
    }
    // The longest first; lists of equal length in the order of their occurrence.
    sort_by_key(&mut lists, |list| std::cmp::Reverse(list.len()));
    let mut families: Vec<Vec<usize>> = Vec::new();
    for list in lists {
        let mut all = families.iter_mut();
        match all.find_map(|family| Some((joined(family, &list)?, family))) {
            Some((joined, family)) => *family = joined,
            None => families.push(list),
        }
    }
    sort_by(&mut families, Ord::cmp);
    let mut number = 0;
    let mut name = |slots: &Vec<usize>| {
        let base = |slot: &usize| match program.prepare.op(program.prepare.results[*slot]) {
            Op::Read(Source::Parameter(i)) => Some(&program.parameters[*i as usize].name.base),
            _ => None,
        };
        let first = slots.first().and_then(base);
        match first {
            Some(first) if slots.iter().all(|slot| base(slot) == Some(first)) => scope.take(first),
            _ => {
                number += 1;
                scope.take(&format!("r{}", number - 1))
            }
        }
    };
    let field = |slots: Vec<usize>| Field {
        ident: name(&slots),
        slots,
        is_family: true,
    };
    families.into_iter().map(field).collect()
}

/// Merges a family with a list if they overlap and have the same neighbours in the same order.
fn joined(family: &[usize], list: &[usize]) -> Option<Vec<usize>> {
    // The offset of the list relative to the family.
    let (in_family, in_list) = list.iter().enumerate().find_map(|(in_list, slot)| {
        let in_family = family.iter().position(|other| other == slot)?;
        Some((in_family as isize, in_list as isize))
    })?;
    let shift = in_family - in_list;
    let end = (list.len() as isize + shift).max(family.len() as isize);
    let mut joined = Vec::new();
    for at in shift.min(0)..end {
        let of = |list: &[usize], at: isize| {
            let at = usize::try_from(at).ok()?;
            list.get(at).copied()
        };
        joined.push(match (of(family, at), of(list, at - shift)) {
            (Some(a), Some(b)) if a == b => a,
            (Some(a), None) | (None, Some(a)) => a,
            _ => return None,
        });
    }
    let mut sorted = joined.clone();
    sorted.sort_unstable();
    sorted.dedup();
    (sorted.len() == joined.len()).then_some(joined)
}

/// The path to each prepared value.
pub(super) fn paths(program: &Program, families: &[Field], scope: &mut Scope) -> Vec<String> {
    let names = formula_names::of_prepared(program, str::to_owned);
    let path = |(slot, name): (usize, String)| {
        let at = families.iter().find_map(|family| {
            let at = family.slots.iter().position(|other| *other == slot)?;
            Some(format!("{}[{at}]", family.ident))
        });
        at.unwrap_or_else(|| scope.take(&name))
    };
    names.into_iter().enumerate().map(path).collect()
}

impl Emitter<'_> {
    /// The fields of the prepared values.
    pub(super) fn prepared_fields(&self) -> Vec<Field> {
        let is_alone = |slot: &usize| {
            let mut families = self.prepared_families.iter();
            families.all(|family| !family.slots.contains(slot))
        };
        let alone = |slot: usize| Field {
            ident: self.prepared[slot].clone(),
            slots: vec![slot],
            is_family: false,
        };
        let single = (0..self.prepared.len()).filter(is_alone).map(alone);
        let families = self.prepared_families.iter().cloned();
        single.chain(families).collect()
    }

    /// The struct literal of the prepared values, each number written by `value`; for some families arrays with
    /// these names exist already.
    pub(super) fn prepared_literal(
        &self,
        value: impl Fn(usize) -> String,
        filled: &[String],
    ) -> Layout {
        let mut filled = filled.iter();
        let fields = self.prepared_fields().into_iter().map(|field| {
            let value = if field.is_family {
                match filled.next() {
                    Some(array) => Layout::Atom(array.clone()),
                    None => Layout::array(field.slots.iter().map(|&slot| value(slot))),
                }
            } else {
                Layout::Atom(value(field.slots[0]))
            };
            (field.ident, value)
        });
        literal(&self.types.prepared, fields.collect())
    }

    /// The loops of `prepare`, if other functions count through its results.
    pub(super) fn plan_of_prepare(&self, prepare: &Function) -> Option<Plan> {
        if self.prepared_families.is_empty() {
            None
        } else {
            Plan::of(prepare, false, 0)
        }
    }

    /// Writes the code of `prepare`; returns the texts of its results and the arrays of the families.
    pub(super) fn prepare_with_loops(
        &mut self,
        prepare: &Function,
        plan: &Plan,
    ) -> (Vec<String>, Vec<String>) {
        let mut writer = std::mem::take(&mut self.writer);
        let rust = Rust {
            emitter: self,
            in_registers: false,
        };
        let mut scope = self.scope();
        let names = self.prepared_families.iter();
        let names: Vec<String> = names.map(|family| scope.take(&family.ident)).collect();
        let results = body::statements_with_loops(&mut writer, &rust, prepare, scope.clone(), plan);
        let (texts, places): (Vec<_>, Vec<_>) = results.into_iter().unzip();
        let texts: Vec<String> = texts.into_iter().map(|text| text.text).collect();
        for (family, name) in self.prepared_families.iter().zip(&names) {
            let slots = family.slots.iter();
            let (texts, places): (Vec<_>, Vec<_>) = slots
                .map(|slot| (texts[*slot].clone(), places[*slot].clone()))
                .unzip();
            let runs = body::runs(&places);
            let as_it_is = &str::to_owned;
            body::fill(
                &mut writer,
                &rust,
                name,
                &runs,
                &texts,
                as_it_is,
                &mut scope,
            );
        }
        self.writer = writer;
        (texts, names)
    }
}

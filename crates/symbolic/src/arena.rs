//! Storage of nodes, each of them once, found by content.

use core::cell::Cell;
use core::hash::{Hash, Hasher};
use std::rc::Rc;

use rustc_hash::FxHasher;

use crate::node::{Factor, Function, Id, Node, Stage, Symbol, Term};
use crate::rational::Rational;

/// The nodes, and a table that finds a node by its content without building it first.
pub(crate) struct Arena {
    entries: Vec<Entry>,
    /// The total number of operands of the nodes.
    operands: usize,
    /// The largest number of nodes and operands; beyond it every new sum, product and function is undefined.
    limit: usize,
    /// Whether a node was requested beyond the limit.
    pub(crate) exhausted: bool,
    /// Open addressing with linear probing; a power of two of slots, at most half of them occupied.
    table: Vec<u32>,
    pub(crate) symbols: Vec<SymbolEntry>,
    /// Buffers for terms and factors, reused because most nodes exist already, so that their
    /// construction allocates nothing else.
    pub(crate) spare_terms: Vec<Term>,
    pub(crate) spare_factors: Vec<Factor>,
    /// The words of an empty set: a new one for every search would take memory in proportion to all nodes.
    spare_set: Cell<Vec<u64>>,
}

pub(crate) struct SymbolEntry {
    pub(crate) name: String,
    pub(crate) stage: Stage,
    pub(crate) id: Id,
}

/// A node with frequently needed properties.
struct Entry {
    node: Node,
    hash: u32,
    /// Hash of the factors that are not parameters: equal for `p₁·X` and `p₂·X`.
    rest: u32,
    /// One bit for each symbol that occurs in it, by its index modulo 64.
    symbols: u64,
    stage: Stage,
    flags: u8,
}

/// The node is a product of parameters and of something else.
pub(crate) const PARAMETER_FACTOR: u8 = 1;
/// The node is a product with sin² or a higher power of a sine among its factors.
pub(crate) const SQUARED_SINE: u8 = 2;

const EMPTY: u32 = u32::MAX;

impl Arena {
    pub(crate) const ZERO: Id = Id(0);
    pub(crate) const ONE: Id = Id(1);
    pub(crate) const UNDEFINED: Id = Id(2);
    pub(crate) const PI: Id = Id(3);

    pub(crate) fn new() -> Arena {
        let mut arena = Arena {
            entries: Vec::new(),
            operands: 0,
            limit: usize::MAX,
            exhausted: false,
            table: vec![EMPTY; 1024],
            symbols: Vec::new(),
            spare_terms: Vec::new(),
            spare_factors: Vec::new(),
            spare_set: Cell::default(),
        };
        arena.constant(Rational::ZERO);
        arena.constant(Rational::ONE);
        arena.product_node(&[(Arena::ZERO, -1)]);
        arena.intern(fingerprint(&2u8), |node| *node == Node::Pi, || Node::Pi);
        arena
    }

    pub(crate) fn len(&self) -> usize {
        self.entries.len()
    }

    /// The number of nodes and operands, to which memory and the work of one pass over the graph are proportional.
    pub(crate) fn size(&self) -> usize {
        self.entries.len() + self.operands
    }

    pub(crate) fn set_limit(&mut self, limit: usize) {
        self.limit = limit;
        self.exhausted = false;
    }

    pub(crate) fn node(&self, id: Id) -> &Node {
        &self.entries[id.index()].node
    }

    pub(crate) fn stage(&self, id: Id) -> Stage {
        self.entries[id.index()].stage
    }

    pub(crate) fn is_parameter(&self, id: Id) -> bool {
        self.stage(id) <= Stage::PARAMETER
    }

    /// Whether the node may depend on a symbol of the mask; `false` is certain.
    pub(crate) fn touches(&self, id: Id, mask: u64) -> bool {
        self.entries[id.index()].symbols & mask != 0
    }

    pub(crate) fn has_flag(&self, id: Id, flag: u8) -> bool {
        self.entries[id.index()].flags & flag != 0
    }

    pub(crate) fn rest_hash(&self, id: Id) -> u32 {
        self.entries[id.index()].rest
    }

    pub(crate) fn symbol_mask(symbol: Symbol) -> u64 {
        1 << (symbol.0 % 64)
    }

    // Constructors of nodes that are already in normal form.

    pub(crate) fn constant(&mut self, value: Rational) -> Id {
        let hash = fingerprint(&(0u8, &value));
        let same = |node: &Node| matches!(node, Node::Constant(other) if *other == value);
        self.intern(hash, same, || Node::Constant(value.clone()))
    }

    pub(crate) fn symbol(&mut self, name: &str, stage: Stage) -> Id {
        let symbol = Symbol(count(self.symbols.len()));
        // There are few symbols, and callers rely on them, so they are exempt from the limit.
        let limit = std::mem::replace(&mut self.limit, usize::MAX);
        let id = self.intern(
            fingerprint(&(1u8, symbol)),
            |_| false,
            || Node::Symbol(symbol),
        );
        self.limit = limit;
        self.symbols.push(SymbolEntry {
            name: name.to_owned(),
            stage,
            id,
        });
        self.entries[id.index()].stage = stage;
        self.entries[id.index()].symbols = Arena::symbol_mask(symbol);
        id
    }

    pub(crate) fn sum_node(&mut self, terms: &[(Id, Rational)]) -> Id {
        let same = |node: &Node| matches!(node, Node::Sum(other) if **other == *terms);
        self.intern(fingerprint(&(3u8, terms)), same, || Node::Sum(terms.into()))
    }

    pub(crate) fn product_node(&mut self, factors: &[(Id, i32)]) -> Id {
        let same = |node: &Node| matches!(node, Node::Product(other) if **other == *factors);
        self.intern(fingerprint(&(4u8, factors)), same, || {
            Node::Product(factors.into())
        })
    }

    /// The product of these factors (by id), if it exists already.
    pub(crate) fn find_product(&self, factors: &[(Id, i32)]) -> Option<Id> {
        match factors {
            [] => None,
            [(id, 1)] => Some(*id),
            _ => self.find(
                fingerprint(&(4u8, factors)),
                |node| matches!(node, Node::Product(other) if **other == *factors),
            ),
        }
    }

    pub(crate) fn function_node(&mut self, function: Function, arguments: &[Id]) -> Id {
        let same = |node: &Node| is_function(node, function, arguments);
        let hash = fingerprint(&(5u8, function, arguments));
        self.intern(hash, same, || Node::Function(function, Rc::from(arguments)))
    }

    /// The function of one argument, if it exists already.
    pub(crate) fn find_function(&self, function: Function, argument: Id) -> Option<Id> {
        let arguments: &[Id] = &[argument];
        self.find(fingerprint(&(5u8, function, arguments)), |node| {
            is_function(node, function, arguments)
        })
    }

    fn find(&self, hash: u32, same: impl Fn(&Node) -> bool) -> Option<Id> {
        let mask = self.table.len() - 1;
        let mut slot = hash as usize & mask;
        loop {
            let index = self.table[slot];
            if index == EMPTY {
                return None;
            }
            let entry = &self.entries[index as usize];
            if entry.hash == hash && same(&entry.node) {
                return Some(Id(index));
            }
            slot = (slot + 1) & mask;
        }
    }

    fn intern(
        &mut self,
        hash: u32,
        same: impl Fn(&Node) -> bool,
        make: impl FnOnce() -> Node,
    ) -> Id {
        if let Some(id) = self.find(hash, same) {
            return id;
        }
        if self.size() >= self.limit {
            self.exhausted = true;
            return Arena::UNDEFINED;
        }
        if 2 * self.entries.len() >= self.table.len() {
            self.grow();
        }
        let id = Id(count(self.entries.len()));
        let entry = self.entry(id, hash, make());
        self.operands += entry.node.operands();
        self.entries.push(entry);
        place(&mut self.table, hash, id.0);
        id
    }

    fn grow(&mut self) {
        let mut table = vec![EMPTY; 2 * self.table.len()];
        for (index, entry) in self.entries.iter().enumerate() {
            place(&mut table, entry.hash, count(index));
        }
        self.table = table;
    }

    fn entry(&self, id: Id, hash: u32, node: Node) -> Entry {
        let mut stage = Stage::CONSTANT;
        let mut symbols = 0;
        node.for_each_child(|child| {
            let child = &self.entries[child.index()];
            stage = stage.max(child.stage);
            symbols |= child.symbols;
        });
        let mut flags = 0;
        let mut rest = fingerprint(&(id, 1));
        if let Node::Product(factors) = &node
            && stage > Stage::PARAMETER
        {
            let mut hasher = FxHasher::default();
            for &(factor, power) in factors.iter() {
                if self.is_parameter(factor) {
                    flags |= PARAMETER_FACTOR;
                } else {
                    (factor, power).hash(&mut hasher);
                }
                if power >= 2 && matches!(self.node(factor), Node::Function(Function::Sin, _)) {
                    flags |= SQUARED_SINE;
                }
            }
            rest = hasher.finish() as u32;
        } else if let Node::Product(factors) = &node {
            let squared = |&(factor, power): &(Id, i32)| {
                power >= 2 && matches!(self.node(factor), Node::Function(Function::Sin, _))
            };
            flags |= if factors.iter().any(squared) {
                SQUARED_SINE
            } else {
                0
            };
        }
        Entry {
            node,
            hash,
            rest,
            symbols,
            stage,
            flags,
        }
    }
}

fn is_function(node: &Node, function: Function, arguments: &[Id]) -> bool {
    matches!(node, Node::Function(f, others) if *f == function && **others == *arguments)
}

/// Puts an index that is not in the table into a free slot.
fn place(table: &mut [u32], hash: u32, index: u32) {
    let mask = table.len() - 1;
    let mut slot = hash as usize & mask;
    while table[slot] != EMPTY {
        slot = (slot + 1) & mask;
    }
    table[slot] = index;
}

fn count(n: usize) -> u32 {
    // At 48 bytes a node, memory is exhausted first.
    u32::try_from(n)
        .ok()
        .filter(|&n| n != EMPTY)
        .expect("fewer than 2^32 nodes")
}

fn fingerprint(content: &impl Hash) -> u32 {
    let mut hasher = FxHasher::default();
    content.hash(&mut hasher);
    hasher.finish() as u32
}

/// A set of ids.
pub(crate) struct BitSet(Vec<u64>);

impl BitSet {
    /// Inserts an id; returns whether it was absent.
    pub(crate) fn insert(&mut self, id: Id) -> bool {
        let word = &mut self.0[id.index() / 64];
        let bit = 1 << (id.index() % 64);
        let new = *word & bit == 0;
        *word |= bit;
        new
    }

    /// Whether the set contains an id.
    pub(crate) fn contains(&self, id: Id) -> bool {
        self.0[id.index() / 64] & (1 << (id.index() % 64)) != 0
    }
}

/// The place of each of some nodes among these, which are in order of age.
#[derive(Clone, Debug, Default)]
pub(crate) struct Places {
    /// For each id one more than its place; 0 stands for none. Empty if the nodes are few among all.
    table: Vec<u32>,
    /// The nodes, if they are few.
    sorted: Vec<Id>,
}

impl Places {
    /// Nodes are few if there are so many times as many up to the last of them. Then they are searched: a table would take memory in proportion to all nodes.
    const FEW: usize = 16;

    pub(crate) fn of(nodes: &[Id]) -> Places {
        let len = nodes.last().map_or(0, |id| id.index() + 1);
        if len > Self::FEW * nodes.len() {
            return Places {
                table: Vec::new(),
                sorted: nodes.to_vec(),
            };
        }
        let mut table = vec![0; len];
        for (id, place) in nodes.iter().zip(1..) {
            table[id.index()] = place;
        }
        Places {
            table,
            sorted: Vec::new(),
        }
    }

    #[inline]
    pub(crate) fn get(&self, id: Id) -> Option<usize> {
        if self.sorted.is_empty() {
            (*self.table.get(id.index())? as usize).checked_sub(1)
        } else {
            self.sorted.binary_search(&id).ok()
        }
    }
}

impl Arena {
    /// An empty set for all ids. To be given back with [`clear`](Self::clear).
    pub(crate) fn empty_set(&self) -> BitSet {
        let mut words = self.spare_set.take();
        words.resize(self.len().div_ceil(64), 0);
        BitSet(words)
    }

    /// Takes back a set, with all ids that it contains.
    pub(crate) fn clear(&self, mut set: BitSet, ids: impl Iterator<Item = Id>) {
        for id in ids {
            set.0[id.index() / 64] = 0;
        }
        self.spare_set.set(set.0);
    }

    /// The nodes that the roots are built from, in order of age; nodes that are not to be entered
    /// and everything below them are left out.
    pub(crate) fn reachable(
        &self,
        roots: impl Iterator<Item = Id>,
        enter: impl Fn(Id) -> bool,
    ) -> Vec<Id> {
        let mut seen = self.empty_set();
        let mut found: Vec<Id> = roots
            .filter(|&root| enter(root) && seen.insert(root))
            .collect();
        let mut next = 0;
        while let Some(&id) = found.get(next) {
            next += 1;
            self.node(id).for_each_child(|child| {
                if enter(child) && seen.insert(child) {
                    found.push(child);
                }
            });
        }
        self.clear(seen, found.iter().copied());
        found.sort_unstable();
        found
    }
}

//! The values of one function, with products and sums still whole, for finding common parts.
//!
//! A function starts from the part of the [`Graph`] that its results need; what depends on
//! parameters alone is cut off and becomes an argument. Then every quotient gets its division,
//! which is shared if a divisor occurs more than once, and [common pairs](super::pairs) of factors
//! and of terms become items of their own.

use lagrangian_symbolic::Function;
use rustc_hash::FxHashMap;

use super::graph::{Graph, Id, Node, Scaled};
use super::steps::EliminationStep;
use super::{Op, Source};
use lagrangian_units::Stages;

/// Powers up to this are written out as repeated factors, so that x² in x²·y and in x²·z is found as a
/// common pair; higher powers are computed by repeated squaring, since parts of x¹⁷ are hardly ever shared.
const WRITTEN_OUT_POWER: u32 = 8;

/// An index into [`Net::items`].
pub type Index = u32;

/// A term of a sum: an item, and whether it is subtracted.
pub type Signed = (Index, bool);

/// A value that is computed or read.
#[derive(Clone, Debug)]
pub enum Item {
    /// A constant or an argument.
    Leaf(Leaf),
    /// Signed terms.
    Sum(Vec<Signed>),
    /// Factors, repeated for powers, over divisors.
    Product {
        /// The factors.
        factors: Vec<Index>,
        /// The divisors.
        divisors: Vec<Index>,
    },
    /// A function of its arguments.
    Function(Function, Vec<Index>),
}

/// A value that is computed elsewhere.
#[derive(Clone, Debug)]
pub enum Leaf {
    /// A constant or an argument.
    Op(Op),
    /// A value that depends on parameters alone.
    Prepared(Id),
}

/// When a value is known: with constants and prepared values, time, coordinates, velocities,
/// inputs, or accelerations.
pub type Stage = u8;

/// The stage of values that depend on time and on nothing later.
pub const TIME: Stage = 1;

/// The stage of values that depend on time and coordinates, and on nothing later.
pub const POSITION: Stage = 2;

/// The values that one function computes, with sums and products merged as far as possible.
#[derive(Clone)]
pub struct Net {
    /// The items, operands before their users.
    pub items: Vec<Item>,
    /// The stage of each item.
    pub stages: Vec<Stage>,
    /// The stages that are computed separately: products and sums are not merged across them.
    pub separate: Stages,
    /// The requested values, with their signs.
    pub roots: Vec<Signed>,
    /// The items that are steps of an elimination.
    pub steps: Vec<(Index, EliminationStep)>,
}

impl Net {
    /// The items that the roots need. With `cut`, values that depend on parameters alone are arguments.
    pub fn new(graph: &Graph, roots: &[(Id, bool)], cut: bool) -> Net {
        Net::with_steps(graph, roots, &[], cut)
    }

    /// The items that the roots need, with those steps of an elimination that belong to them.
    fn with_steps(
        graph: &Graph,
        roots: &[(Id, bool)],
        steps: &[(Scaled, EliminationStep)],
        cut: bool,
    ) -> Net {
        let mut net = Net {
            items: Vec::new(),
            stages: Vec::new(),
            separate: Stages::default(),
            roots: Vec::new(),
            steps: Vec::new(),
        };
        let mut index_of: FxHashMap<Id, Index> = FxHashMap::default();
        for id in needed(graph, roots, cut) {
            let index = net.add_node(graph, id, cut, &index_of);
            index_of.insert(id, index);
        }
        net.roots = roots
            .iter()
            .map(|(id, negative)| (index_of[id], *negative))
            .collect();
        let steps = steps.iter().filter(|(value, _)| !value.is_known());
        let steps = steps.filter_map(|(value, step)| Some((*index_of.get(&value.core)?, *step)));
        net.steps = steps.collect();
        net.share_divisions();
        net
    }

    /// The items that the values need; their signs are prepared together with their factors.
    pub fn of_values(graph: &mut Graph, values: &[Scaled], cut: bool) -> Net {
        Net::of_elimination(graph, values, &[], cut)
    }

    /// The items that the values of an elimination with these steps need.
    pub fn of_elimination(
        graph: &mut Graph,
        values: &[Scaled],
        steps: &[(Scaled, EliminationStep)],
        cut: bool,
    ) -> Net {
        let root = |x: &Scaled| {
            if cut && x.negative && x.factor != Id::ONE {
                let x = graph.with_signed_factor(*x);
                (graph.unsigned(x), false)
            } else {
                (graph.unsigned(*x), x.negative)
            }
        };
        let roots: Vec<(Id, bool)> = values.iter().map(root).collect();
        Net::with_steps(graph, &roots, steps, cut)
    }

    /// The total number of operands of all items.
    pub fn size(&self) -> usize {
        let mut size = 0;
        for item in &self.items {
            operands(item, |_| size += 1);
        }
        size
    }

    fn add_node(
        &mut self,
        graph: &Graph,
        id: Id,
        cut: bool,
        index_of: &FxHashMap<Id, Index>,
    ) -> Index {
        let item = match graph.node(id) {
            Node::Constant(value) => Item::Leaf(Leaf::Op(Op::Constant(value.clone()))),
            Node::Pi => Item::Leaf(Leaf::Op(Op::Pi)),
            Node::Read(source) if !(cut && graph.is_known(id)) => {
                Item::Leaf(Leaf::Op(Op::Read(*source)))
            }
            _ if cut && graph.is_known(id) => Item::Leaf(Leaf::Prepared(id)),
            Node::Opaque(inner) => return index_of[inner],
            Node::Sum(terms) => Item::Sum(
                terms
                    .iter()
                    .map(|term| (index_of[&term.id], term.negative))
                    .collect(),
            ),
            Node::Function(function, arguments) => Item::Function(
                *function,
                arguments
                    .iter()
                    .map(|argument| index_of[argument])
                    .collect(),
            ),
            Node::Product(factors) => return self.add_product(factors, index_of),
            Node::Read(_) => unreachable!("an argument is cut off or read"),
        };
        self.add(item)
    }

    fn add_product(&mut self, factors: &[(Id, i32)], index_of: &FxHashMap<Id, Index>) -> Index {
        let (mut up, mut down) = (Vec::new(), Vec::new());
        for &(id, power) in factors {
            let side = if power > 0 { &mut up } else { &mut down };
            let (item, power) = (index_of[&id], power.unsigned_abs());
            if power <= WRITTEN_OUT_POWER {
                side.extend((0..power).map(|_| item));
            } else {
                side.push(self.add_power(item, power));
            }
        }
        self.add(Item::Product {
            factors: up,
            divisors: down,
        })
    }

    /// x^power by squaring.
    fn add_power(&mut self, x: Index, power: u32) -> Index {
        let mut value = x;
        // From the second-highest bit down: square, and multiply by x if the bit is set.
        for bit in (0..power.ilog2()).rev() {
            value = self.add(Item::Product {
                factors: vec![value, value],
                divisors: vec![],
            });
            if power >> bit & 1 == 1 {
                value = self.add(Item::Product {
                    factors: vec![value, x],
                    divisors: vec![],
                });
            }
        }
        value
    }

    /// Appends an item.
    pub fn add(&mut self, item: Item) -> Index {
        let mut stage = match &item {
            Item::Leaf(Leaf::Op(Op::Read(source))) => stage_of(*source),
            _ => 0,
        };
        operands(&item, |operand| {
            stage = stage.max(self.stages[operand as usize])
        });
        self.stages.push(stage);
        self.items.push(item);
        Index::try_from(self.items.len() - 1).expect("memory ends before 2^32 items")
    }

    /// Gives a divisor that several products share one reciprocal; a single division stays a division.
    fn share_divisions(&mut self) {
        // Divisors that always occur together are treated as one divisor.
        let mut groups: FxHashMap<Vec<Index>, Vec<usize>> = FxHashMap::default();
        for (index, item) in self.items.iter_mut().enumerate() {
            if let Item::Product { divisors: down, .. } = item
                && !down.is_empty()
            {
                down.sort_unstable();
                groups.entry(down.clone()).or_default().push(index);
            }
        }
        let mut groups: Vec<_> = groups.into_iter().collect();
        groups.sort_unstable_by_key(|(_, products)| products[0]);
        let mut company: FxHashMap<Index, usize> = FxHashMap::default();
        for (down, _) in &groups {
            let mut bases = down.clone();
            bases.dedup();
            bases
                .iter()
                .for_each(|base| *company.entry(*base).or_default() += 1);
        }
        let mut reciprocals: FxHashMap<Index, Index> = FxHashMap::default();
        for (down, products) in groups {
            let (own, shared): (Vec<Index>, Vec<Index>) =
                down.iter().partition(|base| company[base] == 1);
            let mut factors: Vec<Index> = Vec::new();
            for base in shared {
                let reciprocal = match reciprocals.get(&base) {
                    Some(&known) => known,
                    None => self.add(Item::Product {
                        factors: vec![],
                        divisors: vec![base],
                    }),
                };
                reciprocals.insert(base, reciprocal);
                factors.push(reciprocal);
            }
            let mut left = own;
            if products.len() > 1 && !left.is_empty() {
                factors.push(self.add(Item::Product {
                    factors: vec![],
                    divisors: std::mem::take(&mut left),
                }));
            }
            for product in products {
                if let Item::Product {
                    factors: up,
                    divisors: down,
                } = &mut self.items[product]
                {
                    up.extend(&factors);
                    down.clone_from(&left);
                }
            }
        }
    }
}

/// The nodes that the roots need, operands first; operands of nodes that are cut off are not needed.
fn needed(graph: &Graph, roots: &[(Id, bool)], cut: bool) -> Vec<Id> {
    let mut seen = vec![false; graph.size()];
    let mut found: Vec<Id> = Vec::new();
    let mut visit = |id: Id, found: &mut Vec<Id>| {
        if !std::mem::replace(&mut seen[id.index()], true) {
            found.push(id);
        }
    };
    roots.iter().for_each(|(id, _)| visit(*id, &mut found));
    let mut next = 0;
    while let Some(&id) = found.get(next) {
        next += 1;
        if cut && graph.is_known(id) {
            continue;
        }
        match graph.node(id) {
            Node::Constant(_) | Node::Pi | Node::Read(_) => {}
            Node::Sum(terms) => terms.iter().for_each(|term| visit(term.id, &mut found)),
            Node::Product(factors) => factors
                .iter()
                .for_each(|(factor, _)| visit(*factor, &mut found)),
            Node::Function(_, arguments) => arguments
                .iter()
                .for_each(|argument| visit(*argument, &mut found)),
            Node::Opaque(inner) => visit(*inner, &mut found),
        }
    }
    found.sort_unstable();
    found
}

/// Calls `visit` with every operand.
pub fn operands(item: &Item, mut visit: impl FnMut(Index)) {
    match item {
        Item::Leaf(_) => {}
        Item::Sum(terms) => terms.iter().for_each(|(term, _)| visit(*term)),
        Item::Product {
            factors: up,
            divisors: down,
        } => up.iter().chain(down).for_each(|factor| visit(*factor)),
        Item::Function(_, arguments) => arguments.iter().for_each(|argument| visit(*argument)),
    }
}

/// The stage at which an argument is known.
pub fn stage_of(source: Source) -> Stage {
    match source {
        Source::Parameter(_) | Source::Prepared(_) => 0,
        Source::Time | Source::AtTime(_) => TIME,
        Source::Coordinate(_) | Source::AtPosition(_) => POSITION,
        Source::Velocity(_) => 3,
        Source::Input(_) => 4,
        Source::Acceleration(_) => 5,
    }
}

//! Shares common pairs: two factors that occur together in several products are multiplied once;
//! then the same for terms of sums.
//!
//! The algorithm is greedy: the most frequent pair becomes an item of its own and replaces the pair
//! everywhere, until no pair occurs twice. Each step saves one operation fewer than the number of
//! occurrences of the pair. Among pairs that occur equally often, the one known earliest is taken,
//! so that values that stay constant while velocities change stay together; then the older one.
//!
//! M. A. Breuer, *Generation of optimal code for expressions via factorization*, Comm. ACM 12
//! (1969) 333–340.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use rustc_hash::FxHashMap;

use super::net::{Index, Item, Net, Signed, Stage};
use lagrangian_symbolic::sorting::sort_by_key;

/// The largest number of changes to the table of pairs in one pass. A pass that reaches it stops
/// there: its code is correct, only longer than it could be. A change takes some 50 ns; a spatial
/// arm of six joints needs 20 000.
const CHANGE_LIMIT: usize = 1 << 18;

/// The part of the budget that may be spent on counting the initial pairs. Bags with more pairs
/// than this leaves room for are skipped: the table of a bag of n members has n²/2 pairs.
const COUNTING_LIMIT: usize = CHANGE_LIMIT / 2;

impl Net {
    /// Finds common pairs of factors, then of terms.
    pub fn share_pairs(&mut self) {
        for kind in [PairKind::Products, PairKind::Sums] {
            let mut bags = Bags::new(self, kind);
            bags.run(self);
            bags.write_back(self);
        }
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum PairKind {
    Products,
    Sums,
}

/// A factor with its multiplicity, or a term (multiplicity 1) with its sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Member {
    item: Index,
    negative: bool,
    count: u32,
}

/// Two different members, the smaller index first, or one member twice; and whether their signs differ.
type Pair = (Index, Index, bool);

/// A product or a sum, without the members that occur nowhere else.
struct Bag {
    item: Index,
    members: Vec<Member>,
    /// Members that occur nowhere else, or must not be changed.
    unshared: Vec<Member>,
}

impl Bag {
    fn len(&self) -> u32 {
        self.members
            .iter()
            .chain(&self.unshared)
            .map(|member| member.count)
            .sum()
    }

    fn find(&self, item: Index) -> Option<usize> {
        self.members.iter().position(|member| member.item == item)
    }
}

#[derive(Default)]
struct Uses {
    count: u32,
    /// Bags that had the pair when it was counted; some may have lost it, some may be listed twice.
    bags: Vec<u32>,
}

/// The number of occurrences of a pair, its stage, and the pair itself: the order in which pairs are taken.
type Rank = (u32, Reverse<Stage>, Reverse<Pair>);

struct Bags {
    kind: PairKind,
    bags: Vec<Bag>,
    pairs: FxHashMap<Pair, Uses>,
    queue: BinaryHeap<Rank>,
    changes: usize,
}

impl Bags {
    fn new(net: &mut Net, kind: PairKind) -> Bags {
        let mut uses = vec![0_u32; net.items.len()];
        for item in &net.items {
            match (item, kind) {
                (Item::Product { factors: up, .. }, PairKind::Products) => {
                    up.iter().for_each(|&factor| uses[factor as usize] += 1);
                }
                (Item::Sum(terms), PairKind::Sums) => {
                    terms.iter().for_each(|term| uses[term.0 as usize] += 1);
                }
                _ => {}
            }
        }
        let is_shared = |item: Index| uses[item as usize] > 1;
        let mut bags = Vec::new();
        for (index, item) in net.items.iter_mut().enumerate() {
            // An item with fewer than two shared members has no pair in common with any other; its shared member is
            // placed last, as in the others.
            let members = match (item, kind) {
                (Item::Product { factors: up, .. }, PairKind::Products) => {
                    if up.iter().filter(|&&factor| is_shared(factor)).count() < 2 {
                        up.sort_unstable_by_key(|&factor| (is_shared(factor), factor));
                        continue;
                    }
                    count_factors(up)
                }
                (Item::Sum(terms), PairKind::Sums) => {
                    if terms.iter().filter(|term| is_shared(term.0)).count() < 2 {
                        sort_by_key(terms, |term| is_shared(term.0));
                        continue;
                    }
                    let member = |&(item, negative): &Signed| Member {
                        item,
                        negative,
                        count: 1,
                    };
                    terms.iter().map(member).collect()
                }
                _ => continue,
            };
            let (members, alone) = members
                .into_iter()
                .partition(|member| is_shared(member.item));
            bags.push(Bag {
                item: index as Index,
                members,
                unshared: alone,
            });
        }
        Bags {
            kind,
            bags,
            pairs: FxHashMap::default(),
            queue: BinaryHeap::new(),
            changes: 0,
        }
    }

    fn run(&mut self, net: &mut Net) {
        for bag in 0..self.bags.len() {
            let members = self.bags[bag].members.len();
            if self.changes + members * (members + 1) / 2 <= COUNTING_LIMIT {
                self.count_pairs(bag, net, Change::Enter);
            }
        }
        // Ranks are of no use until all pairs are counted.
        self.queue.clear();
        let counted = self.pairs.iter().filter(|(_, uses)| uses.count > 1);
        self.queue = counted
            .map(|(&pair, uses)| rank(pair, uses.count, net))
            .collect();
        while let Some((count, _, Reverse(pair))) = self.queue.pop() {
            if self.changes > CHANGE_LIMIT {
                return;
            }
            // Ranks in the queue are not updated; a pair is queued again instead.
            if self
                .pairs
                .get(&pair)
                .is_some_and(|uses| uses.count == count)
            {
                self.extract(pair, net);
            }
        }
    }

    /// Replaces the pair by an item of its own, everywhere.
    fn extract(&mut self, pair: Pair, net: &mut Net) {
        let Some(uses) = self.pairs.remove(&pair) else {
            return;
        };
        let mut users = uses.bags;
        users.sort_unstable();
        users.dedup();
        users.retain(|&bag| occurrences(&self.bags[bag as usize], pair) > 0);
        // A bag that consists of this pair alone becomes the item; the first one, if there are several.
        let (first, second, opposite) = pair;
        let definition = users.iter().copied().find(|&bag| {
            let bag = &self.bags[bag as usize];
            let down_free = !matches!(&net.items[bag.item as usize], Item::Product { divisors: down, .. } if !down.is_empty());
            bag.len() == 2 && down_free && bag.members.iter().any(|member| !member.negative)
        });
        // p = ±first ± second, at least one of them positive.
        let first_negative = definition.is_some_and(|bag| {
            let bag = &self.bags[bag as usize];
            bag.find(first)
                .is_some_and(|position| bag.members[position].negative)
        });
        let item = match definition {
            Some(bag) => self.bags[bag as usize].item,
            None => net.add(match self.kind {
                PairKind::Products => Item::Product {
                    factors: vec![first, second],
                    divisors: vec![],
                },
                PairKind::Sums => Item::Sum(vec![(first, false), (second, opposite)]),
            }),
        };
        for bag in users {
            self.count_pairs(bag as usize, net, Change::Leave);
            let target = &mut self.bags[bag as usize];
            if Some(bag) == definition {
                target.unshared.append(&mut target.members);
                continue;
            }
            let count = occurrences(target, pair);
            let Some(position) = target.find(first) else {
                continue;
            };
            let negative = target.members[position].negative != first_negative;
            for item in [first, second] {
                if let Some(position) = target.find(item) {
                    target.members[position].count -= count;
                }
            }
            target.members.retain(|member| member.count > 0);
            target.members.push(Member {
                item,
                negative,
                count,
            });
            self.count_pairs(bag as usize, net, Change::Enter);
        }
    }

    /// Adds all pairs of a bag to the table, or removes them.
    fn count_pairs(&mut self, bag: usize, net: &Net, change: Change) {
        let members = &self.bags[bag].members;
        for (position, &a) in members.iter().enumerate() {
            for &b in &members[position..] {
                let same = a.item == b.item;
                let count = if same {
                    a.count / 2
                } else {
                    a.count.min(b.count)
                };
                if count == 0 {
                    continue;
                }
                self.changes += 1;
                let pair = (
                    a.item.min(b.item),
                    a.item.max(b.item),
                    a.negative != b.negative,
                );
                let uses = self.pairs.entry(pair).or_default();
                match change {
                    Change::Enter => {
                        uses.count += count;
                        uses.bags.push(bag as u32);
                    }
                    Change::Leave => uses.count = uses.count.saturating_sub(count),
                }
                if uses.count > 1 {
                    self.queue.push(rank(pair, uses.count, net));
                }
            }
        }
    }

    fn write_back(self, net: &mut Net) {
        for bag in self.bags {
            let members = bag.unshared.iter().chain(&bag.members);
            match &mut net.items[bag.item as usize] {
                Item::Product { factors: up, .. } => {
                    up.clear();
                    for member in members {
                        up.extend((0..member.count).map(|_| member.item));
                    }
                }
                Item::Sum(terms) => {
                    terms.clear();
                    terms.extend(members.map(|member| (member.item, member.negative)));
                }
                _ => {}
            }
        }
    }
}

#[derive(Clone, Copy)]
enum Change {
    Enter,
    Leave,
}

fn rank(pair: Pair, count: u32, net: &Net) -> Rank {
    let stage = net.stages[pair.0 as usize].max(net.stages[pair.1 as usize]);
    (count, Reverse(stage), Reverse(pair))
}

/// The number of occurrences of the pair in the bag.
fn occurrences(bag: &Bag, (first, second, opposite): Pair) -> u32 {
    let find = |item| bag.find(item).map(|position| bag.members[position]);
    match (find(first), find(second)) {
        (Some(a), Some(_)) if first == second => a.count / 2,
        (Some(a), Some(b)) if (a.negative != b.negative) == opposite => a.count.min(b.count),
        _ => 0,
    }
}

fn count_factors(factors: &[Index]) -> Vec<Member> {
    let mut sorted = factors.to_vec();
    sorted.sort_unstable();
    let groups = sorted.chunk_by(|a, b| a == b);
    groups
        .map(|group| Member {
            item: group[0],
            negative: false,
            count: group.len() as u32,
        })
        .collect()
}

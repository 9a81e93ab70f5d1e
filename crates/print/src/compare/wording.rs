//! Terms with their factors in the order in which a reader finds them in print.

use lagrangian_symbolic::normal::Difference;
use lagrangian_symbolic::{Expr, Node, Rational, text};

use super::Quoted;
use super::changes::{Factor, Term, differ_by_a_misprint};
use lagrangian_spec::model::PrintedTerm;
use lagrangian_spec::model::product;

/// The terms to add and the terms to drop, as texts.
///
/// A term to drop that occurs in print is written as printed, and the term that replaces it is written in the same
/// order of factors. All others have the usual order.
///
/// With `own_sides`, terms right of an equals sign have the sign that they have there; without, all terms are
/// brought to the left.
pub(super) fn words<'d>(
    mend: &Difference<'d>,
    changes: &[(usize, usize)],
    printed: &[PrintedTerm<'d>],
    own_sides: bool,
) -> [Vec<Quoted>; 2] {
    let values: Vec<Expr<'d>> = printed.iter().filter_map(PrintedTerm::value).collect();
    let find = |&term: &Expr<'d>| {
        let place = values.iter().position(|&value| value == term)?;
        printed.get(place)
    };
    let found: Vec<Option<&PrintedTerm<'d>>> = mend.drop.iter().map(find).collect();
    let usual = |term: Expr<'d>| text(term, term.dag());
    let is_right = |found: &Option<&PrintedTerm<'d>>| found.is_some_and(|term| term.on_the_right);
    let signed = |term: Expr<'d>, right: bool| if right && own_sides { -term } else { term };
    let dropped = mend.drop.iter().zip(&found);
    let drop = dropped.map(|(&term, found)| {
        let on_the_right = is_right(found);
        let text_of = |found: &&PrintedTerm<'d>| {
            if on_the_right && own_sides {
                found.opposite().text()
            } else {
                found.text()
            }
        };
        Quoted {
            text: found.as_ref().map_or_else(|| usual(term), text_of),
            on_the_right,
        }
    });
    let added = mend.add.iter().enumerate().map(|(k, &term)| {
        let change = changes.iter().find(|(_, to)| *to == k);
        let partner = change.and_then(|&(from, _)| found[from]);
        let on_the_right = is_right(&partner);
        let term = signed(term, on_the_right);
        let ordered = partner.and_then(|partner| in_the_order_of(partner, term));
        Quoted {
            text: ordered.unwrap_or_else(|| usual(term)),
            on_the_right,
        }
    });
    [added.collect(), drop.collect()]
}

/// A factor as text.
struct Word<'d> {
    text: String,
    divides: bool,
    /// Its base and exponent; `None` for a number.
    factor: Option<Factor<'d>>,
    /// Whether the term to be written has this factor.
    kept: bool,
}

impl<'d> Word<'d> {
    fn of((base, power): Factor<'d>) -> Word<'d> {
        let magnitude = base.powi(i32::try_from(power.unsigned_abs()).unwrap_or(i32::MAX));
        let bare = text(magnitude, base.dag());
        let is_sum = matches!(magnitude.node(), Node::Sum(_));
        Word {
            text: if is_sum { format!("({bare})") } else { bare },
            divides: power < 0,
            factor: Some((base, power)),
            kept: true,
        }
    }

    /// The sort key of factors in a product.
    fn order(&self) -> impl Ord + use<'d> {
        let base = self.factor.map(|(base, _)| base);
        base.map(|base| (base.stage(), base.as_symbol().is_none()))
    }
}

/// A term written with its factors in the places of the printed term's factors that are equal or differ by a
/// misprint; `None` if the result is not the same term.
fn in_the_order_of<'d>(printed: &PrintedTerm<'d>, term: Expr<'d>) -> Option<String> {
    let dag = term.dag();
    let Term {
        coefficient,
        factors: mut left,
    } = Term::of(term);
    let mut number = Rational::ONE;
    let mut words: Vec<Word<'d>> = Vec::new();
    for factor in &printed.factors {
        let mut word = Word {
            text: factor.text.clone(),
            divides: factor.divides,
            factor: None,
            kept: true,
        };
        if let Some(value) = factor.value.as_constant() {
            number = if factor.divides {
                number.checked_div(&value)?
            } else {
                number.checked_mul(&value)?
            };
        } else {
            let [(base, power)] = Term::of(factor.value).factors[..] else {
                return None;
            };
            let factor = (base, if factor.divides { -power } else { power });
            let place = left.iter().position(|other| *other == factor);
            word.factor = Some(factor);
            word.kept = place.is_some();
            place.map(|place| left.remove(place));
        }
        words.push(word);
    }
    if number != coefficient.abs() {
        words.retain(|word| word.factor.is_some());
        let value = coefficient.abs();
        if !value.is_one() {
            let word = Word {
                text: text(dag.constant(value), dag),
                divides: false,
                factor: None,
                kept: true,
            };
            words.insert(0, word);
        }
    }
    // A factor that differs by a misprint takes the place of the printed one; then any other factor does.
    let alike: [fn(&Factor<'d>, &Factor<'d>) -> bool; 2] = [
        |a, b| a.0 == b.0 || (a.1 == b.1 && differ_by_a_misprint(a.0, b.0)),
        |a, b| (a.1 > 0) == (b.1 > 0),
    ];
    for alike in alike {
        for word in words.iter_mut().filter(|word| !word.kept) {
            let Some(factor) = word.factor else { continue };
            if let Some(place) = left.iter().position(|other| alike(&factor, other)) {
                *word = Word::of(left.remove(place));
            }
        }
    }
    words.retain(|word| word.kept);
    for factor in left {
        let word = Word::of(factor);
        let later = words.iter().position(|other| other.order() > word.order());
        words.insert(later.unwrap_or(words.len()), word);
    }
    let factors = words.iter().filter_map(|word| word.factor);
    let value = dag.product(factors.map(|(base, power)| base.powi(power))) * coefficient.clone();
    let pieces = words.iter().map(|word| (word.text.as_str(), word.divides));
    (value == term).then(|| product(coefficient.is_negative(), pieces))
}

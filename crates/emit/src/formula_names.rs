//! Names of values after their formulas: `e*omega^2` is `e_omega2`, `m1 + m2` is `m1_plus_m2`.

use lagrangian_program::{Op, Program, Source};

use crate::names::{Scope, flat};

/// Longer names than this are no easier to read than a number.
const LONGEST: usize = 24;

/// The name of each prepared value: that of a parameter, one after its formula if that is short, else `k` with a number. `form`
/// converts a name of the spec.
pub fn of_prepared(program: &Program, form: impl Fn(&str) -> String) -> Vec<String> {
    let parameters = program.parameters.iter();
    // A value must not look like a parameter that it is not.
    let parameters: Vec<String> = parameters.map(|slot| form(&flat(&slot.name))).collect();
    let mut scope = Scope::default();
    let mut unnamed = 0;
    let values = program.prepare.results.iter().enumerate();
    let name = |(slot, value): (usize, &_)| {
        if let Op::Read(Source::Parameter(i)) = program.prepare.op(*value) {
            return parameters[*i as usize].clone();
        }
        let formula = program.prepared.get(slot).map_or("", String::as_str);
        let name = of_formula(formula).map(|name| form(&name));
        match name.filter(|name| !parameters.contains(name) && scope.is_free(name)) {
            Some(name) => scope.take_plain(&name),
            None => {
                unnamed += 1;
                format!("k{}", unnamed - 1)
            }
        }
    };
    values.map(name).collect()
}

/// The name of a formula, if it is a short sum of products of names.
fn of_formula(formula: &str) -> Option<String> {
    let mut name = String::new();
    let mut terms = formula.split(' ');
    let first = terms.next()?;
    let (first, sign) = match first.strip_prefix('-') {
        Some(rest) => (rest, "minus_"),
        None => (first, ""),
    };
    name.push_str(sign);
    name.push_str(&of_term(first)?);
    while let Some(operator) = terms.next() {
        name.push_str(match operator {
            "+" => "_plus_",
            "-" => "_minus_",
            _ => return None,
        });
        name.push_str(&of_term(terms.next()?)?);
    }
    (name.chars().count() <= LONGEST).then_some(name)
}

/// The name of a product, or of a quotient of two.
fn of_term(term: &str) -> Option<String> {
    let Some((above, below)) = term.split_once('/') else {
        return of_product(term);
    };
    let below = of_product(below)?;
    match above {
        "1" => Some(format!("inverse_{below}")),
        _ => Some(format!("{}_over_{below}", of_product(above)?)),
    }
}

fn of_product(product: &str) -> Option<String> {
    let factors: Option<Vec<String>> = product.split('*').map(of_factor).collect();
    Some(factors?.join("_"))
}

fn of_factor(factor: &str) -> Option<String> {
    let (base, exponent) = match factor.split_once('^') {
        Some((base, exponent)) => (of_factor(base)?, exponent),
        None => return of_leaf(factor),
    };
    // The square of m1 is not m12, and that of m is not m2, which is often another mass.
    match exponent {
        "2" if base.chars().count() == 1 || base.ends_with(char::is_numeric) => {
            Some(format!("{base}_squared"))
        }
        "3" if base.chars().count() == 1 || base.ends_with(char::is_numeric) => {
            Some(format!("{base}_cubed"))
        }
        "2" | "3" => Some(format!("{base}{exponent}")),
        _ => None,
    }
}

/// The word for a number or a name: `m[3]` is `m_3`.
fn of_leaf(text: &str) -> Option<String> {
    let word = match text {
        "0.25" => "quarter",
        "0.5" => "half",
        "2" => "two",
        "3" => "three",
        "4" => "four",
        _ => "",
    };
    if !word.is_empty() {
        return Some(word.to_owned());
    }
    let (base, index) = match text.split_once('[') {
        Some((base, index)) => (base, Some(index.strip_suffix(']')?)),
        None => (text, None),
    };
    let is_name = base.starts_with(|c: char| c.is_alphabetic() || c == '_')
        && base.chars().all(|c| c.is_alphanumeric() || c == '_');
    if !is_name {
        return None;
    }
    Some(match index {
        None => base.to_owned(),
        Some(index) => format!("{base}_{}", index.replace('-', "m")),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_formulas_have_names() {
        for (formula, name) in [
            ("e*omega^2", "e_omega2"),
            ("m1 + m2", "m1_plus_m2"),
            ("-m2*l1*l2", "minus_m2_l1_l2"),
            ("0.5*m1*l1^2", "half_m1_l1_squared"),
            ("J - m*r^2", "J_minus_m_r_squared"),
            ("1/m3", "inverse_m3"),
            ("m[3]*g", "m_3_g"),
            ("2*k/omega", "two_k_over_omega"),
        ] {
            assert_eq!(of_formula(formula).as_deref(), Some(name), "{formula}");
        }
    }

    #[test]
    fn long_or_ambiguous_formulas_have_none() {
        for formula in [
            "",
            "l1*(m1 + m2)",
            "sin(alpha)",
            "m^4",
            "7.25*m",
            "1/(m1 + m2)",
            "a/b/c",
            "first_mass + second_mass + third_mass",
        ] {
            assert_eq!(of_formula(formula), None, "{formula}");
        }
    }
}

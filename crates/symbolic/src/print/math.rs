//! A formula as it is set on a page, before anyone says in which language.

use std::borrow::Cow;

/// A formula as it is set: what a page shows.
///
/// A row of marks: letters, numbers and signs, and brackets around what is set in another way, `Open(Fraction)` above
/// `Next` below `Close`. It is flat, so that a formula of any depth is built, broken into lines, written and dropped
/// without a stack. [`Math::latex`] and [`Math::mathml`] write the same marks.
///
/// ```
/// use lagrangian_symbolic::Math;
///
/// let half = Math::fraction(Math::number(1), Math::number(2));
/// let momentum = Math::letter('p').with_index(Math::letter('θ'));
/// let formula = half * momentum.squared();
/// assert_eq!(formula.latex(), r"\frac{1}{2} p_{\theta}^{2}");
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Math {
    pub(super) marks: Vec<Mark>,
}

/// A piece of a formula.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Mark {
    /// A letter that stands for a quantity: in italics, capital Greek letters upright.
    Letter(char),
    /// A letter that stands for a vector or a matrix: bold.
    Bold(char),
    /// A name of several letters: upright.
    Word(String),
    /// Words of a language, spaces kept.
    Text(Cow<'static, str>),
    /// A number that is not negative, in digits.
    Number(String),
    /// The name of a function: sin.
    Function(&'static str),
    /// What stands between quantities.
    Sign(Sign),
    /// What follows, up to the [`Mark::Close`] that belongs to it, is set in another way.
    Open(Form),
    /// Ends an argument of a form that has another one.
    Next,
    /// Ends the last argument of a form.
    Close,
}

/// What stands between quantities.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sign {
    /// Between terms.
    Plus,
    /// Between terms.
    Minus,
    /// Before a quantity.
    Negative,
    /// Between equals.
    Equals,
    /// Between factors: nothing to see.
    Times,
    /// Between numbers: a dot.
    Dot,
    /// Between a function and its argument: nothing to see.
    Apply,
    /// Between what is and what it becomes.
    To,
    /// Between arguments.
    Comma,
    /// Sum.
    Sum,
    /// And so on, between commas.
    Dots,
    /// As wide as a letter m.
    Quad,
    /// A parenthesis that is closed in another line.
    LeftParenthesis,
    /// A parenthesis that was opened in another line.
    RightParenthesis,
}

/// A way of setting arguments.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// The first above the second.
    Fraction,
    /// The second at the upper right of the first.
    Power,
    /// The second at the lower right of the first.
    Index,
    /// The second at the lower right of the first, the third at the upper right.
    IndexAndPower,
    /// The second under the first, where it fits: the index of a sum.
    Under,
    /// The square root of the only argument.
    Root,
    /// So many dots over the only argument, one to three.
    Dots(u8),
    /// The only argument, in parentheses.
    Parentheses,
    /// The only argument between bars.
    Bars,
    /// The arguments in so many columns, row by row, in large parentheses.
    Matrix(usize),
}

impl Math {
    /// One mark.
    pub fn mark(mark: Mark) -> Math {
        Math { marks: vec![mark] }
    }

    /// A quantity.
    pub fn letter(letter: char) -> Math {
        Math::mark(Mark::Letter(letter))
    }

    /// A vector or a matrix.
    pub fn bold(letter: char) -> Math {
        Math::mark(Mark::Bold(letter))
    }

    /// Words of a language.
    pub fn text(words: impl Into<Cow<'static, str>>) -> Math {
        Math::mark(Mark::Text(words.into()))
    }

    /// An integer.
    pub fn number(number: i64) -> Math {
        let digits = Math::mark(Mark::Number(number.unsigned_abs().to_string()));
        if number < 0 { -digits } else { digits }
    }

    /// A sign.
    pub fn sign(sign: Sign) -> Math {
        Math::mark(Mark::Sign(sign))
    }

    /// Arguments set in another way.
    pub fn form(form: Form, arguments: impl IntoIterator<Item = Math>) -> Math {
        let mut marks = vec![Mark::Open(form)];
        for (index, argument) in arguments.into_iter().enumerate() {
            if index > 0 {
                marks.push(Mark::Next);
            }
            marks.extend(argument.marks);
        }
        marks.push(Mark::Close);
        Math { marks }
    }

    /// One above the other.
    pub fn fraction(above: Math, below: Math) -> Math {
        Math::form(Form::Fraction, [above, below])
    }

    /// With something at the lower right.
    pub fn with_index(self, index: Math) -> Math {
        Math::form(Form::Index, [self, index])
    }

    /// With an exponent; a letter with an index takes it above the index.
    pub fn power(mut self, exponent: Math) -> Math {
        if self.is_index() {
            self.marks[0] = Mark::Open(Form::IndexAndPower);
            self.marks.pop();
            self.marks.push(Mark::Next);
            self.marks.extend(exponent.marks);
            self.marks.push(Mark::Close);
            return self;
        }
        Math::form(Form::Power, [self, exponent])
    }

    /// With the exponent 2.
    pub fn squared(self) -> Math {
        self.power(Math::number(2))
    }

    /// With a dot above: the rate.
    #[must_use]
    pub fn dotted(self) -> Math {
        Math::form(Form::Dots(1), [self])
    }

    /// In parentheses.
    #[must_use]
    pub fn in_parentheses(self) -> Math {
        Math::form(Form::Parentheses, [self])
    }

    /// Some formulas, one after the other.
    pub fn row(formulas: impl IntoIterator<Item = Math>) -> Math {
        let marks = formulas.into_iter().flat_map(|formula| formula.marks);
        Math {
            marks: marks.collect(),
        }
    }

    /// Some formulas with the same sign between them.
    pub fn joined(formulas: impl IntoIterator<Item = Math>, sign: Sign) -> Math {
        let mut marks = Vec::new();
        for (index, formula) in formulas.into_iter().enumerate() {
            if index > 0 {
                marks.push(Mark::Sign(sign));
            }
            marks.extend(formula.marks);
        }
        Math { marks }
    }

    /// The formula with another after the sign.
    #[must_use]
    pub fn then(mut self, sign: Sign, right: Math) -> Math {
        self.marks.push(Mark::Sign(sign));
        self.marks.extend(right.marks);
        self
    }

    /// `self = right`.
    #[must_use]
    pub fn equals(self, right: Math) -> Math {
        self.then(Sign::Equals, right)
    }

    /// The marks.
    pub fn marks(&self) -> &[Mark] {
        &self.marks
    }

    /// Whether nothing is in it.
    pub fn is_empty(&self) -> bool {
        self.marks.is_empty()
    }

    /// Whether it is one letter or word with an index.
    fn is_index(&self) -> bool {
        if self.marks.first() != Some(&Mark::Open(Form::Index)) {
            return false;
        }
        let mut depth = 0;
        let first_end = self.marks.iter().position(|mark| {
            depth += match mark {
                Mark::Open(_) => 1,
                Mark::Close => -1,
                _ => 0,
            };
            depth == 0
        });
        first_end == Some(self.marks.len() - 1)
    }
}

/// `self + right`; where the right side begins with a sign, that sign alone: a + −b is a − b.
impl std::ops::Add for Math {
    type Output = Math;
    fn add(self, mut right: Math) -> Math {
        if right.marks.first() == Some(&Mark::Sign(Sign::Negative)) {
            right.marks.remove(0);
            return self.then(Sign::Minus, right);
        }
        self.then(Sign::Plus, right)
    }
}

/// `self − right`.
impl std::ops::Sub for Math {
    type Output = Math;
    fn sub(self, right: Math) -> Math {
        self.then(Sign::Minus, right)
    }
}

/// The factors side by side.
impl std::ops::Mul for Math {
    type Output = Math;
    fn mul(self, right: Math) -> Math {
        self.then(Sign::Times, right)
    }
}

/// With a sign before it.
impl std::ops::Neg for Math {
    type Output = Math;
    fn neg(self) -> Math {
        Math::row([Math::sign(Sign::Negative), self])
    }
}

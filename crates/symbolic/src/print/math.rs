//! Formulas in typeset form, independent of the output language.

use std::borrow::Cow;

/// A typeset formula, as shown on a page.
///
/// It is a sequence of marks: letters, numbers and signs, and brackets around content in another form,
/// `Open(Fraction)` above `Next` below `Close`. It is flat, so that a formula of any depth is built, broken into
/// lines, written and dropped without recursion. [`Math::latex`] and [`Math::mathml`] write the same marks.
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
    /// A letter for a quantity: italic, capital Greek letters upright.
    Letter(char),
    /// A letter for a vector or a matrix: bold.
    Bold(char),
    /// A name of several letters: upright.
    Word(String),
    /// Words of a natural language, with their spaces.
    Text(Cow<'static, str>),
    /// A nonnegative number, in digits.
    Number(String),
    /// The name of a function: sin.
    Function(&'static str),
    /// A sign between quantities.
    Sign(Sign),
    /// Begins content in another form, up to the matching [`Mark::Close`].
    Open(Form),
    /// Ends an argument of a form that is followed by another one.
    Next,
    /// Ends the last argument of a form.
    Close,
}

/// A sign between quantities.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sign {
    /// Between terms.
    Plus,
    /// Between terms.
    Minus,
    /// Before a quantity.
    Negative,
    /// Between the sides of an equation.
    Equals,
    /// Between factors: invisible.
    Times,
    /// Between numbers: a dot.
    Dot,
    /// Between a function and its argument: invisible.
    Apply,
    /// Between a quantity and its limit or replacement.
    To,
    /// Between arguments.
    Comma,
    /// Sum.
    Sum,
    /// An ellipsis between commas.
    Dots,
    /// A space of the width of a letter m.
    Quad,
    /// A parenthesis that is closed on another line.
    LeftParenthesis,
    /// A parenthesis that was opened on another line.
    RightParenthesis,
}

/// A form in which arguments are set.
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
    /// The second below the first, if it fits: the index of a sum.
    Under,
    /// The square root of the only argument.
    Root,
    /// The given number of dots over the only argument, one to three.
    Dots(u8),
    /// The only argument, in parentheses.
    Parentheses,
    /// The only argument, between bars.
    Bars,
    /// The arguments in the given number of columns, row by row, in large parentheses.
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

    /// Words of a natural language.
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

    /// Arguments in another form.
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

    /// A fraction.
    pub fn fraction(above: Math, below: Math) -> Math {
        Math::form(Form::Fraction, [above, below])
    }

    /// Adds a subscript.
    pub fn with_index(self, index: Math) -> Math {
        Math::form(Form::Index, [self, index])
    }

    /// Adds an exponent; a letter with a subscript takes it above the subscript.
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

    /// Adds the exponent 2.
    pub fn squared(self) -> Math {
        self.power(Math::number(2))
    }

    /// Adds a dot above: the rate.
    #[must_use]
    pub fn dotted(self) -> Math {
        Math::form(Form::Dots(1), [self])
    }

    /// In parentheses.
    #[must_use]
    pub fn in_parentheses(self) -> Math {
        Math::form(Form::Parentheses, [self])
    }

    /// Several formulas, one after the other.
    pub fn row(formulas: impl IntoIterator<Item = Math>) -> Math {
        let marks = formulas.into_iter().flat_map(|formula| formula.marks);
        Math {
            marks: marks.collect(),
        }
    }

    /// Several formulas with the same sign between them.
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

    /// The formula followed by the sign and another formula.
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

    /// Whether it has no marks.
    pub fn is_empty(&self) -> bool {
        self.marks.is_empty()
    }

    /// Whether it is a single letter or word with a subscript.
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

/// `self + right`; if the right side begins with a sign, only that sign is written: a + −b is a − b.
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

/// Puts a sign before it.
impl std::ops::Neg for Math {
    type Output = Math;
    fn neg(self) -> Math {
        Math::row([Math::sign(Sign::Negative), self])
    }
}

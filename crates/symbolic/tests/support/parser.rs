//! Parses expressions of the spec language, to read back what was printed.

use lagrangian_symbolic::{Dag, Expr, Function, Rational};

pub struct Parser<'a, 'd> {
    dag: &'d Dag,
    symbols: &'a [(&'a str, Expr<'d>)],
    rest: &'a str,
}

/// Parses an expression; chains of terms and of factors are built at once, as written.
pub fn parse<'d>(dag: &'d Dag, symbols: &[(&str, Expr<'d>)], text: &str) -> Expr<'d> {
    let mut parser = Parser {
        dag,
        symbols,
        rest: text,
    };
    let e = parser.sum();
    assert_eq!(parser.rest, "", "left over of {text}");
    e
}

impl<'d> Parser<'_, 'd> {
    fn eat(&mut self, token: &str) -> bool {
        let rest = self.rest.trim_start();
        let found = rest.strip_prefix(token);
        self.rest = found.unwrap_or(self.rest);
        found.is_some()
    }

    fn sum(&mut self) -> Expr<'d> {
        let mut terms = vec![if self.eat("-") {
            -self.product()
        } else {
            self.product()
        }];
        loop {
            if self.eat("+") {
                terms.push(self.product());
            } else if self.eat("-") {
                terms.push(-self.product());
            } else {
                return if terms.len() == 1 {
                    terms[0]
                } else {
                    self.dag.sum(terms)
                };
            }
        }
    }

    fn product(&mut self) -> Expr<'d> {
        let mut factors = vec![self.power()];
        loop {
            if self.eat("*") {
                factors.push(self.power());
            } else if self.eat("/") {
                factors.push(1 / self.power());
            } else {
                return self.dag.product(factors);
            }
        }
    }

    fn power(&mut self) -> Expr<'d> {
        let base = self.atom();
        if self.eat("^") {
            base.pow(self.power())
        } else {
            base
        }
    }

    fn atom(&mut self) -> Expr<'d> {
        self.rest = self.rest.trim_start();
        if self.eat("(") {
            let inner = self.sum();
            assert!(self.eat(")"), "{}", self.rest);
            return inner;
        }
        // A number, from the longest run of characters that can be one.
        if self.rest.starts_with(|c: char| c.is_ascii_digit()) {
            let bytes = self.rest.as_bytes();
            let part = |i: usize| match bytes[i] {
                b'0'..=b'9' | b'.' | b'e' => true,
                b'-' => bytes[i - 1] == b'e',
                _ => false,
            };
            let length = (0..bytes.len()).find(|&i| !part(i)).unwrap_or(bytes.len());
            let (number, rest) = self.rest.split_at(length);
            self.rest = rest;
            return self
                .dag
                .constant(Rational::parse_decimal(number).expect(number));
        }
        // Longest names first: atan2 before atan.
        let mut functions = Function::ALL;
        functions.sort_by_key(|f| core::cmp::Reverse(f.name().len()));
        for function in functions {
            if self.eat(&format!("{}(", function.name())) {
                let mut arguments = vec![self.sum()];
                while self.eat(", ") {
                    arguments.push(self.sum());
                }
                assert!(self.eat(")"), "{}", self.rest);
                return self.dag.function(function, &arguments);
            }
        }
        if let Some((name, symbol)) = self
            .symbols
            .iter()
            .rev()
            .find(|(name, _)| self.rest.starts_with(name))
        {
            self.rest = &self.rest[name.len()..];
            return *symbol;
        }
        assert!(self.eat("pi"), "no expression: {}", self.rest);
        self.dag.pi()
    }
}

//! Checks bounds of numbers at the defaults of the parameters.

use lagrangian_symbolic::Expr;
use rustc_hash::FxHashMap;

use super::Resolver;
use super::value::MemberId;
use crate::diagnostic::Diagnostic;
use crate::model::bounds::{Bound, BoundKind, violations};
use crate::model::{Assumption, Parameter, stage};
use crate::source::Span;

impl<'d> Resolver<'_, 'd, '_> {
    /// Records a bounded number, if it depends on parameters alone.
    pub fn bound(&mut self, kind: BoundKind<'d>, value: Expr<'d>, span: Span) {
        let bound = Bound { kind, value, span };
        if bound.is_of_parameters() {
            self.bounds.push(bound);
        }
    }

    /// Reports numbers beyond their bounds at the defaults of the parameters, and returns all bounds.
    pub fn check_bounds(
        &mut self,
        assumptions: &[Assumption<'d>],
        parameters: &[(MemberId, Parameter<'d>)],
    ) -> Vec<Bound<'d>> {
        let mut bounds = std::mem::take(&mut self.bounds);
        bounds.retain(|bound| !bound.is_intentional(assumptions));
        let mut values = FxHashMap::default();
        for (_, parameter) in parameters {
            let default = parameter.default;
            let number = default.map_or(f64::NAN, lagrangian_symbolic::nearest);
            values.extend(parameter.symbol.as_symbol().map(|symbol| (symbol, number)));
        }
        let value = |symbol| values.get(&symbol).copied().unwrap_or(f64::NAN);
        for (place, code, message) in violations(self.dag, &bounds, value) {
            let Bound { kind, value, span } = bounds[place];
            // The message is about the default if the number is that parameter alone, and not a formula of several.
            let mut parameters = parameters.iter();
            let is_one = !matches!(kind, BoundKind::Tensor(_));
            let alone = parameters.find(|(_, parameter)| is_one && parameter.symbol == value);
            let default =
                alone.and_then(|(parameter, _)| self.quantity(*parameter)?.value.as_ref());
            let diagnostic = match default {
                Some(default) => Diagnostic::new(code, default.span, message)
                    .note(span, "this is where it is used"),
                None => Diagnostic::new(code, span, message),
            };
            self.push(match (kind.may_be_intentional(), default) {
                (true, _) => diagnostic.help(kind.intentional_help()),
                (false, None) if value.stage() > stage::CONSTANT => {
                    diagnostic.help("this is its value for the defaults of the parameters")
                }
                _ => diagnostic,
            });
        }
        bounds
    }
}

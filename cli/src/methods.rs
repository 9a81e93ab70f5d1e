//! Integration methods by name.

use lagrangian::methods::Method;
use lagrangian_spec::diagnostic::most_similar;

use crate::failure::Failure;

/// Automatic choice of methods: the default one, implicit ones where the machine is stiff, and time stepping where
/// contacts meet too often.
pub const AUTO: &str = "auto";

/// The method with this name.
pub fn named(name: &str) -> Result<&'static Method, Failure> {
    named_or(name, &[])
}

/// The method with this name, where `others` are also valid and listed in the error message.
pub fn named_or(name: &str, others: &[&'static str]) -> Result<&'static Method, Failure> {
    Method::named(name).ok_or_else(|| {
        let methods = || Method::all().map(|method| method.tableau.name);
        let names = || others.iter().copied().chain(methods());
        let help = match most_similar(name, names()) {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!("there are: {}", names().collect::<Vec<_>>().join(", ")),
        };
        Failure::Call(format!("no method named `{name}`; {help}"))
    })
}

//! Integration methods by name.

use lagrangian::methods::Method;

use crate::failure::{Failure, help_with};

/// Automatic choice of methods: the default one, implicit ones where the machine is stiff, and time stepping where
/// contacts meet too often.
pub const AUTO: &str = "auto";

/// The method with this name, of a command whose runs have no `--longest-step`.
///
/// # Errors
/// If there is none, or if its steps have a fixed length.
pub fn named(name: &str) -> Result<&'static Method, Failure> {
    named_beside(name, &[])
}

/// [`named`], where `others` are also valid and listed in the error message.
pub fn named_beside(name: &str, others: &[&'static str]) -> Result<&'static Method, Failure> {
    let method = found(name, others, |method| !method.has_fixed_steps())?;
    if method.has_fixed_steps() {
        return Err(Failure::Call(format!(
            "--method {name}: its steps have a fixed length, which only `simulate` can be given, by --longest-step"
        )));
    }
    Ok(method)
}

/// The method with this name, where `others` are also valid and listed in the error message.
pub fn named_or(name: &str, others: &[&'static str]) -> Result<&'static Method, Failure> {
    found(name, others, |_| true)
}

/// The method with this name. If there is none, the error names the `others` and the methods that are `offered`.
fn found(
    name: &str,
    others: &[&'static str],
    offered: fn(&Method) -> bool,
) -> Result<&'static Method, Failure> {
    Method::named(name).ok_or_else(|| {
        let methods = Method::all().filter(|method| offered(method));
        let methods = methods.map(|method| method.tableau.name);
        let help = help_with(name, others.iter().copied().chain(methods));
        Failure::Call(format!("no method named `{name}`; {help}"))
    })
}

//! What the varied names of a plan stand for.

use lagrangian_spec::diagnostic::most_similar;
use lagrangian_spec::model::{Coordinate, Model};
use lagrangian_spec::unit::{integral_name, rate_unit, state_of};

/// What a varied name stands for.
#[derive(Clone, Debug)]
pub(super) enum VariedQuantity {
    /// A parameter or an input.
    Set(String),
    /// A coordinate at the start.
    Start(String),
    /// Its rate.
    Rate(String),
}

impl VariedQuantity {
    /// Resolves a name: `omega`, `start(x)`, `rate(x)`. A state of first order is the rate of its integral.
    pub(super) fn of(name: &str, model: &Model<'_>) -> VariedQuantity {
        let inner = |function: &str| {
            let inner = name.strip_prefix(function)?.strip_prefix('(')?;
            Some(inner.strip_suffix(')')?.trim().to_owned())
        };
        match (inner("start"), inner("rate")) {
            (Some(name), _) => {
                let integral = integral_name(&name);
                let is_meant = |c: &Coordinate<'_>| {
                    let own = c.name.to_string();
                    own == integral || (state_of(&own).is_some() && c.name.base == integral)
                };
                if model.coordinates.iter().any(is_meant) {
                    VariedQuantity::Rate(integral)
                } else {
                    VariedQuantity::Start(name)
                }
            }
            (_, Some(name)) => VariedQuantity::Rate(name),
            _ => VariedQuantity::Set(name.to_owned()),
        }
    }

    /// Whether it is a member of a family; members are set after the family.
    pub(super) fn is_member(&self) -> bool {
        let (VariedQuantity::Set(name) | VariedQuantity::Start(name) | VariedQuantity::Rate(name)) =
            self;
        name.contains('[')
    }
}

/// The unit of a name given to `--vary`.
///
/// # Errors
/// If the machine has nothing of this name; suggests a similar name.
pub fn unit_of(model: &Model<'_>, name: &str) -> Result<String, String> {
    let place = VariedQuantity::of(name, model);
    let (kind, wanted) = match &place {
        VariedQuantity::Set(name) => ("parameter or input", name),
        VariedQuantity::Start(name) | VariedQuantity::Rate(name) => ("coordinate", name),
    };
    let wanted = &*lagrangian_spec::token::normalized(wanted);
    let coordinates = model.coordinates.iter().map(|c| match c.rate {
        Some(_) => (c.name.to_string(), c.unit_text.clone()),
        None => (c.name.to_string(), c.unit.to_string()),
    });
    let parameters = model
        .parameters
        .iter()
        .map(|p| (p.name.to_string(), p.unit_text.clone()));
    let inputs = model
        .inputs
        .iter()
        .map(|i| (i.name.to_string(), i.unit_text.clone()));
    let known: Vec<(String, String)> = match place {
        VariedQuantity::Set(_) => parameters.chain(inputs).collect(),
        _ => coordinates.collect(),
    };
    let is_meant =
        |name: &str| name == wanted || name.split_once('[').is_some_and(|(base, _)| base == wanted);
    if let Some((name, unit)) = known.iter().find(|(name, _)| is_meant(name)) {
        return Ok(match place {
            VariedQuantity::Rate(_) if state_of(name).is_some() => rate_unit(name, unit),
            VariedQuantity::Rate(_) => format!("({unit})/s"),
            _ => unit.clone(),
        });
    }
    let is_coordinate = model
        .coordinates
        .iter()
        .any(|c| is_meant(&c.name.to_string()));
    let names = || known.iter().map(|(name, _)| name.as_str());
    let help = match most_similar(wanted, names()) {
        _ if is_coordinate && matches!(place, VariedQuantity::Set(_)) => {
            format!("it is a coordinate, whose start is `start({wanted})`")
        }
        Some(near) => format!("did you mean `{near}`?"),
        None if known.is_empty() => "there are none".to_owned(),
        None => format!("there are: {}", names().collect::<Vec<_>>().join(", ")),
    };
    Err(format!("no {kind} named `{wanted}`; {help}"))
}

//! What a run leaves behind: one row for each instant, one column for each quantity.

/// What a column holds; decides into which panel of the plot it goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A generalized coordinate.
    Coordinate,
    /// The rate of a coordinate.
    Rate,
    /// An energy: kinetic, potential, their sum.
    Energy,
    /// What is left over in the energy balance.
    Residual,
    /// A quantity that the spec asks to observe.
    Output,
}

/// One quantity along the run.
#[derive(Clone, Debug)]
pub struct Column {
    /// Its name, as the header of a table shows it.
    pub name: String,
    /// Its unit, as a spec writes it.
    pub unit: String,
    /// What it is.
    pub kind: Kind,
    /// Its values, one for each instant.
    pub values: Vec<f64>,
}

/// The whole run, column by column.
#[derive(Clone, Debug, Default)]
pub struct Recording {
    /// The instants, in s.
    pub times: Vec<f64>,
    /// The quantities; all as long as `times`.
    pub columns: Vec<Column>,
}

impl Recording {
    /// The columns of one kind.
    pub fn of_kind(&self, kind: Kind) -> impl Iterator<Item = &Column> {
        self.columns
            .iter()
            .filter(move |column| column.kind == kind)
    }

    /// The headers of a table: the name with its unit, `s1 [m]`, time first.
    pub fn headers(&self) -> impl Iterator<Item = String> + '_ {
        let columns = self
            .columns
            .iter()
            .map(|column| match column.unit.as_str() {
                "1" => column.name.clone(),
                unit => format!("{} [{unit}]", column.name),
            });
        std::iter::once("t [s]".to_owned()).chain(columns)
    }
}

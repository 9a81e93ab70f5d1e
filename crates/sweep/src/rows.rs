//! Rows of a sweep, column by column.

/// A column: its name, the unit of its numbers, and what it holds.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Its name.
    pub name: String,
    /// The unit, where it has one.
    pub unit: Option<String>,
    /// What it holds.
    pub kind: Kind,
}

/// What a column holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Whole numbers.
    Count,
    /// Numbers.
    Number,
    /// Texts.
    Text,
}

/// The values of a column; nothing where there is none.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Whole numbers.
    Count(Vec<u64>),
    /// Numbers.
    Number(Vec<Option<f64>>),
    /// Texts.
    Text(Vec<Option<String>>),
}

/// One value.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// A whole number.
    Count(u64),
    /// A number, or none.
    Number(Option<f64>),
    /// A text, or none.
    Text(Option<String>),
}

/// Rows, column by column; all columns are equally long.
#[derive(Clone, Debug, PartialEq)]
pub struct Rows {
    /// The columns.
    pub columns: Vec<Column>,
    /// The values of each.
    pub values: Vec<Values>,
}

impl Rows {
    /// No rows yet.
    pub fn new(columns: Vec<Column>) -> Rows {
        let empty = |column: &Column| match column.kind {
            Kind::Count => Values::Count(Vec::new()),
            Kind::Number => Values::Number(Vec::new()),
            Kind::Text => Values::Text(Vec::new()),
        };
        Rows {
            values: columns.iter().map(empty).collect(),
            columns,
        }
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.values.first().map_or(0, Values::len)
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Adds a row, a value for each column in order.
    pub fn push(&mut self, row: impl IntoIterator<Item = Cell>) {
        for (values, cell) in self.values.iter_mut().zip(row) {
            match (values, cell) {
                (Values::Count(values), Cell::Count(value)) => values.push(value),
                (Values::Number(values), Cell::Number(value)) => values.push(value),
                (Values::Text(values), Cell::Text(value)) => values.push(value),
                (values, _) => values.push_nothing(),
            }
        }
    }

    /// Adds the rows of others with the same columns.
    pub fn extend(&mut self, other: Rows) {
        for (values, others) in self.values.iter_mut().zip(other.values) {
            match (values, others) {
                (Values::Count(values), Values::Count(others)) => values.extend(others),
                (Values::Number(values), Values::Number(others)) => values.extend(others),
                (Values::Text(values), Values::Text(others)) => values.extend(others),
                _ => {}
            }
        }
    }

    /// Takes the first rows away, as many as are asked for or there are.
    pub fn take(&mut self, count: usize) -> Rows {
        let values = self.values.iter_mut().map(|values| match values {
            Values::Count(values) => Values::Count(first(values, count)),
            Values::Number(values) => Values::Number(first(values, count)),
            Values::Text(values) => Values::Text(first(values, count)),
        });
        Rows {
            values: values.collect(),
            columns: self.columns.clone(),
        }
    }

    /// The values of the column of this name.
    pub fn column(&self, name: &str) -> Option<&Values> {
        let place = self.columns.iter().position(|column| column.name == name)?;
        self.values.get(place)
    }
}

fn first<T>(values: &mut Vec<T>, count: usize) -> Vec<T> {
    let rest = values.split_off(count.min(values.len()));
    std::mem::replace(values, rest)
}

impl Values {
    fn len(&self) -> usize {
        match self {
            Values::Count(values) => values.len(),
            Values::Number(values) => values.len(),
            Values::Text(values) => values.len(),
        }
    }

    fn push_nothing(&mut self) {
        match self {
            Values::Count(values) => values.push(0),
            Values::Number(values) => values.push(None),
            Values::Text(values) => values.push(None),
        }
    }
}

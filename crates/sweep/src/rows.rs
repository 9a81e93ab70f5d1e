//! Rows of a sweep, stored by column.

/// A column: its name, the unit of its numbers, and the kind of its values.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Its name.
    pub name: String,
    /// The unit, where it has one.
    pub unit: Option<String>,
    /// The kind of its values.
    pub kind: ColumnType,
}

/// The kind of the values of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ColumnType {
    /// Whole numbers.
    Count,
    /// Numbers.
    Number,
    /// Texts.
    Text,
}

/// The values of a column; `None` for missing ones.
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
    /// A number, or a missing value.
    Number(Option<f64>),
    /// A text, or a missing value.
    Text(Option<String>),
}

/// Rows, stored by column; all columns have equal length.
#[derive(Clone, Debug, PartialEq)]
pub struct Rows {
    /// The descriptions of the columns.
    pub columns: Vec<Column>,
    /// The values of each column.
    pub values: Vec<Values>,
}

impl Rows {
    /// An empty set of rows.
    pub fn new(columns: Vec<Column>) -> Rows {
        let empty = |column: &Column| match column.kind {
            ColumnType::Count => Values::Count(Vec::new()),
            ColumnType::Number => Values::Number(Vec::new()),
            ColumnType::Text => Values::Text(Vec::new()),
        };
        Rows {
            values: columns.iter().map(empty).collect(),
            columns,
        }
    }

    /// The number of rows.
    pub fn len(&self) -> usize {
        self.values.first().map_or(0, Values::len)
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Appends a row, with a value for each column in order.
    pub fn push(&mut self, row: impl IntoIterator<Item = Cell>) {
        for (values, cell) in self.values.iter_mut().zip(row) {
            match (values, cell) {
                (Values::Count(values), Cell::Count(value)) => values.push(value),
                (Values::Number(values), Cell::Number(value)) => values.push(value),
                (Values::Text(values), Cell::Text(value)) => values.push(value),
                (values, _) => values.push_missing(),
            }
        }
    }

    /// Appends rows that have the same columns.
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

    /// Removes and returns the first `count` rows, or all if there are fewer.
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

    /// The values of the column with this name.
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

    fn push_missing(&mut self) {
        match self {
            Values::Count(values) => values.push(0),
            Values::Number(values) => values.push(None),
            Values::Text(values) => values.push(None),
        }
    }
}

//! The syntax tree of a spec.
//!
//! Every name, field and expression keeps its place in the text. Sums, products and chains of
//! methods are lists, so that only brackets, powers and signs nest, and their depth is limited: a
//! traversal of a tree may recurse.

use std::fmt;

use crate::source::Span;
use crate::syntax::section::Section;

/// One machine, as written.
///
/// The items of a section are in one list, in the order of the text, even if the section repeats.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Spec {
    /// Documentation of the machine.
    pub docs: String,
    /// The name of the machine; empty if the text has none.
    pub name: Ident,
    /// `in plane` or `in space`.
    pub space: Option<Spanned<Space>>,
    /// The file that `extends` names.
    pub extends: Option<Spanned<String>>,
    /// The headings, in the order of the text; a section that repeats is listed repeatedly.
    pub sections: Vec<Spanned<SectionKind>>,

    /// `name: unit = default`
    pub parameters: Vec<Item<Quantity>>,
    /// `name: unit = value`, or `name = value`
    pub constants: Vec<Item<Quantity>>,
    /// `name: unit = start`
    pub coordinates: Vec<Item<Quantity>>,
    /// `der(name): unit = rate`, among the coordinates; the value is never left out
    pub rates: Vec<Item<Quantity>>,
    /// `name: unit = start`, first-order states
    pub states: Vec<Item<Quantity>>,
    /// `der(name) = expression`, among the states; the value is never left out, the unit is if none is given
    pub state_rates: Vec<Item<Quantity>>,
    /// `name: unit = default`
    pub inputs: Vec<Item<Quantity>>,
    /// `name: unit = expression`; the value is never left out
    pub outputs: Vec<Item<Quantity>>,

    /// `name = expression`
    pub define: Vec<Item<Expression>>,
    /// Outputs that formulas of the program that reads the spec contain, as definitions. No text in the spec can set this.
    pub shared_outputs: Vec<Item<Quantity>>,
    /// `name = frame`
    pub frames: Vec<Item<Expression>>,

    /// `name { mass, inertia, at, angle, frame }`
    pub bodies: Vec<Item<Record>>,
    /// `name { on, center, radius }`
    pub circles: Vec<Item<Record>>,
    /// `name { on, center, radius }`, in space
    pub spheres: Vec<Item<Record>>,
    /// `name { circle or sphere, inside or outside or along, restitution, friction }` or `name { gap, slip, … }`
    pub contacts: Vec<Item<Record>>,

    /// The items of all sections of elements: springs, forces, constraints, …
    pub elements: Vec<ElementItem>,
    /// The sections of elements that are a single statement: `gravity (0, -g);`
    pub statements: Vec<SectionStatement>,

    /// `coordinate: frozen` or `coordinate: small`
    pub approximations: Vec<Item<Spanned<Approximation>>>,
    /// `coordinates`, `rates`, `inputs`, `parameters`, or the name of a parameter
    pub derivatives: Vec<Item<()>>,
    /// `time`, `coordinates`
    pub stages: Vec<Item<()>>,
    /// The integration methods for which emitted code needs more than accelerations.
    pub methods: Vec<Item<()>>,
    /// `name: polar(s, phi) | cartesian(x, y)`
    pub charts: Vec<Item<Charts>>,
    /// `theta`, or `der(theta)`, which is the name of a rate here
    pub keep: Vec<Item<()>>,
    /// `coordinate = expression`
    pub brachistochrone: Vec<Item<Expression>>,
    /// `left > right`
    pub assume: Vec<Relation>,
    /// `published "title" { … }`
    pub published: Vec<Published>,
    /// `remove section.name;`
    pub remove: Vec<Remove>,
    /// The files in `table("…", x)`, with their columns if given.
    pub tables: Vec<Spanned<String>>,

    /// Whether something was skipped that may have declared names: an undeclared name is then no
    /// error of its own.
    pub incomplete: bool,
    /// Parameters to which the program that reads the spec gives values, by name or as one member of a family. If the spec derives
    /// one of them from others, the value replaces its formula. No text in the spec can set this.
    pub given: Vec<String>,
    /// From `machine` to the closing brace.
    pub span: Span,
}

impl Spec {
    /// The same spec, with values given to these parameters instead of deriving them from others. Names of
    /// other things have no effect.
    pub fn with_given(mut self, names: impl IntoIterator<Item = String>) -> Spec {
        self.given.extend(names);
        self
    }

    /// The heading of a section, if the machine has it; the first one, if it repeats.
    pub fn section(&self, kind: SectionKind) -> Option<Span> {
        self.sections
            .iter()
            .find(|section| section.value == kind)
            .map(|section| section.span)
    }

    /// Adds items of a section of elements.
    pub(super) fn add_elements<C>(
        &mut self,
        section: &'static Section,
        items: Vec<Item<C>>,
        content: impl Fn(C) -> ElementContent,
    ) {
        let items = items.into_iter().map(|item| ElementItem {
            section,
            item: Item {
                docs: item.docs,
                name: item.name,
                content: content(item.content),
                span: item.span,
            },
        });
        self.elements.extend(items);
    }

    /// The items of the section of elements with a heading word.
    pub fn elements_of(&self, word: &str) -> impl Iterator<Item = &Item<ElementContent>> {
        let all = self.elements.iter();
        all.filter(move |element| element.section.word == word)
            .map(|element| &element.item)
    }

    /// The single-statement section with a heading word.
    pub fn statement(&self, word: &str) -> Option<&SectionStatement> {
        let mut all = self.statements.iter();
        all.find(|statement| statement.section.word == word)
    }
}

/// A value with its place in the text.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Spanned<T> {
    /// The value.
    pub value: T,
    /// Its place.
    pub span: Span,
}

/// A word.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Ident {
    /// The word; a raw identifier `r#type` is `type` here.
    pub text: String,
    /// Its place.
    pub span: Span,
}

/// Whether a machine moves in the plane or in space.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Space {
    /// `in plane`: vectors of two components, bodies that turn about its normal.
    Plane,
    /// `in space`: vectors of three components.
    Space,
}

macro_rules! sections {
    ($($kind:ident => $name:literal,)+) => {
        /// The sections that a machine can have.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[expect(missing_docs, reason = "each is named as the language names it")]
        pub enum SectionKind {
            $($kind,)+
            /// A section of elements.
            Element(&'static Section),
        }

        impl SectionKind {
            /// All sections except those of elements, in the order of the reference manual.
            pub(crate) const OF_OTHERS: &[SectionKind] = &[$(SectionKind::$kind,)+];

            /// The heading word of the section.
            pub fn as_str(self) -> &'static str {
                match self {
                    $(SectionKind::$kind => $name,)+
                    SectionKind::Element(section) => section.word,
                }
            }
        }
    };
}

sections! {
    Parameters => "parameters",
    Constants => "constants",
    Coordinates => "coordinates",
    States => "states",
    Inputs => "inputs",
    Define => "define",
    Assume => "assume",
    Frames => "frames",
    Bodies => "bodies",
    Circles => "circles",
    Spheres => "spheres",
    Contacts => "contacts",
    Approximations => "approximations",
    Outputs => "outputs",
    Derivatives => "derivatives",
    Stages => "stages",
    Methods => "methods",
    Charts => "charts",
    Keep => "keep",
    Brachistochrone => "brachistochrone",
    Published => "published",
}

impl SectionKind {
    /// The section that was most likely meant by an unknown heading word.
    pub fn meant_by(word: &str) -> Option<SectionKind> {
        Some(match word {
            "body" | "mass" | "masses" | "particles" | "links" => SectionKind::Bodies,
            "param" | "params" | "variables" => SectionKind::Parameters,
            "dofs" | "generalized_coordinates" => SectionKind::Coordinates,
            "definitions" | "let" => SectionKind::Define,
            "assumptions" => SectionKind::Assume,
            _ => return None,
        })
    }

    /// The section among some with a heading word.
    pub(crate) fn named_among(all: &[SectionKind], word: &str) -> Option<SectionKind> {
        all.iter().copied().find(|kind| kind.as_str() == word)
    }

    /// The fields that an item of this section can have; none if its items are not records.
    ///
    /// The parser accepts no other field, and none twice. Conflicts between fields are detected
    /// when they are used.
    pub fn fields(self) -> &'static [&'static str] {
        match self {
            SectionKind::Bodies => &["mass", "inertia", "at", "angle", "frame", "outline"],
            SectionKind::Element(section) => section.fields(),
            SectionKind::Circles | SectionKind::Spheres => &["on", "center", "radius"],
            SectionKind::Contacts => &[
                "circle",
                "circles",
                "sphere",
                "spheres",
                "inside",
                "outside",
                "along",
                "point",
                "corners",
                "on",
                "against",
                "of",
                "gap",
                "slip",
                "restitution",
                "tangential_restitution",
                "friction",
                "static_friction",
                "rolling_resistance",
                "law",
                "order",
                "painleve",
                "compliance",
            ],
            _ => &[],
        }
    }

    /// The phrase for one item of this section in messages.
    pub fn item(self) -> &'static str {
        match self {
            SectionKind::Parameters => "a parameter",
            SectionKind::Constants => "a constant",
            SectionKind::Coordinates => "a coordinate",
            SectionKind::States => "a state",
            SectionKind::Inputs => "an input",
            SectionKind::Define => "a definition",
            SectionKind::Assume => "a fact",
            SectionKind::Frames => "a frame",
            SectionKind::Bodies => "a body",
            SectionKind::Element(section) => section.item,
            SectionKind::Circles => "a circle",
            SectionKind::Spheres => "a sphere",
            SectionKind::Contacts => "a contact",
            SectionKind::Approximations => "an approximated coordinate",
            SectionKind::Outputs => "an output",
            SectionKind::Derivatives => "a derivative",
            SectionKind::Stages => "a stage",
            SectionKind::Methods => "a method of integration",
            SectionKind::Charts => "a pair of charts",
            SectionKind::Keep => "a start value that is kept",
            SectionKind::Brachistochrone => "the end of a coordinate",
            SectionKind::Published => "a published equation",
        }
    }
}

impl fmt::Display for SectionKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.as_str())
    }
}

/// One item of a section: its name and its content.
#[derive(Clone, Debug, PartialEq)]
pub struct Item<C> {
    /// Documentation, line by line.
    pub docs: String,
    /// The declaration: a single thing, one member of a family, or a whole family.
    pub name: Declared,
    /// Its content.
    pub content: C,
    /// The whole item.
    pub span: Span,
}

/// A name in a declaration: `theta`, `link[0]`, `q[1..N]`, `bob[i in 1..N]`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Declared {
    /// The name without its index.
    pub base: Ident,
    /// The members of a family that it refers to.
    pub index: Index,
    /// Name and index.
    pub span: Span,
}

/// The index of a name in a declaration.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Index {
    /// `theta`: not a family.
    #[default]
    None,
    /// `link[0]`: one member.
    One(Expression),
    /// `q[1..N]` or `bob[i in 1..N]`: each member in turn.
    Range(Range),
}

/// The range of an index: `i in 1..N`, both ends included.
#[derive(Clone, Debug, PartialEq)]
pub struct Range {
    /// The name of the index inside the item; `q[1..N]` has none.
    pub variable: Option<Ident>,
    /// The first index.
    pub low: Expression,
    /// The last index.
    pub high: Expression,
    /// The whole range, without the brackets.
    pub span: Span,
}

/// `unit = value`.
#[derive(Clone, Debug, PartialEq)]
pub struct Quantity {
    /// The unit. Only a constant may omit it, and then has the unit of its value.
    pub unit: Option<Unit>,
    /// The value, if given.
    pub value: Option<Expression>,
}

/// A unit: a product of powers, empty for `1`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Unit {
    /// Its factors, in the order of the text; a factor in the denominator has a negative power.
    pub factors: Vec<UnitFactor>,
    /// Its place.
    pub span: Span,
}

/// As the spec writes it: `kg*m^2/s^2`.
impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.factors.first().is_none_or(|first| first.power < 0) {
            f.write_str("1")?;
        }
        for (i, factor) in self.factors.iter().enumerate() {
            match (i, factor.power < 0) {
                (_, true) => f.write_str("/")?,
                (0, false) => {}
                (_, false) => f.write_str("*")?,
            }
            f.write_str(&factor.name.text)?;
            match (factor.power.unsigned_abs(), factor.halved) {
                (1, false) => {}
                (power, false) => write!(f, "^{power}")?,
                (power, true) => write!(f, "^({power}/2)")?,
            }
        }
        Ok(())
    }
}

/// A power of a named unit.
#[derive(Clone, Debug, PartialEq)]
pub struct UnitFactor {
    /// A name that [`Measure::named`](crate::unit::Measure::named) knows; any other word was reported,
    /// and the whole unit is treated as omitted.
    pub name: Ident,
    /// The exponent, negative in the denominator.
    pub power: i32,
    /// Whether the exponent is half of `power`: `m^(3/2)`.
    pub halved: bool,
}

/// `{ field: value, … }`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Record {
    /// The fields in the order of the text: only fields of its section, each at most once.
    pub fields: Vec<Field>,
    /// From brace to brace.
    pub span: Span,
}

impl Record {
    /// The value of a field, if given.
    pub fn get(&self, name: &str) -> Option<&Expression> {
        self.field(name).map(|field| &field.value)
    }

    /// A field, if given.
    pub fn field(&self, name: &str) -> Option<&Field> {
        self.fields.iter().find(|field| field.name.text == name)
    }
}

/// `name: value` inside braces.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// The name of the field.
    pub name: Ident,
    /// Its value.
    pub value: Expression,
}

/// `left = right`.
#[derive(Clone, Debug, PartialEq)]
pub struct Equation {
    /// The left side.
    pub left: Expression,
    /// The right side.
    pub right: Expression,
}

/// `polar(s, phi) | cartesian(x, y)` in `charts`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Charts {
    /// The names of two coordinates, a distance from a point and the angle of the direction.
    pub polar: [Ident; 2],
    /// New names, for the components of the distance along the directions 0 and π/2 of the angle.
    pub cartesian: [Ident; 2],
}

/// `coordinate: …` in `approximations`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Approximation {
    /// `frozen`
    Frozen,
    /// `small`
    Small,
}

/// `left > right` in `assume`; for a family `s[i] > 0 for i in 1..N`.
#[derive(Clone, Debug, PartialEq)]
pub struct Relation {
    /// The left side.
    pub left: Expression,
    /// The sign.
    pub operator: Spanned<Comparison>,
    /// The right side.
    pub right: Expression,
    /// The index range over which it holds.
    pub range: Option<Range>,
    /// The whole relation.
    pub span: Span,
}

/// The sign of a relation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Comparison {
    /// `>`
    Greater,
    /// `>=`
    GreaterOrEqual,
    /// `<`
    Less,
    /// `<=`
    LessOrEqual,
}

/// One item of a section of elements.
#[derive(Clone, Debug, PartialEq)]
pub struct ElementItem {
    /// The section.
    pub section: &'static Section,
    /// The item.
    pub item: Item<ElementContent>,
}

/// The content of an item of a section of elements, by the [`Form`](crate::syntax::Form) of the section.
#[derive(Clone, Debug, PartialEq)]
pub enum ElementContent {
    /// `{ field: value, … }`
    Record(Record),
    /// `expression`
    Expression(Expression),
    /// `left = right`
    Equation(Equation),
}

impl ElementContent {
    /// The value of a field, if the content is a record that gives it.
    pub fn get(&self, name: &str) -> Option<&Expression> {
        match self {
            ElementContent::Record(record) => record.get(name),
            ElementContent::Expression(_) | ElementContent::Equation(_) => None,
        }
    }
}

/// `gravity (0, -g);`: a section of elements that is a single statement.
#[derive(Clone, Debug, PartialEq)]
pub struct SectionStatement {
    /// The section.
    pub section: &'static Section,
    /// Documentation.
    pub docs: String,
    /// Its value; none if the spec says `none`.
    pub value: Option<Expression>,
    /// From the heading to the value.
    pub span: Span,
}

/// `remove springs.x_left;`
#[derive(Clone, Debug, PartialEq)]
pub struct Remove {
    /// The section that loses an item.
    pub section: Spanned<SectionKind>,
    /// The item: the whole family if a family is named without an index. `remove springs;` and
    /// `remove gravity;` have no name, and remove everything.
    pub name: Option<Declared>,
    /// The whole statement.
    pub span: Span,
}

/// `published "title" { … }`
#[derive(Clone, Debug, PartialEq)]
pub struct Published {
    /// Documentation.
    pub docs: String,
    /// The publication.
    pub title: Spanned<String>,
    /// The equations.
    pub items: Vec<PublishedItem>,
    /// The whole block.
    pub span: Span,
}

/// One printed equation.
#[derive(Clone, Debug, PartialEq)]
pub struct PublishedItem {
    /// Documentation.
    pub docs: String,
    /// The kind of quantity.
    pub kind: Spanned<PublishedKind>,
    /// The body or coordinate; none for the quantities of the whole machine.
    pub of: Option<Declared>,
    /// The printed statement.
    pub statement: Statement,
    /// The whole item.
    pub span: Span,
}

/// The statement of a published item.
#[derive(Clone, Debug, PartialEq)]
pub enum Statement {
    /// `… = value`
    Value(Expression),
    /// `…: left = right`, only for an equation of motion.
    Equation(Equation),
}

/// The quantities that a published block can hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum PublishedKind {
    /// `kinetic_energy` of the machine, or of one body.
    KineticEnergy,
    /// `potential_energy` of the machine.
    PotentialEnergy,
    /// `dissipation` of the machine.
    Dissipation,
    /// `force` on a coordinate: the generalized force.
    Force,
    /// `friction` on a coordinate: the generalized force of contacts that slide forward.
    Friction,
    /// `position` of the mass centre of a body.
    Position,
    /// `velocity` of the mass centre of a body.
    Velocity,
    /// `equation` of motion that belongs to a coordinate.
    Equation,
}

impl PublishedKind {
    /// All of them.
    pub const ALL: &[PublishedKind] = &[
        PublishedKind::KineticEnergy,
        PublishedKind::PotentialEnergy,
        PublishedKind::Dissipation,
        PublishedKind::Force,
        PublishedKind::Friction,
        PublishedKind::Position,
        PublishedKind::Velocity,
        PublishedKind::Equation,
    ];

    /// The word of the language.
    pub fn as_str(self) -> &'static str {
        match self {
            PublishedKind::KineticEnergy => "kinetic_energy",
            PublishedKind::PotentialEnergy => "potential_energy",
            PublishedKind::Dissipation => "dissipation",
            PublishedKind::Force => "force",
            PublishedKind::Friction => "friction",
            PublishedKind::Position => "position",
            PublishedKind::Velocity => "velocity",
            PublishedKind::Equation => "equation",
        }
    }
}

/// An expression: a scalar, a vector, a point, a frame or a name.
#[derive(Clone, Debug, PartialEq)]
pub struct Expression {
    /// Its kind.
    pub kind: ExpressionKind,
    /// Its place, including brackets.
    pub span: Span,
}

/// The kinds of expressions.
#[derive(Clone, Debug, PartialEq)]
pub enum ExpressionKind {
    /// `1.5e-3`: a decimal number that a floating-point number can hold, without `_`.
    Number(String),
    /// `theta`, `q[i-1]`
    Name(Reference),
    /// `a - b + c`: at least two terms.
    Sum(Vec<Term>),
    /// `a*b/c`: at least two factors.
    Product(Vec<Factor>),
    /// `-a`
    Negative(Box<Expression>),
    /// `a^b`
    Power(Box<Expression>, Box<Expression>),
    /// `f(a, b)`, `der(x)` too.
    Call(Call),
    /// `ground.shift(x, y).turn(theta)`, `mortar.at`
    Chain(Chain),
    /// `(a, b)`: a vector, two components or more.
    Tuple(Vec<Expression>),
    /// `"torque.csv"`: the file of a table.
    Text(String),
    /// Something that could not be read, and was reported.
    Error,
}

/// A name in an expression.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    /// The name without its index.
    pub base: Ident,
    /// The index of a member of a family.
    pub index: Option<Box<Expression>>,
}

/// A term of a sum.
#[derive(Clone, Debug, PartialEq)]
pub struct Term {
    /// Whether a minus precedes it.
    pub negative: bool,
    /// The operand that is added or subtracted.
    pub value: Expression,
}

/// A factor of a product.
#[derive(Clone, Debug, PartialEq)]
pub struct Factor {
    /// Whether a slash precedes it.
    pub divides: bool,
    /// The operand that is multiplied or divided by.
    pub value: Expression,
}

/// `function(arguments)`.
#[derive(Clone, Debug, PartialEq)]
pub struct Call {
    /// The function.
    pub function: Ident,
    /// Its arguments.
    pub arguments: Vec<Expression>,
}

/// `root.link.link…`
#[derive(Clone, Debug, PartialEq)]
pub struct Chain {
    /// The expression before the first dot.
    pub root: Box<Expression>,
    /// The links after the dots, at least one.
    pub links: Vec<Link>,
}

/// `.origin` or `.turn(q[i])`.
#[derive(Clone, Debug, PartialEq)]
pub struct Link {
    /// The word after the dot.
    pub name: Ident,
    /// The arguments of a method; none if there are no brackets.
    pub arguments: Option<Vec<Expression>>,
    /// From the word to the end of its arguments.
    pub span: Span,
}

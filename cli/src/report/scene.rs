//! The picture of a machine. A spec says nothing about drawing, so connections are found in the model.
//!
//! * A displacement of constant length from one frame to the next is a link; two points whose distance a constraint keeps are
//!   connected by a rope.
//! * A body is connected by a rod to the nearest earlier point (the ground, origins of frames, earlier bodies) from which it keeps
//!   its distance. If there is none, it is connected to a point in the expression of its own position: the pivot of a driven
//!   pendulum, the axle of an unbalanced rotor.
//! * A body with an `outline` is drawn as that polygon.
//! * A body with an inertia is drawn as the uniform solid that has it: in the plane a disc, or a bar if it is attached at the end
//!   of one; in space a cylinder or a box.
//! * The force of a contact is drawn where it touches, along the normal and the tangents. If the gap is given by an expression, the
//!   force is drawn on its line of action, if that can be found as for a spring.
//! * A spring or damper given by its stretch is drawn between the two points whose distance differs from the stretch by a constant;
//!   otherwise on its line of action: where a force on its body must act to have the same power.
//!
//! All findings hold for all parameters, coordinates and times, see [`places`](super::places). Points and vectors are indices in
//! the list of values that the page computes.

mod elements;
mod solids;

use lagrangian_spec::model::circles::{body_axes, centre_and_axes, outline};
use lagrangian_spec::model::element::{Drawing, Element, Site};
use lagrangian_spec::model::{
    Body, ContactGeometry, FrameOrBody, Inertia, Model, PoseChange, PoseId, Rotation, stage,
};
use lagrangian_symbolic::{Expr, Node, Symbol, evaluate};
use serde::Serialize;

use super::places::{Experiment, Places};
use super::touching;
use solids::solid_in_space;

/// The most pairs of points and elements that are searched; more would take seconds.
const MOST_PAIRS: usize = 400_000;

/// How closely the half-length of a uniform bar must match the distance of a joint for the body to be drawn as that bar.
const BAR: f64 = 0.02;

/// The picture of a machine, with the values that it needs.
pub struct Scene<'d> {
    /// The picture.
    pub picture: Picture,
    /// The values that the page must compute at every instant.
    pub values: Vec<Expr<'d>>,
}

/// The picture. All numbers of type `usize` are indices of values, except `body`, which is the index of a body.
#[derive(Debug, Serialize)]
pub struct Picture {
    /// 2 in the plane, 3 in space.
    pub dimension: usize,
    /// The origin of the ground.
    pub ground: usize,
    pub bodies: Vec<BodyDrawn>,
    pub frames: Vec<FrameDrawn>,
    /// Displacements of constant length between frames.
    pub links: Vec<Link>,
    /// Springs and dampers.
    pub elements: Vec<ElementDrawn>,
    pub circles: Vec<CircleDrawn>,
    /// Contacts whose forces are drawn.
    pub contacts: Vec<ContactDrawn>,
    /// The acceleration of gravity, as a vector.
    pub gravity: Option<usize>,
    /// Springs, dampers and contact forces without a place where they can be drawn.
    pub omitted: Vec<String>,
}

#[derive(Debug, Serialize)]
pub struct BodyDrawn {
    pub name: String,
    /// The mass in this run, in kg.
    pub mass: f64,
    /// The mass centre.
    pub at: usize,
    /// The axes, one after the other; `None` if the spec does not define the orientation of the body.
    pub axes: Option<usize>,
    /// The point to which a rod connects it.
    pub rod: Option<usize>,
    pub solid: Option<Solid>,
}

/// The outline of a body, or a uniform solid with its mass and inertia.
#[derive(Debug, Serialize, PartialEq)]
#[serde(rename_all = "lowercase", tag = "form")]
pub enum Solid {
    /// In the plane, a polygon with these corners.
    Outline { corners: Vec<usize> },
    /// In the plane.
    Disc { radius: f64 },
    /// In the plane, from `end`, at distance `half` from the mass centre, to the same distance beyond it.
    Bar { end: usize, half: f64 },
    /// In space, about an axis given in the axes of the body.
    Cylinder {
        axis: [f64; 3],
        radius: f64,
        half: f64,
    },
    /// In space, along axes given in the axes of the body.
    Box { axes: [[f64; 3]; 3], half: [f64; 3] },
}

#[derive(Debug, Serialize)]
pub struct FrameDrawn {
    pub name: String,
    pub origin: usize,
    pub axes: usize,
}

#[derive(Debug, Serialize)]
pub struct Link {
    pub ends: [usize; 2],
    /// The first body that is fixed to it.
    pub body: Option<usize>,
    /// Whether a constraint keeps its length, as for a rope or a massless rod.
    pub rope: bool,
}

#[derive(Debug, Serialize)]
pub struct ElementDrawn {
    pub name: String,
    /// Whether it is a damper instead of a spring.
    pub damper: bool,
    #[serde(flatten)]
    pub place: Placed,
}

#[derive(Debug, Serialize, PartialEq)]
#[serde(rename_all = "lowercase", tag = "placed")]
pub enum Placed {
    /// Between two points.
    Between { ends: [usize; 2] },
    /// From the ground to a point of a body, in the axes of the body, along a direction in those of the ground. It is a
    /// sketch, since the spec only determines the line of action. `side` is −1 behind the body and 1 in front of it.
    Sketch {
        body: usize,
        foot: [f64; 2],
        along: [f64; 2],
        side: i8,
    },
    /// A torsion element about a point.
    Twist { about: usize },
}

#[derive(Debug, Serialize)]
pub struct CircleDrawn {
    pub name: String,
    pub center: usize,
    pub radius: usize,
    /// The axes of the frame to which it is fixed.
    pub axes: usize,
    /// The body to which it belongs.
    pub body: Option<usize>,
}

#[derive(Debug, Serialize)]
pub struct ContactDrawn {
    pub name: String,
    /// The names of the curves with the components of its force along its directions.
    pub forces: Vec<String>,
    #[serde(flatten)]
    pub place: Touch,
}

#[derive(Debug, Serialize, PartialEq)]
#[serde(rename_all = "lowercase", tag = "placed")]
pub enum Touch {
    /// At a point, along unit vectors.
    Point {
        point: usize,
        directions: Vec<usize>,
    },
    /// On a line of action: at a point of a body, in its axes, with the force per unit of the force on the gap, in
    /// the axes of the ground.
    Line {
        body: usize,
        foot: [f64; 2],
        force: [f64; 2],
    },
}

impl<'d> Scene<'d> {
    /// The scene of a machine with these initial values of the symbols: parameters, coordinates, time.
    pub fn new(model: &Model<'d>, value: &dyn Fn(Symbol) -> f64) -> Scene<'d> {
        let mut places = Places::default();
        let points = Points::new(model, &mut places);
        let experiment = places.experiment(model);
        let start = evaluate(model.dag, places.values(), value);
        let finder = Finder {
            model,
            points: &points,
            experiment: &experiment,
            start: &start,
            value,
        };
        let links = finder.links();
        let mut bodies: Vec<BodyDrawn> = Vec::new();
        for index in 0..model.bodies.len() {
            let body = finder.body(index, &links);
            bodies.push(body);
        }
        let built_on = finder.built_on(&bodies, &links);
        for (body, anchor) in bodies.iter_mut().zip(built_on) {
            if let Some(anchor) = anchor {
                body.rod = Some(places.of(&anchor));
            }
        }
        let links = finder.without_bars(links, &bodies);
        let (elements, mut omitted) = finder.elements();
        let (contacts, placeless) = finder.contacts();
        omitted.extend(placeless);
        let picture = Picture {
            dimension: points.dimension,
            ground: points.origins[0],
            bodies,
            frames: model
                .frames
                .iter()
                .map(|frame| FrameDrawn {
                    name: frame.name.to_string(),
                    origin: points.origins[frame.pose.index()],
                    axes: points.axes[frame.pose.index()],
                })
                .collect(),
            links,
            elements,
            circles: points.circles(model),
            contacts,
            gravity: points.gravity,
            omitted,
        };
        Scene {
            picture,
            values: places.into_values(),
        }
    }
}

/// The indices of all points and vectors.
struct Points {
    dimension: usize,
    /// For each pose.
    origins: Vec<usize>,
    axes: Vec<usize>,
    /// For each body.
    bodies: Vec<usize>,
    body_axes: Vec<Option<usize>>,
    /// The corners of each body's outline.
    outlines: Vec<Vec<usize>>,
    /// The centre, radius and axes of each circle.
    circles: Vec<[usize; 3]>,
    /// The function of each constraint on positions.
    constraints: Vec<usize>,
    /// The location of each drawn element, in the order of [`drawings`].
    sites: Vec<SitePoints>,
    /// The point and directions of each contact, then of each rolling contact; `None` if only an expression is known.
    touching: Vec<Option<(usize, Vec<usize>)>>,
    gravity: Option<usize>,
}

/// The point and directions of each contact, then of each rolling contact; `None` if only an expression is known.
fn touching_points<'d>(
    model: &Model<'d>,
    places: &mut Places<'d>,
) -> Vec<Option<(usize, Vec<usize>)>> {
    let mut touch = |site: touching::Site<'d>| {
        let touching::Site { point, directions } = site;
        let directions = directions.iter().map(|along| places.of(along));
        let directions = directions.collect();
        Some((places.of(&point), directions))
    };
    let mut touching = Vec::new();
    for contact in &model.contacts {
        touching.push(match &contact.geometry {
            ContactGeometry::Circles(circles) => {
                let circle = &model.circles[circles.circle];
                touch(touching::site(model, circle, circles.surface))
            }
            ContactGeometry::Point { point, surface } => {
                touch(touching::site(model, point, *surface))
            }
            ContactGeometry::Corner(corner) => touch(touching::site_of_corner(model, corner)),
            ContactGeometry::Expressions { .. } => None,
        });
    }
    for rolling in model.rolling() {
        let circles = rolling.circles;
        let circle = &model.circles[circles.circle];
        touching.push(touch(touching::site(model, circle, circles.surface)));
    }
    touching
}

impl Points {
    fn new<'d>(model: &Model<'d>, places: &mut Places<'d>) -> Points {
        let dimension = model.space.dimension();
        let origins = model.poses.iter().map(|pose| places.of(&pose.origin));
        let origins = origins.collect();
        let axes = model
            .poses
            .iter()
            .map(|pose| places.of(&pose.axes.concat()));
        let axes = axes.collect();
        let bodies = model
            .bodies
            .iter()
            .map(|body| places.of(&body.at))
            .collect();
        let turned = model.bodies.iter().map(|body| {
            let axes = body_axes(model, body)?;
            Some(places.of(&axes.concat()))
        });
        let turned = turned.collect();
        let outlines = (0..model.bodies.len()).map(|body| {
            let corners = outline(model, body);
            corners.iter().map(|corner| places.of(corner)).collect()
        });
        let outlines = outlines.collect();
        let circles = model.circles.iter().map(|circle| {
            let (center, axes) = centre_and_axes(model, circle);
            [
                places.of(&center),
                places.of(&[circle.radius]),
                places.of(&axes.concat()),
            ]
        });
        let circles = circles.collect();
        let constraints = model.constraints();
        let constraints = constraints.iter().map(|constraint| constraint.expression);
        let of_positions = constraints.filter(|expression| expression.stage() <= stage::POSITION);
        let constraints = of_positions.map(|expression| places.of(&[expression]));
        let constraints = constraints.collect();
        let sites = drawings(model).map(|(_, drawing)| match &drawing.site {
            Site::Between([from, to]) => SitePoints::Between([places.of(from), places.of(to)]),
            Site::Stretch(stretch) => SitePoints::Stretch(places.of(&[*stretch])),
            Site::Twist(_) => SitePoints::Twist,
            Site::At(point) => SitePoints::At(places.of(point)),
        });
        let sites = sites.collect();
        let touching = touching_points(model, places);
        Points {
            dimension,
            origins,
            axes,
            bodies,
            body_axes: turned,
            outlines,
            circles,
            constraints,
            sites,
            touching,
            gravity: model.gravity().map(|gravity| places.of(gravity)),
        }
    }

    fn circles(&self, model: &Model<'_>) -> Vec<CircleDrawn> {
        let circles = model.circles.iter().zip(&self.circles);
        let drawn = circles.map(|(circle, &[center, radius, axes])| CircleDrawn {
            name: circle.name.to_string(),
            center,
            radius,
            axes,
            body: holder(model, circle.on),
        });
        drawn.collect()
    }
}

/// The location of an element, by indices.
enum SitePoints {
    /// Between two points.
    Between([usize; 2]),
    /// To be found from this stretch.
    Stretch(usize),
    /// At a hinge that is to be found.
    Twist,
    /// About a point.
    At(usize),
}

/// The elements that are drawn.
fn drawings<'m, 'd>(
    model: &'m Model<'d>,
) -> impl Iterator<Item = (&'m Element<'d>, &'m Drawing<'d>)> {
    let all = model.elements.iter();
    all.filter_map(|element| Some((element, element.drawing.as_ref()?)))
}

/// The body to which a circle is fixed, directly or through its frame.
fn holder(model: &Model<'_>, place: FrameOrBody) -> Option<usize> {
    match place {
        FrameOrBody::Body(body) => Some(body),
        FrameOrBody::Frame(PoseId::GROUND) => None,
        FrameOrBody::Frame(pose) => {
            let on = |body: &Body| matches!(body.rotation, Rotation::Frame(frame) if frame == pose);
            model.bodies.iter().position(on)
        }
    }
}

struct Finder<'a, 'd> {
    model: &'a Model<'d>,
    points: &'a Points,
    experiment: &'a Experiment,
    /// The values at the start.
    start: &'a [f64],
    value: &'a dyn Fn(Symbol) -> f64,
}

impl<'d> Finder<'_, 'd> {
    fn dimension(&self) -> usize {
        self.points.dimension
    }

    /// The distance of two points at the start.
    fn distance(&self, a: usize, b: usize) -> f64 {
        let difference = |k| self.start[a + k] - self.start[b + k];
        let squares = (0..self.dimension()).map(|k| difference(k) * difference(k));
        squares.sum::<f64>().sqrt()
    }

    fn joined(&self, a: usize, b: usize) -> bool {
        self.experiment.keeps_distance(a, b, self.dimension())
            && !self.experiment.coincide(a, b, self.dimension())
    }

    /// Displacements of constant length.
    fn links(&self) -> Vec<Link> {
        let mut links: Vec<Link> = Vec::new();
        for (index, pose) in self.model.poses.iter().enumerate() {
            let PoseChange::Shift(_) = pose.step else {
                continue;
            };
            let origin = |pose: PoseId| self.points.origins[pose.index()];
            let ends = [origin(pose.parent), self.points.origins[index]];
            if self.joined(ends[0], ends[1]) && !links.iter().any(|link| link.ends == ends) {
                links.push(Link {
                    ends,
                    body: None,
                    rope: false,
                });
            }
        }
        links.extend(self.ropes());
        for link in &mut links {
            link.body = (0..self.model.bodies.len()).find(|&body| {
                let rests = |end: &usize| self.rests(*end, body);
                link.ends.iter().all(rests)
            });
        }
        links
    }

    /// The two points of each constraint that keeps a distance.
    fn ropes(&self) -> Vec<Link> {
        let candidates = self.references(self.model.bodies.len());
        if candidates.len().pow(2) / 2 * self.points.constraints.len() > MOST_PAIRS {
            return Vec::new();
        }
        let mut ropes = Vec::new();
        for &constraint in &self.points.constraints {
            let pairs = candidates.iter().enumerate();
            let mut pairs =
                pairs.flat_map(|(k, &a)| candidates[k + 1..].iter().map(move |&b| [a, b]));
            let is_kept = |&[a, b]: &[usize; 2]| {
                let experiment = self.experiment;
                experiment.is_kept(a, b, constraint, self.dimension())
            };
            ropes.extend(pairs.find(is_kept).map(|ends| Link {
                ends,
                body: None,
                rope: true,
            }));
        }
        ropes
    }

    /// Whether a point is fixed in a body.
    fn rests(&self, point: usize, body: usize) -> bool {
        let (at, axes) = (self.points.bodies[body], self.points.body_axes[body]);
        axes.is_some_and(|axes| self.experiment.rests(point, at, axes, self.dimension()))
    }

    /// The points to which a body may be connected: the ground, origins of frames, earlier bodies; without duplicates.
    fn references(&self, body: usize) -> Vec<usize> {
        let mut references = Vec::new();
        for &place in self
            .points
            .origins
            .iter()
            .chain(&self.points.bodies[..body])
        {
            if !references.contains(&place) {
                references.push(place);
            }
        }
        references
    }

    fn body(&self, index: usize, links: &[Link]) -> BodyDrawn {
        let body = &self.model.bodies[index];
        let at = self.points.bodies[index];
        let references = self.references(index);
        let joined: Vec<usize> = references
            .iter()
            .copied()
            .filter(|&reference| self.joined(at, reference))
            .collect();
        let nearest = |points: &[usize]| {
            let by_distance =
                |a: &&usize, b: &&usize| self.distance(at, **a).total_cmp(&self.distance(at, **b));
            points.iter().min_by(by_distance).copied()
        };
        let numbers = |expressions: &[Expr<'d>]| {
            evaluate(self.model.dag, expressions, |symbol| (self.value)(symbol))
        };
        let mass = numbers(&[body.mass])[0];
        let fixed: Vec<usize> = joined
            .iter()
            .copied()
            .filter(|&point| self.rests(point, index))
            .collect();
        let on_link = links
            .iter()
            .flat_map(|link| link.ends)
            .any(|end| self.experiment.coincide(end, at, self.dimension()));
        let outlined = |circle: &CircleDrawn| circle.body == Some(index);
        let outlined = self.points.circles(self.model).iter().any(outlined);
        let corners = &self.points.outlines[index];
        let solid = match body.inertia {
            _ if !corners.is_empty() => Some(Solid::Outline {
                corners: corners.clone(),
            }),
            Inertia::Particle => None,
            _ if outlined => None,
            Inertia::Planar(inertia) => {
                let squared = numbers(&[inertia])[0] / mass;
                self.planar_solid(at, squared, &fixed)
            }
            Inertia::Tensor(ref entries) => solid_in_space(mass, &numbers(entries)),
        };
        // A bar reaches its joints without a rod.
        let rod = match solid {
            Some(Solid::Bar { .. }) => None,
            _ if on_link => None,
            _ => nearest(&joined),
        };
        BodyDrawn {
            name: body.name.to_string(),
            mass,
            at,
            axes: self.points.body_axes[index],
            rod,
            solid,
        }
    }

    /// The uniform bar or disc with this squared radius of gyration.
    fn planar_solid(&self, at: usize, squared: f64, fixed: &[usize]) -> Option<Solid> {
        if !(squared > 0.0 && squared.is_finite()) {
            return None;
        }
        // A bar of length 2h has the inertia m h²/3, a disc of radius R has m R²/2.
        let half = (3.0 * squared).sqrt();
        let is_end = |&&end: &&usize| (self.distance(at, end) - half).abs() < BAR * half;
        Some(match fixed.iter().find(is_end) {
            Some(&end) => Solid::Bar { end, half },
            None => Solid::Disc {
                radius: (2.0 * squared).sqrt(),
            },
        })
    }

    /// For bodies without a connection: the point from which the position of each is constructed, if there is one.
    ///
    /// A position is a sum that contains its construction as a term: `platform.point(x0, y0) + polar(e, ω t)`. If one term
    /// of each component forms a vector of constant length, the remaining terms are the point at its other end.
    fn built_on(&self, bodies: &[BodyDrawn], links: &[Link]) -> Vec<Option<Vec<Expr<'d>>>> {
        let dag = self.model.dag;
        let held = |body: &BodyDrawn| {
            let on_link = |link: &Link| link.ends.contains(&body.at);
            body.rod.is_some()
                || matches!(body.solid, Some(Solid::Bar { .. }))
                || links.iter().any(on_link)
        };
        let found = bodies.iter().zip(&self.model.bodies).map(|(drawn, body)| {
            if held(drawn) {
                return None;
            }
            let terms: Vec<Vec<Expr<'d>>> = body.at.iter().map(|&x| terms(x)).collect();
            if terms.iter().map(Vec::len).product::<usize>() > 64 {
                return None;
            }
            let mut sheet: Vec<Expr<'d>> = Vec::new();
            let places: Vec<Vec<usize>> = terms
                .iter()
                .map(|terms| {
                    let first = sheet.len();
                    sheet.extend(terms);
                    (first..sheet.len()).collect()
                })
                .collect();
            let experiment = Experiment::new(self.model, &sheet);
            let choice = choices(&places).find(|choice| {
                let one = choice.iter().all(|&place| !sheet[place].is_zero());
                one && experiment.keeps_length(choice)
            })?;
            let anchor: Vec<Expr<'d>> = body
                .at
                .iter()
                .zip(&choice)
                .map(|(&x, &place)| dag.sum([x, -sheet[place]]))
                .collect();
            // Everything was dropped: this is the ground, which has been tried.
            let ground = anchor.iter().all(|x| x.is_zero());
            (!ground).then_some(anchor)
        });
        found.collect()
    }

    /// Links that are not covered by a bar.
    fn without_bars(&self, links: Vec<Link>, bodies: &[BodyDrawn]) -> Vec<Link> {
        let covered = |link: &Link| {
            bodies.iter().enumerate().any(|(index, body)| {
                let Some(Solid::Bar { half, .. }) = body.solid else {
                    return false;
                };
                link.ends.iter().all(|&end| {
                    (self.distance(body.at, end) - half).abs() < 2.0 * BAR * half
                        && self.rests(end, index)
                })
            })
        };
        links.into_iter().filter(|link| !covered(link)).collect()
    }
}

/// The terms of a sum with their coefficients; any other expression is a single term.
fn terms(x: Expr<'_>) -> Vec<Expr<'_>> {
    match x.node() {
        Node::Sum(terms) => terms
            .iter()
            .map(|(id, coefficient)| x.dag().expr(*id) * coefficient.clone())
            .collect(),
        _ => vec![x],
    }
}

/// All combinations of one element from each list.
fn choices(lists: &[Vec<usize>]) -> impl Iterator<Item = Vec<usize>> + '_ {
    let count: usize = lists.iter().map(Vec::len).product();
    (0..count).map(move |mut number| {
        let pick = |list: &Vec<usize>| {
            let place = list[number % list.len()];
            number /= list.len();
            place
        };
        lists.iter().map(pick).collect()
    })
}

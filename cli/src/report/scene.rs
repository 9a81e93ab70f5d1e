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

use lagrangian_spec::model::circles::{body_axes, centre_and_axes, outline};
use lagrangian_spec::model::element::{Drawing, Element, Shape, Site};
use lagrangian_spec::model::{
    Body, ContactGeometry, FrameOrBody, Inertia, Model, PoseChange, PoseId, Rotation, stage,
};
use lagrangian_symbolic::{Expr, Node, Symbol, Tangent, evaluate};
use serde::Serialize;

use super::places::{Experiment, Places};
use super::touching;

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

    /// Springs, dampers and similar elements with their locations, and the names of those without one.
    fn elements(&self) -> (Vec<ElementDrawn>, Vec<String>) {
        let mut candidates = self.references(self.model.bodies.len());
        if candidates.len().pow(2) / 2 * self.points.sites.len() > MOST_PAIRS {
            candidates.clear();
        }
        let mut sketches: Vec<(usize, [f64; 2])> = Vec::new();
        let (mut drawn, mut omitted) = (Vec::new(), Vec::new());
        for ((element, drawing), site) in drawings(self.model).zip(&self.points.sites) {
            let between = |ends| Placed::Between { ends };
            let found = match (site, &drawing.site) {
                (&SitePoints::Between(ends), _) => Some(between(ends)),
                (&SitePoints::At(about), _) => Some(Placed::Twist { about }),
                (&SitePoints::Stretch(place), &Site::Stretch(stretch)) => {
                    let pair = self.pair(place, &candidates);
                    pair.map(between).or_else(|| self.sketch(stretch))
                }
                (_, &Site::Twist(twist)) => self.twist(twist),
                (SitePoints::Stretch(_) | SitePoints::Twist, _) => None,
            };
            let Some(mut place) = found else {
                omitted.push(format!("{} {}", element.section.noun, element.name));
                continue;
            };
            // Elements that act on one body along the same direction are placed alternately on opposite sides.
            if let Placed::Sketch {
                body, along, side, ..
            } = &mut place
            {
                let same = |(other, direction): &&(usize, [f64; 2])| {
                    let [a, b] = [direction, along];
                    other == body && (a[0] * b[0] + a[1] * b[1]).abs() > 0.9
                };
                let before = sketches.iter().filter(same).count();
                *side = if before % 2 == 0 { -1 } else { 1 };
                sketches.push((*body, *along));
            }
            drawn.push(ElementDrawn {
                name: element.name.to_string(),
                damper: drawing.shape == Shape::Dashpot,
                place,
            });
        }
        (drawn, omitted)
    }

    /// Where the forces of `contacts` and `rolling` are drawn, and the names of those without a location.
    fn contacts(&self) -> (Vec<ContactDrawn>, Vec<String>) {
        let (mut drawn, mut omitted) = (Vec::new(), Vec::new());
        let collide = self.model.contacts.iter().map(|contact| {
            let name = contact.name.to_string();
            let mut forces = vec![format!("normal({name})")];
            if contact.friction.is_some() {
                forces.push(format!("friction({name})"));
            }
            if contact.has_two_tangents(self.model.space) {
                forces.push(format!("friction({name}.across)"));
            }
            let gap = match contact.geometry {
                // Friction has a separate line of action, which is unknown because only its power is.
                ContactGeometry::Expressions { gap, .. } if contact.friction.is_none() => Some(gap),
                _ => None,
            };
            (name, forces, gap)
        });
        let roll = self.model.rolling().into_iter().map(|rolling| {
            let name = rolling.name.to_string();
            let forces = ["gap", "slip"].map(|row| format!("multiplier({name}.{row})"));
            (name, forces.to_vec(), None)
        });
        for ((name, forces, gap), touching) in collide.chain(roll).zip(&self.points.touching) {
            let place = match touching {
                Some((point, directions)) => Some(Touch::Point {
                    point: *point,
                    // Without friction only the normal force exists.
                    directions: directions.iter().copied().take(forces.len()).collect(),
                }),
                None => gap
                    .and_then(|gap| self.line_of_action(gap))
                    .map(|(body, foot, force)| Touch::Line { body, foot, force }),
            };
            match place {
                Some(place) => drawn.push(ContactDrawn {
                    name,
                    forces,
                    place,
                }),
                None => omitted.push(format!("force of contact {name}")),
            }
        }
        (drawn, omitted)
    }

    /// The two points whose distance is the stretch plus a constant. From the ground the constant must not be 0: the
    /// stretch would then be a coordinate, not a length.
    fn pair(&self, stretch: usize, candidates: &[usize]) -> Option<[usize; 2]> {
        let ground = self.points.origins[0];
        for (index, &a) in candidates.iter().enumerate() {
            for &b in &candidates[index + 1..] {
                let found = self.experiment.is_stretch(a, b, stretch, self.dimension());
                if found.is_some_and(|zero| !(zero && a == ground)) {
                    return Some([a, b]);
                }
            }
        }
        None
    }

    fn sketch(&self, stretch: Expr<'d>) -> Option<Placed> {
        let (body, foot, force) = self.line_of_action(stretch)?;
        let size = force[0].hypot(force[1]);
        Some(Placed::Sketch {
            body,
            foot,
            along: force.map(|x| x / size),
            side: -1,
        })
    }

    /// The line of action of a force that does work only on the stretch, as a force on one body of a plane machine: `w`
    /// with `∂stretch/∂q = wᵀ ∂(x, y, angle)/∂q` at the start. Returns its foot, in the axes of the body, and the force
    /// per unit of the force on the stretch, in those of the ground.
    fn line_of_action(&self, stretch: Expr<'d>) -> Option<(usize, [f64; 2], [f64; 2])> {
        if self.dimension() != 2 {
            return None;
        }
        let slopes = |of: Expr<'d>| -> Vec<Expr<'d>> {
            let coordinates = self.model.coordinates.iter();
            let symbols = coordinates.filter_map(|coordinate| coordinate.q.as_symbol());
            symbols
                .map(|symbol| {
                    Tangent::new(self.model.dag, &[(symbol, self.model.dag.one())]).of(of)
                })
                .collect()
        };
        let numbers =
            |slopes: &[Expr<'d>]| evaluate(self.model.dag, slopes, |symbol| (self.value)(symbol));
        // The line of action of a nonlinear stretch would move.
        let linear = slopes(stretch);
        if linear.iter().any(|slope| slope.stage() > stage::PARAMETER) {
            return None;
        }
        let wanted = numbers(&linear);
        if wanted.iter().all(|slope| *slope == 0.0) {
            return None;
        }
        for (index, body) in self.model.bodies.iter().enumerate() {
            let angle = match body.rotation {
                Rotation::Unspecified => self.model.dag.zero(),
                Rotation::Angle(angle) => angle,
                Rotation::Frame(pose) => self.model.poses[pose.index()].angle,
            };
            let motion: Vec<Vec<f64>> = [body.at[0], body.at[1], angle]
                .map(|of| numbers(&slopes(of)))
                .into();
            let Some([x, y, moment]) = wrench(&motion, &wanted) else {
                continue;
            };
            let size = x.hypot(y);
            if size < 1e-9 {
                continue;
            }
            // The foot of the perpendicular from the mass centre, in the axes of the body.
            let foot = [moment * y / (size * size), -moment * x / (size * size)];
            let turn = evaluate(self.model.dag, &[angle], |symbol| (self.value)(symbol))[0];
            let (sin, cos) = turn.sin_cos();
            let foot = [cos * foot[0] + sin * foot[1], cos * foot[1] - sin * foot[0]];
            return Some((index, foot, [x, y]));
        }
        None
    }

    /// A torsion spring is drawn at the first body whose angle equals its twist up to a constant.
    fn twist(&self, twist: Expr<'d>) -> Option<Placed> {
        let same = |angle: Expr<'d>| {
            let rest = [twist - angle];
            Experiment::new(self.model, &rest).value_is_constant(0)
        };
        let turned = self
            .model
            .poses
            .iter()
            .enumerate()
            .find(|(_, pose)| match pose.step {
                PoseChange::Turn { angle, .. } => same(angle) || same(-angle),
                _ => false,
            });
        if let Some((pose, _)) = turned {
            return Some(Placed::Twist {
                about: self.points.origins[pose],
            });
        }
        let body = self
            .model
            .bodies
            .iter()
            .position(|body| match body.rotation {
                Rotation::Angle(angle) => same(angle) || same(-angle),
                _ => false,
            });
        body.map(|body| Placed::Twist {
            about: self.points.bodies[body],
        })
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

/// The `w` with `wanted_i = Σ_k w_k motion_k,i` for every i, by least squares; `None` if there is none. If it is not
/// unique, irrelevant components are 0.
fn wrench(motion: &[Vec<f64>], wanted: &[f64]) -> Option<[f64; 3]> {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    // Gram–Schmidt orthogonalization of at most three rows, with the coefficients of each.
    let mut basis: Vec<(Vec<f64>, [f64; 3])> = Vec::new();
    for (k, row) in motion.iter().enumerate() {
        let mut row = row.clone();
        let mut weights = [0.0; 3];
        *weights.get_mut(k)? = 1.0;
        let size = dot(&row, &row);
        for (other, other_weights) in &basis {
            let share = dot(&row, other) / dot(other, other);
            row.iter_mut().zip(other).for_each(|(x, y)| *x -= share * y);
            let pairs = weights.iter_mut().zip(other_weights);
            pairs.for_each(|(x, y)| *x -= share * y);
        }
        if size > 0.0 && dot(&row, &row) > 1e-12 * size {
            basis.push((row, weights));
        }
    }
    let (mut rest, mut found) = (wanted.to_vec(), [0.0; 3]);
    for (row, weights) in &basis {
        let share = dot(&rest, row) / dot(row, row);
        rest.iter_mut().zip(row).for_each(|(x, y)| *x -= share * y);
        let pairs = found.iter_mut().zip(weights);
        pairs.for_each(|(x, y)| *x += share * y);
    }
    let exact = dot(&rest, &rest) <= 1e-18 * dot(wanted, wanted);
    (exact && found.iter().all(|x| x.is_finite())).then_some(found)
}

/// The uniform cylinder, or otherwise the box, with this mass and inertia `xx, yy, zz, xy, xz, yz`.
///
/// A cylinder of radius R and height 2h has m R²/2 about its axis and m (R²/4 + h²/3) across it; a box of sides 2a, 2b, 2c
/// has m (b² + c²)/3 about the first axis. A tensor that no solid has (A > B + C) gives sides of 0.
fn solid_in_space(mass: f64, inertia: &[f64]) -> Option<Solid> {
    let &[xx, yy, zz, xy, xz, yz] = inertia else {
        return None;
    };
    let tensor = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
    let (moments, axes) = principal(tensor);
    let largest = moments.iter().fold(0.0_f64, |a, b| a.max(*b));
    if !(mass > 0.0 && largest > 0.0 && largest.is_finite()) {
        return None;
    }
    let equal = |a: f64, b: f64| (a - b).abs() < 1e-9 * largest;
    let root = |x: f64| if x > 0.0 { x.sqrt() } else { 0.0 };
    for (axis, [b, c]) in [(2, [0, 1]), (0, [1, 2]), (1, [2, 0])] {
        if equal(moments[b], moments[c]) && !equal(moments[axis], moments[b]) {
            let radius = root(2.0 * moments[axis] / mass);
            let half = root(3.0 * (moments[b] / mass - radius * radius / 4.0));
            return Some(Solid::Cylinder {
                axis: axes[axis],
                radius,
                half,
            });
        }
    }
    let half = [0, 1, 2].map(|axis| {
        let others = moments.iter().sum::<f64>() - 2.0 * moments[axis];
        root(1.5 * others / mass)
    });
    Some(Solid::Box { axes, half })
}

/// Principal moments and axes of a symmetric tensor, by Jacobi rotations. G. H. Golub and C. F. Van Loan, *Matrix
/// Computations*, 4th ed. (2013), section 8.5.
fn principal(mut a: [[f64; 3]; 3]) -> ([f64; 3], [[f64; 3]; 3]) {
    // The rows of `v` are the axes.
    let mut v = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    // Convergence is quadratic: a few sweeps reach round-off.
    for _ in 0..12 {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            if a[p][q] == 0.0 {
                continue;
            }
            let theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
            let tan = theta.signum() / (theta.abs() + theta.hypot(1.0));
            let cos = 1.0 / tan.hypot(1.0);
            let sin = tan * cos;
            for row in &mut a {
                let (x, y) = (row[p], row[q]);
                (row[p], row[q]) = (cos * x - sin * y, sin * x + cos * y);
            }
            for k in 0..3 {
                let (x, y) = (a[p][k], a[q][k]);
                (a[p][k], a[q][k]) = (cos * x - sin * y, sin * x + cos * y);
                let (x, y) = (v[p][k], v[q][k]);
                (v[p][k], v[q][k]) = (cos * x - sin * y, sin * x + cos * y);
            }
        }
    }
    ([a[0][0], a[1][1], a[2][2]], v)
}

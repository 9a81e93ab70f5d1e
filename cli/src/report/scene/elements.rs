//! Where springs, dampers and similar elements are drawn, and the forces of contacts.

use lagrangian_spec::model::element::{Shape, Site};
use lagrangian_spec::model::{ContactGeometry, PoseChange, Rotation, stage};
use lagrangian_symbolic::{Expr, Tangent, evaluate};

use super::{
    ContactDrawn, ElementDrawn, Experiment, Finder, MOST_PAIRS, Placed, SitePoints, Touch, drawings,
};

impl<'d> Finder<'_, 'd> {
    /// Springs, dampers and similar elements with their locations, and the names of those without one.
    pub(super) fn elements(&self) -> (Vec<ElementDrawn>, Vec<String>) {
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
    pub(super) fn contacts(&self) -> (Vec<ContactDrawn>, Vec<String>) {
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

//! Rewritings of a machine into equivalent descriptions, and the results expected of each.

use super::generate::close;
use super::machine::{
    Body, Constraint, Elastic, Expr, Force, Frame, METRE, Machine, Meaning, NEWTON, PURE, Step,
    Stretch, Surface, Vector, cos, der, dot, mul, neg, norm, num, power, q, quotient, sin, sum,
};
use super::random::Random;

/// An equivalent description of a machine.
#[derive(Clone)]
pub struct Rewritten {
    pub machine: Machine,
    /// Its coordinates, as functions of the original ones.
    pub coordinates: Vec<Expr>,
    /// For each of its constraints, the original constraint and the factor between them.
    pub constraints: Vec<Option<(usize, f64)>>,
    /// For each of its guides, the original guide and the signs of its direction and of its normal.
    pub guides: Vec<(usize, f64, f64)>,
    /// Whether T, V and D must equal the original ones; they need not after every rewriting.
    pub energies: [bool; 3],
    /// Whether the spec may be refused because the reaction of a guide may no longer follow from it.
    pub refusable: bool,
    /// Whether the bodies in guides are placed by formulas in coordinates and no longer by frames.
    pub by_formulas: bool,
    pub names: Vec<&'static str>,
}

type Rewriting = fn(&mut Rewritten, &mut Random) -> bool;

/// All rewritings. The first is always applied before the others, because it rebuilds the frames.
pub const REWRITINGS: [(&str, Rewriting); 26] = [
    ("loop cut elsewhere", cut_elsewhere),
    ("coordinates in place of frames", formulas_for_frames),
    ("frames from the ground", frames_from_ground),
    ("relative coordinates", relative_coordinates),
    ("order of coordinates", order_of_coordinates),
    ("order of items", order_of_items),
    ("split body", split_body),
    ("particles for a rigid body", particles),
    ("springs as potentials", springs_as_potentials),
    ("springs as forces", springs_as_forces),
    ("torsion springs otherwise", torsions_otherwise),
    ("dampers as dissipations", dampers_as_dissipations),
    ("bushings as their energies", bushings_as_energies),
    ("actuators as forces", actuators_as_forces),
    ("weights as potentials", weights_as_potentials),
    ("weights as forces", weights_as_forces),
    ("ground turned", ground_turned),
    ("ground moving", ground_moving),
    ("constraints scaled", constraints_scaled),
    ("constraint doubled", constraint_doubled),
    ("constraint by its rate", constraint_by_rate),
    ("constraint put in", constraint_put_in),
    ("definitions inlined", definitions_inlined),
    ("definitions introduced", definitions_introduced),
    ("guide reversed", guide_reversed),
    ("polar coordinates", polar),
];

/// Additional changes: parameters become constants, and other derivatives are requested.
pub const BESIDES: [(&str, Rewriting); 2] = [
    ("parameters as constants", parameters_as_constants),
    ("derivatives and stages", derivatives_and_stages),
];

impl Rewritten {
    pub fn new(machine: &Machine) -> Rewritten {
        Rewritten {
            machine: machine.clone(),
            coordinates: (0..machine.coordinates.len()).map(q).collect(),
            constraints: (0..machine.constraints.len())
                .map(|k| Some((k, 1.0)))
                .collect(),
            guides: (0..machine.sliding.len()).map(|k| (k, 1.0, 1.0)).collect(),
            energies: [true; 3],
            refusable: false,
            by_formulas: false,
            names: Vec::new(),
        }
    }

    /// Substitutes expressions for coordinates.
    fn substitute(&mut self, f: &dyn Fn(usize) -> Option<Expr>) {
        self.machine.replace(&mut |e| {
            if let Expr::Coordinate(i) = e
                && let Some(new) = f(*i)
            {
                *e = new;
            }
        });
    }
}

/// Origin, axes (component, axis) and, in the plane, the angle of a frame, as formulas.
struct Formulas {
    origin: Vec<Expr>,
    axes: Vec<Vec<Expr>>,
    angle: Expr,
}

fn formulas(machine: &Machine, frame: usize) -> Formulas {
    let n = machine.dimension();
    if frame == 0 {
        let one = |i, k| num(if i == k { 1.0 } else { 0.0 });
        return Formulas {
            origin: vec![num(0.0); n],
            axes: (0..n)
                .map(|i| (0..n).map(|k| one(i, k)).collect())
                .collect(),
            angle: num(0.0),
        };
    }
    let Frame { parent, step } = &machine.frames[frame - 1];
    let mut formulas = formulas(machine, *parent);
    match step {
        Step::Shift(shift) => formulas.origin = formulas.point(shift),
        Step::Turn(_, angle) if !machine.spatial => {
            formulas.angle = match formulas.angle {
                Expr::Number(0.0) => angle.clone(),
                before => sum(vec![before, angle.clone()]),
            };
            let (s, c) = (sin(formulas.angle.clone()), cos(formulas.angle.clone()));
            formulas.axes = vec![vec![c.clone(), neg(s.clone())], vec![s, c]];
        }
        Step::Turn(axis, angle) => {
            let (s, c) = (sin(angle.clone()), cos(angle.clone()));
            let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
            for row in &mut formulas.axes {
                let (x, y) = (row[a].clone(), row[b].clone());
                row[a] = sum(vec![product(&x, &c), product(&y, &s)]);
                row[b] = sum(vec![product(&y, &c), neg(product(&x, &s))]);
            }
        }
    }
    formulas
}

/// A product without factors of one and zero.
fn product(a: &Expr, b: &Expr) -> Expr {
    match (a, b) {
        (Expr::Number(0.0), _) | (_, Expr::Number(0.0)) => num(0.0),
        (Expr::Number(1.0), x) | (x, Expr::Number(1.0)) => x.clone(),
        (a, b) => mul(a.clone(), b.clone()),
    }
}

fn total(parts: Vec<Expr>) -> Expr {
    let mut parts: Vec<Expr> = parts.into_iter().filter(|e| *e != num(0.0)).collect();
    match parts.len() {
        0 => num(0.0),
        1 => parts.remove(0),
        _ => sum(parts),
    }
}

impl Formulas {
    fn along(&self, local: &[Expr]) -> Vec<Expr> {
        let row =
            |row: &Vec<Expr>| total(row.iter().zip(local).map(|(a, b)| product(a, b)).collect());
        self.axes.iter().map(row).collect()
    }

    fn point(&self, local: &[Expr]) -> Vec<Expr> {
        let along = self.along(local).into_iter();
        let parts = self.origin.iter().zip(along);
        parts.map(|(a, b)| total(vec![a.clone(), b])).collect()
    }
}

/// The components of a vector along the ground's axes, if it is given in a frame.
fn in_ground(machine: &Machine, v: &Vector) -> Vector {
    match v {
        Vector::Origin(frame) => Vector::Free(formulas(machine, *frame).origin, METRE),
        Vector::Point(frame, local) => Vector::Free(formulas(machine, *frame).point(local), METRE),
        Vector::Along(frame, local) => Vector::Free(formulas(machine, *frame).along(local), PURE),
        Vector::Define(k) => match &machine.defines[*k] {
            Meaning::Vector(v) => in_ground(machine, v),
            Meaning::Number(_) => v.clone(),
        },
        _ => v.clone(),
    }
}

fn place_of(machine: &Machine, body: usize) -> Vector {
    let body = &machine.bodies[body];
    match (&body.at, body.frame) {
        (Some(at), _) => at.clone(),
        (None, frame) => Vector::Origin(frame.unwrap_or(0)),
    }
}

fn cut_elsewhere(r: &mut Rewritten, random: &mut Random) -> bool {
    let Some(closed) = &mut r.machine.closed else {
        return false;
    };
    let links = closed.lengths.len();
    closed.cut = 1 + (closed.cut + random.below(links - 1)) % links;
    close(&mut r.machine);
    for (constraint, stands_for) in r.machine.constraints.iter().zip(&mut r.constraints) {
        if ["across", "up"].contains(&constraint.name.as_str()) {
            *stands_for = None;
        }
    }
    // The energies differ off the constraints, but agree on them.
    true
}

/// Whether an energy depends on points of frames. In a machine with guides such an energy has forces at these points;
/// the same energy as a formula in coordinates only has forces along the guides, so it is not equivalent.
fn energies_need_frames(machine: &Machine) -> bool {
    let mut found = false;
    let energies = machine.potentials.iter().chain(&machine.dissipations);
    for energy in energies {
        energy.clone().vectors(&mut |v| {
            found |= matches!(v, Vector::Point(..) | Vector::Origin(_) | Vector::Along(..));
        });
    }
    (found || !machine.bushings.is_empty()) && is_guided_at_all(machine)
}

fn formulas_for_frames(r: &mut Rewritten, _: &mut Random) -> bool {
    if energies_need_frames(&r.machine) {
        return false;
    }
    let before = r.machine.clone();
    let mut some = false;
    for k in 0..r.machine.bodies.len() {
        let body = &mut r.machine.bodies[k];
        let Some(frame) = body.frame else {
            continue;
        };
        some = true;
        body.at = Some(in_ground(&before, &place_of(&before, k)));
        if !before.spatial {
            body.frame = None;
            body.angle = Some(formulas(&before, frame).angle);
        }
    }
    r.machine.all_vectors(&mut |v| {
        if !matches!(v, Vector::Define(_)) {
            *v = in_ground(&before, v);
        }
    });
    r.by_formulas |= some && is_guided_at_all(&r.machine);
    r.refusable |= r.by_formulas;
    some
}

/// Renumbers frames wherever they occur.
fn rename_frames(machine: &mut Machine, new: &dyn Fn(usize) -> usize) {
    machine.all_vectors(&mut |v| {
        if let Vector::Point(frame, _) | Vector::Along(frame, _) | Vector::Origin(frame) = v {
            *frame = new(*frame);
        }
    });
    for body in &mut machine.bodies {
        body.frame = body.frame.map(new);
    }
    for circle in &mut machine.circles {
        circle.on = circle.on.map(new);
    }
    for rolling in &mut machine.rolling {
        if let Surface::Along(frame) = &mut rolling.surface {
            *frame = new(*frame);
        }
    }
    for guide in &mut machine.sliding {
        guide.on = new(guide.on);
    }
    for bushing in &mut machine.bushings {
        bushing.from = new(bushing.from);
        bushing.to = new(bushing.to);
    }
}

fn frames_from_ground(r: &mut Rewritten, _: &mut Random) -> bool {
    let before = r.machine.clone();
    if before.frames.iter().all(|frame| frame.parent == 0) || energies_need_frames(&before) {
        return false;
    }
    let mut frames = Vec::new();
    let mut renamed = vec![0];
    for k in 1..=before.frames.len() {
        let origin = formulas(&before, k).origin;
        frames.push(Frame {
            parent: 0,
            step: Step::Shift(origin),
        });
        let mut turns = Vec::new();
        let mut at = k;
        while at != 0 {
            let frame = &before.frames[at - 1];
            if let Step::Turn(axis, angle) = &frame.step {
                turns.push((*axis, angle.clone()));
            }
            at = frame.parent;
        }
        turns.reverse();
        if !before.spatial && !turns.is_empty() {
            let angles = turns.iter().map(|(_, angle)| angle.clone());
            turns = vec![(2, sum(angles.collect()))];
        }
        for (axis, angle) in turns {
            frames.push(Frame {
                parent: frames.len(),
                step: Step::Turn(axis, angle),
            });
        }
        renamed.push(frames.len());
    }
    rename_frames(&mut r.machine, &|frame| renamed[frame]);
    r.machine.frames = frames;
    r.by_formulas |= is_guided_at_all(&r.machine);
    r.refusable |= r.by_formulas;
    true
}

fn has_approximations(machine: &Machine) -> bool {
    !machine.approximations.is_empty()
}

fn relative_coordinates(r: &mut Rewritten, random: &mut Random) -> bool {
    let n = r.machine.coordinates.len();
    if n < 2 || has_approximations(&r.machine) {
        return false;
    }
    let i = random.below(n);
    let j = (i + 1 + random.below(n - 1)) % n;
    let factor = [1.0, -1.0, 1.0, 0.5][random.below(4)];
    // Then every force on one coordinate becomes a force on several of the others.
    r.refusable |= is_guided_at_all(&r.machine);
    r.substitute(&|k| (k == i).then(|| sum(vec![q(i), mul(num(factor), q(j))])));
    r.coordinates[i] = sum(vec![
        r.coordinates[i].clone(),
        mul(num(-factor), r.coordinates[j].clone()),
    ]);
    for k in 0..r.machine.forces.len() {
        if let Force::On(on, value) = &r.machine.forces[k]
            && *on == i
        {
            let value = mul(num(factor), value.clone());
            r.machine.forces.push(Force::On(j, value));
        }
    }
    true
}

fn order_of_coordinates(r: &mut Rewritten, random: &mut Random) -> bool {
    let n = r.machine.coordinates.len();
    if n < 2 {
        return false;
    }
    // Entry k is the coordinate that moves to place k.
    let order = shuffled(n, random);
    let place = |i: usize| order.iter().position(|k| *k == i).unwrap_or(i);
    r.substitute(&|i| Some(q(place(i))));
    let coordinates = r.machine.coordinates.clone();
    r.machine.coordinates = order.iter().map(|k| coordinates[*k].clone()).collect();
    let expressions = r.coordinates.clone();
    r.coordinates = order.iter().map(|k| expressions[*k].clone()).collect();
    for force in &mut r.machine.forces {
        if let Force::On(i, _) = force {
            *i = place(*i);
        }
    }
    for (i, _) in &mut r.machine.approximations {
        *i = place(*i);
    }
    true
}

pub fn shuffled(n: usize, random: &mut Random) -> Vec<usize> {
    let mut order: Vec<usize> = (0..n).collect();
    for i in (1..n).rev() {
        order.swap(i, random.below(i + 1));
    }
    order
}

fn reorder<T: Clone>(list: &mut Vec<T>, random: &mut Random) -> Vec<usize> {
    let order = shuffled(list.len(), random);
    let before = list.clone();
    *list = order.iter().map(|k| before[*k].clone()).collect();
    order
}

fn order_of_items(r: &mut Rewritten, random: &mut Random) -> bool {
    let machine = &mut r.machine;
    if !machine.sliding.is_empty() {
        let order = reorder(&mut machine.sliding, random);
        let before = r.guides.clone();
        r.guides = order.iter().map(|k| before[*k]).collect();
    }
    let bodies = reorder(&mut machine.bodies, random);
    let place = |body: usize| bodies.iter().position(|k| *k == body).unwrap_or(body);
    machine.all_vectors(&mut |v| {
        if let Vector::Centre(body) = v {
            *body = place(*body);
        }
    });
    for (body, _) in &mut machine.torques {
        *body = place(*body);
    }
    for circle in &mut machine.circles {
        circle.on = circle.on.map_err(place);
    }
    for guide in &mut machine.sliding {
        guide.body = place(guide.body);
    }
    reorder(&mut machine.springs, random);
    reorder(&mut machine.dampers, random);
    reorder(&mut machine.torsions, random);
    reorder(&mut machine.bushings, random);
    reorder(&mut machine.potentials, random);
    reorder(&mut machine.dissipations, random);
    reorder(&mut machine.forces, random);
    reorder(&mut machine.torques, random);
    let order = reorder(&mut machine.constraints, random);
    let before = r.constraints.clone();
    r.constraints = order.iter().map(|k| before[*k]).collect();
    // Loops are built in the order of their links.
    machine.closed = None;
    true
}

fn is_guided_at_all(machine: &Machine) -> bool {
    !machine.sliding.is_empty()
}

/// Whether a body is in a guide.
fn is_guided(machine: &Machine, body: usize) -> bool {
    machine.sliding.iter().any(|guide| guide.body == body)
}

fn split_body(r: &mut Rewritten, random: &mut Random) -> bool {
    let k = random.below(r.machine.bodies.len());
    if is_guided(&r.machine, k) && r.machine.bodies[k].frame.is_none() {
        return false;
    }
    let body = &mut r.machine.bodies[k];
    let mut other = body.clone();
    let share = [0.25, 0.5, 0.125][random.below(3)];
    for (part, share) in [(&mut *body, share), (&mut other, 1.0 - share)] {
        let scale = |e: &mut Expr| *e = mul(num(share), e.clone());
        scale(&mut part.mass);
        part.inertia.iter_mut().for_each(scale);
    }
    other.name = format!("{}b", other.name);
    r.machine.bodies.push(other);
    true
}

fn particles(r: &mut Rewritten, random: &mut Random) -> bool {
    let candidates: Vec<usize> = (0..r.machine.bodies.len())
        .filter(|k| {
            let body = &r.machine.bodies[*k];
            let local = matches!(body.at, None | Some(Vector::Point(..)));
            local && body.frame.is_some() && [1, 3].contains(&body.inertia.len())
        })
        .collect();
    if candidates.is_empty() {
        return false;
    }
    let k = candidates[random.below(candidates.len())];
    let at = place_of(&r.machine, k);
    // References to its centre become references to that point.
    let centre = at.clone();
    r.machine.all_vectors(&mut |v| {
        if *v == Vector::Centre(k) {
            *v = centre.clone();
        }
    });
    let n = r.machine.dimension();
    let (frame, local) = match at {
        Vector::Point(frame, local) => (frame, local),
        _ => (r.machine.bodies[k].frame.unwrap_or(0), vec![num(0.0); n]),
    };
    let Body { mass, inertia, .. } = r.machine.bodies[k].clone();
    // Two halves with m d² = J; in space six sixths with m a²/3 = (B + C − A)/2.
    let arms: Vec<Expr> = match &inertia[..] {
        [moment] => vec![power(quotient(moment.clone(), mass.clone()), 1)],
        moments => (0..3)
            .map(|i| {
                let parts = (0..3).map(|j| {
                    if i == j {
                        neg(moments[j].clone())
                    } else {
                        moments[j].clone()
                    }
                });
                let parts = mul(num(1.5), sum(parts.collect()));
                power(quotient(parts, mass.clone()), 1)
            })
            .collect(),
    };
    let count = 2.0 * arms.len() as f64;
    let mut parts = Vec::new();
    for (axis, arm) in arms.iter().enumerate() {
        for sign in [1.0, -1.0] {
            let mut place = local.clone();
            place[axis] = sum(vec![place[axis].clone(), mul(num(sign), arm.clone())]);
            parts.push(Vector::Point(frame, place));
        }
    }
    for (index, place) in parts.into_iter().enumerate() {
        let mut part = r.machine.bodies[k].clone();
        part.mass = quotient(mass.clone(), num(count));
        part.inertia = Vec::new();
        part.at = Some(place);
        match index {
            0 => r.machine.bodies[k] = part,
            _ => {
                part.name = format!("{}p{index}", part.name);
                r.machine.bodies.push(part);
            }
        }
    }
    true
}

fn stretch_expr(stretch: &Stretch) -> Expr {
    match stretch {
        Stretch::Number(e) => e.clone(),
        Stretch::Points(a, b, length) => {
            let distance = norm(b.clone().less(a.clone()));
            match length {
                Some(length) => sum(vec![distance, neg(length.clone())]),
                None => distance,
            }
        }
    }
}

fn springs_as_potentials(r: &mut Rewritten, _: &mut Random) -> bool {
    // An energy in coordinates acts only along the guides; a spring between points does not.
    if r.by_formulas {
        return false;
    }
    let springs = std::mem::take(&mut r.machine.springs);
    let some = !springs.is_empty();
    for Elastic {
        factor, stretch, ..
    } in springs
    {
        let energy = mul(mul(num(0.5), factor), power(stretch_expr(&stretch), 4));
        r.machine.potentials.push(energy);
    }
    some
}

fn springs_as_forces(r: &mut Rewritten, _: &mut Random) -> bool {
    // A coordinate that is approximated as small is expanded in energies, but not in forces.
    if has_approximations(&r.machine) {
        return false;
    }
    let n = r.machine.dimension();
    let springs = std::mem::take(&mut r.machine.springs);
    let (between, others): (Vec<Elastic>, Vec<Elastic>) = springs
        .into_iter()
        .partition(|one| matches!(one.stretch, Stretch::Points(..)));
    r.machine.springs = others;
    for one in &between {
        let Stretch::Points(a, b, _) = &one.stretch else {
            continue;
        };
        let pull = mul(one.factor.clone(), stretch_expr(&one.stretch));
        r.machine.forces.extend(pulling([a, b], pull, n));
        r.energies[1] = false;
    }
    !between.is_empty()
}

/// The forces on two points that pull them together.
fn pulling([a, b]: [&Vector; 2], pull: Expr, n: usize) -> [Force; 2] {
    let line = b.clone().less(a.clone());
    let over = quotient(pull, norm(line.clone()));
    [(a, 1.0), (b, -1.0)].map(|(point, sign)| {
        let parts = (0..n).map(|axis| {
            let axis = (0..n).map(|i| num(if i == axis { 1.0 } else { 0.0 }));
            let along = dot(line.clone(), Vector::Free(axis.collect(), PURE));
            mul(num(sign), mul(over.clone(), along))
        });
        let force = Vector::Free(parts.collect(), NEWTON);
        Force::At(point.clone(), force)
    })
}

fn actuators_as_forces(r: &mut Rewritten, _: &mut Random) -> bool {
    let n = r.machine.dimension();
    let before = std::mem::take(&mut r.machine.forces);
    let mut some = false;
    for force in before {
        let Force::Between(a, b, value) = force else {
            r.machine.forces.push(force);
            continue;
        };
        some = true;
        let both = pulling([&a, &b], neg(value), n);
        r.machine.forces.extend(both);
    }
    some
}

fn torsions_otherwise(r: &mut Rewritten, random: &mut Random) -> bool {
    let torsions = std::mem::take(&mut r.machine.torsions);
    let some = !torsions.is_empty();
    for (k, (stiffness, twist)) in torsions.into_iter().enumerate() {
        if random.chance(50) {
            let energy = mul(mul(num(0.5), stiffness), power(twist, 4));
            r.machine.potentials.push(energy);
        } else {
            // A stretch only has a direction; its force across a guide is not determined.
            r.refusable |= is_guided_at_all(&r.machine);
            r.machine.springs.push(Elastic {
                name: format!("t{k}"),
                factor: stiffness,
                stretch: Stretch::Number(twist),
            });
        }
    }
    some
}

fn dampers_as_dissipations(r: &mut Rewritten, _: &mut Random) -> bool {
    // As above.
    if r.by_formulas {
        return false;
    }
    let dampers = std::mem::take(&mut r.machine.dampers);
    let some = !dampers.is_empty();
    for Elastic {
        factor, stretch, ..
    } in dampers
    {
        let rate = der(stretch_expr(&stretch));
        let power = mul(mul(num(0.5), factor), power(rate, 4));
        r.machine.dissipations.push(power);
    }
    some
}

/// Replaces bushings by their energy and dissipation function, in products of vectors.
fn bushings_as_energies(r: &mut Rewritten, _: &mut Random) -> bool {
    // As above.
    if r.by_formulas {
        return false;
    }
    let bushings = std::mem::take(&mut r.machine.bushings);
    let some = !bushings.is_empty();
    for bushing in bushings {
        let angle = |frame: usize| formulas(&r.machine, frame).angle;
        let line = Vector::Origin(bushing.to).less(Vector::Origin(bushing.from));
        let along = |k: usize| {
            let axis = [0, 1].map(|l| num(f64::from(u8::from(k == l))));
            dot(line.clone(), Vector::Along(bushing.from, axis.to_vec()))
        };
        let turned = sum(vec![angle(bushing.to), neg(angle(bushing.from))]);
        let deformed = [along(0), along(1), turned];
        for (k, s) in deformed.into_iter().enumerate() {
            let half = |factor: &Expr, s: Expr| mul(mul(num(0.5), factor.clone()), power(s, 4));
            r.machine
                .potentials
                .push(half(&bushing.stiffness[k], s.clone()));
            if let Some(preload) = &bushing.preload {
                r.machine
                    .potentials
                    .push(neg(mul(preload[k].clone(), s.clone())));
            }
            if let Some(damping) = &bushing.damping {
                r.machine.dissipations.push(half(&damping[k], der(s)));
            }
        }
    }
    some
}

fn weights_as_potentials(r: &mut Rewritten, _: &mut Random) -> bool {
    let Some(gravity) = r.machine.gravity.take() else {
        return false;
    };
    for k in 0..r.machine.bodies.len() {
        let height = dot(Vector::Centre(k), Vector::Free(gravity.clone(), PURE));
        let mass = r.machine.bodies[k].mass.clone();
        r.machine.potentials.push(neg(mul(mass, height)));
    }
    true
}

fn weights_as_forces(r: &mut Rewritten, _: &mut Random) -> bool {
    if has_approximations(&r.machine) {
        return false;
    }
    let Some(gravity) = r.machine.gravity.take() else {
        return false;
    };
    for k in 0..r.machine.bodies.len() {
        let mass = &r.machine.bodies[k].mass;
        let parts = gravity.iter().map(|g| mul(mass.clone(), g.clone()));
        let weight = Vector::Free(parts.collect(), NEWTON);
        r.machine.forces.push(Force::At(Vector::Centre(k), weight));
    }
    r.energies[1] = false;
    true
}

fn ground_turned(r: &mut Rewritten, random: &mut Random) -> bool {
    move_ground(r, random, None);
    true
}

fn ground_moving(r: &mut Rewritten, random: &mut Random) -> bool {
    // Expressions with the velocity of a point would change.
    let asks = |e: &Expr| {
        e.any(|e| {
            let is_rate = |v: &Vector| matches!(v, Vector::Der(_));
            match e {
                Expr::Dot(u, v) => is_rate(u) || is_rate(v),
                Expr::Norm(u) => is_rate(u),
                _ => false,
            }
        })
    };
    let machine = &r.machine;
    let mut all = machine.outputs.iter().chain(&machine.dissipations);
    if has_approximations(machine) || all.any(asks) {
        return false;
    }
    let speeds = (0..machine.dimension()).map(|_| random.number(-1.0, 1.0));
    let speeds = speeds.collect();
    move_ground(r, random, Some(speeds));
    r.energies = [false, false, r.energies[2]];
    true
}

/// Turns the ground about its last axis, and lets it move at a constant velocity.
fn move_ground(r: &mut Rewritten, random: &mut Random, speeds: Option<Vec<f64>>) {
    let machine = &mut r.machine;
    let angle = num(random.number(0.25, 2.5));
    let mut steps = Vec::new();
    let n = machine.dimension();
    let shift: Option<Vec<Expr>> = speeds.map(|speeds| {
        let parts = speeds.iter().map(|speed| mul(num(*speed), Expr::Time));
        parts.collect()
    });
    if let Some(shift) = &shift {
        steps.push(Step::Shift(shift.clone()));
    }
    steps.push(Step::Turn(2, angle.clone()));
    let added = steps.len();
    // All other frames follow these.
    let new = |frame: usize| frame + added;
    rename_frames(machine, &new);
    let frames = std::mem::take(&mut machine.frames);
    machine.frames = steps
        .into_iter()
        .enumerate()
        .map(|(parent, step)| Frame { parent, step })
        .collect();
    machine.frames.extend(frames.into_iter().map(|frame| Frame {
        parent: new(frame.parent),
        step: frame.step,
    }));
    let turned = |parts: &[Expr]| -> Vec<Expr> {
        let (s, c) = (sin(angle.clone()), cos(angle.clone()));
        let mut list = vec![
            total(vec![product(&parts[0], &c), neg(product(&parts[1], &s))]),
            total(vec![product(&parts[0], &s), product(&parts[1], &c)]),
        ];
        list.extend(parts.get(2).cloned());
        list
    };
    machine.all_vectors(&mut |v| {
        if let Vector::Free(parts, unit) = v {
            *parts = turned(parts);
            if let (METRE, Some(shift)) = (*unit, &shift) {
                for (part, by) in parts.iter_mut().zip(shift) {
                    *part = sum(vec![part.clone(), by.clone()]);
                }
            }
        }
    });
    if let Some(gravity) = &mut machine.gravity {
        *gravity = turned(gravity);
    }
    for body in &mut machine.bodies {
        if let Some(own) = &mut body.angle {
            *own = sum(vec![own.clone(), angle.clone()]);
        }
    }
    for (_, torque) in machine.torques.iter_mut().filter(|_| n == 3) {
        *torque = turned(torque);
    }
    machine.closed = None;
}

fn constraints_scaled(r: &mut Rewritten, random: &mut Random) -> bool {
    if r.machine.constraints.is_empty() {
        return false;
    }
    let k = random.below(r.machine.constraints.len());
    let factors = [2.0, -1.0, 0.125, -4.0, 16.0];
    let factor = factors[random.below(factors.len())];
    let one = &mut r.machine.constraints[k];
    if random.chance(50) {
        one.left = mul(num(factor), one.left.clone());
        one.right = mul(num(factor), one.right.clone());
    } else {
        // Both sides exchanged, with all terms on one side.

        let left = std::mem::replace(&mut one.left, mul(num(factor), one.right.clone()));
        one.left = sum(vec![one.left.clone(), mul(num(-factor), left)]);
        one.right = num(0.0);
    }
    let factor = match one.right {
        Expr::Number(0.0) if matches!(one.left, Expr::Sum(_)) => -factor,
        _ => factor,
    };
    if let Some((_, own)) = &mut r.constraints[k] {
        *own *= factor;
    }
    r.machine.closed = None;
    true
}

fn constraint_doubled(r: &mut Rewritten, random: &mut Random) -> bool {
    // Friction with undetermined reactions is tested elsewhere.
    if r.machine.constraints.is_empty() || !r.machine.sliding.is_empty() {
        return false;
    }
    let k = random.below(r.machine.constraints.len());
    let Constraint {
        name,
        left,
        right,
        holonomic,
    } = r.machine.constraints[k].clone();
    let factor = [1.0, 2.0, -0.5][random.below(3)];
    r.machine.constraints.push(Constraint {
        name: format!("{name}b"),
        left: mul(num(factor), left),
        right: mul(num(factor), right),
        holonomic,
    });
    let stands_for = r.constraints[k].map(|(base, own)| (base, own * factor));
    r.constraints.push(stands_for);
    true
}

fn constraint_by_rate(r: &mut Rewritten, random: &mut Random) -> bool {
    let holonomic: Vec<usize> = (0..r.machine.constraints.len())
        .filter(|k| r.machine.constraints[*k].holonomic)
        .collect();
    if holonomic.is_empty() {
        return false;
    }
    let k = holonomic[random.below(holonomic.len())];
    let one = &mut r.machine.constraints[k];
    one.left = der(one.left.clone());
    one.right = der(one.right.clone());
    one.holonomic = false;
    r.machine.closed = None;
    true
}

fn constraint_put_in(r: &mut Rewritten, _: &mut Random) -> bool {
    let is_of = |e: &Expr, i: usize| e.any(|e| *e == q(i));
    let found = r
        .machine
        .constraints
        .iter()
        .enumerate()
        .find_map(|(k, one)| {
            let Expr::Coordinate(i) = one.left else {
                return None;
            };
            let fits = one.holonomic && !is_of(&one.right, i);
            fits.then(|| (k, i, one.right.clone()))
        });
    let Some((k, i, right)) = found else {
        return false;
    };
    let acts = |force: &Force| matches!(force, Force::On(on, _) if *on == i);
    let (count, doubles) = (r.machine.coordinates.len(), &r.constraints);
    let base = doubles[k].map(|(base, _)| base);
    let is_doubled = doubles
        .iter()
        .flatten()
        .filter(|(b, _)| Some(*b) == base)
        .count()
        > 1;
    if count < 2
        || is_doubled
        || has_approximations(&r.machine)
        || r.machine.forces.iter().any(acts)
    {
        return false;
    }
    r.substitute(&|j| (j == i).then(|| right.clone()));
    r.substitute(&|j| (j > i).then(|| q(j - 1)));
    for force in &mut r.machine.forces {
        if let Force::On(on, _) = force
            && *on > i
        {
            *on -= 1;
        }
    }
    r.machine.coordinates.remove(i);
    r.coordinates.remove(i);
    r.machine.constraints.remove(k);
    r.constraints.remove(k);
    true
}

fn definitions_inlined(r: &mut Rewritten, _: &mut Random) -> bool {
    let some = !r.machine.defines.is_empty();
    let defines = r.machine.defines.clone();
    // Definitions may be nested.
    for _ in 0..=defines.len() {
        r.machine.all_vectors(&mut |v| {
            if let Vector::Define(k) = v
                && let Meaning::Vector(meaning) = &defines[*k]
            {
                *v = meaning.clone();
            }
        });
        r.machine.replace(&mut |e| {
            if let Expr::Define(k) = e
                && let Meaning::Number(meaning) = &defines[*k]
            {
                *e = meaning.clone();
            }
        });
    }
    r.machine.defines = Vec::new();
    some
}

fn definitions_introduced(r: &mut Rewritten, random: &mut Random) -> bool {
    let mut defines = std::mem::take(&mut r.machine.defines);
    let before = defines.len();
    for frame in &mut r.machine.frames {
        if let Step::Turn(_, angle) = &mut frame.step
            && !matches!(angle, Expr::Define(_))
        {
            let meaning = std::mem::replace(angle, Expr::Define(defines.len()));
            defines.push(Meaning::Number(meaning));
        }
    }
    for body in &mut r.machine.bodies {
        if let Some(at) = &mut body.at
            && !matches!(at, Vector::Define(_))
            && random.chance(60)
        {
            let meaning = std::mem::replace(at, Vector::Define(defines.len()));
            defines.push(Meaning::Vector(meaning));
        }
    }
    for one in &mut r.machine.springs {
        if let Stretch::Number(e) = &mut one.stretch
            && !matches!(e, Expr::Define(_))
        {
            let meaning = std::mem::replace(e, Expr::Define(defines.len()));
            defines.push(Meaning::Number(meaning));
        }
    }
    r.machine.defines = defines;
    r.machine.defines.len() > before
}

fn guide_reversed(r: &mut Rewritten, random: &mut Random) -> bool {
    if r.machine.sliding.is_empty() {
        return false;
    }
    let k = random.below(r.machine.sliding.len());
    let guide = &mut r.machine.sliding[k];
    let factor = [-1.0, -3.0, -0.125, 6.0][random.below(4)];
    guide.direction = Vector::Scaled(num(factor), Box::new(guide.direction.clone()));
    let (_, direction, normal) = &mut r.guides[k];
    if factor < 0.0 {
        *direction = -*direction;
        if guide.normal.is_none() {
            *normal = -*normal;
        }
    }
    true
}

fn polar(r: &mut Rewritten, random: &mut Random) -> bool {
    let n = r.machine.coordinates.len();
    if n < 2 || has_approximations(&r.machine) {
        return false;
    }
    let i = random.below(n);
    let j = (i + 1 + random.below(n - 1)) % n;
    let start = |k: usize| r.machine.coordinates[k].start;
    if start(i).hypot(start(j)) < 0.375 {
        return false;
    }
    // As above.
    r.refusable |= is_guided_at_all(&r.machine);
    let (distance, angle) = (q(i), q(j));
    let of_x = |e: Expr| mul(e, cos(angle.clone()));
    let of_y = |e: Expr| mul(e, sin(angle.clone()));
    r.substitute(&|k| match k {
        k if k == i => Some(of_x(distance.clone())),
        k if k == j => Some(of_y(distance.clone())),
        _ => None,
    });
    let (x, y) = (r.coordinates[i].clone(), r.coordinates[j].clone());
    r.coordinates[i] = power(sum(vec![power(x.clone(), 4), power(y.clone(), 4)]), 1);
    r.coordinates[j] = Expr::Angle(Box::new(y), Box::new(x));
    let forces = std::mem::take(&mut r.machine.forces);
    for force in forces {
        match force {
            Force::On(k, value) if k == i => r.machine.forces.extend([
                Force::On(i, of_x(value.clone())),
                Force::On(j, neg(mul(q(i), of_y(value)))),
            ]),
            Force::On(k, value) if k == j => r.machine.forces.extend([
                Force::On(i, of_y(value.clone())),
                Force::On(j, mul(q(i), of_x(value))),
            ]),
            force => r.machine.forces.push(force),
        }
    }
    r.machine.assumptions.push(q(i));
    true
}

fn parameters_as_constants(r: &mut Rewritten, random: &mut Random) -> bool {
    // It would change the function that is differentiated by a parameter.
    if r.machine.derivatives[3] {
        return false;
    }
    let k = random.below(r.machine.parameters.len());
    let mut constant = r.machine.parameters[k].clone();
    constant.name = format!("fixed_{}", constant.name);
    let index = r.machine.constants.len();
    r.machine.constants.push(constant);
    r.machine.replace(&mut |e| {
        if *e == Expr::Parameter(k) {
            *e = Expr::Constant(index);
        }
    });
    // An assumption that only contains numbers is trivial.
    r.machine
        .assumptions
        .retain(|e| *e != Expr::Constant(index));
    true
}

fn derivatives_and_stages(r: &mut Rewritten, random: &mut Random) -> bool {
    if !r.machine.sliding.is_empty() {
        return false;
    }
    if r.machine.derivatives == [false; 4] && r.machine.stages == [false; 2] {
        if random.chance(50) {
            r.machine.derivatives = [true, random.chance(50), false, false]
        } else {
            r.machine.stages = [random.chance(50), true]
        }
    } else {
        r.machine.derivatives = [false; 4];
        r.machine.stages = [false; 2];
    }
    true
}

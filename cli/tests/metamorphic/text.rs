//! Prints a machine as the text of a spec.

use super::machine::{
    Approximation, Coordinate, Elastic, Expr, Force, Machine, Meaning, NEWTON, PURE, Step, Stretch,
    Surface, Unit, Vector,
};

/// An item of a section.
#[derive(Clone, Debug)]
pub struct Item {
    pub section: &'static str,
    pub name: String,
    pub text: String,
}

/// The constants of one unit each that every machine has.
const UNITS: &str = "one_m: m = 1, one_s: s = 1, one_kg: kg = 1, one_N: N = 1";

fn unit_text([m, s, n]: Unit) -> String {
    let factors = [("one_m", m), ("one_s", s), ("one_N", n)];
    let factors = factors.iter().filter(|(_, power)| *power != 0);
    let text: Vec<String> = factors
        .map(|(name, power)| format!("{name}^({power})"))
        .collect();
    if text.is_empty() {
        "1".into()
    } else {
        text.join("*")
    }
}

struct Printer<'m>(&'m Machine);

impl Printer<'_> {
    fn list(&self, parts: &[Expr], unit: Unit) -> String {
        let scale = match unit {
            PURE => String::new(),
            _ => format!("*{}", unit_text(unit)),
        };
        let parts: Vec<String> = parts
            .iter()
            .map(|part| format!("{}{scale}", self.expr(part)))
            .collect();
        parts.join(", ")
    }

    /// A dimensionless expression, in parentheses if it needs them as a factor.
    fn expr(&self, e: &Expr) -> String {
        match e {
            Expr::Number(x) if *x < 0.0 => format!("({x})"),
            Expr::Number(x) => x.to_string(),
            Expr::Parameter(k) => self.0.parameters[*k].name.clone(),
            Expr::Constant(k) => self.0.constants[*k].name.clone(),
            Expr::Define(k) => format!("d{k}"),
            Expr::Coordinate(i) => self.0.coordinates[*i].name.clone(),
            Expr::Input(k) => self.0.inputs[*k].name.clone(),
            Expr::Time => "(t/one_s)".into(),
            Expr::Sum(parts) => {
                let parts: Vec<String> = parts.iter().map(|part| self.expr(part)).collect();
                format!("({})", parts.join(" + "))
            }
            Expr::Product(parts) => {
                let parts: Vec<String> = parts.iter().map(|part| self.expr(part)).collect();
                parts.join("*")
            }
            Expr::Quotient(a, b) => format!("({}/({}))", self.expr(a), self.expr(b)),
            Expr::Power(a, halves) => match halves % 2 {
                0 => format!("({})^({})", self.expr(a), halves / 2),
                _ => format!("({})^({halves}/2)", self.expr(a)),
            },
            Expr::Sin(a) => format!("sin({})", self.expr(a)),
            Expr::Cos(a) => format!("cos({})", self.expr(a)),
            Expr::Exp(a) => format!("exp({})", self.expr(a)),
            Expr::Angle(y, x) => format!("atan2({}, {})", self.expr(y), self.expr(x)),
            Expr::Der(a) => format!("(one_s*der({}))", self.expr(a)),
            Expr::Dot(u, v) => {
                let ([a, b, c], [d, e, f]) = (u.unit(self.0), v.unit(self.0));
                let (u, v) = (self.vector(u), self.vector(v));
                let unit = unit_text([a + d, b + e, c + f]);
                format!("(dot({u}, {v})/({unit}))")
            }
            Expr::Norm(u) => {
                let unit = unit_text(u.unit(self.0));
                format!("(norm({})/({unit}))", self.vector(u))
            }
        }
    }

    fn frame(&self, frame: usize) -> String {
        match frame {
            0 => "ground".into(),
            _ => format!("f{frame}"),
        }
    }

    fn vector(&self, v: &Vector) -> String {
        match v {
            Vector::Free(parts, unit) => format!("({})", self.list(parts, *unit)),
            Vector::Origin(frame) => format!("{}.origin", self.frame(*frame)),
            Vector::Point(frame, parts) => {
                let parts = self.list(parts, [1, 0, 0]);
                format!("{}.point({parts})", self.frame(*frame))
            }
            Vector::Along(frame, parts) => {
                format!("{}.vector({})", self.frame(*frame), self.list(parts, PURE))
            }
            Vector::Centre(body) => format!("{}.at", self.0.bodies[*body].name),
            Vector::Define(k) => format!("d{k}"),
            Vector::Less(a, b) => format!("({} - {})", self.vector(a), self.vector(b)),
            Vector::Scaled(e, a) => format!("{}*{}", self.expr(e), self.vector(a)),
            Vector::Der(a) => format!("der({})", self.vector(a)),
        }
    }

    fn elastic(&self, one: &Elastic, factor: &str) -> String {
        let (value, unit) = match factor {
            "stiffness" => (self.expr(&one.factor), "one_N/one_m"),
            _ => (self.expr(&one.factor), "one_N*one_s/one_m"),
        };
        let stretch = match &one.stretch {
            Stretch::Number(e) => format!("stretch: {}*one_m", self.expr(e)),
            Stretch::Points(a, b, length) => {
                let length = length.as_ref().map_or_else(String::new, |length| {
                    format!(", length: {}*one_m", self.expr(length))
                });
                format!("from: {}, to: {}{length}", self.vector(a), self.vector(b))
            }
        };
        format!("{} {{ {factor}: {value}*{unit}, {stretch} }}", one.name)
    }
}

/// The items of all sections. Families are declared member by member.
pub fn items(machine: &Machine) -> Vec<Item> {
    let p = Printer(machine);
    let mut items = Vec::new();
    let mut item = |section: &'static str, name: String, text: String| {
        items.push(Item {
            section,
            name,
            text,
        });
    };
    item("constants", String::new(), UNITS.into());
    for one in &machine.constants {
        let (name, value) = (one.name.clone(), one.value);
        item("constants", name.clone(), format!("{name} = {value}"));
    }
    for (section, list) in [
        ("parameters", &machine.parameters),
        ("inputs", &machine.inputs),
    ] {
        for one in list {
            let (name, value) = (one.name.clone(), one.value);
            item(section, name.clone(), format!("{name}: 1 = {value}"));
        }
    }
    for one in &machine.coordinates {
        let name = one.name.clone();
        let mut text = format!("{name}: 1 = {}", one.start);
        if one.rate != 0.0 {
            text += &format!(", der({name}): 1/s = {}", one.rate);
        }
        item("coordinates", name, text);
    }
    for (k, define) in machine.defines.iter().enumerate() {
        let text = match define {
            Meaning::Number(e) => p.expr(e),
            Meaning::Vector(v) => p.vector(v),
        };
        item("define", format!("d{k}"), format!("d{k} = {text}"));
    }
    for fact in &machine.assumptions {
        item("assume", String::new(), format!("{} > 0", p.expr(fact)));
    }
    for (k, frame) in machine.frames.iter().enumerate() {
        let step = match &frame.step {
            Step::Shift(shift) => format!("shift({})", p.list(shift, [1, 0, 0])),
            Step::Turn(axis, angle) if machine.spatial => {
                format!("turn({}, {})", ["x", "y", "z"][*axis], p.expr(angle))
            }
            Step::Turn(_, angle) => format!("turn({})", p.expr(angle)),
        };
        let name = p.frame(k + 1);
        let text = format!("{name} = {}.{step}", p.frame(frame.parent));
        item("frames", name, text);
    }
    for body in &machine.bodies {
        let mut fields = vec![format!("mass: one_kg*{}", p.expr(&body.mass))];
        let inertia: Vec<String> = body
            .inertia
            .iter()
            .map(|e| format!("one_kg*one_m^2*{}", p.expr(e)))
            .collect();
        match inertia.len() {
            0 => {}
            1 => fields.push(format!("inertia: {}", inertia[0])),
            _ => fields.push(format!("inertia: ({})", inertia.join(", "))),
        }
        fields.extend(body.frame.map(|frame| format!("frame: {}", p.frame(frame))));
        fields.extend(body.at.as_ref().map(|at| format!("at: {}", p.vector(at))));
        fields.extend(body.angle.as_ref().map(|e| format!("angle: {}", p.expr(e))));
        let text = format!("{} {{ {} }}", body.name, fields.join(", "));
        item("bodies", body.name.clone(), text);
    }
    if let Some(gravity) = &machine.gravity {
        let text = format!("({})", p.list(gravity, [1, -2, 0]));
        item("gravity", String::new(), text);
    }
    for one in &machine.springs {
        item("springs", one.name.clone(), p.elastic(one, "stiffness"));
    }
    for one in &machine.dampers {
        item("dampers", one.name.clone(), p.elastic(one, "damping"));
    }
    for (k, (stiffness, twist)) in machine.torsions.iter().enumerate() {
        let (stiffness, twist) = (p.expr(stiffness), p.expr(twist));
        let text = format!("w{k} {{ stiffness: one_N*one_m*{stiffness}, twist: {twist} }}");
        item("torsion_springs", format!("w{k}"), text);
    }
    for (k, one) in machine.bushings.iter().enumerate() {
        let values = |field: &str, values: &[Expr; 3], unit: &str| {
            let [x, y, angle] = [0, 1, 2].map(|k| p.expr(&values[k]));
            let about = format!("{angle}*{unit}*one_m^2");
            format!("{field}: ({x}*{unit}, {y}*{unit}, {about})")
        };
        let ends = format!("from: {}, to: {}", p.frame(one.from), p.frame(one.to));
        let mut fields = vec![ends, values("stiffness", &one.stiffness, "one_N/one_m")];
        let damping = one.damping.as_ref();
        fields.extend(damping.map(|all| values("damping", all, "one_N*one_s/one_m")));
        fields.extend(one.preload.as_ref().map(|[x, y, moment]| {
            let along = p.list(&[x.clone(), y.clone()], NEWTON);
            format!("preload: ({along}, {}*one_N*one_m)", p.expr(moment))
        }));
        let text = format!("b{k} {{ {} }}", fields.join(", "));
        item("bushings", format!("b{k}"), text);
    }
    for (k, e) in machine.potentials.iter().enumerate() {
        let text = format!("u{k}: one_N*one_m*{}", p.expr(e));
        item("potentials", format!("u{k}"), text);
    }
    for (k, e) in machine.dissipations.iter().enumerate() {
        let text = format!("r{k}: one_N*one_m/one_s*{}", p.expr(e));
        item("dissipations", format!("r{k}"), text);
    }
    for (k, force) in machine.forces.iter().enumerate() {
        let text = match force {
            Force::Between(from, to, value) => {
                let (from, to, value) = (p.vector(from), p.vector(to), p.expr(value));
                let text = format!("p{k} {{ from: {from}, to: {to}, force: one_N*{value} }}");
                item("actuators", format!("p{k}"), text);
                continue;
            }
            Force::At(point, force) => {
                format!("at: {}, force: {}", p.vector(point), p.vector(force))
            }
            Force::On(i, value) => {
                let name = &machine.coordinates[*i].name;
                format!("on: {name}, value: one_N*one_m*{}", p.expr(value))
            }
        };
        item("forces", format!("p{k}"), format!("p{k} {{ {text} }}"));
    }
    for (k, (body, torque)) in machine.torques.iter().enumerate() {
        let parts = p.list(torque, [1, 0, 1]);
        let torque = if machine.spatial {
            format!("({parts})")
        } else {
            parts
        };
        let name = &machine.bodies[*body].name;
        let text = format!("m{k} {{ on: {name}, torque: {torque} }}");
        item("torques", format!("m{k}"), text);
    }
    for one in &machine.constraints {
        let (left, right) = (p.expr(&one.left), p.expr(&one.right));
        let text = format!("{}: {left} = {right}", one.name);
        item("constraints", one.name.clone(), text);
    }
    for (k, circle) in machine.circles.iter().enumerate() {
        let on = match circle.on {
            Ok(frame) => p.frame(frame),
            Err(body) => machine.bodies[body].name.clone(),
        };
        let centre = p.list(&circle.centre, [1, 0, 0]);
        let radius = p.expr(&circle.radius);
        let text = format!("c{k} {{ on: {on}, center: ({centre}), radius: {radius}*one_m }}");
        item("circles", format!("c{k}"), text);
    }
    for one in &machine.rolling {
        let surface = match &one.surface {
            Surface::Inside(k) => format!("inside: c{k}"),
            Surface::Outside(k) => format!("outside: c{k}"),
            Surface::Along(frame) => format!("along: {}", p.frame(*frame)),
        };
        let text = format!("{} {{ circle: c{}, {surface} }}", one.name, one.circle);
        item("rolling", one.name.clone(), text);
    }
    for one in &machine.sliding {
        let mut text = format!(
            "{} {{ body: {}, on: {}, direction: {}, friction: {}",
            one.name,
            machine.bodies[one.body].name,
            p.frame(one.on),
            p.vector(&one.direction),
            p.expr(&one.friction)
        );
        if let Some(normal) = &one.normal {
            text += &format!(", normal: {}", p.vector(normal));
        }
        if let Some(sticking) = &one.sticking {
            text += &format!(", static_friction: {}", p.expr(sticking));
        }
        item("sliding", one.name.clone(), text + " }");
    }
    for (i, kind) in &machine.approximations {
        let name = &machine.coordinates[*i].name;
        let kind = match kind {
            Approximation::Frozen => "frozen",
            Approximation::Small => "small",
        };
        item("approximations", name.clone(), format!("{name}: {kind}"));
    }
    for (k, e) in machine.outputs.iter().enumerate() {
        let text = format!("o{k}: 1 = {}", p.expr(e));
        item("outputs", format!("o{k}"), text);
    }
    let words = ["coordinates", "rates", "inputs", "parameters"];
    for (word, _) in words.iter().zip(machine.derivatives).filter(|(_, on)| *on) {
        item("derivatives", (*word).into(), (*word).into());
    }
    let words = ["time", "coordinates"];
    for (word, _) in words.iter().zip(machine.stages).filter(|(_, on)| *on) {
        item("stages", (*word).into(), (*word).into());
    }
    for Coordinate { name, kept, .. } in &machine.coordinates {
        let [start, rate] = [name.clone(), format!("der({name})")];
        for (text, _) in [start, rate]
            .into_iter()
            .zip(kept)
            .filter(|(_, kept)| **kept)
        {
            item("keep", text.clone(), text);
        }
    }
    items
}

/// The text of items in the given order; consecutive items of the same section share its braces.
pub fn assemble(head: &str, items: &[Item]) -> String {
    let mut text = format!("{head} {{\n");
    for group in items.chunk_by(|a, b| a.section == b.section && a.section != "gravity") {
        let section = group[0].section;
        let words: Vec<&str> = group.iter().map(|item| item.text.as_str()).collect();
        match section {
            "gravity" => text += &format!("    gravity {};\n", words[0]),
            "remove" => {
                for word in words {
                    text += &format!("    remove {word};\n");
                }
            }
            _ => {
                text += &format!(
                    "    {section} {{\n        {},\n    }}\n",
                    words.join(",\n        ")
                )
            }
        }
    }
    text + "}\n"
}

pub fn head(machine: &Machine, name: &str) -> String {
    let space = if machine.spatial { "space" } else { "plane" };
    format!("machine {name} in {space}")
}

/// The machine as a spec, in the usual order.
pub fn spec(machine: &Machine, name: &str) -> String {
    assemble(&head(machine, name), &items(machine))
}

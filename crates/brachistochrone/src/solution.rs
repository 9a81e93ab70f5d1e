//! The fastest motion, with all quantities along it.

use super::error::Unsolved;
use super::linear::{dot, times};
use super::plane::Arc;
use super::problem::{Frame, Problem, check_list};

/// The number of intervals into which [`Brachistochrone::violations`] divides the motion to check the guides.
const CHECK_POINTS: u32 = 256;

/// The fastest motion from rest at one position to another.
#[derive(Clone, Debug)]
pub struct Brachistochrone {
    problem: Problem,
    frame: Frame,
    arc: Arc,
    start: Vec<f64>,
    end: Vec<f64>,
    /// `S` of [`plane`](super::plane), in the unit of V.
    scale: f64,
    /// `R cos x₀`.
    descent: f64,
    /// `x₀`, in rad.
    first: f64,
}

/// The motion at one moment. Numbers are in SI units, vectors have a component for each coordinate.
#[derive(Clone, Debug, PartialEq)]
pub struct Moment {
    /// Time since the start, in s.
    pub time: f64,
    /// The angle by which the direction has turned, in rad, in the metric of the motion.
    pub turned: f64,
    /// The coordinates `q`.
    pub q: Vec<f64>,
    /// Their rates `v = q̇`.
    pub v: Vec<f64>,
    /// Their accelerations `v̇`.
    pub a: Vec<f64>,
    /// The direction of motion, as a velocity for which twice the kinetic energy `a_αβ v^α v^β` is 1; defined at rest too.
    pub direction: Vec<f64>,
    /// Control forces `u = (a + d) v̇ + b + c`.
    pub control: Vec<f64>,
    /// Power of friction `−b·v − v·d v̇`, in W.
    pub friction_power: f64,
    /// λ of (44), the multiplier of the principle of work and energy divided by the speed, (31); 0 at the end.
    pub multiplier: f64,
    /// The slips and reactions of the guides, in their order.
    pub contacts: Vec<Contact>,
}

/// A guide at one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Slip `τ·v`, in m/s; friction was taken to act against a positive one.
    pub slip: f64,
    /// Normal reaction `ν + ρ·v̇`, in N; a guide that only presses cannot make a negative one.
    pub reaction: f64,
}

/// A guide that violates the law under which the motion was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Lapse {
    /// Name of the guide.
    pub guide: String,
    /// The time of the first violation, in s.
    pub time: f64,
    /// Whether it slips backwards; otherwise its reaction is negative.
    pub backwards: bool,
    /// The least value during the motion: of the reaction, in N, or of the slip for motion with unit [`Moment::direction`].
    pub least: f64,
}

impl Problem {
    /// The fastest motion from rest at one position to another.
    ///
    /// # Errors
    /// Why there is none; see [`Unsolved`].
    pub fn solve(&self, from: &[f64], to: &[f64]) -> Result<Brachistochrone, Unsolved> {
        let n = self.coordinates();
        check_list("the start", from, n)?;
        check_list("the end", to, n)?;
        let displacement: Vec<f64> = to.iter().zip(from).map(|(to, from)| to - from).collect();
        check_list("the way to the end", &displacement, n)?;
        if displacement.iter().all(|x| *x == 0.0) {
            return Err(Unsolved::SameEnds);
        }
        let frame = Frame::new(self, &displacement)?;
        let arc = Arc::to(frame.angle, frame.kappa)
            .map_err(|beyond| self.beyond(&displacement, frame.angle, beyond.reach))?;
        Ok(Brachistochrone::new(self.clone(), frame, arc, from, to))
    }

    /// The reason why the end cannot be reached.
    fn beyond(&self, way: &[f64], angle: f64, reach: f64) -> Unsolved {
        let rise = dot(&self.slope, way);
        let friction = dot(&self.loads, way);
        if rise >= 0.0 {
            return Unsolved::NotBelow { rise };
        }
        if rise + friction < 0.0 {
            Unsolved::TurnsTooFar { angle, reach }
        } else {
            Unsolved::Held {
                descent: -rise,
                friction,
            }
        }
    }
}

impl Brachistochrone {
    fn new(
        problem: Problem,
        frame: Frame,
        arc: Arc,
        start: &[f64],
        end: &[f64],
    ) -> Brachistochrone {
        let first = frame.kappa.atan();
        let descent = frame.drive * first.cos();
        let [ahead, aside, _] = arc.whole();
        // Separate square roots: for a straight path, `ahead` is nearly 0.
        let scale = (frame.length * descent).sqrt() / ahead.hypot(aside).sqrt();
        Brachistochrone {
            problem,
            frame,
            arc,
            start: start.to_vec(),
            end: end.to_vec(),
            scale,
            descent,
            first,
        }
    }

    /// The duration, in s.
    pub fn time(&self) -> f64 {
        self.scale / self.descent * self.arc.whole()[2]
    }

    /// The machine.
    pub fn problem(&self) -> &Problem {
        &self.problem
    }

    /// The start and the end.
    pub fn ends(&self) -> [&[f64]; 2] {
        [&self.start, &self.end]
    }

    /// The constant κ of friction, positive where turning costs speed; 0 without friction, and with more than two
    /// coordinates.
    pub fn kappa(&self) -> f64 {
        self.frame.kappa
    }

    /// The total angle by which the direction turns, in rad, in the metric of the motion.
    pub fn turn(&self) -> f64 {
        self.arc.turn()
    }

    /// The constants `C_α` of Euler's equations (22), a covector; infinite for a whole arch of a cycloid.
    pub fn constants(&self) -> Vec<f64> {
        let turn = self.arc.turn();
        let sin = if self.arc.is_arch() { 0.0 } else { turn.sin() };
        let length = 1.0 / (self.scale * sin * self.first.cos());
        let (aside, ahead) = (2.0 * self.first + turn).sin_cos();
        let [down, across] = &self.frame.coaxes;
        let parts = down.iter().zip(across);
        parts
            .map(|(down, across)| length * (ahead * down + aside * across))
            .collect()
    }

    /// The range of sudden turns of the direction, in rad, among which none would be faster at any moment: −π and π
    /// if there is no better motion at all, less where turning saves friction. Positive turns have the sense in which
    /// the motion turns.
    pub fn best_among_turns(&self) -> [f64; 2] {
        self.arc.best_among_turns()
    }

    /// The motion at a time, in s; times before the start or after the end are clamped.
    pub fn at(&self, time: f64) -> Moment {
        let part = time / self.time();
        self.after_turning(self.arc.turned_after(part))
    }

    /// The motion at a fraction of the total turn, from 0 to 1; moments are then denser where it turns faster.
    pub fn after_part(&self, part: f64) -> Moment {
        self.after_turning(self.arc.turn() * part.clamp(0.0, 1.0))
    }

    fn after_turning(&self, u: f64) -> Moment {
        let Brachistochrone { problem, frame, .. } = self;
        let [down, across] = &frame.axes;
        let along = |ahead: f64, aside: f64| -> Vec<f64> {
            let parts = down.iter().zip(across);
            parts
                .map(|(down, across)| ahead * down + aside * across)
                .collect()
        };
        let [ahead, aside, time] = self.arc.so_far(u);
        let (sin, cos) = self.first.sin_cos();
        let displacement = along(cos * ahead - sin * aside, sin * ahead + cos * aside);
        // Applied one after the other, because the unit of displacement may overflow where the displacement in that unit underflows.
        let scaled = |x: &f64| x * self.scale / self.descent * self.scale;
        let q = self
            .start
            .iter()
            .zip(&displacement)
            .map(|(start, x)| start + scaled(x))
            .collect();
        let (sin, cos) = (self.first + u).sin_cos();
        let [unit, turned] = [along(cos, sin), along(-sin, cos)];
        let (speed, by_angle) = self.arc.speed(u);
        let rate = self.descent / self.scale / self.arc.slowness(u);
        let speed = self.scale * speed;
        let (faster, turning) = (self.scale * by_angle * rate, speed * rate);
        let v: Vec<f64> = unit.iter().map(|unit| speed * unit).collect();
        let parts = unit.iter().zip(&turned);
        let a: Vec<f64> = parts
            .map(|(unit, turned)| faster * unit + turning * turned)
            .collect();
        let reactive = times(&problem.reactive, &a);
        let friction_power = -dot(&problem.loads, &v) - dot(&reactive, &v);
        let inertia = times(&problem.mass, &a);
        let control = (0..v.len())
            .map(|i| inertia[i] + reactive[i] + problem.loads[i] + problem.slope[i])
            .collect();
        let contacts = problem.guides.iter().map(|guide| Contact {
            slip: dot(&guide.along, &v),
            reaction: guide.load + dot(&guide.weights, &a),
        });
        // In the metric of the motion |e| = 1, but the paper measures speed by the kinetic energy alone.
        let kinetic = dot(&unit, &times(&problem.mass, &unit)).sqrt();
        Moment {
            time: self.scale / self.descent * time,
            turned: u,
            q,
            contacts: contacts.collect(),
            direction: unit.iter().map(|unit| unit / kinetic).collect(),
            v,
            a,
            control,
            friction_power,
            multiplier: self.arc.multiplier(u) / self.descent * kinetic,
        }
    }

    /// Guides that slip backwards, or whose reaction becomes negative, at one of 257 moments: there the assumed friction is
    /// not that of Coulomb.
    pub fn violations(&self) -> Vec<Lapse> {
        let moments =
            (0..=CHECK_POINTS).map(|k| self.after_part(f64::from(k) / f64::from(CHECK_POINTS)));
        let guides = &self.problem.guides;
        let names: Vec<String> = guides.iter().map(|guide| guide.name.clone()).collect();
        let slip = |guide: usize, moment: &Moment| dot(&guides[guide].along, &moment.direction);
        violations(&names, &moments.collect::<Vec<_>>(), slip)
    }
}

/// The violations of Coulomb's law by guides at these moments; `slip` is that of a motion with unit [`Moment::direction`].
pub(super) fn violations(
    guides: &[String],
    moments: &[Moment],
    slip: impl Fn(usize, &Moment) -> f64,
) -> Vec<Lapse> {
    let mut lapses = Vec::new();
    for (index, guide) in guides.iter().enumerate() {
        for backwards in [true, false] {
            let value = |moment: &Moment| {
                if backwards {
                    slip(index, moment)
                } else {
                    moment.contacts[index].reaction
                }
            };
            let least = moments.iter().map(value).fold(f64::INFINITY, f64::min);
            if let Some(moment) = moments.iter().find(|moment| value(moment) < 0.0) {
                lapses.push(Lapse {
                    guide: guide.clone(),
                    time: moment.time,
                    backwards,
                    least,
                });
            }
        }
    }
    lapses
}

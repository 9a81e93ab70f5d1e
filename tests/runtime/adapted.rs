//! A derived machine with an additional force, compared with a machine whose spec contains that force.

use crate::by_hand::as_list::AsList;
use crate::by_hand::toy::oscillator;
use lagrangian::interpreted::{InterpretedMachine, Named};
use lagrangian::{
    Adapted, Error, HasFriction, Machine, Quantity, Simulation, State, System, Warning,
};

/// Compiles a machine with the force in its spec, and one without it.
fn both(text: &str, force: &str) -> [InterpretedMachine; 2] {
    [text.replace("FORCE", force), text.replace("FORCE", "")]
        .map(|text| InterpretedMachine::from_text(text).build().unwrap())
}

const FREE: &str = "machine Rods in plane {
    parameters { m: kg = 1, l: m = 0.8, g: m/s^2 = 9.81, c: N*m*s^2 = 0.3, d: N*m = 0.5, w: 1/s = 4 }
    coordinates { a: rad = 0.7, b: rad = -0.4 }
    bodies { upper { mass: m, at: l*(sin(a), -cos(a)) }, lower { mass: m/2, at: upper.at + l*(sin(b), -cos(b)) } }
    gravity (0, -g);
    FORCE
}";

const HELD: &str = "machine Held in plane {
    parameters { m: kg = 2, l: m = 0.8, r: m = 0.1, g: m/s^2 = 9.81, F: N = 5, H: N = 3, c: N*s/m = 2, k: N/m = 30 }
    coordinates { x: m = 0.8, y: m, z: m }
    bodies { bob { mass: m, at: (x, y) }, slider { mass: m, at: (z, 0) } }
    gravity (0, -g);
    springs { link { stiffness: k, stretch: z - x } }
    constraints { rod: (x^2 + y^2 - l^2)/(2*l) = 0 }
    FORCE
}";

/// The rod's length changes and the slider is shaken, so constraints and drives do work.
const MOVED: &str = "machine Moved in plane {
    parameters {
        m: kg = 2, l: m = 0.8, r: m = 0.1, g: m/s^2 = 9.81, F: N = 5, H: N = 3, c: N*s/m = 2, k: N/m = 30,
        shake: 1/s = 3, grow: 1/s = 2,
    }
    coordinates { x: m = 0.8, y: m, z: m }
    bodies { bob { mass: m, at: (x, y) }, slider { mass: m, at: (z + r*sin(shake*t), 0) } }
    gravity (0, -g);
    springs { link { stiffness: k, stretch: z - x } }
    constraints { rod: (x^2 + y^2 - (l + r*sin(grow*t))^2)/(2*l) = 0 }
    FORCE
}";

type Force = fn(f64, &Named, &Named, &Named, &mut Named);

/// Runs both machines and compares motions, multipliers and energy balances.
fn agree(text: &str, in_spec: &str, force: Force) {
    const TOLERANCE: f64 = 1e-10;
    let [whole, without] = both(text, in_spec);
    let adapted = Adapted::new(without, force).unwrap();
    let start = whole.start();
    let expected = Simulation::new(&whole).tolerance(TOLERANCE).until(2.0);
    let expected = expected.energy_balance(true).run(start.clone()).unwrap();
    let run = Simulation::new(&adapted).tolerance(TOLERANCE).until(2.0);
    let run = run.energy_balance(true).run(start).unwrap();
    // The start of a machine with prescribed motions may have to be moved onto them; there must be no other warning,
    // such as one about energy.
    let is_about_start = |warning: &Warning| matches!(warning, Warning::StartMoved { .. });
    assert!(run.warnings().iter().all(is_about_start));
    let [mine, theirs] = [run.energy_balance(), expected.energy_balance()].map(Option::unwrap);
    // Each of fewer than a thousand steps keeps the tolerance, and these motions amplify errors by less than ten.
    let limit = 1e4 * TOLERANCE;
    let off = (mine.work - mine.dissipated) - (theirs.work - theirs.dissipated);
    assert!(off.abs() < 100.0 * limit, "{off:e} J");
    assert!(theirs.exchanged > 1.0);
    for t in [0.3, 1.1, 2.0] {
        let [mine, theirs] = [
            run.observe(t).unwrap().a.values,
            expected.observe(t).unwrap().a.values,
        ];
        for (mine, theirs) in mine.iter().zip(&theirs) {
            assert!(
                (mine - theirs).abs() < 100.0 * limit,
                "{t} s: {mine} {theirs}"
            );
        }
        let [mine, theirs] = [
            run.at(t).unwrap().q.values,
            expected.at(t).unwrap().q.values,
        ];
        for (mine, theirs) in mine.iter().zip(&theirs) {
            assert!((mine - theirs).abs() < limit, "{t} s: {mine} {theirs}");
        }
        let mine = run.observe(t).unwrap().multipliers;
        let theirs = expected.observe(t).unwrap().multipliers;
        assert_eq!(mine.len(), theirs.len());
        for (mine, theirs) in mine.iter().zip(&theirs) {
            assert!(
                (mine - theirs).abs() < 1000.0 * limit,
                "{t} s: {mine} {theirs}"
            );
        }
    }
}

#[test]
fn a_further_force_is_as_one_of_the_description() {
    agree(
        FREE,
        "forces { air { on: a, value: -c*der(a)*abs(der(a)) }, drive { on: b, value: d*sin(w*t) } }",
        |t, _, v, _, force| {
            let rate = v.get("a").unwrap();
            force.set("a", -0.3 * rate * rate.abs()).unwrap();
            force.set("b", 0.5 * (4.0 * t).sin()).unwrap();
        },
    );
}

/// A force on the bob and one on the slider.
const PULL: &str = "forces { pull { on: y, value: F - c*der(y) }, push { on: z, value: H } }";

fn pull(_: f64, _: &Named, v: &Named, _: &Named, force: &mut Named) {
    force.set("y", 5.0 - 2.0 * v.get("y").unwrap()).unwrap();
    force.set("z", 3.0).unwrap();
}

#[test]
fn constraints_take_up_their_part_of_a_further_force() {
    agree(HELD, PULL, pull);
}

#[test]
fn work_of_constraints_that_move_is_counted_once() {
    agree(MOVED, PULL, pull);
}

#[test]
fn friction_at_guides_takes_no_further_force() {
    let text = include_str!("../../machines/block_on_incline.machine");
    let block = InterpretedMachine::from_text(text).build().unwrap();
    let error = Adapted::new(block, |_, _, _, _, _| ()).unwrap_err();
    assert_eq!(error, HasFriction);
    assert!(Error::from(error).to_string().contains("friction"));
}

/// A system that implements only the required methods.
#[derive(Clone)]
struct Plain;

impl System for Plain {
    type Vector = [f64; 1];
    type Matrix = [f64; 1];
    type Coordinates = [f64; 1];
    type Inputs = ();
    type Outputs = ();

    fn coordinates(&self) -> impl ExactSizeIterator<Item = Quantity<'_>> {
        [Quantity::new("x", "m")].into_iter()
    }

    fn to_coordinates(&self, vector: &[f64; 1]) -> [f64; 1] {
        *vector
    }

    fn to_vector(&self, coordinates: &[f64; 1]) -> [f64; 1] {
        *coordinates
    }

    fn accelerations(
        &self,
        _: f64,
        q: &[f64; 1],
        _: &[f64; 1],
        (): &(),
        a: &mut [f64; 1],
    ) -> Result<(), lagrangian::Singular> {
        a[0] = -q[0];
        Ok(())
    }

    fn default_inputs(&self) {}
    fn outputs(&self, _: f64, _: &[f64; 1], _: &[f64; 1], _: &[f64; 1], (): &()) {}
}

impl Machine for Plain {
    type System = Self;

    fn name(&self) -> &str {
        "Plain"
    }

    fn parameters(&self) -> impl ExactSizeIterator<Item = (Quantity<'_>, f64)> {
        core::iter::empty()
    }

    fn prepare(&self) -> Self {
        Self
    }

    fn start(&self) -> State<[f64; 1]> {
        State {
            t: 0.0,
            q: [1.0],
            v: [0.0],
        }
    }
}

#[test]
fn what_a_system_does_not_say_is_not_known() {
    let run = Simulation::new(&Plain)
        .until(1.0)
        .run(Plain.start())
        .unwrap();
    assert!((run.end().q[0] - 1.0_f64.cos()).abs() < 1e-7);
    let seen = run.observe(0.5).unwrap();
    assert!(seen.kinetic_energy.is_nan() && seen.potential_energy.is_nan());
    let error = Simulation::new(&Plain).until(1.0).energy_balance(true);
    let error = error.run(Plain.start()).unwrap_err();
    assert_eq!(error, Error::EnergiesUnknown { t: 0.0 });
    // Without a mass matrix the effect of an additional force is not defined.
    let pushed = Adapted::new(Plain, |_, _, _, _, force: &mut [f64; 1]| force[0] = 1.0).unwrap();
    let error = Simulation::new(&pushed)
        .until(1.0)
        .run(pushed.start())
        .unwrap_err();
    assert!(matches!(error, Error::SingularMassMatrix { .. }), "{error}");
    // The default implementation is f = Q − h, from whichever of these the system provides.
    let mut forces = vec![0.0];
    AsList(oscillator()).forces(0.0, &vec![1.0], &vec![0.0], &(), &mut forces);
    assert!(forces[0].is_nan() || forces[0] == 0.0);
}

#[test]
fn parameters_are_set_by_name() {
    let mut chain = lagrangian_machines::SpringMassTrain::default();
    let names: Vec<String> = chain.parameters().map(|(of, _)| of.name.into()).collect();
    for (index, name) in names.iter().enumerate() {
        let value = 1.5 + index as f64;
        chain.set(name, value).unwrap();
        assert_eq!(chain.get(name), Ok(value));
    }
    // Each parameter has its own value, so no name wrote to another's parameter.
    for (index, (_, value)) in chain.parameters().enumerate() {
        assert_eq!(value, 1.5 + index as f64);
    }
    let unknown = chain.set("Nonsense", 1.0).unwrap_err();
    assert_eq!((unknown.near, unknown.known), (None, names));
    // A parameter that a machine by hand does not list cannot be set.
    let error = Error::from(Plain.set("p", 1.0).unwrap_err());
    assert_eq!(
        error.to_string(),
        "there is no `p`; nothing can be set by name"
    );
}

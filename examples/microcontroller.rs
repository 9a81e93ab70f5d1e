//! How does it run on a microcontroller? A model in the firmware, without an allocator or an operating system; there the
//! dependency has `default-features = false, features = ["macros"]`.

lagrangian::machine! {
    /// A motor with a flywheel on a compliant shaft.
    machine Drive in plane {
        parameters { motor: kg*m^2 = 0.01, wheel: kg*m^2 = 0.05, stiffness: N*m = 20, loss: N*m*s = 0.05 }
        coordinates { phi: rad, psi: rad }
        inputs { torque: N*m }
        bodies {
            rotor { mass: 1, inertia: motor, at: ground.origin, angle: phi },
            flywheel { mass: 1, inertia: wheel, at: ground.origin, angle: psi },
        }
        potentials { shaft: 1/2*stiffness*(phi - psi)^2 }
        dissipations { shaft: 1/2*loss*(der(phi) - der(psi))^2 }
        forces { drive { on: phi, value: torque } }
    }
}

/// The code in the firmware: it uses only `core` and the library, and has a fixed size.
pub mod firmware {
    use super::{Drive, drive};
    use lagrangian::{ControlledStepper, Method, StepError, Stepper};

    /// The model, and the number of milliseconds that it has run.
    pub struct Model(ControlledStepper<drive::Prepared>, u32);

    impl Model {
        /// Starts at rest.
        pub fn new(machine: &Drive) -> Result<Self, StepError> {
            let stepper = Stepper::builder(machine.prepare()).method(Method::BS32);
            Ok(Self(stepper.tolerance(1e-5).start(machine.start())?, 0))
        }

        /// Advances by a millisecond with this torque of the motor, and returns the twist of the shaft, in rad.
        pub fn tick(&mut self, torque: f64) -> Result<f64, StepError> {
            let Self(stepper, ticks) = self;
            *ticks += 1;
            stepper.set_inputs(drive::Inputs { torque });
            stepper.advance_to(f64::from(*ticks) * 1e-3)?;
            let [phi, psi] = *stepper.q();
            Ok(phi - psi)
        }
    }
}

/// Prints the twist under a steady torque, and the size of the model.
pub fn main() -> Result<(), lagrangian::StepError> {
    let mut model = firmware::Model::new(&Drive::default())?;
    let twist = (0..2000).try_fold(0.0, |_, _| model.tick(1.0))?;
    println!("{twist:.5} rad, in {} bytes", size_of_val(&model));
    Ok(())
}

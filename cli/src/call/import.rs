//! Arguments of `import`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::arguments::Arguments;

/// Arguments of `import`.
#[derive(Debug, Args)]
pub struct Import {
    /// The robot: a URDF file with the ending `.urdf`, or a MuJoCo model with the ending `.xml` or `.mjcf`.
    #[arg(value_name = "ROBOT")]
    pub path: PathBuf,
    /// Write the spec to a file instead of standard output.
    #[arg(long, value_name = "FILE.machine")]
    pub out: Option<PathBuf>,
    /// Whether the root link is fixed to the ground or moves with six coordinates.
    #[arg(long, value_enum, default_value_t = Base::Fixed)]
    pub base: Base,
    /// The angles of spherical and floating joints, named after their rotation axes, or a quaternion, which is singular nowhere; by
    /// default xyz for spherical joints and zyx for floating ones.
    #[arg(long, value_enum)]
    pub ball: Option<Ball>,
    /// The treatment of Coulomb friction, which is rejected if this option is not given: `none` leaves it out, `smooth=1e-3` makes it
    /// smooth below that rate, in rad/s or m/s.
    #[arg(long, value_name = "none|smooth=RATE", value_parser = friction)]
    pub friction: Option<Friction>,
    /// The treatment of joint limits: they are written as comments, a run reports when it leaves them, or they stop the joint.
    #[arg(long, value_enum, default_value_t = Limits::None)]
    pub limits: Limits,
    /// Leave out joints that move no mass, together with everything attached to them.
    #[arg(long)]
    pub drop_massless: bool,
    /// Leave out these elements and attributes, which are unknown or may change the motion.
    #[arg(long, value_name = "NAME,…", value_delimiter = ',')]
    pub ignore: Vec<String>,
    /// Print the result as one JSON document on standard output, and nothing else there.
    #[arg(long)]
    pub json: bool,
}

impl Arguments for Import {
    fn json(&self) -> bool {
        self.json
    }
}

/// What the root of a robot does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Base {
    /// It is fixed to the ground.
    Fixed,
    /// It moves with six coordinates.
    Floating,
}

/// What turns: three angles, by the axes about which they turn, or four numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Ball {
    /// About x, y and z: Cardan angles.
    Xyz,
    /// Yaw, pitch and roll.
    Zyx,
    /// Precession, nutation and spin: Euler's angles.
    Zxz,
    /// A quaternion, which is singular nowhere.
    Quaternion,
}

/// The treatment of Coulomb friction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Friction {
    /// It is left out.
    None,
    /// It is smooth below a rate.
    Smooth(f64),
}

fn friction(text: &str) -> Result<Friction, String> {
    let rate = text.strip_prefix("smooth=").map(str::parse::<f64>);
    match (text, rate) {
        ("none", _) => Ok(Friction::None),
        (_, Some(Ok(rate))) if rate.is_normal() && rate > 0.0 => Ok(Friction::Smooth(rate)),
        _ => Err("expected `none`, or `smooth=` and a rate above 0, as in `smooth=1e-3`".into()),
    }
}

/// What becomes of the limits of joints.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Limits {
    /// They are written as comments.
    None,
    /// A run reports when it leaves them.
    Assume,
    /// Stops: unilateral contacts at both ends.
    Stop,
}

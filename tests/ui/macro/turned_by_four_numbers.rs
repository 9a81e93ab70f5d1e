// The four numbers that turn a frame are coordinates of their own, and only their ratios mean anything.
lagrangian::machine! {
    machine Halves in space {
        coordinates { phi: rad }
        frames { body = ground.turn(cos(phi/2), 0, 0, sin(phi/2)) }
        bodies { body { mass: 2*kg, inertia: (1, 2, 3)*kg*m^2, frame: body } }
        gravity none;
    }
}
lagrangian::machine! {
    machine Sprung in space {
        parameters { m: kg = 2, A: kg*m^2 = 1, k: J = 1 }
        coordinates { e[0]: 1 = 1, e[1..3]: 1 }
        frames { body = ground.turn(e[0], e[1], e[2], e[3]) }
        bodies { body { mass: m, inertia: (A, A, A), frame: body } }
        gravity none;
        potentials { spring: k*e[1]^2 }
    }
}

fn main() {
    let _ = (Halves::default(), Sprung::default());
}

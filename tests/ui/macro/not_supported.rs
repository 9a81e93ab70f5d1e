lagrangian::machine! {
    machine Bead in space {
        coordinates { x: m, y: m, z: m }
        bodies { bead { mass: 1, at: (x, y, z) } }
        contacts { stop { gap: x, slip: (der(y), der(z)), restitution: 0.5, friction: 0.1, law: stronge } }
    }
}

fn main() {
    let _ = Bead::default();
}

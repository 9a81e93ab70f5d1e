lagrangian::machine! {
    machine Bead in plane {
        coordinates { x: m, y: m }
        bodies { bead { mass: 1, at: (x, y) } }
        contacts { stop { gap: x, slip: der(y), restitution: 0.5, friction: 0.1 } }
    }
}

fn main() {
    let _ = Bead::default();
}

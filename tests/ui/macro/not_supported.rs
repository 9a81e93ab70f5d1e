lagrangian::machine! {
    machine Bead in plane {
        coordinates { x: m, y: m }
        bodies { bead { mass: 1, at: (x, y) } }
        sliding { table { body: bead, on: ground, direction: (1, 0), friction: 0.1 } }
    }
}

fn main() {
    let _ = Bead::default();
}

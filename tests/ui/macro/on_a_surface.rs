// What slides on a surface is held to it, and has no derivatives.
lagrangian::machine! {
    machine Loose in space {
        parameters { m: kg = 1, mu: 1 = 0.2, g: m/s^2 = 9.81 }
        coordinates { x: m, y: m, h: m = 1 }
        bodies { puck { mass: m, at: (x, y, h) } }
        gravity (0, 0, -g);
        sliding { slot { body: puck, on: ground, normal: (0, 0, 1), friction: mu } }
    }
}
lagrangian::machine! {
    machine Derived in space {
        parameters { m: kg = 1, mu: 1 = 0.2, g: m/s^2 = 9.81 }
        coordinates { x: m, y: m }
        bodies { puck { mass: m, at: (x, y, 0) } }
        gravity (0, 0, -g);
        sliding { slot { body: puck, on: ground, normal: (0, 0, 1), friction: mu } }
        derivatives { coordinates }
    }
}

fn main() {
    let _ = (Loose::default(), Derived::default());
}

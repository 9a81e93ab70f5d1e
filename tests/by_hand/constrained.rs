//! Small machines with constraints whose equations fit into a few lines.

use lagrangian::{
    Assumption, Constraint, Machine, Quantity, Singular, State, System, constraint_workspace,
};

/// A machine of `N` coordinates and `M` constraints, given by its functions. `p` is its only
/// parameter. The mass matrix has `NN` = `N²` entries and is diagonal.
#[derive(Clone, Copy, Debug)]
pub struct Constrained<const N: usize, const M: usize, const NN: usize> {
    pub coordinates: [(&'static str, &'static str); N],
    pub constraints: [(&'static str, bool); M],
    pub p: f64,
    pub start: ([f64; N], [f64; N]),
    pub mass: [f64; N],
    /// Forces `f` at `(t, q, v, p)`.
    pub forces: fn(f64, &[f64; N], &[f64; N], f64) -> [f64; N],
    /// `g` at `(t, q, p)`.
    pub positions: fn(f64, &[f64; N], f64) -> [f64; M],
    /// `G` at `(t, q, p)`.
    pub matrix: fn(f64, &[f64; N], f64) -> [[f64; N]; M],
    /// `∂g/∂t` at `(t, q, p)`.
    pub by_time: fn(f64, &[f64; N], f64) -> [f64; M],
    /// `γ` at `(t, q, v, p)`.
    pub constraint_bias: fn(f64, &[f64; N], &[f64; N], f64) -> [f64; M],
    /// `V` at `(q, p)`.
    pub potential_energy: fn(&[f64; N], f64) -> f64,
    /// Whether the workspace is an array on the stack instead of being allocated.
    pub on_stack: bool,
}

impl<const N: usize, const M: usize, const NN: usize> Constrained<N, M, NN> {
    /// Solves `M a − Gᵀ λ = f`, `G a = γ` for accelerations and multipliers, by
    /// elimination without pivoting.
    fn solve(&self, t: f64, q: &[f64; N], v: &[f64; N]) -> Result<([f64; N], [f64; M]), Singular> {
        let f = (self.forces)(t, q, v, self.p);
        let g = (self.matrix)(t, q, self.p);
        let mut rest = (self.constraint_bias)(t, q, v, self.p);
        // (G M⁻¹ Gᵀ) λ = γ − G M⁻¹ f
        let mut schur = [[0.0; M]; M];
        let mut scale = [0.0; M];
        for i in 0..M {
            for k in 0..N {
                rest[i] -= g[i][k] * f[k] / self.mass[k];
            }
            for j in 0..M {
                schur[i][j] = (0..N).map(|k| g[i][k] * g[j][k] / self.mass[k]).sum();
            }
            scale[i] = schur[i][i];
        }
        for i in 0..M {
            if schur[i][i] <= 16.0 * f64::EPSILON * scale[i] {
                return Err(Singular::constraint(i, schur[i][i], scale[i]));
            }
            for j in i + 1..M {
                let factor = schur[j][i] / schur[i][i];
                let above = schur[i];
                for (entry, above) in schur[j].iter_mut().zip(above).skip(i) {
                    *entry -= factor * above;
                }
                rest[j] -= factor * rest[i];
            }
        }
        let mut multipliers = [0.0; M];
        for i in (0..M).rev() {
            let known: f64 = (i + 1..M).map(|k| schur[i][k] * multipliers[k]).sum();
            multipliers[i] = (rest[i] - known) / schur[i][i];
        }
        let a = core::array::from_fn(|k| {
            let reaction: f64 = (0..M).map(|i| g[i][k] * multipliers[i]).sum();
            (f[k] + reaction) / self.mass[k]
        });
        Ok((a, multipliers))
    }

    pub fn start(&self) -> State<[f64; N]> {
        State {
            t: 0.0,
            q: self.start.0,
            v: self.start.1,
        }
    }
}

impl<const N: usize, const M: usize, const NN: usize> Machine for Constrained<N, M, NN> {
    type System = Self;

    fn name(&self) -> &str {
        "Constrained"
    }

    fn parameters(&self) -> impl ExactSizeIterator<Item = (Quantity<'_>, f64)> {
        let p = Quantity {
            name: "p",
            unit: "1",
        };
        [(p, self.p)].into_iter()
    }

    fn prepare(&self) -> Self {
        *self
    }

    fn start(&self) -> State<[f64; N]> {
        Constrained::start(self)
    }
}

impl<const N: usize, const M: usize, const NN: usize> System for Constrained<N, M, NN> {
    type Vector = [f64; N];
    type Matrix = [f64; NN];
    type Coordinates = [f64; N];
    type Inputs = ();
    type Outputs = ();
    // This compiles out all code that handles contacts.
    const MAY_SLIDE: bool = false;
    const MAY_COLLIDE: bool = false;

    fn coordinates(&self) -> impl ExactSizeIterator<Item = Quantity<'_>> {
        let named = |(name, unit): &(&'static str, &'static str)| Quantity { name, unit };
        self.coordinates.each_ref().map(named).into_iter()
    }

    fn to_coordinates(&self, vector: &[f64; N]) -> [f64; N] {
        *vector
    }

    fn to_vector(&self, coordinates: &[f64; N]) -> [f64; N] {
        *coordinates
    }

    fn accelerations(
        &self,
        t: f64,
        q: &[f64; N],
        v: &[f64; N],
        (): &(),
        a: &mut [f64; N],
    ) -> Result<(), Singular> {
        *a = self.solve(t, q, v)?.0;
        Ok(())
    }

    fn mass_matrix(&self, _: f64, _: &[f64; N], matrix: &mut [f64; NN]) {
        matrix.fill(0.0);
        for (i, mass) in self.mass.iter().enumerate() {
            matrix[i * N + i] = *mass;
        }
    }

    fn bias(&self, _: f64, _: &[f64; N], _: &[f64; N], bias: &mut [f64; N]) {
        bias.fill(0.0);
    }

    fn applied(&self, t: f64, q: &[f64; N], v: &[f64; N], u: &(), applied: &mut [f64; N]) {
        self.forces(t, q, v, u, applied);
    }

    fn forces(&self, t: f64, q: &[f64; N], v: &[f64; N], (): &(), forces: &mut [f64; N]) {
        *forces = (self.forces)(t, q, v, self.p);
    }

    fn kinetic_energy(&self, _: f64, _: &[f64; N], v: &[f64; N]) -> f64 {
        (0..N).map(|k| 0.5 * self.mass[k] * v[k] * v[k]).sum()
    }

    fn potential_energy(&self, _: f64, q: &[f64; N], (): &()) -> f64 {
        (self.potential_energy)(q, self.p)
    }

    fn dissipation(&self, _: f64, _: &[f64; N], _: &[f64; N], (): &()) -> f64 {
        0.0
    }

    /// `vᵀ (M a − f)`: all forces have a potential, so the remaining work is that of the
    /// reactions of moving constraints.
    fn work_rate(&self, t: f64, q: &[f64; N], v: &[f64; N], a: &[f64; N], (): &()) -> f64 {
        let f = (self.forces)(t, q, v, self.p);
        (0..N).map(|k| v[k] * (self.mass[k] * a[k] - f[k])).sum()
    }

    fn dissipation_rate(&self, _: f64, _: &[f64; N], _: &[f64; N], (): &()) -> f64 {
        0.0
    }

    fn default_inputs(&self) {}

    fn input_values(&self, (): &()) -> impl ExactSizeIterator<Item = (Quantity<'_>, f64)> {
        core::iter::empty()
    }

    fn outputs(&self, _: f64, _: &[f64; N], _: &[f64; N], _: &[f64; N], (): &()) {}

    fn output_values(&self, (): &()) -> impl ExactSizeIterator<Item = (Quantity<'_>, f64)> {
        core::iter::empty()
    }

    fn assumptions(
        &self,
        _: f64,
        _: &[f64; N],
        _: &[f64; N],
        (): &(),
    ) -> impl ExactSizeIterator<Item = Assumption<'_>> {
        core::iter::empty()
    }

    fn constraints(&self) -> impl ExactSizeIterator<Item = Constraint<'_>> {
        self.constraints
            .iter()
            .map(|&(name, holonomic)| Constraint {
                name,
                unit: "1",
                multiplier_unit: "1",
                holonomic,
            })
    }

    fn constraint_positions(&self, t: f64, q: &[f64; N], residuals: &mut [f64]) {
        residuals.copy_from_slice(&(self.positions)(t, q, self.p));
    }

    fn constraint_rates(&self, t: f64, q: &[f64; N], v: &[f64; N], residuals: &mut [f64]) {
        residuals.copy_from_slice(&(self.by_time)(t, q, self.p));
        for (rate, row) in residuals.iter_mut().zip((self.matrix)(t, q, self.p)) {
            *rate += row.iter().zip(v).map(|(g, v)| g * v).sum::<f64>();
        }
    }

    fn constraint_matrix(&self, t: f64, q: &[f64; N], matrix: &mut [f64]) {
        matrix.copy_from_slice((self.matrix)(t, q, self.p).as_flattened());
    }

    fn constraint_bias(&self, t: f64, q: &[f64; N], v: &[f64; N], bias: &mut [f64]) {
        bias.copy_from_slice(&(self.constraint_bias)(t, q, v, self.p));
    }

    fn multipliers(
        &self,
        t: f64,
        q: &[f64; N],
        v: &[f64; N],
        (): &(),
        multipliers: &mut [f64],
    ) -> Result<(), Singular> {
        multipliers.copy_from_slice(&self.solve(t, q, v)?.1);
        Ok(())
    }

    fn with_workspace<R>(&self, length: usize, work: impl FnOnce(Option<&mut [f64]>) -> R) -> R {
        assert!(length <= constraint_workspace(N, M));
        let mut values = [0.0; 512];
        work(self.on_stack.then(|| &mut values[..length]))
    }
}

const METRES: [(&str, &str); 4] = [("x1", "m"), ("y1", "m"), ("x2", "m"), ("y2", "m")];

/// A particle of 1 kg on a circle of radius 1 m under 9.81 m/s², released at rest from `(-1, 0)`. The
/// circle is stated `M` times, the k-th time multiplied by k: `k (x² + y² − 1)/2 = 0`.
pub fn circle<const M: usize>() -> Constrained<2, M, 4> {
    Constrained {
        coordinates: [METRES[0], METRES[1]],
        constraints: core::array::from_fn(|k| (["rod", "again", "more"][k], true)),
        p: 9.81,
        start: ([-1.0, 0.0], [0.0, 0.0]),
        mass: [1.0; 2],
        forces: |_, _, _, g| [0.0, -g],
        positions: |_, [x, y], _| {
            core::array::from_fn(|k| (k + 1) as f64 * 0.5 * (x * x + y * y - 1.0))
        },
        matrix: |_, [x, y], _| core::array::from_fn(|k| [x, y].map(|x| (k + 1) as f64 * x)),
        by_time: |_, _, _| [0.0; M],
        constraint_bias: |_, _, [vx, vy], _| {
            core::array::from_fn(|k| -((k + 1) as f64) * (vx * vx + vy * vy))
        },
        potential_energy: |[_, y], g| g * y,
        on_stack: true,
    }
}

/// A double pendulum as two particles of 1 kg; its rods, each 1 m long, are the constraints.
pub fn double_pendulum(theta: [f64; 2]) -> Constrained<4, 2, 16> {
    let [(s1, c1), (s2, c2)] = theta.map(f64::sin_cos);
    Constrained {
        coordinates: METRES,
        constraints: [("upper", true), ("lower", true)],
        p: 9.81,
        start: ([s1, -c1, s1 + s2, -c1 - c2], [0.0; 4]),
        mass: [1.0; 4],
        forces: |_, _, _, g| [0.0, -g, 0.0, -g],
        positions: |_, [x1, y1, x2, y2], _| {
            let (dx, dy) = (x2 - x1, y2 - y1);
            [x1 * x1 + y1 * y1 - 1.0, dx * dx + dy * dy - 1.0]
        },
        matrix: |_, [x1, y1, x2, y2], _| {
            let (dx, dy) = (2.0 * (x2 - x1), 2.0 * (y2 - y1));
            [[2.0 * x1, 2.0 * y1, 0.0, 0.0], [-dx, -dy, dx, dy]]
        },
        by_time: |_, _, _| [0.0; 2],
        constraint_bias: |_, _, [x1, y1, x2, y2], _| {
            let (dx, dy) = (x2 - x1, y2 - y1);
            [-2.0 * (x1 * x1 + y1 * y1), -2.0 * (dx * dx + dy * dy)]
        },
        potential_energy: |q, g| g * (q[1] + q[3]),
        on_stack: true,
    }
}

/// Chaplygin's sleigh: 1 kg and 0.05 kg m², with its edge 0.3 m behind the mass centre.
pub fn sleigh() -> Constrained<3, 1, 9> {
    const A: f64 = 0.3;
    Constrained {
        coordinates: [("x", "m"), ("y", "m"), ("phi", "rad")],
        constraints: [("edge", false)],
        p: A,
        // 0.4 m/s ahead, turning about the edge at 3 rad/s.
        start: ([0.0; 3], [0.4, A * 3.0, 3.0]),
        mass: [1.0, 1.0, 0.05],
        forces: |_, _, _, _| [0.0; 3],
        positions: |_, _, _| [0.0],
        matrix: |_, [_, _, phi], a| [[-phi.sin(), phi.cos(), -a]],
        by_time: |_, _, _| [0.0],
        constraint_bias: |_, [_, _, phi], [vx, vy, omega], _| {
            [omega * (phi.cos() * vx + phi.sin() * vy)]
        },
        potential_energy: |_, _| 0.0,
        on_stack: true,
    }
}

/// A pendulum of 1 kg under 9.81 m/s² whose rod changes its length, `l = 1 + 0.1 sin 2t`. It starts
/// at 1 rad with no velocity but that of the rod's change of length.
pub fn winch() -> Constrained<2, 1, 4> {
    let (s, c) = 1.0_f64.sin_cos();
    Constrained {
        coordinates: [METRES[0], METRES[1]],
        constraints: [("rope", true)],
        p: 9.81,
        start: ([s, -c], [0.2 * s, -0.2 * c]),
        mass: [1.0; 2],
        forces: |_, _, _, g| [0.0, -g],
        positions: |t, [x, y], _| [x * x + y * y - rope(t)[0] * rope(t)[0]],
        matrix: |_, [x, y], _| [[2.0 * x, 2.0 * y]],
        by_time: |t, _, _| [-2.0 * rope(t)[0] * rope(t)[1]],
        constraint_bias: |t, _, [vx, vy], _| {
            let [l, dl, ddl] = rope(t);
            [2.0 * (dl * dl + l * ddl) - 2.0 * (vx * vx + vy * vy)]
        },
        potential_energy: |[_, y], g| g * y,
        on_stack: true,
    }
}

/// Length of the winch's rope and its first two derivatives.
pub fn rope(t: f64) -> [f64; 3] {
    let (s, c) = (2.0 * t).sin_cos();
    [1.0 + 0.1 * s, 0.2 * c, -0.4 * s]
}

/// A bead of 1 kg on a straight wire through the origin that turns at `p` rad/s; it starts 1 m out,
/// at rest on the wire.
pub fn bead() -> Constrained<2, 1, 4> {
    Constrained {
        coordinates: [METRES[0], METRES[1]],
        constraints: [("wire", true)],
        p: 2.0,
        start: ([1.0, 0.0], [0.0, 2.0]),
        mass: [1.0; 2],
        forces: |_, _, _, _| [0.0; 2],
        positions: |t, [x, y], w| [y * (w * t).cos() - x * (w * t).sin()],
        matrix: |t, _, w| [[-(w * t).sin(), (w * t).cos()]],
        by_time: |t, [x, y], w| [-w * (y * (w * t).sin() + x * (w * t).cos())],
        constraint_bias: |t, [x, y], [vx, vy], w| {
            let (s, c) = (w * t).sin_cos();
            [2.0 * w * (vy * s + vx * c) + w * w * (y * c - x * s)]
        },
        potential_energy: |_, _| 0.0,
        on_stack: true,
    }
}

/// Two equal pendulums of 1 m, hung 1 m apart, with a rod of 1 m between their bobs. The rod
/// therefore stays level, which the last constraint states redundantly.
pub fn parallelogram(theta: f64) -> Constrained<4, 4, 16> {
    let (s, c) = theta.sin_cos();
    Constrained {
        coordinates: METRES,
        constraints: [
            ("left", true),
            ("right", true),
            ("rod", true),
            ("level", true),
        ],
        p: 9.81,
        start: ([s, -c, 1.0 + s, -c], [0.0; 4]),
        mass: [1.0; 4],
        forces: |_, _, _, g| [0.0, -g, 0.0, -g],
        positions: |_, [x1, y1, x2, y2], _| {
            let (dx, dy, x3) = (x2 - x1, y2 - y1, x2 - 1.0);
            [
                x1 * x1 + y1 * y1 - 1.0,
                x3 * x3 + y2 * y2 - 1.0,
                dx * dx + dy * dy - 1.0,
                dy,
            ]
        },
        matrix: |_, [x1, y1, x2, y2], _| {
            let (dx, dy) = (2.0 * (x2 - x1), 2.0 * (y2 - y1));
            [
                [2.0 * x1, 2.0 * y1, 0.0, 0.0],
                [0.0, 0.0, 2.0 * (x2 - 1.0), 2.0 * y2],
                [-dx, -dy, dx, dy],
                [0.0, -1.0, 0.0, 1.0],
            ]
        },
        by_time: |_, _, _| [0.0; 4],
        constraint_bias: |_, _, [x1, y1, x2, y2], _| {
            let (dx, dy) = (x2 - x1, y2 - y1);
            [
                -2.0 * (x1 * x1 + y1 * y1),
                -2.0 * (x2 * x2 + y2 * y2),
                -2.0 * (dx * dx + dy * dy),
                0.0,
            ]
        },
        potential_energy: |q, g| g * (q[1] + q[3]),
        on_stack: true,
    }
}

//! The specs in `benches/peers`, which are compared with other programs, describe what the tasks define: task T1 is tested
//! by its check values, task T2 by its equations in closed form, typed in here.

use std::f64::consts::PI;

use crate::support::library;
use lagrangian::interpreted::InterpretedMachine;
use lagrangian::{Machine, System};

/// The generator of the tasks' random states: G. L. Steele, D. Lea, C. H. Flood, *Fast splittable pseudorandom number
/// generators*, OOPSLA 2014, fig. 17.
struct SplitMix64(u64);

impl SplitMix64 {
    fn uniform(&mut self, lo: f64, hi: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        let z = z ^ (z >> 31);
        lo + (hi - lo) * ((z >> 11) as f64 / (1_u64 << 53) as f64)
    }
}

/// Interprets a spec of `benches/peers`.
fn spec(name: &str, constants: &[(&str, i64)]) -> InterpretedMachine {
    let path = format!(
        "{}/../benches/peers/{name}.machine",
        env!("CARGO_MANIFEST_DIR")
    );
    let text = std::fs::read_to_string(&path).expect("the spec");
    InterpretedMachine::new(library::compile(&path, &text, constants))
}

fn accelerations(machine: &InterpretedMachine, t: f64, q: &[f64], v: &[f64]) -> Vec<f64> {
    let system = machine.prepare();
    let mut a = vec![0.0; q.len()];
    let u = system.default_inputs();
    system
        .accelerations(t, &q.to_vec(), &v.to_vec(), &u, &mut a)
        .expect("not singular");
    a
}

/// The bound allows a few hundred operations on numbers of the size of the largest acceleration.
fn assert_close(found: &[f64], exact: &[f64], roundings: f64) {
    assert_eq!(found.len(), exact.len());
    let largest = exact.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
    for (found, exact) in found.iter().zip(exact) {
        let limit = roundings * f64::EPSILON * largest;
        assert!((found - exact).abs() <= limit, "{found}, not {exact}");
    }
}

#[test]
fn the_crusher_has_the_accelerations_of_task_t1() {
    let exact = [
        10.670920720781252,
        9.755377125111174,
        -11.703958033459951,
        -25.019176457107335,
        -1.7333601951634445,
        0.0,
        -3.776609960850123,
        113.20408211539767,
        0.0,
    ];
    let centre = [0.0, 0.0, 0.0, 0.15, 0.0, 0.0, 0.10, 0.0, 0.0];
    let half = [0.02, 0.02, 0.1, 0.03, PI, PI, 0.02, PI, PI];
    let half_rates = [0.5, 0.5, 1.0, 0.3, 5.0, 10.0, 0.3, 5.0, 10.0];
    let mut random = SplitMix64(20_260_001);
    let q: Vec<f64> = centre
        .iter()
        .zip(half)
        .map(|(c, h)| c + random.uniform(-h, h))
        .collect();
    let v: Vec<f64> = half_rates.iter().map(|h| random.uniform(-h, *h)).collect();
    let t = random.uniform(0.0, 10.0);
    for machine in [library::interpreted("crusher9"), spec("crusher_const", &[])] {
        assert_close(&accelerations(&machine, t, &q, &v), &exact, 300.0);
    }
}

/// `Σⱼ Aᵢⱼ cos(θᵢ − θⱼ) θ̈ⱼ = −Σⱼ Aᵢⱼ sin(θᵢ − θⱼ) θ̇ⱼ² − Bᵢ g sin θᵢ`
#[test]
fn the_chain_obeys_the_equations_of_task_t2() {
    for n in [2_usize, 4, 8] {
        // Each link is a uniform rod with a point mass at its end.
        let link = |i: usize| {
            let l = 0.4 + 0.05 * (i % 5) as f64;
            let (rod, point) = (0.8 + 0.1 * (i % 3) as f64, 0.5 + 0.1 * (i % 4) as f64);
            let m = rod + point;
            let c = (rod * l / 2.0 + point * l) / m;
            let inertia = rod * l * l / 12.0
                + rod * (c - l / 2.0) * (c - l / 2.0)
                + point * (l - c) * (l - c);
            [l, m, c, inertia]
        };
        let links: Vec<[f64; 4]> = (0..n).map(link).collect();
        let mut machine = spec("chain", &[("N", n as i64)]);
        for (i, numbers) in links.iter().enumerate() {
            for (name, number) in ["l", "m", "c", "I"].iter().zip(numbers) {
                let member = format!("{name}[{}]", i + 1);
                machine.set(&member, *number).expect("a parameter");
            }
        }
        let mut random = SplitMix64(20_260_100 + n as u64);
        let q: Vec<f64> = (0..n).map(|_| random.uniform(-PI, PI)).collect();
        let v: Vec<f64> = (0..n).map(|_| random.uniform(-3.0, 3.0)).collect();
        let a = accelerations(&machine, 0.0, &q, &v);

        let above = |i: usize| links[i + 1..].iter().map(|link| link[1]).sum::<f64>();
        for i in 0..n {
            let (mut left, mut size) = (0.0, 0.0);
            for j in 0..n {
                let (low, high) = (i.min(j), i.max(j));
                let [l, m, c, inertia] = links[high];
                let coupling = if i == j {
                    inertia + m * c * c + l * l * above(i)
                } else {
                    links[low][0] * (m * c + l * above(high))
                };
                let (sin, cos) = (q[i] - q[j]).sin_cos();
                let terms = [coupling * cos * a[j], coupling * sin * v[j] * v[j]];
                left += terms[0] + terms[1];
                size += coupling * (a[j].abs() + v[j] * v[j]);
            }
            let [l, m, c, _] = links[i];
            let weight = (m * c + l * above(i)) * 9.81;
            left += weight * q[i].sin();
            size += weight;
            // Twenty rounding units for each link on the way out and back, and those of this sum.
            let limit = 64.0 * n as f64 * f64::EPSILON * size;
            assert!(left.abs() <= limit, "N = {n}, row {i}: {left} of {size}");
        }
    }
}

//! The cost of a node: `cargo bench -p lagrangian-symbolic`.

use std::hint::black_box;
use std::time::Instant;

use lagrangian_symbolic::{Dag, Expr, Id, Stage, Symbol, Tangent, reverse};

fn main() {
    pairs();
    for n in [16, 64] {
        chain(n);
    }
}

/// Products and sums of two symbols, first as new nodes, then found again.
fn pairs() {
    let dag = Dag::new();
    let symbols: Vec<_> = (0..100)
        .map(|i| dag.symbol(&format!("x{i}"), Stage(3)))
        .collect();
    for what in ["new", "found"] {
        let (start, before) = (Instant::now(), dag.len());
        for &x in &symbols {
            for &y in &symbols {
                black_box(x * y);
                black_box(x - y);
            }
        }
        let each = start.elapsed().as_nanos() / 20_000;
        println!("x*y, x-y {what}: {each} ns ({} nodes)", dag.len() - before);
    }
}

/// M, h and the inverse dynamics of a chain of links in relative angles.
fn chain(n: usize) {
    let start = Instant::now();
    let dag = Dag::new();
    let row = |name: &str, stage| -> Vec<Expr<'_>> {
        (0..n)
            .map(|i| dag.symbol(&format!("{name}{i}"), stage))
            .collect()
    };
    let (m, l) = (row("m", Stage::PARAMETER), row("l", Stage::PARAMETER));
    let (q, v, a) = (row("q", Stage(3)), row("v", Stage(4)), row("a", Stage(6)));
    let (mut angle, mut x, mut y) = (dag.zero(), dag.zero(), dag.zero());
    let mut positions = Vec::new();
    for i in 0..n {
        angle = angle + q[i];
        (x, y) = (x + l[i] * angle.cos(), y + l[i] * angle.sin());
        positions.extend([(x, m[i]), (y, m[i])]);
    }
    let symbol = |e: &Expr<'_>| -> Symbol { e.as_symbol().expect("a symbol") };
    let coordinates: Vec<Symbol> = q.iter().map(symbol).collect();

    let rates = |rates: &[(&[Expr<'_>], &[Expr<'_>])]| -> Vec<(Symbol, Id)> {
        rates
            .iter()
            .flat_map(|(of, to)| of.iter().map(symbol).zip(to.iter().map(|e| e.id())))
            .collect()
    };
    let seeds_along = |list: Vec<(Symbol, Id)>| {
        let list: Vec<_> = list.into_iter().map(|(s, id)| (s, dag.expr(id))).collect();
        let mut d = Tangent::new(&dag, &list);
        let seed = |&(p, m)| {
            let velocity = d.of(p);
            (p, m * d.of(velocity))
        };
        positions.iter().map(seed).collect::<Vec<_>>()
    };
    let inverse = reverse(
        &dag,
        &seeds_along(rates(&[(&q, &v), (&v, &a)])),
        &coordinates,
    );
    let bias = reverse(&dag, &seeds_along(rates(&[(&q, &v)])), &coordinates);
    for j in 0..n {
        let mut d = Tangent::new(&dag, &[(coordinates[j], dag.one())]);
        let seeds: Vec<_> = positions.iter().map(|&(p, m)| (p, m * d.of(p))).collect();
        black_box(reverse(&dag, &seeds, &coordinates[j..]));
    }
    black_box((inverse, bias));
    let elapsed = start.elapsed();
    println!(
        "chain of {n} links, M, h and inverse dynamics: {:.1} ms, {} nodes, {} ns a node",
        elapsed.as_secs_f64() * 1e3,
        dag.len(),
        elapsed.as_nanos() / dag.len() as u128
    );
}

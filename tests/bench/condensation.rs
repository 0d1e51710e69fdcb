//! Cost of the reduction of a whole sparse matrix, in time and memory, and its gain.
//!
//! `cargo bench --bench condensation`. One thread. Peak memory is that of Linux.

#[allow(dead_code)]
#[path = "../common/mesh.rs"]
mod mesh;

use std::time::Instant;

use faer::linalg::solvers::Solve;
use faer::{Mat, Par, Side};
use mesh::{Block, Mesh, Pairs, Stiffness, steps};
use signorini::{FrictionLaw, LoadCase, Model, Monitor, Settings, Solution, Status};

fn main() {
    faer::set_global_parallelism(Par::Seq);
    println!("Sparse and dense condensation of the same matrix");
    for columns in [15, 22, 31] {
        compare(columns);
    }
    println!("\nA large bar");
    large(315, 129);
}

fn timed<T>(work: impl FnOnce() -> T) -> (f64, T) {
    let begin = Instant::now();
    let result = work();
    (begin.elapsed().as_secs_f64(), result)
}

/// The bar on the plane: half model 40 x 40, `columns` elements each way, the last `pairs` nodes of
/// the bottom line on the obstacle.
struct Bar {
    mesh: Mesh,
    block: Block,
    stiffness: Stiffness,
    fixed: Vec<usize>,
    pairs: Pairs,
}

impl Bar {
    fn new(columns: usize, pairs: usize) -> Bar {
        let mut mesh = Mesh::default();
        let lines = steps(0.0, 40.0, columns);
        let block = mesh.block(&lines, &lines, (13000.0, 0.2));
        let stiffness = mesh.stiffness();
        let fixed = block.column(columns).iter().map(|node| 2 * node).collect();
        let pairs = Pairs::on_obstacle(&block.row(0)[columns + 1 - pairs..], [0.0, -1.0]);
        Bar { mesh, block, stiffness, fixed, pairs }
    }

    fn model(&self) -> Model {
        self.stiffness.model(&self.fixed, &self.pairs).expect("a valid model")
    }

    fn load(&self, pressure: f64, side: f64) -> Vec<f64> {
        let mut load = vec![0.0; self.mesh.size()];
        self.mesh.traction(&self.block.row(self.block.rows), [0.0, -pressure], &mut load);
        self.mesh.traction(&self.block.column(0), [side, 0.0], &mut load);
        load
    }
}

fn solved(model: &Model, load: &[f64], start: Option<&[f64]>) -> Solution {
    let case = LoadCase {
        load,
        prescribed: None,
        gap: &vec![0.0; model.pairs()],
        law: FrictionLaw::Coulomb(&vec![0.5; model.pairs()]),
        reference_slip: None,
    };
    let settings = Settings::default();
    let monitor = &mut Monitor::new(&settings, None);
    let solution = model.solve(&case, &settings, start, monitor).expect("a valid case");
    assert_eq!(solution.status, Status::Solved, "{}", solution.message);
    solution
}

/// Schur complement by a dense Cholesky factorisation, in the host's components.
fn dense(bar: &Bar) -> Mat<f64> {
    let n = bar.stiffness.size;
    let mut place = vec![Some(0); n];
    bar.fixed.iter().for_each(|&dof| place[dof] = None);
    let contact: Vec<usize> =
        bar.pairs.slaves.iter().flat_map(|node| [2 * node, 2 * node + 1]).collect();
    let contact: Vec<usize> = contact.into_iter().filter(|&dof| place[dof].is_some()).collect();
    let mut is_contact = vec![false; n];
    contact.iter().for_each(|&dof| is_contact[dof] = true);
    let free = (0..n).filter(|&dof| place[dof].is_some() && !is_contact[dof]).collect::<Vec<_>>();
    let rest = contact.len();
    for (k, &dof) in free.iter().chain(&contact).enumerate() {
        place[dof] = Some(k);
    }
    let size = free.len() + rest;
    let mut matrix = Mat::<f64>::zeros(size, size);
    for (i, j, value) in bar.stiffness.entries() {
        if let (Some(i), Some(j)) = (place[i], place[j]) {
            matrix[(i, j)] = value;
            matrix[(j, i)] = value;
        }
    }
    let factor =
        matrix.submatrix(0, 0, free.len(), free.len()).llt(Side::Lower).expect("it is held");
    let coupling = matrix.submatrix(0, free.len(), free.len(), rest);
    let inner = factor.solve(coupling);
    matrix.submatrix(free.len(), free.len(), rest, rest) - coupling.transpose() * &inner
}

fn compare(columns: usize) {
    let bar = Bar::new(columns, columns + 1);
    let (mut sparse_time, mut dense_time) = (f64::INFINITY, f64::INFINITY);
    for _ in 0..5 {
        let (time, model) = timed(|| bar.model());
        sparse_time = sparse_time.min(time);
        let (time, schur) = timed(|| dense(&bar));
        dense_time = dense_time.min(time);
        // (n, t) = (-u_y, u_x): the first pair's normal stiffness.
        let (one, two) = (model.stiffness()[0], schur[(1, 1)]);
        assert!((one - two).abs() <= 1e-10 * two, "{one} and {two}");
    }
    println!(
        "{:5} degrees of freedom, {:3} pairs: sparse {:7.2} ms, dense {:7.2} ms",
        bar.mesh.size(),
        bar.pairs.count(),
        1e3 * sparse_time,
        1e3 * dense_time
    );
}

fn large(columns: usize, pairs: usize) {
    let bar = Bar::new(columns, pairs);
    println!("{} degrees of freedom, {pairs} pairs", bar.mesh.size());
    // Linux: the high-water mark begins anew.
    let reset = std::fs::write("/proc/self/clear_refs", "5").is_ok();
    let before = peak();
    let (reduction, model) = timed(|| bar.model());
    let after = peak();
    println!("reduction: {reduction:.2} s");
    match (before, after) {
        (Some(before), Some(after)) if reset => {
            println!(
                "peak memory: {after} MB, of which {before} MB are the host's mesh and matrix"
            );
            assert!(after < 1000, "the reduction must need less than 1 GB");
        }
        _ => println!("peak memory is not known on this system"),
    }
    let (first, _) = timed(|| solved(&model, &bar.load(5.0, 10.0), None));
    println!("first load case, with the reduction: {:.2} s", reduction + first);
    let (further, solution) = timed(|| solved(&model, &bar.load(5.0, 9.0), None));
    println!("a further one: {:.3} s, {} sweeps", further, solution.iterations);
    let load = bar.load(5.0, 9.0);
    let (time, u) = timed(|| model.recover(Some(&load), None, &solution.d).expect("displacements"));
    println!("displacements of the mesh: {time:.3} s, {} of them", u.len());
    let (block, sweeps) = timed(|| {
        let mut sweeps = 0;
        let mut start: Option<Vec<f64>> = None;
        for case in 0..100 {
            let load = bar.load(5.0, 0.1 * f64::from(case));
            let solution = solved(&model, &load, start.as_deref());
            sweeps += solution.iterations;
            start = Some(solution.d);
        }
        sweeps
    });
    println!("100 load cases, each from the one before: {block:.2} s, {sweeps} sweeps");
}

/// Peak resident memory in MB.
fn peak() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    Some(line.split_whitespace().nth(1)?.parse::<u64>().ok()? / 1000)
}

//! What the condensation of large models costs: CPU time and peak memory of `Model::sparse`.
//!
//! `cargo bench --bench large_rows -- bar block 26 33`: `bar` has 1000 x 50 nodes with all 1000 of its lower
//! line in contact, `block` 224 x 224 nodes with one line in contact; a number is the nodes along an edge of a
//! cube that is clamped above and in contact below. One thread. Times and peaks are those of Linux.

#[path = "../common/mod.rs"]
mod common;

use std::ops::ControlFlow;

use common::brick::{Brick, Support};
use common::mesh::{Mesh, Pairs, steps};
use signorini::{Model, Monitor, Progress, Settings};

fn main() {
    println!("case, unknowns, contact, CPU seconds, peak MB, of these the host's MB");
    let wanted: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with('-')).collect();
    let wanted = if wanted.is_empty() { vec!["block".into(), "bar".into()] } else { wanted };
    for case in &wanted {
        match case.as_str() {
            "bar" => plane(case, [999, 49]),
            "block" => plane(case, [223, 223]),
            edge => cube(case, edge.parse().expect("bar, block or a number of nodes")),
        }
    }
}

fn plane(case: &str, [columns, rows]: [usize; 2]) {
    let mut mesh = Mesh::default();
    let lines = [columns, rows].map(|count| steps(0.0, count as f64, count));
    let block = mesh.block(&lines[0], &lines[1], (13000.0, 0.2));
    let stiffness = mesh.stiffness();
    let fixed: Vec<usize> = block.row(rows).iter().flat_map(|n| [2 * n, 2 * n + 1]).collect();
    let pairs = Pairs::on_obstacle(&block.row(0), [0.0, -1.0]);
    measured(case, stiffness.size - fixed.len(), || {
        stiffness.model(&fixed, &pairs).expect("a valid model")
    });
}

fn cube(case: &str, edge: usize) {
    let brick = Brick::new([edge - 1; 3], [1.0; 3], Support::Clamped);
    let stiffness = brick.stiffness();
    let mut announced = 0;
    let mut progress = |now: &Progress| {
        announced = announced.max(now.memory);
        ControlFlow::Continue(())
    };
    measured(case, brick.size() - 3 * brick.pairs(), || {
        let monitor = &mut Monitor::new(&Settings::default(), Some(&mut progress));
        brick.model_within(&stiffness, None, monitor).expect("a valid model")
    });
    println!("    announced {} MB", announced / 1_000_000);
}

fn measured(case: &str, unknowns: usize, make: impl FnOnce() -> Model) {
    // Linux: the high-water mark begins anew.
    let _ = std::fs::write("/proc/self/clear_refs", "5");
    let (before, begin) = (peak(), cpu());
    let model = make();
    let (seconds, contact) = (cpu() - begin, model.dim() * model.pairs());
    println!("{case}, {unknowns}, {contact}, {seconds:.2}, {}, {before}", peak());
    // A number by which two versions can be compared.
    let largest = model.stiffness().iter().fold(0.0_f64, |most, k| most.max(k.abs()));
    let sum: f64 = model.stiffness().iter().map(|k| k * k).sum();
    println!("    largest {largest:.15e}, norm {:.15e}", sum.sqrt());
}

/// CPU seconds of this thread.
fn cpu() -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    let first = text.split_whitespace().next().and_then(|ns| ns.parse::<f64>().ok());
    first.unwrap_or(f64::NAN) / 1e9
}

/// Peak resident memory in MB; 0 where it is not known.
fn peak() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find(|line| line.starts_with("VmHWM:")).unwrap_or_default();
    line.split_whitespace().nth(1).and_then(|kb| kb.parse::<u64>().ok()).unwrap_or(0) / 1000
}

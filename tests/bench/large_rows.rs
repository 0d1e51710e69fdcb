//! Costs of large models: CPU time and peak memory of the reduction, of the first load case, of a further one,
//! and of a hundred further ones at once, each with its displacements.
//!
//! `cargo bench --bench large_rows -- bar block 26 33`: `bar` has 1000 x 50 nodes with all 1000 of its lower
//! line in contact, `block` 224 x 224 nodes with one line in contact, `square-N` N x N nodes with one line in
//! contact; a number is the nodes along an edge of a cube that is clamped above and in contact below, `26-67` such a
//! cube with only the 67 pairs in contact that are nearest to the middle of its face. The
//! clamped face presses, shears and tilts, differently in each load case; the obstacle is hollow, so that some
//! pairs open; friction .3. One thread. Times and peaks are those of Linux. `tests/bench/large.sh` makes a table of
//! the rows; lines with # are no rows. With `SIGNORINI_LARGE_MATRIX=FILE` the matrix is written for
//! `large_peers.c`, which says how.

#[path = "../common/mod.rs"]
mod common;
mod large_problem;

use std::ops::ControlFlow;
use std::path::Path;
use std::time::Instant;

use common::brick::{Brick, Support};
use common::mesh::{Mesh, Pairs, Stiffness, steps};
use signorini::reduce::SolvedCase;
use signorini::{
    FrictionLaw, LoadCase, Model, Monitor, Progress, Series, Settings, Solution, Starts, Status,
};

/// Load cases at once.
const MANY: usize = 100;

/// Load cases one by one in a series, from number 1 on.
const IN_SERIES: usize = 12;

fn main() {
    println!("case,dim,unknowns,contact_dofs,library,blas,step,cpu_s,peak_mb,eta,status");
    let wanted: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with('-')).collect();
    let wanted = if wanted.is_empty() { vec!["block".into(), "bar".into()] } else { wanted };
    for case in &wanted {
        match case.as_str() {
            "bar" => plane(case, [999, 49]),
            "block" => plane(case, [223, 223]),
            other => match other.strip_prefix("square-") {
                Some(edge) => plane(case, [number(edge) - 1; 2]),
                None => match other.split_once('-') {
                    Some((edge, pairs)) => cube(case, number(edge), number(pairs)),
                    None => cube(case, number(other), usize::MAX),
                },
            },
        }
    }
}

fn number(nodes: &str) -> usize {
    nodes.parse().expect("bar, block, square-NODES, NODES or NODES-PAIRS")
}

fn plane(case: &str, [columns, rows]: [usize; 2]) {
    let mut mesh = Mesh::default();
    let lines = [columns, rows].map(|count| steps(0.0, count as f64, count));
    let block = mesh.block(&lines[0], &lines[1], (13000.0, 0.2));
    let stiffness = mesh.stiffness();
    let fixed: Vec<usize> = block.row(rows).iter().flat_map(|n| [2 * n, 2 * n + 1]).collect();
    let contact: Vec<usize> = block.row(0).iter().flat_map(|n| [2 * n, 2 * n + 1]).collect();
    let pairs = Pairs::on_obstacle(&block.row(0), [0.0, -1.0]);
    let (length, height) = (columns as f64, rows as f64);
    let place = |node: usize| [mesh.nodes[node][0] / length - 0.5, 0.0];
    let study = Study {
        case,
        height,
        above: block.row(rows).into_iter().map(place).collect(),
        below: block.row(0).into_iter().map(place).collect(),
        unknowns: stiffness.size - fixed.len(),
        dim: 2,
    };
    study.write_problem(&stiffness, &fixed, &contact);
    study.run(|| stiffness.model(&fixed, &pairs).expect("a valid model"));
}

fn cube(case: &str, edge: usize, pairs: usize) {
    let mut brick = Brick::new([edge - 1; 3], [1.0; 3], Support::Clamped);
    if pairs < brick.pairs() {
        let from_middle = |node: &usize| brick.nodes[*node][0].hypot(brick.nodes[*node][1]);
        let mut contact = brick.contact.clone();
        contact.sort_by(|a, b| from_middle(a).total_cmp(&from_middle(b)));
        contact.truncate(pairs);
        (brick.contact, brick.tangents) = (contact, None);
    }
    let stiffness = brick.stiffness();
    let contact: Vec<usize> =
        brick.contact.iter().flat_map(|n| [0, 1, 2].map(|c| 3 * n + c)).collect();
    let place = |node: usize| [brick.nodes[node][0], brick.nodes[node][1]];
    let study = Study {
        case,
        height: 1.0,
        above: brick.top().map(place).collect(),
        below: brick.contact.iter().map(|&node| place(node)).collect(),
        unknowns: brick.size() - brick.fixed().len(),
        dim: 3,
    };
    study.write_problem(&stiffness, &brick.fixed(), &contact);
    let mut announced = 0;
    let mut progress = |now: &Progress| {
        announced = announced.max(now.memory);
        ControlFlow::Continue(())
    };
    study.run(|| {
        let monitor = &mut Monitor::new(&Settings::default(), Some(&mut progress));
        brick.model_within(&stiffness, None, monitor).expect("a valid model")
    });
    println!("# announced {} MB", announced / 1_000_000);
}

/// A body with its load cases. Places are along x and y, from -1/2 to 1/2.
struct Study<'a> {
    case: &'a str,
    height: f64,
    /// Where the nodes of the clamped face are.
    above: Vec<[f64; 2]>,
    /// Where the pairs are.
    below: Vec<[f64; 2]>,
    unknowns: usize,
    dim: usize,
}

/// The arrays of load cases.
struct Cases {
    load: Vec<f64>,
    prescribed: Vec<Vec<f64>>,
    gap: Vec<f64>,
    mu: Vec<f64>,
}

impl Cases {
    fn case(&self, k: usize) -> LoadCase<'_> {
        LoadCase {
            load: &self.load,
            prescribed: Some(&self.prescribed[k]),
            gap: &self.gap,
            law: FrictionLaw::Coulomb(&self.mu),
            reference_slip: None,
        }
    }

    fn solved<'a>(&'a self, k: usize, solution: &'a Solution) -> SolvedCase<'a> {
        let case = self.case(k);
        SolvedCase { load: Some(case.load), prescribed: case.prescribed, d: &solution.d }
    }
}

impl Study<'_> {
    /// Load cases on an obstacle whose lowest point is at `lowest` along x.
    fn cases(&self, model: &Model, lowest: f64) -> Cases {
        Cases {
            load: vec![0.0; model.host_size()],
            prescribed: (0..MANY + 2).map(|k| self.prescribed(k)).collect(),
            gap: self.gaps(lowest),
            mu: vec![0.3; model.pairs()],
        }
    }

    /// The motion of the clamped face in a case, node by node.
    fn prescribed(&self, k: usize) -> Vec<f64> {
        let unit = self.unit();
        let (share, angle) = (k as f64 / MANY as f64, 0.3 * k as f64);
        let motion = |place: &[f64; 2]| {
            let down = unit * (1.0 + 0.2 * share + 0.3 * angle.sin() * place[0]);
            let along = 0.4 * unit * angle.cos();
            match self.dim {
                2 => vec![along, -down],
                _ => vec![along, 0.1 * unit * share, -down],
            }
        };
        self.above.iter().flat_map(motion).collect()
    }

    /// Gaps of the hollow obstacle.
    fn gaps(&self, lowest: f64) -> Vec<f64> {
        let unit = 4.0 * self.unit();
        let hollow = |place: &[f64; 2]| unit * ((place[0] - lowest).powi(2) + place[1].powi(2));
        self.below.iter().map(hollow).collect()
    }

    fn unit(&self) -> f64 {
        1e-3 * self.height
    }

    /// Writes the first case for other libraries, if that is asked for.
    fn write_problem(&self, stiffness: &Stiffness, fixed: &[usize], contact: &[usize]) {
        if let Some(path) = std::env::var_os("SIGNORINI_LARGE_MATRIX") {
            let problem =
                (stiffness, (fixed, &self.prescribed(0)[..]), contact, &self.gaps(0.0)[..]);
            large_problem::write(Path::new(&path), problem);
        }
    }

    fn run(&self, make: impl FnOnce() -> Model) {
        // Linux: the high-water mark begins anew.
        let _ = std::fs::write("/proc/self/clear_refs", "5");
        let (before, begin) = (peak(), cpu());
        let model = make();
        let reduced = cpu() - begin;
        self.row(&model, "reduce", reduced, None);
        println!("# of the peak the host's own: {before} MB");
        // A number by which two versions can be compared.
        let largest = model.stiffness().iter().fold(0.0_f64, |most, k| most.max(k.abs()));
        let sum: f64 = model.stiffness().iter().map(|k| k * k).sum();
        println!("# largest {largest:.15e}, norm {:.15e}", sum.sqrt());

        let cases = self.cases(&model, 0.0);
        let first = reduced + self.one(&model, &cases, (0, "solve"), None);
        let further = self.one(&model, &cases, (1, "further"), None);
        self.without_friction(&model, &cases);
        let part =
            |seconds| format!("{:.2} % of the first with the reduction", 100.0 * seconds / first);
        println!("# a further case: {}", part(further));
        // Cases one by one, of which the first leaves something to the others.
        let mut series = model.series();
        let mut seconds: Vec<f64> = (1..IN_SERIES)
            .map(|k| self.one(&model, &cases, (k, "in series"), Some(&mut series)))
            .collect();
        seconds.remove(0);
        seconds.sort_by(f64::total_cmp);
        println!("# a further case in a series, the median: {}", part(seconds[seconds.len() / 2]));
        for starts in [Starts::Cold, Starts::Previous(None)] {
            let (solved, recovered) = many(&model, &cases, starts);
            let each = (solved + recovered) / MANY as f64;
            println!(
                "# {MANY} cases, {starts:?}: solved in {solved:.2} s, recovered in {recovered:.2} s, {each:.4} s \
                 each: {:.2} % of the first with the reduction",
                100.0 * each / first
            );
        }
        self.moving(&model);
        two_threads(&model, &cases);
        let (condensed, count) = (cpu(), 10);
        for k in 0..count {
            let case = cases.case(k);
            model.condensed_load(case.load, case.prescribed).expect("a valid load");
        }
        println!("# of a case by itself, the load: {:.4} s", (cpu() - condensed) / count as f64);
    }

    /// The first case without friction, as libraries for inequalities alone solve it.
    fn without_friction(&self, model: &Model, cases: &Cases) {
        let begin = cpu();
        let case = LoadCase { law: FrictionLaw::Frictionless, ..cases.case(0) };
        let settings = Settings::default();
        let found = model.solve(&case, &settings, None, &mut Monitor::new(&settings, None));
        let found = found.expect("a valid case");
        let u = model.recover(Some(case.load), case.prescribed, &found.d).expect("a solution");
        self.row(model, "without friction", cpu() - begin, Some(&found));
        let pressure: f64 = found.certificate.force.iter().step_by(self.dim).sum();
        let largest = u.iter().fold(0.0_f64, |most, u| most.max(u.abs()));
        println!(
            "# without friction: pressure {pressure:.12e}, largest displacement {largest:.12e}"
        );
    }

    /// Cases that press in turn at either end, by themselves and in a series.
    fn moving(&self, model: &Model) {
        let ends = [-0.45, 0.45].map(|lowest| self.cases(model, lowest));
        let all: Vec<_> = (0..IN_SERIES).map(|k| ends[k % 2].case(k)).collect();
        let settings = Settings::default();
        let begin = cpu();
        for case in &all {
            let monitor = &mut Monitor::new(&settings, None);
            let found = model.solve(case, &settings, None, monitor).expect("a valid case");
            assert_eq!(found.status, Status::Solved);
        }
        let alone = cpu();
        let mut series = model.series();
        for case in &all {
            let found = series.solve_cases(&[*case], &settings, Starts::Cold, None).remove(0);
            assert_eq!(found.expect("a valid case").status, Status::Solved);
        }
        println!(
            "# {IN_SERIES} cases at either end in turn: {:.3} s by themselves, {:.3} s in a series",
            alone - begin,
            cpu() - alone
        );
    }

    /// Solves and recovers a load case by itself, or as the next one of a series. Returns the seconds.
    fn one(
        &self,
        model: &Model,
        cases: &Cases,
        (k, step): (usize, &str),
        series: Option<&mut Series<'_>>,
    ) -> f64 {
        let begin = cpu();
        let (case, settings) = (cases.case(k), Settings::default());
        let monitor = &mut Monitor::new(&settings, None);
        let solution = match series {
            None => model.solve(&case, &settings, None, monitor),
            Some(series) => {
                let starts = Starts::Previous(None);
                series.solve_cases(&[case], &settings, starts, None).remove(0)
            }
        };
        let solution = solution.expect("a valid case");
        let u = model.recover(Some(case.load), case.prescribed, &solution.d);
        let seconds = cpu() - begin;
        assert_eq!(u.expect("a valid solution").len(), model.host_size());
        self.row(model, step, seconds, Some(&solution));
        let (method, iterations) = (solution.method, solution.iterations);
        println!("# {method:?}, {iterations} sweeps or systems, fallback {:?}", solution.fallback);
        seconds
    }

    fn row(&self, model: &Model, step: &str, seconds: f64, solution: Option<&Solution>) {
        let (dim, contact) = (model.dim(), model.dim() * model.pairs());
        let (case, unknowns, peak) = (self.case, self.unknowns, peak());
        let end = solution.map_or_else(
            || ",reduced".to_owned(),
            |found| format!("{:.1e},{:?}", found.certificate.eta, found.status),
        );
        println!(
            "{case},{dim},{unknowns},{contact},signorini,faer,{step},{seconds:.4},{peak},{end}"
        );
    }
}

/// A hundred load cases on one thread, and on two that have a half each: CPU seconds of the busier thread, which
/// are those of an idle machine, and seconds on the clock.
fn two_threads(model: &Model, cases: &Cases) {
    let all: Vec<_> = (2..MANY + 2).map(|k| cases.case(k)).collect();
    let solved = |cases: &[LoadCase<'_>]| {
        let begin = cpu();
        let found = model.solve_cases(cases, &Settings::default(), Starts::Cold, None);
        assert!(found.into_iter().all(|found| found.is_ok_and(|f| f.status == Status::Solved)));
        cpu() - begin
    };
    let begin = Instant::now();
    let (one, clock) = (solved(&all), begin.elapsed().as_secs_f64());
    let (first, second) = all.split_at(MANY / 2);
    let begin = Instant::now();
    let two = std::thread::scope(|scope| {
        let other = scope.spawn(|| solved(second));
        solved(first).max(other.join().expect("solved"))
    });
    println!(
        "# {MANY} cases: on one thread {one:.2} s ({clock:.2} s on the clock), on two {two:.2} s ({:.2} s)",
        begin.elapsed().as_secs_f64()
    );
}

/// Seconds of a hundred load cases at once, and of their displacements.
fn many(model: &Model, cases: &Cases, starts: Starts<'_>) -> (f64, f64) {
    let all: Vec<_> = (2..MANY + 2).map(|k| cases.case(k)).collect();
    let begin = cpu();
    let solutions: Vec<Solution> = (model.solve_cases(&all, &Settings::default(), starts, None))
        .into_iter()
        .map(|solution| solution.expect("a valid case"))
        .collect();
    let solved = cpu();
    assert!(solutions.iter().all(|solution| solution.status == Status::Solved), "all are solved");
    let columns = (2..).zip(&solutions).map(|(k, solution)| cases.solved(k, solution));
    let recovered = model.recover_cases(&columns.collect::<Vec<_>>()).expect("valid solutions");
    assert_eq!(recovered.len(), MANY);
    (solved - begin, cpu() - solved)
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

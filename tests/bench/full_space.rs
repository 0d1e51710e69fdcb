//! Costs of models in full space: CPU time, peak memory, factorisations and solutions with a factor.
//!
//! `cargo bench --bench full_space -- plane 512 .3` solves half of a bar with 512 elements along a wavy obstacle,
//! `space 16 .3` a block with 16 x 16 pairs, both graded away from the contact; a coefficient of friction for each
//! run follows. Told are a solution, the recovery of its displacements, and further cases of the same model that start from
//! the case before: loads that grow by a hundredth, and loads of which a part is turned. With `condensed` before it the condensed matrix is formed, for comparison. One thread. Times and
//! peaks are those of Linux.

#[path = "../common/mod.rs"]
mod common;

use common::wavy::Wavy;
use signorini::{FrictionLaw, LoadCase, Model, Monitor, Settings, Starts};

fn main() {
    let mut wanted: Vec<String> =
        std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    let condensed = wanted.first().is_some_and(|first| first == "condensed");
    if condensed {
        wanted.remove(0);
    }
    let [kind, size, coefficients @ ..] = wanted.as_slice() else {
        println!(
            "give plane or space, a number of elements or pairs, and coefficients of friction"
        );
        return;
    };
    let size: usize = size.parse().expect("a number");
    let wavy = if kind == "plane" { Wavy::plane(size) } else { Wavy::space(size) };
    let settings = Settings { full_space: !condensed, ..Settings::default() };
    // Linux: the high-water mark begins anew.
    let _ = std::fs::write("/proc/self/clear_refs", "5");
    let (before, begin) = (peak(), cpu());
    let model = wavy.model(&settings);
    println!(
        "{} unknowns, {} pairs: model {:.2} s, peak {} MB, of these the host's {before} MB",
        wavy.stiffness.size,
        model.pairs(),
        cpu() - begin,
        peak()
    );
    for mu in coefficients {
        let mu = vec![mu.parse().expect("a coefficient"); model.pairs()];
        let case = LoadCase {
            load: &wavy.load,
            prescribed: wavy.prescribed.as_deref(),
            gap: &wavy.gap,
            law: FrictionLaw::Coulomb(&mu),
            reference_slip: None,
        };
        let begin = cpu();
        let monitor = &mut Monitor::new(&settings, None);
        let solution = model.solve(&case, &settings, None, monitor).expect("a case");
        println!(
            "mu {}: {:.2} s, peak {} MB, {} systems, {} factorisations, {} solves, {}",
            mu[0],
            cpu() - begin,
            peak(),
            solution.iterations,
            solution.factorisations,
            solution.outer_iterations,
            solution.message,
        );
        let begin = cpu();
        let u = model.recover(Some(&wavy.load), wavy.prescribed.as_deref(), &solution.d);
        u.expect("a solution");
        println!("    recovered in {:.2} s", cpu() - begin);
        further(&model, &wavy, &case);
    }
}

/// Cases after the first one of a series.
fn further(model: &Model, wavy: &Wavy, case: &LoadCase<'_>) {
    let (mut series, settings) = (model.series(), Settings::default());
    // Along one axis by more than along the others, which no case before has told apart.
    let changed = |parts: [f64; 2]| -> [Vec<f64>; 2] {
        let values = wavy.prescribed.clone().unwrap_or_default();
        [wavy.load.clone(), values].map(|mut values| {
            let part = |i: usize| parts[usize::from(!i.is_multiple_of(model.dim()))];
            values.iter_mut().enumerate().for_each(|(i, value)| *value *= part(i));
            values
        })
    };
    let steps = [
        ("first", [1.0, 1.0]),
        ("grown", [1.01, 1.01]),
        ("turned", [1.02, 1.0]),
        ("back", [1.0, 1.01]),
    ];
    for (name, parts) in steps {
        let [load, values] = changed(parts);
        let prescribed = case.prescribed.map(|_| values.as_slice());
        let case = LoadCase { load: &load, prescribed, ..*case };
        let begin = cpu();
        let solved = series.solve_cases(&[case], &settings, Starts::Previous(None), None);
        let solution = solved.into_iter().next().expect("a case").expect("data that fit");
        println!(
            "    {name}: {:.2} s, {} systems, {} factorisations, {} solves, {}",
            cpu() - begin,
            solution.iterations,
            solution.factorisations,
            solution.outer_iterations,
            solution.message,
        );
    }
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

//! Gain of threads in one solution of a condensed problem.
//!
//! `cargo bench --bench solve_threads -- [TURNS] [CASE ...]`: `signorini_solve` with `settings.threads` 1 to 4, in turns, the
//! factor of the bar on the plane (`growth.rs`) with 2049 pairs and of a cube that is clamped above with 961 pairs, with
//! and without friction. Prints for each number of threads medians and least values of seconds on the clock and of all
//! threads, the gain on the clock, and that all have the same bits; with `--features counters` also the median of the
//! seconds in which threads share nothing, and their part of those of one thread.

#[path = "../common/mod.rs"]
mod common;

#[path = "../common/graded_bar.rs"]
mod graded_bar;

use std::ffi::c_void;
use std::time::{Duration, Instant};

use common::brick::{Brick, Support};
use common::mesh;
use graded_bar::GradedBar;
use signorini::Model;

/// `signorini_settings`, of which this bench sets the last number alone.
#[repr(C)]
struct Settings {
    numbers: [u64; 11],
    full_space: i32,
    threads: i32,
}

unsafe extern "C" {
    fn signorini_settings_default(settings: *mut Settings, size: usize) -> i32;
    fn signorini_solve(
        dim: i32,
        pairs: i64,
        stiffness: *const f64,
        ld: i64,
        load: *const f64,
        gap: *const f64,
        law: i32,
        friction: *const f64,
        slip: *const f64,
        settings: *const Settings,
        d: *mut f64,
        force: *mut f64,
        state: *mut i32,
        report: *mut c_void,
        extra: *const c_void,
    ) -> i32;
}

/// Coulomb's law.
const COULOMB: i32 = 1;

const THREADS: [i32; 4] = [1, 2, 3, 4];

struct Case {
    name: &'static str,
    dim: usize,
    load: Vec<f64>,
    gap: Vec<f64>,
    mu: f64,
}

fn main() {
    let mut wanted: Vec<String> =
        std::env::args().skip(1).filter(|a| !a.starts_with('-')).collect();
    let turns = wanted.first().and_then(|first| first.parse().ok());
    wanted.drain(..usize::from(turns.is_some()));
    let turns = turns.unwrap_or(9);
    let is_wanted = |name: &str| wanted.is_empty() || wanted.iter().any(|own| own == name);
    println!("case,pairs,threads,wall_median,wall_least,cpu_median,cpu_least,gain,bits");
    let plane = ["plane-0", "plane-0.3"];
    if plane.into_iter().any(is_wanted) {
        let bar = GradedBar::new(2048);
        let wave = 3.0 * std::f64::consts::TAU / 2048.0;
        let load = bar.model.condensed_load(&bar.load, None).expect("a load");
        for (name, mu) in plane.into_iter().zip([0.0, 0.3]).filter(|(name, _)| is_wanted(name)) {
            let height = if mu == 0.0 { 2e-3 } else { 0.0 };
            let gap = (0..2049).map(|i| height * (1.0 - (wave * i as f64).cos())).collect();
            run(&bar.model, &Case { name, dim: 2, load: load.clone(), gap, mu }, turns);
        }
    }
    let space = ["space-0", "space-0.2", "space-0.3"];
    if space.into_iter().any(is_wanted) {
        let brick = Brick::new([30, 30, 10], [1.0, 1.0, 0.5], Support::Clamped);
        let model = brick.model();
        // The face presses, shears and tilts, on a hollow obstacle.
        let (load, prescribed) = brick.moved(|at| [4e-4, 1e-4, -1e-3 * (1.0 + 0.3 * at[0])]);
        let load = model.condensed_load(&load, prescribed.as_deref()).expect("a load");
        let hollow = |pair| {
            let [x, y, _] = brick.place(pair);
            4e-3 * (x * x + y * y)
        };
        for (name, mu) in space.into_iter().zip([0.0, 0.2, 0.3]).filter(|(name, _)| is_wanted(name))
        {
            let gap = (0..brick.pairs()).map(hollow).collect();
            run(&model, &Case { name, dim: 3, load: load.clone(), gap, mu }, turns);
        }
    }
}

/// Solves a case in turns.
fn run(model: &Model, case: &Case, turns: usize) {
    let mut times = THREADS.map(|_| [Vec::new(), Vec::new(), Vec::new()]);
    let mut first: Option<Vec<u64>> = None;
    let mut same = THREADS.map(|_| true);
    for _ in 0..turns {
        for (k, threads) in THREADS.into_iter().enumerate() {
            take_shared();
            let (begin, cpu) = (Instant::now(), cpu());
            let bits = solve(model, case, threads);
            let wall = begin.elapsed();
            times[k][0].push(wall.as_secs_f64());
            times[k][1].push(self::cpu() - cpu);
            times[k][2].push((wall - take_shared()).as_secs_f64());
            same[k] &= first.get_or_insert_with(|| bits.clone()) == &bits;
        }
    }
    let of = |values: &[f64]| {
        let mut values = values.to_vec();
        values.sort_by(f64::total_cmp);
        (values[values.len() / 2], values[0])
    };
    let one = of(&times[0][0]);
    for (k, threads) in THREADS.into_iter().enumerate() {
        let (wall, cpu) = (of(&times[k][0]), of(&times[k][1]));
        let unshared = of(&times[k][2]).0;
        let counted = format!(",{unshared:.4},{:.1} %", 100.0 * unshared / one.0);
        println!(
            "{},{},{threads},{:.4},{:.4},{:.4},{:.4},{:.2},{}{}",
            case.name,
            model.pairs(),
            wall.0,
            wall.1,
            cpu.0,
            cpu.1,
            one.1 / wall.1,
            if same[k] { "same" } else { "other" },
            if cfg!(feature = "counters") && threads > 1 { counted } else { String::new() }
        );
    }
}

/// The time since the last call in which threads shared works, where it is counted.
fn take_shared() -> Duration {
    #[cfg(feature = "counters")]
    return signorini::counters::take_shared();
    #[cfg(not(feature = "counters"))]
    Duration::ZERO
}

/// The bits of the displacements and forces.
fn solve(model: &Model, case: &Case, threads: i32) -> Vec<u64> {
    let n = case.dim * model.pairs();
    let (mut d, mut force) = (vec![0.0; n], vec![0.0; n]);
    let mu = vec![case.mu; model.pairs()];
    let mut settings = Settings { numbers: [0; 11], full_space: 0, threads: 0 };
    // SAFETY: the arrays have the lengths that the header tells.
    let status = unsafe {
        assert_eq!(signorini_settings_default(&raw mut settings, size_of::<Settings>()), 0);
        settings.threads = threads;
        signorini_solve(
            case.dim as i32,
            model.pairs() as i64,
            model.stiffness().as_ptr(),
            n as i64,
            case.load.as_ptr(),
            case.gap.as_ptr(),
            COULOMB,
            mu.as_ptr(),
            std::ptr::null(),
            &raw const settings,
            d.as_mut_ptr(),
            force.as_mut_ptr(),
            std::ptr::null_mut(),
            std::ptr::null_mut(),
            std::ptr::null(),
        )
    };
    assert_eq!(status, 0, "{}", case.name);
    d.iter().chain(&force).map(|value| value.to_bits()).collect()
}

/// CPU seconds of all threads of the process, those that have ended among them.
fn cpu() -> f64 {
    let mut now = libc::timespec { tv_sec: 0, tv_nsec: 0 };
    // SAFETY: the time is written to its place.
    unsafe { libc::clock_gettime(libc::CLOCK_PROCESS_CPUTIME_ID, &raw mut now) };
    now.tv_sec as f64 + 1e-9 * now.tv_nsec as f64
}

//! How late a call may end: the longest silence of each phase, between two looks at the clock or the callback.
//!
//! `cargo bench --bench time_limits`, or with words of the groups that are wanted, such as `-- space models`. Told are milliseconds
//! of the thread's own processor time, which other work on the machine does not lengthen: of the phase in all (up to ten
//! seconds), the longest between two looks, and how long the call goes on after a callback that cancels, the most of
//! three places. A limit that passes is noticed after the longest silence, and then the call ends as a cancelled one.

#[path = "../common/mod.rs"]
mod common;
#[path = "../common/surfaces.rs"]
#[allow(dead_code)] // Tests use the rest.
mod surfaces;

use std::ops::ControlFlow;

use common::blocks::{Loading, block, loaded};
use common::brick::{Brick, Support};
use common::problems::{Case, Law};
use common::wavy::Wavy;
use signorini::surface::{
    Faces, Master, Obstacle, Pairing, SurfaceSettings, Surfaces, pair_surfaces,
};
use signorini::{
    ContactProblem, FlexibilityData, FlexibilityProblem, FrictionLaw, Lcp, LoadCase, Method, Model,
    Monitor, ProgressFn, Search, Settings, Starts, solve, solve_flexibility, solve_lcp,
};
use surfaces::{Shape, Sheet, TwoSheets, flat};

/// A phase is ended after so many milliseconds.
const LONGEST: f64 = 1e4;

/// Parts of a phase after which its callback cancels.
const CANCELLED: [f64; 3] = [0.2, 0.5, 0.8];

fn main() {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| word != "--bench").collect();
    let groups: [(&str, fn()); 5] = [
        ("plane", plane),
        ("space", space),
        ("flexibility", flexibility),
        ("models", models),
        ("surfaces", all_surfaces),
    ];
    println!("ms of the processor            in all, longest silence, on after a cancellation");
    for (name, group) in groups {
        if words.is_empty() || words.iter().any(|word| word == name) {
            group();
        }
    }
}

/// 2049 pairs of a bar.
fn plane() {
    let wavy = Wavy::plane(2048);
    let model = wavy.model(&Settings::default());
    let case = Case {
        dim: 2,
        pairs: wavy.gap.len(),
        k: model.stiffness().to_vec(),
        f: model.condensed_load(&wavy.load, None).expect("loads that fit"),
        gap: wavy.gap,
        law: Law::Coulomb(vec![0.3; 2049]),
        slip: None,
    };
    drop(model);
    every_method("2049 pairs in the plane", case);
}

/// 961 pairs of a block, clamped and free.
fn space() {
    let brick = block(31, Support::Clamped);
    every_method("961 pairs in space", loaded(&brick, &brick.model(), Loading::WavyGaps, 0.3));
    let free = Brick { support: Support::Free, ..brick };
    let model = free.model();
    let mut load = vec![0.0; free.size()];
    free.top().for_each(|node| (load[3 * node], load[3 * node + 2]) = (1e-6, -1e-5));
    let f = model.condensed_load(&load, None).expect("loads that fit");
    let gap = vec![0.0; free.pairs()];
    let law = Law::Coulomb(vec![0.3; free.pairs()]);
    let case = Case {
        dim: 3,
        pairs: free.pairs(),
        k: model.stiffness().to_vec(),
        f,
        gap,
        law,
        slip: None,
    };
    told("free block, auto", |look| contact(&case, &Settings::default(), look));
    let others = Settings { search: Search::Others, ..Settings::default() };
    told("free block, other solutions", |look| contact(&case, &others, look));
}

/// A problem by every method that fits it, without friction and with it.
fn every_method(name: &str, mut case: Case) {
    for mu in [0.0, 0.3] {
        println!("{name}, mu {mu}");
        case.law = Law::Coulomb(vec![mu; case.pairs]);
        let method = |method| Settings { method, ..Settings::default() };
        for (called, settings) in [
            ("auto", method(Method::Auto)),
            ("nested sweeps", method(Method::SorNested)),
            ("diagonal sweeps", method(Method::SorDiagonal)),
            ("Lemke", method(Method::Lemke)),
            ("block pivoting", method(Method::BlockPivoting)),
            ("Newton", method(Method::Newton)),
            ("path", method(Method::Path)),
            ("other solutions", Settings { search: Search::Others, ..Settings::default() }),
            ("proof", Settings { proof: true, ..Settings::default() }),
        ] {
            let fits = settings.method != Method::BlockPivoting || mu == 0.0;
            let in_space = case.dim == 3 && mu > 0.0;
            if fits && !(in_space && settings.method == Method::Lemke) {
                told(called, |look| contact(&case, &settings, look));
            }
        }
    }
}

fn contact(case: &Case, settings: &Settings, look: &mut ProgressFn<'_>) {
    let monitor = &mut Monitor::new(settings, Some(look));
    let problem = ContactProblem::new(case.data()).expect("valid data");
    solve(&problem, settings, None, monitor).expect("settings that fit");
}

/// A dense `W` of the size of 961 pairs in space, definite and singular, and a linear complementarity problem of it.
fn flexibility() {
    println!("flexibility form, 961 pairs in space");
    let (pairs, n) = (961, 3 * 961);
    for (called, twice) in [("definite", 1), ("each pair twice", 2)] {
        // Components next to each other are tied the most.
        let place = |i: usize| 3 * (i / (3 * twice)) + i % 3;
        let entry = |i: usize, j: usize| {
            let own = if place(i) == place(j) { 0.5 } else { 0.0 };
            own + 1.0 / (1.0 + place(i).abs_diff(place(j)) as f64)
        };
        let w: Vec<f64> = (0..n * n).map(|at| entry(at % n, at / n)).collect();
        let free: Vec<f64> = (0..n).map(|i| (0.37 * place(i) as f64).sin()).collect();
        let gap: Vec<f64> =
            (0..pairs).map(|pair| 0.3 * (0.5 * (pair / twice) as f64).cos()).collect();
        let (mu, settings) = (vec![0.3; pairs], Settings::default());
        let law = FrictionLaw::Coulomb(&mu);
        let data = FlexibilityData {
            dim: 3,
            pairs,
            flexibility: (&w[..], n),
            free: &free,
            gap: &gap,
            law,
            reference_slip: None,
        };
        told(called, |look| {
            let monitor = &mut Monitor::new(&settings, Some(look));
            let problem = FlexibilityProblem::from_flexibility(data).expect("valid data");
            solve_flexibility(&problem, &settings, None, monitor).expect("settings that fit");
        });
        told("model of it", |_| {
            Model::flexibility(3, pairs, &w, n).expect("valid data");
        });
        for method in [Method::Auto, Method::Lemke] {
            let settings = Settings { method, ..settings };
            told(&format!("LCP, {method:?}"), |look| {
                let monitor = &mut Monitor::new(&settings, Some(look));
                let lcp = Lcp::new(n, &w, n, &free, None).expect("valid data");
                solve_lcp(&lcp, &settings, monitor).expect("settings that fit");
            });
        }
    }
}

/// Models of 100,000 unknowns in both forms, with a series of load cases, each from the one before it.
fn models() {
    let brick = Brick::new([30, 30, 34], [2.0, 2.0, 2.0], Support::Clamped);
    let of_brick =
        |matrix: &_, monitor: &mut Monitor<'_>| brick.model_within(matrix, None, monitor);
    let matrix = brick.stiffness();
    let (load, prescribed) = brick.moved(|[x, y, _]| [0.008 - 0.005 * y, 0.003 + 0.005 * x, -0.03]);
    let gap: Vec<f64> = (0..brick.pairs())
        .map(|pair| {
            let [x, y, _] = brick.place(pair);
            0.01 * (1.0 - (4.0 * x).cos() * (3.0 * y + 0.5).cos())
        })
        .collect();
    in_both_forms(
        &format!("961 pairs in space, {} unknowns", matrix.size),
        &|monitor| of_brick(&matrix, monitor).ok(),
        (&load, prescribed.as_deref(), &gap),
    );
    for (name, wavy) in
        [("2001 pairs in the plane", Wavy::plane(2000)), ("1849 pairs in space", Wavy::space(43))]
    {
        let name = format!("{name}, {} unknowns", wavy.stiffness.size);
        let case = (&wavy.load[..], wavy.prescribed.as_deref(), &wavy.gap[..]);
        in_both_forms(&name, &|monitor| wavy.try_model(monitor).ok(), case);
    }
}

fn in_both_forms(
    name: &str,
    make: &dyn Fn(&mut Monitor<'_>) -> Option<Model>,
    (load, prescribed, gap): (&[f64], Option<&[f64]>, &[f64]),
) {
    for full_space in [false, true] {
        let settings = Settings { full_space, ..Settings::default() };
        println!("{name}, {}", if full_space { "full space" } else { "condensed" });
        let make = |look: &mut ProgressFn<'_>| make(&mut Monitor::new(&settings, Some(look)));
        told("model", |look| drop(make(look)));
        let model = make(&mut |_| ControlFlow::Continue(())).expect("a model");
        let (mu, mut series) = (vec![0.3; model.pairs()], model.series());
        let mut d = Vec::new();
        for (part, called) in [(1.0, "first load case"), (0.9, "second"), (0.8, "third")] {
            let scaled = |values: &[f64]| values.iter().map(|v| part * v).collect::<Vec<f64>>();
            let (load, values) = (scaled(load), prescribed.map(scaled));
            let law = FrictionLaw::Coulomb(&mu);
            let case = LoadCase {
                load: &load,
                prescribed: values.as_deref(),
                gap,
                law,
                reference_slip: None,
            };
            if part == 1.0 {
                told("load case by itself", |look| {
                    model.solve_cases(&[case], &settings, Starts::Cold, Some(look));
                });
            }
            let (looks, solved) = looked(f64::INFINITY, |look| {
                series.solve_cases(&[case], &settings, Starts::Previous(None), Some(look))
            });
            print(called, looks, None);
            d = solved.into_iter().next().expect("a case").expect("a solution").d;
        }
        let ((all, _, _), _) = looked(f64::INFINITY, |_| model.recover(Some(load), prescribed, &d));
        println!("  {:<30} {all:>8.0}", "recovery, without a callback");
    }
}

/// A hundred thousand faces on as many of another mesh.
fn all_surfaces() {
    let sheet = |shape: Shape, cells: [usize; 2], height: f64| {
        let rng = &mut fastrand::Rng::with_seed(3);
        let flat = Sheet::rectangle(shape, cells, [[0.0, 1.0]; 2], (0.0, rng));
        flat.mapped(|[x, y, _]| [x, y, height - 0.3 * (x * x + y * y)])
    };
    println!("100,000 faces a side, 200,000 slivers");
    let dual = SurfaceSettings::default();
    let nodes = SurfaceSettings { pairing: Pairing::NodeToSurface, ..SurfaceSettings::default() };
    let far = SurfaceSettings { search_distance: Some(1e3), ..SurfaceSettings::default() };
    for (name, shape, cells, settings) in [
        ("Q4", Shape::Q4, 316, &dual),
        ("Q4, nodes against surfaces", Shape::Q4, 316, &nodes),
        ("Q4, any distance", Shape::Q4, 316, &far),
        ("T3", Shape::T3, 224, &dual),
        ("T6", Shape::T6, 224, &dual),
        ("Q8", Shape::Q8, 316, &dual),
        ("Q9", Shape::Q9, 316, &dual),
        ("Q9, nodes against surfaces", Shape::Q9, 316, &nodes),
    ] {
        let slave = sheet(shape, [cells; 2], 1e-3).turned();
        paired(name, &TwoSheets::new(3, slave, sheet(shape, [cells + 1; 2], 0.0)), settings);
    }
    let fan = |height: f64| {
        let rim = (0..=200_000).map(|k| (5.0 * k as f64 / 2e5).sin_cos());
        Sheet {
            nodes: std::iter::once([0.0, 0.0, height])
                .chain(rim.map(|(s, c)| [c, s, height]))
                .collect(),
            faces: (0..200_000).map(|k| vec![0, k + 1, k + 2]).collect(),
        }
    };
    let other = fan(0.0).mapped(|[x, y, z]| [y, -x, z]);
    paired("slivers", &TwoSheets::new(3, fan(1e-3).turned(), other), &dual);
    let plate = sheet(Shape::Q4, [316; 2], 1e-3).turned();
    let (coordinates, (start, faces)) = (plate.nodes.concat(), flat(&plate.faces));
    let plane = Obstacle::Plane { point: [0.0; 3], outward: [0.0, 0.0, 1.0] };
    told("Q4 on a rigid plane", |look| {
        let monitor = &mut Monitor::new(&Settings::default(), Some(look));
        let (slave, master) = (Faces { start: &start, nodes: &faces }, Master::RigidShape(plane));
        let surfaces = Surfaces { dim: 3, coordinates: &coordinates, slave, master };
        pair_surfaces(&surfaces, &dual, monitor).ok();
    });
}

fn paired(name: &str, sheets: &TwoSheets, settings: &SurfaceSettings) {
    let coordinates = sheets.nodes.concat();
    let [slave, master] = [flat(&sheets.slave), flat(&sheets.master)];
    told(name, |look| {
        let [slave, master] = [&slave, &master].map(|(start, nodes)| Faces { start, nodes });
        let master = Master::Faces(master);
        let surfaces = Surfaces { dim: 3, coordinates: &coordinates, slave, master };
        pair_surfaces(&surfaces, settings, &mut Monitor::new(&Settings::default(), Some(look)))
            .ok();
    });
}

/// Tells of a phase, which is run again for each cancellation.
fn told(name: &str, work: impl Fn(&mut ProgressFn<'_>)) {
    let (looks, ()) = looked(LONGEST, &work);
    let on = CANCELLED.map(|part| looked(part * looks.0, &work).0.2);
    print(name, looks, Some(on.into_iter().fold(0.0, f64::max)));
}

fn print(name: &str, (all, silence, end): (f64, f64, f64), cancelled: Option<f64>) {
    let silence = silence.max(if all < LONGEST { end } else { 0.0 });
    let on = cancelled.map_or(String::new(), |on| format!("{on:>8.0}"));
    println!("  {name:<30} {all:>8.0} {silence:>8.0} {on}");
}

/// Milliseconds of a work that is cancelled after `most` of them: in all, the longest between two looks, and after the last one.
fn looked<T>(most: f64, work: impl FnOnce(&mut ProgressFn<'_>) -> T) -> ((f64, f64, f64), T) {
    let begin = processor_time();
    let (mut last, mut longest) = (begin, 0.0_f64);
    let done = work(&mut |_| {
        let now = processor_time();
        longest = longest.max(now - last);
        last = now;
        if now - begin < most { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    });
    let end = processor_time();
    ((end - begin, longest, end - last), done)
}

/// Milliseconds that the processor has worked for this thread.
fn processor_time() -> f64 {
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").expect("Linux");
    let nanoseconds: f64 = told.split(' ').next().and_then(|ns| ns.parse().ok()).expect("a number");
    1e-6 * nanoseconds
}

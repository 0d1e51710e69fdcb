//! Bodies in full space: those that contact alone holds, closed forms, what is told and what is refused, and the
//! limit on memory that chooses the form.

use std::ops::ControlFlow;

use crate::common::dense::{difference, largest};
use crate::common::mesh::{Mesh, Pairs, steps};
use crate::common::stack::{Stack, components};
use crate::common::wavy::Wavy;
use signorini::{
    Error, FrictionLaw, Limit, LoadCase, Method, Model, Monitor, Progress, Search, Settings,
    Solution, Starts, State, Status,
};

fn full() -> Settings {
    Settings { full_space: true, ..Settings::default() }
}

fn solve(model: &Model, load: &[f64], law: FrictionLaw<'_>, settings: &Settings) -> Solution {
    let gap = vec![0.0; model.pairs()];
    let case = LoadCase { load, prescribed: None, gap: &gap, law, reference_slip: None };
    model.solve(&case, settings, None, &mut Monitor::new(settings, None)).expect("a case")
}

fn stacked(stack: &Stack, fixed: &[usize], settings: &Settings) -> Model {
    let monitor = &mut Monitor::new(settings, None);
    stack.mesh.stiffness().model_under(fixed, &stack.pairs().view(), monitor).expect("a model")
}

/// Patch test: under uniform pressure `p` strains are uniform, `strain_y = -p (1 - nu²) / E`,
/// `strain_x = p nu (1 + nu) / E` (plane strain). The upper block is held by contact alone. To 1e-10: a thousand
/// times the rounding of the displacements, which follow the forces of a small mesh.
#[test]
fn a_block_on_a_block_passes_the_patch_test() {
    let stack = Stack::new([4, 4], [2000.0, 2000.0]);
    let mut fixed = components(&stack.lower.row(0), 1);
    fixed.push(2 * stack.lower.node(0, 0));
    let model = stacked(&stack, &fixed, &full());
    let load = stack.load(7.0, 0.0);
    let solution = solve(&model, &load, FrictionLaw::Coulomb(&[0.5; 5]), &full());
    assert_eq!(solution.status, Status::Solved, "{}", solution.message);
    let u = model.recover(Some(&load), None, &solution.d).unwrap();
    let strains = (7.0 * 0.3 * 1.3 / 2000.0, -7.0 * (1.0 - 0.09) / 2000.0);
    let exact: Vec<f64> =
        stack.mesh.nodes.iter().flat_map(|[x, y]| [strains.0 * x, strains.1 * y]).collect();
    assert!(largest(&difference(&u, &exact)) <= 1e-10 * largest(&exact));
    let share = 7.0 * 3.0 / 4.0;
    for (pair, force) in solution.certificate.force.chunks(2).enumerate() {
        let normal = if pair % 4 == 0 { -share / 2.0 } else { -share };
        assert!((force[0] - normal).abs() <= 1e-9 * share && force[1].abs() <= 1e-9 * share);
    }
}

/// Full space gives the answers of the condensed form, for a body that contact alone holds, on meshes that match and
/// that do not, under all laws of the plane. Both are certified to 1e-10 of the forces.
#[test]
fn floating_bodies_have_the_same_answers_as_condensed() {
    for columns in [[6, 6], [9, 7], [20, 24]] {
        let stack = Stack::new(columns, [2000.0, 700.0]);
        let pairs = columns[1] + 1;
        let models = [Settings::default(), full()];
        let models = models.map(|settings| stacked(&stack, &stack.bottom(), &settings));
        assert!(!models[0].is_matrix_free() && models[1].is_matrix_free());
        let load = stack.load(7.0, 2.0);
        let (coulomb, tresca) = (vec![0.4; pairs], vec![7.0 / pairs as f64; pairs]);
        let cohesive = [0.3, 0.2, 0.1].repeat(pairs);
        for law in [
            FrictionLaw::Coulomb(&coulomb),
            FrictionLaw::Tresca(&tresca),
            FrictionLaw::Cohesive(&cohesive),
        ] {
            let [dense, full] = [0, 1].map(|i| solve(&models[i], &load, law, &Settings::default()));
            let context = format!("{columns:?}, {law:?}");
            assert_eq!(dense.status, Status::Solved, "{context}: {}", dense.message);
            assert_eq!(full.status, Status::Solved, "{context}: {}", full.message);
            let apart = largest(&difference(&full.d, &dense.d)) / largest(&dense.d);
            assert!(apart <= 1e-9, "{context}: {apart:e}");
            assert_eq!(full.certificate.states, dense.certificate.states, "{context}");
            let displacements = |solution: &Solution, model: &Model| {
                model.recover(Some(&load), None, &solution.d).unwrap()
            };
            let (u, v) = (displacements(&full, &models[1]), displacements(&dense, &models[0]));
            assert!(largest(&difference(&u, &v)) <= 1e-9 * largest(&v), "{context}");
            let relative = models.each_ref().map(|m| m.condensed_load(&load, None).unwrap());
            let apart = largest(&difference(&relative[0], &relative[1]));
            assert!(apart <= 1e-12 * largest(&relative[0]), "{context}: {apart:e}");
        }
    }
}

/// A block on a plane under its weight `N` and the horizontal force `T`: in equilibrium if `T < mu N` (and it does
/// not tip), in none if `T > mu N`, where nothing may be called a solution.
#[test]
fn a_block_slides_beyond_the_coulomb_limit() {
    let mut mesh = Mesh::default();
    let block = mesh.block(&steps(0.0, 4.0, 8), &steps(0.0, 1.0, 2), (100.0, 0.3));
    let pairs = Pairs::on_obstacle(&block.row(0), [0.0, -1.0]);
    let monitor = &mut Monitor::new(&full(), None);
    let model = mesh.stiffness().model_under(&[], &pairs.view(), monitor).unwrap();
    let mu = vec![0.4; 9];
    for (ratio, holds) in [(0.2, true), (0.399, true), (0.401, false), (0.6, false)] {
        let mut load = vec![0.0; mesh.size()];
        mesh.traction(&block.row(0), [ratio, 0.0], &mut load);
        mesh.traction(&block.row(block.rows), [0.0, -1.0], &mut load);
        let solution = solve(&model, &load, FrictionLaw::Coulomb(&mu), &full());
        assert_eq!(solution.status == Status::Solved, holds, "{ratio}: {}", solution.message);
        if holds {
            let force = &solution.certificate.force;
            let sum = |c: usize| force.iter().skip(c).step_by(2).sum::<f64>();
            assert!((sum(0) + 4.0).abs() <= 1e-8 && (sum(1).abs() - 4.0 * ratio).abs() <= 1e-8);
        } else {
            assert_eq!(solution.status, Status::NoEquilibrium, "{}", solution.message);
        }
    }
}

/// A body pulled off its plane flies away; pushed by nothing it rests.
#[test]
fn a_body_that_nothing_holds_is_not_solved() {
    let mut mesh = Mesh::default();
    let block = mesh.block(&steps(0.0, 2.0, 4), &steps(0.0, 1.0, 2), (100.0, 0.3));
    let pairs = Pairs::on_obstacle(&block.row(0), [0.0, -1.0]);
    let monitor = &mut Monitor::new(&full(), None);
    let model = mesh.stiffness().model_under(&[], &pairs.view(), monitor).unwrap();
    for mu in [0.0, 0.3] {
        let mu = vec![mu; 5];
        let mut load = vec![0.0; mesh.size()];
        let rest = solve(&model, &load, FrictionLaw::Coulomb(&mu), &full());
        assert_eq!((rest.status, largest(&rest.d)), (Status::Solved, 0.0), "{}", rest.message);
        mesh.traction(&block.row(block.rows), [0.0, 1.0], &mut load);
        let solution = solve(&model, &load, FrictionLaw::Coulomb(&mu), &full());
        assert_eq!(solution.status, Status::NoEquilibrium, "{}", solution.message);
    }
}

/// The limit on memory chooses: without one the matrix is condensed; with one that the condensed matrix passes the
/// model is in full space, if a load case there keeps to it too; with a smaller one there is none. The body is a
/// sheet of two layers, of whose nodes a third is in contact: its sparse matrix is small beside the dense one.
#[test]
fn the_limit_on_memory_chooses_the_form() {
    let mut mesh = Mesh::default();
    let sheet = mesh.block(&steps(0.0, 1100.0, 1100), &steps(0.0, 2.0, 2), (100.0, 0.3));
    let held: Vec<usize> =
        sheet.row(sheet.rows).iter().flat_map(|node| [2 * node, 2 * node + 1]).collect();
    let (stiffness, pairs) = (mesh.stiffness(), Pairs::on_obstacle(&sheet.row(0), [0.0, -1.0]));
    let announced = |settings: &Settings| {
        let mut bytes = Vec::new();
        let mut progress = |now: &Progress| {
            bytes.push(now.memory);
            ControlFlow::Continue(())
        };
        let monitor = &mut Monitor::new(settings, Some(&mut progress));
        let made = stiffness.model_under(&held, &pairs.view(), monitor);
        (made, bytes.into_iter().max().unwrap_or(0))
    };
    let (dense, condensed) = announced(&Settings::default());
    let (in_full, spread) = announced(&full());
    assert!(!dense.unwrap().is_matrix_free() && in_full.unwrap().is_matrix_free());
    assert!(spread < condensed, "{spread} bytes are not less than {condensed}");
    for (limit, form) in [
        (condensed, Some(false)),
        (condensed - 1, Some(true)),
        (spread, Some(true)),
        (spread - 1, None),
    ] {
        let settings = Settings { memory_limit: limit, ..Settings::default() };
        let (made, _) = announced(&settings);
        match (made, form) {
            (Ok(model), Some(form)) => {
                assert_eq!(model.is_matrix_free(), form, "{limit}");
                assert!(!form || model.memory() <= limit, "{limit}: {}", model.memory());
            }
            (Err(Error::Stopped { limit: Limit::Memory, message }), None) => {
                assert!(message.contains("memory_limit"), "{message}");
            }
            (Ok(_), None) => panic!("{limit} bytes are too few"),
            (Err(error), _) => panic!("{limit}: {error}"),
        }
    }
}

/// A load case may take as much as the model tells, and is refused before anything is done where the limit is a byte less;
/// so is one of pairs that depend on each other, which is condensed all the same.
#[test]
fn a_limit_on_memory_refuses_load_cases() {
    let stack = Stack::new([4, 4], [2000.0, 2000.0]);
    let all = |nodes: &[usize]| nodes.iter().flat_map(|n| [2 * n, 2 * n + 1]).collect::<Vec<_>>();
    let twice = [stack.upper.row(0), stack.upper.row(0)].concat();
    let dependent = Pairs::on_obstacle(&twice, [0.0, -1.0]);
    let lower: Vec<usize> = stack.lower.nodes().collect();
    let models = [
        stacked(&stack, &all(&stack.lower.row(0)), &full()),
        stack.mesh.stiffness().model(&all(&lower), &dependent).expect("a model"),
    ];
    assert!(models[0].is_matrix_free() && !models[1].dependent_pairs().is_empty());
    let load = stack.load(7.0, 0.0);
    for model in models {
        let (gap, mu) = (vec![0.0; model.pairs()], vec![0.5; model.pairs()]);
        let law = FrictionLaw::Coulomb(&mu);
        let case = LoadCase { load: &load, prescribed: None, gap: &gap, law, reference_slip: None };
        let limited = |memory_limit| {
            let settings = Settings { memory_limit, ..Settings::default() };
            model.solve(&case, &settings, None, &mut Monitor::new(&settings, None))
        };
        assert!(limited(model.memory()).is_ok());
        match limited(model.memory() - 1) {
            Err(Error::Stopped { limit: Limit::Memory, message }) => {
                assert!(message.contains("memory_limit allows"), "{message}");
            }
            other => panic!("{other:?}"),
        }
    }
}

/// Refused by a sentence: what needs the condensed matrix. Told: the measures of displacements from elsewhere.
#[test]
fn what_needs_the_matrix_is_refused() {
    let stack = Stack::new([4, 4], [2000.0, 2000.0]);
    let model = stacked(&stack, &stack.bottom(), &full());
    assert!(model.stiffness().is_empty() && model.frames().is_some());
    let (load, mu, gap) = (stack.load(7.0, 2.0), [0.3; 5], [0.0; 5]);
    let law = FrictionLaw::Coulomb(&mu);
    let case = LoadCase { load: &load, prescribed: None, gap: &gap, law, reference_slip: None };
    for settings in [
        Settings { method: Method::SorNested, ..full() },
        Settings { search: Search::Others, ..full() },
        Settings { proof: true, ..full() },
    ] {
        let monitor = &mut Monitor::new(&settings, None);
        let message = model.solve(&case, &settings, None, monitor).err().unwrap().message();
        assert!(message.contains("needs the condensed matrix"), "{message}");
    }
    let path = std::path::Path::new("never written");
    assert!(model.write_case(path, &case, None).err().unwrap().message().contains("full space"));
    let solution = solve(&model, &load, law, &full());
    assert!(model.certify(&case, &solution.d).unwrap().holds(1e-10));
    let off: Vec<f64> = solution.d.iter().map(|d| d + 1e-4).collect();
    assert!(!model.certify(&case, &off).unwrap().holds(1e-10));
    // From the solution one system is enough, and states and bits stay.
    let settings = full();
    let monitor = &mut Monitor::new(&settings, None);
    let warm = model.solve(&case, &settings, Some(&solution.d), monitor).unwrap();
    assert_eq!(warm.status, Status::Solved, "{}", warm.message);
    assert!(warm.iterations <= 2, "{} systems", warm.iterations);
    assert!(largest(&difference(&warm.d, &solution.d)) <= 1e-9 * largest(&solution.d));
    assert_eq!(solve(&model, &load, law, &full()).d, solution.d);
    assert!(solution.certificate.count(State::Open) < 5);
}

/// A budget ends the solution with its status and the best iterate; time runs out before the first system.
#[test]
fn budgets_end_a_solution() {
    let wavy = Wavy::plane(64);
    let model = wavy.try_model(&mut Monitor::new(&full(), None)).unwrap();
    let mu = vec![0.3; 65];
    let case = LoadCase {
        load: &wavy.load,
        prescribed: None,
        gap: &wavy.gap,
        law: FrictionLaw::Coulomb(&mu),
        reference_slip: None,
    };
    for (settings, status) in [
        (Settings { max_iterations: 2, ..full() }, Status::IterationLimit),
        (Settings { time_limit: f64::MIN_POSITIVE, ..full() }, Status::TimeLimit),
    ] {
        let solution = model.solve(&case, &settings, None, &mut Monitor::new(&settings, None));
        assert_eq!(solution.unwrap().status, status);
    }
    let mut progress = |now: &Progress| match now.iterations {
        3.. => ControlFlow::Break(()),
        _ => ControlFlow::Continue(()),
    };
    let monitor = &mut Monitor::new(&full(), Some(&mut progress));
    let solution = model.solve(&case, &full(), None, monitor).unwrap();
    assert_eq!((solution.status, solution.iterations), (Status::Cancelled, 3));
}

/// A callback is asked while a factor is made too; whenever it cancels, the model serves as before.
#[test]
fn a_factorisation_can_be_cancelled() {
    let wavy = Wavy::space(17);
    let model = wavy.try_model(&mut Monitor::new(&full(), None)).unwrap();
    let mu = vec![0.3; model.pairs()];
    let case = LoadCase {
        load: &wavy.load,
        prescribed: wavy.prescribed.as_deref(),
        gap: &wavy.gap,
        law: FrictionLaw::Coulomb(&mu),
        reference_slip: None,
    };
    let run = |most: u64| {
        let mut calls = 0;
        let mut progress = |_: &Progress| {
            calls += 1;
            if calls > most { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let monitor = &mut Monitor::new(&full(), Some(&mut progress));
        let solution = model.solve(&case, &full(), None, monitor).unwrap();
        (solution, calls)
    };
    let (whole, calls) = run(u64::MAX);
    assert_eq!(whole.status, Status::Solved, "{}", whole.message);
    // It is asked before each solution with a factor, and in each factorisation.
    let (solutions, factors) = (whole.outer_iterations, whole.factorisations);
    assert!(calls > solutions + factors, "{calls} calls: {solutions} solutions, {factors} factors");
    for most in 0..calls {
        let (solution, asked) = run(most);
        assert_eq!(solution.status, Status::Cancelled, "{most}: {}", solution.message);
        assert_eq!(asked, most + 1);
    }
    assert_eq!(run(u64::MAX).0.d, whole.d);
}

/// The factor with all pairs held, which a further load case makes before its first system, asks too.
#[test]
fn a_further_load_case_asks_before_its_first_system() {
    let wavy = Wavy::space(17);
    let model = wavy.try_model(&mut Monitor::new(&full(), None)).unwrap();
    let mu = vec![0.3; model.pairs()];
    let case = LoadCase {
        load: &wavy.load,
        prescribed: wavy.prescribed.as_deref(),
        gap: &wavy.gap,
        law: FrictionLaw::Coulomb(&mu),
        reference_slip: None,
    };
    for begins in [1, 2] {
        let mut before = 0;
        let mut progress = |now: &Progress| {
            before += u64::from(now.iterations == 0);
            ControlFlow::Continue(())
        };
        let monitor = &mut Monitor::new(&full(), Some(&mut progress));
        let solution = model.solve(&case, &full(), None, monitor).unwrap();
        assert_eq!(solution.status, Status::Solved, "{}", solution.message);
        // The first system itself asks once; the model has left the factor of the first case.
        assert!(before >= begins, "{before}");
    }
}

/// A case of a series begins at the solution before it, with its factor: it has the answer of a case by itself, with
/// fewer factorisations, also where its loads are no multiple of earlier ones.
#[test]
fn a_series_begins_where_it_was() {
    let wavy = Wavy::space(13);
    let model = || wavy.try_model(&mut Monitor::new(&full(), None)).unwrap();
    let (series, alone) = (model(), model());
    let mut series = series.series();
    let mu = vec![0.3; alone.pairs()];
    for (k, part) in [1.0, 0.95, 0.9, 0.85].into_iter().enumerate() {
        let values = wavy.prescribed.as_ref().map(|values| {
            let turned = |(i, v): (usize, &f64)| if k == 2 && i % 3 == 0 { 0.9 * v } else { *v };
            values.iter().enumerate().map(turned).map(|v| part * v).collect::<Vec<f64>>()
        });
        let case = LoadCase {
            load: &wavy.load,
            prescribed: values.as_deref(),
            gap: &wavy.gap,
            law: FrictionLaw::Coulomb(&mu),
            reference_slip: None,
        };
        let solved = series.solve_cases(&[case], &full(), Starts::Previous(None), None);
        let one = solved.into_iter().next().unwrap().unwrap();
        let start = None;
        let other = alone.solve(&case, &full(), start, &mut Monitor::new(&full(), None)).unwrap();
        for solution in [&one, &other] {
            assert_eq!(solution.status, Status::Solved, "{k}: {}", solution.message);
        }
        // Friction .3 leaves one solution here; both are certified to 1e-10 of the forces.
        assert!(largest(&difference(&one.d, &other.d)) <= 1e-8 * largest(&other.d), "{k}");
        let counts = (one.factorisations, other.factorisations);
        assert!(k == 0 || counts.0 < counts.1, "{k}: {counts:?}");
    }
}

/// All unknowns of a load case are known when it ends: they are those that a new model recovers from its `d`, to the
/// tolerance of forces, and other loads do not get them.
#[test]
fn displacements_of_the_last_case_are_those_of_any_case() {
    let stack = Stack::new([9, 7], [2000.0, 700.0]);
    let model = || stacked(&stack, &stack.bottom(), &full());
    let (load, other) = (stack.load(7.0, 2.0), stack.load(5.0, 1.0));
    let (one, new) = (model(), model());
    let solution = solve(&one, &load, FrictionLaw::Coulomb(&[0.4; 8]), &full());
    assert_eq!(solution.status, Status::Solved, "{}", solution.message);
    for load in [&load, &other, &load] {
        let [u, v] =
            [&one, &new].map(|model| model.recover(Some(load), None, &solution.d).unwrap());
        assert!(largest(&difference(&u, &v)) <= 1e-9 * largest(&v));
    }
}

/// Obstacles that nothing can reach, and pairs without one, change nothing.
#[test]
fn far_obstacles_change_nothing() {
    let wavy = Wavy::plane(32);
    let model = wavy.try_model(&mut Monitor::new(&full(), None)).unwrap();
    let mu = vec![0.3; 33];
    let solve = |far: f64| {
        let gap: Vec<f64> = wavy
            .gap
            .iter()
            .enumerate()
            .map(|(i, gap)| if i % 5 == 1 { far } else { *gap })
            .collect();
        let case = LoadCase {
            load: &wavy.load,
            prescribed: None,
            gap: &gap,
            law: FrictionLaw::Coulomb(&mu),
            reference_slip: None,
        };
        let solution = model.solve(&case, &full(), None, &mut Monitor::new(&full(), None)).unwrap();
        assert_eq!(solution.status, Status::Solved, "{far}: {}", solution.message);
        solution.d
    };
    let without = solve(f64::INFINITY);
    for far in [1.0, 1e8, 1e300] {
        assert!(largest(&difference(&solve(far), &without)) <= 1e-9 * largest(&without), "{far}");
    }
}

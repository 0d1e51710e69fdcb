//! Many load cases of a model at once: more than fill a block, with wrong ones between them.

use crate::common::dense::{difference, largest};
use crate::common::mesh::{Mesh, Pairs, steps};
use fastrand::Rng;
use signorini::reduce::{ContactPairs, Indices, SolvedCase, SparseMatrix, Triangle};
use signorini::{
    Argument, Error, FrictionLaw, LoadCase, Method, Model, Monitor, Settings, Solution, Starts,
    Status,
};

const PAIRS: usize = 9;

/// More than two blocks of 32, and not a multiple.
const CASES: usize = 71;

/// A block on a block that stands on a plate which moves.
struct Blocks {
    model: Model,
    fixed: usize,
    loads: Vec<Vec<f64>>,
    prescribed: Vec<Vec<f64>>,
    gaps: Vec<Vec<f64>>,
}

impl Blocks {
    fn new(full_space: bool) -> Blocks {
        let mut mesh = Mesh::default();
        let x = steps(0.0, 3.0, PAIRS - 1);
        let lower = mesh.block(&x, &steps(0.0, 1.0, 3), (2000.0, 0.3));
        let upper = mesh.block(&x, &steps(1.0, 2.0, 3), (700.0, 0.3));
        let fixed: Vec<usize> =
            lower.row(0).iter().flat_map(|node| [2 * node, 2 * node + 1]).collect();
        let pairs = Pairs::matching(&upper.row(0), &lower.row(3), [0.0, -1.0]);
        let settings = Settings { full_space, ..Settings::default() };
        let monitor = &mut Monitor::new(&settings, None);
        let model = mesh.stiffness().model_under(&fixed, &pairs.view(), monitor).unwrap();
        let mut rng = Rng::with_seed(12);
        let mut random = |length: usize, size: f64| {
            (0..CASES).map(|_| (0..length).map(|_| size * rng.f64()).collect()).collect()
        };
        let (prescribed, gaps) = (random(fixed.len(), 1e-3), random(PAIRS, 1e-3));
        let mut loads: Vec<Vec<f64>> = random(mesh.size(), 1e-2);
        for (k, load) in loads.iter_mut().enumerate() {
            mesh.traction(&upper.row(3), [0.1 + 0.002 * k as f64, -2.0], load);
        }
        Blocks { model, fixed: fixed.len(), loads, prescribed, gaps }
    }

    fn cases(&self) -> Vec<LoadCase<'_>> {
        let case = |k: usize| LoadCase {
            load: &self.loads[k],
            prescribed: (!k.is_multiple_of(3)).then_some(&self.prescribed[k][..]),
            gap: &self.gaps[k],
            law: FrictionLaw::Coulomb(&[0.4; PAIRS]),
            reference_slip: None,
        };
        (0..CASES).map(case).collect()
    }

    fn all(&self, starts: Starts<'_>) -> Vec<Solution> {
        let solved = self.model.solve_cases(&self.cases(), &settings(), starts, None);
        let checked = |solution: Result<Solution, Error>| {
            let solution = solution.unwrap();
            assert_eq!(solution.status, Status::Solved, "{}", solution.message);
            solution
        };
        solved.into_iter().map(checked).collect()
    }

    fn one(&self, k: usize, start: Option<&[f64]>) -> Solution {
        let monitor = &mut Monitor::new(&settings(), None);
        self.model.solve(&self.cases()[k], &settings(), start, monitor).unwrap()
    }
}

fn settings() -> Settings {
    Settings { tolerance: 1e-12, ..Settings::default() }
}

/// The tolerance of 1e-12 times a condition of 1e3; a block only rounds otherwise than a single case.
const SAME: f64 = 1e-9;

fn same(one: &[f64], two: &[f64], what: &str) {
    assert_eq!(one.len(), two.len(), "{what}");
    let apart = largest(&difference(one, two));
    assert!(apart <= SAME * largest(two), "{what}: {apart:e}");
}

/// Condensed and in full space.
#[test]
fn all_at_once_are_the_same_as_one_by_one() {
    for full_space in [false, true] {
        let blocks = Blocks::new(full_space);
        assert_eq!(blocks.model.is_matrix_free(), full_space);
        let (all, cases) = (blocks.all(Starts::Cold), blocks.cases());
        let solved: Vec<_> = (cases.iter().zip(&all))
            .map(|(case, solution)| SolvedCase {
                load: Some(case.load),
                prescribed: case.prescribed,
                d: &solution.d,
            })
            .collect();
        let recovered = blocks.model.recover_cases(&solved).unwrap();
        assert_eq!((all.len(), recovered.len()), (CASES, CASES));
        for k in 0..CASES {
            let one = blocks.one(k, None);
            same(&all[k].d, &one.d, &format!("d of case {k}"));
            same(&all[k].certificate.force, &one.certificate.force, &format!("F of case {k}"));
            assert_eq!(all[k].certificate.states, one.certificate.states, "case {k}");
            let case = &solved[k];
            let u = blocks.model.recover(case.load, case.prescribed, case.d).unwrap();
            same(&recovered[k], &u, &format!("u of case {k}"));
        }
    }
}

/// Given starts are those of the cases; the previous start is the solution of the case before.
#[test]
fn starts_are_those_of_the_cases() {
    let blocks = Blocks::new(false);
    let cold = blocks.all(Starts::Cold);
    let at_the_end: Vec<f64> = cold.iter().flat_map(|solution| solution.d.clone()).collect();
    for starts in [Starts::Given(&at_the_end), Starts::Previous(None)] {
        let warm = blocks.all(starts);
        for (k, (warm, cold)) in warm.iter().zip(&cold).enumerate() {
            same(&warm.d, &cold.d, &format!("{starts:?}, case {k}"));
        }
    }
    // A case again and again: only the first one has anything to do.
    let settings = Settings { method: Method::SorNested, ..settings() };
    let again = vec![blocks.cases()[5]; CASES];
    let solve = |starts| -> Vec<u64> {
        let solved = blocks.model.solve_cases(&again, &settings, starts, None);
        solved.into_iter().map(|solution| solution.unwrap().iterations).collect()
    };
    let (cold, warm) = (solve(Starts::Cold), solve(Starts::Previous(None)));
    assert!(cold.iter().all(|iterations| *iterations == cold[0]), "{cold:?}");
    assert_eq!(warm[0], cold[0]);
    assert!(warm[1..].iter().all(|iterations| *iterations < cold[0]), "{warm:?}");
    // A start of the wrong length is told, for each case that has none.
    let short = blocks.model.solve_cases(&again, &settings, Starts::Given(&at_the_end[1..]), None);
    let wrong = |found: &Result<Solution, Error>| {
        matches!(found, Err(Error::Invalid { argument: Argument::Start, .. }))
    };
    assert!(short[..CASES - 1].iter().all(Result::is_ok) && wrong(&short[CASES - 1]));
}

/// Wrong cases, one in each block and one at its end, say what is wrong, and others do not feel them; the
/// start goes around them.
#[test]
fn a_wrong_case_does_not_stop_the_others() {
    let mut blocks = Blocks::new(false);
    let right = blocks.all(Starts::Cold);
    blocks.loads[3][7] = f64::NAN;
    blocks.prescribed[31] = vec![0.0; blocks.fixed + 1];
    blocks.gaps[40][2] = f64::NAN;
    blocks.loads[70].pop();
    let wrong = [
        (3, Argument::Load, "f[7] is not finite"),
        (31, Argument::Prescribed, "prescribed has 19 entries, it must have 18"),
        (40, Argument::Gap, "gap[2]"),
        (70, Argument::Load, "f has 143 entries, it must have 144"),
    ];
    for starts in [Starts::Cold, Starts::Previous(None)] {
        let solved = blocks.model.solve_cases(&blocks.cases(), &settings(), starts, None);
        for (k, found) in solved.iter().enumerate() {
            match (found, wrong.iter().find(|(case, ..)| *case == k)) {
                (Ok(found), None) => same(&found.d, &right[k].d, &format!("case {k}")),
                (Err(Error::Invalid { argument, message }), Some((_, wanted, words))) => {
                    assert_eq!(argument, wanted, "case {k}: {message}");
                    assert!(message.contains(words), "case {k}: {message}");
                }
                (found, _) => panic!("case {k}: {found:?}"),
            }
        }
    }
}

/// A recovery of many cases names the case, and recovers none.
#[test]
fn a_recovery_names_the_wrong_case() {
    let blocks = Blocks::new(false);
    let d = vec![0.0; 2 * PAIRS];
    let case = SolvedCase { load: Some(&blocks.loads[0]), prescribed: None, d: &d };
    let bad = vec![f64::INFINITY; 2 * PAIRS];
    let short = &blocks.loads[0][1..];
    for (wrong, argument, words) in [
        (SolvedCase { load: Some(short), ..case }, Argument::Load, "f has 143 entries"),
        (SolvedCase { prescribed: Some(&bad), ..case }, Argument::Prescribed, "prescribed[0]"),
        (SolvedCase { d: &bad, ..case }, Argument::Start, "d[0] is not finite"),
    ] {
        let cases = [&vec![case; 40][..], &[wrong]].concat();
        let Err(Error::Invalid { argument: found, message }) = blocks.model.recover_cases(&cases)
        else {
            panic!("{words}")
        };
        assert_eq!(found, argument, "{message}");
        assert!(message.starts_with(&format!("case 40: {words}")), "{message}");
        let alone = blocks.model.recover_cases(&[wrong]).unwrap_err().message();
        assert!(alone.starts_with(words), "{alone}");
    }
    assert!(blocks.model.recover_cases(&[]).unwrap().is_empty());
    assert!(blocks.model.solve_cases(&[], &settings(), Starts::Cold, None).is_empty());
}

/// The closed form of a column without lateral strain under a pressure p: u_y = -p y / E, nothing across, and
/// pressures p a / 2 and p a at nodes whose elements have the width a.
#[test]
fn columns_under_many_pressures() {
    let (young, width) = (50.0, 0.5);
    let mut mesh = Mesh::default();
    let column = mesh.block(&steps(0.0, 4.0, PAIRS - 1), &steps(0.0, 2.0, 4), (young, 0.0));
    let fixed: Vec<usize> = column.column(0).iter().map(|node| 2 * node).collect();
    let pairs = Pairs::on_obstacle(&column.row(0), [0.0, -1.0]);
    let model = mesh.stiffness().model(&fixed, &pairs).unwrap();
    let pressure = |k: usize| 0.1 * (1 + k) as f64;
    let loads: Vec<Vec<f64>> = (0..CASES)
        .map(|k| {
            let mut load = vec![0.0; mesh.size()];
            mesh.traction(&column.row(4), [0.0, -pressure(k)], &mut load);
            load
        })
        .collect();
    let case = |load| LoadCase {
        load,
        prescribed: None,
        gap: &[0.0; PAIRS],
        law: FrictionLaw::Frictionless,
        reference_slip: None,
    };
    let cases: Vec<_> = loads.iter().map(|load| case(load)).collect();
    let solutions: Vec<_> = (model.solve_cases(&cases, &settings(), Starts::Cold, None))
        .into_iter()
        .map(|solution| solution.unwrap())
        .collect();
    let solved: Vec<_> = (solutions.iter().zip(&loads))
        .map(|(solution, load)| SolvedCase { load: Some(load), prescribed: None, d: &solution.d })
        .collect();
    let recovered = model.recover_cases(&solved).unwrap();
    for (k, (solution, u)) in solutions.iter().zip(&recovered).enumerate() {
        assert_eq!(solution.status, Status::Solved, "case {k}");
        let p = pressure(k);
        for (pair, force) in solution.certificate.force.chunks(2).enumerate() {
            let share = if pair == 0 || pair == PAIRS - 1 { 0.5 } else { 1.0 };
            assert!((force[0] + share * p * width).abs() <= SAME * p, "case {k}: {force:?}");
        }
        let exact: Vec<f64> =
            mesh.nodes.iter().flat_map(|node| [0.0, -p * node[1] / young]).collect();
        same(u, &exact, &format!("u of case {k}"));
    }
}

/// Two nodes on springs of stiffness 1, but for one of 0.1: a load of 1e307 on it moves its node by 1e308, which is
/// a double; one of 1e308 by 1e309, which is none.
#[test]
fn displacements_that_overflow_are_refused() {
    let matrix = SparseMatrix {
        size: 4,
        col_start: Indices::Wide(&[0, 1, 2, 3, 4]),
        row: Indices::Wide(&[0, 1, 2, 3]),
        values: &[1.0, 1.0, 0.1, 1.0],
        index_base: 0,
        triangle: Triangle::Lower,
    };
    let pairs = ContactPairs {
        dim: 2,
        count: 1,
        slaves: &[0, 1],
        master_start: &[0, 0],
        masters: &[],
        weights: &[],
        normals: &[1.0, 1.0],
        tangents: None,
        ..ContactPairs::default()
    };
    let model = Model::sparse(&matrix, &[], &pairs).unwrap();
    let (small, large) = ([0.0, 0.0, 1e307, 0.0], [0.0, 0.0, 1e308, 0.0]);
    let case = |load| SolvedCase { load: Some(load), prescribed: None, d: &[0.0, 0.0] };
    let moved = model.recover(Some(&small), None, &[0.0, 0.0]).unwrap()[2];
    // One division.
    assert!((moved / 1e308 - 1.0).abs() <= f64::EPSILON);
    let told = |error: Error| match error {
        Error::Invalid { argument, message } => (argument, message.to_string()),
        other => panic!("{other}"),
    };
    let (argument, message) = told(model.recover(Some(&large), None, &[0.0, 0.0]).unwrap_err());
    assert!(argument == Argument::Start && message.starts_with("u[2] overflows"), "{message}");
    let cases: Vec<_> =
        (0..40).map(|k| case(if k == 35 { &large[..] } else { &small[..] })).collect();
    let (_, message) = told(model.recover_cases(&cases).unwrap_err());
    assert!(message.starts_with("case 35: u[2] overflows"), "{message}");
    // Along the axes, at 45 degrees to the pair's frame, the components of a force add up to 2.4e308.
    let (argument, message) = told(model.nodal_forces(&[1.7e308, 1.7e308]).unwrap_err());
    assert!(argument == Argument::Load && message.contains("overflows"), "{message}");
}

/// A model of a condensed matrix holds nothing fixed, so that an empty array of fixed values says as much as none,
/// and its displacements are those of the host: several cases come back as they are.
#[test]
fn a_condensed_model_gives_the_displacements_of_its_cases_back() {
    let model = Model::condensed(2, 1, &[2.0, 0.0, 0.0, 1.0], 2).unwrap();
    let law = FrictionLaw::Coulomb(&[0.5]);
    let load = &[1.0, 0.25];
    let solve = |prescribed| {
        let case = LoadCase { load, prescribed, gap: &[0.0], law, reference_slip: None };
        model.solve(&case, &settings(), None, &mut Monitor::new(&settings(), None)).unwrap()
    };
    let (none, empty) = (solve(None), solve(Some(&[])));
    assert_eq!(none.status, Status::Solved, "{}", none.message);
    assert_eq!(empty.d, none.d);
    let d = [[0.0, 0.25], [-1.0, 3.0]];
    let cases = d.each_ref().map(|d| SolvedCase { load: Some(load), prescribed: None, d });
    assert_eq!(model.recover_cases(&cases).unwrap(), d.map(Vec::from));
}

//! Rows by degree of freedom, and equations between degrees of freedom: random structures of any kind, and what is
//! refused.

use crate::common::problems::{uniform, vector};
use crate::constrained::{Constrained, EquationArrays, Terms, close, solved};
use crate::rows::springs;
use fastrand::Rng;
use signorini::reduce::{ContactPairs, Indices, SparseMatrix, Triangle};
use signorini::{Argument, Error, FrictionLaw, LoadCase, Model, Monitor, Settings, Status};

/// A structure with equations in chains, some without terms, whose rows have a degree of freedom of their own each,
/// and others.
fn any_structure(rng: &mut Rng) -> Constrained {
    let dim = rng.usize(2..=3);
    let (size, pairs) = (rng.usize(20..=30), rng.usize(1..=3));
    let mut order: Vec<usize> = (0..size).collect();
    rng.shuffle(&mut order);
    // Dependents, each of those that come later; then what rows have for themselves.
    let dependents = rng.usize(1..=6);
    let terms = |rng: &mut Rng, k: usize| -> Terms {
        let count = rng.usize(0..=3);
        (0..count).map(|_| (order[rng.usize(k + 1..size)], uniform(rng, -1.0, 1.0))).collect()
    };
    let equations = (0..dependents).map(|k| (order[k], terms(rng, k))).collect();
    let mut own = order[dependents..].iter();
    let mut row = |rng: &mut Rng| {
        let mut row: Vec<(usize, Vec<f64>)> = Vec::new();
        for axis in 0..dim {
            let mut unit = vec![0.0; dim];
            unit[axis] = uniform(rng, 0.5, 1.5);
            row.push((*own.next().unwrap(), unit));
        }
        let others = rng.usize(0..=4);
        row.extend((0..others).map(|_| (order[rng.usize(0..size)], vector(rng, dim))));
        row
    };
    let rows = (0..pairs).map(|_| row(rng)).collect();
    let is_fixed = |_: &usize| rng.u8(0..4) == 0;
    let fixed = order[dependents + dim * pairs..].iter().copied().filter(is_fixed).collect();
    let normals = vector(rng, dim * pairs);
    let stiffness = springs(rng, size);
    Constrained { dim, stiffness, fixed, equations, rows, normals, tangents: None }
}

/// The whole matrix, a host's elimination with numbers beyond its matrix, and rows in independents alone have the same
/// stiffness, loads, forces and displacements: to 1e-9, as rows are random and nearly dependent at times.
#[test]
fn three_hosts_have_one_model() {
    let mut independent = 0;
    for seed in 0..200 {
        let rng = &mut Rng::with_seed(seed);
        let structure = any_structure(rng);
        let settings = Settings::default();
        let [whole, eliminated] = [structure.whole(&settings), structure.eliminated(&settings)];
        let reduced = structure.reduced().whole(&settings);
        if !whole.dependent_pairs().is_empty() {
            continue;
        }
        let context = |what: &str| format!("seed {seed}: {what}");
        let load = vector(rng, structure.size());
        let values = vector(rng, structure.fixed.len());
        let d = vector(rng, structure.dim * structure.rows.len());
        let gathered = structure.gathered(&load);
        let independents = structure.independents();
        let of_independents =
            |u: &[f64]| independents.iter().map(|&dof| u[dof]).collect::<Vec<f64>>();
        let stiffness = whole.stiffness();
        let condensed = whole.condensed_load(&load, Some(&values)).unwrap();
        let u = whole.recover(Some(&load), Some(&values), &d).unwrap();
        let nodal = whole.nodal_forces(&d).unwrap();
        for host in [&eliminated, &reduced] {
            assert_eq!(host.frames(), whole.frames());
            close(host.stiffness(), stiffness, 1e-9, &context("K_rel"));
            let other = host.condensed_load(&gathered, Some(&values)).unwrap();
            close(&other, &condensed, 1e-9, &context("f"));
            let other = host.recover(Some(&gathered), Some(&values), &d).unwrap();
            close(&other, &of_independents(&u), 1e-9, &context("u"));
            let other = host.nodal_forces(&d).unwrap();
            close(&other, &of_independents(&nodal), 1e-9, &context("Bᵀ F"));
        }
        for (dof, terms) in &structure.equations {
            let sum: f64 = terms.iter().map(|(other, a)| a * u[*other]).sum();
            assert!((u[*dof] - sum).abs() <= 1e-12 * (1.0 + sum.abs()), "seed {seed}: u[{dof}]");
            assert_eq!(nodal[*dof], 0.0, "seed {seed}");
        }
        independent += 1;
    }
    assert!(independent > 100, "{independent}");
}

/// Coefficients of the size of rounding, as of turns by right angles, say that a displacement moves another one by nothing: rows over
/// many nodes, some of which stand on a plane, have the stiffness and the loads of a host that has eliminated them. To 1e-9, as above.
#[test]
fn coefficients_of_rounding_move_nothing() {
    for (seed, small) in (0..100).flat_map(|seed| [1e-17, 6e-17, 1e-12, 1e-9].map(|a| (seed, a))) {
        let rng = &mut Rng::with_seed(seed);
        let (dim, nodes, pairs) = (rng.usize(2..=3), rng.usize(6..=9), rng.usize(1..=4));
        let on_plane = rng.usize(1..=nodes - pairs);
        // Another displacement of the node, or one of a node that no row names.
        let across = |node: usize| {
            let other = if rng.bool() { dim * node + 1 } else { dim * nodes };
            (dim * node, vec![(other, small * uniform(rng, 0.5, 1.0))])
        };
        let equations = (0..on_plane).map(across).collect();
        let mut row = || {
            let weights = vector(rng, nodes);
            let of_node = |(node, weight): (usize, f64)| {
                let along = move |axis: usize| {
                    let mut unit = vec![0.0; dim];
                    unit[axis] = weight;
                    (dim * node + axis, unit)
                };
                (0..dim).map(along)
            };
            weights.into_iter().enumerate().flat_map(of_node).collect()
        };
        let rows = (0..pairs).map(|_| row()).collect();
        let (stiffness, normals) = (springs(rng, dim * nodes + 1), vector(rng, dim * pairs));
        let fixed = vec![];
        let structure =
            Constrained { dim, stiffness, fixed, equations, rows, normals, tangents: None };
        let settings = Settings::default();
        let [whole, reduced] = [&structure, &structure.reduced()].map(|host| host.whole(&settings));
        let context = format!("seed {seed}, {small:e}");
        assert!(whole.dependent_pairs().is_empty(), "{context}");
        close(whole.stiffness(), reduced.stiffness(), 1e-9, &context);
        let load = vector(rng, structure.size());
        let [own, other] = [whole.condensed_load(&load, None), {
            reduced.condensed_load(&structure.gathered(&load), None)
        }];
        close(&own.unwrap(), &other.unwrap(), 1e-9, &context);
    }
}

/// Solutions balance in the whole structure, whose forces are found without the library; condensed and in full
/// space. To 1e-9, a thousand times the tolerance.
#[test]
fn solutions_balance_in_the_whole_structure() {
    let mut solutions = 0;
    for seed in 0..60 {
        let rng = &mut Rng::with_seed(seed);
        let structure = any_structure(rng);
        let load: Vec<f64> = vector(rng, structure.size()).iter().map(|f| 3.0 * f).collect();
        let gap: Vec<f64> = vector(rng, structure.rows.len()).iter().map(|g| g.abs()).collect();
        for full_space in [false, true] {
            let settings = Settings { full_space, ..Settings::default() };
            let whole = structure.whole(&settings);
            assert_eq!(whole.is_matrix_free(), full_space && whole.dependent_pairs().is_empty());
            let solution = solved(&whole, &load, &gap, 0.2);
            let u = whole.recover(Some(&load), None, &solution.d).unwrap();
            let nodal = whole.nodal_forces(&solution.certificate.force).unwrap();
            let given = (whole.frames().unwrap(), &load[..]);
            structure.assert_balanced(given, &solution, (&u, &nodal), 1e-9);
            solutions += usize::from(solution.certificate.force.iter().any(|f| *f != 0.0));
        }
    }
    assert!(solutions > 40, "{solutions} with contact");
}

/// A pair whose sides move alike by equations, and one of what equations hold, move nothing and carry nothing; the other
/// one has what it has alone.
#[test]
fn pairs_that_equations_hold_rest() {
    let along = || vec![(0, vec![1.0, 0.0]), (1, vec![0.0, 1.0])];
    let alike = vec![(0, vec![1.0, 0.0]), (4, vec![-1.0, 0.0])];
    let equations = vec![(4, vec![(0, 1.0)]), (5, vec![])];
    let rows = vec![alike, along(), vec![(5, vec![0.0, 1.0])]];
    let model = Small { rows, equations, fixed: vec![] }.model().unwrap();
    let alone = Small { rows: vec![along()], equations: vec![], fixed: vec![] }.model().unwrap();
    assert!(model.dependent_pairs().is_empty());
    let load = [1.0, -4.0];
    let solution = solved(&model, &load, &[0.0; 3], 0.5);
    let expected = solved(&alone, &load, &[0.0], 0.5);
    close(&solution.d[2..4], &expected.d, 1e-12, "d");
    let force = &solution.certificate.force;
    close(&force[2..4], &expected.certificate.force, 1e-12, "F");
    let rest = [&solution.d[..2], &solution.d[4..], &force[..2], &force[4..]].concat();
    assert_eq!(rest, [0.0; 8]);
    close(
        &model.recover(Some(&load), None, &solution.d).unwrap(),
        &alone.recover(Some(&load), None, &expected.d).unwrap(),
        1e-12,
        "u",
    );
}

/// A chain of a thousand equations in any order is one of its ends.
#[test]
fn long_chains_are_followed() {
    let rng = &mut Rng::with_seed(1);
    let mut equations: Vec<(usize, Terms)> =
        (0..1000).map(|k| (k + 2, vec![(k + 1, 1.0)])).collect();
    rng.shuffle(&mut equations);
    let one = |dof: usize| {
        let rows = vec![vec![(0, vec![1.0, 0.0]), (dof, vec![0.0, 1.0])]];
        let pairs = Small { rows, equations: equations.clone(), fixed: vec![] };
        pairs.model().unwrap().stiffness().to_vec()
    };
    assert_eq!(one(1001), one(1));
}

/// A term with coefficient 0 says nothing: it makes no circle, in any order.
#[test]
fn terms_of_nothing_are_none() {
    let along = |dof: usize| vec![vec![(0, vec![1.0, 0.0]), (dof, vec![0.0, 1.0])]];
    let stiffness = |dof: usize, equations: Vec<(usize, Terms)>| {
        let small = Small { rows: along(dof), equations, fixed: vec![] };
        small.model().unwrap().stiffness().to_vec()
    };
    let plain = stiffness(1, vec![]);
    let (follows, closes) = ((5, vec![(6, 1.0)]), (6, vec![(5, 0.0), (1, 1.0)]));
    assert_eq!(stiffness(5, vec![follows.clone(), closes.clone()]), plain);
    assert_eq!(stiffness(5, vec![closes, follows]), plain);
    assert_eq!(stiffness(5, vec![(5, vec![(5, 0.0), (1, 1.0)])]), plain);
}

/// Two springs of 2 and 3, one pair, degrees of freedom 0 and 1.
struct Small {
    rows: Vec<Vec<(usize, Vec<f64>)>>,
    equations: Vec<(usize, Terms)>,
    fixed: Vec<usize>,
}

impl Small {
    fn model(&self) -> Result<Model, Error> {
        self.with(&EquationArrays::new(&self.equations))
    }

    fn with(&self, equations: &EquationArrays) -> Result<Model, Error> {
        let (mut start, mut dofs, mut vectors) = (vec![0], vec![], vec![]);
        for row in &self.rows {
            dofs.extend(row.iter().map(|(dof, _)| *dof));
            vectors.extend(row.iter().flat_map(|(_, vector)| vector));
            start.push(dofs.len());
        }
        let matrix = SparseMatrix {
            size: 2,
            col_start: Indices::Wide(&[0, 1, 2]),
            row: Indices::Wide(&[0, 1]),
            values: &[2.0, 3.0],
            index_base: 0,
            triangle: Triangle::Lower,
        };
        let pairs = ContactPairs {
            dim: 2,
            count: self.rows.len(),
            master_start: &start,
            masters: &dofs,
            vectors: Some(&vectors),
            normals: &[0.0, -1.0].repeat(self.rows.len()),
            equations: equations.view(),
            ..ContactPairs::default()
        };
        Model::sparse(&matrix, &self.fixed, &pairs)
    }
}

/// A direction along which a row moves by rounding beside its others, as what is left of a plane of symmetry, is one along
/// which nothing moves: springs of 2e31 there would hide all forces.
#[test]
fn a_direction_of_rounding_does_not_move() {
    let normal = |rest: f64| {
        let rows = vec![vec![(0, vec![rest, 1.0]), (1, vec![-0.3 * rest, -1.0])]];
        Small { rows, equations: vec![], fixed: vec![] }.model().unwrap()
    };
    let load = [-2e-3, 1e-3];
    let solved = |model: &Model| {
        let case = LoadCase {
            load: &load,
            prescribed: None,
            gap: &[0.0],
            law: FrictionLaw::Coulomb(&[0.3]),
            reference_slip: None,
        };
        let settings = Settings::default();
        model.solve(&case, &settings, None, &mut Monitor::new(&settings, None)).unwrap()
    };
    let [exact, rounded] = [0.0, 3e-16].map(|rest| solved(&normal(rest)));
    // Springs of 2 and 3, alone, would be at -1e-3 and 1/3e-3; in a row they have a stiffness of 6/5. To rounding of 1e-3.
    for solution in [exact, rounded] {
        assert_eq!(solution.status, Status::Solved);
        let force = &solution.certificate.force;
        assert!((force[0] + 1.6e-3).abs() < 1e-17 && force[1] == 0.0, "{force:?}");
    }
}

fn refused(made: Result<Model, Error>, argument: Argument, part: &str) {
    match made {
        Ok(_) => panic!("'{part}': accepted"),
        Err(Error::Invalid { argument: named, message }) => {
            assert_eq!(named, argument, "{message}");
            assert!(message.contains(part), "'{part}' is not in '{message}'");
        }
        Err(other) => panic!("{other}"),
    }
}

#[test]
fn what_is_wrong_is_named() {
    let along = || vec![(0, vec![1.0, 0.0]), (1, vec![0.0, 1.0])];
    let rows = |row: Vec<(usize, Vec<f64>)>, part: &str| {
        let small = Small { rows: vec![row], equations: vec![], fixed: vec![] };
        refused(small.model(), Argument::Pairs, part);
    };
    let zero = || vec![0.0; 2];
    rows(vec![], "pair 0: it has no degree of freedom with a vector that is not zero");
    rows(vec![(0, zero()), (1, zero())], "pair 0: it has no degree of freedom with a vector");
    rows(vec![(0, vec![0.0, f64::NAN])], "pair 0: the vector of degree of freedom 0 is not finite");
    rows(vec![(2, vec![1.0; 2])], "pair 0: there is no degree of freedom 2");

    let equations = |equations: &[(usize, Terms)], part: &str| {
        let small = Small { rows: vec![along()], equations: equations.to_vec(), fixed: vec![] };
        refused(small.model(), Argument::Pairs, part);
    };
    let one = |dof: usize| vec![(dof, 1.0)];
    equations(
        &[(7, one(0)), (7, one(1))],
        "equation 1: it gives degree of freedom 7, as equation 0",
    );
    equations(
        &[(7, one(9))],
        "equation 0: there is no degree of freedom 9, and no equation gives it",
    );
    equations(&[(7, one(0)), (8, vec![(0, f64::NAN)])], "equation 1: a coefficient is not finite");
    equations(
        &[(7, one(0)), (8, vec![(0, 1e200)])],
        "equation 1: the coefficient of degree of freedom 0 overflows",
    );
    equations(
        &[(7, one(7))],
        "equation 0: its dependent degree of freedom follows from itself, by way of 7:",
    );
    let circle = [(6, one(7)), (7, one(8)), (8, one(9)), (9, vec![(0, 1.0), (7, 2.0)])];
    equations(
        &circle,
        "equation 1: its dependent degree of freedom follows from itself, by way of 7, 8, 9:",
    );
    let small = Small { rows: vec![along()], equations: vec![(1, one(0))], fixed: vec![1] };
    refused(
        small.model(),
        Argument::Fixed,
        "fixed: degree of freedom 1 is dependent by an equation",
    );
    let beyond = vec![(0, vec![1.0, 0.0]), (5, vec![0.0, 1.0])];
    let small = Small { rows: vec![beyond], equations: vec![(4, one(0))], fixed: vec![] };
    refused(
        small.model(),
        Argument::Pairs,
        "there is no degree of freedom 5, and no equation gives it",
    );
    rows(
        vec![(0, vec![1.0, 0.0]), (0, vec![-1.0, 0.0])],
        "pair 0: its weights cancel, so that no node",
    );

    let arrays = |change: fn(&mut EquationArrays), part: &str| {
        let small = Small { rows: vec![along()], equations: vec![], fixed: vec![] };
        let mut arrays = EquationArrays::new(&[(7, one(0)), (8, one(1))]);
        change(&mut arrays);
        refused(small.with(&arrays), Argument::Pairs, part);
    };
    arrays(|a| a.start.truncate(2), "equations: start has 2 entries, it must have 3");
    arrays(|a| a.start[1] = 3, "equation 1: its terms begin after they end");
    arrays(|a| a.start[0] = 1, "equations: start must lead from the first of dofs, which are 2,");
    arrays(|a| a.coefficients.truncate(1), "each of dofs must have a coefficient");
}

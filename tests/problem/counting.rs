//! Sentences count their indices from 0 with square brackets, and from 1 with round brackets for
//! Fortran; other numbers are the same in both.

use signorini::reduce::{ContactPairs, Equations, Indices, SparseMatrix, Triangle};
use signorini::{
    ContactData, ContactProblem, Error, FrictionLaw, Lcp, LoadCase, Message, Model, Monitor,
    Settings, Solution, Status, solve,
};

/// The sentence has `zero` as it is printed, and `one` in the same place counted from 1.
fn counts(message: &Message, zero: &str, one: &str) {
    assert!(message.contains(zero), "'{zero}' is not in '{message}'");
    let fortran = message.counted_from_one();
    assert!(fortran.contains(one), "'{one}' is not in '{fortran}'");
    for text in [&message.to_string(), &fortran] {
        assert!(text.chars().all(|c| c.is_ascii() && !c.is_control()), "a mark is left: {text:?}");
    }
}

fn refused<T>(result: Result<T, Error>, zero: &str, one: &str) {
    let Err(error) = result else { panic!("'{zero}': accepted") };
    counts(&error.message(), zero, one);
}

const DIAGONAL: [f64; 16] =
    [4.0, 0.0, 0.0, 0.0, 0.0, 4.0, 0.0, 0.0, 0.0, 0.0, 4.0, 0.0, 0.0, 0.0, 0.0, 4.0];

/// Two pairs in the plane.
const GOOD: ContactData<'static> = ContactData {
    dim: 2,
    pairs: 2,
    stiffness: &DIAGONAL,
    ld: 4,
    load: &[1.0; 4],
    gap: &[0.0; 2],
    law: FrictionLaw::Frictionless,
    reference_slip: None,
};

/// `K` with entry `(i, j)` replaced.
fn changed(i: usize, j: usize, value: f64) -> [f64; 16] {
    let mut k = DIAGONAL;
    k[i + 4 * j] = value;
    k
}

#[test]
fn of_condensed_problems() {
    let refused = |data: ContactData<'_>, zero: &str, one: &str| {
        refused(ContactProblem::new(data), zero, one);
    };
    let k = |i, j, value, zero, one| {
        refused(ContactData { stiffness: &changed(i, j, value), ..GOOD }, zero, one);
    };
    k(2, 1, f64::NAN, "K[2,1] is not finite", "K(3,2) is not finite");
    k(3, 3, -1.0, "K[3,3] is -1, it", "K(4,4) is -1, it");
    let mut zero = changed(3, 1, 1.0);
    (zero[5], zero[1 + 4 * 3]) = (0.0, 1.0);
    let data = ContactData { stiffness: &zero, ..GOOD };
    refused(data, "K[1,1] is 0, it must be positive: K[3,1] is 1", "K(2,2) is 0, it must be");
    k(3, 1, 1.0, "K[3,1] is 1, K[1,3] is 0", "K(4,2) is 1, K(2,4) is 0");
    let mut indefinite = changed(3, 1, 9.0);
    indefinite[1 + 4 * 3] = 9.0;
    let data = ContactData { stiffness: &indefinite, ..GOOD };
    refused(data, "K[3,1] is 9, more", "K(4,2) is 9, more");
    let data = ContactData { load: &[0.0, f64::NAN, 0.0, 0.0], ..GOOD };
    refused(data, "f[1] is not", "f(2) is not");
    let data = ContactData { gap: &[0.0, f64::NAN], ..GOOD };
    refused(data, "gap[1] is NaN", "gap(2) is NaN");
    let data = ContactData { law: FrictionLaw::Coulomb(&[0.0, -1.0]), ..GOOD };
    refused(data, "mu[1] is -1, it", "mu(2) is -1, it");
    let data = ContactData { reference_slip: Some(&[f64::NAN, 0.0]), ..GOOD };
    refused(data, "slip0[0] is not", "slip0(1) is not");
    // Numbers that are no indices.
    refused(
        ContactData { dim: 4, ..GOOD },
        "dim is 4, it must be 2 or 3",
        "dim is 4, it must be 2",
    );
    let data = ContactData { load: &[0.0; 3], ..GOOD };
    refused(data, "f has 3 entries, it must have 4", "f has 3 entries, it must have 4");
}

#[test]
fn of_lcps_starts_and_models() {
    let lcp = |m: &[f64], q: &[f64], cover: &[f64], zero, one| {
        refused(Lcp::new(2, m, 2, q, Some(cover)), zero, one);
    };
    let m = [1.0, 0.0, 0.0, 1.0];
    lcp(&[1.0, f64::NAN, 0.0, 1.0], &[1.0; 2], &[1.0; 2], "M[1,0] is not", "M(2,1) is not");
    lcp(&m, &[1.0, f64::NAN], &[1.0; 2], "q[1] is not", "q(2) is not");
    lcp(&m, &[1.0; 2], &[1.0, 0.0], "cover[1] is 0, it", "cover(2) is 0, it");

    let problem = ContactProblem::new(GOOD).unwrap();
    let settings = Settings { omega: 3.0, ..Settings::default() };
    let run = |settings: &Settings, start: &[f64]| {
        solve(&problem, settings, Some(start), &mut Monitor::new(settings, None))
    };
    refused(run(&settings, &[0.0; 4]), "omega is 3, it must", "omega is 3, it must");
    let start = [0.0, 0.0, f64::NAN, 0.0];
    refused(run(&Settings::default(), &start), "the start d[2] is not", "the start d(3) is not");

    let model = Model::condensed(2, 2, &DIAGONAL, 4).unwrap();
    refused(model.nodal_forces(&[0.0, 0.0, 0.0, f64::NAN]), "F[3] is not", "F(4) is not");
    let loose = |k: &[f64]| Model::two_body(2, 1, (k, 2), (k, 2));
    let along = [1.0, 1.0, 1.0, 1.0];
    refused(loose(&along), "motion of component 1", "motion of component 2");
}

/// A host of two nodes on springs, in the plane, each the slave of a pair that faces an obstacle.
struct Host {
    col_start: [i64; 5],
    row: Vec<i64>,
    values: Vec<f64>,
    fixed: Vec<usize>,
    slaves: [usize; 4],
    master_start: [usize; 3],
    masters: Vec<usize>,
    weights: Vec<f64>,
    normals: [f64; 4],
}

impl Host {
    fn with(change: impl FnOnce(&mut Host)) -> Result<Model, Error> {
        let mut host = Host {
            col_start: [0, 1, 2, 3, 4],
            row: vec![0, 1, 2, 3],
            values: vec![1.0; 4],
            fixed: vec![],
            slaves: [0, 1, 2, 3],
            master_start: [0; 3],
            masters: vec![],
            weights: vec![],
            normals: [0.0, -1.0, 0.0, -1.0],
        };
        change(&mut host);
        let matrix = SparseMatrix {
            size: 4,
            col_start: Indices::Wide(&host.col_start),
            row: Indices::Wide(&host.row),
            values: &host.values,
            index_base: 0,
            triangle: Triangle::Lower,
        };
        let pairs = ContactPairs {
            dim: 2,
            count: 2,
            slaves: &host.slaves,
            master_start: &host.master_start,
            masters: &host.masters,
            weights: &host.weights,
            normals: &host.normals,
            tangents: None,
            ..ContactPairs::default()
        };
        Model::sparse(&matrix, &host.fixed, &pairs)
    }
}

#[test]
fn of_sparse_matrices() {
    let wrong = |change: fn(&mut Host), zero, one| refused(Host::with(change), zero, one);
    // The value is the host's own, counted from its base.
    wrong(|h| h.col_start[2] = 0, "col_start[2] is 0, less", "col_start(3) is 0, less");
    wrong(|h| h.col_start[2] = 0, "than col_start[1], which is 1", "than col_start(2), which is 1");
    wrong(|h| h.row[3] = 9, "row[3], in column 3, is 9", "row(4), in column 4, is 9");
    wrong(|h| h.values[1] = f64::NAN, "K[1,1] is not finite", "K(2,2) is not finite");
    wrong(|h| h.values[1] = -1.0, "K[1,1] is -1, it", "K(2,2) is -1, it");
    wrong(|h| h.row[1] = 0, "K[0,1] is not in", "K(1,2) is not in");
    let held = |h: &mut Host| h.values[1] = 0.0;
    wrong(held, "resists degree of freedom 1: list", "resists degree of freedom 2: list");
    wrong(held, "(K[1,1] is 0)", "(K(2,2) is 0)");
    let two = |h: &mut Host| (h.col_start, h.row[1]) = ([0, 2, 2, 3, 4], 0);
    wrong(two, "column 0: row 0 is listed twice", "column 1: row 1 is listed twice");
    wrong(two, "in row[0] and row[1]: sum", "in row(1) and row(2): sum");
    let after = |h: &mut Host| (h.col_start, h.row) = ([0, 2, 2, 3, 4], vec![1, 0, 2, 3]);
    wrong(after, "column 0: row 0 stands after row 1", "column 1: row 1 stands after row 2");
}

#[test]
fn of_supports_and_pairs() {
    let wrong = |change: fn(&mut Host), zero, one| refused(Host::with(change), zero, one);
    wrong(|h| h.fixed = vec![4], "no degree of freedom 4", "no degree of freedom 5");
    wrong(
        |h| h.fixed = vec![1, 1],
        "degree of freedom 1 is listed",
        "degree of freedom 2 is listed",
    );
    let itself = |h: &mut Host| {
        (h.master_start, h.masters, h.weights) = ([0, 0, 1], vec![2, 3], vec![1.0]);
    };
    wrong(itself, "pair 1: its weights cancel", "pair 2: its weights cancel");
    let model = Host::with(|h| h.fixed = vec![2, 3]).unwrap();
    let lifted = model.condensed_load(&[0.0; 4], Some(&[1.0, 0.0]));
    refused(lifted, "both sides of pair 1 apart by 1,", "both sides of pair 2 apart by 1,");
    wrong(|h| h.normals[3] = 0.0, "pair 1: its normal", "pair 2: its normal");
    wrong(|h| h.slaves[3] = 4, "pair 1: there is no degree", "pair 2: there is no degree");
    wrong(|h| h.slaves[3] = 4, "of freedom 4", "of freedom 5");
    let twice = |h: &mut Host| h.slaves[3] = 2;
    wrong(twice, "pair 1: its slave has", "pair 2: its slave has");
    wrong(twice, "degree of freedom 2 twice", "degree of freedom 3 twice");
    wrong(
        |h| h.master_start = [1, 1, 1],
        "pair 0: its masters begin at 1",
        "pair 1: its masters begin at 2",
    );
    wrong(
        |h| h.master_start = [0, 1, 0],
        "pair 1: its masters begin after",
        "pair 2: its masters begin after",
    );
    // The number of masters is no index, nor is the sum of weights.
    wrong(|h| h.master_start = [0, 0, 1], "have 1 masters", "have 1 masters");
}

#[test]
fn of_equations() {
    let one = [Indices::Wide(&[0, 1, 2, 3, 4]), Indices::Wide(&[0, 1, 2, 3])];
    let matrix = SparseMatrix {
        size: 4,
        col_start: one[0],
        row: one[1],
        values: &[1.0; 4],
        index_base: 0,
        triangle: Triangle::Lower,
    };
    let wrong = |dependent: [usize; 2], dofs: [usize; 2], zero: &str, one: &str| {
        let equations = Equations {
            dependent: &dependent,
            start: &[0, 1, 2],
            dofs: &dofs,
            coefficients: &[1.0, 1.0],
        };
        let pairs = ContactPairs {
            dim: 2,
            count: 1,
            slaves: &[0, 8],
            master_start: &[0, 0],
            normals: &[0.0, -1.0],
            equations,
            ..ContactPairs::default()
        };
        refused(Model::sparse(&matrix, &[2], &pairs), zero, one);
    };
    wrong(
        [8, 8],
        [1, 1],
        "equation 1: it gives degree of freedom 8,",
        "equation 2: it gives degree of freedom 9,",
    );
    wrong([8, 8], [1, 1], "as equation 0 does", "as equation 1 does");
    wrong([8, 9], [9, 8], "equation 0: its dependent", "equation 1: its dependent");
    wrong([8, 9], [9, 8], "by way of 8, 9:", "by way of 9, 10:");
    wrong([8, 9], [1, 7], "there is no degree of freedom 7,", "there is no degree of freedom 8,");
    wrong([8, 2], [1, 1], "fixed: degree of freedom 2 is", "fixed: degree of freedom 3 is");
    wrong(
        [7, 9],
        [1, 1],
        "pair 0: there is no degree of freedom 8,",
        "pair 1: there is no degree of freedom 9,",
    );
}

/// Node 1 is held by nothing along (1, 1) and pulled away from its obstacle.
fn escaped(solution: &Solution, zero: &str, one: &str) {
    assert_eq!(solution.status, Status::NoEquilibrium, "{}", solution.message);
    counts(&solution.message, zero, one);
}

#[test]
fn of_motions_of_escape() {
    let settings = Settings::default();
    let mut k = changed(2, 3, -4.0);
    k[3 + 4 * 2] = -4.0;
    // (n, t), with n = (0, -1) and t = (1, 0): the motion (1, 1) of the host is (-1, 1).
    let load = [0.0, 0.0, -1.0, -1.0];
    let data = ContactData { stiffness: &k, load: &load, ..GOOD };
    let problem = ContactProblem::new(data).unwrap();
    let solution = solve(&problem, &settings, None, &mut Monitor::new(&settings, None)).unwrap();
    escaped(&solution, "1 of 2 pairs, most of all pair 1,", "1 of 2 pairs, most of all pair 2,");

    let case = |load| LoadCase {
        load,
        prescribed: None,
        gap: &[0.0; 2],
        law: FrictionLaw::Frictionless,
        reference_slip: None,
    };
    let run = |model: &Model, load| {
        model.solve(&case(load), &settings, None, &mut Monitor::new(&settings, None)).unwrap()
    };
    let model = Model::condensed(2, 2, &k, 4).unwrap();
    escaped(&run(&model, &load), "most of all pair 1 by (-1.000", "most of all pair 2 by (-1.000");

    let host = Host::with(|h| {
        (h.col_start, h.row) = ([0, 1, 2, 4, 5], vec![0, 1, 2, 3, 3]);
        h.values = vec![1.0, 1.0, 1.0, -1.0, 1.0];
    });
    let solution = run(&host.unwrap(), &[0.0, 0.0, 1.0, 1.0]);
    escaped(
        &solution,
        "2 of the degrees of freedom 2 to 3, most of all degree of freedom",
        "2 of the degrees of freedom 3 to 4, most of all degree of freedom",
    );
    escaped(&solution, "3 by 1.000", "4 by 1.000");
    escaped(&solution, "slave of pair 1 moves along (1.000", "slave of pair 2 moves along (1.000");
}

//! A motion of escape in words: which pair moves, in which direction, and what force drives it, in the host's axes.

use signorini::reduce::{ContactPairs, Indices, SparseMatrix, Triangle};
use signorini::{FrictionLaw, LoadCase, Model, Monitor, Settings, Status};

/// Three bodies of two nodes each; springs of 1 between the two along each axis. The first node of each body stands
/// on an obstacle of its own, with its own normal; the second nodes of all bodies but `free` have springs to the
/// ground too. The load pulls the second node of the free body.
fn solution(dim: usize, free: usize, pull: &[f64]) -> String {
    let (bodies, size) = (3, 6 * dim);
    let (mut col_start, mut row, mut values) = (vec![0], vec![], vec![]);
    for body in 0..bodies {
        for node in 0..2 {
            for axis in 0..dim {
                let dof = dim * (2 * body + node) + axis;
                row.push(dof as i64);
                values.push(if node == 1 && body != free { 2.0 } else { 1.0 });
                if node == 0 {
                    row.push((dof + dim) as i64);
                    values.push(-1.0);
                }
                col_start.push(row.len() as i64);
            }
        }
    }
    let slaves: Vec<usize> =
        (0..bodies).flat_map(|body| (0..dim).map(move |axis| 2 * dim * body + axis)).collect();
    let normals: Vec<f64> = match dim {
        2 => vec![1.0, 0.0, 3.0, 4.0, -4.0, 3.0],
        _ => vec![0.0, 0.0, 1.0, 2.0, 1.0, 2.0, -1.0, 2.0, 2.0],
    };
    let matrix = SparseMatrix {
        size,
        col_start: Indices::Wide(&col_start),
        row: Indices::Wide(&row),
        values: &values,
        index_base: 0,
        triangle: Triangle::Lower,
    };
    let pairs = ContactPairs {
        dim,
        count: bodies,
        slaves: &slaves,
        master_start: &[0; 4],
        masters: &[],
        weights: &[],
        normals: &normals,
        tangents: None,
        ..ContactPairs::default()
    };
    let model = Model::sparse(&matrix, &[], &pairs).unwrap();
    let mut load = vec![0.0; size];
    load[dim * (2 * free + 1)..][..dim].copy_from_slice(pull);
    let case = LoadCase {
        load: &load,
        prescribed: None,
        gap: &[0.0; 3],
        law: FrictionLaw::Frictionless,
        reference_slip: None,
    };
    let settings = Settings::default();
    let solution = model.solve(&case, &settings, None, &mut Monitor::new(&settings, None)).unwrap();
    assert_eq!(solution.status, Status::NoEquilibrium, "{}", solution.message);
    solution.message.to_string()
}

/// The free body is pulled away from its obstacle, along an axis: it moves along the pull and nothing else moves;
/// components that are zero are said to be so, whatever the frames have left of rounding.
#[test]
fn a_body_moves_along_what_pulls_it() {
    for dim in [2, 3] {
        for free in 0..3 {
            let mut pull = vec![0.0; dim];
            // The axis along which each normal is positive or negative.
            let (axis, sign): (usize, f64) = match (dim, free) {
                (2, 0) => (0, -1.0),
                (2, 1) => (1, -1.0),
                (2, _) => (0, 1.0),
                (_, 0) => (2, -1.0),
                (_, 1) => (0, -1.0),
                _ => (0, 1.0),
            };
            pull[axis] = 6.0 * sign;
            let message = solution(dim, free, &pull);
            let words = |value: f64, zero: &str, one: &str| {
                let of = |c: usize| match (c == axis, value < 0.0) {
                    (false, _) => zero.to_owned(),
                    (true, false) => one.to_owned(),
                    (true, true) => format!("-{one}"),
                };
                (0..dim).map(of).collect::<Vec<_>>().join(", ")
            };
            let first = 2 * dim * free;
            for part in [
                format!("it moves 2 of the degrees of freedom {} to ", first + axis),
                format!("the slave of pair {free} moves along ({})", words(sign, "0.000", "1.000")),
                "the resultant of the loads along it is 6.000e0".to_owned(),
                "and contact leaves 6.000e0 of it".to_owned(),
                format!("the force is ({})", words(sign, "0.000e0", "6.000e0")),
            ] {
                assert!(message.contains(&part), "{dim}, {free}: '{part}' is not in '{message}'");
            }
        }
    }
}

/// A pull across the axes is said with all its components.
#[test]
fn a_pull_has_all_its_components() {
    let message = solution(2, 1, &[-6.0, -2.5]);
    assert!(message.contains("the force is (-6.000e0, -2.500e0)"), "{message}");
    assert!(message.contains("moves along (-1.000, -0.417)"), "{message}");
    let message = solution(3, 2, &[1.5, -6.0, -3.0]);
    assert!(message.contains("the force is (1.500e0, -6.000e0, -3.000e0)"), "{message}");
    assert!(message.contains("moves along (0.250, -1.000, -0.500)"), "{message}");
}

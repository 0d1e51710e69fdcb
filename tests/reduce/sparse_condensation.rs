//! A whole sparse matrix is condensed as a dense elimination would, however it is stored.

use crate::common::dense::{condensed, difference, dot};
use crate::common::mesh::{Mesh, Pairs, Stiffness, steps};
use crate::common::problems::vector;
use crate::common::stack::{Stack, close, components, solve_case, solved};
use fastrand::Rng;
use signorini::reduce::{Indices, SparseMatrix, Triangle};
use signorini::{
    ContactData, ContactProblem, FrictionLaw, Method, Model, Monitor, Settings, solve,
};

/// `K_rel`, `f_rel` by a dense change of variables `u = T [free; d] + u_0` and a dense elimination:
/// every slave component `u_s = sum w u_m + n d_n + t d_t`.
fn dense_reduction(
    stiffness: &Stiffness,
    fixed: &[usize],
    values: &[f64],
    pairs: &Pairs,
    load: &[f64],
) -> (Vec<f64>, Vec<f64>) {
    let n = stiffness.size;
    let slave_dofs: Vec<usize> = pairs.slaves.iter().flat_map(|s| [2 * s, 2 * s + 1]).collect();
    let is_free = |dof: &usize| !fixed.contains(dof) && !slave_dofs.contains(dof);
    let free: Vec<usize> = (0..n).filter(is_free).collect();
    let unknowns = free.len() + slave_dofs.len();
    let mut t = vec![vec![0.0; unknowns]; n];
    let mut shift = vec![0.0; n];
    for (k, &dof) in free.iter().enumerate() {
        t[dof][k] = 1.0;
    }
    for (&dof, &value) in fixed.iter().zip(values) {
        shift[dof] = value;
    }
    for (pair, &slave) in pairs.slaves.iter().enumerate() {
        let length = pairs.normals[pair][0].hypot(pairs.normals[pair][1]);
        let normal = pairs.normals[pair].map(|c| c / length);
        let tangent = [-normal[1], normal[0]];
        for axis in 0..2 {
            let row = 2 * slave + axis;
            for &(master, weight) in &pairs.masters[pair] {
                let from = t[2 * master + axis].clone();
                t[row].iter_mut().zip(from).for_each(|(t, m)| *t += weight * m);
                shift[row] += weight * shift[2 * master + axis];
            }
            t[row][free.len() + 2 * pair] += normal[axis];
            t[row][free.len() + 2 * pair + 1] += tangent[axis];
        }
    }
    let columns: Vec<Vec<f64>> =
        (0..unknowns).map(|k| t.iter().map(|row| row[k]).collect()).collect();
    let strained: Vec<Vec<f64>> = columns.iter().map(|column| stiffness.times(column)).collect();
    let matrix: Vec<f64> =
        strained.iter().flat_map(|s| columns.iter().map(|c| dot(c, s))).collect();
    let carried = difference(load, &stiffness.times(&shift));
    let right: Vec<f64> = columns.iter().map(|column| dot(column, &carried)).collect();
    condensed(&matrix, &right, free.len())
}

/// Rounding of 150 unknowns with condition numbers around 1e3: below 1e-12 of the largest entry.
/// The loads are seen through `K_rel d = f_rel` with everything open, to ten times the tolerance
/// times the condition.
#[test]
fn condensation_is_the_dense_schur_complement() {
    for (seed, columns) in [[3, 3], [3, 4], [4, 3], [6, 5]].into_iter().enumerate() {
        let stack = Stack::new(columns, [2000.0, 500.0]);
        let (stiffness, fixed) = (stack.mesh.stiffness(), stack.bottom());
        let mut rng = Rng::with_seed(seed as u64);
        let mut pairs = stack.pairs();
        let mut held = fixed.clone();
        // The upper block held on top, for the open case.
        held.extend(components(&stack.upper.row(3), 1));
        held.push(2 * stack.upper.node(0, 3));
        // Normals of any direction and length.
        let normal = [rng.f64() - 0.5, -3.0 * rng.f64() - 0.1];
        pairs = Pairs::new(&pairs.slaves, &pairs.masters, normal);
        let load = vector(&mut rng, stiffness.size);
        let values: Vec<f64> = vector(&mut rng, held.len()).iter().map(|v| 1e-3 * v).collect();
        for fixed in [&fixed, &held] {
            let model = stiffness.model(fixed, &pairs).unwrap();
            let zero = vec![0.0; fixed.len()];
            let (matrix, _) = dense_reduction(&stiffness, fixed, &zero, &pairs, &load);
            close(model.stiffness(), &matrix, 1e-12, &format!("{columns:?}: K_rel"));
        }
        let model = stiffness.model(&held, &pairs).unwrap();
        let (matrix, right) = dense_reduction(&stiffness, &held, &values, &pairs, &load);
        let open = solve_case(&model, &load, Some(&values), f64::INFINITY, 0.0, Method::SorNested);
        let carried = crate::common::dense::product(&matrix, &open.d);
        close(&carried, &right, 1e-10, &format!("{columns:?}: f_rel"));
        // Nothing touches: the displacements of the whole mesh balance its loads.
        let u = model.recover(Some(&load), Some(&values), &open.d).unwrap();
        held.iter().zip(&values).for_each(|(&dof, value)| assert_eq!(u[dof], *value));
        let residual = difference(&stiffness.times(&u), &load);
        for dof in (0..stiffness.size).filter(|dof| !held.contains(dof)) {
            assert!(residual[dof].abs() < 1e-10, "{columns:?}: {dof}: {:e}", residual[dof]);
        }
    }
}

/// The bar of the benchmarks, condensed row by row there, and as a whole matrix here. The tangent
/// of the last node is held: it is decoupled in both, on whatever diagonal.
#[test]
fn bar_as_a_whole_matrix_is_the_condensed_bar() {
    let (columns, rows, ratio, side) = (16, 8, 1.4_f64, 10.0);
    let reference = crate::bar::bar(columns, rows, ratio, side);
    let first = 40.0 * (ratio - 1.0) / (ratio.powi(rows as i32) - 1.0);
    let mut y = vec![0.0];
    for row in 0..rows {
        y.push(y[row] + first * ratio.powi(row as i32));
    }
    let mut mesh = Mesh::default();
    let block = mesh.block(&steps(0.0, 40.0, columns), &y, (13000.0, 0.2));
    let fixed = components(&block.column(columns), 0);
    let pairs = Pairs::on_obstacle(&block.row(0), [0.0, -1.0]);
    let model = mesh.stiffness().model(&fixed, &pairs).unwrap();
    let n = 2 * reference.pairs;
    let but_held = |matrix: &[f64]| {
        let mut matrix = matrix.to_vec();
        matrix[n * n - 1] = 0.0;
        matrix
    };
    let stiffness = but_held(model.stiffness());
    close(&stiffness, &but_held(&reference.stiffness), 1e-12, "K_rel");
    assert!(model.stiffness()[n * n - 1] > 0.0);

    let mut load = vec![0.0; mesh.size()];
    mesh.traction(&block.row(rows), [0.0, -5.0], &mut load);
    mesh.traction(&block.column(0), [side, 0.0], &mut load);
    for mu in [0.0, 0.3, 1.0] {
        let (gap, coefficients) = (vec![0.0; reference.pairs], vec![mu; reference.pairs]);
        let whole = solved(&model, &load, mu);
        let problem = ContactProblem::new(ContactData {
            dim: 2,
            pairs: reference.pairs,
            stiffness: &reference.stiffness,
            ld: n,
            load: &reference.load,
            gap: &gap,
            law: FrictionLaw::Coulomb(&coefficients),
            reference_slip: None,
        })
        .unwrap();
        let settings = Settings { tolerance: 1e-13, ..Settings::default() };
        let monitor = &mut Monitor::new(&settings, None);
        let condensed = solve(&problem, &settings, None, monitor).unwrap();
        // The tolerance times a condition number of some 1e3.
        close(&whole.d, &condensed.d, 1e-9, &format!("mu {mu}: d"));
        let forces = [&whole, &condensed].map(|s| &s.certificate.force);
        close(forces[0], forces[1], 1e-9, &format!("mu {mu}: F"));
        assert_eq!(whole.certificate.states, condensed.certificate.states);
    }
}
/// Lower or upper triangle or all entries, 32 or 64 bits, counted from 0 or 1: the same bits.
#[test]
fn storage_does_not_matter() {
    let stack = Stack::new([3, 4], [2000.0, 700.0]);
    let (lower, pairs, fixed) = (stack.mesh.stiffness(), stack.pairs(), stack.bottom());
    let reference = lower.model(&fixed, &pairs).unwrap();
    let load = stack.load(7.0, 2.0);
    let d = solved(&reference, &load, 0.4).d;
    for triangle in [Triangle::Lower, Triangle::Upper, Triangle::Full] {
        let stored = lower.stored(triangle);
        for base in [0, 1] {
            let shift = |values: &[i64]| values.iter().map(|v| v + base).collect::<Vec<i64>>();
            let narrow = |values: &[i64]| values.iter().map(|v| *v as i32).collect::<Vec<i32>>();
            let (starts, rows) = (shift(&stored.col_start), shift(&stored.row));
            let (narrow_starts, narrow_rows) = (narrow(&starts), narrow(&rows));
            for (starts, rows) in [
                (Indices::Wide(&starts), Indices::Wide(&rows)),
                (Indices::Narrow(&narrow_starts), Indices::Narrow(&narrow_rows)),
            ] {
                let matrix = SparseMatrix {
                    size: stored.size,
                    col_start: starts,
                    row: rows,
                    values: &stored.values,
                    index_base: base,
                    triangle,
                };
                let model = Model::sparse(&matrix, &fixed, &pairs.view()).unwrap();
                assert_eq!(model.stiffness(), reference.stiffness(), "{triangle:?}, base {base}");
                assert_eq!(solved(&model, &load, 0.4).d, d, "{triangle:?}, base {base}");
            }
        }
    }
}

/// All entries, of which one triangle holds roundings where the other has nothing: GetFEM assembles
/// so. They are roundings still, and the other entries of their columns are compared as before.
#[test]
fn triangles_may_differ_by_roundings() {
    let stack = Stack::new([3, 4], [2000.0, 700.0]);
    let (lower, pairs, fixed) = (stack.mesh.stiffness(), stack.pairs(), stack.bottom());
    let reference = lower.model(&fixed, &pairs).unwrap();
    let known = lower.dense();
    let absent = |i: usize, j: usize| i < j && known[i + lower.size * j] == 0.0;
    for (extra, accepted) in [(1e-12, true), (1e-3, false)] {
        let mut full = Stiffness { col_start: vec![0], row: vec![], values: vec![], ..lower };
        for j in 0..lower.size {
            for i in 0..lower.size {
                let value = if absent(i, j) { extra } else { known[i + lower.size * j] };
                if value != 0.0 {
                    full.row.push(i as i64);
                    full.values.push(value);
                }
            }
            full.col_start.push(full.row.len() as i64);
        }
        let matrix = SparseMatrix {
            size: full.size,
            col_start: Indices::Wide(&full.col_start),
            row: Indices::Wide(&full.row),
            values: &full.values,
            index_base: 0,
            triangle: Triangle::Full,
        };
        match Model::sparse(&matrix, &fixed, &pairs.view()) {
            Ok(model) => {
                assert!(accepted);
                close(model.stiffness(), reference.stiffness(), 1e-12, "K_rel");
            }
            Err(error) => {
                assert!(!accepted && error.to_string().contains("not symmetric"), "{error}");
            }
        }
    }
}

//! Models of whole sparse matrices on small plane-strain meshes.

mod common;

#[path = "bench/bar.rs"]
mod bar;

use common::dense::{condensed, difference, dot, largest};
use common::mesh::{Block, Mesh, Pairs, Stiffness, steps};
use common::problems::vector;
use fastrand::Rng;
use signorini::reduce::{Indices, SparseMatrix, Triangle};
use signorini::{
    Argument, ContactData, ContactProblem, Error, Friction, LoadCase, Method, Model, Monitor,
    Settings, Solution, Status, solve,
};

const STEEL: (f64, f64) = (2000.0, 0.3);

fn solve_case(
    model: &Model,
    load: &[f64],
    prescribed: Option<&[f64]>,
    gap: f64,
    mu: f64,
    method: Method,
) -> Solution {
    let pairs = model.pairs();
    let case = LoadCase {
        load,
        prescribed,
        gap: &vec![gap; pairs],
        friction: Friction::Coulomb(&vec![mu; pairs]),
        previous_slip: None,
    };
    let settings = Settings { method, tolerance: 1e-13, ..Settings::default() };
    model.solve(&case, &settings, None, &mut Monitor::new(&settings, None)).unwrap()
}

fn solved(model: &Model, load: &[f64], mu: f64) -> Solution {
    let solution = solve_case(model, load, None, 0.0, mu, Method::SorNested);
    assert_eq!(solution.status, Status::Solved, "{}", solution.message);
    solution
}

fn close(a: &[f64], b: &[f64], tolerance: f64, what: &str) {
    let error = largest(&difference(a, b)) / largest(b);
    assert!(error <= tolerance, "{what}: {error:e}");
}

fn components(block: &[usize], axis: usize) -> Vec<usize> {
    block.iter().map(|node| 2 * node + axis).collect()
}

/// Two blocks, one upon the other, with the lower one's bottom line held in both directions.
struct Stack {
    mesh: Mesh,
    lower: Block,
    upper: Block,
}

impl Stack {
    /// Of `columns` elements each (lower, upper), 3 wide, 1 and 1.5 high.
    fn new(columns: [usize; 2], young: [f64; 2]) -> Stack {
        let mut mesh = Mesh::default();
        let x = |count| steps(0.0, 3.0, count);
        let lower = mesh.block(&x(columns[0]), &steps(0.0, 1.0, 2), (young[0], 0.3));
        let upper = mesh.block(&x(columns[1]), &steps(1.0, 2.5, 3), (young[1], 0.3));
        Stack { mesh, lower, upper }
    }

    fn bottom(&self) -> Vec<usize> {
        let line = self.lower.row(0);
        [components(&line, 0), components(&line, 1)].concat()
    }

    /// The upper block's nodes on the lower one's, by linear interpolation.
    fn pairs(&self) -> Pairs {
        let slaves = self.upper.row(0);
        let line = self.lower.row(self.lower.rows);
        let masters: Vec<_> = slaves
            .iter()
            .map(|&slave| {
                let place = self.mesh.nodes[slave][0] / 3.0 * self.lower.columns as f64;
                let left = (place.floor() as usize).min(self.lower.columns - 1);
                let share = place - left as f64;
                let both = [(line[left], 1.0 - share), (line[left + 1], share)];
                both.into_iter().filter(|(_, weight)| *weight != 0.0).collect()
            })
            .collect();
        Pairs::new(&slaves, &masters, [0.0, -1.0])
    }

    /// Pressure and shear on the top, some of the shear on half of it.
    fn load(&self, pressure: f64, shear: f64) -> Vec<f64> {
        let mut load = vec![0.0; self.mesh.size()];
        let top = self.upper.row(self.upper.rows);
        self.mesh.traction(&top, [shear / 2.0, -pressure], &mut load);
        self.mesh.traction(&top[..=top.len() / 2], [shear, 0.0], &mut load);
        load
    }
}

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
        let carried = common::dense::product(&matrix, &open.d);
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
    let reference = bar::bar(columns, rows, ratio, side);
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
            friction: Friction::Coulomb(&coefficients),
            previous_slip: None,
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

/// Contact forces of a uniform pressure on matching nodes: half an element's share at the ends.
fn uniform_forces(pressure: f64, pairs: usize) -> Vec<f64> {
    let share = pressure * 3.0 / (pairs - 1) as f64;
    (0..2 * pairs)
        .map(|i| match i {
            i if i % 2 == 1 => 0.0,
            i if i == 0 || i == 2 * pairs - 2 => -share / 2.0,
            _ => -share,
        })
        .collect()
}

/// Patch test: under uniform pressure `p` the displacements are linear, `strain_y = -p (1 - nu²) /
/// E`, `strain_x = p nu (1 + nu) / E` (plane strain), and the pressure is `p` at every node. The
/// upper block is held by contact alone; without friction its stiffness may differ from the lower
/// one's, as it slips on it, and it may be anywhere along it. To 1e-10: a thousand times the
/// tolerance.
#[test]
fn stacked_blocks_pass_the_patch_test() {
    for (young, mu, method) in [
        ([2000.0, 500.0], 0.0, Method::SorNested),
        ([2000.0, 500.0], 0.0, Method::Lemke),
        ([2000.0, 2000.0], 0.5, Method::SorNested),
        ([2000.0, 2000.0], 0.5, Method::SorDiagonal),
    ] {
        let stack = Stack::new([4, 4], young);
        let context = format!("E {young:?}, mu {mu}, {method:?}");
        let mut fixed = components(&stack.lower.row(0), 1);
        fixed.push(2 * stack.lower.node(0, 0));
        let pairs = stack.pairs();
        let model = stack.mesh.stiffness().model(&fixed, &pairs).unwrap();
        let load = stack.load(7.0, 0.0);
        let solution = solve_case(&model, &load, None, 0.0, mu, method);
        assert_eq!(solution.status, Status::Solved, "{context}: {}", solution.message);
        let force = &solution.certificate.force;
        close(force, &uniform_forces(7.0, 5), 1e-10, &format!("{context}: F"));

        let u = model.recover(Some(&load), None, &solution.d).unwrap();
        let strains = young.map(|e| (7.0 * 0.3 * 1.3 / e, -7.0 * (1.0 - 0.09) / e));
        let aside = u[2 * stack.upper.node(0, 0)];
        let exact: Vec<f64> = (0..stack.mesh.nodes.len())
            .flat_map(|node| {
                let [x, y] = stack.mesh.nodes[node];
                if stack.lower.nodes().contains(&node) {
                    [strains[0].0 * x, strains[0].1 * y]
                } else {
                    [aside + strains[1].0 * x, strains[0].1 + strains[1].1 * (y - 1.0)]
                }
            })
            .collect();
        close(&u, &exact, 1e-10, &format!("{context}: u"));
        if mu > 0.0 {
            assert!(aside.abs() <= 1e-10 * largest(&u), "{context}: it sticks");
        }
    }
}

/// Three elements against four, nodes to segments: forces and moments of the nodal contact forces
/// balance to rounding, as the weights interpolate the slaves' places; the pressure's resultant
/// passes the interface (1e-10: a thousand times the tolerance).
///
/// The pressure itself is not uniform, as nodes against segments fail the patch test. Measured
/// here: nodal forces up to 8 % off those of a uniform pressure.
#[test]
fn non_matching_interface_transmits_forces_and_moments() {
    for (columns, mu) in [([3, 4], 0.0), ([4, 3], 0.0), ([3, 4], 0.4), ([5, 7], 0.4)] {
        let stack = Stack::new(columns, [2000.0, 2000.0]);
        let context = format!("{columns:?}, mu {mu}");
        let pairs = stack.pairs();
        let stiffness = stack.mesh.stiffness();
        let model = stiffness.model(&stack.bottom(), &pairs).unwrap();
        let load = stack.load(7.0, 0.0);
        let solution = solved(&model, &load, mu);
        let force = &solution.certificate.force;
        let uniform = uniform_forces(7.0, columns[1] + 1);
        let error = largest(&difference(force, &uniform)) / largest(&uniform);
        assert!(error < 0.1, "{context}: {error}");
        let nodal = model.nodal_forces(force).unwrap();
        let (mut sums, mut parts) = ([0.0; 3], 0.0);
        for (node, [x, y]) in stack.mesh.nodes.iter().enumerate() {
            let [fx, fy] = [nodal[2 * node], nodal[2 * node + 1]];
            sums[0] += fx;
            sums[1] += fy;
            sums[2] += x * fy - y * fx;
            parts += fx.abs() + fy.abs();
        }
        assert!(largest(&sums) <= 1e-14 * 3.0 * parts, "{context}: {sums:?} of {parts}");
        let pressed: f64 = force.iter().step_by(2).sum();
        assert!((pressed + 21.0).abs() <= 21.0 * 1e-10, "{context}: {pressed}");
        // The upper block alone: loads and contact forces hold its recovered displacements.
        let u = model.recover(Some(&load), None, &solution.d).unwrap();
        let residual = difference(&difference(&stiffness.times(&u), &load), &nodal);
        let held = stack.bottom();
        let left: Vec<f64> =
            (0..residual.len()).filter(|dof| !held.contains(dof)).map(|i| residual[i]).collect();
        assert!(largest(&left) <= 1e-10 * 21.0, "{context}: {:e}", largest(&left));
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
            let (starts, rows) = (shift(&stored.starts), shift(&stored.rows));
            let (narrow_starts, narrow_rows) = (narrow(&starts), narrow(&rows));
            for (starts, rows) in [
                (Indices::Wide(&starts), Indices::Wide(&rows)),
                (Indices::Narrow(&narrow_starts), Indices::Narrow(&narrow_rows)),
            ] {
                let matrix = SparseMatrix {
                    size: stored.size,
                    starts,
                    rows,
                    values: &stored.values,
                    base,
                    triangle,
                };
                let model = Model::sparse(&matrix, &fixed, &pairs.interface()).unwrap();
                assert_eq!(model.stiffness(), reference.stiffness(), "{triangle:?}, base {base}");
                assert_eq!(solved(&model, &load, 0.4).d, d, "{triangle:?}, base {base}");
            }
        }
    }
}

/// Forces of two blocks under pressure and shear with stick, slip and openings, by which the
/// transformed problems are measured.
fn sheared() -> (Stack, Vec<f64>, Vec<f64>) {
    let stack = Stack::new([4, 4], [2000.0, 700.0]);
    let load = stack.load(7.0, 1.5);
    let model = stack.mesh.stiffness().model(&stack.bottom(), &stack.pairs()).unwrap();
    let solution = solved(&model, &load, 0.25);
    let certificate = &solution.certificate;
    let count = |state| certificate.states.iter().filter(|s| **s == state).count();
    use signorini::State::{Slip, Stick};
    assert!(count(Slip) > 0 && count(Stick) > 0, "{:?}", certificate.states);
    let force = certificate.force.clone();
    (stack, load, force)
}

/// A problem turned by any angle, with its normals and loads, has the same contact forces in the
/// pairs' own frames. The tolerance of 1e-13 times a condition number of 1e3, and more for slip.
#[test]
fn a_turned_problem_has_the_same_forces() {
    let (stack, load, force) = sheared();
    for angle in [0.3, 1.0, 2.5, -1.9, std::f64::consts::FRAC_PI_2] {
        let (sin, cos) = f64::sin_cos(angle);
        let turn = |v: [f64; 2]| [cos * v[0] - sin * v[1], sin * v[0] + cos * v[1]];
        let mut mesh = stack.mesh.clone();
        mesh.nodes.iter_mut().for_each(|node| *node = turn(*node));
        let load: Vec<f64> = load.chunks(2).flat_map(|f| turn([f[0], f[1]])).collect();
        let pairs = stack.pairs();
        let pairs = Pairs::new(&pairs.slaves, &pairs.masters, turn([0.0, -1.0]));
        let model = mesh.stiffness().model(&stack.bottom(), &pairs).unwrap();
        close(&solved(&model, &load, 0.25).certificate.force, &force, 1e-9, "turned");
    }
}

/// Numbering the nodes anew changes nothing.
#[test]
fn a_renumbered_problem_has_the_same_forces() {
    let (stack, load, force) = sheared();
    for seed in 0..5 {
        let mut place: Vec<usize> = (0..stack.mesh.nodes.len()).collect();
        Rng::with_seed(seed).shuffle(&mut place);
        let mut mesh = stack.mesh.clone();
        let mut turned = load.clone();
        for (old, &new) in place.iter().enumerate() {
            mesh.nodes[new] = stack.mesh.nodes[old];
            turned[2 * new..2 * new + 2].copy_from_slice(&load[2 * old..2 * old + 2]);
        }
        mesh.elements.iter_mut().for_each(|(nodes, _)| *nodes = nodes.map(|node| place[node]));
        let fixed: Vec<usize> =
            stack.bottom().iter().map(|dof| 2 * place[dof / 2] + dof % 2).collect();
        let pairs = stack.pairs();
        let slaves: Vec<usize> = pairs.slaves.iter().map(|&node| place[node]).collect();
        let masters: Vec<Vec<_>> = pairs
            .masters
            .iter()
            .map(|masters| masters.iter().map(|&(node, weight)| (place[node], weight)).collect())
            .collect();
        let pairs = Pairs::new(&slaves, &masters, [0.0, -1.0]);
        let model = mesh.stiffness().model(&fixed, &pairs).unwrap();
        let renumbered = solved(&model, &turned, 0.25).certificate.force;
        close(&renumbered, &force, 1e-9, &format!("seed {seed}"));
    }
}

/// On matching nodes, slaves and masters may change places, with the normals reversed.
#[test]
fn slaves_and_masters_may_change_places() {
    let (stack, load, force) = sheared();
    let (upper, lower) = (stack.upper.row(0), stack.lower.row(2));
    let pairs = Pairs::matching(&lower, &upper, [0.0, 1.0]);
    let model = stack.mesh.stiffness().model(&stack.bottom(), &pairs).unwrap();
    let solution = solved(&model, &load, 0.25);
    close(&solution.certificate.force, &force, 1e-9, "exchanged");
    let kept = stack.mesh.stiffness().model(&stack.bottom(), &stack.pairs()).unwrap();
    close(
        &model.nodal_forces(&force).unwrap(),
        &kept.nodal_forces(&force).unwrap(),
        1e-14,
        "nodal forces",
    );
}

/// Blocks between smooth walls, pressed by a prescribed motion `v` of the top: the strain is `(v -
/// gap) / height`, the pressure `E (1 - nu) / ((1 + nu) (1 - 2 nu))` times that.
#[test]
fn prescribed_motion_presses_a_confined_column() {
    let (young, nu) = STEEL;
    let modulus = young * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu));
    let motion = 0.02;
    for two in [false, true] {
        for gap in [0.0, 0.005, -0.01, 0.03] {
            let stack = Stack::new([4, 4], [young; 2]);
            let mesh = &stack.mesh;
            let (upper, lower) = (stack.upper, stack.lower);
            let mut pairs = stack.pairs();
            let mut walls = Vec::new();
            for i in [0, 4] {
                walls.extend(components(&upper.column(i), 0));
                walls.extend(components(&lower.column(i), 0));
            }
            let mut bottom = components(&lower.row(0), 1);
            let mut height = 2.5;
            let top = components(&upper.row(3), 1);
            if !two {
                // The lower block is held as a whole, and the upper one meets an obstacle.
                pairs = Pairs::on_obstacle(&upper.row(0), [0.0, -1.0]);
                bottom = components(&lower.nodes().collect::<Vec<_>>(), 1);
                walls.extend(components(&lower.nodes().collect::<Vec<_>>(), 0));
                walls.sort_unstable();
                walls.dedup();
                height = 1.5;
            }
            let fixed = [walls.clone(), bottom.clone(), top.clone()].concat();
            let mut values = vec![0.0; walls.len() + bottom.len()];
            values.extend(vec![-motion; top.len()]);
            let model = mesh.stiffness().model(&fixed, &pairs).unwrap();
            let load = vec![0.0; mesh.size()];
            for mu in [0.0, 0.5] {
                let solution = solve_case(&model, &load, Some(&values), gap, mu, Method::SorNested);
                let context = format!("two {two}, gap {gap}, mu {mu}");
                assert_eq!(solution.status, Status::Solved, "{context}: {}", solution.message);
                let pressure = modulus * (motion - gap).max(0.0) / height;
                let exact = uniform_forces(pressure, 5);
                let error = difference(&solution.certificate.force, &exact);
                assert!(largest(&error) <= 1e-10 * modulus * motion, "{context}: {error:?}");
                let u = model.recover(Some(&load), Some(&values), &solution.d).unwrap();
                for (&dof, value) in fixed.iter().zip(&values) {
                    assert_eq!(u[dof], *value, "{context}: {dof}");
                }
                let strain = (motion - gap).max(0.0) / height;
                for node in upper.nodes() {
                    let uy = -motion + strain * (2.5 - mesh.nodes[node][1]);
                    assert!((u[2 * node + 1] - uy).abs() <= 1e-12, "{context}: node {node}");
                    assert!(u[2 * node].abs() <= 1e-12, "{context}: node {node}");
                }
            }
        }
    }
}

/// A part that neither supports nor pairs hold is refused by one of its degrees of freedom.
#[test]
fn a_part_that_nothing_holds_is_refused() {
    for place in 0..3 {
        let mut mesh = Mesh::default();
        let mut loose = None;
        let mut add = |mesh: &mut Mesh, at: usize| {
            if at == place {
                let y = steps(7.0, 8.0, 2);
                loose = Some(mesh.block(&steps(0.0, 2.0, 3), &y, STEEL));
            }
        };
        add(&mut mesh, 0);
        let lower = mesh.block(&steps(0.0, 3.0, 3), &steps(0.0, 1.0, 2), STEEL);
        add(&mut mesh, 1);
        let upper = mesh.block(&steps(0.0, 3.0, 3), &steps(1.0, 2.0, 2), STEEL);
        add(&mut mesh, 2);
        let loose = loose.unwrap();
        let line = lower.row(0);
        let mut fixed = [components(&line, 0), components(&line, 1)].concat();
        let pairs = Pairs::matching(&upper.row(0), &lower.row(2), [0.0, -1.0]);
        let stiffness = mesh.stiffness();
        // Not held at all, held against motion upwards only, and but for one rotation.
        let corner = loose.node(0, 0);
        for held in [vec![], vec![2 * corner + 1], vec![2 * corner, 2 * corner + 1]] {
            fixed.extend(&held);
            let Err(Error::Invalid { argument, message }) = stiffness.model(&fixed, &pairs) else {
                panic!("place {place}: a part is loose");
            };
            fixed.truncate(fixed.len() - held.len());
            assert_eq!(argument, Argument::Matrix, "{message}");
            let named = message.strip_prefix("degree of freedom ").and_then(|rest| {
                rest.split(' ').next().and_then(|word| word.parse::<usize>().ok())
            });
            let named = named.unwrap_or_else(|| panic!("no degree of freedom: {message}"));
            assert!(loose.nodes().contains(&(named / 2)), "place {place}: {message}");
        }
        fixed.extend([2 * corner, 2 * corner + 1, 2 * loose.node(0, 2)]);
        assert!(stiffness.model(&fixed, &pairs).is_ok());
    }
}

/// A block that is pulled off its support flies: the proof is a rigid motion of it, whose strain
/// energy is zero in the host's matrix (1e-12 of what the size of the motion could store), and all
/// else rests. Lemke's method.
#[test]
fn a_part_that_flies_off_moves_rigidly() {
    let stack = Stack::new([3, 4], [2000.0, 500.0]);
    let stiffness = stack.mesh.stiffness();
    let model = stiffness.model(&stack.bottom(), &stack.pairs()).unwrap();
    for (pressure, moment) in [(-1.0, 0.0), (-1.0, 1.0), (1.0, 30.0)] {
        let mut load = stack.load(pressure, 0.0);
        // A couple on the ends of the top, in excess of what the base can take.
        load[2 * stack.upper.node(0, 3) + 1] += moment;
        load[2 * stack.upper.node(4, 3) + 1] -= moment;
        let solution = solve_case(&model, &load, None, 0.0, 0.0, Method::Lemke);
        let context = format!("pressure {pressure}, moment {moment}");
        assert_eq!(solution.status, Status::NoEquilibrium, "{context}: {}", solution.message);
        assert_eq!(largest(&solution.certificate.force), 0.0);
        let u = model.recover(None, None, &solution.d).unwrap();
        let most = largest(&u);
        assert!(most > 0.1, "{context}");
        let energy = dot(&u, &stiffness.times(&u));
        let stored = largest(&stiffness.values) * dot(&u, &u);
        assert!(energy.abs() <= 1e-12 * stored, "{context}: {energy:e} of {stored:e}");
        for node in stack.lower.nodes() {
            for dof in [2 * node, 2 * node + 1] {
                assert!(u[dof].abs() <= 1e-12 * most, "{context}: {dof} moves by {}", u[dof]);
            }
        }
        assert!(dot(&u, &load) > 0.0, "{context}: the loads drive it");
        assert!(solution.d.iter().step_by(2).all(|d| *d <= 1e-10), "{context}: it leaves");
    }
}

/// Half models: where the plane of symmetry meets the interface, slave and master are both held
/// along it. The component between them is a row of its own, zero and without force.
#[test]
fn a_slave_held_with_its_master_is_decoupled() {
    let stack = Stack::new([4, 4], [2000.0, 700.0]);
    let mut fixed = components(&stack.lower.row(0), 1);
    fixed.extend(components(&stack.lower.column(0), 0));
    fixed.extend(components(&stack.upper.column(0), 0));
    let model = stack.mesh.stiffness().model(&fixed, &stack.pairs()).unwrap();
    let (n, held) = (10, 1);
    for j in 0..n {
        let (row, column) = (model.stiffness()[held + n * j], model.stiffness()[j + n * held]);
        if j == held {
            assert!(row > 0.0);
        } else {
            assert_eq!((row, column), (0.0, 0.0), "{j}");
        }
    }
    // Loads and reactions of the support do not pass through the pair.
    let mut load = stack.load(7.0, 1.0);
    load[2 * stack.upper.node(0, 0)] = 100.0;
    for mu in [0.0, 0.3] {
        let solution = solved(&model, &load, mu);
        assert_eq!(solution.d[held], 0.0, "mu {mu}");
        assert_eq!(solution.certificate.force[held], 0.0, "mu {mu}");
    }
    // The slave alone.
    fixed.retain(|&dof| dof != 2 * stack.lower.node(0, 2));
    let refused = stack.mesh.stiffness().model(&fixed, &stack.pairs());
    assert!(matches!(refused, Err(Error::Invalid { argument: Argument::Pairs, .. })));
}

/// A master of weight zero, as interpolation leaves it at the end of a segment, does not count:
/// it need not be held where the slave is.
#[test]
fn a_master_of_weight_zero_does_not_count() {
    let stack = Stack::new([4, 4], [2000.0, 700.0]);
    let mut fixed = stack.bottom();
    fixed.extend(components(&stack.lower.column(0)[1..], 0));
    fixed.extend(components(&stack.upper.column(0), 0));
    let pairs = stack.pairs();
    let mut masters = pairs.masters.clone();
    masters[0].push((stack.lower.node(1, 2), 0.0));
    let stiffness = stack.mesh.stiffness();
    let weighted = Pairs::new(&pairs.slaves, &masters, [0.0, -1.0]);
    let models = [&pairs, &weighted].map(|pairs| stiffness.model(&fixed, pairs).unwrap());
    assert_eq!(models[0].stiffness(), models[1].stiffness());
}

/// A part that may still turn about a node within it is refused on fine meshes too, where rounding
/// leaves resistance of its own to that motion.
#[test]
fn a_finely_meshed_part_that_may_turn_is_refused() {
    for (columns, rows, width, height) in [(100, 100, 1.0, 1.0), (200, 10, 1.0, 1.0)] {
        for young in [1.0, 2.1e5, 2.1e11] {
            let mut mesh = Mesh::default();
            let body = mesh.block(&steps(0.0, 3.0, 3), &steps(0.0, 1.0, 2), STEEL);
            let (x, y) = (steps(7.0, 7.0 + width, columns), steps(0.1, 0.1 + height, rows));
            let loose = mesh.block(&x, &y, (young, 0.3));
            let pin = loose.node(columns / 3, rows / 2);
            let pairs = Pairs::on_obstacle(&body.row(0), [0.0, -1.0]);
            let context = format!("{columns} x {rows}, E {young}");
            match mesh.stiffness().model(&[2 * pin, 2 * pin + 1], &pairs) {
                Ok(_) => panic!("{context}: it is taken for held"),
                Err(error) => {
                    let message = error.to_string();
                    let named = message.split(' ').find_map(|word| word.parse::<usize>().ok());
                    let named = named.unwrap_or_else(|| panic!("{context}: {message}"));
                    assert!(loose.nodes().contains(&(named / 2)), "{context}: {message}");
                }
            }
            let held = [2 * pin, 2 * pin + 1, 2 * loose.node(0, 0) + 1];
            assert!(mesh.stiffness().model(&held, &pairs).is_ok(), "{context}: it is held");
        }
    }
}

/// A slender cantilever is weak at its tip, and held: 2 high, 10000 long, `3 E I / l³` is `2e-12` of
/// its elements' stiffness.
#[test]
fn a_slender_part_is_held() {
    for length in [100, 1000, 10_000] {
        let mut mesh = Mesh::default();
        let x = steps(0.0, length as f64, length);
        let beam = mesh.block(&x, &steps(0.0, 2.0, 2), STEEL);
        let root = beam.column(0);
        let fixed = [components(&root, 0), components(&root, 1)].concat();
        for first in [1, length - 2] {
            let pairs = Pairs::on_obstacle(&beam.row(0)[first..first + 3], [0.0, -1.0]);
            let made = mesh.stiffness().model(&fixed, &pairs);
            assert!(made.is_ok(), "length {length}, pairs from {first}: {:?}", made.err());
        }
    }
}

/// Where slave and master are both held along a component, and moved differently, the answer obeys
/// `u_slave = u_master + R d` all the same, or is refused.
#[test]
fn supports_that_part_a_pair_are_not_overlooked() {
    let stack = Stack::new([4, 4], [2000.0, 700.0]);
    let held = components(&stack.upper.column(0), 0);
    let mut fixed = stack.bottom();
    fixed.extend(components(&stack.lower.column(0)[1..], 0));
    let mut values = vec![0.0; fixed.len()];
    fixed.extend(&held);
    values.extend(vec![0.01; held.len()]);
    let model = stack.mesh.stiffness().model(&fixed, &stack.pairs()).unwrap();
    let load = stack.load(7.0, 0.0);
    let case = LoadCase {
        load: &load,
        prescribed: Some(&values),
        gap: &[0.0; 5],
        friction: Friction::Coulomb(&[0.2; 5]),
        previous_slip: None,
    };
    let settings = Settings::default();
    let monitor = &mut Monitor::new(&settings, None);
    match model.solve(&case, &settings, None, monitor) {
        Err(Error::Invalid { argument, .. }) => assert_eq!(argument, Argument::Prescribed),
        Err(error) => panic!("{error}"),
        Ok(solution) => {
            let u = model.recover(Some(&load), Some(&values), &solution.d).unwrap();
            let (slave, master) = (stack.upper.node(0, 0), stack.lower.node(0, 2));
            let apart = u[2 * slave] - u[2 * master];
            assert!((apart - solution.d[1]).abs() < 1e-12, "{apart} apart, d_t {}", solution.d[1]);
        }
    }
}

/// A normal has any length.
#[test]
fn the_length_of_a_normal_does_not_matter() {
    let stack = Stack::new([3, 4], [2000.0, 700.0]);
    let (stiffness, pairs) = (stack.mesh.stiffness(), stack.pairs());
    let reference = stiffness.model(&stack.bottom(), &pairs).unwrap();
    for length in [1e-300, 1e-200, 0.1, 3.0, 1e200, 1e300] {
        let pairs = Pairs::new(&pairs.slaves, &pairs.masters, [0.0, -length]);
        let model = stiffness.model(&stack.bottom(), &pairs);
        let model = model.unwrap_or_else(|error| panic!("length {length:e}: {error}"));
        close(model.stiffness(), reference.stiffness(), 1e-14, "K_rel");
    }
}

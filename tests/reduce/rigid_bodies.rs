//! Rigid bodies whose stiffness is rounding: the change of variables, or the product with the matrix, cancels.

use crate::common::problems::{uniform, vector};
use crate::constrained::{Constrained, Terms, close, in_axes, solved};
use fastrand::Rng;
use signorini::{Error, FrictionLaw, LoadCase, Monitor, Settings, Status};

/// Equations of a node of a plane rigid body at the arm `r`: `u = U + theta x r`, its motion from degree of freedom `first` on.
pub fn rigid(node: usize, [x, y]: [f64; 2], first: usize) -> [(usize, Terms); 2] {
    [
        (2 * node, vec![(first, 1.0), (first + 2, -y)]),
        (2 * node + 1, vec![(first + 1, 1.0), (first + 2, x)]),
    ]
}

/// The row of a pair of a node against a rigid plane.
fn row(node: usize) -> Vec<(usize, Vec<f64>)> {
    vec![(2 * node, vec![1.0, 0.0]), (2 * node + 1, vec![0.0, 1.0])]
}

/// Adds `k v vᵀ`.
pub fn add_spring(stiffness: &mut [f64], k: f64, v: &[f64]) {
    let size = (0..).find(|n| n * n == stiffness.len()).unwrap();
    for (j, b) in v.iter().enumerate() {
        v.iter().enumerate().for_each(|(i, a)| stiffness[i + size * j] += k * a * b);
    }
}

/// A rigid body of one node on springs to another node turns freely about its node, on whatever arm: this motion is named, in
/// any units, where the node is the slave of a pair and the turn is left over.
#[test]
fn the_free_turn_of_a_rigid_body_of_one_node_is_named() {
    for seed in 0..200 {
        let rng = &mut Rng::with_seed(seed);
        let arm = [uniform(rng, -1.0, 1.0), uniform(rng, -1.0, 1.0)];
        let units = 10_f64.powi(rng.i32(-6..=6));
        let mut stiffness = vec![0.0; 49];
        for _ in 0..4 {
            let v = vector(rng, 2);
            add_spring(&mut stiffness, units, &[v[0], v[1], -v[0], -v[1], 0.0, 0.0, 0.0]);
        }
        (0..2).for_each(|i| stiffness[8 * i] += units);
        let structure = Constrained {
            dim: 2,
            stiffness,
            fixed: vec![],
            equations: rigid(1, arm, 4).into(),
            rows: vec![row(1)],
            normals: vec![1.0, 0.0],
            tangents: None,
        };
        let full_space = seed % 2 == 1;
        match structure.tried(&Settings { full_space, ..Settings::default() }) {
            Err(Error::Invalid { message, .. }) => {
                let said = message.to_string();
                let part = "a motion remains that no support and no pair holds: it moves 3 of the degrees of freedom 4 to 6";
                assert!(said.contains(part), "seed {seed}: {said}");
            }
            Err(other) => panic!("seed {seed}: {other}"),
            Ok(_) => panic!("seed {seed}: nothing holds the turn, and the model was made"),
        }
    }
}

/// Two nodes of a rigid body rest on a rigid plane, under a load of 2 in the middle: 1 each. A node on springs of 2 has a load
/// of 1 and a gap of 0.1: it meets 0.8. Stiffness between nodes that are one rigid body changes nothing; it resists no motion but
/// by rounding.
#[test]
fn stiffness_within_a_rigid_body_is_none() {
    for seed in 0..100 {
        let rng = &mut Rng::with_seed(seed);
        let angle = uniform(rng, 0.0, 6.0);
        let (along, normal) = ([angle.cos(), angle.sin()], [angle.sin(), -angle.cos()]);
        let middle = [uniform(rng, -1.0, 1.0), uniform(rng, -1.0, 1.0)];
        let mut stiffness = vec![0.0; 81];
        let k = 10_f64.powi(rng.i32(-3..=6));
        add_spring(
            &mut stiffness,
            k,
            &[along[0], along[1], -along[0], -along[1], 0.0, 0.0, 0.0, 0.0, 0.0],
        );
        [4, 5].iter().for_each(|i| stiffness[10 * i] = 2.0);
        let node = |node: usize, side: f64| {
            rigid(node, [middle[0] + side * along[0], middle[1] + side * along[1]], 6)
        };
        let structure = Constrained {
            dim: 2,
            stiffness,
            fixed: vec![],
            equations: [node(0, -1.0), node(1, 1.0)].concat(),
            rows: (0..3).map(row).collect(),
            normals: normal.repeat(3),
            tangents: None,
        };
        let [x, y] = [2.0 * normal[0], 2.0 * normal[1]];
        let turn = middle[0] * y - middle[1] * x;
        let load = [0.0, 0.0, 0.0, 0.0, normal[0], normal[1], x, y, turn];
        let model = structure.whole(&Settings::default());
        let force = solved(&model, &load, &[0.0, 0.0, 0.1], 0.0).certificate.force;
        let pressed: Vec<f64> = force.chunks(2).map(|force| force[0]).collect();
        close(&pressed, &[-1.0, -1.0, -0.8], 1e-9, &format!("seed {seed}"));
    }
}

/// A rigid body of twelve nodes with springs between all of them stands with three on nodes that have springs of 2 along each axis. Its
/// own springs change nothing, whichever side is the slave: the springs under it carry its load as those of a rigid body do, by
/// three equations, and nothing slips.
#[test]
fn stiffness_within_a_rigid_body_on_elastic_nodes_is_none() {
    let (bodies, turn, size) = (12, 30, 33);
    for seed in 0..100 {
        let rng = &mut Rng::with_seed(seed);
        let mut places: Vec<[f64; 2]> =
            (0..bodies).map(|_| [uniform(rng, -1.0, 1.0), uniform(rng, 0.0, 1.0)]).collect();
        (0..3).for_each(|k| places[k][0] = k as f64 - 1.0);
        let mut stiffness = vec![0.0; size * size];
        let k = 10_f64.powi(rng.i32(-1..=6));
        for (a, b) in (0..bodies).flat_map(|b| (0..b).map(move |a| (a, b))) {
            let mut v = vec![0.0; size];
            for c in 0..2 {
                (v[2 * a + c], v[2 * b + c]) =
                    (places[a][c] - places[b][c], places[b][c] - places[a][c]);
            }
            add_spring(&mut stiffness, k * uniform(rng, 0.1, 1.0), &v);
        }
        (2 * bodies..turn).for_each(|i| stiffness[i + size * i] = 2.0);
        let signs = if seed % 2 == 0 { [1.0, -1.0] } else { [-1.0, 1.0] };
        let side =
            |node: usize, sign: f64| [(2 * node, vec![sign, 0.0]), (2 * node + 1, vec![0.0, sign])];
        let pair = |k: usize| [side(k, signs[0]), side(bodies + k, signs[1])].concat();
        let structure = Constrained {
            dim: 2,
            stiffness,
            fixed: vec![],
            equations: (0..bodies).flat_map(|k| rigid(k, places[k], turn)).collect(),
            rows: (0..3).map(pair).collect(),
            normals: [0.0, -signs[0]].repeat(3),
            tangents: None,
        };
        let mut load = vec![0.0; size];
        let [x, y, moment] = [uniform(rng, -0.2, 0.2), -3.0, uniform(rng, -0.5, 0.5)];
        load[turn..].copy_from_slice(&[x, y, moment]);
        let model = structure.whole(&Settings::default());
        let found = solved(&model, &load, &[0.0; 3], 10.0).certificate.force;
        // The springs under the body: 2 sum (U + turn x r), and their moments.
        let mut whole = nalgebra::Matrix3::zeros();
        let motions = places[..3].iter().flat_map(|[x, y]| [[1.0, 0.0, -y], [0.0, 1.0, *x]]);
        let motions: Vec<nalgebra::Vector3<f64>> = motions.map(Into::into).collect();
        motions.iter().for_each(|v| whole += 2.0 * v * v.transpose());
        let moved = whole.try_inverse().unwrap() * nalgebra::Vector3::new(x, y, moment);
        let pressed: Vec<f64> =
            motions[1..].iter().step_by(2).map(|v| 2.0 * v.dot(&moved)).collect();
        assert!(pressed.iter().all(|push| *push < -0.1), "seed {seed}: {pressed:?}");
        let normal: Vec<f64> = found.chunks(2).map(|force| force[0]).collect();
        // The stiffness is known to 1e-16 of 1e6 springs of 1e0.
        close(&normal, &pressed, 1e-7, &format!("seed {seed}"));
    }
}

/// A node is tied twice to the place where it stands, by two triangles of supports that turn rigidly: both prescribe the same motion, and
/// only rounding parts them. It follows, and nothing acts.
#[test]
fn ties_of_supports_that_move_rigidly_agree() {
    for seed in 0..200 {
        let rng = &mut Rng::with_seed(seed);
        let mut place = || nalgebra::Vector2::new(uniform(rng, -1.0, 1.0), uniform(rng, -1.0, 1.0));
        let (own, corners): (_, [[_; 3]; 2]) =
            (place(), [[(); 3]; 2].map(|of| of.map(|()| place())));
        let [turn, x, y] = [0; 3].map(|_| uniform(rng, -0.1, 0.1));
        let motion = |p: &nalgebra::Vector2<f64>| [x - turn * p.y, y + turn * p.x];
        let mut stiffness = vec![0.0; 14 * 14];
        for (k, corner) in corners[0].iter().enumerate() {
            let mut v = [0.0; 14];
            for c in 0..2 {
                (v[c], v[2 * (k + 1) + c]) = (own[c] - corner[c], corner[c] - own[c]);
            }
            add_spring(&mut stiffness, 1e3, &v);
        }
        let row = |triangle: usize| {
            let of = &corners[triangle];
            let sides = nalgebra::Matrix2::from_columns(&[of[1] - of[0], of[2] - of[0]]);
            let [b, c] = sides.try_inverse().map(|inverse| (inverse * (own - of[0])).into())?;
            let weights: [f64; 4] = [1.0, b + c - 1.0, -b, -c];
            let nodes = [0, 3 * triangle + 1, 3 * triangle + 2, 3 * triangle + 3];
            let entry = |(node, weight): (usize, f64)| {
                [(2 * node, vec![weight, 0.0]), (2 * node + 1, vec![0.0, weight])]
            };
            let is_fair = weights.iter().all(|weight| weight.abs() < 10.0);
            is_fair.then(|| nodes.into_iter().zip(weights).flat_map(entry).collect())
        };
        let [Some(first), Some(second)] = [row(0), row(1)] else { continue };
        let structure = Constrained {
            dim: 2,
            stiffness,
            fixed: (2..14).collect(),
            equations: vec![],
            rows: vec![first, second],
            normals: [0.6, 0.8].repeat(2),
            tangents: None,
        };
        let values: Vec<f64> = corners.iter().flatten().flat_map(motion).collect();
        let settings = Settings::default();
        let case = LoadCase {
            load: &[0.0; 14],
            prescribed: Some(&values),
            gap: &[0.0; 2],
            law: FrictionLaw::Tied,
            reference_slip: None,
        };
        let model = structure.whole(&settings);
        let monitor = &mut Monitor::new(&settings, None);
        let solution = model.solve(&case, &settings, None, monitor).unwrap();
        assert_eq!(solution.status, Status::Solved, "seed {seed}: {}", solution.message);
        let u = model.recover(None, Some(&values), &solution.d).unwrap();
        // Weights below 10 times the rounding of numbers of the size one, and springs of 1e3 times that.
        close(&u[..2], &motion(&own), 1e-12, &format!("seed {seed}"));
        let force = solution.certificate.force.iter().fold(0.0_f64, |most, f| most.max(f.abs()));
        assert!(force < 1e-11, "seed {seed}: {force:e}");
    }
}

/// A rigid body of no stiffness on a rigid plane: forces of its nodes balance the load if this does not slide, `|T| <= mu N`, and
/// acts within the base, where it has fallen by the gap; otherwise no equilibrium exists. Its nodes have rows in the matrix that are
/// empty, or none, and lengths have any unit. Loads nearer than a thousandth to a limit are left out.
#[test]
fn rigid_bodies_without_any_stiffness_obey_statics() {
    let mut statuses = [0; 2];
    for seed in 0..150 {
        let rng = &mut Rng::with_seed(seed);
        let nodes = rng.usize(2..=6);
        let (at, mu) = ([uniform(rng, -1.0, 1.0), uniform(rng, 0.1, 1.0)], uniform(rng, 0.1, 1.0));
        let base: Vec<f64> = (0..nodes).map(|_| uniform(rng, -1.0, 1.0)).collect();
        let [left, right] = [f64::min, f64::max].map(|of| base.iter().copied().reduce(of).unwrap());
        let [shear, moment] = [uniform(rng, -0.8, 0.8), uniform(rng, -0.8, 0.8)];
        let acts = at[0] + at[1] * shear - moment;
        let slides = shear.abs() - mu;
        let beyond = (left - acts).max(acts - right);
        if slides.abs() < 1e-3 || beyond.abs() < 1e-3 {
            continue;
        }
        let unit = 10_f64.powi(rng.i32(-12..=12));
        let (first, size) = (2 * nodes, 2 * nodes + 3);
        let node =
            |(node, x): (usize, &f64)| rigid(node, [unit * (x - at[0]), -unit * at[1]], first);
        let structure = Constrained {
            dim: 2,
            stiffness: vec![0.0; size * size],
            fixed: vec![],
            equations: base.iter().enumerate().flat_map(node).collect(),
            rows: (0..nodes).map(row).collect(),
            normals: [0.0, -1.0].repeat(nodes),
            tangents: None,
        };
        let mut load = vec![0.0; size];
        load[first..].copy_from_slice(&[shear, -1.0, unit * moment]);
        let settings = Settings::default();
        let gathered = structure.gathered(&load);
        let hosts =
            [(structure.whole(&settings), &load), (structure.eliminated(&settings), &gathered)];
        for (model, load) in hosts {
            let (gap, friction) = (vec![0.1 * unit; nodes], vec![mu; nodes]);
            let law = FrictionLaw::Coulomb(&friction);
            let case = LoadCase { load, prescribed: None, gap: &gap, law, reference_slip: None };
            let monitor = &mut Monitor::new(&settings, None);
            let solution = model.solve(&case, &settings, None, monitor).unwrap();
            let rests = slides < 0.0 && beyond < 0.0;
            let expected = if rests { Status::Solved } else { Status::NoEquilibrium };
            assert_eq!(solution.status, expected, "seed {seed}: {}", solution.message);
            statuses[usize::from(rests)] += 1;
            if rests {
                // To ten times the tolerance.
                let nodal = model.nodal_forces(&solution.certificate.force).unwrap();
                let u = model.recover(Some(load), None, &solution.d).unwrap();
                let [force, motion] = [&nodal, &u].map(|all| &all[all.len() - 3..]);
                let on_body = [force[0], force[1], force[2] / unit];
                close(&on_body, &[-shear, 1.0, -moment], 1e-9, &format!("seed {seed}"));
                let height = |x: &f64| motion[1] / unit + motion[2] * (x - at[0]);
                let heights: Vec<f64> = base.iter().map(height).collect();
                close(&heights, &vec![-0.1; nodes], 1e-9, &format!("seed {seed}"));
            }
        }
    }
    assert!(statuses.iter().all(|count| *count > 50), "{statuses:?}");
}

/// A rigid body that nothing but pairs hold, on nodes with springs: hosts with rows for its nodes, without, and with rows of pairs
/// by its three unknowns have the same solution. To 1e-9, a thousand times the tolerance.
#[test]
fn a_rigid_body_on_springs_needs_no_rows_in_the_matrix() {
    for seed in 0..100 {
        let rng = &mut Rng::with_seed(seed);
        let nodes = rng.usize(2..=5);
        let (first, size) = (4 * nodes, 4 * nodes + 3);
        let mut stiffness = vec![0.0; size * size];
        for spring in 0..4 * nodes {
            let mut v = vec![0.0; size];
            v[2 * nodes..first].copy_from_slice(&vector(rng, 2 * nodes));
            v[2 * nodes + spring / 2] += 1.0;
            add_spring(&mut stiffness, 1.0, &v);
        }
        let place = |k: usize| k as f64 / (nodes - 1) as f64 - 0.5;
        let onto = |k: usize| {
            let above = row(k);
            let below = row(nodes + k).into_iter().map(|(dof, v)| (dof, vec![-v[0], -v[1]]));
            above.into_iter().chain(below).collect()
        };
        let structure = Constrained {
            dim: 2,
            stiffness,
            fixed: vec![],
            equations: (0..nodes).flat_map(|k| rigid(k, [place(k), -0.2], first)).collect(),
            rows: (0..nodes).map(onto).collect(),
            normals: [0.0, -1.0].repeat(nodes),
            tangents: None,
        };
        let mut load = vec![0.0; size];
        load[first..].copy_from_slice(&[uniform(rng, -0.1, 0.1), -1.0, uniform(rng, -0.1, 0.1)]);
        let (settings, gap) = (Settings::default(), vec![0.0; nodes]);
        let whole = solved(&structure.whole(&settings), &load, &gap, 0.5);
        let gathered = structure.gathered(&load);
        for model in [structure.eliminated(&settings), structure.reduced().whole(&settings)] {
            let other = solved(&model, &gathered, &gap, 0.5);
            let context = format!("seed {seed}");
            close(&other.certificate.force, &whole.certificate.force, 1e-9, &context);
            close(&other.d, &whole.d, 1e-9, &context);
        }
    }
}

/// Equal rigid disks of the radius a half in a pile of rows on a floor, which nothing but contact holds; the lowest ones may
/// touch walls.
fn pile(rows: usize, in_box: bool) -> Constrained {
    let all = (0..rows).flat_map(|j| (0..rows - j).map(move |i| [i, j]));
    let place = |[i, j]: [usize; 2]| [i as f64 + 0.5 * j as f64, 0.75_f64.sqrt() * j as f64];
    let mut disks: Vec<([usize; 2], usize)> =
        all.enumerate().map(|(disk, at)| (at, disk)).collect();
    disks.sort_unstable();
    let part = |disk: usize, [x, y]: [f64; 2], sign: f64| {
        let (first, turn) = (3 * disk, vec![-sign * y, sign * x]);
        vec![(first, vec![sign, 0.0]), (first + 1, vec![0.0, sign]), (first + 2, turn)]
    };
    let (mut meeting, mut normals) = (Vec::new(), Vec::new());
    for (k, &(at, disk)) in disks.iter().enumerate() {
        for &(other_at, other) in &disks[k + 1..] {
            let [one, another] = [place(at), place(other_at)];
            let to = [another[0] - one[0], another[1] - one[1]];
            if (to[0].hypot(to[1]) - 1.0).abs() < 1e-9 {
                let [own, others] = [(disk, 0.5, 1.0), (other, -0.5, -1.0)]
                    .map(|(disk, by, sign)| part(disk, to.map(|x| by * x), sign));
                meeting.push([own, others].concat());
                normals.extend(to);
            }
        }
        let floor = (at[1] == 0).then_some([0.0, -1.0]);
        let left = (in_box && disk == 0).then_some([-1.0, 0.0]);
        let right = (in_box && disk + 1 == rows).then_some([1.0, 0.0]);
        for normal in [floor, left, right].into_iter().flatten() {
            meeting.push(part(disk, normal.map(|x| 0.5 * x), 1.0));
            normals.extend(normal);
        }
    }
    let size = 3 * disks.len();
    Constrained {
        dim: 2,
        stiffness: vec![0.0; size * size],
        fixed: vec![],
        equations: vec![],
        rows: meeting,
        normals,
        tangents: None,
    }
}

/// A pile whose disks have a weight of 1 stands with friction .6, as a linear program over the edges of the cones says: some
/// forces in the cones balance each disk, to a hundred times the tolerance, and no disk moves.
#[test]
fn a_pile_of_rigid_disks_stands() {
    for rows in 2..=6 {
        let structure = pile(rows, false);
        let model = structure.whole(&Settings::default());
        let mut left = [0.0, -1.0, 0.0].repeat(rows * (rows + 1) / 2);
        let solution = solved(&model, &left, &vec![0.0; structure.rows.len()], 0.6);
        assert!(solution.d.iter().all(|d| d.abs() < 1e-12), "{rows}: no disk moves");
        let force = &solution.certificate.force;
        let in_axes = in_axes(model.frames().expect("it has pairs"), force, 2);
        for (pair, row) in structure.rows.iter().enumerate() {
            let [n, t] = [force[2 * pair], force[2 * pair + 1]];
            assert!(n <= 1e-12 && t.abs() <= -0.6 * n + 1e-12, "{rows}, pair {pair}: {n}, {t}");
            for (dof, along) in row {
                left[*dof] += along[0] * in_axes[2 * pair] + along[1] * in_axes[2 * pair + 1];
            }
        }
        let most = left.iter().fold(0.0_f64, |most, left| most.max(left.abs()));
        assert!(most < 1e-10, "{rows}: {most:e} is left of a weight of 1");
    }
}

/// Springs of 1 on some disks of a pile in a box: the rows of the others are zero in the host's matrix, and the square of rounding in
/// that of the independent displacements, which is no unit for their springs.
#[test]
fn springs_hold_some_disks_of_a_pile() {
    for held in (0_u32..1 << 10).filter(|held| held.count_ones() == 4) {
        let mut structure = pile(4, true);
        for dof in (0..30).filter(|dof| held >> (dof / 3) & 1 == 1) {
            structure.stiffness[31 * dof] = 1.0;
        }
        let load = [0.0, -1.0, 0.0].repeat(10);
        let model = structure.whole(&Settings::default());
        solved(&model, &load, &vec![0.0; structure.rows.len()], 0.2);
    }
}

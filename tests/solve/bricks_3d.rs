//! The bricks that other tests stand on: their patch test, and a block in plane strain against the mesh of
//! quadrilaterals and the methods of the plane.

use crate::common::brick::{Brick, Support};
use crate::common::dense::{difference, largest, product};
use crate::common::mesh::{Mesh, Pairs, steps};
use crate::common::problems::{Case, Law, uniform};
use fastrand::Rng;
use signorini::{Method, Settings, Status};

fn settings() -> Settings {
    Settings { method: Method::Auto, tolerance: 1e-13, ..Settings::default() }
}

/// A block that does not contract aside, pressed by a plate: the pressure is `E` times the strain, and a
/// node carries that of its quarters of faces.
#[test]
fn a_block_without_contraction_is_pressed_evenly() {
    let (cells, size, press) = ([3, 4, 2], [1.5, 2.0, 0.7], 0.1);
    let mut brick = Brick::new(cells, size, Support::Clamped);
    brick.material = (5.0, 0.0);
    let case = brick.case(&brick.model(), |_| [0.0, 0.0, -press], 0.2);
    let solution = case.solve(&settings());
    assert_eq!(solution.status, Status::Solved, "{}", solution.message);
    let face = size[0] / cells[0] as f64 * size[1] / cells[1] as f64;
    for pair in 0..brick.pairs() {
        let [x, y, _] = brick.place(pair);
        let part = |at: f64, size: f64| if at.abs() > 0.499 * size { 0.5 } else { 1.0 };
        let share = face * part(x, size[0]) * part(y, size[1]);
        let expected = [-5.0 * press / size[2] * share, 0.0, 0.0];
        let force = &solution.certificate.force[3 * pair..3 * (pair + 1)];
        assert!(largest(&difference(force, &expected)) <= 1e-12, "{force:?}, {expected:?}");
    }
}

/// A free block has its rigid motions and no others: the stiffness of 3 n components has rank 3 n - 6.
#[test]
fn a_free_block_has_six_rigid_motions() {
    let brick = Brick::new([3, 2, 2], [1.5, 2.0, 0.7], Support::Free);
    let model = brick.model();
    let (k, n) = (model.stiffness(), 3 * brick.pairs());
    for motion in brick.rigid_motions(&model) {
        assert!(largest(&product(k, &motion)) <= 1e-14 * largest(k) * n as f64);
    }
    let mut values = nalgebra::DMatrix::from_column_slice(n, n, k).symmetric_eigenvalues();
    values.as_mut_slice().sort_by(f64::total_cmp);
    assert!(values[6] > 1e-3 * values[n - 1] && values[5] < 1e-14 * values[n - 1], "{values}");
}

/// One layer of bricks that cannot move across the plane: half of what the plane has stands on either side.
#[test]
fn a_block_in_plane_strain_is_that_of_the_plane() {
    let (columns, rows, size, depth, material) = (12, 4, [3.0, 1.0], 0.4, (2.0, 0.3));
    let mut brick = Brick::new([columns, 1, rows], [size[0], depth, size[1]], Support::Clamped);
    brick.material = material;
    brick.held = (0..brick.top().start).map(|node| 3 * node + 1).collect();
    let model = brick.model();
    let mut mesh = Mesh::default();
    let half = size[0] / 2.0;
    let block = mesh.block(&steps(-half, half, columns), &steps(0.0, size[1], rows), material);
    let top: Vec<usize> =
        block.row(rows).iter().flat_map(|node| [2 * node, 2 * node + 1]).collect();
    let plane = mesh.stiffness().model(&top, &Pairs::on_obstacle(&block.row(0), [0.0, -1.0]));
    let plane = plane.expect("the block is a model");
    for seed in 0..50 {
        let mut rng = Rng::with_seed(seed);
        let mut some = |size: f64| uniform(&mut rng, -size, size);
        let (shift, turn, mu) = (some(0.03), some(0.03), 0.15 + some(0.15));
        let motion = |x: f64| [shift, 0.0, turn * x - 0.05];
        let space = brick.case(&model, |[x, _, _]| motion(x), mu);
        let prescribed: Vec<f64> = block
            .row(rows)
            .iter()
            .flat_map(|&node| {
                let [along, _, up] = motion(mesh.nodes[node][0]);
                [along, up]
            })
            .collect();
        let pairs = columns + 1;
        let gap: Vec<f64> = (0..pairs).map(|_| some(0.02)).collect();
        let slip: Vec<f64> = (0..pairs).map(|_| some(0.01)).collect();
        let space = Case {
            gap: [&gap[..], &gap].concat(),
            slip: Some([&slip[..], &slip].concat().iter().flat_map(|&slip| [slip, 0.0]).collect()),
            ..space
        };
        let flat = Case {
            dim: 2,
            pairs,
            k: plane.stiffness().to_vec(),
            f: plane.condensed_load(&vec![0.0; mesh.size()], Some(&prescribed)).unwrap(),
            gap,
            law: Law::Coulomb(vec![mu; pairs]),
            slip: Some(slip),
        };
        let (two, three) = (flat.solve(&settings()), space.solve(&settings()));
        assert_eq!((two.status, three.status), (Status::Solved, Status::Solved), "seed {seed}");
        // Both obey the law to 1e-13 of the forces, and the condition number is below 1e3.
        for pair in 0..2 * pairs {
            let (a, b) = (2 * (pair % pairs), 3 * pair);
            let force = |c: usize| {
                let plane = two.certificate.force[a + c];
                (2.0 * three.certificate.force[b + c] / depth - plane).abs()
            };
            let moved = |c: usize| (three.d[b + c] - two.d[a + c]).abs();
            let d = moved(0).max(moved(1)) / largest(&two.d);
            let f = force(0).max(force(1)) / largest(&two.certificate.force);
            assert!(d.max(f) <= 1e-10, "seed {seed}, pair {pair}: {d:e}, {f:e}");
            assert_eq!(three.certificate.states[pair], two.certificate.states[pair % pairs]);
        }
    }
}

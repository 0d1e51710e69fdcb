//! Two blocks in space, the upper one held by contact alone, in full space and condensed.
//!
//! The two forms share the certificate and little else: one factorises the sparse matrix with contact components held,
//! the other the condensed matrix. `SIGNORINI_FLOATING=25 cargo test --release --test operator -- products::full_space_floating:: --nocapture`
//! takes 25 cells along each edge of the lower block, some 100,000 unknowns.

use std::time::Instant;

use crate::common::dense::{difference, largest};
use crate::common::mesh::Stiffness;
use crate::common::solids::{Cells, Order, Point, Solid};
use crate::surfaces::{pair, steps};
use fastrand::Rng;
use signorini::reduce::ContactPairs;
use signorini::surface::{PairArrays, SurfaceSettings};
use signorini::{FrictionLaw, LoadCase, Monitor, Settings, Solution, Status};

/// Weight of the upper block, and the force that pushes it aside: below the friction of [`FRICTION`], and too small to
/// tip a cube.
const WEIGHT: f64 = 10.0;
const PUSH: [f64; 2] = [2.0, 1.0];
const FRICTION: f64 = 0.4;

/// Two cubes on each other, the lower one clamped below.
struct Cubes {
    stiffness: Stiffness,
    fixed: Vec<usize>,
    arrays: PairArrays,
    load: Vec<f64>,
}

impl Cubes {
    /// So many cells along the edges of the lower and the upper cube.
    fn new(cells: [usize; 2]) -> Cubes {
        let mut rng = Rng::with_seed(0);
        let solids = [0, 1].map(|body| {
            let flat = steps(0.0, 1.0, cells[body]);
            let level = body as f64;
            let upright = steps(level - 1.0, level, cells[body]);
            let material = [(1000.0, 0.3), (400.0, 0.2)][body];
            Solid::new(
                &[&flat, &flat, &upright],
                (Cells::Boxes, Order::Linear),
                material,
                (0.0, &mut rng),
            )
        });
        let first = solids[0].nodes.len();
        let shifted = |face: &Vec<usize>| face.iter().map(|node| first + node).collect();
        let lower: Vec<Vec<usize>> = solids[1].lower.iter().map(shifted).collect();
        let nodes: Vec<Point> = [&solids[0].nodes[..], &solids[1].nodes].concat();
        let sides = [&lower[..], &solids[0].upper[..]];
        let arrays = pair(3, &nodes, sides, &SurfaceSettings::default()).unwrap().rows();
        let clamped = (0..first).filter(|&node| nodes[node][2] == -1.0);
        let fixed = clamped.flat_map(|node| (3 * node)..(3 * node + 3)).collect();
        let mut load = vec![0.0; 3 * nodes.len()];
        let share = 1.0 / solids[1].nodes.len() as f64;
        for force in load[3 * first..].chunks_exact_mut(3) {
            force.copy_from_slice(&[PUSH[0] * share, PUSH[1] * share, -WEIGHT * share]);
        }
        Cubes { stiffness: Solid::stiffness(&solids.each_ref()), fixed, arrays, load }
    }

    /// The solution, and the displacements of all nodes.
    fn solved(&self, full_space: bool) -> (Solution, Vec<f64>) {
        let settings = Settings { full_space, ..Settings::default() };
        let begin = Instant::now();
        let (pairs, monitor) =
            (ContactPairs::from(&self.arrays), &mut Monitor::new(&settings, None));
        let model = self.stiffness.model_under(&self.fixed, &pairs, monitor).unwrap();
        assert_eq!(model.is_matrix_free(), full_space);
        let friction = vec![FRICTION; model.pairs()];
        let case = LoadCase {
            load: &self.load,
            prescribed: None,
            gap: &self.arrays.gaps,
            law: FrictionLaw::Coulomb(&friction),
            reference_slip: None,
        };
        let settings = Settings::default();
        let solution = model.solve(&case, &settings, None, &mut Monitor::new(&settings, None));
        let solution = solution.unwrap();
        let u = model.recover(Some(&self.load), None, &solution.d).unwrap();
        println!(
            "{} unknowns, {} pairs, full space {full_space}: {:.1} s, {}",
            self.stiffness.size - self.fixed.len(),
            model.pairs(),
            begin.elapsed().as_secs_f64(),
            solution.message
        );
        (solution, u)
    }
}

/// Forces, states and displacements agree on meshes that match and that do not; and the forces balance the loads of
/// the floating block.
#[test]
fn a_floating_cube_is_the_same_in_full_space_and_condensed() {
    let edge = std::env::var("SIGNORINI_FLOATING").map_or(8, |cells| cells.parse().unwrap());
    for cells in [[edge, edge], [edge, edge - 3]] {
        let cubes = Cubes::new(cells);
        let [(dense, u), (full, v)] = [false, true].map(|full_space| cubes.solved(full_space));
        for solution in [&dense, &full] {
            assert_eq!(solution.status, Status::Solved, "{cells:?}: {}", solution.message);
            let normal: f64 = solution.certificate.force.iter().step_by(3).sum();
            // The tolerance of eta, in forces.
            assert!((normal + WEIGHT).abs() <= 1e-9 * WEIGHT, "{cells:?}: {normal}");
        }
        let apart = |a: &[f64], b: &[f64]| largest(&difference(a, b)) / largest(a);
        let (forces, moved) =
            (apart(&dense.certificate.force, &full.certificate.force), apart(&u, &v));
        println!("{cells:?}: forces {forces:.1e}, displacements {moved:.1e} apart");
        assert!(forces <= 1e-9, "{cells:?}: forces {forces:e} apart");
        assert!(moved <= 1e-9, "{cells:?}: displacements {moved:e} apart");
        assert_eq!(dense.certificate.states, full.certificate.states, "{cells:?}");
    }
}

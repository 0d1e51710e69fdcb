//! Walls of bricks that nothing but the floor and each other hold: at corners that meet, rows depend on each other.

use crate::common::mesh::{Block, Mesh};
use crate::common::problems::uniform;
use crate::rows::Host;
use fastrand::Rng;
use signorini::{FrictionLaw, LoadCase, Monitor, Settings, Status};

/// A wall in running bond: bricks of one element, 2 wide and 1 high.
struct Wall {
    mesh: Mesh,
    courses: Vec<Vec<Block>>,
}

impl Wall {
    fn new(columns: usize, courses: usize) -> Wall {
        let mut mesh = Mesh::default();
        let mut brick = |left: f64, level: f64| {
            mesh.block(&[left, left + 2.0], &[level, level + 1.0], (1000.0, 0.2))
        };
        let course = |j: usize| -> Vec<Block> {
            let left = 0.7 * (j % 2) as f64;
            (0..columns).map(|i| brick(left + 2.0 * i as f64, j as f64)).collect()
        };
        let courses = (0..courses).map(course).collect();
        Wall { mesh, courses }
    }

    /// Lower corners stand on the floor, corners on the bricks above and below between their ends; those of bricks beside
    /// each other meet.
    fn host(&self) -> Host {
        let (mut rows, mut normals) = (vec![], vec![]);
        let mut add = |row: Vec<(usize, f64)>, normal: [f64; 2]| {
            rows.push(row);
            normals.extend(normal);
        };
        let floor = self.courses[0].iter().flat_map(|brick| brick.row(0));
        floor.for_each(|corner| add(vec![(corner, 1.0)], [0.0, -1.0]));
        for course in &self.courses {
            for beside in course.windows(2) {
                for level in [0, 1] {
                    let both = [(beside[1].node(0, level), 1.0), (beside[0].node(1, level), -1.0)];
                    add(both.to_vec(), [-1.0, 0.0]);
                }
            }
        }
        for courses in self.courses.windows(2) {
            for (below, above) in
                courses[0].iter().flat_map(|b| courses[1].iter().map(move |a| (b, a)))
            {
                let (top, bottom) = (below.row(1), above.row(0));
                for (corners, edge, normal) in [(&bottom, &top, -1.0), (&top, &bottom, 1.0)] {
                    corners
                        .iter()
                        .filter_map(|&corner| self.on(corner, edge))
                        .for_each(|row| add(row, [0.0, normal]));
                }
            }
        }
        let stiffness = self.mesh.stiffness().dense();
        Host { dim: 2, stiffness, fixed: vec![], rows, normals, tangents: None }
    }

    /// The row of a corner on an edge, if it is between its ends.
    fn on(&self, corner: usize, edge: &[usize]) -> Option<Vec<(usize, f64)>> {
        let share = (self.mesh.nodes[corner][0] - self.mesh.nodes[edge[0]][0]) / 2.0;
        let row = [(corner, 1.0), (edge[0], share - 1.0), (edge[1], -share)];
        let row = row.into_iter().filter(|(_, weight)| *weight != 0.0);
        (share > 0.0 && share < 1.0).then(|| row.collect())
    }

    /// Weights of 1, and a force on the upper corners of the last brick.
    fn load(&self, force: [f64; 2]) -> Vec<f64> {
        let mut load = vec![0.0; self.mesh.size()];
        load.iter_mut().skip(1).step_by(2).for_each(|load| *load = -0.25);
        let last = self.courses.last().and_then(|course| course.last()).unwrap();
        for corner in last.row(1) {
            (0..2).for_each(|axis| load[2 * corner + axis] += 0.5 * force[axis]);
        }
        load
    }
}

/// Loads near the limit of what friction balances: with some the wall slides or turns for ever, though statics alone does not
/// show it. Nothing is found then, and the call ends when the default method, sweeps too, has failed once and is no nearer: springs
/// in series, let go or not, would go on for `max_iterations`. Sweeps are told to be hopeless after some 15,000.
#[test]
fn a_wall_without_a_solution_ends_soon() {
    let mut statuses = [0; 3];
    for seed in 0..150 {
        let rng = &mut Rng::with_seed(seed);
        let wall = Wall::new(rng.usize(2..=3), rng.usize(1..=4));
        let host = wall.host();
        let load = wall.load([uniform(rng, -1.0, 1.0), uniform(rng, -1.0, 0.5)]);
        let mu = vec![uniform(rng, 0.2, 1.0); host.rows.len()];
        let model = host.model().unwrap();
        assert!(!model.dependent_pairs().is_empty());
        let gap = vec![0.0; mu.len()];
        let law = FrictionLaw::Coulomb(&mu);
        let case = LoadCase { load: &load, prescribed: None, gap: &gap, law, reference_slip: None };
        let settings = Settings::default();
        let mut monitor = Monitor::new(&settings, None);
        let solution = model.solve(&case, &settings, None, &mut monitor).unwrap();
        let context = format!("seed {seed}: {}", solution.message);
        match solution.status {
            Status::Solved => {
                host.assert_balanced(&model, &case, &solution, 1e-9);
                statuses[0] += 1;
            }
            Status::NoEquilibrium => statuses[1] += 1,
            Status::Stalled => {
                assert!(context.contains("wanted 1.0e-10"), "{context}");
                statuses[2] += 1;
            }
            _ => panic!("{context}"),
        }
        assert!(solution.iterations < 30_000, "{context}");
    }
    assert!(statuses.iter().all(|count| *count > 0), "{statuses:?}");
}

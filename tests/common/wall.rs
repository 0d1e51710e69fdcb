//! Walls of bricks in running bond that nothing but the floor, abutments and each other hold.

use crate::common::mesh::{Block, Mesh};
use crate::rows::Host;

/// A wall in running bond: bricks of one element, 2 wide and 1 high.
pub struct Wall {
    mesh: Mesh,
    courses: Vec<Vec<Block>>,
    /// So many courses, from the lowest on, are between abutments.
    held: usize,
    /// Corners meet at every joint, so that rows depend on each other; otherwise on top alone.
    all_meet: bool,
}

impl Wall {
    /// `columns` bricks in each of `courses`; every other course is moved by `shift` to the right.
    pub fn new([columns, courses]: [usize; 2], shift: f64, held: usize, all_meet: bool) -> Wall {
        let mut mesh = Mesh::default();
        let mut brick = |left: f64, level: f64| {
            mesh.block(&[left, left + 2.0], &[level, level + 1.0], (1000.0, 0.2))
        };
        let course = |j: usize| -> Vec<Block> {
            let left = shift * (j % 2) as f64;
            (0..columns).map(|i| brick(left + 2.0 * i as f64, j as f64)).collect()
        };
        let courses = (0..courses).map(course).collect();
        Wall { mesh, courses, held, all_meet }
    }

    /// A course with the one above, if there is one.
    fn beds(&self) -> impl Iterator<Item = (&Block, &Block)> {
        let both = self.courses.windows(2);
        both.flat_map(|both| both[0].iter().flat_map(|b| both[1].iter().map(move |a| (b, a))))
    }

    /// Lower corners stand on the floor, corners on the bricks above and below between their ends; those of bricks beside
    /// each other meet.
    pub fn host(&self) -> Host {
        let (mut rows, mut normals) = (vec![], vec![]);
        let mut add = |row: Vec<(usize, f64)>, normal: [f64; 2]| {
            rows.push(row);
            normals.extend(normal);
        };
        let floor = self.courses[0].iter().flat_map(|brick| brick.row(0));
        floor.for_each(|corner| add(vec![(corner, 1.0)], [0.0, -1.0]));
        for (j, course) in self.courses.iter().enumerate() {
            let last = j + 1 == self.courses.len();
            for level in [0, 1] {
                let meet = self.all_meet || last && level == 1;
                for two in course.windows(2).filter(|_| meet) {
                    let both = [(two[1].node(0, level), 1.0), (two[0].node(1, level), -1.0)];
                    add(both.to_vec(), [-1.0, 0.0]);
                }
                if j < self.held && (self.all_meet || level == 1) {
                    add(vec![(course[0].node(0, level), 1.0)], [-1.0, 0.0]);
                    add(vec![(course[course.len() - 1].node(1, level), 1.0)], [1.0, 0.0]);
                }
            }
        }
        for (below, above) in self.beds() {
            let (top, bottom) = (below.row(1), above.row(0));
            for (corners, edge, normal) in [(&bottom, &top, -1.0), (&top, &bottom, 1.0)] {
                let on = corners.iter().filter_map(|&corner| self.on(corner, edge));
                on.for_each(|row| add(row, [0.0, normal]));
            }
        }
        let stiffness = self.mesh.stiffness().dense();
        Host { dim: 2, stiffness, fixed: vec![], rows, normals, tangents: None }
    }

    /// The row of a corner on an edge, if it is between its ends.
    fn on(&self, corner: usize, edge: &[usize]) -> Option<Vec<(usize, f64)>> {
        let share = (self.mesh.nodes[corner][0] - self.mesh.nodes[edge[0]][0]) / 2.0;
        let row = [(corner, 1.0), (edge[0], share - 1.0), (edge[1], -share)];
        (share > 0.0 && share < 1.0).then(|| row.to_vec())
    }

    /// Weights of 1, and a force on the upper corners of the last brick.
    pub fn load(&self, force: [f64; 2]) -> Vec<f64> {
        let mut load = vec![0.0; self.mesh.size()];
        load.iter_mut().skip(1).step_by(2).for_each(|load| *load = -0.25);
        let last = self.courses.last().and_then(|course| course.last()).unwrap();
        for corner in last.row(1) {
            (0..2).for_each(|axis| load[2 * corner + axis] += 0.5 * force[axis]);
        }
        load
    }

    /// The motions of each brick, two translations and a rotation about its middle, of all nodes.
    pub fn motions(&self) -> Vec<Vec<f64>> {
        let bricks = self.courses.iter().flatten();
        let of_brick = |brick: &Block| {
            let [x, y] = self.mesh.nodes[brick.node(0, 0)];
            let mut motions = vec![vec![0.0; self.mesh.size()]; 3];
            for node in brick.nodes() {
                let [from_x, from_y] = [self.mesh.nodes[node][0] - x, self.mesh.nodes[node][1] - y];
                (motions[0][2 * node], motions[1][2 * node + 1]) = (1.0, 1.0);
                (motions[2][2 * node], motions[2][2 * node + 1]) = (0.5 - from_y, from_x - 1.0);
            }
            motions
        };
        bricks.flat_map(of_brick).collect()
    }
}

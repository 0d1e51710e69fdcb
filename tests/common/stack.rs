//! Two blocks, one upon the other, and what tests of sparse models do with models.

use signorini::{FrictionLaw, LoadCase, Method, Model, Monitor, Settings, Solution, Status};

use super::dense::{difference, largest};
use super::mesh::{Block, Mesh, Pairs, steps};

pub const STEEL: (f64, f64) = (2000.0, 0.3);

pub fn solve_case(
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
        law: FrictionLaw::Coulomb(&vec![mu; pairs]),
        reference_slip: None,
    };
    let settings = Settings { method, tolerance: 1e-13, ..Settings::default() };
    model.solve(&case, &settings, None, &mut Monitor::new(&settings, None)).unwrap()
}

pub fn solved(model: &Model, load: &[f64], mu: f64) -> Solution {
    let solution = solve_case(model, load, None, 0.0, mu, Method::SorNested);
    assert_eq!(solution.status, Status::Solved, "{}", solution.message);
    solution
}

pub fn close(a: &[f64], b: &[f64], tolerance: f64, what: &str) {
    let error = largest(&difference(a, b)) / largest(b);
    assert!(error <= tolerance, "{what}: {error:e}");
}

pub fn components(block: &[usize], axis: usize) -> Vec<usize> {
    block.iter().map(|node| 2 * node + axis).collect()
}

/// Two blocks, one upon the other, with the lower one's bottom line held in both directions.
pub struct Stack {
    pub mesh: Mesh,
    pub lower: Block,
    pub upper: Block,
}

impl Stack {
    /// A stack of `columns` elements each (lower, upper), 3 wide, 1 and 1.5 high.
    pub fn new(columns: [usize; 2], young: [f64; 2]) -> Stack {
        let mut mesh = Mesh::default();
        let x = |count| steps(0.0, 3.0, count);
        let lower = mesh.block(&x(columns[0]), &steps(0.0, 1.0, 2), (young[0], 0.3));
        let upper = mesh.block(&x(columns[1]), &steps(1.0, 2.5, 3), (young[1], 0.3));
        Stack { mesh, lower, upper }
    }

    pub fn bottom(&self) -> Vec<usize> {
        let line = self.lower.row(0);
        [components(&line, 0), components(&line, 1)].concat()
    }

    /// The upper block's nodes on the lower one's, by linear interpolation.
    pub fn pairs(&self) -> Pairs {
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
    pub fn load(&self, pressure: f64, shear: f64) -> Vec<f64> {
        let mut load = vec![0.0; self.mesh.size()];
        let top = self.upper.row(self.upper.rows);
        self.mesh.traction(&top, [shear / 2.0, -pressure], &mut load);
        self.mesh.traction(&top[..=top.len() / 2], [shear, 0.0], &mut load);
        load
    }
}

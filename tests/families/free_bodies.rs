//! Free bodies on two points in the plane and three or four in space, against rigid statics.
//!
//! Nothing but contact holds such a body, and along most components of its feet nothing resists: what stands
//! there in the condensed matrix is rounding. Whether the feet can balance the loads is a question of
//! the rigid body, which `crate::common::rigid_statics` answers.

use crate::common::brick::{Brick, Support, Vector, cross};
use crate::common::dense::{Elimination, condensed, dot, largest, norm};
use crate::common::mesh::{self, Mesh, steps};
use crate::common::problems::{decades, uniform};
use crate::common::rigid_statics::{Statics, statics};
use fastrand::Rng;
use signorini::reduce::ContactPairs;
use signorini::{Error, FrictionLaw, LoadCase, Model, Monitor, Settings, Solution, Status};

/// The residual of the whole structure, relative to the loads.
const RESIDUAL: f64 = 1e-9;

/// How far a solution may be from the law, relative to the loads: the tolerance of `eta`, 1e-10, in the
/// largest stiffness of the body, which is some hundred times that of a foot.
const LAW: f64 = 1e-7;

/// How far a motion of escape may go into the plane, relative to it: its accuracy is 1e-10 in the norm of the
/// stiffness of all feet.
const APPROACH: f64 = 1e-8;

/// A body under loads on feet that stand on a plane.
struct Body {
    dim: usize,
    nodes: Vec<Vector>,
    stiffness: mesh::Stiffness,
    feet: Vec<usize>,
    normal: Vector,
    mu: f64,
    load: Vec<f64>,
}

/// Turns about an axis by an angle (Rodrigues).
fn turned(v: Vector, axis: Vector, angle: f64) -> Vector {
    let (sin, cos) = angle.sin_cos();
    let (across, along) = (cross(axis, v), dot(&axis, &v));
    std::array::from_fn(|i| cos * v[i] + sin * across[i] + (1.0 - cos) * along * axis[i])
}

impl Body {
    fn in_plane(cells: [usize; 2], size: [f64; 2], young: f64, angle: f64) -> Body {
        let mut mesh = Mesh::default();
        let lines = [0, 1].map(|axis| steps(0.0, size[axis], cells[axis]));
        let block = mesh.block(&lines[0], &lines[1], (young, 0.3));
        let turn = |v: [f64; 2]| turned([v[0], v[1], 0.0], [0.0, 0.0, 1.0], angle);
        mesh.nodes.iter_mut().for_each(|node| {
            let turned = turn(*node);
            *node = [turned[0], turned[1]];
        });
        Body {
            dim: 2,
            nodes: mesh.nodes.iter().map(|node| [node[0], node[1], 0.0]).collect(),
            stiffness: mesh.stiffness(),
            feet: vec![block.node(0, 0), block.node(cells[0], 0)],
            normal: turn([0.0, -1.0]),
            mu: 0.0,
            load: vec![0.0; mesh.size()],
        }
    }

    fn in_space(
        cells: [usize; 3],
        size: Vector,
        young: f64,
        (axis, angle): (Vector, f64),
        feet: usize,
    ) -> Body {
        let mut brick = Brick::new(cells, size, Support::Free);
        brick.material = (young, 0.3);
        brick.nodes.iter_mut().for_each(|node| *node = turned(*node, axis, angle));
        let [nx, ny, _] = cells;
        let corners = [0, nx, (nx + 1) * ny, (nx + 1) * ny + nx];
        Body {
            dim: 3,
            stiffness: brick.stiffness(),
            feet: corners[..feet].to_vec(),
            normal: turned(brick.normal, axis, angle),
            mu: 0.0,
            load: vec![0.0; brick.size()],
            nodes: brick.nodes,
        }
    }

    /// Random loads: downward, and in most cases a share along the plane.
    fn loaded(mut self, rng: &mut Rng) -> Body {
        let mu = [0.0, 0.3, 1.0][rng.usize(0..3)];
        let side = if rng.u8(0..4) == 0 { 0.0 } else { rng.f64() };
        for node in 0..self.nodes.len() {
            if rng.bool() && node > 0 {
                continue;
            }
            let down = rng.f64();
            let mut along = cross(self.normal, [uniform(rng, -1.0, 1.0), 0.3, rng.f64()]);
            if self.dim == 2 {
                along = cross(self.normal, [0.0, 0.0, uniform(rng, -1.0, 1.0)]);
            }
            let own = self.load[self.dim * node..].iter_mut().take(self.dim);
            for ((load, normal), along) in own.zip(self.normal).zip(along) {
                *load = down * normal + side * along;
            }
        }
        Body { mu, ..self }
    }

    fn plane(rng: &mut Rng) -> Body {
        let cells = [1 + rng.usize(0..6), 1 + rng.usize(0..5)];
        let size = [0.0; 2].map(|_| uniform(rng, 0.3, 3.0));
        let angle = if rng.bool() { 0.0 } else { uniform(rng, -3.0, 3.0) };
        Body::in_plane(cells, size, decades(rng, 6.0), angle).loaded(rng)
    }

    fn space(rng: &mut Rng) -> Body {
        let cells = [0; 3].map(|_| 1 + rng.usize(0..3));
        let size = [0.0; 3].map(|_| uniform(rng, 0.3, 3.0));
        let axis = [0.0; 3].map(|_| uniform(rng, -1.0, 1.0));
        let length = norm(&axis);
        let angle = if rng.bool() { 0.0 } else { uniform(rng, -3.0, 3.0) };
        let turn = (axis.map(|a| a / length), angle);
        let feet = 3 + rng.usize(0..2);
        Body::in_space(cells, size, decades(rng, 6.0), turn, feet).loaded(rng)
    }

    fn statics(&self) -> Statics {
        let force = |node: usize| -> Vector {
            std::array::from_fn(|c| if c < self.dim { self.load[self.dim * node + c] } else { 0.0 })
        };
        let loads: Vec<_> =
            (0..self.nodes.len()).map(|node| (self.nodes[node], force(node))).collect();
        let feet: Vec<Vector> = self.feet.iter().map(|&foot| self.nodes[foot]).collect();
        statics(self.dim, &feet, self.normal, self.mu, &loads)
    }

    fn model(&self) -> Result<Model, Error> {
        let count = self.feet.len();
        let dofs = |&foot: &usize| self.dim * foot..self.dim * (foot + 1);
        let pairs = ContactPairs {
            dim: self.dim,
            count,
            slaves: &self.feet.iter().flat_map(dofs).collect::<Vec<_>>(),
            master_start: &vec![0; count + 1],
            masters: &[],
            weights: &[],
            normals: &vec![&self.normal[..self.dim]; count].concat(),
            tangents: None,
            ..ContactPairs::default()
        };
        Model::sparse(&self.stiffness.view(), &[], &pairs)
    }

    fn solved(&self, model: &Model, load: &[f64]) -> Result<Solution, Error> {
        let (gap, mu) = (vec![0.0; self.feet.len()], vec![self.mu; self.feet.len()]);
        let case = LoadCase {
            load,
            prescribed: None,
            gap: &gap,
            law: FrictionLaw::Coulomb(&mu),
            reference_slip: None,
        };
        model.solve(
            &case,
            &Settings::default(),
            None,
            &mut Monitor::new(&Settings::default(), None),
        )
    }

    /// The largest `K u - f - nodal`, relative to the loads.
    fn residual(&self, u: &[f64], nodal: &[f64]) -> f64 {
        let internal = self.stiffness.times(u);
        let parts = internal.iter().zip(&self.load).zip(nodal);
        let residual: Vec<f64> = parts.map(|((k, f), contact)| k - f - contact).collect();
        largest(&residual) / largest(&self.load)
    }

    /// How far displacements and forces of the pairs are from the law, relative to the loads.
    fn against_the_law(&self, d: &[f64], force: &[f64]) -> f64 {
        let (size, stiff) = (largest(&self.load), largest(&self.stiffness.values));
        let mut worst: f64 = 0.0;
        for (d, force) in d.chunks(self.dim).zip(force.chunks(self.dim)) {
            let (slip, friction) = (norm(&d[1..]), norm(&force[1..]));
            // No tension, no friction beyond the cone, no penetration, no force on open pairs.
            worst = worst.max(force[0]).max(friction + self.mu * force[0]).max(stiff * d[0]);
            worst = worst.max((-force[0]).min(-stiff * d[0]));
            // Friction on its bound opposes a slip that is more than rounding.
            if stiff * slip > size {
                worst = worst.max((dot(&d[1..], &force[1..]) / slip - self.mu * force[0]).abs());
            }
        }
        worst / size
    }
}

/// How far a motion goes into the plane.
fn largest_of_normals(dim: usize, motion: &[f64]) -> f64 {
    motion.iter().step_by(dim).fold(0.0, |most: f64, r| most.max(*r))
}

/// Counts of what became of the bodies.
#[derive(Debug, Default, PartialEq, Eq)]
struct Counts {
    balanced: usize,
    driven: usize,
    undecided: usize,
    /// Four feet, and no equilibrium found where statics alone would allow one.
    not_found: usize,
}

/// Judges what a model made of a body against statics: `u` and the nodal forces of a solution.
fn judged(
    body: &Body,
    solution: &Solution,
    whole: impl FnOnce(&Solution) -> (Vec<f64>, Vec<f64>),
    motion: impl FnOnce(&[f64]) -> Vec<f64>,
    counts: &mut Counts,
) -> Result<(), String> {
    let statics = body.statics();
    match (solution.status, statics) {
        (Status::Solved, _) => {
            let (u, nodal) = whole(solution);
            let residual = body.residual(&u, &nodal);
            if !(residual <= RESIDUAL) {
                return Err(format!("solved, and the residual is {residual:.1e}"));
            }
            let flaw = body.against_the_law(&solution.d, &solution.certificate.force);
            if !(flaw <= LAW) {
                return Err(format!("solved, and the law is missed by {flaw:.1e}"));
            }
        }
        (Status::NoEquilibrium, Statics::Driven | Statics::Undecided) => {
            let u = motion(solution.recession.as_ref().ok_or("no motion")?);
            let forces = body.stiffness.times(&u);
            let size = largest(&body.stiffness.values) * largest(&u);
            if !(largest(&forces) <= RESIDUAL * size) {
                return Err(format!("the motion is not rigid: {:.1e}", largest(&forces) / size));
            }
            if !(dot(&body.load, &u) > 0.0) {
                return Err("the loads do no work on the motion".into());
            }
            let escape = solution.escape.as_ref().ok_or("no escape")?;
            let approach = largest_of_normals(body.dim, &escape.motion);
            if !(approach <= APPROACH) {
                return Err(format!("a foot goes into the plane by {approach:.1e}"));
            }
        }
        // On four feet elasticity shares out the pressures, and the friction of these may not balance
        // loads that friction under other pressures would.
        (Status::Stalled, Statics::Balanced) if body.feet.len() > 3 && body.mu > 0.0 => {
            counts.not_found += 1;
            return Ok(());
        }
        _ => return Err(format!("{:?}: {}", solution.status, solution.message)),
    }
    match statics {
        Statics::Balanced => counts.balanced += 1,
        Statics::Driven if solution.status == Status::Solved => {
            return Err("solved, and no forces balance the loads".into());
        }
        Statics::Driven => counts.driven += 1,
        Statics::Undecided => counts.undecided += 1,
    }
    Ok(())
}

fn through_the_sparse_model(body: &Body, counts: &mut Counts) -> Result<(), String> {
    let model = body.model().map_err(|error| format!("refused: {error}"))?;
    let solution = body.solved(&model, &body.load).map_err(|error| error.to_string())?;
    let whole = |solution: &Solution| {
        let u = model.recover(Some(&body.load), None, &solution.d).unwrap();
        (u, model.nodal_forces(&solution.certificate.force).unwrap())
    };
    judged(body, &solution, whole, |d| model.recover(None, None, d).unwrap(), counts)
}

/// The body as a host condenses it: on its feet, in frames of their pairs.
struct Condensed {
    /// All degrees of freedom, those of the feet last.
    order: Vec<usize>,
    /// The directions of the pairs, the normal first.
    frame: Vec<Vector>,
    elimination: Elimination,
    /// The whole matrix in this order, column-major.
    whole: Vec<f64>,
    matrix: Vec<f64>,
    load: Vec<f64>,
}

impl Condensed {
    fn new(body: &Body) -> Condensed {
        let (dim, size) = (body.dim, body.stiffness.size);
        let is_foot = |dof: &usize| body.feet.contains(&(dof / dim));
        let mut order: Vec<usize> = (0..size).filter(|dof| !is_foot(dof)).collect();
        let free = order.len();
        order.extend(body.feet.iter().flat_map(|foot| dim * foot..dim * (foot + 1)));
        let dense = body.stiffness.dense();
        let whole: Vec<f64> = order
            .iter()
            .flat_map(|&j| order.iter().map(move |&i| (i, j)))
            .map(|(i, j)| dense[i + size * j])
            .collect();
        let load: Vec<f64> = order.iter().map(|&dof| body.load[dof]).collect();
        let (on_feet, load_on_feet) = condensed(&whole, &load, free);
        let least =
            (0..3).min_by(|&a, &b| body.normal[a].abs().total_cmp(&body.normal[b].abs())).unwrap();
        let mut axis = [0.0; 3];
        axis[if dim == 2 { 2 } else { least }] = 1.0;
        let across = cross(axis, body.normal);
        let one = across.map(|t| t / norm(&across));
        let frame = [body.normal, one, cross(body.normal, one)][..dim].to_vec();
        let m = dim * body.feet.len();
        let along = |values: &dyn Fn(usize) -> f64, i: usize| -> f64 {
            (0..dim).map(|c| frame[i % dim][c] * values(i - i % dim + c)).sum()
        };
        let mut matrix = vec![0.0; m * m];
        for j in 0..m {
            for i in 0..m {
                let column = |l: usize| along(&|k| on_feet[k + m * l], i);
                matrix[i + m * j] = along(&column, j);
            }
        }
        let load = (0..m).map(|i| along(&|k| load_on_feet[k], i)).collect();
        let block: Vec<f64> =
            (0..free * free).map(|k| whole[k / free + size * (k % free)]).collect();
        Condensed { elimination: Elimination::new(free, &block), order, frame, whole, matrix, load }
    }

    /// A vector of the pairs in the axes of the feet.
    fn in_axes(&self, dim: usize, values: &[f64]) -> Vec<f64> {
        let axes = |pair: &[f64]| -> Vec<f64> {
            (0..dim).map(|c| (0..dim).map(|k| self.frame[k][c] * pair[k]).sum()).collect()
        };
        values.chunks(dim).flat_map(axes).collect()
    }

    /// All displacements from the loads and those of the pairs.
    fn recovered(&self, body: &Body, loaded: bool, d: &[f64]) -> Vec<f64> {
        let (size, feet) = (self.order.len(), self.in_axes(body.dim, d));
        let free = size - feet.len();
        let right: Vec<f64> = (0..free)
            .map(|i| {
                let load = if loaded { body.load[self.order[i]] } else { 0.0 };
                load - (0..feet.len())
                    .map(|k| self.whole[i + size * (free + k)] * feet[k])
                    .sum::<f64>()
            })
            .collect();
        let ordered = [self.elimination.solve(&right).0, feet].concat();
        self.placed(&ordered, 0)
    }

    /// Values in the host's order, the first of which stands at `first` of this one.
    fn placed(&self, values: &[f64], first: usize) -> Vec<f64> {
        let mut placed = vec![0.0; self.order.len()];
        self.order[first..].iter().zip(values).for_each(|(&dof, value)| placed[dof] = *value);
        placed
    }
}

fn through_a_condensation(body: &Body, counts: &mut Counts) -> Result<(), String> {
    let host = Condensed::new(body);
    let (dim, count) = (body.dim, body.feet.len());
    let model = Model::condensed(dim, count, &host.matrix, dim * count)
        .map_err(|error| format!("refused: {error}"))?;
    let solution = body.solved(&model, &host.load).map_err(|error| error.to_string())?;
    let whole = |solution: &Solution| {
        let nodal = host.in_axes(dim, &solution.certificate.force);
        let first = host.order.len() - nodal.len();
        (host.recovered(body, true, &solution.d), host.placed(&nodal, first))
    };
    judged(body, &solution, whole, |d| host.recovered(body, false, d), counts)
}

/// Runs `solve` on bodies, and reports all that went wrong at once.
fn all_right(
    count: usize,
    body: impl Fn(&mut Rng) -> Body,
    solve: impl Fn(&Body, &mut Counts) -> Result<(), String>,
) -> Counts {
    let mut counts = Counts::default();
    let mut wrong = Vec::new();
    for seed in 0..count as u64 {
        let body = body(&mut Rng::with_seed(seed));
        if let Err(what) = solve(&body, &mut counts) {
            wrong.push(format!("{seed} ({:?}, mu {}): {what}", body.statics(), body.mu));
        }
    }
    println!("{counts:?}, {} wrong", wrong.len());
    assert!(wrong.is_empty(), "{} wrong of {count}:\n{}", wrong.len(), wrong.join("\n"));
    counts
}

#[test]
fn bodies_in_the_plane_on_two_points() {
    let counts = all_right(1000, Body::plane, through_the_sparse_model);
    assert!(counts.balanced > 200 && counts.driven > 200, "{counts:?}");
    assert!(counts.undecided < 10, "{counts:?}");
}

#[test]
fn bodies_in_space_on_three_or_four_points() {
    let counts = all_right(1000, Body::space, through_the_sparse_model);
    assert!(counts.not_found <= 5, "{counts:?}");
    assert!(counts.balanced > 200 && counts.driven > 200, "{counts:?}");
    assert!(counts.undecided < 10, "{counts:?}");
}

#[test]
fn condensed_bodies_in_the_plane() {
    let counts = all_right(1000, Body::plane, through_a_condensation);
    assert!(counts.balanced > 200 && counts.driven > 200, "{counts:?}");
}

#[test]
fn condensed_bodies_in_space() {
    let counts = all_right(300, Body::space, through_a_condensation);
    assert!(counts.not_found <= 3, "{counts:?}");
    assert!(counts.balanced > 60 && counts.driven > 60, "{counts:?}");
}

/// A unit square on its two lower corners, pressed by its weight and pushed by a part of it: both feet carry
/// half of the weight and what the push, at the upper edge, turns over.
#[test]
fn unit_squares_on_their_corners() {
    for cells in [[2, 1], [3, 2], [4, 2], [8, 4], [16, 8]] {
        for push in [0.0, 0.2] {
            let mut body = Body::in_plane(cells, [1.0, 1.0], 1.0, 0.0);
            let top = body.nodes.len() - 1;
            (body.load[2 * top], body.load[2 * top + 1], body.mu) = (-push, -1.0, 0.5);
            body.load[2 * (top - cells[0]) + 1] = -1.0;
            let mut counts = Counts::default();
            through_the_sparse_model(&body, &mut counts).unwrap();
            through_a_condensation(&body, &mut counts).unwrap();
            assert_eq!(counts.balanced, 2);
            let model = body.model().unwrap();
            let solution = body.solved(&model, &body.load).unwrap();
            let pressures: Vec<f64> =
                solution.certificate.force.chunks(2).map(|force| -force[0]).collect();
            for (pressure, wanted) in pressures.iter().zip([1.0 + push, 1.0 - push]) {
                assert!((pressure - wanted).abs() <= RESIDUAL, "{cells:?} {pressures:?}");
            }
        }
    }
}

/// A right matrix is no less right for being ill-conditioned: what is held, however softly, stays bit by bit.
/// `K = Q diag(1 .. 1/c) Qᵀ` with Householder's reflection `Q` has a diagonal of one size; springs without
/// coupling are exact at any size.
#[test]
fn definite_matrices_are_taken_as_they_are() {
    for seed in 0..200 {
        let mut rng = Rng::with_seed(seed);
        let (dim, pairs) = (2 + rng.usize(0..2), 2 + rng.usize(0..6));
        let n = dim * pairs;
        let v: Vec<f64> = (0..n).map(|_| uniform(&mut rng, -1.0, 1.0)).collect();
        let factor = 2.0 / dot(&v, &v);
        let q = |i: usize, k: usize| f64::from(u8::from(i == k)) - factor * v[i] * v[k];
        let values: Vec<f64> = (0..n).map(|k| 10f64.powf(-12.0 * k as f64 / n as f64)).collect();
        let mut rotated = vec![0.0; n * n];
        for j in 0..n {
            for i in 0..=j {
                let entry = (0..n).map(|k| q(i, k) * values[k] * q(j, k)).sum();
                (rotated[i + n * j], rotated[j + n * i]) = (entry, entry);
            }
        }
        let mut springs = vec![0.0; n * n];
        (0..n).for_each(|i| springs[i + n * i] = 10f64.powf(uniform(&mut rng, -15.0, 0.0)));
        for k in [&rotated, &springs] {
            let model = Model::condensed(dim, pairs, k, n).unwrap();
            assert!(model.stiffness() == k.as_slice(), "{seed}");
        }
    }
}

/// A foot that a soft spring holds: `c` times the stiffness along the plane, and coupled to it as far as
/// energies stay positive. No body condenses to less than 9e-12 but by rounding.
#[test]
fn softly_held_feet_stay_held() {
    for soft in [1e-6, 1e-8, 1e-10, 1e-11] {
        let coupling = 0.5 * f64::sqrt(soft);
        let mut k = vec![0.0; 16];
        for pair in 0..2 {
            let at = 2 * pair;
            (k[at + 4 * at], k[at + 1 + 4 * (at + 1)]) = (soft, 1.0);
            (k[at + 1 + 4 * at], k[at + 4 * (at + 1)]) = (coupling, coupling);
        }
        let model = Model::condensed(2, 2, &k, 4).unwrap();
        assert!(model.stiffness() == k.as_slice(), "{soft}");
        assert!(Model::two_body(2, 2, (&k, 4), (&k, 4)).is_ok(), "{soft}");
    }
}

/// Loads above the line through two of three feet leave nothing for the third one but rounding, of either sign:
/// any lift of that foot is a solution, and the answer is one that keeps the digits of the residual.
fn on_two_of_three_feet(rng: &mut Rng) -> Body {
    let size = [0.0; 3].map(|_| uniform(rng, 0.3, 3.0));
    let axis = [0.0; 3].map(|_| uniform(rng, -1.0, 1.0));
    let length = norm(&axis);
    let turn = (axis.map(|a| a / length), uniform(rng, -3.0, 3.0));
    let mut body = Body::in_space([1, 1, 1], size, decades(rng, 6.0), turn, 3);
    body.mu = [0.0, 0.3, 1.0][rng.usize(0..3)];
    // Above the first two feet.
    for node in [4, 5] {
        let down = rng.f64();
        let own = body.load[3 * node..].iter_mut().zip(body.normal);
        own.for_each(|(load, normal)| *load = down * normal);
    }
    body
}

#[test]
fn a_foot_that_carries_nothing_is_not_lifted_away() {
    let mut counts = all_right(200, on_two_of_three_feet, through_the_sparse_model);
    assert_eq!(counts.balanced, 200);
    counts = all_right(200, on_two_of_three_feet, through_a_condensation);
    assert_eq!(counts.balanced, 200);
    // A random body whose third foot has the load -3e-17.
    let body = Body::space(&mut Rng::with_seed(100_543));
    through_the_sparse_model(&body, &mut counts).unwrap();
    through_a_condensation(&body, &mut counts).unwrap();
}

/// A lift of 1e9 costs the residual of a host all digits: it is no answer, though the condensed row is zero.
#[test]
fn lifts_that_cost_the_residual_its_digits_are_not_certified() {
    let body = on_two_of_three_feet(&mut Rng::with_seed(1));
    let model = body.model().unwrap();
    let solution = body.solved(&model, &body.load).unwrap();
    let (gap, mu) = (vec![0.0; 3], vec![body.mu; 3]);
    let case = LoadCase {
        load: &body.load,
        prescribed: None,
        gap: &gap,
        law: FrictionLaw::Coulomb(&mu),
        reference_slip: None,
    };
    let mut d = solution.d;
    assert!(model.certify(&case, &d).unwrap().holds(1e-10));
    d[6] -= 1e9;
    assert!(!model.certify(&case, &d).unwrap().holds(1e-10));
}

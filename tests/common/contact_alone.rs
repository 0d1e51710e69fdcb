//! Random elastic bodies that contact alone holds, as a host condenses them on their pairs.
//!
//! A body is a cloud of nodes, each tied to each other one by a spring along the line between them: its rigid motions
//! are known exactly, and it resists all others. The lowest body stands on an obstacle, each further one on the body
//! below. The condensed stiffness comes from an elimination of the saddle point matrix with partial pivoting, as hosts
//! make it: its entries carry the rounding of that elimination.

use super::brick::{Vector, cross};
use super::dense::{dot, norm};
use super::problems::{Case, Law, uniform};
use super::rigid_statics::{Statics, distance};
use fastrand::Rng;

/// How the bodies touch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// On a plane, pressed on it by most loads.
    Standing,
    /// On as few points as hold it.
    FewPoints,
    /// Between obstacles on all sides.
    Wedged,
    /// The loads pull it off the plane.
    Falling,
    /// Two pairs nearly at one place.
    NearDuplicate,
    /// Two to four, one upon the other.
    Stacked,
}

pub const KINDS: [Kind; 6] = [
    Kind::Standing,
    Kind::FewPoints,
    Kind::Wedged,
    Kind::Falling,
    Kind::NearDuplicate,
    Kind::Stacked,
];

/// Bodies with their contact problem.
pub struct ContactAlone {
    /// With the matrix as the elimination leaves it, made symmetric.
    pub raw: Case,
    /// The bodies before they are condensed.
    pub whole: Whole,
    /// The relative rigid motions at the pairs, orthonormal.
    pub motions: Vec<Vec<f64>>,
    /// The work of the loads on each.
    pub work: Vec<f64>,
}

/// Bodies as a host has them: all entries of their stiffness and their loads, with a node of each pair and one of the
/// body below.
pub struct Whole {
    pub stiffness: Vec<f64>,
    pub load: Vec<f64>,
    pub nodes: Vec<(usize, Option<usize>)>,
    /// Axes of each pair, the normal first.
    pub frames: Vec<Vec<Vector>>,
}

/// Edges of the polygons in and around the circle of friction.
const EDGES: usize = 48;

/// The rest of the loads that no forces balance, relative to them: up to the first it is rounding, from the second on
/// it is not.
const ROUNDING: f64 = 1e-12;
const CLEAR: f64 = 1e-8;

struct Body {
    places: Vec<Vector>,
    loads: Vec<Vector>,
}

/// A pair: the node of a body, the body below with its node there (`None`: the obstacle), and the normal.
struct Pair {
    slave: (usize, usize),
    master: Option<(usize, usize)>,
    normal: Vector,
}

impl ContactAlone {
    pub fn random(rng: &mut Rng, kind: Kind) -> ContactAlone {
        let dim = rng.usize(2..=3);
        let count = if kind == Kind::Stacked { rng.usize(2..=4) } else { 1 };
        let feet = match kind {
            Kind::FewPoints => dim,
            Kind::Wedged => rng.usize(dim + 1..=2 * dim),
            _ => rng.usize(dim..=dim + 3),
        };
        let (bodies, pairs) = bodies(rng, kind, dim, count, feet);
        let gap = pairs
            .iter()
            .map(|_| match rng.u8(0..8) {
                0 => 0.1 * rng.f64(),
                1 if kind == Kind::Wedged => f64::INFINITY,
                _ => 0.0,
            })
            .collect();
        let mu = if rng.u8(..6) == 0 { 0.0 } else { uniform(rng, 0.05, 1.5) };
        let frames: Vec<Vec<Vector>> = pairs.iter().map(|pair| frame(dim, pair.normal)).collect();
        let ((k, f), whole) = condensed(rng, dim, &bodies, (&pairs, &frames));
        let law = Law::Coulomb(vec![mu; pairs.len()]);
        let raw = Case { dim, pairs: pairs.len(), k, f, gap, law, slip: None };
        let (motions, work) = motions(dim, &bodies, (&pairs, &frames));
        ContactAlone { raw, whole, motions, work }
    }

    /// The problem without rounding on rigid motions: `(1 - N Nᵀ) K (1 - N Nᵀ)`.
    pub fn clean(&self) -> Case {
        let n = self.raw.size();
        let mut k = self.raw.k.clone();
        for _ in 0..2 {
            for by_rows in [false, true] {
                let at = |i: usize, j: usize| if by_rows { j + n * i } else { i + n * j };
                for j in 0..n {
                    for v in &self.motions {
                        let share: f64 = (0..n).map(|i| v[i] * k[at(i, j)]).sum();
                        (0..n).for_each(|i| k[at(i, j)] -= share * v[i]);
                    }
                }
            }
        }
        symmetric(n, &mut k);
        // Components that the rigid motions move on their own.
        let most = (0..n).fold(0.0, |most: f64, i| most.max(k[i + n * i]));
        for i in (0..n).filter(|&i| k[i + n * i] <= 1e-13 * most).collect::<Vec<_>>() {
            (0..n).for_each(|j| (k[i + n * j], k[j + n * i]) = (0.0, 0.0));
        }
        Case { k, ..self.raw.clone() }
    }

    /// If forces that the law admits balance the loads on all rigid motions.
    pub fn statics(&self) -> Statics {
        let around = (std::f64::consts::PI / EDGES as f64).cos().recip();
        let inner = self.rest(1.0);
        if inner <= ROUNDING {
            return Statics::Balanced;
        }
        let outer = if self.raw.dim == 2 { inner } else { self.rest(around) };
        if outer >= CLEAR { Statics::Driven } else { Statics::Undecided }
    }

    /// The part of the loads on the rigid motions that forces leave, relative to these; friction is `around` times as large.
    pub fn rest(&self, around: f64) -> f64 {
        let case = &self.raw;
        let scale = norm(&self.work).max(1e-3 * norm(&case.f));
        let target: Vec<f64> = self.work.iter().map(|work| work / scale).collect();
        let columns: Vec<Vec<f64>> = (0..case.pairs)
            .filter(|&pair| case.gap[pair].is_finite())
            .flat_map(|pair| edges(case.dim, around * case.law.of(pair)[0], pair))
            .map(|(pair, edge)| {
                let at = case.dim * pair;
                self.motions.iter().map(|v| dot(&v[at..at + case.dim], &edge)).collect()
            })
            .filter(|column: &Vec<f64>| norm(column) > 1e-12)
            .collect();
        distance(&target, &columns)
    }
}

/// The edges of the cone of a pair, the normal component first.
fn edges(dim: usize, mu: f64, pair: usize) -> Vec<(usize, Vec<f64>)> {
    let edge = |tangent: &[f64]| {
        (pair, [&[-1.0][..], &tangent.iter().map(|t| mu * t).collect::<Vec<_>>()].concat())
    };
    match dim {
        _ if mu == 0.0 => vec![edge(&[0.0, 0.0][..dim - 1])],
        2 => vec![edge(&[1.0]), edge(&[-1.0])],
        _ => (0..EDGES)
            .map(|k| (std::f64::consts::TAU * k as f64 / EDGES as f64).sin_cos())
            .map(|(sin, cos)| edge(&[cos, sin]))
            .collect(),
    }
}

fn bodies(
    rng: &mut Rng,
    kind: Kind,
    dim: usize,
    count: usize,
    feet: usize,
) -> (Vec<Body>, Vec<Pair>) {
    let (mut bodies, mut pairs): (Vec<Body>, Vec<Pair>) = (Vec::new(), Vec::new());
    let up = |height: f64| -> Vector {
        std::array::from_fn(|i| if i + 1 == dim { height } else { 0.0 })
    };
    for body in 0..count {
        // Feet around the middle, so that they are not on a line and the loads are often between them.
        let turn = uniform(rng, 0.0, std::f64::consts::TAU);
        let mut places: Vec<Vector> = (0..feet)
            .map(|foot| {
                let angle =
                    turn + std::f64::consts::TAU * (foot as f64 + 0.4 * rng.f64()) / feet as f64;
                match (dim, kind) {
                    (2, Kind::Wedged) => [angle.cos(), angle.sin(), 0.0],
                    (2, _) => [2.0 * (foot as f64 + 0.4 * rng.f64()) / feet as f64 - 1.0, 0.0, 0.0],
                    (_, Kind::Wedged) => [angle.cos(), angle.sin(), uniform(rng, -1.0, 1.0)],
                    _ => [angle.cos(), angle.sin(), 0.0],
                }
            })
            .collect();
        if kind == Kind::NearDuplicate {
            let mut near = places[0];
            near[0] += 10f64.powf(uniform(rng, -8.0, -5.0));
            places.push(near);
        }
        let touching = places.len();
        let level = body as f64;
        places.iter_mut().for_each(|place| *place = add(*place, up(level)));
        for _ in 0..rng.usize(2..=4) {
            let place: Vector =
                std::array::from_fn(|i| if i < dim { uniform(rng, -1.0, 1.0) } else { 0.0 });
            places.push(add(place.map(|x| 0.7 * x), up(level + 0.5)));
        }
        let down = match kind {
            Kind::Falling => -1.0,
            _ => 1.0,
        };
        let side = if rng.u8(..4) == 0 { 0.0 } else { uniform(rng, 0.0, 2.0) };
        let loads = (0..places.len())
            .map(|node| {
                let load: Vector = std::array::from_fn(|i| match i {
                    _ if i >= dim || node < touching && rng.bool() => 0.0,
                    _ if i + 1 == dim => -down * rng.f64(),
                    _ => side * uniform(rng, -0.5, 1.0),
                });
                load
            })
            .collect();
        for (node, place) in places[..touching].iter().enumerate() {
            let normal = match kind {
                Kind::Wedged => {
                    let tilt: Vector = std::array::from_fn(|i| {
                        if i < dim { place[i] + uniform(rng, -0.4, 0.4) } else { 0.0 }
                    });
                    tilt.map(|x| x / norm(&tilt))
                }
                _ => up(-1.0),
            };
            // A node of the body below at the same place.
            let master = body.checked_sub(1).map(|below| {
                let own = &mut bodies[below];
                own.places.push(*place);
                own.loads.push([0.0; 3]);
                (below, own.places.len() - 1)
            });
            pairs.push(Pair { slave: (body, node), master, normal });
        }
        bodies.push(Body { places, loads });
    }
    (bodies, pairs)
}

fn add(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|i| a[i] + b[i])
}

/// The normal, and tangents.
fn frame(dim: usize, normal: Vector) -> Vec<Vector> {
    if dim == 2 {
        return vec![normal, [-normal[1], normal[0], 0.0]];
    }
    let least = (0..3).min_by(|&a, &b| normal[a].abs().total_cmp(&normal[b].abs())).unwrap();
    let mut axis = [0.0; 3];
    axis[least] = 1.0;
    let one = cross(normal, axis);
    let one = one.map(|t| t / norm(&one));
    vec![normal, one, cross(normal, one)]
}

/// Values of nodes of all bodies, seen by the pairs: the rows of slaves less those of masters along the frames.
fn relative(
    dim: usize,
    (pairs, frames): (&[Pair], &[Vec<Vector>]),
    value: &dyn Fn((usize, usize)) -> Vector,
) -> Vec<f64> {
    let each = pairs.iter().zip(frames).flat_map(|(pair, frame)| {
        let (slave, master) = (value(pair.slave), pair.master.map_or([0.0; 3], value));
        let apart: Vector = std::array::from_fn(|i| slave[i] - master[i]);
        frame[..dim].iter().map(move |axis| dot(axis, &apart)).collect::<Vec<_>>()
    });
    each.collect()
}

/// Rigid motions of all bodies at the pairs, orthonormal, and the work of the loads on them.
fn motions(
    dim: usize,
    bodies: &[Body],
    pairs: (&[Pair], &[Vec<Vector>]),
) -> (Vec<Vec<f64>>, Vec<f64>) {
    let (mut motions, mut work): (Vec<Vec<f64>>, Vec<f64>) = (Vec::new(), Vec::new());
    for moving in 0..bodies.len() {
        for k in 0..dim * (dim + 1) / 2 {
            let motion = |place: Vector| -> Vector {
                let mut unit = [0.0; 3];
                match k.checked_sub(dim) {
                    None => unit[k] = 1.0,
                    Some(axis) => {
                        unit[if dim == 2 { 2 } else { axis }] = 1.0;
                        unit = cross(unit, place);
                    }
                }
                unit
            };
            let own = &bodies[moving];
            let works = own.places.iter().zip(&own.loads).map(|(x, f)| dot(&motion(*x), f));
            let mut work_of = works.sum::<f64>();
            let mut v = relative(dim, pairs, &|(body, node)| {
                if body == moving { motion(bodies[body].places[node]) } else { [0.0; 3] }
            });
            for _ in 0..2 {
                for (other, own) in motions.iter().zip(&work) {
                    let share = dot(other, &v);
                    v.iter_mut().zip(other).for_each(|(v, other)| *v -= share * other);
                    work_of -= share * own;
                }
            }
            let size = norm(&v);
            assert!(size > 1e-3, "the pairs feel every rigid motion");
            motions.push(v.iter().map(|v| v / size).collect());
            work.push(work_of / size);
        }
    }
    (motions, work)
}

/// The condensed stiffness and load, by elimination of `[[K, Cᵀ], [C, 0]]`.
fn condensed(
    rng: &mut Rng,
    dim: usize,
    bodies: &[Body],
    pairs: (&[Pair], &[Vec<Vector>]),
) -> ((Vec<f64>, Vec<f64>), Whole) {
    let starts: Vec<usize> = bodies
        .iter()
        .scan(0, |next, body| {
            let start = *next;
            *next += dim * body.places.len();
            Some(start)
        })
        .collect();
    let inner = starts.last().unwrap() + dim * bodies.last().unwrap().places.len();
    let contact = dim * pairs.0.len();
    let n = inner + contact;
    let mut a = vec![0.0; n * n];
    let mut b = vec![vec![0.0; n]; contact + 1];
    for (body, start) in bodies.iter().zip(&starts) {
        let young = 10f64.powf(uniform(rng, 0.0, 3.0));
        for (p, at) in body.places.iter().enumerate() {
            for (q, other) in body.places.iter().enumerate().take(p) {
                let apart: Vector = std::array::from_fn(|i| at[i] - other[i]);
                // Two nodes at one place, of the pairs above and below: a spring along each axis.
                let length = norm(&apart);
                let stiffness = young * uniform(rng, 0.2, 1.0);
                for i in 0..dim {
                    for j in 0..dim {
                        let share = match length == 0.0 {
                            true => f64::from(u8::from(i == j)),
                            false => apart[i] * apart[j] / (length * length),
                        };
                        let k = stiffness * share;
                        let (p, q) = (start + dim * p, start + dim * q);
                        a[(p + i) * n + p + j] += k;
                        a[(q + i) * n + q + j] += k;
                        a[(p + i) * n + q + j] -= k;
                        a[(q + i) * n + p + j] -= k;
                    }
                }
            }
            (0..dim).for_each(|i| b[contact][start + dim * p + i] = body.loads[p][i]);
        }
    }
    let node = |(body, node): (usize, usize)| starts[body] / dim + node;
    let whole = Whole {
        stiffness: a.chunks_exact(n).take(inner).flat_map(|row| row[..inner].to_vec()).collect(),
        load: b[contact][..inner].to_vec(),
        nodes: pairs.0.iter().map(|pair| (node(pair.slave), pair.master.map(node))).collect(),
        frames: pairs.1.to_vec(),
    };
    for (own, &start) in starts.iter().enumerate() {
        for node in 0..bodies[own].places.len() {
            for c in 0..dim {
                let row = relative(dim, pairs, &|at| {
                    let mut unit = [0.0; 3];
                    unit[c] = f64::from(u8::from(at == (own, node)));
                    unit
                });
                for (i, value) in row.into_iter().enumerate() {
                    a[(inner + i) * n + start + dim * node + c] = value;
                    a[(start + dim * node + c) * n + inner + i] = value;
                }
            }
        }
    }
    (0..contact).for_each(|j| b[j][inner + j] = 1.0);
    eliminate(n, &mut a, &mut b);
    let mut k: Vec<f64> = b[..contact].iter().flat_map(|x| x[inner..].iter().map(|x| -x)).collect();
    symmetric(contact, &mut k);
    ((k, b[contact][inner..].to_vec()), whole)
}

/// Overwrites right-hand sides with solutions, by Gaussian elimination with partial pivoting.
fn eliminate(n: usize, a: &mut [f64], b: &mut [Vec<f64>]) {
    for p in 0..n {
        let best = (p..n).max_by(|&i, &j| a[i * n + p].abs().total_cmp(&a[j * n + p].abs()));
        let best = best.unwrap();
        (0..n).for_each(|j| a.swap(p * n + j, best * n + j));
        b.iter_mut().for_each(|b| b.swap(p, best));
        for i in p + 1..n {
            let share = a[i * n + p] / a[p * n + p];
            if share != 0.0 {
                (p..n).for_each(|j| a[i * n + j] -= share * a[p * n + j]);
                b.iter_mut().for_each(|b| b[i] -= share * b[p]);
            }
        }
    }
    for b in b {
        for p in (0..n).rev() {
            let known: f64 = (p + 1..n).map(|j| a[p * n + j] * b[j]).sum();
            b[p] = (b[p] - known) / a[p * n + p];
        }
    }
}

fn symmetric(n: usize, k: &mut [f64]) {
    for j in 0..n {
        for i in 0..j {
            let mean = 0.5 * (k[i + n * j] + k[j + n * i]);
            (k[i + n * j], k[j + n * i]) = (mean, mean);
        }
    }
}

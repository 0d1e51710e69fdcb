//! Problems: data that owns its arrays, and random ones.

use fastrand::Rng;
use signorini::{ContactData, ContactProblem, FrictionLaw, Method, Monitor, Settings, Solution};

use super::dense::{Elimination, dot, largest, norm};

/// A law with its numbers, pair by pair.
#[derive(Clone, Debug)]
pub enum Law {
    Coulomb(Vec<f64>),
    Tresca(Vec<f64>),
    /// `(mu, b, a)` of each pair.
    Cohesive(Vec<f64>),
    /// `(mu1, mu2, angle)` of each pair, in space; the slip along the normal of the ellipse.
    Orthotropic(Vec<f64>),
    /// The same, the slip against the force.
    Collinear(Vec<f64>),
    /// The number of its own law for each pair, and three numbers, those that this law has and zeros.
    ByPair(Vec<f64>),
    /// No relative motion; no numbers.
    Tied,
}

impl Law {
    /// The law as the library takes it.
    pub fn friction(&self) -> FrictionLaw<'_> {
        match self {
            Law::Coulomb(mu) => FrictionLaw::Coulomb(mu),
            Law::Tresca(g) => FrictionLaw::Tresca(g),
            Law::Cohesive(numbers) => FrictionLaw::Cohesive(numbers),
            Law::Orthotropic(numbers) => FrictionLaw::Orthotropic(numbers),
            Law::Collinear(numbers) => FrictionLaw::OrthotropicCollinear(numbers),
            Law::ByPair(numbers) => FrictionLaw::ByPair(numbers),
            Law::Tied => FrictionLaw::Tied,
        }
    }

    pub fn values(&self) -> &[f64] {
        self.friction().values()
    }

    /// This law with other numbers.
    pub fn with(&self, values: Vec<f64>) -> Law {
        match self {
            Law::Coulomb(_) => Law::Coulomb(values),
            Law::Tresca(_) => Law::Tresca(values),
            Law::Cohesive(_) => Law::Cohesive(values),
            Law::Orthotropic(_) => Law::Orthotropic(values),
            Law::Collinear(_) => Law::Collinear(values),
            Law::ByPair(_) => Law::ByPair(values),
            Law::Tied => Law::Tied,
        }
    }

    /// Numbers of each pair.
    pub fn stride(&self) -> usize {
        match self {
            Law::Coulomb(_) | Law::Tresca(_) => 1,
            Law::Cohesive(_) | Law::Orthotropic(_) | Law::Collinear(_) => 3,
            Law::ByPair(_) => 4,
            Law::Tied => 0,
        }
    }

    /// The law of one pair by itself.
    pub fn own(&self, pair: usize) -> Law {
        let numbers = &self.values()[self.stride() * pair..][..self.stride()];
        match self {
            Law::ByPair(_) => match numbers[0] as usize {
                0 => Law::Coulomb(vec![0.0]),
                1 => Law::Coulomb(vec![numbers[1]]),
                2 => Law::Tresca(vec![numbers[1]]),
                3 => Law::Cohesive(numbers[1..].to_vec()),
                4 => Law::Orthotropic(numbers[1..].to_vec()),
                7 => Law::Tied,
                _ => Law::Collinear(numbers[1..].to_vec()),
            },
            law => law.with(numbers.to_vec()),
        }
    }

    /// The number of this law, and its numbers with zeros, for each pair.
    pub fn by_pair(&self) -> Law {
        let number = match self {
            Law::Coulomb(_) => 1.0,
            Law::Tresca(_) => 2.0,
            Law::Cohesive(_) => 3.0,
            Law::Orthotropic(_) => 4.0,
            Law::Collinear(_) => 5.0,
            Law::ByPair(_) => return self.clone(),
            Law::Tied => return Law::ByPair(vec![7.0, 0.0, 0.0, 0.0]),
        };
        let of_pair = |own: &[f64]| {
            let at = |k: usize| own.get(k).copied().unwrap_or(0.0);
            [number, at(0), at(1), at(2)]
        };
        Law::ByPair(self.values().chunks_exact(self.stride()).flat_map(of_pair).collect())
    }

    /// This law with all its forces times a factor.
    pub fn with_forces(&self, factor: f64) -> Law {
        let times = |values: &[f64]| values.iter().map(|value| factor * value).collect();
        match self {
            Law::Coulomb(_) | Law::Orthotropic(_) | Law::Collinear(_) | Law::Tied => self.clone(),
            Law::Tresca(g) => Law::Tresca(times(g)),
            Law::Cohesive(numbers) => Law::Cohesive(
                numbers
                    .chunks_exact(3)
                    .flat_map(|n| [n[0], factor * n[1], factor * n[2]])
                    .collect(),
            ),
            Law::ByPair(numbers) => Law::ByPair(
                (0..numbers.len() / 4)
                    .flat_map(|pair| {
                        let own = self.own(pair).with_forces(factor).by_pair().values().to_vec();
                        [&numbers[4 * pair..=4 * pair], &own[1..]].concat()
                    })
                    .collect(),
            ),
        }
    }

    /// `(mu, b, a)` of a pair: `p >= -a`, `|F_t| <= mu p + b`; `mu` the larger coefficient of an ellipse. A tie bears more
    /// than any force of these problems.
    pub fn of(&self, pair: usize) -> [f64; 3] {
        match self {
            Law::Coulomb(mu) => [mu[pair], 0.0, 0.0],
            Law::Tresca(g) => [0.0, g[pair], 0.0],
            Law::Cohesive(numbers) => [0, 1, 2].map(|k| numbers[3 * pair + k]),
            Law::Orthotropic(numbers) | Law::Collinear(numbers) => {
                [numbers[3 * pair].max(numbers[3 * pair + 1]), 0.0, 0.0]
            }
            Law::ByPair(_) => self.own(pair).of(0),
            Law::Tied => [0.0, UNBOUNDED, UNBOUNDED],
        }
    }
}

/// A force beyond all others, and far enough from overflow that its square is finite.
const UNBOUNDED: f64 = 1e100;

/// A contact problem with its arrays.
#[derive(Clone, Debug)]
pub struct Case {
    pub dim: usize,
    pub pairs: usize,
    pub k: Vec<f64>,
    pub f: Vec<f64>,
    pub gap: Vec<f64>,
    pub law: Law,
    pub slip: Option<Vec<f64>>,
}

impl Case {
    /// The data as the library takes it.
    pub fn data(&self) -> ContactData<'_> {
        ContactData {
            dim: self.dim,
            pairs: self.pairs,
            stiffness: &self.k,
            ld: (self.dim * self.pairs).max(1),
            load: &self.f,
            gap: &self.gap,
            law: self.law.friction(),
            reference_slip: self.slip.as_deref(),
        }
    }

    pub fn problem(&self) -> ContactProblem<'_> {
        ContactProblem::new(self.data()).expect("the data is valid")
    }

    pub fn solve(&self, settings: &Settings) -> Solution {
        signorini::solve(&self.problem(), settings, None, &mut Monitor::new(settings, None))
            .expect("the settings fit")
    }

    pub fn solve_by(&self, method: Method) -> Solution {
        self.solve(&Settings { method, ..Settings::default() })
    }

    /// A problem in the plane with a second tangent that nothing loads or couples, of the stiffness that
    /// `stiffness` gives it. Its solutions are those of the plane: `k delta_2 + tau_2 = 0` and
    /// `delta_2 tau_2 >= 0` leave zero.
    pub fn extruded(&self, mut stiffness: impl FnMut() -> f64) -> Case {
        let (pairs, n) = (self.pairs, 3 * self.pairs);
        let place = |i: usize| 3 * (i / 2) + i % 2;
        let (mut k, mut f, mut slip) = (vec![0.0; n * n], vec![0.0; n], vec![0.0; 2 * pairs]);
        for j in 0..2 * pairs {
            for i in 0..2 * pairs {
                k[place(i) + n * place(j)] = self.stiffness(i, j);
            }
            f[place(j)] = self.f[j];
        }
        for pair in 0..pairs {
            k[(3 * pair + 2) * (n + 1)] = stiffness();
            slip[2 * pair] = self.rest(pair, 0);
        }
        Case { dim: 3, pairs, k, f, gap: self.gap.clone(), law: self.law.clone(), slip: Some(slip) }
    }

    pub fn size(&self) -> usize {
        self.dim * self.pairs
    }

    /// `K[i, j]`.
    pub fn stiffness(&self, i: usize, j: usize) -> f64 {
        self.k[i + j * self.size()]
    }

    /// Reference slip.
    pub fn rest(&self, pair: usize, component: usize) -> f64 {
        self.slip.as_ref().map_or(0.0, |slip| slip[(self.dim - 1) * pair + component])
    }

    /// Bound on the tangential force under the normal force `normal`.
    pub fn bound(&self, pair: usize, normal: f64) -> f64 {
        let [mu, b, a] = self.law.of(pair);
        mu * (-normal).max(-a) + b
    }
}

/// Uniform in (low, high).
pub fn uniform(rng: &mut Rng, low: f64, high: f64) -> f64 {
    low + (high - low) * rng.f64()
}

/// `10^e`, `e` uniform in (0, `decades`).
pub fn decades(rng: &mut Rng, decades: f64) -> f64 {
    10_f64.powf(uniform(rng, 0.0, decades))
}

pub fn vector(rng: &mut Rng, n: usize) -> Vec<f64> {
    (0..n).map(|_| uniform(rng, -1.0, 1.0)).collect()
}

/// A symmetric positive semi-definite matrix with the given kernel (any independent vectors),
/// other eigenvalues between `1 / condition` (attained) and 1, other eigenvectors random.
pub fn semidefinite(rng: &mut Rng, n: usize, condition: f64, kernel: &[Vec<f64>]) -> Vec<f64> {
    let mut basis: Vec<Vec<f64>> = Vec::new();
    while basis.len() < n {
        let given = kernel.get(basis.len());
        let mut v = given.cloned().unwrap_or_else(|| vector(rng, n));
        let before = norm(&v);
        for _ in 0..2 {
            for q in &basis {
                let share = dot(q, &v);
                v.iter_mut().zip(q).for_each(|(v, q)| *v -= share * q);
            }
        }
        let length = norm(&v);
        if length > if given.is_some() { 1e-9 } else { 1e-3 } * before {
            basis.push(v.iter().map(|v| v / length).collect());
        } else {
            assert!(given.is_none(), "the kernel's vectors are dependent");
        }
    }
    let mut k = vec![0.0; n * n];
    for (index, q) in basis.iter().enumerate().skip(kernel.len()) {
        let least = index == kernel.len();
        let exponent = if least { 1.0 } else { rng.f64() };
        let value = condition.powf(-exponent);
        for i in 0..n {
            for j in 0..=i {
                k[i + j * n] += value * q[i] * q[j];
            }
        }
    }
    for i in 0..n {
        for j in 0..i {
            k[j + i * n] = k[i + j * n];
        }
    }
    k
}

/// A symmetric positive definite matrix of a condition number, largest eigenvalue about 1.
pub fn definite(rng: &mut Rng, n: usize, condition: f64) -> Vec<f64> {
    semidefinite(rng, n, condition, &[])
}

/// A 2D stiffness with a kernel of one or two motions: translations and the rotation of a body
/// that stands on a plane (one tangential for all pairs, normals linear in place), or random ones.
/// Returns the motions too.
pub fn floating(rng: &mut Rng, pairs: usize, condition: f64) -> (Vec<f64>, Vec<Vec<f64>>) {
    let n = 2 * pairs;
    loop {
        let count = if n > 2 && rng.bool() { 2 } else { 1 };
        let motions: Vec<Vec<f64>> = (0..count).map(|_| motion(rng, pairs)).collect();
        let independent = motions
            .windows(2)
            .all(|pair| dot(&pair[0], &pair[1]).abs() < 0.99 * norm(&pair[0]) * norm(&pair[1]));
        if !independent {
            continue;
        }
        let k = semidefinite(rng, n, condition, &motions);
        // A component that no spring resists is bad input.
        if (0..n).all(|i| k[i + i * n] > 1e-2 / condition) {
            return (k, motions);
        }
    }
}

fn motion(rng: &mut Rng, pairs: usize) -> Vec<f64> {
    let kind = rng.u8(0..5);
    let normal = |i: usize| match kind {
        0 => 1.0,
        1 => 0.0,
        2 => i as f64 - 0.5,
        _ => i as f64 - 1.0,
    };
    let slide = if kind == 1 || kind == 2 { 1.0 } else { 0.0 };
    if kind < 4 {
        (0..pairs).flat_map(|i| [normal(i), slide]).collect()
    } else {
        vector(rng, 2 * pairs)
    }
}

/// A block of three or more pairs on a plane, without supports: stretching springs between
/// neighbours, bending springs over three of them, coupled. All entries are integers: the rigid
/// motions (translations, rotation) are in the kernel without rounding.
pub fn block(rng: &mut Rng, pairs: usize) -> Vec<f64> {
    assert!(pairs >= 3);
    let n = 2 * pairs;
    let mut k = vec![0.0; n * n];
    for first in 0..pairs - 2 {
        for stretched in 0..2 {
            let mut strain = vec![0.0; n];
            let at = 2 * (first + stretched);
            (strain[at + 1], strain[at + 3]) = (-1.0, 1.0);
            let bend = f64::from(rng.i32(-1..=1));
            for (i, weight) in [1.0, -2.0, 1.0].into_iter().enumerate() {
                strain[2 * (first + i)] = bend * weight;
            }
            add_spring(&mut k, &strain, f64::from(rng.i32(1..=8)));
        }
        let mut strain = vec![0.0; n];
        for (i, weight) in [1.0, -2.0, 1.0].into_iter().enumerate() {
            strain[2 * (first + i)] = weight;
        }
        add_spring(&mut k, &strain, f64::from(rng.i32(1..=8)));
    }
    k
}

/// Adds `stiffness strain strainᵀ`.
pub fn add_spring(k: &mut [f64], strain: &[f64], stiffness: f64) {
    let n = strain.len();
    for i in 0..n {
        for j in 0..n {
            k[i + j * n] += stiffness * strain[i] * strain[j];
        }
    }
}

/// Loads (mostly pressing), gaps (zero, positive, negative, infinite), previous slip.
pub fn loaded(rng: &mut Rng, dim: usize, k: Vec<f64>, law: Law) -> Case {
    let n = (0..).find(|n| n * n == k.len()).unwrap();
    let pairs = n / dim;
    let mut f: Vec<f64> = vector(rng, n);
    for (i, f) in f.iter_mut().enumerate() {
        if i % dim == 0 {
            *f += 0.4;
        }
        if rng.u8(0..12) == 0 {
            *f = 0.0;
        }
    }
    if largest(&f) == 0.0 {
        f[0] = 1.0;
    }
    let size = decades(rng, 2.0) / 10.0;
    let gap = (0..pairs)
        .map(|_| match rng.u8(0..10) {
            0..4 => 0.0,
            4..7 => size * rng.f64(),
            7..9 => -size * rng.f64(),
            _ => f64::INFINITY,
        })
        .collect();
    let slip = rng.bool().then(|| vector(rng, (dim - 1) * pairs));
    Case { dim, pairs, k, f, gap, law, slip }
}

/// Coefficients up to `most`, every fifth zero.
pub fn coulomb(rng: &mut Rng, pairs: usize, most: f64) -> Law {
    Law::Coulomb(
        (0..pairs).map(|_| if rng.u8(0..5) == 0 { 0.0 } else { uniform(rng, 0.0, most) }).collect(),
    )
}

/// Thresholds up to 1, every fifth zero.
pub fn tresca(rng: &mut Rng, pairs: usize) -> Law {
    Law::Tresca((0..pairs).map(|_| if rng.u8(0..5) == 0 { 0.0 } else { rng.f64() }).collect())
}

/// Coefficients up to `most`, cohesion and tension up to 1, each of the three zero in every fourth pair:
/// Coulomb's law, Tresca's, tension alone and all together.
pub fn cohesive(rng: &mut Rng, pairs: usize, most: f64) -> Law {
    let or_zero = |rng: &mut Rng, most: f64| match rng.u8(0..4) {
        0 => 0.0,
        _ => uniform(rng, 0.0, most),
    };
    let numbers = |_| {
        let (mu, a, more) = (or_zero(rng, most), or_zero(rng, 1.0), or_zero(rng, 1.0));
        [mu, mu * a + more, a]
    };
    Law::Cohesive((0..pairs).flat_map(numbers).collect())
}

/// A law of its own for each pair: without friction, Coulomb's, Tresca's or cohesive, coefficients up to `most`, and in
/// space an ellipse too.
pub fn mixed(rng: &mut Rng, (dim, pairs): (usize, usize), most: f64) -> Law {
    let own = |_| {
        let law = match rng.u8(0..if dim == 2 { 4 } else { 6 }) {
            0 => return vec![0.0; 4],
            1 => coulomb(rng, 1, most),
            2 => tresca(rng, 1),
            3 => cohesive(rng, 1, most),
            kind => {
                let axis = |rng: &mut Rng| uniform(rng, 0.1, 1.0) * most;
                let numbers = vec![axis(rng), axis(rng), uniform(rng, -4.0, 4.0)];
                if kind == 4 { Law::Orthotropic(numbers) } else { Law::Collinear(numbers) }
            }
        };
        law.by_pair().values().to_vec()
    };
    Law::ByPair((0..pairs).flat_map(own).collect())
}

pub fn frictionless(pairs: usize) -> Law {
    Law::Coulomb(vec![0.0; pairs])
}

/// One to four pairs in 2D of a definite stiffness, condition up to `10^most`.
pub fn definite_case(rng: &mut Rng, most: f64, law: impl Fn(&mut Rng, usize) -> Law) -> Case {
    let pairs = rng.usize(1..=4);
    let condition = decades(rng, most);
    let k = definite(rng, 2 * pairs, condition);
    let law = law(rng, pairs);
    loaded(rng, 2, k, law)
}

/// A random case whose stiffness has a kernel.
pub fn floating_case(rng: &mut Rng, most: f64, law: impl Fn(&mut Rng, usize) -> Law) -> Case {
    let pairs = rng.usize(1..=4);
    let condition = decades(rng, most);
    let (k, _) = floating(rng, pairs, condition);
    let law = law(rng, pairs);
    loaded(rng, 2, k, law)
}

/// Friction so low that `mu sqrt(|K_nn| |(K⁻¹)_tt|)` is 0.9 at most.
pub fn contracting_case(rng: &mut Rng) -> Case {
    let mut case = definite_case(rng, 4.0, |rng, pairs| coulomb(rng, pairs, 1.0));
    let n = case.size();
    let inverse = Elimination::new(n, &case.k);
    // Frobenius norms bound the spectral ones.
    let (mut normal, mut tangential) = (0.0, 0.0);
    for j in 0..n {
        let unit: Vec<f64> = (0..n).map(|i| f64::from(u8::from(i == j))).collect();
        let column = inverse.solve(&unit).0;
        for i in (j % 2..n).step_by(2) {
            match j % 2 {
                0 => normal += case.stiffness(i, j).powi(2),
                _ => tangential += column[i].powi(2),
            }
        }
    }
    let most = 0.9 / (normal * tangential).powf(0.25);
    if let Law::Coulomb(mu) = &mut case.law {
        mu.iter_mut().for_each(|mu| *mu *= most);
    }
    case
}

//! Random contact problems at the edges of what doubles can tell, by classes. A seed makes a problem.

use fastrand::Rng;

use super::dense::{dot, norm};
use super::exact::UNIT;
use super::problems::{
    Case, Law, block, coulomb, definite, loaded, mixed, semidefinite, tresca, uniform, vector,
};

/// A problem, and what its maker knows of it.
#[derive(Clone, Debug)]
pub struct Problem {
    pub class: usize,
    pub case: Case,
    /// Independent rigid motions, which strain nothing but for rounding; none if `K` is definite.
    pub motions: Vec<Vec<f64>>,
    /// Largest error of an entry of `K`, a stiffness, beyond the rounding of the entry itself.
    pub noise: f64,
    pub tolerance: f64,
    /// `true`: other solutions are looked for.
    pub search: bool,
}

/// Name of a class and its maker.
type Class = (&'static str, fn(&mut Rng, usize) -> Made);

/// A case, its rigid motions and its noise.
type Made = (Case, Vec<Vec<f64>>, f64);

pub const CLASSES: [Class; 24] = [
    ("definite, condition to 1e3, mu to 2", ordinary),
    ("definite, condition to 1e3, mu to 1e3", high_friction),
    ("definite, thresholds", thresholds),
    ("definite, condition 1e3 to 1e15", ill_conditioned),
    ("definite, stiffness 1e13 apart", scales_apart),
    ("soft springs beside stiff ones, to 1e-15", soft_springs),
    ("rigid motions", rigid_motions),
    ("blocks, rigid motions exact", rigid_blocks),
    ("body on two or three points", few_points),
    ("duplicated pairs", duplicated),
    ("touching, on the cone, unloaded", touching),
    ("gaps to 1e300 and infinite, mu to 1e3", large_gaps),
    ("no loads", unloaded),
    ("grazing up to rounding", grazing),
    ("cohesion", cohesive),
    ("cohesion, rigid motions", cohesive_bodies),
    ("reference slips to 1e8 of the gaps", far_slips),
    ("units to 1e60", far_units),
    ("pairs that nearly coincide, to 1e-12", nearly_duplicated),
    ("ellipses to 1e6, slip along the normal", ellipses),
    ("ellipses to 1e6, slip against the force", collinear_ellipses),
    ("gaps of 1e-12 to 1e12 together", wide_gaps),
    ("a law for each pair", mixed_laws),
    ("ties", tied),
];

/// The problem of a seed: all classes in turn, in 2D and in 3D.
pub fn problem(seed: u64) -> Problem {
    problem_among(seed, CLASSES.len())
}

/// The problem of a seed among the first classes.
pub fn problem_among(seed: u64, classes: usize) -> Problem {
    let rng = &mut Rng::with_seed(seed);
    let class = seed as usize % classes;
    let dim = 2 + seed as usize / classes % 2;
    let (case, motions, noise) = CLASSES[class].1(rng, dim);
    // The default three times in ten; 0.01 and 0.1, at which errors are seen, as often.
    let tolerances = [1e-10, 1e-10, 1e-10, 1e-8, 1e-8, 1e-12, 1e-12, 1e-2, 1e-2, 0.1];
    let tolerance = tolerances[rng.usize(0..tolerances.len())];
    Problem { class, case, motions, noise, tolerance, search: dim == 2 && rng.u8(0..4) > 0 }
}

/// `10^e`, `e` uniform.
fn power(rng: &mut Rng, low: f64, high: f64) -> f64 {
    10_f64.powf(uniform(rng, low, high))
}

fn pairs(rng: &mut Rng) -> usize {
    rng.usize(1..=4)
}

fn friction(rng: &mut Rng, pairs: usize, most: f64) -> Law {
    let most = power(rng, -1.0, most.log10());
    coulomb(rng, pairs, most)
}

fn on_definite(rng: &mut Rng, dim: usize, condition: f64, most_mu: f64) -> Made {
    let pairs = pairs(rng);
    let k = definite(rng, dim * pairs, condition);
    let law = friction(rng, pairs, most_mu);
    (loaded(rng, dim, k, law), Vec::new(), 0.0)
}

fn ordinary(rng: &mut Rng, dim: usize) -> Made {
    let condition = power(rng, 0.0, 3.0);
    on_definite(rng, dim, condition, 2.0)
}

fn high_friction(rng: &mut Rng, dim: usize) -> Made {
    let condition = power(rng, 0.0, 3.0);
    on_definite(rng, dim, condition, 1e3)
}

fn thresholds(rng: &mut Rng, dim: usize) -> Made {
    let (pairs, condition) = (pairs(rng), power(rng, 0.0, 6.0));
    let k = definite(rng, dim * pairs, condition);
    let law = tresca(rng, pairs);
    (loaded(rng, dim, k, law), Vec::new(), 0.0)
}

fn ill_conditioned(rng: &mut Rng, dim: usize) -> Made {
    let condition = power(rng, 3.0, 15.0);
    on_definite(rng, dim, condition, 2.0)
}

/// Units of length that differ from component to component of an ordinary problem.
fn scales_apart(rng: &mut Rng, dim: usize) -> Made {
    let condition = power(rng, 0.0, 3.0);
    let (mut case, ..) = on_definite(rng, dim, condition, 2.0);
    let n = case.size();
    let size: Vec<f64> = (0..case.pairs)
        .flat_map(|_| vec![power(rng, -6.5, 6.5).log2().round().exp2(); dim])
        .collect();
    for i in 0..n {
        for j in 0..n {
            case.k[i + j * n] *= size[i] * size[j];
        }
        case.f[i] *= size[i];
    }
    for (pair, gap) in case.gap.iter_mut().enumerate() {
        *gap /= size[dim * pair];
    }
    if let Some(slip) = &mut case.slip {
        slip.iter_mut().enumerate().for_each(|(i, slip)| *slip /= size[dim * (i / (dim - 1))]);
    }
    (case, Vec::new(), 0.0)
}

/// Integer strains of unit stiffness and springs of `10^-U(6, 15)` to the ground: the smallest is
/// `K = [[1 + s, -1], [-1, 1 + s]]` with one pair.
fn soft_springs(rng: &mut Rng, dim: usize) -> Made {
    let pairs = rng.usize(1..=3);
    let n = dim * pairs;
    let spring = power(rng, -15.0, -6.0);
    let mut k = vec![0.0; n * n];
    for i in 0..n - 1 {
        for (a, b, value) in [(i, i, 1.0), (i + 1, i + 1, 1.0), (i, i + 1, -1.0), (i + 1, i, -1.0)]
        {
            k[a + b * n] += value;
        }
    }
    (0..n).for_each(|i| k[i + i * n] += spring);
    let law = if rng.bool() { coulomb(rng, pairs, 0.0) } else { friction(rng, pairs, 2.0) };
    let mut case = loaded(rng, dim, k, law);
    if rng.bool() {
        case.f = (0..n).map(|_| f64::from(rng.i32(-1..=1))).collect();
    }
    (case, Vec::new(), 0.0)
}

/// Translations and turns of a body with a plane face, its pairs at random places: all of them, in the
/// components (n, t) or (n, t1, t2) of the pairs.
fn plane_motions(rng: &mut Rng, dim: usize, pairs: usize) -> Vec<Vec<f64>> {
    let place: Vec<[f64; 2]> =
        (0..pairs).map(|_| [uniform(rng, -1.0, 1.0), uniform(rng, -1.0, 1.0)]).collect();
    let motion = |part: &dyn Fn(&[f64; 2]) -> Vec<f64>| place.iter().flat_map(part).collect();
    if dim == 2 {
        return vec![
            motion(&|_| vec![1.0, 0.0]),
            motion(&|_| vec![0.0, 1.0]),
            motion(&|p| vec![p[0], 0.0]),
        ];
    }
    vec![
        motion(&|_| vec![1.0, 0.0, 0.0]),
        motion(&|_| vec![0.0, 1.0, 0.0]),
        motion(&|_| vec![0.0, 0.0, 1.0]),
        motion(&|p| vec![p[0], 0.0, 0.0]),
        motion(&|p| vec![p[1], 0.0, 0.0]),
        motion(&|p| vec![0.0, -p[1], p[0]]),
    ]
}

/// `true` if no motion is nearly a sum of those before it.
fn independent(motions: &[Vec<f64>]) -> bool {
    let mut basis: Vec<Vec<f64>> = Vec::new();
    motions.iter().all(|motion| {
        let mut rest = motion.clone();
        for q in &basis {
            let share = dot(q, &rest);
            rest.iter_mut().zip(q).for_each(|(rest, q)| *rest -= share * q);
        }
        let length = norm(&rest);
        basis.push(rest.iter().map(|rest| rest / length).collect());
        length > 0.1 * norm(motion)
    })
}

/// Some motions of a plane body, or any vectors.
fn rigid_motions(rng: &mut Rng, dim: usize) -> Made {
    loop {
        let pairs = pairs(rng);
        let n = dim * pairs;
        let mut motions = plane_motions(rng, dim, pairs);
        rng.shuffle(&mut motions);
        motions.truncate(rng.usize(1..=motions.len()).min(n - 1));
        if rng.u8(0..4) == 0 {
            motions.iter_mut().for_each(|motion| *motion = vector(rng, n));
        }
        if !independent(&motions) {
            continue;
        }
        let condition = power(rng, 0.0, 4.0);
        let k = semidefinite(rng, n, condition, &motions);
        // A component that nothing resists is the class of few points.
        if (0..n).all(|i| k[i + i * n] > 1e-3 / condition) {
            let law =
                if rng.u8(0..4) == 0 { tresca(rng, pairs) } else { friction(rng, pairs, 5.0) };
            return (loaded(rng, dim, k, law), motions, 0.0);
        }
    }
}

/// Entries are integers, and so are the motions: no rounding. In 3D the block of the plane with a
/// second tangential component that springs hold.
fn rigid_blocks(rng: &mut Rng, dim: usize) -> Made {
    let pairs = rng.usize(3..=4);
    let plane = block(rng, pairs);
    let n = dim * pairs;
    let at = |i: usize| dim * (i / 2) + i % 2;
    let mut k = vec![0.0; n * n];
    for i in 0..2 * pairs {
        for j in 0..2 * pairs {
            k[at(i) + at(j) * n] = plane[i + j * 2 * pairs];
        }
    }
    if dim == 3 {
        (0..pairs).for_each(|pair| k[(3 * pair + 2) * (n + 1)] = f64::from(rng.i32(1..=8)));
    }
    let motion = |part: &dyn Fn(usize) -> [f64; 2]| {
        let mut r = vec![0.0; n];
        for pair in 0..pairs {
            r[dim * pair..dim * pair + 2].copy_from_slice(&part(pair));
        }
        r
    };
    let turn = |pair: usize| [pair as f64, 0.0];
    let motions = vec![motion(&|_| [1.0, 0.0]), motion(&|_| [0.0, 1.0]), motion(&turn)];
    let law = if rng.u8(0..4) == 0 { tresca(rng, pairs) } else { friction(rng, pairs, 5.0) };
    (loaded(rng, dim, k, law), motions, 0.0)
}

/// A free body on as many points as turn it about each of them: its normal stiffness is rounding, here
/// of a condensation, some units of the largest entry. Mostly pressed, gaps closed.
fn few_points(rng: &mut Rng, dim: usize) -> Made {
    let motions = loop {
        let motions = plane_motions(rng, dim, dim);
        if independent(&motions) {
            break motions;
        }
    };
    let n = dim * dim;
    let stiffness = power(rng, 0.0, 6.0);
    let mut k = semidefinite(rng, n, 10.0, &motions);
    let noise = 4.0 * UNIT * stiffness;
    for i in 0..n {
        for j in 0..=i {
            let entry = k[i + j * n] * stiffness + uniform(rng, -noise, noise);
            (k[i + j * n], k[j + i * n]) = (entry, entry);
        }
    }
    let mu = [0.0, 0.3, 1.0][rng.usize(0..3)];
    let side = rng.f64();
    let load = |rng: &mut Rng, i: usize| match i % dim {
        0 => rng.f64(),
        _ => side * uniform(rng, -1.0, 1.0),
    };
    let f = (0..n).map(|i| load(rng, i)).collect();
    let gap = vec![0.0; dim];
    let law = Law::Coulomb(vec![mu; dim]);
    (Case { dim, pairs: dim, k, f, gap, law, slip: None }, motions, noise)
}

/// A pair that stands twice: `K` sees the sum of both displacements, and the loads are alike.
fn duplicated(rng: &mut Rng, dim: usize) -> Made {
    let (once, ..) = ordinary(rng, dim);
    let keep = once.pairs.min(3);
    let source: Vec<usize> = (0..=keep).map(|pair| pair.min(keep - 1)).collect();
    let (pairs, n) = (source.len(), dim * source.len());
    let at = |i: usize| dim * source[i / dim] + i % dim;
    let k = (0..n * n).map(|e| once.stiffness(at(e % n), at(e / n))).collect();
    let f = (0..n).map(|i| once.f[at(i)]).collect();
    let gap = source.iter().map(|&pair| once.gap[pair]).collect();
    let Law::Coulomb(mu) = &once.law else { unreachable!("ordinary friction is Coulomb's") };
    let law = Law::Coulomb(source.iter().map(|&pair| mu[pair]).collect());
    let slips = dim - 1;
    let slip = once.slip.map(|slip| {
        source.iter().flat_map(|&pair| slip[slips * pair..slips * (pair + 1)].to_vec()).collect()
    });
    // One body moves and the other moves back.
    let motions = (0..dim)
        .map(|c| {
            let mut r = vec![0.0; n];
            (r[n - 2 * dim + c], r[n - dim + c]) = (1.0, -1.0);
            r
        })
        .collect();
    (Case { dim, pairs, k, f, gap, law, slip }, motions, 0.0)
}

/// Built from an answer in small integers, so that nothing is rounded: pairs that touch without force,
/// forces on the edge of the cone without slip, both; or no loads at all.
fn touching(rng: &mut Rng, dim: usize) -> Made {
    let pairs = pairs(rng);
    let n = dim * pairs;
    let mut k = vec![0.0; n * n];
    (0..n).for_each(|i| k[i + i * n] = f64::from(rng.i32(1..=4)));
    for _ in 0..n {
        let strain: Vec<f64> = (0..n).map(|_| f64::from(rng.i32(-2..=2))).collect();
        super::problems::add_spring(&mut k, &strain, 1.0);
    }
    let mu = f64::from(rng.i32(0..=4)) / 2.0;
    let unloaded = rng.u8(0..6) == 0;
    let d: Vec<f64> = (0..n).map(|_| f64::from(rng.i32(-3..=3))).collect();
    let mut f: Vec<f64> = (0..n).map(|i| (0..n).map(|j| k[i + j * n] * d[j]).sum()).collect();
    let (mut gap, mut slip) = (Vec::new(), Vec::new());
    for pair in 0..pairs {
        let i = dim * pair;
        let pressure = f64::from(rng.i32(0..=2));
        let apart = if pressure > 0.0 || rng.bool() { 0.0 } else { f64::from(rng.i32(0..=2)) };
        gap.push(d[i] + apart);
        slip.extend_from_slice(&d[i + 1..i + dim]);
        // K d - F, with F_n = -pressure and F_t on the edge of the cone or inside it.
        f[i] += pressure;
        f[i + 1 + rng.usize(0..dim - 1)] += mu * pressure * f64::from(rng.i32(-1..=1));
    }
    if unloaded {
        f.fill(0.0);
    }
    let law = Law::Coulomb(vec![mu; pairs]);
    (Case { dim, pairs, k, f, gap, law, slip: Some(slip) }, Vec::new(), 0.0)
}

fn large_gaps(rng: &mut Rng, dim: usize) -> Made {
    let (mut case, ..) = high_friction(rng, dim);
    for gap in &mut case.gap {
        match rng.u8(0..4) {
            0 => *gap = power(rng, 0.0, 12.0),
            1 => *gap = power(rng, 0.0, 300.0),
            _ => {}
        }
    }
    (case, Vec::new(), 0.0)
}

/// Interferences and reference slips alone drive it, of a definite matrix or of a body with rigid motions.
fn unloaded(rng: &mut Rng, dim: usize) -> Made {
    let (mut case, motions, noise) = match rng.bool() {
        true => ordinary(rng, dim),
        false => rigid_motions(rng, dim),
    };
    case.f.fill(0.0);
    for gap in &mut case.gap {
        let some = if gap.is_finite() { *gap } else { 1.0 };
        *gap = [*gap, -some, -some.abs(), 0.0][rng.usize(0..4)];
    }
    (case, motions, noise)
}

/// As [`touching`], in units that are no powers of two: what was zero there is rounding, of either sign.
fn grazing(rng: &mut Rng, dim: usize) -> Made {
    let (mut case, motions, noise) = touching(rng, dim);
    let (length, force) = (power(rng, -3.0, 3.0), power(rng, -3.0, 3.0));
    let rounded =
        |values: &mut [f64], unit: f64| values.iter_mut().for_each(|value| *value *= unit);
    rounded(&mut case.k, force / length);
    rounded(&mut case.f, force);
    rounded(&mut case.gap, length);
    case.slip.iter_mut().for_each(|slip| rounded(slip, length));
    (case, motions, noise)
}

/// `b >= mu a`, both of the size of the loads; where both are equal the cone is moved, and zero tension is Coulomb's law
/// with an offset.
fn with_cohesion(rng: &mut Rng, case: &mut Case) {
    let size = norm(&case.f).max(f64::MIN_POSITIVE);
    let most = power(rng, -1.0, 1.0);
    let numbers = (0..case.pairs).flat_map(|_| {
        let mu = most * rng.f64();
        let tension = [0.0, size * rng.f64(), 1e-3 * size * rng.f64()][rng.usize(0..3)];
        let more = [0.0, size * rng.f64()][rng.usize(0..2)];
        [mu, mu * tension + more, tension]
    });
    case.law = Law::Cohesive(numbers.collect());
}

fn cohesive(rng: &mut Rng, dim: usize) -> Made {
    let condition = power(rng, 0.0, 6.0);
    let (mut case, motions, noise) = on_definite(rng, dim, condition, 1.0);
    with_cohesion(rng, &mut case);
    (case, motions, noise)
}

fn cohesive_bodies(rng: &mut Rng, dim: usize) -> Made {
    let (mut case, motions, noise) = rigid_motions(rng, dim);
    with_cohesion(rng, &mut case);
    (case, motions, noise)
}

fn far_slips(rng: &mut Rng, dim: usize) -> Made {
    let (mut case, motions, noise) = ordinary(rng, dim);
    let gaps = case.gap.iter().filter(|gap| gap.is_finite());
    let size = power(rng, 0.0, 8.0) * gaps.fold(0.1, |most: f64, gap| most.max(gap.abs()));
    let slips = case.pairs * (dim - 1);
    case.slip = Some((0..slips).map(|_| size * uniform(rng, -1.0, 1.0)).collect());
    (case, motions, noise)
}

/// Units that are powers of two, of lengths and of forces: squares of all numbers are in range.
fn far_units(rng: &mut Rng, dim: usize) -> Made {
    let (mut case, motions, noise) = ordinary(rng, dim);
    let [length, force] = [(); 2].map(|()| 2_f64.powi(rng.i32(-100..=100)));
    let times = |values: &mut [f64], unit: f64| values.iter_mut().for_each(|value| *value *= unit);
    times(&mut case.k, force / length);
    times(&mut case.f, force);
    times(&mut case.gap, length);
    case.slip.iter_mut().for_each(|slip| times(slip, length));
    (case, motions, noise)
}

/// A pair that stands twice, a soft spring between both: definite, and ill-conditioned.
fn nearly_duplicated(rng: &mut Rng, dim: usize) -> Made {
    let (mut case, motions, noise) = duplicated(rng, dim);
    let spring = power(rng, -12.0, -2.0);
    for motion in &motions {
        super::problems::add_spring(&mut case.k, motion, spring);
    }
    (case, Vec::new(), noise)
}

/// Coefficients up to 1e6 apart: in space those of a pair, along axes at any angle, in the plane those of pairs.
fn ellipses(rng: &mut Rng, dim: usize) -> Made {
    let condition = power(rng, 0.0, 3.0);
    let (mut case, motions, noise) = on_definite(rng, dim, condition, 1.0);
    let most = power(rng, -2.0, 2.0);
    // The header admits a quotient of 1e6 after its rounding.
    let other = |rng: &mut Rng| most * power(rng, -6.0, 0.0).max(1.000_001e-6);
    if dim == 2 {
        case.law = Law::Coulomb((0..case.pairs).map(|_| other(rng)).collect());
        return (case, motions, noise);
    }
    let numbers = (0..case.pairs).flat_map(|_| {
        let mu = if rng.bool() { [most, other(rng)] } else { [other(rng), most] };
        let angle = if rng.u8(0..4) == 0 { 0.0 } else { uniform(rng, -10.0, 10.0) };
        [mu[0], mu[1], angle]
    });
    case.law = Law::Orthotropic(numbers.collect());
    (case, motions, noise)
}

fn collinear_ellipses(rng: &mut Rng, dim: usize) -> Made {
    let (mut case, motions, noise) = ellipses(rng, dim);
    if let Law::Orthotropic(numbers) = case.law {
        case.law = Law::Collinear(numbers);
    }
    (case, motions, noise)
}

/// Gaps over 24 decades beside each other, on an ill-conditioned matrix too.
fn wide_gaps(rng: &mut Rng, dim: usize) -> Made {
    let condition = power(rng, 0.0, 6.0);
    let (mut case, motions, noise) = on_definite(rng, dim, condition, 10.0);
    for gap in &mut case.gap {
        let sign = if rng.u8(0..4) == 0 { -1.0 } else { 1.0 };
        *gap = sign * power(rng, -12.0, if sign < 0.0 { 0.0 } else { 12.0 });
    }
    (case, motions, noise)
}

/// Laws of all kinds but ties, on a definite matrix or on a body with rigid motions.
fn mixed_laws(rng: &mut Rng, dim: usize) -> Made {
    let (mut case, motions, noise) = match rng.bool() {
        true => ordinary(rng, dim),
        false => rigid_motions(rng, dim),
    };
    let most = power(rng, -1.0, 1.0);
    case.law = mixed(rng, (dim, case.pairs), most);
    (case, motions, noise)
}

/// As [`mixed_laws`], some pairs tied, or all of them.
fn tied(rng: &mut Rng, dim: usize) -> Made {
    let (mut case, motions, noise) = mixed_laws(rng, dim);
    if rng.u8(0..4) == 0 {
        case.law = Law::Tied;
    } else if let Law::ByPair(numbers) = &mut case.law {
        let first = rng.usize(0..case.pairs);
        let own = numbers.chunks_exact_mut(4).enumerate();
        let tied = own.filter(|(pair, _)| *pair == first || rng.bool());
        tied.for_each(|(_, numbers)| numbers.copy_from_slice(&[7.0, 0.0, 0.0, 0.0]));
    }
    // A tie without an obstacle is a pair without a law.
    for gap in case.gap.iter_mut().filter(|gap| !gap.is_finite()) {
        *gap = uniform(rng, -1.0, 1.0);
    }
    (case, motions, noise)
}

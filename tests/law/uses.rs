//! The law's services to methods, against mechanics: the step of a sweep minimises the energy of its
//! pair, motions of recession take no work from contact forces, cones hold their forces, and the
//! variables of the complementarity problem name the piece of the normal map.

use crate::laws::{Numbers, direction, dot, uniform};
use fastrand::Rng;
use signorini::law::Rule;

const POINTS: usize = 20_000;

/// Rounding of a few operations on numbers up to about 1000.
const ROUNDING: f64 = 1e-11;

/// A pair in a sweep: its law, its block of `K`, and where it is.
struct Pair {
    law: Numbers,
    /// `K_tn`.
    coupling: [f64; 2],
    /// `K_tt`, its largest eigenvalue `k_t`.
    block: [[f64; 2]; 2],
    d: Vec<f64>,
    /// `K d - f`.
    force: Vec<f64>,
}

impl Pair {
    fn random(rng: &mut Rng, dim: usize) -> Pair {
        let law = Numbers::random_in(rng, dim);
        // [k_n, c; c, B] is definite with |c|² < k_n times the least eigenvalue of B: its trace less the
        // largest one.
        let (k_n, k_t) = law.k;
        let least = if dim == 2 { k_t } else { k_t * uniform(rng, 0.1, 1.0) };
        let [x, y] = direction(rng, dim);
        let block = [
            [k_t * x * x + least * y * y, (k_t - least) * x * y],
            [(k_t - least) * x * y, k_t * y * y + least * x * x],
        ];
        let share = uniform(rng, 0.0, 0.95) * (k_n * least).sqrt();
        let coupling = direction(rng, dim).map(|c| share * c);
        let (mut d, mut force) = (vec![0.0; dim], vec![0.0; dim]);
        d.iter_mut().for_each(|d| *d = uniform(rng, -2.0, 2.0));
        force.iter_mut().for_each(|force| *force = uniform(rng, -4.0, 4.0));
        d[0] = d[0].min(law.gap);
        if rng.u8(0..4) == 0 {
            d[1..].copy_from_slice(&law.slip0[..dim - 1]);
        }
        Pair { law, coupling, block, d, force }
    }

    /// Energy of the pair at `d`, beside that where it is, with the threshold `g`; other pairs stay.
    fn energy(&self, d: &[f64], g: f64) -> f64 {
        let moved: Vec<f64> = d.iter().zip(&self.d).map(|(d, before)| d - before).collect();
        let mut energy = dot(&self.force, &moved) + self.law.k.0 * moved[0] * moved[0] / 2.0;
        energy -= self.law.tension * moved[0];
        for c in 1..d.len() {
            energy += self.coupling[c - 1] * moved[0] * moved[c];
            for other in 1..d.len() {
                energy += self.block[c - 1][other - 1] * moved[c] * moved[other] / 2.0;
            }
        }
        let slip: Vec<f64> = d[1..].iter().zip(&self.law.slip0).map(|(d, rest)| d - rest).collect();
        let before = self.d[1..].iter().zip(&self.law.slip0).map(|(d, rest)| d - rest);
        let work = |slip: &[f64]| self.law.most_work(g, slip);
        energy + work(&slip) - work(&before.collect::<Vec<_>>())
    }

    /// `d` after a step, and the threshold at the pressure that the normal step has left.
    fn step(&self, omega: f64) -> (Vec<f64>, f64) {
        let mut d = self.d.clone();
        let dim = self.law.dim;
        let law = self.law.law();
        let (steps, change) = law.relax(&mut d, &self.force, &self.coupling[..dim - 1], omega);
        let mut sum = 0.0;
        let scaled = self.law.scaled(&steps[1..]);
        for i in 0..dim {
            assert!((d[i] - self.d[i] - steps[i]).abs() <= ROUNDING);
            sum += if i == 0 { self.law.k.0 * steps[0] } else { scaled[i - 1] } * steps[i];
        }
        assert!((sum - change).abs() <= ROUNDING * (1.0 + sum));
        let pressure = (-(self.force[0] + self.law.k.0 * steps[0])).max(-self.law.tension);
        (d, self.law.threshold(pressure))
    }
}

/// Normal: the energy is a parabola on `d_n <= gap`. Tangential: it is one on either side of no slip.
/// So the minimum is among these candidates.
#[test]
fn in_the_plane_a_step_minimises_the_energy_of_its_pair() {
    let rng = &mut Rng::with_seed(1);
    for _ in 0..POINTS {
        let pair = Pair::random(rng, 2);
        let (k_n, k_t) = pair.law.k;
        let (d, g) = pair.step(1.0);
        let normals = [pair.d[0] - (pair.force[0] - pair.law.tension) / k_n, pair.law.gap];
        let at = |d_n: f64| pair.energy(&[d_n, pair.d[1]], g);
        let least = normals
            .into_iter()
            .filter(|d_n| d_n.is_finite() && *d_n <= pair.law.gap)
            .map(at)
            .fold(f64::INFINITY, f64::min);
        assert!(d[0] <= pair.law.gap);
        assert!((at(d[0]) - least).abs() <= ROUNDING, "{:?}: {d:?}", pair.law);

        let trial = pair.force[1] + pair.coupling[0] * (d[0] - pair.d[0]);
        let slipped = |side: f64| pair.d[1] - (trial + side * g) / k_t;
        let tangentials = [pair.law.slip0[0], slipped(1.0), slipped(-1.0)];
        let at = |d_t: f64| pair.energy(&[d[0], d_t], g);
        let least = tangentials.into_iter().map(at).fold(f64::INFINITY, f64::min);
        assert!((at(d[1]) - least).abs() <= ROUNDING, "{:?}: {d:?}", pair.law);
    }
}

#[test]
fn a_step_lowers_the_energy_of_its_pair() {
    let rng = &mut Rng::with_seed(2);
    let mut lowered = 0;
    for _ in 0..POINTS {
        let dim = rng.usize(2..=3);
        let pair = Pair::random(rng, dim);
        if pair.law.axes.is_some_and(|axes| axes.rule == Rule::Collinear) {
            // Not the minimum of an energy.
            continue;
        }
        let (d, g) = pair.step(uniform(rng, 0.01, 1.99));
        let energy = pair.energy(&d, g);
        assert!(energy <= ROUNDING, "{:?} to {d:?}: {energy}", pair.law);
        lowered += usize::from(energy < -1e-6);
    }
    assert!(lowered > POINTS / 2, "{lowered}");
}

/// A force that the pair can carry.
fn admissible(rng: &mut Rng, law: &Numbers) -> Vec<f64> {
    let p = if law.has_obstacle() { uniform(rng, 0.0, 2.0) } else { 0.0 } - law.tension;
    let h = direction(rng, law.dim);
    let tau = law.threshold(p) * rng.f64() / law.size(&h[..law.dim - 1]);
    let mut force = vec![-p, tau * h[0], tau * h[1]];
    force.truncate(law.dim);
    force
}

#[test]
fn contact_forces_take_no_more_work_than_said_from_a_recession() {
    let rng = &mut Rng::with_seed(3);
    for _ in 0..POINTS {
        let law = Numbers::random(rng);
        let slide = if rng.u8(0..5) == 0 { 0.0 } else { uniform(rng, 0.0, 2.0) };
        let h = direction(rng, law.dim);
        let mut r = vec![0.0, slide * h[0], slide * h[1]];
        r.truncate(law.dim);
        // Just admissible, and beyond that.
        let lift = law.most_work(law.bound.slope, &r[1..]);
        let beyond = if rng.bool() { 0.0 } else { uniform(rng, 0.0, 1.0) };
        r[0] = -lift - beyond;
        let motion = law.law().recession(&r);
        assert!((motion.lift - lift).abs() <= ROUNDING);
        match law.has_obstacle() {
            true => assert!((motion.approach + beyond).abs() <= ROUNDING),
            false => assert!(motion.approach < 0.0, "nothing to approach"),
        }
        for _ in 0..5 {
            let force = admissible(rng, &law);
            let work = dot(&force, &r);
            assert!(
                work >= law.tension * r[0] - motion.resisted - ROUNDING,
                "{law:?} {r:?} {force:?}"
            );
        }
        // The bound is met: by the force on the bound that takes most work from the slip, which of an
        // ellipse is diag(mu²) times the slip in its axes, scaled.
        let p = if law.has_obstacle() { 1.0 } else { 0.0 };
        let g = law.threshold(p - law.tension);
        let most = law.axes.map_or(h, |axes| {
            let along = axes.along(&h);
            axes.of([along[0] * axes.mu[0].powi(2), along[1] * axes.mu[1].powi(2)])
        });
        let against = g / law.size(&most[..law.dim - 1]);
        let mut force = vec![law.tension - p, -against * most[0], -against * most[1]];
        force.truncate(law.dim);
        let work = dot(&force, &r) - law.tension * r[0] - p * beyond;
        assert!((work + motion.resisted).abs() <= ROUNDING, "{law:?} {r:?}");
        let is_cone = law.bound.offset == 0.0 && law.tension == 0.0;
        if law.has_obstacle() && is_cone && slide > 0.0 {
            let edge = law.law().opposing_edge(&r);
            let off = edge.iter().zip(&force).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(off <= ROUNDING, "{law:?} {r:?}: {edge:?} {force:?}");
        }
        // Nearer to the obstacle some force takes more.
        if law.has_obstacle() {
            r[0] += beyond + 0.1;
            assert!(law.law().recession(&r).approach > 0.0);
            assert!(dot(&force, &r) < law.tension * r[0] - motion.resisted);
        }
    }
}

/// Edges lie on the cone; in the plane they hold all of it.
#[test]
fn edges_lie_on_the_friction_cone() {
    let rng = &mut Rng::with_seed(4);
    for _ in 0..POINTS / 10 {
        let mut law = Numbers::random(rng);
        (law.bound.offset, law.tension) = (0.0, 0.0);
        let edges = law.law().cone_edges();
        let mu = law.bound.slope;
        let expected = match law.dim {
            _ if !law.has_obstacle() => 0,
            _ if mu == 0.0 => 1,
            dim => 2 * (dim - 1),
        };
        assert_eq!(edges.len(), expected, "{law:?}");
        for edge in &edges {
            assert_eq!(edge[0], -1.0);
            assert!((law.size(&edge[1..law.dim]) - mu).abs() <= ROUNDING, "{law:?} {edge:?}");
        }
        // They stand on both sides of the normal, and in space no two of them on one line but those.
        if expected > 1 {
            for edge in edges.chunks_exact(2) {
                assert!((edge[0][1] + edge[1][1]).abs() <= ROUNDING, "{edges:?}");
                assert!((edge[0][2] + edge[1][2]).abs() <= ROUNDING, "{edges:?}");
            }
        }
        if expected == 4 {
            let across = edges[0][1] * edges[2][2] - edges[0][2] * edges[2][1];
            assert!(across.abs() > 0.0, "{law:?} {edges:?}");
        }
    }
}

#[test]
fn variables_name_the_branch_of_the_normal_map() {
    let rng = &mut Rng::with_seed(5);
    for _ in 0..POINTS {
        let law = Numbers::random_in(rng, 2);
        let (v, p) = law.point(rng, 1e-6);
        let most = if law.has_obstacle() { 1.0 } else { 0.0 };
        let friction = law.threshold(most - law.tension) > 0.0;
        // A pair without the variable has 0.
        let clearance = if law.has_obstacle() { -v[0] } else { 0.0 };
        let slip = if law.has_obstacle() || friction { v[1] } else { 0.0 };
        let named = law.law().piece_of_variables(clearance, slip.max(0.0), (-slip).max(0.0));
        let piece = law.law().piece(&law.trial(&v, &p));
        assert_eq!(named, piece, "{law:?} at {v:?} {p:?}");
    }
}

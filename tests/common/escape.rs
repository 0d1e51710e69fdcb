//! The judge of a motion that is to prove that no equilibrium exists, in twice the precision.

use super::dense::dot;
use super::edges::Problem;
use super::ellipses::axes;
use super::exact::{UNIT, force, largest_stiffness, quads, work};
use super::problems::{Case, Law};
use super::quad::norm;

/// Why `r` does not prove that there is no equilibrium: how far it is from that, beside what is allowed,
/// and a sentence. It does if `K r = 0` up to the rounding of the entries, `-r_n >= mu |r_t|` at
/// obstacles, and `(f + a) . r > sum (b - mu a) |r_t|` with the tension `a`, each up to the rounding of its terms.
pub fn flaw_of_motion(problem: &Problem, r: &[f64]) -> Option<(f64, String)> {
    let Problem { case, noise, .. } = problem;
    let (n, dim) = (case.size(), case.dim);
    let few = 4.0 * n as f64 * UNIT;
    let unloaded = Case { f: vec![0.0; n], ..case.clone() };
    let strain = force(&unloaded, &quads(r));
    // The products that make K of rigid motions round beside its largest entries.
    let rounded = if problem.motions.is_empty() { 0.0 } else { few * largest_stiffness(case) };
    let noise = noise + rounded;
    let most = r.iter().fold(0.0, |most: f64, r| most.max(r.abs()));
    let least = few * most + 2.0 * distance_to(&problem.motions, r);
    let root: Vec<f64> = (0..n).map(|i| case.stiffness(i, i).abs().sqrt()).collect();
    let total: f64 = root.iter().zip(r).map(|(root, r)| root * r.abs()).sum();
    for i in 0..n {
        let entry = |j: usize| (few * root[i] * root[j] + noise) * r[j].abs();
        let allowed: f64 = (0..n).map(entry).sum();
        if strain[i].abs().value() > allowed {
            let size = strain[i].abs().value();
            return Some((size / allowed, format!("|(K r)[{i}]| = {size:.1e} > {allowed:.1e}")));
        }
    }
    let (mut resisted, mut pulled) = (0.0, 0.0);
    for pair in 0..case.pairs {
        let part = &r[dim * pair..dim * (pair + 1)];
        // A motion of the size of rounding beside the largest is none, nor is one as small as its distance to the
        // motions of the maker: those of K as it is given are as far from them. Nor is one that strains K by rounding.
        let strained = few * total / root[dim * pair];
        if matches!(case.law.own(pair), Law::Tied) {
            let moved = part.iter().fold(0.0, |most: f64, r| most.max(r.abs()));
            let allowed = least + strained;
            if moved > allowed {
                return Some((
                    moved / allowed,
                    format!("the tied pair {pair} moves by {moved:.1e}"),
                ));
            }
            continue;
        }
        let along = quads(&part[1..]);
        let slide = axes(case, pair).map_or_else(|| norm(&along), |axes| axes.work(&along)).value();
        let [slope, offset, tension] = case.law.of(pair);
        let lift = slope * slide;
        resisted += (offset - slope * tension) * slide;
        pulled += tension * part[0];
        let allowed = few * (part[0].abs() + lift);
        let approach = part[0] + lift;
        let allowed = allowed + (1.0 + slope) * (least + strained);
        if case.gap[pair].is_finite() && approach > allowed {
            let size = approach / allowed;
            return Some((size, format!("contact can stop it at pair {pair}: {approach:.1e}")));
        }
    }
    let loads: f64 = (0..n).map(|i| (case.f[i] * r[i]).abs()).sum();
    let driven = work(&case.f, r) + pulled - resisted;
    let parts = loads + resisted + f64::abs(pulled);
    (driven <= few * parts).then(|| (f64::INFINITY, format!("the loads do the work {driven:.1e}")))
}

/// Largest component of what is left of `r` beside the motions.
fn distance_to(motions: &[Vec<f64>], r: &[f64]) -> f64 {
    let mut basis: Vec<Vec<f64>> = Vec::new();
    let without = |basis: &[Vec<f64>], v: &[f64]| {
        let mut rest = v.to_vec();
        for q in basis.iter().chain(basis) {
            let share = dot(q, &rest);
            rest.iter_mut().zip(q).for_each(|(rest, q)| *rest -= share * q);
        }
        rest
    };
    for motion in motions {
        let rest = without(&basis, motion);
        let length = dot(&rest, &rest).sqrt();
        basis.push(rest.iter().map(|rest| rest / length).collect());
    }
    without(&basis, r).iter().fold(0.0, |most: f64, rest| most.max(rest.abs()))
}

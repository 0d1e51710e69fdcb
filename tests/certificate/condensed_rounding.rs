//! The rounding of a host's condensed matrix, from both sides: motions whose energy is at most 9e-12
//! of the diagonals are free, those from 3e-10 on are held, and a matrix with one between is taken as it is. It is
//! looked at only where an entry of the diagonal is as small as that beside its pair's. In a proof that no equilibrium
//! exists such a motion is free if the matrix shows, by an energy below zero, that it is rounded so.

use crate::common::problems::{Case, add_spring, frictionless};
use signorini::certificate::is_escape;
use signorini::{Argument, Error, Model};

/// Blocks of two components, `u [[1, c], [c, c^2 + e]]`: the motion `(-c, 1)` has the energy `u e`.
fn blocks(parts: &[[f64; 3]]) -> Vec<f64> {
    let size = 2 * parts.len();
    let mut k = vec![0.0; size * size];
    for (block, [unit, c, e]) in parts.iter().enumerate() {
        let at = 2 * block * (size + 1);
        (k[at], k[at + 1], k[at + size]) = (*unit, unit * c, unit * c);
        k[at + size + 1] = unit * (c * c + e);
    }
    k
}

fn stiffness(k: &[f64], dim: usize) -> Vec<f64> {
    let size = k.len().isqrt();
    Model::condensed(dim, size / dim, k, size).unwrap().stiffness().to_vec()
}

/// `(-c, 1) . K (-c, 1)` of a block.
fn energy(k: &[f64], size: usize, block: usize, c: f64) -> f64 {
    let at = 2 * block * (size + 1);
    (k[at] * c - 2.0 * k[at + 1]) * c + k[at + size + 1]
}

/// Small and not: in all units.
const UNITS: [f64; 3] = [1.0 / (1_u64 << 40) as f64, 1.0, (1_u64 << 40) as f64];

/// The coupling of a block whose second entry is small: its square is 9.1e-13.
const SMALL: f64 = 1.0 / (1 << 20) as f64;

/// A motion of 2e-12 becomes free; another pair, whose soft motion of 1e-9 is held, stays as it is but for rounding.
#[test]
fn free_motions_become_free_and_held_ones_stay() {
    for free in UNITS {
        for held in UNITS {
            let k = blocks(&[[free, SMALL, 2e-12], [held, 1e-2, 1e-9]]);
            let cleaned = stiffness(&k, 2);
            assert!(energy(&k, 4, 0, SMALL) > 1.9e-12 * free);
            // Rounding of the entries, of which the first is the unit.
            let left = energy(&cleaned, 4, 0, SMALL).abs();
            assert!(left <= 1e-15 * free, "{free:e}, {held:e}: {left:e}");
            for at in [10, 11, 14, 15] {
                let off = (cleaned[at] - k[at]).abs();
                assert!(off <= 1e-14 * held, "{free:e}, {held:e}: {at} by {off:e}");
            }
        }
    }
}

/// A motion of 1e-10 cannot be told: the whole matrix is taken as it is, to the last bit.
#[test]
fn what_cannot_be_told_is_taken_as_it_is() {
    for free in UNITS {
        for unclear in UNITS {
            let k = blocks(&[[free, SMALL, 2e-12], [unclear, 1e-2, 1e-10]]);
            assert_eq!(stiffness(&k, 2), k, "{free:e}, {unclear:e}");
        }
    }
}

/// Where no entry of the diagonal is small beside its pair's, nothing is changed, whatever motions are free; nor is
/// a spring that is coupled to nothing, however soft.
#[test]
fn what_looks_sound_is_taken_as_it_is() {
    for unit in UNITS {
        let floating = blocks(&[[unit, -1.0, 1e-15], [unit, 1e-2, 1e-12]]);
        assert_eq!(stiffness(&floating, 2), floating);
        for soft in [1e-13, 1e-30] {
            let spring = blocks(&[[unit, 0.0, soft], [unit, 0.0, 1.0]]);
            assert_eq!(stiffness(&spring, 2), spring, "{soft:e}");
            // Beside another motion that becomes free it stays too, but for rounding.
            let both = blocks(&[[unit, 0.0, soft], [unit, SMALL, 2e-12]]);
            let cleaned = stiffness(&both, 2);
            assert!((cleaned[5] - both[5]).abs() <= 1e-15 * both[5], "{soft:e}");
            assert!(energy(&cleaned, 4, 1, SMALL).abs() <= 1e-15 * unit);
        }
    }
}

/// Nor does a component that nothing resists, coupled to nothing, keep the motion of another pair from becoming free.
#[test]
fn what_nothing_resists_hides_nothing() {
    for unit in UNITS {
        let k = blocks(&[[unit, 0.0, 0.0], [unit, SMALL, 2e-12]]);
        let cleaned = stiffness(&k, 2);
        assert_eq!(cleaned[..8], k[..8]);
        assert!(energy(&cleaned, 4, 1, SMALL).abs() <= 1e-15 * unit);
    }
}

/// A matrix with an entry of rounding is refused as any other: not symmetric, not finite.
#[test]
fn rounding_does_not_hide_what_is_wrong() {
    let sound = blocks(&[[1.0, SMALL, 2e-12], [1.0, 0.5, 1.0]]);
    for (at, value, part) in
        [(11, 0.75, "not symmetric"), (2, 0.5, "not symmetric"), (15, f64::NAN, "not finite")]
    {
        let mut k = sound.clone();
        k[at] = value;
        match Model::condensed(2, 2, &k, 4) {
            Err(Error::Invalid { argument: Argument::Matrix, message }) => {
                assert!(message.contains(part), "{message}");
            }
            other => panic!("{at}: {:?}", other.map(|model| model.stiffness().to_vec())),
        }
    }
}

/// Pairs of a chain.
const CHAIN: usize = 8;

/// True if a chain whose springs `spring` join the components `component` of its pairs is driven away as a whole, held by
/// the springs `grounds` of its pairs; the others components have springs of 1. Beside it stand parts of two pairs each,
/// `unit [[1, -1], [-1, 1 - below]]`: the energy of `(1, 1)` is `below` under zero, of terms of 4.
fn escapes(component: usize, spring: f64, grounds: [f64; CHAIN], parts: &[[f64; 2]]) -> bool {
    let pairs = CHAIN + 2 * parts.len();
    let n = 2 * pairs;
    let (mut k, mut f, mut motion) = (vec![0.0; n * n], vec![0.0; n], vec![0.0; n]);
    (0..n).filter(|i| i % 2 != component).for_each(|i| k[i * (n + 1)] = 1.0);
    for (pair, ground) in grounds.into_iter().enumerate() {
        let at = 2 * pair + component;
        (f[at], motion[at]) = (1.0, 1.0);
        let mut strain = vec![0.0; n];
        strain[at] = 1.0;
        add_spring(&mut k, &strain, ground);
        if pair > 0 {
            strain[at - 2] = -1.0;
            add_spring(&mut k, &strain, spring);
        }
    }
    for (part, [unit, below]) in parts.iter().enumerate() {
        let [one, two] = [0, 1].map(|i| 2 * (CHAIN + 2 * part + i) + component);
        (k[one * (n + 1)], k[two * (n + 1)]) = (*unit, unit * (1.0 - below));
        (k[one + n * two], k[two + n * one]) = (-unit, -unit);
    }
    let gap = vec![f64::INFINITY; pairs];
    is_escape(
        &Case { dim: 2, pairs, k, f, gap, law: frictionless(pairs), slip: None }.problem(),
        &motion,
    )
}

/// Ground springs of `2^exponent` at all pairs, or at the last alone.
fn grounds(exponent: i32, last_alone: bool) -> [f64; CHAIN] {
    let mut grounds = [if last_alone { 0.0 } else { 2_f64.powi(exponent) }; CHAIN];
    grounds[CHAIN - 1] = 2_f64.powi(exponent);
    grounds
}

/// The rounding that a matrix shows, 2^-44, frees what 9e-12 explains, from both sides in powers of two. With the terms
/// `4 (8 - 1)` the energy `8 e` counts up to `e = 3.2e-11`. One spring `e` strains its pair up to 9e-12 of the motion, whose
/// components come to `2 + 6 sqrt 2` in the roots of their units: 9.4e-11; its energy would count up to 2.5e-10. Where the
/// chain is along the tangents, soft beside the normals, the units of these are those of the energy, 8: 9e-12.
#[test]
fn what_a_matrix_shows_to_be_rounding_holds_nothing() {
    let shown = [[1.0, 2_f64.powi(-42)]];
    for (exponent, is_free) in [(-52, true), (-36, true), (-35, true), (-34, false), (-33, false)] {
        assert_eq!(escapes(0, 1.0, grounds(exponent, false), &shown), is_free, "2^{exponent}");
    }
    for (exponent, is_free) in [(-35, true), (-34, true), (-33, false), (-32, false)] {
        assert_eq!(escapes(0, 1.0, grounds(exponent, true), &shown), is_free, "last, 2^{exponent}");
    }
    let soft = 2_f64.powi(-10);
    for (exponent, is_free) in [(-38, true), (-37, true), (-36, false), (-35, false)] {
        assert_eq!(
            escapes(1, soft, grounds(exponent, false), &shown),
            is_free,
            "soft, 2^{exponent}"
        );
    }
}

/// An energy below zero shows rounding from an epsilon for 8 components on: 3 of them here, where its terms are 4. Without, a
/// motion is free up to that energy, here 2 or 2.5 epsilons: `8 e` of 28. A part that shows nothing does not hide one that does,
/// however large its entries.
#[test]
fn what_a_matrix_does_not_show_holds() {
    for parts in [vec![], vec![[1.0, 0.0]], vec![[1.0, -1e-13]], vec![[1.0, 2_f64.powi(-50)]]] {
        for (exponent, is_free) in
            [(-50, true), (-49, true), (-48, false), (-47, false), (-36, false)]
        {
            let escapes = escapes(0, 1.0, grounds(exponent, false), &parts);
            let few = parts.is_empty() && exponent == -49;
            assert_eq!(escapes, is_free && !few, "{parts:?}, 2^{exponent}");
        }
    }
    for below in [-50, -49, -48, -40].map(|exponent| 2_f64.powi(exponent)) {
        for unit in [-30, 0, 30].map(|exponent| 2_f64.powi(exponent)) {
            let parts = [[unit, below], [2_f64.powi(40), f64::EPSILON]];
            for parts in [parts, [parts[1], parts[0]]] {
                let escapes = escapes(0, 1.0, grounds(-36, false), &parts);
                assert_eq!(escapes, below > 12.0 * f64::EPSILON, "{parts:?}");
            }
        }
    }
}

//! The rounding of a host's condensed matrix, from both sides: motions whose energy is at most 9e-12
//! of the diagonals are free, those from 3e-10 on are held, and a matrix with one between is taken as it is. It is
//! looked at only where an entry of the diagonal is as small as that beside its pair's.

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

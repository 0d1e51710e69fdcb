//! Reports about other solutions in space, against the enumeration of all states of the plane:
//! problems of up to four pairs, extruded.

use crate::common::measures::{eta, rounding};
use crate::common::oracle::Enumeration;
use crate::common::problems::{coulomb, definite, definite_case, loaded, uniform};
use fastrand::Rng;
use signorini::{Search, Settings, Status, Uniqueness};

const TOLERANCE: f64 = 1e-10;

fn settings() -> Settings {
    Settings { search: Search::Others, tolerance: TOLERANCE, ..Settings::default() }
}

/// Normal and first tangential components.
fn of_the_plane(d: &[f64]) -> Vec<f64> {
    d.chunks_exact(3).flat_map(|d| [d[0], d[1]]).collect()
}

#[test]
fn what_is_said_about_other_solutions_is_true() {
    let (mut clear, mut several, mut found, mut unique) = (0, 0, 0, 0);
    for seed in 0..600 {
        let mut rng = Rng::with_seed(seed);
        let plane = definite_case(&mut rng, 4.0, |rng, pairs| coulomb(rng, pairs, 5.0));
        let enumeration = Enumeration::new(&plane);
        if !enumeration.is_clear() {
            continue;
        }
        let count = enumeration.solutions().count();
        let space = plane.extruded(|| uniform(&mut rng, 0.5, 2.0));
        let solution = space.solve(&settings());
        assert_eq!(solution.status, Status::Solved, "seed {seed}: {}", solution.message);
        clear += 1;
        several += usize::from(count > 1);
        match solution.uniqueness {
            Uniqueness::NotKnown => {}
            Uniqueness::Unique => {
                unique += 1;
                assert_eq!(count, 1, "seed {seed}: 'unique'");
            }
            Uniqueness::Several => {
                found += 1;
                assert!(count > 1, "seed {seed}: 'several', but there is one");
            }
        }
        // The sign of a solution's determinant is that of its state in the plane: the second tangent
        // adds a positive factor.
        let matches = enumeration.identify(&of_the_plane(&solution.d), TOLERANCE);
        if let [only] = &matches[..]
            && solution.orientation != 0
        {
            assert_eq!(solution.orientation, only.piece.orientation(), "seed {seed}: orientation");
        }
        if let Some(second) = &solution.second {
            let residual = eta(&space, &second.d);
            assert!(
                residual <= TOLERANCE + rounding(&space, &second.d),
                "seed {seed}: {residual:e}"
            );
            let others = enumeration.identify(&of_the_plane(&second.d), TOLERANCE);
            if let ([one], [other]) = (&matches[..], &others[..]) {
                assert_ne!(
                    one.piece.local, other.piece.local,
                    "seed {seed}: the second is the first"
                );
            }
        }
    }
    println!("{clear} problems, {several} with several solutions, {found} found; {unique} unique");
    // Paths from starts at random find most of them; what they miss is said to be not known.
    assert!(clear > 400 && several > 20 && found >= several * 3 / 4 && unique > 20);
}

/// With the coefficients in the range of proven uniqueness nothing else may be said.
#[test]
fn little_friction_has_one_solution() {
    let mut unique = 0;
    for seed in 0..100 {
        let mut rng = Rng::with_seed(seed);
        let pairs = rng.usize(1..=8);
        let k = definite(&mut rng, 3 * pairs, 10.0);
        let law = coulomb(&mut rng, pairs, 0.2);
        let solution = loaded(&mut rng, 3, k, law).solve(&settings());
        assert_eq!(solution.status, Status::Solved, "seed {seed}");
        assert_ne!(solution.uniqueness, Uniqueness::Several, "seed {seed}");
        unique += u32::from(solution.uniqueness == Uniqueness::Unique);
    }
    println!("{unique} of 100 proved to be unique");
    assert!(unique > 50);
}

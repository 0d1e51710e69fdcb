//! The remark that every gap is negative, on springs without coupling.

use crate::common::problems::{Case, Law};
use signorini::{Settings, Status};

/// It is said where every finite gap of a pair that is not tied is below zero by more than rounding of the displacements, and
/// tells the deepest one. A pair without an obstacle has no gap; a gap of zero is not negative.
#[test]
fn negative_gaps_are_told_with_the_deepest() {
    let none = f64::INFINITY;
    for (gap, slide, deepest) in [
        ([-1.0, -4.0, -2.0], 0.0, Some("4.0e0")),
        ([none, -0.5, none], 0.0, Some("5.0e-1")),
        ([-1.0, 0.0, -2.0], 0.0, None),
        ([-1.0, 1.0, -2.0], 0.0, None),
        ([none; 3], 0.0, None),
        ([-1.8e-15; 3], 0.0, Some("1.8e-15")),
        ([-1.8e-15; 3], 1.0, None),
    ] {
        // Springs of 1; all pairs slide without friction.
        let k = (0..36).map(|i| f64::from(u8::from(i % 7 == 0))).collect();
        let f = [0.0, slide].repeat(3);
        let law = Law::Coulomb(vec![0.0; 3]);
        let case = Case { dim: 2, pairs: 3, k, f, gap: gap.to_vec(), law, slip: None };
        let solution = case.solve(&Settings::default());
        assert_eq!(solution.status, Status::Solved, "{gap:?}");
        assert_eq!(solution.remarks.gaps_negative, deepest.is_some(), "{gap:?}, {slide}");
        let told = deepest.map(|deepest| format!("every gap is negative, by at most {deepest}"));
        let said = |told: &String| solution.message.ends_with(told.as_str());
        assert!(told.as_ref().is_none_or(said), "{gap:?}: {}", solution.message);
    }
}

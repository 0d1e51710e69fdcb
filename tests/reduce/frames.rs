//! The frames of pairs, turned exactly along the axes of supports.

use signorini::reduce::{
    ContactPairs, Control, Indices, Reduction, SparseMatrix, SparseReduction, Triangle,
};

/// The reduction that nothing limits.
fn reduced(
    matrix: &SparseMatrix<'_>,
    fixed: &[usize],
    pairs: &ContactPairs<'_>,
) -> SparseReduction {
    let go_on = &mut |_, _| Ok(());
    let control =
        Control { order: None, full_space: false, reserve: |_| true, case: |_, _| 0, ask: go_on };
    SparseReduction::new(matrix, fixed, pairs, control).unwrap()
}

/// The directions of the frame of one node on an obstacle, which springs of 1 hold along each axis, and supports along
/// the axes that are `fixed`.
fn frame(fixed: &[usize], normal: &[f64], tangent: Option<&[f64]>) -> Vec<Vec<f64>> {
    let dim = normal.len();
    let (start, row): (Vec<i64>, Vec<i64>) =
        ((0..=dim as i64).collect(), (0..dim as i64).collect());
    let matrix = SparseMatrix {
        size: dim,
        col_start: Indices::Wide(&start),
        row: Indices::Wide(&row),
        values: &vec![1.0; dim],
        index_base: 0,
        triangle: Triangle::Lower,
    };
    let pairs = ContactPairs {
        dim,
        count: 1,
        slaves: &(0..dim).collect::<Vec<_>>(),
        master_start: &[0, 0],
        masters: &[],
        weights: &[],
        normals: normal,
        tangents: tangent,
        ..ContactPairs::default()
    };
    let reduction = reduced(&matrix, fixed, &pairs);
    reduction.frames().unwrap().chunks_exact(dim).map(<[f64]>::to_vec).collect()
}

/// A normal of seven digits along y: the frame is that of the exact normal.
#[test]
fn a_frame_is_aligned_with_an_axis() {
    let rounded = [3e-7, -0.9999999, -8e-7];
    let directions = frame(&[1], &rounded, Some(&[1.0, 0.0, 0.5]));
    assert_eq!(directions[0], [0.0, -1.0, 0.0]);
    let length = 1.25_f64.sqrt();
    for (i, exact) in [(1, [1.0, 0.0, 0.5]), (2, [-0.5, 0.0, 1.0])] {
        for (c, e) in directions[i].iter().zip(exact) {
            assert!((c - e / length).abs() < 2e-6, "{directions:?}");
        }
    }
    // One that is inclined to the axis stays as it is.
    let inclined = [1e-4, -1.0];
    assert_eq!(frame(&[1], &inclined, None), frame(&[], &inclined, None));
}

/// Any direction of a frame may be along any axis, up or down: it is then exactly so, the frame is orthonormal
/// and turned the same way round, and no direction has changed by more than the rounding.
#[test]
fn every_direction_is_aligned_with_every_axis() {
    let near = 3e-7;
    let mut aligned = 0;
    for dim in [2, 3] {
        for (axis, sign) in (0..dim).flat_map(|axis| [(axis, 1.0), (axis, -1.0)]) {
            for turn in [0.4, 2.0, 3.5, 5.5] {
                let mut along = [0.0; 3];
                along[axis] = sign;
                along[(axis + 1) % dim] += near;
                let mut across = [0.0; 3];
                across[(axis + 1) % dim] = f64::cos(turn);
                if dim == 3 {
                    across[(axis + 2) % 3] = f64::sin(turn);
                    along[(axis + 2) % 3] = -near;
                }
                let (along, across) = (&along[..dim], &across[..dim]);
                for (normal, tangent) in [(along, None), (across, Some(along)), (across, None)] {
                    let (before, after) =
                        (frame(&[], normal, tangent), frame(&[axis], normal, tangent));
                    aligned += usize::from(check(&before, &after, axis, 4.0 * near));
                }
            }
        }
    }
    // The normal along each axis, and a tangent.
    assert!(aligned >= 2 * 4 * (4 + 6), "{aligned}");
}

/// Checks a frame before and after it is aligned, if it has a direction along the axis.
fn check(before: &[Vec<f64>], after: &[Vec<f64>], axis: usize, near: f64) -> bool {
    let sine = |direction: &Vec<f64>| {
        let others = direction.iter().enumerate().filter(|(i, _)| *i != axis);
        others.map(|(_, part)| part * part).sum::<f64>().sqrt()
    };
    let Some(component) = before.iter().position(|direction| sine(direction) <= near) else {
        return false;
    };
    assert_eq!(after[component][axis].abs(), 1.0);
    for (i, one) in after.iter().enumerate() {
        assert!(one.iter().zip(&before[i]).all(|(a, b)| (a - b).abs() <= near), "{after:?}");
        assert!(i == component || one[axis] == 0.0, "{after:?}");
        for (j, other) in after.iter().enumerate() {
            let dot: f64 = one.iter().zip(other).map(|(a, b)| a * b).sum();
            assert!((dot - f64::from(u8::from(i == j))).abs() <= 1e-15, "{after:?}");
        }
    }
    true
}

/// A motion has no unit: parts of 1e-7 of the largest do not count as moving, others do; and what does not
/// move at all moves nothing.
#[test]
fn motions_are_told_alike_in_all_units() {
    let (start, row) = ([0, 1, 2, 3, 4, 5, 6], [0, 1, 2, 3, 4, 5]);
    let matrix = SparseMatrix {
        size: 6,
        col_start: Indices::Narrow(&start),
        row: Indices::Narrow(&row),
        values: &[1.0; 6],
        index_base: 0,
        triangle: Triangle::Lower,
    };
    let pairs = ContactPairs {
        dim: 2,
        count: 3,
        slaves: &[0, 1, 2, 3, 4, 5],
        master_start: &[0; 4],
        masters: &[],
        weights: &[],
        normals: &[1.0, 0.0, 1.0, 0.0, 1.0, 0.0],
        tangents: None,
        ..ContactPairs::default()
    };
    let reduction = reduced(&matrix, &[], &pairs);
    for unit in [1e-9, 1.0, 1e9] {
        let words =
            reduction.motion_in_words(2, &[1e-7, -4.0, 2.0, 1e-5, 0.0, 0.0].map(|u| u * unit));
        let expected = "3 of the degrees of freedom 1 to 3, most of all degree of freedom 1 by -1.000, 2 by 0.500, \
                        3 by 0.000; the slave of pair 0 moves along (0.000, -1.000) relative to what it faces";
        assert_eq!(words.to_string(), expected);
    }
    assert_eq!(reduction.motion_in_words(2, &[0.0; 6]).to_string(), "nothing");
}

//! First tangents: one direction for all pairs, so that one angle of orthotropic friction is one direction on the bodies.

use crate::surfaces::{Shape, Sheet, TwoSheets};
use fastrand::Rng;
use signorini::surface::{SurfacePair, SurfacePairs, SurfaceSettings, SymmetryPlane};

fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn cross(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(a: [f64; 3]) -> [f64; 3] {
    a.map(|x| x / dot(&a, &a).sqrt())
}

/// Two sheets over each other, at places of the unit square and heights.
fn pairs(settings: &SurfaceSettings, place: impl Fn([f64; 3]) -> [f64; 3]) -> SurfacePairs {
    let mut rng = Rng::with_seed(5);
    let square = [[0.0, 1.0]; 2];
    let slave = Sheet::rectangle(Shape::Q4, [4; 2], square, (0.1, &mut rng));
    let slave = slave.mapped(|x| place([x[0], x[1], 0.01])).turned();
    let master = Sheet::rectangle(Shape::T3, [3; 2], square, (0.1, &mut rng));
    let both = TwoSheets::new(3, slave, master.mapped(&place));
    let found = both.pair(settings).unwrap();
    assert!(found.pairs.len() > 20);
    found
}

/// Panics unless the first tangent is a vector's part in the tangent plane, at length one, and the frame is orthonormal.
fn assert_towards(SurfacePair { normal, tangents, .. }: &SurfacePair, towards: &[f64; 3]) {
    let along = dot(towards, normal);
    let expected = unit(std::array::from_fn(|i| towards[i] - along * normal[i]));
    let second = cross(normal, &expected);
    for (own, expected) in tangents.iter().zip([expected, second]) {
        // Rounding of a difference of vectors of length one.
        let is_near = own.iter().zip(&expected).all(|(a, b)| (a - b).abs() < 1e-13);
        assert!(is_near, "{tangents:?}, not {expected:?}, at normal {normal:?}");
    }
}

/// Planes across an axis, between two and between three of them. Nodes stand off them as a mesh in files of seven digits does.
#[test]
fn a_flat_surface_has_one_first_tangent() {
    let mut axes: Vec<([[f64; 3]; 2], [f64; 3])> = Vec::new();
    axes.push(([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], [1.0, 0.0, 0.0]));
    axes.push(([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], [0.0, 1.0, 0.0]));
    axes.push(([unit([1.0, -1.0, 0.0]), [0.0, 0.0, 1.0]], [0.0, 0.0, 1.0]));
    axes.push(([unit([1.0, -1.0, 0.0]), unit([1.0, 1.0, -2.0])], [1.0, 0.0, 0.0]));
    for ([a, b], towards) in axes {
        for noise in [0.0, 1e-15, 1e-8] {
            let n = cross(&a, &b);
            // The same noise at the same place.
            let place = |x: [f64; 3]| {
                let bits = (x[0] + 7.3 * x[1]).to_bits();
                let up = x[2] + noise * (Rng::with_seed(bits).f64() - 0.5);
                std::array::from_fn(|i| x[0] * a[i] + x[1] * b[i] + up * n[i])
            };
            let found = pairs(&SurfaceSettings::default(), place);
            found.pairs.iter().for_each(|pair| assert_towards(pair, &towards));
        }
    }
}

/// A direction along the axis of a turned cylinder is the first tangent of all its pairs; one across it is nowhere a normal's
/// own. Without a direction it is one axis for all pairs.
#[test]
fn first_tangents_follow_a_direction() {
    let axis = unit([1.0, 2.0, 3.0]);
    let side = unit(cross(&axis, &[1.0, 0.0, 0.0]));
    let up = cross(&side, &axis);
    let cylinder = |[x, y, z]: [f64; 3]| {
        let (radius, angle) = (1.0 + z, x - 0.5);
        let [s, c] = [radius * angle.sin(), radius * angle.cos()];
        std::array::from_fn(|i| y * axis[i] + s * side[i] + c * up[i])
    };
    for towards in [axis, side, [3.0, -1.0, 0.5]] {
        let tangent = Some(towards.map(|part| 4.0 * part));
        let settings = SurfaceSettings { tangent, ..SurfaceSettings::default() };
        let found = pairs(&settings, cylinder);
        found.pairs.iter().for_each(|pair| assert_towards(pair, &towards));
    }
    let found = pairs(&SurfaceSettings::default(), cylinder);
    let squares = |i: usize| found.pairs.iter().map(|p| p.area * p.normal[i].powi(2)).sum::<f64>();
    let least = (0..3).min_by(|a, b| squares(*a).total_cmp(&squares(*b))).unwrap();
    let towards = std::array::from_fn(|i| if i == least { 1.0 } else { 0.0 });
    found.pairs.iter().for_each(|pair| assert_towards(pair, &towards));
}

/// A normal along the direction has none of its parts: the frame is orthonormal all the same. A direction that is none is
/// refused.
#[test]
fn directions_along_normals_leave_frames() {
    let settings = |tangent| SurfaceSettings { tangent, ..SurfaceSettings::default() };
    let found = pairs(&settings(Some([0.0, 0.0, -2.0])), |x| x);
    found.pairs.iter().for_each(|pair| assert_towards(pair, &[1.0, 0.0, 0.0]));
    for wrong in [[0.0; 3], [f64::NAN, 1.0, 0.0]] {
        let sheet = || Sheet::rectangle(Shape::Q4, [1; 2], [[0.0, 1.0]; 2], (0.0, &mut Rng::new()));
        let both = TwoSheets::new(3, sheet().turned(), sheet());
        let error = both.pair(&settings(Some(wrong))).unwrap_err().to_string();
        assert!(error.contains("tangent") && error.contains("is no direction"), "{error}");
    }
}

/// On a skewed plane of symmetry a frame has a tangent across it: the first is the nearer one to the direction.
#[test]
fn frames_on_planes_of_symmetry_have_a_tangent_across() {
    let across = unit([1.0, -2.0, 0.0]);
    let along = unit([2.0, 1.0, 0.0]);
    let place = |x: [f64; 3]| {
        std::array::from_fn(|i| {
            x[0] * across[i] + x[1] * along[i] + if i == 2 { x[2] } else { 0.0 }
        })
    };
    for (tangent, first) in [([0.1, -1.0, 0.0], across), ([-1.0, -1.0, 0.0], along.map(|x| -x))] {
        let settings = SurfaceSettings {
            symmetry: vec![SymmetryPlane { normal: across, at: 0.0 }],
            tangent: Some(tangent),
            ..SurfaceSettings::default()
        };
        let found = pairs(&settings, place);
        let on = |pair: &&SurfacePair| found.held.contains_key(&pair.slave);
        let of_plane: Vec<_> = found.pairs.iter().filter(on).collect();
        assert_eq!(of_plane.len(), 5);
        of_plane.into_iter().for_each(|pair| assert_towards(pair, &first));
        found.pairs.iter().filter(|p| !on(p)).for_each(|pair| assert_towards(pair, &tangent));
    }
}

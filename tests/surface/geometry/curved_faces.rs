//! Curved faces: their polynomials, and patches through their nodes.

use super::bilinear::Bilinear;
use super::curved::Curved;
use super::curved_patch::{Patch, arc, on_arc};
use super::face::Face;
use super::shape::FaceKind::{self, Line3, Q8, Q9, T6};
use super::shape::MOST_NODES;
use crate::linalg::vector3::Vector3;

/// Positions, derivatives and local coordinates are those of the face's shape functions, on edges bent by a tenth.
#[test]
fn polynomials_are_the_face() {
    let rng = &mut fastrand::Rng::with_seed(3);
    for kind in [Line3, T6, Q8, Q9] {
        let mut x = [Vector3::zeros(); MOST_NODES];
        for (x, &[s, t]) in x.iter_mut().zip(kind.places()) {
            let mut bend = || 0.05 * (2.0 * rng.f64() - 1.0);
            let across = if kind.is_line() { 0.0 } else { t + 0.1 * s + bend() };
            *x = Vector3::new(s + bend(), across, bend());
        }
        let face = Face { kind, nodes: &[], x, is_ring: false };
        let curved = Curved::new(&face, &Bilinear::new(&face));
        for _ in 0..20 {
            let at = [0.8 * rng.f64(), if kind.is_line() { 0.0 } else { 0.2 * rng.f64() }];
            let place = face.position(at);
            let found = curved.local([place.x, place.y], &Bilinear::new(&face)).unwrap();
            // A step may leave 1e-15; coordinates of the size 1 by some ten terms each.
            assert!((0..2).all(|c| (found[c] - at[c]).abs() < 1e-14), "{kind:?}: {found:?}");
            assert!((curved.at(at)[0].z - place.z).abs() < 1e-15, "{kind:?}");
            let along = if kind.is_line() { 1 } else { 2 };
            let both = face.derivatives(at).into_iter().zip(curved.at(at).into_iter().skip(1));
            for (exact, found) in both.take(along) {
                let miss = (found - exact).norm();
                assert!(miss < 1e-14, "{kind:?}: {miss:e}");
            }
        }
    }
}

/// A face of the size `h` on the unit sphere, or on the circle, with the normals of that: how far it is from it at most,
/// and how wrong its derivatives are beside differences.
fn errors(kind: FaceKind, h: f64) -> [f64; 2] {
    let place = |[s, t]: [f64; 2]| match kind.is_line() {
        true => Vector3::new((h * s).sin(), (h * s).cos(), 0.0),
        false => Vector3::new(h * s + 0.1 * h * t, h * t, 1.0).normalize(),
    };
    let mut x = [Vector3::zeros(); MOST_NODES];
    x.iter_mut().zip(kind.places()).for_each(|(x, at)| *x = place(*at));
    let patch = Patch::new(&Face { kind, nodes: &[], x, is_ring: false }, &x);
    let (mut distance, mut slope) = (0.0_f64, 0.0_f64);
    for i in 0..=20 {
        for j in 0..=20 {
            let (s, t) = (0.05 * f64::from(i), 0.05 * f64::from(j));
            let at = match kind {
                _ if kind.is_line() => [2.0 * s - 1.0, 0.0],
                _ if kind.is_triangle() => [s * (1.0 - t), t],
                _ => [2.0 * s - 1.0, 2.0 * t - 1.0],
            };
            let (point, along) = patch.at(at);
            distance = distance.max((point.norm() - 1.0).abs());
            for c in 0..if kind.is_line() { 1 } else { 2 } {
                let step = |by: f64| {
                    let mut at = at;
                    at[c] += by;
                    patch.at(at).0
                };
                let difference = (step(1e-6) - step(-1e-6)) / 2e-6;
                slope = slope.max((difference - along[c]).norm());
            }
        }
    }
    [distance, slope]
}

/// An arc is off by the sixth power of the size, other patches by the fourth; with half the size they are at least 50 and
/// 14 times as near. Derivatives are those of differences: rounding over the step, 1e-9, in one part of a face; where parts
/// meet they differ by the third power.
#[test]
fn patches_follow_circles_and_spheres() {
    use FaceKind::{Line2, Q4, T3};
    for kind in [Line2, Line3, T3, Q4, T6, Q8, Q9] {
        let [coarse, fine] = [0.2, 0.1].map(|h| errors(kind, h));
        let (most, order) = if kind.is_line() { (1e-7, 50.0) } else { (2e-3, 14.0) };
        assert!(coarse[0] < most && order * fine[0] < coarse[0], "{kind:?}: {coarse:?}, {fine:?}");
        let of_parts = kind.mids().next().is_some() && !kind.is_line();
        let slope = if of_parts { 0.1_f64.powi(3) } else { 1e-9 };
        assert!(fine[1] < slope, "{kind:?}: {fine:?}");
    }
}
/// The way between two points of a cylinder that lies aslant is a helix: the arc is off the cylinder by the sixth power of
/// the size, with half the size 50 times nearer at least.
#[test]
fn arcs_follow_helices() {
    let error = |h: f64, rise: f64| {
        let normals = [-h, h].map(|angle| Vector3::new(angle.sin(), angle.cos(), 0.0));
        let ends = [-1.0, 1.0].map(|side| Vector3::new(0.0, 0.0, side * rise * h));
        let arc = arc([0, 1].map(|end| normals[end] + ends[end]), normals);
        let off = |k: i32| on_arc(&arc, 0.05 * f64::from(k)).0.xy().norm() - 1.0;
        (1..20).map(|k| off(k).abs()).fold(0.0, f64::max)
    };
    for rise in [0.0, 0.5, 1.0, 2.0] {
        let [coarse, fine] = [0.2, 0.1].map(|h| error(h, rise));
        assert!(coarse < 1e-6 && 50.0 * fine < coarse, "{rise}: {coarse:e}, {fine:e}");
    }
}

//! Dual mortar: rows that hold the two surfaces together in the mean, so that a uniform pressure of one
//! side is a uniform pressure of the other.
//!
//! Over the covered part `C` of every slave face, with functions `N̂` of the slave (see `control`) and
//! dual functions `ψ`, `∫_C ψ_j N̂_i = δ_ij D_j`, `Σ ψ_j = 1`, the row of node `j` is
//! `û_j - Σ_k w_jk u_k` with `D_j w_jk = Σ_faces ∫_C ψ_j Nᵐ_k`: Wohlmuth (2000), Hüeber and Wohlmuth (2005),
//! in space Popp, Gitterle, Gee and Wall (2010); faces that are covered in part: Cichosz and Bischoff
//! (2011). As `Σ ψ_j = 1`, forces `F_j = p D_j` load the master's nodes by `p ∫ Nᵐ_k`: the patch test.

use std::collections::BTreeMap;

use super::candidates::{Candidates, SAME_WAY};
use super::control::Edges;
use super::face::Face;
use super::meetings::Meetings;
use super::mesh::Side;
use super::normals::{at_nodes, cancel, direction};
use super::overlap::{Overlaps, SlaveFace};
use super::pairs::{SurfacePairs, SurfaceReport, without_rounding};
use super::projected_shapes::{Covered, Opposite, Polynomials};
use super::rims::{self, SAME_COVER};
use super::row::{Row, add_face, pair_of_row, pairs_of_rows};
use super::self_overlap::UPON;
use super::settings::{Normals, SurfaceSettings};
use super::symmetry::OnPlanes;
use super::tree::Tree;
use super::true_shape::TrueSides;
use crate::error::Error;
use crate::linalg::vector3::Vector3;

/// The part of a slave face over master faces, if it lies over any, and `true` if it has the functions of a face that is
/// covered wholly.
type Cover = (Option<Covered>, bool);

/// The search for what lies over slave faces, with the memory that it uses from face to face.
struct Search<'a> {
    sides: [&'a Side<'a>; 2],
    own: Tree<'a>,
    candidates: Candidates<'a>,
    shapes: Option<TrueSides<'a>>,
    overlaps: Overlaps,
    polynomials: Polynomials,
}

/// The pairs of two sides.
///
/// # Errors
/// Master faces that lie over each other; faces that are turned over in the projection; normals that
/// cancel at a slave node.
pub(super) fn pairs<'a>(
    sides: [&'a Side<'a>; 2],
    planes: &'a OnPlanes,
    (own, candidates): (Tree<'a>, Candidates<'a>),
    settings: &SurfaceSettings,
) -> Result<SurfacePairs, Error> {
    let [slave, _] = sides;
    let mut report = SurfaceReport::default();
    let shapes = TrueSides::new(sides, settings)?;
    let (overlaps, polynomials) = (Overlaps::default(), Polynomials::default());
    let mut search = Search { sides, own, candidates, shapes, overlaps, polynomials };
    let mut faces = Vec::with_capacity(slave.count());
    for at in 0..slave.count() {
        slave.progress.step()?;
        let cover = search.cover(at, &slave.face(at))?;
        match &cover {
            (None, _) => report.uncovered_faces.push(at),
            (Some(covered), wholly) => {
                let in_part = !wholly || covered.holds_many;
                report.held_in_part.extend(in_part.then_some(at));
            }
        }
        faces.push(cover);
    }
    let Search { candidates, shapes, .. } = search;
    candidates.look_beyond(sides, &mut report)?;
    let mut rows = rows(slave, faces, &mut report)?;
    if settings.normals == Normals::Averaged {
        average(&mut rows, (slave, planes, &report.uncovered_faces))?;
    }
    let pair = |node, row: Row| {
        let gap = row.gap / row.area;
        // The mean over what the row covers, with the rows that it has taken in.
        let normal = direction(row.normal, row.area).ok_or_else(|| cancel(node))?;
        let mut pair = pair_of_row(sides, planes, (node, row), normal);
        if let Some(shapes) = &shapes {
            let size = shapes.size() + Vector3::from(pair.point).lp_norm(1);
            pair.gap = without_rounding(gap, size);
        }
        Ok(pair)
    };
    let on = (slave, &report.uncovered_faces[..], planes);
    report.folded = rims::fold(settings, &mut rows, on)?;
    pairs_of_rows(slave, rows, report, pair)
}

/// Gives rows the mean normals at their nodes, without faces around sharp edges that lie over nothing: these have none of the contact.
fn average(
    rows: &mut BTreeMap<usize, Row>,
    (slave, planes, uncovered): (&Side<'_>, &OnPlanes, &[usize]),
) -> Result<(), Error> {
    let looks_elsewhere =
        |row: &Row, normal: &Vector3| row.normal.dot(normal) <= SAME_WAY * row.normal.norm();
    let counts = |at: usize, node: usize, normal: &Vector3| {
        uncovered.binary_search(&at).is_err()
            || !rows.get(&node).is_some_and(|row| looks_elsewhere(row, normal))
    };
    let averaged = slave.node_normals(planes, counts)?;
    for (node, row) in rows {
        slave.progress.goes_on()?;
        let mean = averaged[node];
        if mean != Vector3::zeros() {
            row.normal = row.area * mean;
        }
    }
    Ok(())
}

impl<'a> Search<'a> {
    /// The part of the master that a slave face lies over.
    fn cover(&mut self, at: usize, face: &Face<'_>) -> Result<Cover, Error> {
        let normal = face.middle_normal();
        let mut parts = self.opposite(at, (face, normal))?;
        let Search { sides: [slave, master], own, candidates, shapes, overlaps, polynomials } =
            self;
        let (points, reach) = (&mut overlaps.points, candidates.reach);
        parts.retain(|opposite| {
            let from = face.position(points.at(opposite.points.start)[0]);
            !own.end_above((from, normal), -opposite.part.distance, reach.of_shells())
        });
        let distances = parts.iter().map(|opposite| opposite.part.distance.abs());
        let most = distances.fold(f64::INFINITY, f64::min) + reach.layer;
        parts.retain(|opposite| opposite.part.distance.abs() <= most);
        let share = |parts: &[Opposite<'_>]| parts.iter().map(|part| part.part.share).sum::<f64>();
        if share(&parts) > 1.0 + SAME_COVER {
            let over: Vec<String> =
                parts.iter().map(|opposite| master.named(opposite.at)).collect();
            let what = format!(
                "lies under master faces that lie over each other, among {}: leave the hidden ones out, or \
                 give a smaller search distance",
                over.join(", ")
            );
            return Err(slave.refuse(at, &what));
        }
        let step = UPON * face.size();
        let joins = |a: &Opposite<'_>, b: &Opposite<'_>| {
            a.part.joins(&b.part, step) && candidates.are_of_one_surface([a.at, b.at])
        };
        if parts.windows(2).any(|two| !joins(&two[0], &two[1])) {
            keep_one_surface(&mut parts, joins);
        }
        keep_points(&mut parts, points);
        let is_off_axis = !face.is_at_axis();
        if parts.is_empty() {
            return Ok((None, is_off_axis));
        }
        let mut covered = polynomials.project(face, points, &parts);
        // Of master faces that are so small nodes are held in the mean alone.
        let half = 0.5 * face.size();
        covered.holds_many = parts.iter().any(|opposite| master.face(opposite.at).size() < half);
        if let Some(shapes) = shapes {
            let gaps = shapes.gaps((at, face), points, &parts);
            covered.gaps = polynomials.fit(&gaps);
        }
        Ok((Some(covered), share(&parts) >= 1.0 - SAME_COVER && is_off_axis))
    }

    /// The parts of a slave face with a normal over master faces within reach, with their points.
    fn opposite(
        &mut self,
        at: usize,
        (face, normal): (&Face<'_>, Vector3),
    ) -> Result<Vec<Opposite<'a>>, Error> {
        let Search { sides: [slave, master], candidates, shapes, overlaps, .. } = self;
        let of_gaps = shapes.as_ref().map_or(0, TrueSides::degree);
        let in_plane = SlaveFace::new(face, normal, of_gaps);
        overlaps.points.truncate(0);
        let reach = candidates.reach;
        let mut parts = Vec::new();
        for &opposite in candidates.of_face(face, normal) {
            slave.progress.goes_on()?;
            let other = master.face(opposite);
            let before = overlaps.points.count();
            let wanted = |distance| reach.holds(distance);
            let part = in_plane.overlap(&other, wanted, overlaps).ok_or_else(|| {
                let opposite = master.named(opposite);
                let what = format!(
                    "cannot be projected on master face {opposite}: one of them is turned over, strongly curved \
                     or has a corner that is nearly straight, as seen along the slave's normal; refine there, or \
                     make the other side the slave"
                );
                slave.refuse(at, &what)
            })?;
            let points = before..overlaps.points.count();
            if !points.is_empty() {
                let (kind, nodes) = (other.kind, other.nodes);
                parts.push(Opposite { at: opposite, kind, nodes, points, part });
            }
        }
        Ok(parts)
    }
}

/// Leaves the points of the parts alone.
fn keep_points(parts: &mut [Opposite<'_>], points: &mut Meetings) {
    let mut end = 0;
    for opposite in parts {
        let own = opposite.points.clone();
        opposite.points = end..end + own.len();
        points.move_to(end, own);
        end = opposite.points.end;
    }
    points.truncate(end);
}

/// Leaves the parts that are on one surface with the nearest one. Distances from a face to a surface take all values between
/// theirs; across a step they jump. Weights are negative on a part of a face, so that with both sides of a step, or of an edge
/// of the body, gaps would be less than all distances.
fn keep_one_surface(
    parts: &mut Vec<Opposite<'_>>,
    joins: impl Fn(&Opposite<'_>, &Opposite<'_>) -> bool,
) {
    let distance = |at: &usize| parts[*at].part.distance.abs();
    let mut rest: Vec<usize> = (0..parts.len()).collect();
    let nearest = rest.iter().copied().min_by(|a, b| distance(a).total_cmp(&distance(b)));
    let mut kept: Vec<usize> = nearest.into_iter().collect();
    while let Some(at) = kept.pop() {
        kept.extend(rest.extract_if(.., |other| joins(&parts[at], &parts[*other])));
    }
    let mut place = 0..;
    parts.retain(|_| place.next().is_some_and(|at| rest.binary_search(&at).is_err()));
}

/// The rows of all nodes with cover, by node. The areas of all faces are added to those of the report.
fn rows(
    slave: &Side<'_>,
    faces: Vec<Cover>,
    report: &mut SurfaceReport,
) -> Result<BTreeMap<usize, Row>, Error> {
    let mut edges = Edges::default();
    for (at, (_, wholly)) in faces.iter().enumerate() {
        slave.progress.goes_on()?;
        let face = slave.face(at);
        edges.add(face.kind, face.nodes, *wholly);
    }
    let slave_area = &mut report.slave_area;
    let mut rows: BTreeMap<usize, Row> = BTreeMap::new();
    // The memory of a face is given back once its rows have it.
    for (at, (covered, wholly)) in faces.into_iter().enumerate() {
        slave.progress.goes_on()?;
        if let Some(covered) = covered {
            let face = slave.face(at);
            let basis = edges.basis(face.kind, face.nodes, wholly);
            let integrals = ([covered.integrals, face.integrals()], covered.moments);
            *slave_area += slave.own_area(at, integrals.0[1]);
            let on = (face.nodes, &basis);
            add_face(&mut rows, on, integrals, covered.weights(), (at_nodes(&face), covered.gaps));
        }
    }
    for &at in &report.uncovered_faces {
        slave.progress.goes_on()?;
        let face = slave.face(at);
        let basis = edges.basis(face.kind, face.nodes, !face.is_at_axis());
        let (integrals, normal) = (face.integrals(), face.middle_normal());
        *slave_area += slave.own_area(at, integrals);
        let whole = basis.functions(integrals);
        for (node, whole) in face.nodes.iter().zip(whole) {
            // Around a sharp edge faces look elsewhere, and the node has none of its contact there.
            let row = rows.get_mut(node);
            let same_way = |row: &&mut Row| row.normal.dot(&normal) > SAME_WAY * row.normal.norm();
            row.into_iter().filter(same_way).for_each(|row| row.whole += whole);
        }
    }
    Ok(rows)
}

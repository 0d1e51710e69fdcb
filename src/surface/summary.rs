//! The findings of a pairing, in words.

use std::collections::BTreeSet;
use std::f64::consts::TAU;

use super::pairs::{SurfacePair, SurfacePairs};
use crate::error::{Message, index};

impl SurfacePairs {
    /// One sentence on what was found, of indices that count from 0: for a log, and to see why there are no pairs.
    pub fn summary(&self) -> Message {
        let mut text = if self.pairs.is_empty() { self.why_none() } else { self.found() };
        if self.report.looking_away > 0 && self.report.looking_away == self.report.slave_faces {
            text += "; all slave faces look away from the obstacle: is its direction turned round, or is it hollow?";
        }
        if let Some((pairs, most)) = self.report.large_facets {
            text += &format!(
                "; at {pairs} pairs facets change the interference or clearance by more than a tenth of it, by \
                 up to {}: if the surfaces are curved, give their true shapes, as their facets are larger than the interference or \
                 clearance allows",
                short(most)
            );
        }
        if let Some(least) = self.all_overlap_by() {
            text += &format!(
                "; every pair overlaps, by at least {}, more than a face is long: if the sides do not, the faces of both are \
                 turned over",
                short(least)
            );
        }
        // In one clause, the last.
        let beyond = self.beyond().join(", and ");
        if !beyond.is_empty() {
            text += &format!("; {beyond}");
        }
        text.into()
    }

    /// The least overlap of all pairs, if each overlaps another body by more than the length of a face around its node, which
    /// its area tells.
    fn all_overlap_by(&self) -> Option<f64> {
        let length = |pair: &SurfacePair| match (self.dim, self.axisymmetric) {
            (2, false) => pair.area,
            // On the axis the ring is a disc.
            (2, true) => (pair.area / (TAU * pair.point[0])).min(pair.area.sqrt()),
            _ => pair.area.sqrt(),
        };
        let overlap = |pair: &SurfacePair| {
            let is_deep = !pair.masters().is_empty() && -pair.measured_gap > length(pair);
            is_deep.then_some(-pair.measured_gap)
        };
        let overlaps: Option<Vec<f64>> = self.pairs.iter().map(overlap).collect();
        overlaps?.into_iter().reduce(f64::min)
    }

    /// The faces that point at a master too far away, and those that overlap one by too much.
    fn beyond(&self) -> Vec<String> {
        let report = &self.report;
        let clause = |is_deep: bool, what: &str, limit: f64, at: &str| {
            let faces = || report.beyond.iter().filter(|(_, away)| (*away < 0.0) == is_deep);
            let nearest = faces().min_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))?;
            let (count, face, distance) =
                (faces().count(), index(nearest.0), short(nearest.1.abs()));
            let what = format!("{what} {}", short(limit));
            Some(format!("{count} slave faces {what}, the nearest, face {face}, {at} {distance}"))
        };
        let point_at = "point at a master beyond the search distance of";
        let clauses = [
            clause(false, point_at, report.search_distance, "at"),
            clause(true, "overlap a master by more than", report.overlap_distance, "by"),
        ];
        clauses.into_iter().flatten().collect()
    }

    fn found(&self) -> String {
        let report = &self.report;
        let (pairs, unpaired, folded) =
            (self.pairs.len(), self.unpaired.len(), report.folded.len());
        let cover = 100.0 * (report.covered_area / report.slave_area);
        let mut found = format!(
            "{pairs} pairs on {cover:.2} % of the slave area; {unpaired} slave nodes without a \
             pair, {folded} of them in pairs of neighbours"
        );
        let furthest = report.folded.iter().max_by(|a, b| a.distance.total_cmp(&b.distance));
        if let Some(fold) = furthest {
            let (node, into) = (index(fold.node), index(fold.into));
            found += &format!(", at most {} away ({node} in that of {into})", short(fold.distance));
        }
        let on_planes = self.on_symmetry().count();
        if on_planes > 0 {
            let axis = if self.axisymmetric { "the axis and " } else { "" };
            found += &format!("; {on_planes} of the pairs on {axis}planes of symmetry");
        }
        let idle: Vec<String> = report.idle_planes.iter().map(|plane| index(*plane)).collect();
        if !idle.is_empty() {
            found += &format!("; no slave node stands on plane of symmetry {}", idle.join(", "));
        }
        for (plane, node, distance) in &report.beside_planes {
            let (node, plane) = (index(*node), index(*plane));
            found += &format!(
                "; slave node {node} is {distance:.1e} away from plane of symmetry {plane} and does not count as on it: if it \
                 should, give the plane, and coordinates, with more digits"
            );
        }
        if self.images.are_of_sector() {
            let on_second = self.images.on_second().values();
            let first: BTreeSet<usize> = on_second.map(|(first, _)| *first).collect();
            let on = self.pairs.iter().filter(|pair| first.contains(&pair.slave)).count();
            found += &format!("; {on} of the pairs on the boundary of the sector");
        }
        found
    }

    fn why_none(&self) -> String {
        let report = &self.report;
        if self.unpaired.is_empty() {
            return "no pairs: there are no slave faces".into();
        }
        let mut found = format!(
            "no pairs: nothing lies opposite the {} slave faces within {}",
            report.slave_faces,
            short(report.search_distance)
        );
        if report.overlap_distance < report.search_distance {
            found += &format!(", or overlaps them by at most {}", short(report.overlap_distance));
        }
        match report.not_opposed {
            0 => format!(
                "{found}; if it should, give a larger search distance, or check the numbers from which nodes of faces count"
            ),
            times => format!(
                "{found}, but {times} times a master face was near whose normal does not \
                 oppose the slave's: one side is turned over, or the search distance is too small"
            ),
        }
    }
}

/// Lengths in here are written without an exponent.
const PLAIN: std::ops::Range<f64> = 1e-3..1e4;

/// A length in a few digits.
fn short(length: f64) -> String {
    let rounded: f64 = format!("{length:.3e}").parse().unwrap_or(length);
    if PLAIN.contains(&rounded) || rounded == 0.0 {
        format!("{rounded}")
    } else {
        format!("{length:.3e}")
    }
}

//! What a pairing has found, in words.

use super::pairs::SurfacePairs;
use crate::error::{Message, index};

impl SurfacePairs {
    /// One sentence on what was found, of indices that count from 0: for a log, and to see why there are no pairs.
    pub fn summary(&self) -> Message {
        let mut text = if self.pairs.is_empty() { self.why_none() } else { self.found() };
        if self.report.looking_away > 0 && self.report.looking_away == self.report.slave_faces {
            text += "; all slave faces look away from the obstacle: is its direction turned round, or is it hollow?";
        }
        let [overlapping, rough] = self.report.overlapping_and_rough;
        if rough > 0 && rough >= overlapping / A_PART {
            text += &format!(
                "; on {rough} of {overlapping} slave faces that overlap the other side gaps differ by more than their mean: if the \
                 surfaces are curved, their facets are larger than the interference; give their true shapes"
            );
        }
        let nearest = self.report.beyond.iter().min_by(|a, b| a.1.total_cmp(&b.1));
        if let Some((face, distance)) = nearest {
            text += &format!(
                "; {} slave faces point at a master beyond the search distance of {}, the nearest, face {}, at {}",
                self.report.beyond.len(),
                short(self.report.search_distance),
                index(face),
                short(*distance)
            );
        }
        text.into()
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
        match self.on_symmetry().count() {
            0 => found,
            on => format!("{found}; {on} of the pairs on planes of symmetry"),
        }
    }

    fn why_none(&self) -> String {
        let report = &self.report;
        if self.unpaired.is_empty() {
            return "no pairs: there are no slave faces".into();
        }
        let found = format!(
            "no pairs: nothing lies opposite the {} slave faces within {}",
            report.slave_faces,
            short(report.search_distance)
        );
        match report.not_opposed {
            0 => format!("{found}; if it should, give a larger search distance"),
            times => format!(
                "{found}, but {times} times a master face was near whose normal does not \
                 oppose the slave's: one side is turned over, or the search distance is too small"
            ),
        }
    }
}

/// One of so many overlapping faces with gaps that differ is a wedge or an edge; more are facets.
const A_PART: usize = 4;

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

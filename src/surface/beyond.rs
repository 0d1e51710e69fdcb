//! Slave faces that lie over nothing within the search distance, and point at a master beyond it or overlap one by more.

use super::candidates::Candidates;
use super::mesh::Side;
use super::overlap::{Overlaps, SlaveFace};
use super::pairs::SurfaceReport;
use crate::error::Error;

impl Candidates<'_> {
    /// Tells the report how far was looked, and adds those of its uncovered faces, with the distance of the nearest master, negative where they overlap it:
    /// where they are inside of a body, and no master face stands before it that looks their way, as that body's other side.
    ///
    /// # Errors
    /// What stops the pairing.
    pub(super) fn look_beyond(
        mut self,
        [slave, master]: [&Side<'_>; 2],
        report: &mut SurfaceReport,
    ) -> Result<(), Error> {
        (report.boxes_searched, report.not_opposed) = (self.searched, self.not_opposed);
        let reach = self.reach;
        (report.search_distance, report.overlap_distance) = (reach.open, reach.overlap);
        (self.reach.overlap, self.reach.open) =
            (f64::max(reach.overlap, self.span), f64::max(reach.open, self.span));
        let mut overlaps = Overlaps::default();
        for &at in &report.uncovered_faces {
            slave.progress.goes_on()?;
            let face = slave.face(at);
            let normal = face.middle_normal();
            let in_plane = SlaveFace::new(&face, normal);
            let mut distances = |masters: &[usize]| {
                let mut found = Vec::new();
                for &other in masters {
                    let part = in_plane.overlap(&master.face(other), |_| true, &mut overlaps);
                    overlaps.points.clear();
                    let part = part.unwrap_or_default();
                    found.extend((part.share > 0.0).then_some(part.distance));
                }
                found
            };
            let opposite = distances(self.of_face(&face, normal));
            let ahead = opposite.iter().copied().filter(|away| *away > reach.open);
            let behind = opposite.iter().copied().filter(|away| *away < -reach.overlap);
            let nearest = ahead.reduce(f64::min).or_else(|| {
                let deep = behind.reduce(f64::max)?;
                let looking_along = distances(self.of_face(&face, -normal));
                let is_between = |away: &f64| (deep..0.0).contains(away);
                (!looking_along.iter().any(is_between)).then_some(deep)
            });
            report.beyond.extend(nearest.map(|nearest| (at, nearest)));
        }
        Ok(())
    }
}

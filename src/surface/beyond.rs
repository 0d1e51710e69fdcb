//! Slave faces that lie over nothing within the search distance, and point at a master beyond it.

use super::candidates::Candidates;
use super::mesh::Side;
use super::overlap::{Overlaps, SlaveFace};
use super::pairs::SurfaceReport;
use super::watch::Watch;
use crate::error::Error;

impl Candidates<'_> {
    /// Adds to the report those of its uncovered faces, with the distance of the nearest master.
    ///
    /// # Errors
    /// What ends the watch.
    pub(super) fn look_beyond(
        mut self,
        [slave, master]: [&Side<'_>; 2],
        report: &mut SurfaceReport,
        watch: &mut Watch<'_, '_>,
    ) -> Result<(), Error> {
        (report.boxes_searched, report.not_opposed) = (self.searched, self.not_opposed);
        let from = self.reach.open;
        self.reach.open = f64::max(from, self.span);
        let mut overlaps = Overlaps::default();
        for &at in &report.uncovered_faces {
            watch.goes_on()?;
            let (face, mut nearest) = (slave.face(at), f64::INFINITY);
            let normal = face.middle_normal();
            let in_plane = SlaveFace::new(&face, normal);
            for &opposite in self.of_face(&face, normal) {
                let part =
                    in_plane.overlap(&master.face(opposite), |away| away > from, &mut overlaps);
                let part = part.unwrap_or_default();
                if part.share > 0.0 {
                    nearest = nearest.min(part.distance);
                }
                overlaps.points.clear();
            }
            if nearest.is_finite() {
                report.beyond.push((at, nearest));
            }
        }
        Ok(())
    }
}

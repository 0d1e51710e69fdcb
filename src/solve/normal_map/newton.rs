//! Newton's method on the normal map with a line search on the lack of equilibrium.
//!
//! The iterates obey the law exactly; what falls is `|H|`. Some sweeps before the first system bring
//! nearly all pairs to their branch. In the plane the active-set method takes fewer systems and is
//! used instead. There is no guarantee: where it fails, sweeps follow.

use super::point::Point;
use super::step::System;
use crate::certificate::eta_of;
use crate::law::Contact;
use crate::monitor::Monitor;
use crate::settings::Settings;
use crate::solve::candidate::{Candidate, Effort, Ending};
use crate::solve::sweeps::Sweeper;

/// Sweeps before the first system: they cost a small part of one on a hundred pairs and more.
const SWEEPS: usize = 20;

/// Systems after which it is given up: it takes up to about ten where it converges.
const MOST_SYSTEMS: u64 = 60;

/// Part of the fall of `|H|` that a full step promises which a shortened one must keep (Armijo).
const SUFFICIENT: f64 = 1e-4;

/// Shortest step: a kink of the law may lie within any longer one.
const SHORTEST: f64 = 1e-3;

/// Solves from the displacements `start` (zero if `None`).
pub fn newton(
    contact: &Contact<'_>,
    settings: &Settings,
    start: Option<&[f64]>,
    monitor: &mut Monitor<'_>,
) -> Candidate {
    let root = contact.problem().stiffness().diagonal_roots();
    let mut point = swept(contact, &root, start);
    let mut factorisations = 0;
    let ending = loop {
        let eta = eta_of(contact, &point.d, &point.force);
        monitor.measured(eta);
        // One system at least: it finds the digits that sweeps have not.
        if eta <= settings.tolerance && factorisations > 0 {
            break Ending::Done;
        }
        if factorisations >= MOST_SYSTEMS {
            break Ending::Stalled("Newton's method does not converge");
        }
        if let Err(stop) = monitor.step() {
            break Ending::Stopped(stop);
        }
        factorisations += 1;
        let Some(step) = System::new(contact, &point).step(contact, &point, &root) else {
            break Ending::Singular;
        };
        let mut part = 1.0;
        point = loop {
            let y = point.y.iter().zip(&step);
            let y = y.map(|(y, dy)| std::array::from_fn(|c| y[c] + part * dy[c])).collect();
            let next = Point::new(contact, &root, y);
            if next.merit <= (1.0 - SUFFICIENT * part) * point.merit || part <= SHORTEST {
                break next;
            }
            part /= 2.0;
        };
    };
    let effort = Effort { factorisations, ..Effort::default() };
    Candidate::new(point.d, point.force, ending, effort)
}

/// The point after some sweeps from a start.
fn swept(contact: &Contact<'_>, root: &[f64], start: Option<&[f64]>) -> Point {
    let mut d = start.map_or_else(|| vec![0.0; contact.unknowns()], <[f64]>::to_vec);
    for (law, normal) in contact.pairs().iter().zip(d.iter_mut().step_by(contact.dim())) {
        *normal = law.admissible(*normal);
    }
    let mut force = contact.problem().force(&d);
    let sweeper = Sweeper::new();
    for _ in 0..SWEEPS {
        sweeper.sweep(contact, (&mut d, &mut force), 1.0);
    }
    let y = contact.each(&d, &force).map(|(law, d, force)| law.chart(d, force)).collect();
    Point::new(contact, root, y)
}

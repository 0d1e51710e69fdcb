//! Contact zones with names in one set of pairs, and a table of what they carry.

use std::fmt::{Display, Write};
use std::ops::Range;
use std::ptr::null;

use libc::c_char;

use super::args::{At, c_entry};
use super::guard::{self, Failure, Outcome};
use super::law;
use super::surface::SignoriniFaces;
use super::surface_fields::pair_results;
use super::surface_new::{JoinedZones, SignoriniSurfacePairs};
use crate::law::State;
use crate::surface::{ContactZone, Joined, join_zones};

/// A contact zone for signorini_surface_join.
#[repr(C)]
pub struct SignoriniContactZone {
    /// sizeof(signorini_contact_zone).
    pub struct_size: u32,
    /// SIGNORINI_LAW_... of its pairs, but for SIGNORINI_LAW_BY_PAIR. A tie closes the gaps that you
    /// hand over: 0 ties surfaces where they stand.
    pub law: i32,
    /// Its pairs.
    pub contact: *const SignoriniSurfacePairs,
    /// Its name, UTF-8, which no other zone has.
    pub name: *const c_char,
    /// The parameters of the law, one set for all of its pairs; NULL if it has none.
    pub friction: *const f64,
}

/// Number of the zones among the arguments.
const ZONES: i32 = 2;

/// Bytes of a pair and of a node of a row that a call takes, in a few copies.
const OF_PAIR: usize = 2048;
const OF_NODE: usize = 256;

/// Joins the pairs of contact zones: the result has all pairs, one zone after the other, as
/// data.zone_start tells, and data.friction for SIGNORINI_LAW_BY_PAIR. It is an object of its own:
/// the zones may be released. All calls take it, and each zone's own pairs with its part of d, F and
/// state, unless zones cut a smooth surface.
///
/// A node may be slave in one zone and master in another. A face that is slave in two zones is
/// refused if both have a pair of one of its nodes: pair it once, with the masters of both. A slave
/// node of faces of its own in each of two zones has two pairs at an edge of the body, where their
/// normals are more than 45 degrees apart. Where zones cut a smooth surface it has one pair, the sum
/// of both, in the first zone and with its law, and none in the other one. Then a part of d, F and
/// state belongs to joined pairs alone: the resultant of a zone is that of joined with an F that is
/// 0 at the pairs of other zones.
///
/// @param n_zones  number of zones, at least 1
/// @param zones    the zones, paired on one mesh with one numbering
/// @param joined   out: the pairs of all zones; NULL unless 0 is returned
/// @return the status; signorini_last_error names zones, face and node
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_surface_join(
    n_zones: i64,
    zones: *const SignoriniContactZone,
    joined: *mut *mut SignoriniSurfacePairs,
) -> i32 {
    c_entry!(|arrays| {
        let place = arrays.at(3, "joined").out_pointer(joined)?;
        let at_count = arrays.at(1, "n_zones");
        let at = arrays.at(ZONES, "zones");
        let given = at.all(zones, at_count.size(n_zones)?)?.into_iter().enumerate();
        let zones = given.map(|(number, zone)| Zone::read(at.number(number), zone));
        let zones: Vec<Zone<'_>> = zones.collect::<Result<_, _>>()?;
        guard::reserve(zones.iter().map(|zone| zone.contact.bytes()).sum())?;
        let Some(first) = zones.first() else {
            return at_count.refuse("is 0, there must be a zone");
        };
        let like_first = |zone: &Zone<'_>| {
            let (own, other) = (zone.contact, first.contact);
            own.nodes == other.nodes && own.numbering == other.numbering
        };
        if let Some(zone) = zones.iter().find(|zone| !like_first(zone)) {
            return Err(Failure::argument(
                ZONES,
                format!(
                    "zone '{}' is of another mesh than zone '{}', or numbers nodes or degrees of freedom otherwise",
                    zone.part.name, first.part.name
                ),
            ));
        }
        let parts: Vec<ContactZone<'_>> = zones.iter().map(|zone| zone.part).collect();
        let joined = join_zones(&parts).map(|found| {
            let (nodes, numbering) = (first.contact.nodes, first.contact.numbering.clone());
            let told = joined_zones(&zones, &found, &parts);
            let kept = zones.iter().flat_map(|zone| zone.contact.kept.iter().cloned()).collect();
            let mut joined = SignoriniSurfacePairs::new(found.contact, nodes, numbering, told);
            joined.kept = kept;
            joined
        });
        place.fill(joined.map_err(arrays.refused(ZONES))?)
    })
}

/// Writes a table for a log: of each zone its name, its pairs, how many are open, slip and stick,
/// the force on the slave's body, the area of the pairs that press, and the largest pressure. Pairs
/// that were not joined are one zone.
///
/// @param joined  the pairs
/// @param d       relative displacements, N
/// @param F       contact forces, N
/// @param state   SIGNORINI_STATE_... of each pair
/// @param text    out: size bytes, ended by a zero byte; what does not fit is left out
/// @param size    at least 1; 160 for each zone and for the head hold names of 40 bytes
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_surface_table(
    joined: *const SignoriniSurfacePairs,
    d: *const f64,
    F: *const f64,
    state: *const i32,
    text: *mut c_char,
    size: i64,
) -> i32 {
    c_entry!(|arrays| {
        let joined = arrays.at(1, "joined").handle(joined)?;
        let results = pair_results(arrays, joined, [1, 1, 2, 3], [null(), null(), d, F])?;
        let at_state = arrays.at(4, "state");
        let states = at_state.required(state, joined.arrays.count)?;
        guard::reserve(joined.bytes())?;
        let states = at_state.states(states)?;
        let at_size = arrays.at(6, "size");
        let length = at_size.size(size)?;
        if length == 0 {
            return at_size.refuse("is 0, it must be at least 1");
        }
        let text = arrays.at(5, "text").output(text.cast::<u8>(), length)?;
        arrays.check_overlap()?;
        let mut table = String::new();
        let forces = ["force x", "force y", "force z", "area", "pressure"];
        add_row(&mut table, "zone", ["pairs", "open", "slip", "stick"], forces);
        for (name, pairs) in joined.zones() {
            let origin = &[0.0; 3][..joined.found.dim];
            let sums = joined.found.resultant_of(pairs.clone(), &results, origin);
            let sums = sums.map_err(arrays.refused(3))?;
            let [x, y, z] = sums.force;
            let numbers = [x, y, z, sums.pressed_area, sums.largest_pressure];
            add_row(&mut table, name, counts(&states[pairs]), numbers.map(scientific));
        }
        let fitting = (0..length).rev().find(|&end| table.is_char_boundary(end.min(table.len())));
        let mut bytes = table.as_bytes()[..fitting.unwrap_or(0).min(table.len())].to_vec();
        bytes.resize(length, 0);
        text.write(&bytes);
        Ok(0)
    })
}

/// Characters of a name in the table, at least.
const NAME: usize = 16;

fn add_row(table: &mut String, name: &str, counts: [impl Display; 4], numbers: [impl Display; 5]) {
    let _ = write!(table, "{name:NAME$}");
    counts.iter().for_each(|count| _ = write!(table, " {count:>8}"));
    numbers.iter().for_each(|number| _ = write!(table, " {number:>12}"));
    table.push('\n');
}

/// How many pairs there are, and how many are open, slip and stick.
fn counts(states: &[State]) -> [usize; 4] {
    let count = |wanted: State| states.iter().filter(|own| **own == wanted).count();
    [states.len(), count(State::Open), count(State::Slip), count(State::Stick)]
}

/// A number as `printf` writes it by `%.4e`.
fn scientific(number: f64) -> String {
    let text = format!("{number:.4e}");
    match text.split_once('e').map(|(digits, power)| (digits, power.parse::<i32>())) {
        Some((digits, Ok(power))) => format!("{digits}e{power:+03}"),
        _ => text,
    }
}

/// A zone as the host gave it.
struct Zone<'h> {
    part: ContactZone<'h>,
    contact: &'h SignoriniSurfacePairs,
    /// The number of its law, and three parameters.
    friction: [f64; 4],
}

impl<'h> Zone<'h> {
    fn read(at: At<'h>, given: &SignoriniContactZone) -> Outcome<Self> {
        let contact = at.field("contact").handle(given.contact)?;
        let name = at.field("name").text(given.name)?.unwrap_or("");
        if !contact.zones.names.is_empty() {
            return at.refuse_part("its pairs are joined already: give those of each zone");
        }
        if given.law == law::SIGNORINI_LAW_BY_PAIR {
            return at.refuse_part("law is SIGNORINI_LAW_BY_PAIR: give the law of the zone");
        }
        // The numbers of a law stand in the structure too.
        let laws = ["law", "friction"].map(|name| at.named(name));
        let friction = law::read((laws[0], given.law), (laws[1], given.friction), 1)
            .map_err(|failure| failure.explained(&at.to_string()))?;
        if friction.law().parameters().is_empty() && !given.friction.is_null() {
            return at.refuse_part(format!(
                "friction is given, and its law, {}, has no parameters: give the law of these numbers, as \
                 SIGNORINI_LAW_COULOMB, or NULL",
                friction.law().title()
            ));
        }
        friction.check(contact.found.dim).or_else(|error| at.refuse_error(&error))?;
        let mut numbers = [friction.law().number(), 0.0, 0.0, 0.0];
        numbers[1..].iter_mut().zip(friction.values()).for_each(|(own, given)| *own = *given);
        let slave = SignoriniFaces::view(&contact.slave_faces);
        let part = ContactZone { name, contact: &contact.found, slave };
        Ok(Zone { part, contact, friction: numbers })
    }
}

/// The zones of joined pairs, as they hold them.
fn joined_zones(zones: &[Zone<'_>], found: &Joined, parts: &[ContactZone<'_>]) -> JoinedZones {
    let pairs = found.starts.windows(2).map(|ends| ends[1] - ends[0]);
    let friction = zones.iter().zip(pairs);
    let friction = friction.flat_map(|(zone, pairs)| std::iter::repeat_n(zone.friction, pairs));
    JoinedZones {
        names: zones.iter().map(|zone| zone.part.name.to_owned()).collect(),
        starts: found.starts.iter().map(|&start| start as i64).collect(),
        friction: friction.flatten().collect(),
        summary: found.summary(parts),
    }
}

impl SignoriniSurfacePairs {
    /// Bytes that copies of the pairs and of their faces may take.
    fn bytes(&self) -> usize {
        let nodes = self.arrays.masters.len() / self.found.dim + self.slave_faces[1].len();
        OF_PAIR * (1 + self.arrays.count) + OF_NODE * nodes
    }

    /// The zones with their pairs: one without a name of pairs that were not joined.
    fn zones(&self) -> impl Iterator<Item = (&str, Range<usize>)> {
        let alone = self.zones.names.is_empty().then_some(("contact", 0..self.arrays.count));
        let ends = self.zones.starts.windows(2).map(|ends| ends[0] as usize..ends[1] as usize);
        alone.into_iter().chain(self.zones.names.iter().map(String::as_str).zip(ends))
    }
}

//! A mesh with fields at its nodes as a `.vtu` file, which ParaView and others open.
//!
//! The format is VTK's XML `UnstructuredGrid`, version 1.0: arrays stand inline in base64, each with its
//! number of bytes in front as `UInt64`, least significant byte first. Every bit of a number is kept,
//! infinities too.

use std::io::{self, Write};
use std::path::Path;

use super::write::replace;
use crate::error::{Argument, Error, entry, index};
use crate::problem::checked_dim;

/// Components of every vector and point of the file.
const SPACE: usize = 3;

/// A mesh of the host.
#[derive(Clone, Copy, Debug)]
pub struct Mesh<'a> {
    /// Space dimension, 2 or 3.
    pub dim: usize,
    /// Coordinates of the nodes, `dim` for each.
    pub coordinates: &'a [f64],
    /// VTK's number of the type of each cell.
    pub types: &'a [u8],
    /// Start of each cell in `nodes`, and the length of `nodes`: one entry more than cells.
    pub start: &'a [usize],
    /// Nodes of the cells, counted from 0, in VTK's order.
    pub nodes: &'a [usize],
}

/// Values at the nodes of a mesh.
#[derive(Clone, Debug)]
pub struct Field<'a> {
    /// The name of the field in ParaView.
    pub name: &'a str,
    /// The numbers.
    pub values: Values<'a>,
}

/// The numbers of a field.
#[derive(Clone, Debug)]
pub enum Values<'a> {
    /// One for each node.
    Scalars(&'a [f64]),
    /// `dim` for each node.
    Vectors(&'a [f64]),
    /// A whole number for each node.
    Integers(&'a [i32]),
}

/// The number of nodes of a cell of VTK's linear and quadratic types; `None` for other types.
pub fn nodes_of_type(cell_type: i32) -> Option<usize> {
    let known = [
        (1, 1),   // vertex
        (3, 2),   // line
        (5, 3),   // triangle
        (9, 4),   // quadrilateral
        (10, 4),  // tetrahedron
        (12, 8),  // hexahedron
        (13, 6),  // wedge
        (14, 5),  // pyramid
        (21, 3),  // the quadratic ones: line,
        (22, 6),  // triangle,
        (23, 8),  // quadrilateral,
        (24, 10), // tetrahedron,
        (25, 20), // hexahedron,
        (26, 15), // wedge,
        (27, 13), // pyramid,
        (28, 9),  // quadrilateral with its centre,
        (29, 27), // hexahedron with its centres
    ];
    known.iter().find(|(of, _)| *of == cell_type).map(|(_, nodes)| *nodes)
}

impl Mesh<'_> {
    /// Number of nodes.
    pub fn node_count(&self) -> usize {
        self.coordinates.len() / self.dim
    }

    fn check(&self) -> Result<(), Error> {
        let refuse = |wrong: String| Argument::Mesh.refuse(format!("mesh: {wrong}"));
        let Mesh { dim, coordinates, types, start, nodes } = self;
        if let Err(error) = checked_dim(*dim) {
            return refuse(error.to_string());
        }
        if !coordinates.len().is_multiple_of(*dim) {
            let given = coordinates.len();
            return refuse(format!("there are {given} coordinates, no multiple of dim {dim}"));
        }
        if start.len() != types.len() + 1 || start.first() != Some(&0) {
            return refuse("the cells need a start each, the first 0, and an end".into());
        }
        if let Some(cell) = start.windows(2).position(|ends| ends[0] > ends[1]) {
            let (here, next) = (entry("cell_start", [cell]), entry("cell_start", [cell + 1]));
            return refuse(format!("{next} is less than {here}"));
        }
        if start[types.len()] != nodes.len() {
            let (last, given) = (start[types.len()], nodes.len());
            return refuse(format!("cell_start ends with {last}, cells have {given} nodes"));
        }
        for (cell, ends) in start.windows(2).enumerate() {
            let (has, kind) = (ends[1] - ends[0], types[cell]);
            let cell_name = index(cell);
            if nodes_of_type(kind.into()).is_some_and(|nodes| nodes != has) {
                return refuse(format!(
                    "cell {cell_name} has {has} nodes, no number of VTK's type {kind}"
                ));
            }
            let count = self.node_count();
            if let Some(node) = nodes[ends[0]..ends[1]].iter().find(|node| **node >= count) {
                let node = index(node);
                return refuse(format!(
                    "cell {cell_name} has node {node}, the coordinates are those of {count} nodes"
                ));
            }
        }
        Ok(())
    }

    /// Vectors with a third component.
    fn in_space<'a>(&self, values: &'a [f64]) -> impl Iterator<Item = f64> + use<'a> {
        let dim = self.dim;
        values
            .chunks(dim)
            .flat_map(move |x| x.iter().copied().chain(std::iter::repeat_n(0.0, SPACE - dim)))
    }
}

/// Writes a mesh with fields to the file `path`, which is replaced if it exists.
///
/// # Errors
/// [`Argument::Mesh`] for the mesh, [`Argument::Fields`] for a field of the wrong length or a name that
/// is empty or not printable; [`Error::File`] if the file cannot be written: an old one is then as it
/// was.
pub fn write_vtu(path: &Path, mesh: &Mesh<'_>, fields: &[Field<'_>]) -> Result<(), Error> {
    mesh.check()?;
    for field in fields {
        check_field(mesh, field)?;
    }
    replace(path, |file| write_grid(file, mesh, fields))
}

fn check_field(mesh: &Mesh<'_>, field: &Field<'_>) -> Result<(), Error> {
    let name = field.name;
    if name.is_empty() || name.chars().any(char::is_control) {
        return Argument::Fields.refuse("a field has a name that is empty or not printable");
    }
    let nodes = mesh.node_count();
    let (given, needed) = match field.values {
        Values::Scalars(values) => (values.len(), nodes),
        Values::Vectors(values) => (values.len(), nodes * mesh.dim),
        Values::Integers(values) => (values.len(), nodes),
    };
    if given != needed {
        let wrong = format!("field {name} has {given} entries, it needs {needed}");
        return Argument::Fields.refuse(wrong);
    }
    Ok(())
}

fn write_grid(file: &mut impl Write, mesh: &Mesh<'_>, fields: &[Field<'_>]) -> io::Result<()> {
    let reals = |values: &mut dyn Iterator<Item = f64>| -> Vec<u8> {
        values.flat_map(f64::to_le_bytes).collect()
    };
    let numbers = |values: &[usize]| -> Vec<u8> {
        values.iter().flat_map(|value| (*value as i64).to_le_bytes()).collect()
    };
    writeln!(file, "<?xml version=\"1.0\"?>")?;
    let head = "version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\"";
    writeln!(file, "<VTKFile type=\"UnstructuredGrid\" {head}>")?;
    let (points, cells) = (mesh.node_count(), mesh.types.len());
    writeln!(file, "<UnstructuredGrid>")?;
    writeln!(file, "<Piece NumberOfPoints=\"{points}\" NumberOfCells=\"{cells}\">")?;
    writeln!(file, "<Points>")?;
    let places = reals(&mut mesh.in_space(mesh.coordinates));
    array(file, ("Float64", "Points", SPACE), &places)?;
    writeln!(file, "</Points>\n<Cells>")?;
    array(file, ("Int64", "connectivity", 1), &numbers(mesh.nodes))?;
    array(file, ("Int64", "offsets", 1), &numbers(&mesh.start[1..]))?;
    array(file, ("UInt8", "types", 1), mesh.types)?;
    writeln!(file, "</Cells>\n<PointData>")?;
    for field in fields {
        let (kind, components, bytes) = match field.values {
            Values::Scalars(values) => ("Float64", 1, reals(&mut values.iter().copied())),
            Values::Vectors(values) => ("Float64", SPACE, reals(&mut mesh.in_space(values))),
            Values::Integers(values) => {
                ("Int32", 1, values.iter().flat_map(|value| value.to_le_bytes()).collect())
            }
        };
        array(file, (kind, &escaped(field.name), components), &bytes)?;
    }
    writeln!(file, "</PointData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>")
}

/// An array with its number of bytes in front.
fn array(
    file: &mut impl Write,
    (kind, name, components): (&str, &str, usize),
    bytes: &[u8],
) -> io::Result<()> {
    write!(file, "<DataArray type=\"{kind}\" Name=\"{name}\"")?;
    writeln!(file, " NumberOfComponents=\"{components}\" format=\"binary\">")?;
    // Number and data are one stream of base64: VTK's reader looks for the data behind the number in it.
    let number = (bytes.len() as u64).to_le_bytes();
    base64(file, &[&number, bytes].concat())?;
    writeln!(file, "\n</DataArray>")
}

/// Base64 of RFC 4648, with padding.
fn base64(file: &mut impl Write, bytes: &[u8]) -> io::Result<()> {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for group in bytes.chunks(3) {
        let mut three = [0; 3];
        three[..group.len()].copy_from_slice(group);
        let [a, b, c] = three.map(u32::from);
        let bits = (a << 16) | (b << 8) | c;
        let mut four =
            [18, 12, 6, 0].map(|shift| LETTERS[(bits >> shift) as usize % LETTERS.len()]);
        four[group.len() + 1..].fill(b'=');
        file.write_all(&four)?;
    }
    Ok(())
}

/// A name inside of quotation marks.
fn escaped(name: &str) -> String {
    name.replace('&', "&amp;").replace('"', "&quot;").replace('<', "&lt;").replace('>', "&gt;")
}

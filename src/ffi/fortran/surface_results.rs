//! SGSFLD, SGSVTU: what a solution means on the surfaces.

use std::ffi::CString;
use std::sync::Arc;

use libc::c_char;

use super::super::guard::Failure;
use super::super::mesh::SignoriniMesh;
use super::super::surface_fields::{SignoriniContactFields, signorini_surface_fields};
use super::super::surface_write::signorini_surface_write;
use super::arguments::{Integer, choice, count, run};
use super::sparse::numbers;
use super::surfaces::SURFACES;

/// SGSFLD: fields at the nodes that stand in pairs.
///
/// # Safety
/// As include/signorini.inc demands.
pub(super) unsafe fn fields<I: Integer>(
    hsurf: *const i64,
    gap: *const f64,
    slip0: *const f64,
    d: *const f64,
    r: *const f64,
    press: *mut f64,
    tract: *mut f64,
    clear: *mut f64,
    slip: *mut f64,
    info: *mut I,
) {
    // SAFETY: by the caller's contract.
    let body = || unsafe {
        let contact = SURFACES.find(1, hsurf)?;
        let fields = SignoriniContactFields {
            struct_size: size_of::<SignoriniContactFields>() as u32,
            reserved: 0,
            pressure: press,
            traction: tract,
            clearance: clear,
            slip,
            state: std::ptr::null_mut(),
        };
        let (states, fields) = (std::ptr::null(), &raw const fields);
        Ok(signorini_surface_fields(Arc::as_ptr(&contact), gap, slip0, d, r, states, fields))
    };
    // SAFETY: by the caller's contract.
    unsafe { run(info, &[1, 2, 3, 4, 5, 5, 6], body) }
}

/// SGSVTU: mesh, displacements and fields to a file for ParaView.
///
/// # Safety
/// As above.
pub(super) unsafe fn write_vtu<I: Integer>(
    hsurf: *const i64,
    path: *const c_char,
    lpath: *const I,
    x: *const f64,
    vtktyp: *const I,
    lcell: *const I,
    ncell: *const I,
    cell: *const I,
    gap: *const f64,
    slip0: *const f64,
    u: *const f64,
    d: *const f64,
    r: *const f64,
    state: *const I,
    info: *mut I,
) {
    // SAFETY: by the caller's contract.
    let body = || unsafe {
        let contact = SURFACES.find(1, hsurf)?;
        let path = name_of_file(path, lpath)?;
        let cell_type = choice(5, "VTKTYP", vtktyp)?;
        let each = count(6, "LCELL", lcell)?;
        let cells = count(7, "NCELL", ncell)?;
        if each == 0 && cells > 0 {
            return Err(Failure::argument(6, "LCELL is 0, it must be the nodes of a cell"));
        }
        let cell_nodes = numbers(8, "CELL", cell, each * cells)?;
        // A type with another number of nodes is refused by its own name.
        let starts: Vec<i64> = (0..=cells).map(|k| 1 + each * k).collect();
        let state = numbers(14, "STATE", state, contact.rows.count)?;
        let state: Vec<i32> = state.iter().map(|state| i32::nearest(*state)).collect();
        let mesh = SignoriniMesh {
            struct_size: size_of::<SignoriniMesh>() as u32,
            dim: contact.rows.dim,
            nodes: contact.nodes as i64,
            coordinates: x,
            cells,
            index_base: 1,
            cell_type,
            cell_types: std::ptr::null(),
            cell_start: starts.as_ptr(),
            cell_nodes: cell_nodes.as_ptr(),
        };
        let (contact, mesh) = (Arc::as_ptr(&contact), &raw const mesh);
        let (path, state) = (path.as_ptr(), state.as_ptr());
        Ok(signorini_surface_write(contact, path, mesh, gap, slip0, u, d, r, state))
    };
    // SAFETY: by the caller's contract.
    unsafe { run(info, &[1, 2, 8, 9, 10, 11, 12, 13, 14], body) }
}

/// PATH, without the blanks at its end.
///
/// # Safety
/// As above.
unsafe fn name_of_file<I: Integer>(
    path: *const c_char,
    lpath: *const I,
) -> Result<CString, Failure> {
    // SAFETY: by the caller's contract.
    let bytes = unsafe {
        let length = count(3, "LPATH", lpath)?;
        if path.is_null() {
            return Err(Failure::argument(2, "PATH is NULL"));
        }
        std::slice::from_raw_parts(path.cast::<u8>(), length as usize)
    };
    let bytes = bytes.trim_ascii_end();
    CString::new(bytes)
        .map_err(|_| Failure::argument(2, "PATH has a character 0: give LPATH its length"))
}

"""Meshes with fields to files for ParaView."""

import ctypes
import os
from xml.sax.saxutils import quoteattr

import numpy as np

from ._arrays import at, doubles, fit, indices, integers, reals
from ._library import check, library
from ._structures import Mesh, NodalField, Zone, sized
from ._text import name_bytes, path_bytes

# VTK's numbers of the cells that meshio names.
TYPES = {
    "vertex": 1, "line": 3, "triangle": 5, "quad": 9, "tetra": 10, "hexahedron": 12, "wedge": 13,
    "pyramid": 14, "line3": 21, "triangle6": 22, "quad8": 23, "tetra10": 24, "hexahedron20": 25,
    "wedge15": 26, "pyramid13": 27, "quad9": 28, "hexahedron27": 29,
}


class Cells:
    """Nodes with cells; structure: signorini_mesh."""

    def __init__(self, coordinates, cells):
        self.coordinates = points(coordinates)
        if cells is None:
            raise TypeError("cells is None: give the nodes of the cells by their types, such as {'hexahedron': array}")
        blocks = cells.items() if hasattr(cells, "items") else [_block(block) for block in cells]
        types, starts, nodes = [], [np.zeros(1, np.int64)], []
        for name, block in blocks:
            if name not in TYPES:
                raise ValueError(f"cells: there is no type {name!r}; types: {', '.join(TYPES)}")
            block = integers(f"cells of the type {name}", block)
            if block.ndim != 2:
                raise ValueError(f"cells of the type {name} have the shape {block.shape}: give the "
                                 f"nodes of each, shape (cells, nodes)")
            types.append(np.full(len(block), TYPES[name], np.int32))
            starts.append(starts[-1][-1] + block.shape[1] * np.arange(1, len(block) + 1))
            nodes.append(block.ravel())
            if not len(block):
                starts.pop()
        self.types = np.concatenate([np.zeros(0, np.int32), *types])
        self.starts = indices(np.concatenate(starts))
        self.nodes = indices(np.concatenate([np.zeros(0, np.int64), *nodes]))
        count, dim = self.coordinates.shape
        self.structure = sized(
            Mesh, dim=dim, nodes=count, coordinates=at(self.coordinates), cells=len(self.types),
            cell_types=at(self.types), cell_start=at(self.starts), cell_nodes=at(self.nodes),
        )

    def write(self, path, u=None, zones=(), fields=()):
        """Writes them to a file, with displacements, zones and fields."""
        functions = library()
        zones, fields = (Zone * len(zones))(*zones), (NodalField * len(fields))(*fields)
        check(functions, functions.mesh_write(path_bytes(path), ctypes.byref(self.structure), at(u),
                                              len(zones), zones, len(fields), fields))


def write_mesh(path, coordinates, cells, fields=None):
    """Writes a mesh with fields at its nodes to a file .vtu, which ParaView opens.

    coordinates: (nodes, D).  cells: nodes of the cells by meshio's names of their types, a
    dictionary such as {"hexahedron": (C, 8)}, or the cells of a meshio mesh; counted from 0, in
    VTK's order.
    fields: a dictionary of numbers, (nodes,), or vectors, (nodes, D) or nodes * D.
    """
    mesh, kept = Cells(coordinates, cells), []
    count, dim = mesh.coordinates.shape
    for name, values in (fields or {}).items():
        asked = (f"one number for each of the {count} nodes, shape {(count,)}, or a vector for "
                 f"each, shape {(count * dim,)} or {(count, dim)}")
        shape = np.shape(values)
        shapes = [(count,)] if shape == (count,) else [(count * dim,), (count, dim)]
        kept.append((name_bytes(name), fit(f"field {name}", values, shapes, asked)))
    given = [sized(NodalField, components=1 if values.ndim == 1 else dim, name=name, values=at(values))
             for name, values in kept]
    mesh.write(path, fields=given)


def write_series(path, files, times=None):
    """Writes a file .pvd, by which ParaView opens the files .vtu of load steps as one series.

    files: their paths, one for each step; they stand in the .pvd relative to its folder.  times: a number for each
    step, increasing; None: 0, 1, 2, ...
    """
    if isinstance(files, (str, bytes, os.PathLike)):
        raise TypeError(f"files is {files!r}: give a list of paths, one for each step")
    path, files = os.fsdecode(path), [os.fsdecode(file) for file in files]
    times = np.arange(len(files)) if times is None else reals("times", times)
    if times.shape != (len(files),):
        raise ValueError(f"times has the shape {times.shape}: give an increasing number for each of the {len(files)} files")
    if not np.isfinite(times).all():
        raise ValueError(f"times[{np.isfinite(times).argmin()}] is not finite: give an increasing number for each file")
    if (np.diff(times) <= 0).any():
        step = (np.diff(times) <= 0).argmax() + 1
        raise ValueError(f"times[{step}] is not above times[{step - 1}]: give an increasing number for each file")
    for file in files:
        if not os.path.isfile(file):
            raise FileNotFoundError(f"there is no file {file}: write the steps before their series")
    folder = os.path.dirname(os.path.abspath(path))
    lines = ['<?xml version="1.0"?>', '<VTKFile type="Collection" version="0.1">', "  <Collection>"]
    for time, file in zip(times.tolist(), files):
        name = os.path.relpath(os.path.abspath(file), folder).replace(os.sep, "/")
        lines.append(f'    <DataSet timestep="{time!r}" part="0" file={quoteattr(name)}/>')
    lines += ["  </Collection>", "</VTKFile>", ""]
    try:
        text = "\n".join(lines).encode()
    except UnicodeEncodeError as error:
        raise ValueError(f"{error.object[error.start:error.end]!r} in the name of a file is no UTF-8, which a .pvd is: "
                         "give the file another name") from None
    _replace(path, text)


def _replace(path, text):
    """Writes a new file, which replaces an old one and takes over its mode when it is whole."""
    path = os.path.realpath(path)  # a link stays, and names the new file
    if os.path.exists(path) and not os.path.isfile(path):
        raise OSError(f"{path} cannot be written: it is not a file")
    part = f"{path}.{os.getpid()}.part"
    with open(part, "xb") as file:
        try:
            file.write(text)
            file.close()
            if os.path.exists(path):
                os.chmod(part, os.stat(path).st_mode)
            os.replace(part, path)
        except BaseException:
            os.unlink(part)
            raise


def points(coordinates):
    """Coordinates of nodes, (nodes, D)."""
    array = reals("coordinates", coordinates)
    if array.ndim != 2 or array.shape[1] not in (2, 3):
        raise ValueError(f"coordinates has the shape {array.shape}: give the nodes' places, shape "
                         f"(nodes, dim), dim 2 or 3")
    return doubles(array)


def _block(block):
    """Name and nodes of cells of one type: a tuple, or a block of meshio."""
    if hasattr(block, "type") and hasattr(block, "data"):
        return block.type, block.data
    try:
        name, nodes = block
    except (TypeError, ValueError):
        raise ValueError("cells: give a dictionary, or a list of (type, nodes)") from None
    return name, nodes

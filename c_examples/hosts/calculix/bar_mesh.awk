# The mesh and the loads of the bar on the plane, as CalculiX reads them:
#     awk -v mesh=bar_mesh.inc -v loads=bar_loads.inc -f bar_mesh.awk
# Nodes 1 to 33 face the plane y = 0, the others follow row by row. It is the mesh of bar_mesh.c.

function node(column, row) { return row * (columns + 1) + column + 1 }

function load(at, direction, value) { printf "%d,%d,%.12e\n", at, direction, value >loads }

BEGIN {
    columns = 32; rows = 5; ratio = 1.7; side = 40; top_pressure = 5; side_pressure = 10
    for (row = 0; row < rows; row++) sum += ratio ^ row
    for (row = 0; row < rows; row++) height[row] = side * ratio ^ row / sum

    # CalculiX reads 20 characters of a number: of %.16g it would cut off the exponent, in silence.
    print "*NODE, NSET=ALL" >mesh
    for (row = 0; row <= rows; row++) {
        for (column = 0; column <= columns; column++)
            printf "%d,%.12e,%.12e,0.\n", node(column, row), side * column / columns, y >mesh
        y = row == rows - 1 ? side : y + height[row]
    }
    print "*ELEMENT, TYPE=CPE4, ELSET=BAR" >mesh
    for (row = 0; row < rows; row++)
        for (column = 0; column < columns; column++)
            printf "%d,%d,%d,%d,%d\n", ++element, node(column, row), node(column + 1, row),
                node(column + 1, row + 1), node(column, row + 1) >mesh
    print "*NSET, NSET=CONTACT, GENERATE" >mesh
    printf "%d,%d,1\n", node(0, 0), node(columns, 0) >mesh
    print "*NSET, NSET=SYMMETRY, GENERATE" >mesh
    printf "%d,%d,%d\n", node(columns, 0), node(columns, rows), columns + 1 >mesh

    # Consistent nodal loads: each edge gives half of its resultant to both of its ends.
    edge = side / columns
    for (column = 0; column <= columns; column++)
        load(node(column, rows), 2, -top_pressure * edge * (column % columns ? 1 : 0.5))
    for (row = 0; row <= rows; row++)
        load(node(0, row), 1, side_pressure * ((row > 0 ? height[row - 1] : 0) \
            + (row < rows ? height[row] : 0)) / 2)
}

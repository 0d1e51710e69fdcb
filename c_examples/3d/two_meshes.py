"""From two meshes to pressures: the two blocks of two_blocks.py, pressed and twisted in load steps.

    PYTHONPATH=c_examples/3d:c_examples/python python3 c_examples/3d/two_meshes.py

brick_mesh is the host: a mesh, a sparse matrix, supports and loads. It writes two_meshes.vtu for ParaView.
"""
import brick_mesh
import signorini

blocks = brick_mesh.two_blocks()
mesh, slip0 = (blocks.at, {"hexahedron": blocks.bricks}), 0.0
model = signorini.Model.from_meshes(blocks.matrix, mesh, mesh, slave_faces=blocks.slave,
                                    master_faces=blocks.master, fixed=blocks.held)
for twist in (0, 1e5, 2e5, 3e5, 4e5):
    load = blocks.press + twist * blocks.twist
    result = model.solve(load, mu=0.6, slip0=slip0)
    if result.status != signorini.Status.SOLVED:
        raise SystemExit(result.message)
    slip0 = result.d[:, 1:]  # friction remembers
    print(f"twist {twist:6.0f} N mm, friction holds {-model.contact.resultant(result).moment[2]:6.0f}")
model.contact.write("two_meshes.vtu", mesh[1], result, model.recover(result.d, load))

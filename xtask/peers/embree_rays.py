"""Embree (through embreex) on the rays and triangles that `cargo xtask bench --triangles` writes.

Needs `pip install embreex numpy`. Started with the folder of the files; asked by lines of standard input:

  mesh                     reads mesh.f32 (three corners of three coordinates each) and builds; says the seconds
  rays NAME                reads NAME.f32 (origin and direction of each ray)
  time MODE QUERY NAME     MODE fast or robust, QUERY nearest or any; says the seconds on one thread
  hits MODE NAME           writes NAME.t.f32 and NAME.id.i32, distance and triangle of the nearest hits
"""
import sys
import time

try:
    import numpy as np
    from embreex.mesh_construction import TriangleMesh
    from embreex.rtcore_scene import EmbreeScene
except ImportError as e:
    print(e, flush=True)
    sys.exit()

folder = sys.argv[1]
scenes, rays = {}, {}
QUERIES = {"nearest": "INTERSECT", "any": "OCCLUDED"}


def mesh():
    corners = np.fromfile(f"{folder}/mesh.f32", np.float32).reshape(-1, 3, 3)
    scenes.clear()
    rays.clear()
    seconds = {}
    somewhere = np.zeros((1, 3), np.float32), np.ones((1, 3), np.float32)
    for mode in ("fast", "robust"):
        scene = EmbreeScene(robust=mode == "robust")
        geometry = TriangleMesh(scene, corners)
        # The first ray builds the hierarchy.
        begun = time.perf_counter()
        scene.run(*somewhere)
        seconds[mode] = time.perf_counter() - begun
        scenes[mode] = scene, geometry
    return seconds["robust"]


def read_rays(name):
    both = np.fromfile(f"{folder}/{name}.f32", np.float32).reshape(-1, 6)
    rays[name] = np.ascontiguousarray(both[:, :3]), np.ascontiguousarray(both[:, 3:])
    return len(both)


def timed(mode, query, name):
    scene, _ = scenes[mode]
    origins, directions = rays[name]
    begun = time.perf_counter()
    scene.run(origins, directions, query=QUERIES[query])
    return time.perf_counter() - begun


def hits(mode, name):
    scene, _ = scenes[mode]
    found = scene.run(*rays[name], output=True)
    found["tfar"].astype(np.float32).tofile(f"{folder}/{name}.t.f32")
    found["primID"].astype(np.int32).tofile(f"{folder}/{name}.id.i32")
    return len(found["primID"])


COMMANDS = {"mesh": mesh, "rays": read_rays, "time": timed, "hits": hits}
print("ready", flush=True)
for line in sys.stdin:
    command, *arguments = line.split()
    print(COMMANDS[command](*arguments), flush=True)

"""A scene like the README's in Mitsuba 3, for `cargo xtask bench --peers`.

Needs `pip install mitsuba numpy` and LLVM (on Debian: apt-get install libllvm19, and DRJIT_LIBLLVM_PATH where it is not found).
Asked by lines of standard input: `render` renders 2000x1500 pixels with one sample each and says the seconds.
It renders once before it says `ready`: that compiles the picture's program.
"""
import sys
import time

try:
    import mitsuba as mi
    import numpy as np

    mi.set_variant("llvm_ad_rgb")
    from drjit import set_thread_count
    from mitsuba import ScalarTransform4f as T

    T()
except Exception as e:
    print(str(e).splitlines()[0], flush=True)
    sys.exit()

set_thread_count(2)


def matte(colour):
    return {"type": "diffuse", "reflectance": {"type": "rgb", "value": colour}}


def mirror():
    return {"type": "conductor", "material": "none"}


def chess(first, second, cells):
    colours = {f"color{i}": {"type": "rgb", "value": c} for i, c in enumerate((first, second))}
    return {"type": "diffuse", "reflectance": {"type": "checkerboard", **colours, "to_uv": T().scale(cells)}}


def ball(centre, radius, surface):
    return {"type": "sphere", "center": centre, "radius": radius, "bsdf": surface}


def sheet(origin, normal, surface, size):
    target = [o + n for o, n in zip(origin, normal)]
    place = T().look_at(origin=origin, target=target, up=[0.123, 0.3, 0.9]) @ T().scale(size)
    return {"type": "rectangle", "to_world": place, "bsdf": surface}


white = {"type": "twosided", "b": matte([1, 1, 1])}
floor = {"type": "blendbsdf", "weight": 0.1, "a": chess([0, 0, 1], [1, 1, 1], 100), "b": mirror()}
description = {
    "type": "scene",
    "integrator": {"type": "path", "max_depth": 5},
    "sensor": {
        "type": "perspective", "fov": 31.19, "fov_axis": "x",
        "to_world": T().look_at(origin=[1, 0, 3], target=[4, 5, 2], up=[0, 0, 1]),
        "film": {"type": "hdrfilm", "width": 2000, "height": 1500, "rfilter": {"type": "box"}},
        "sampler": {"type": "independent", "sample_count": 1},
    },
    "ball0": ball([9, 11, 1.5], 1.5, chess([1, 0, 0], [0, 1, 0], 6)),
    "ball1": ball([6, 11, 1], 1, mirror()),
    "ball2": ball([9, 8, 0.3], 0.3, matte([1, 0, 0])),
    "ball3": ball([7, 7.5, 0.6], 0.6, chess([1, 1, 1], [0, 0, 0], 6)),
    "floor": sheet([0, 0, 0], [0, 0, 1], floor, 100),
}
for i, position in enumerate([[5, 5, 4], [10, 5, 3], [13, 7, 2]]):
    description[f"lamp{i}"] = {"type": "point", "position": position, "intensity": 1.5}
walls = [
    ([20, 20, 0], [-3, -1, 0]), ([20, 20, 0], [1, -3, 0]), ([-20, -20, 0], [3, 1, 0]),
    ([-20, -20, 0], [-1, 3, 0]), ([0, 0, 50], [0, 0, -1]),
]
for i, (origin, normal) in enumerate(walls):
    description[f"wall{i}"] = sheet(origin, normal, white, 200)
scene = mi.load_dict(description)



def rendered():
    begun = time.perf_counter()
    np.array(mi.render(scene, spp=1))
    return time.perf_counter() - begun


rendered()
print("ready", flush=True)
for line in sys.stdin:
    print(rendered(), flush=True)

# Renders a scene file: SCENE PICTURE WIDTH HEIGHT SAMPLES SEED THREADS. Writes red, green and blue
# as 32-bit floats, least byte first, and says `seconds` and how many the second rendering took.
import sys
import time

import mitsuba as mi
import numpy as np

scene_file, picture, width, height, samples, seed, threads = sys.argv[1:]
try:
    mi.set_variant("llvm_ad_rgb")
    from drjit import JitBackend, has_backend

    if not has_backend(JitBackend.LLVM):
        raise ImportError("no LLVM")
except Exception:
    # Slower, but it needs nothing else.
    mi.set_variant("scalar_rgb")

from drjit import set_thread_count

set_thread_count(int(threads))
scene = mi.load_file(scene_file, width=width, height=height)


def rendered(seed):
    begun = time.perf_counter()
    values = np.array(mi.render(scene, spp=int(samples), seed=seed))
    return time.perf_counter() - begun, values


rendered(int(seed) + 1)
seconds, values = rendered(int(seed))
np.ascontiguousarray(values[..., :3], dtype="<f4").tofile(picture)
print("seconds", seconds, flush=True)

"""The targets: ratios to Embree's best mode in the same run, each a floor and an aim."""

SCENES = ["s1", "s2", "s3", "mol", "u1e5", "mol5", "c1e6", "u1e6", "u1e7"]
GROUPS = [["s1", "s2", "s3", "mol"], ["u1e5", "mol5"], ["c1e6", "u1e6", "u1e7"]]
KINDS = ["primary", "random", "shadow", "mirror1", "mirror2", "mirror3", "mirror_shadow2", "mirror_shadow3"]
TITLES = {
    "primary": "primary",
    "random": "random",
    "shadow": "first shadow",
    "mirror1": "mirror 1",
    "mirror2": "mirror 2",
    "mirror3": "mirror 3",
    "mirror_shadow2": "shadow of mirror 2",
    "mirror_shadow3": "shadow of mirror 3",
    "build": "build",
}

# A line for each group of scenes: (floor, aim) of primary, random, first shadow, mirror, their shadows, build.
_RATIOS = [
    [(7, 12), (2.8, 4), (4.5, 8), (2.8, 4), (3, 5), (5.5, 10)],
    [(4.5, 10), (2.8, 4), (4, 8), (2.8, 4), (3, 5), (4.5, 10)],
    [(3.5, 8), (2.8, 5), (4, 8), (2.8, 4.5), (3, 5), (7, 10)],
]
_COLUMN = {"primary": 0, "random": 1, "shadow": 2, "mirror1": 3, "mirror2": 3, "mirror3": 3, "build": 5}
_COLUMN.update({"mirror_shadow2": 4, "mirror_shadow3": 4})

# Rays of ambient occlusion along shared directions: floors beside Embree's along random ones, and along the same ones.
AMBIENT_SHARED, AMBIENT_OWN = 5, 3  # both along shared ones, and both along random ones
AMBIENT = {scene: (beside_random, AMBIENT_SHARED) for scene, beside_random in {"s1": 3, "mol": 5, "u1e5": 2.5, "u1e6": 4}.items()}
COMB = 2.5

BYTES = (19, 16.5)  # per sphere, at most
AVX2 = {"primary": 4.5, "random": 1.3, "shadow": 1.8, "mirror1": 1.4, "mirror2": 1.4, "mirror3": 1.4}
PICTURE = (4, 8)  # times as fast as Tachyon
# The same with ambient occlusion.
OCCLUSION = {"1tii": (8, 16), "u1e6": (4, 8)}
FILE_TO_PNG_S = 0.5  # a molecule of 5,684 atoms without any option, as an aim
# Frames of the thesis with bytes in memory, on two cores: the floor by instruction set, and the aim.
THESIS_FLOORS = {"avx512": 240, "avx2": 240}
THESIS_AIM = 500
WASM = 4  # times the native time, at most
PAGE_MB = 2  # a visitor's download, compressed with gzip, at most
FIRST_PICTURE_MS = 2000  # until it is on the screen, at most


def ratio_target(scene, kind):
    """(floor, aim) for a scene and a kind of rays, or `build`."""
    group = next(number for number, scenes in enumerate(GROUPS) if scene in scenes)
    return _RATIOS[group][_COLUMN[kind]]

"""A hundred figures over all appearances and kinds of files, as options of `bihive render`, and their inputs."""

import math
import pathlib
import shutil

TOP = pathlib.Path(__file__).resolve().parents[2]
SIZE = ["--size", "160x120"]
STYLES = ["default", "plain", "illustrative", "studio", "glossy", "flat", "xray"]


def halton(index, base):
    share, digit = 0.0, 1.0 / base
    while index:
        index, rest = divmod(index, base)
        share += rest * digit
        digit /= base
    return share


def write_inputs(folder):
    """The files beside the figures: those of the tests, and some that are made here."""
    folder = pathlib.Path(folder)
    data = TOP / "tests/data/io"
    shutil.copy(TOP / "data/1hpv.pdb", folder)
    for name in ("water.gro", "water.xtc", "water.gsd"):
        shutil.copy(data / "trajectories" / name, folder)
    shutil.copy(data / "sets.h5", folder)
    points = [tuple(10 * halton(i, base) for base in (2, 3, 5)) for i in range(1, 3001)]
    lines = ["x,y,z,r,charge,part"]
    for i, (x, y, z) in enumerate(points[:800]):
        radius = 0.1 + 0.5 * halton(i + 1, 7)
        charge = "" if i % 50 == 0 else repr(round(math.sin(i), 6))
        lines.append(f"{x!r},{y!r},{z!r},{radius!r},{charge},{'left' if x < 5 else 'right'}")
    (folder / "grains.csv").write_text("\n".join(lines) + "\n")
    (folder / "points.xyz").write_text(f"{len(points)}\n\n" + "".join(f"1 {x!r} {y!r} {z!r}\n" for x, y, z in points))
    dump = []
    for frame in range(3):
        dump += ["ITEM: TIMESTEP", str(100 * frame), "ITEM: NUMBER OF ATOMS", "400", "ITEM: BOX BOUNDS pp pp pp", "0 10", "0 10", "0 10",
                 "ITEM: ATOMS id type x y z vx"]
        dump += [f"{i + 1} {i % 3 + 1} {(x + 0.3 * frame) % 10!r} {y!r} {z!r} {math.cos(i + frame)!r}" for i, (x, y, z) in enumerate(points[:400])]
    (folder / "melt.dump").write_text("\n".join(dump) + "\n")
    (folder / "evening.json").write_text('{"bihive_style": 1, "material": "plastic", "colour": "#8899bb", "background": "#101828", "lights": '
                                         '[{"direction": [-1, 0.3, 0.4], "colour": [0.9, 0.6, 0.4], "angle_deg": 10}], '
                                         '"picture": {"ambient_occlusion": {"directions": 16}, "outline": {"width_px": 1}}}')


def figures():
    """Lists of words, the input first."""
    inputs = ["1hpv.pdb", "grains.csv", "points.xyz", "melt.dump", "water.gro"]
    made = [[name, "--style", style] for style in STYLES for name in inputs]
    protein = "1hpv.pdb"
    made += [[protein, "--material", material] for material in ("matte", "plastic", "metal", "glass", "flat", "toon")]
    made += [[protein, "--light", light] for light in ("studio", "cloudy", "headlight", "from:-1,1,1:#ffe0c0:0.6:14", "at:60,60,60:white:0.8:5")]
    made += [[protein, "--select", "chain B", "--opacity", "0.3", "--opacity-rule", rule] for rule in ("first", "once", "each_surface")]
    made += [[protein, "--view", view] for view in ("recursion", "traversal", "normal", "distance", "id", "tree")]
    made += [[protein, "--tone", "filmic", "--exposure", "1"], [protein, "--tone", "soft", "--exposure", "-0.5"],
             [protein, "--samples", "auto"], [protein, "--samples", "16", "--style", "plain"], [protein, "--bits", "16"],
             [protein, "--background", "none"], [protein, "--background", "none", "--matte", "#203040", "--fog", "0.7"],
             [protein, "--stereo", "side"], [protein, "--stereo", "anaglyph"], [protein, "--aperture", "2", "--focus", "resname 478", "--samples", "32"],
             [protein, "--fit", "resname 478", "--style", "illustrative"], [protein, "--zoom-to", "chain A"],
             [protein, "--view-from", "iso", "--projection", "orthographic", "--scale-bar", "--axes"], [protein, "--view-from", "principal"],
             [protein, "--view-from", "best:resname 478"], [protein, "--turn", "40,20,10", "--zoom", "1.4"], [protein, "--up", "1,1,0", "--fov", "60"],
             [protein, "--crop", "20,30,100,90"], [protein, "--clip", "plane:0,0,1,10", "--style", "studio"],
             [protein, "--select", "chain A", "--clip", "sphere:12,20,8,14", "--select", "water", "--hide"],
             [protein, "--crease", "chain", "--outline", "2", "--outline-colour", "#800000"], [protein, "--cell", "--cell-width", "3"],
             [protein, "--colour-by", "b_factor:plasma:2%,98%", "--legend", "--legend-title", "B (\u00c5\u00b2)"],
             [protein, "--colour-by", "chain", "--legend", "--title", "HIV-1 protease"], [protein, "--element-colours", "cpk", "--no-water"]]
    made += [["grains.csv", "--colour-by", f"charge:{scale}", "--legend"] for scale in ("coolwarm:mid=0", "viridis_r", "blue-white-red")]
    made += [["grains.csv", "--select", "r < 0.3", "--hide", "--select", "part = right", "--opacity", "0.4", "--material", "glass"],
             ["grains.csv", "--style", "evening.json", "--nan-colour", "red", "--colour-by", "charge"], ["grains.csv", "--radius-scale", "0.5", "--recenter"],
             ["melt.dump", "--frame", "1", "--smooth", "3", "--title", "step {step}", "--cell"], ["melt.dump", "--frame", "-1", "--colour-by", "vx", "--legend"],
             ["melt.dump", "--replicate", "2x1x2", "--cell"], ["melt.dump", "--wrap", "--colour-by", "type"],
             ["water.gro", "--trajectory", "water.xtc", "--frame", "2", "--unwrap"], ["water.gro", "--trajectory", "water.xtc", "--frame", "1", "--smooth", "3"],
             ["water.gsd", "--frame", "1"], ["points.xyz", "--radius", "0.2", "--colour-by", "z:inferno", "--ao-directions", "32"],
             ["scenario1", "--count", "500"], ["scenario2", "--count", "300", "--recursion", "3"], ["scenario3", "--count", "300"], ["four-spheres"],
             ["demo", "--style", "glossy", "--recursion", "8"], ["demo", "--style", "xray", "--opacity-rule", "each_surface"]]
    return [[*words, *SIZE] for words in made]

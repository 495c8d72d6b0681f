"""The bundled molecule by other programs, each with several numbers of threads: which of them repeat their bits?"""

import hashlib
import os
import pathlib
import shutil
import subprocess

SIZE = (640, 480)
THREADS = (1, 2, 4)
CAMERA = (12.7, 21.5, 130.0), (12.7, 21.5, 8.9)  # eye and the middle of the molecule
RADII = {"C": 1.7, "N": 1.55, "O": 1.52, "S": 1.8}
COLOURS = {"C": (0.55, 0.55, 0.55), "N": (0.2, 0.3, 0.9), "O": (0.9, 0.15, 0.1), "S": (0.9, 0.8, 0.2)}


def atoms_of(pdb):
    for line in pathlib.Path(pdb).read_text().splitlines():
        if line.startswith(("ATOM", "HETATM")):
            element = line[76:78].strip()
            yield element, tuple(float(line[first:first + 8]) for first in (30, 38, 46))


def pixels_hash(path):
    """SHA-256 of a PNG's or TGA's pixels, without what the file says besides."""
    done = subprocess.run(["ffmpeg", "-v", "error", "-i", str(path), "-f", "rawvideo", "-pix_fmt", "rgb24", "-"], capture_output=True, check=True)
    return hashlib.sha256(done.stdout).hexdigest()


def run(command, folder):
    # Debian's PyMOL needs Debian's Python.
    environment = {**os.environ, "PATH": "/usr/bin:" + os.environ["PATH"]}
    subprocess.run([str(word) for word in command], cwd=folder, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=True)


def tachyon(pdb, folder, occlusion):
    (eye, middle), (width, height) = CAMERA, SIZE
    lines = ["BEGIN_SCENE", f"RESOLUTION {width} {height}", "SHADER_MODE FULL", "TRANS_VMD", "END_SHADER_MODE", "CAMERA", "ZOOM 3.7", f"ASPECTRATIO {height / width}", "ANTIALIASING 2", "RAYDEPTH 4",
              f"CENTER {eye[0]} {eye[1]} {-eye[2]}", "VIEWDIR 0 0 1", "UPDIR 0 1 0", "END_CAMERA", "BACKGROUND 1 1 1",
              f"LIGHT CENTER {eye[0] - 60} {eye[1] + 60} {-eye[2]} RAD 0.1 COLOR 0.8 0.8 0.8"]
    for element, (x, y, z) in atoms_of(pdb):
        r, g, b = COLOURS.get(element, (0.5, 0.5, 0.5))
        lines.append(f"SPHERE CENTER {x} {y} {-z} RAD {RADII.get(element, 1.7)} TEXTURE AMBIENT 0.2 DIFFUSE 0.8 SPECULAR 0 OPACITY 1 "
                     f"COLOR {r} {g} {b} TEXFUNC 0")
    (folder / "scene.dat").write_text("\n".join([*lines, "END_SCENE", ""]))
    for threads in THREADS:
        sky = ["-add_skylight", "0.8", "-skylight_samples", "64"] if occlusion else []
        run(["tachyon", "scene.dat", "-fullshade", *sky, "-numthreads", threads, "-format", "TARGA", "-o", f"tachyon{threads}.tga"], folder)
        yield folder / f"tachyon{threads}.tga"


def povray(pdb, folder, occlusion):
    (eye, middle), (width, height) = CAMERA, SIZE
    lines = ["#version 3.7; global_settings { assumed_gamma 1" + (" radiosity { count 100 }" if occlusion else "") + " }",
             f"camera {{ location <{eye[0]}, {eye[1]}, {-eye[2]}> look_at <{middle[0]}, {middle[1]}, {-middle[2]}> angle 30 }}",
             "background { rgb 1 }", f"light_source {{ <{eye[0] - 60}, {eye[1] + 60}, {-eye[2]}> rgb 1" +
             (" area_light <10, 0, 0>, <0, 10, 0>, 4, 4 adaptive 1 jitter" if occlusion else "") + " }"]
    for element, (x, y, z) in atoms_of(pdb):
        r, g, b = COLOURS.get(element, (0.5, 0.5, 0.5))
        lines.append(f"sphere {{ <{x}, {y}, {-z}>, {RADII.get(element, 1.7)} pigment {{ rgb <{r}, {g}, {b}> }} }}")
    (folder / "scene.pov").write_text("\n".join(lines))
    for threads in THREADS:
        run(["povray", "+Iscene.pov", f"+Opovray{threads}.png", f"+W{width}", f"+H{height}", "+A0.3", "-D", f"+WT{threads}"], folder)
        yield folder / f"povray{threads}.png"


def pymol(pdb, folder, occlusion):
    """Its ambient occlusion is for surfaces, not for spheres."""
    width, height = SIZE
    if occlusion:
        return
    for threads in THREADS:
        steps = ["hide everything", "show spheres", "bg_color white", f"set max_threads, {threads}", "set antialias, 2",
                 f"ray {width}, {height}", f"png pymol{threads}.png"]
        run(["pymol", "-cq", pdb, *[word for step in steps for word in ("-d", step)]], folder)
        yield folder / f"pymol{threads}.png"


def molstar(pdb, folder, occlusion):
    """In a browser whose WebGL is software, on as many processors as there are threads. BIHIVE_MOLSTAR: the folder of its modules
    (molstar.mjs). It has no shadows without blur, so that "sharp" is without any."""
    modules = os.environ["BIHIVE_MOLSTAR"]
    for threads in THREADS:
        if threads > os.cpu_count():
            continue
        out = folder / f"molstar{threads}"
        run(["taskset", "-c", f"0-{threads - 1}", "node", pathlib.Path(__file__).with_name("molstar.mjs"), modules, pdb, out], folder)
        yield out.with_name(out.name + ("-soft.png" if occlusion else "-sharp.png"))


def is_here(name):
    return "BIHIVE_MOLSTAR" in os.environ if name == "Mol*" else shutil.which(name.lower().replace("-", "")) is not None


def bihive(program):
    def draw(pdb, folder, occlusion):
        style = ["--style", "default" if occlusion else "plain"]
        for threads in THREADS:
            run([program, "render", pdb, "-o", f"bihive{threads}.png", "--size", "{}x{}".format(*SIZE), "--threads", threads, *style], folder)
            yield folder / f"bihive{threads}.png"
    return draw


def repeats(program, pdb, folder):
    """A row for each program: its name, and for sharp shadows and for soft light whether all its pictures are equal; None: it is not here, or
    has no such light."""
    rows = []
    for name, draw in [("bihive", bihive(program)), ("Tachyon", tachyon), ("POV-Ray", povray), ("PyMOL", pymol), ("Mol*", molstar)]:
        row = {"program": name}
        for kind, occlusion in [("sharp", False), ("soft", True)]:
            if name != "bihive" and not is_here(name):
                row[kind] = None
                continue
            folder_of = pathlib.Path(folder) / f"{name}-{kind}"
            folder_of.mkdir(parents=True, exist_ok=True)
            pictures = {pixels_hash(path) for path in draw(pdb, folder_of, occlusion)}
            row[kind] = len(pictures) == 1 if pictures else None
        rows.append(row)
    return rows

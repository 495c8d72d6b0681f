"""The build backend for pip: CMake builds the package, and this file packs the result into a wheel.

It needs nothing besides Python and what bihive's build needs. CMAKE_ARGS in the environment holds options of CMake; the build
is in build-pip, so that the next call continues from it.
"""

import base64
import hashlib
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import sysconfig
import tempfile
import zipfile

TOP = pathlib.Path(__file__).resolve().parents[3]


def version():
    """The project's, as CMake knows it."""
    text = (TOP / "CMakeLists.txt").read_text(encoding="utf-8")
    return re.search(r"project\(bihive VERSION ([0-9.]+)", text).group(1)


def metadata():
    text = (TOP / "bindings/python/METADATA.in").read_text(encoding="utf-8")
    return text.replace("@PROJECT_VERSION@", version())


def tag():
    """This Python and this machine alone: the module is linked to the system's libraries."""
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{re.sub('[-.]', '_', sysconfig.get_platform())}"


def run(*words):
    print(shlex.join(words), flush=True)
    try:
        subprocess.run(words, check=True)
    except FileNotFoundError:
        raise SystemExit(f"bihive is built by {words[0]}, which is not installed: run scripts/setup python") from None
    except subprocess.CalledProcessError:
        raise SystemExit("bihive could not be built: the reason is printed above") from None


def build(folder):
    """Builds package and program, and installs the package into the folder."""
    made = TOP / "build-pip"
    options = [f"-DPython_EXECUTABLE={sys.executable}", "-DBIHIVE_PYTHON=ON", "-DBIHIVE_PYTHON_FOLDER=."]
    options += ["-DBIHIVE_BUILD_VIEWER=OFF", "-DBIHIVE_BUILD_BENCH=OFF", "-DCMAKE_BUILD_TYPE=Release"]
    options += shlex.split(os.environ.get("CMAKE_ARGS", ""))
    generator = ["-G", "Ninja"] if shutil.which("ninja") else []
    run("cmake", "-S", str(TOP), "-B", str(made), *generator, *options)
    run("cmake", "--build", str(made), "--target", "bihive_python", "bihive", "--parallel")
    run("cmake", "--install", str(made), "--component", "python", "--prefix", str(folder), "--strip")
    return made / "bihive"


def record_line(name, data):
    digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
    return f"{name},sha256={digest},{len(data)}"


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """PEP 517: a wheel in the directory; returns its name."""
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        program = build(folder)
        files = [(path.relative_to(folder).as_posix(), path.read_bytes()) for path in sorted(folder.rglob("*")) if path.is_file()]
        files.append((f"bihive-{version()}.data/scripts/bihive", program.read_bytes()))
    return pack(files, wheel_directory, tag())


def pack(files, wheel_directory, its_tag):
    """Writes a wheel of these (path, bytes) and what describes it; returns its name."""
    name = f"bihive-{version()}-{its_tag}.whl"
    about = f"bihive-{version()}.dist-info"
    files.append((f"{about}/METADATA", metadata().encode()))
    files.append((f"{about}/WHEEL", f"Wheel-Version: 1.0\nGenerator: bihive_build\nRoot-Is-Purelib: false\nTag: {its_tag}\n".encode()))
    files.append((f"{about}/LICENSE", (TOP / "LICENSE").read_bytes()))
    record = [record_line(path, data) for path, data in files] + [f"{about}/RECORD,,", ""]
    files.append((f"{about}/RECORD", "\n".join(record).encode()))
    with zipfile.ZipFile(pathlib.Path(wheel_directory) / name, "w", zipfile.ZIP_DEFLATED) as wheel:
        for path, data in files:
            entry = zipfile.ZipInfo(path)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = (0o100755 if "/scripts/" in path or "/bin/" in path or path.endswith(".so") else 0o100644) << 16
            wheel.writestr(entry, data)
    return name


def build_sdist(sdist_directory, config_settings=None):
    """PEP 517: the sources that Git knows, as they are now committed."""
    name = f"bihive-{version()}.tar.gz"
    path = str(pathlib.Path(sdist_directory) / name)
    run("git", "-C", str(TOP), "archive", "--format=tar.gz", f"--prefix=bihive-{version()}/", "-o", path, "HEAD")
    return name

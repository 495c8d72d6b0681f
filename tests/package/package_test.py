"""What `make package` packs: the promised files, in packages that say what they need, and an archive that runs anywhere.

Usage: package_test.py BUILD_FOLDER CPACK SCRATCH_FOLDER
The programs are those of the build; nothing is compiled.
"""

import gzip
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

BUILD, CPACK, SCRATCH = pathlib.Path(sys.argv[1]), sys.argv[2], pathlib.Path(sys.argv[3])
SOURCE = pathlib.Path(__file__).resolve().parent.parent.parent
ENVIRONMENT = {"PATH": "/usr/bin:/bin", "HOME": "/nonexistent", "LC_ALL": "C.UTF-8"}


def output_of(*command, **options):
    done = subprocess.run([str(word) for word in command], text=True, capture_output=True, timeout=900, **options)
    assert done.returncode == 0, (command, done.returncode, done.stdout, done.stderr)
    return done.stdout


def one(pattern):
    found = list(SCRATCH.glob(pattern))
    assert len(found) == 1, (pattern, found)
    return found[0]


class Packages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(SCRATCH, ignore_errors=True)
        output_of(CPACK, "-B", SCRATCH, cwd=BUILD, env={**os.environ, "SOURCE_DATE_EPOCH": "1767225600"})
        cls.unpacked = {}
        for package in ("bihive", "libbihive-c*", "libbihive-dev"):
            cls.unpacked[package] = SCRATCH / "unpacked" / package.strip("*")
            cls.unpacked[package].mkdir(parents=True)
            output_of("dpkg-deb", "-x", one(f"{package}_*.deb"), cls.unpacked[package])

    def files(self, package):
        root = self.unpacked[package]
        return {path.relative_to(root).as_posix() for path in root.rglob("*") if not path.is_dir()}

    def field(self, package, name):
        return output_of("dpkg-deb", "-f", one(f"{package}_*.deb"), name).strip()

    def test_the_package_of_the_programs(self):
        files = self.files("bihive")
        commands = output_of(BUILD / "bihive", "describe", "commands").split()
        expected = {
            "usr/bin/bihive",
            "usr/bin/bihive-thesis",
            "usr/share/bash-completion/completions/bihive",
            "usr/share/zsh/vendor-completions/_bihive",
            "usr/share/fish/vendor_completions.d/bihive.fish",
            "usr/share/doc/bihive/copyright",
            "usr/share/doc/bihive/changelog.gz",
            "usr/share/doc/bihive/changelog.Debian.gz",
            "usr/share/lintian/overrides/bihive",
            "usr/share/man/man1/bihive.1.gz",
            *(f"usr/share/man/man1/bihive-{command}.1.gz" for command in commands),
        }
        if (BUILD / "bihive-view").exists():
            expected |= {
                "usr/bin/bihive-view",
                "usr/share/applications/bihive.desktop",
                "usr/share/mime/packages/bihive-types.xml",
                "usr/share/icons/hicolor/scalable/apps/bihive.svg",
            }
        page = SOURCE / "build-web/page"
        if (page / "index.html").exists():
            expected |= {f"usr/share/bihive/web/{path.relative_to(page)}" for path in page.rglob("*") if path.is_file()}
        self.assertEqual(files, expected)

    def test_the_package_of_the_library_for_c_has_the_name_of_its_soname(self):
        library = (BUILD / "bindings/c/libbihive_c.so").resolve()
        soname = re.search(r"SONAME.*\[libbihive_c\.so\.([\d.]+)\]", output_of("readelf", "-d", library)).group(1)
        package = f"libbihive-c{soname}"
        self.assertEqual(self.field("libbihive-c*", "Package"), package)
        documents = {f"usr/share/doc/{package}/{name}" for name in ("copyright", "changelog.gz", "changelog.Debian.gz")}
        names = {f"usr/lib/libbihive_c.so.{soname}", f"usr/lib/{library.name}", f"usr/share/lintian/overrides/{package}"}
        self.assertEqual(self.files("libbihive-c*"), documents | names)
        shlibs = output_of("dpkg-deb", "-I", one("libbihive-c*.deb"), "shlibs")
        self.assertEqual(shlibs, f"libbihive_c {soname} {package} (>= {self.field('bihive', 'Version').split('-')[0]})\n")
        self.assertIn(f"{package} (= {self.field('bihive', 'Version')})", self.field("libbihive-dev", "Depends"))
        self.assertNotIn("libbihive", self.field("bihive", "Depends"))

    def test_the_package_of_the_library(self):
        headers = {line for line in (SOURCE / "cmake/public_headers.txt").read_text().splitlines() if line.startswith("bihive/")}
        files = self.files("libbihive-dev")
        self.assertLessEqual({f"usr/include/{header}" for header in headers}, files)
        self.assertIn("usr/lib/libbihive.a", files)
        self.assertIn("usr/lib/libbihive_rays.a", files)
        self.assertIn("usr/lib/cmake/bihive/bihiveConfig.cmake", files)
        self.assertTrue([name for name in files if name.endswith("/pkgconfig/bihive.pc")])
        self.assertFalse([name for name in files if name.startswith(("usr/bin", "usr/share/man"))])

    def test_they_say_what_they_need(self):
        self.assertRegex(self.field("bihive", "Version"), r"\A\d+\.\d+\.\d+-1\Z")
        self.assertRegex(self.field("bihive", "Depends"), r"libtbb12.*")
        self.assertIn("libpng16-16", self.field("bihive", "Depends"))
        self.assertIn("libtbb-dev", self.field("libbihive-dev", "Depends"))
        self.assertTrue(self.field("bihive", "Description").startswith("ray tracer for spheres"))
        copyright_text = (self.unpacked["bihive"] / "usr/share/doc/bihive/copyright").read_text()
        for sentence in ("2026 bihive authors", "THE SOFTWARE IS PROVIDED", "names not containing either the words \"Bitstream\"", "CC0"):
            self.assertIn(sentence, " ".join(copyright_text.split()))
        changes = gzip.decompress((self.unpacked["bihive"] / "usr/share/doc/bihive/changelog.Debian.gz").read_bytes()).decode()
        self.assertIn("Thu, 01 Jan 2026 00:00:00 +0000", changes)

    def test_the_program_runs_from_where_it_was_unpacked(self):
        program = self.unpacked["bihive"] / "usr/bin/bihive"
        self.assertNotIn("PATH", output_of("readelf", "-d", program).split("NEEDED")[-1])
        self.assertIn("1,631", output_of(program, "info", "demo", cwd="/", env=ENVIRONMENT))

    def test_a_consumer_finds_the_library_by_pkg_config(self):
        pc = next(self.unpacked["libbihive-dev"].rglob("bihive.pc"))
        flags = output_of("pkg-config", "--cflags", "--libs", "bihive", env={**ENVIRONMENT, "PKG_CONFIG_PATH": str(pc.parent)})
        program = SCRATCH / "consumer"
        output_of("g++", "-std=c++20", SOURCE / "tests/install/consumer.cpp", *flags.split(), "-o", program)
        self.assertRegex(output_of(program, cwd="/"), r": 1631 atoms\n\Z")

    @unittest.skipUnless(shutil.which("lintian"), "lintian is not installed")
    def test_lintian_has_no_remark_that_is_not_explained(self):
        # A build without the page has no use for the explanation that the page needs. Letters of machine code that look
        # like misspelt words change with each compiler; scripts/check_words reads the sources.
        said = subprocess.run(
            ["lintian", "--allow-root", "--display-info", "--pedantic", "--suppress-tags", "unused-override,spelling-error-in-binary", *map(str, SCRATCH.glob("*.deb"))],
            text=True, capture_output=True, timeout=900)
        self.assertEqual((said.returncode, said.stdout), (0, ""), said.stderr)

    def test_the_archive_runs_from_another_folder_with_its_own_libraries(self):
        root = SCRATCH / "moved"
        output_of("tar", "-xzf", one("bihive-*.tar.gz"), "-C", SCRATCH)
        next(path for path in SCRATCH.glob("bihive-*") if path.is_dir()).rename(root)
        for name in ("bihive", "bihive-thesis", "bihive-view"):
            program = root / "bin" / name
            if not program.exists():
                continue
            # Each library but the system's own comes from the archive.
            for line in output_of("ldd", program, env=ENVIRONMENT).splitlines():
                library, _, place = line.strip().partition(" => ")
                if re.match(r"(linux-vdso|/lib|lib(c|m|dl|pthread|gcc_s|stdc\+\+|X11|xcb|Xau|Xdmcp|bsd|md)\.so)", library):
                    continue
                self.assertTrue(place.startswith(str(root / "bin/../lib/bihive/")), (name, line))
        picture = SCRATCH / "demo.png"
        output_of(root / "bin/bihive", "render", "demo", "-o", picture, "--size", "64x36", cwd="/", env=ENVIRONMENT)
        self.assertTrue(picture.read_bytes().startswith(b"\x89PNG"))
        self.assertTrue((root / "share/doc/bihive/LICENSE").exists())
        licences = {path.name for path in (root / "share/doc/bihive/libraries").iterdir()}
        self.assertLessEqual({"libtbb12", "libpng16-16", "zlib1g"}, licences)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)

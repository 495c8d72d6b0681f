"""scripts/check_includes finds every kind of offence, and finds none in this project."""

import importlib.machinery
import importlib.util
import os
import pathlib
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ.get("BIHIVE_SOURCE", pathlib.Path(__file__).parent.parent.parent))

sys.dont_write_bytecode = True
loader = importlib.machinery.SourceFileLoader("check_includes", str(SOURCE / "scripts" / "check_includes"))
check_includes = importlib.util.module_from_spec(importlib.util.spec_from_loader("check_includes", loader))
loader.exec_module(check_includes)


class CheckIncludes(unittest.TestCase):
    def offences(self, files):
        """Runs on a small project, given as path -> content."""
        with tempfile.TemporaryDirectory() as folder:
            for name, text in files.items():
                path = pathlib.Path(folder) / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text)
            return check_includes.offences(pathlib.Path(folder).resolve())

    def test_arrow_that_runs_forward(self):
        files = {
            "cmake/public_headers.txt": "bihive/base/check.h\n",
            "src/bihive/math/vec3.h": '#include "bihive/base/check.h"\n#include <cmath>\n',
            "src/bihive/base/check.h": "#pragma once\n",
        }
        self.assertEqual(self.offences(files), [])

    def test_arrow_that_runs_back(self):
        files = {
            "src/bihive/base/check.h": '#pragma once\n#include "bihive/math/vec3.h"\n',
            "src/bihive/math/vec3.h": "#pragma once\n",
        }
        found = self.offences(files)
        self.assertEqual(len(found), 1)
        self.assertTrue(found[0].startswith("src/bihive/base/check.h:2: base must not include math"), found)

    def test_render_must_not_read_files(self):
        files = {
            "src/bihive/render/film.cpp": "#include <bihive/io/npy.h>\n",
            "src/bihive/io/npy.h": "#pragma once\n",
        }
        self.assertEqual(len(self.offences(files)), 1)

    def test_ranks_have_a_wing_of_their_own(self):
        files = {
            "cmake/public_headers.txt": "bihive/spread/communicator.h\n",
            "src/bihive/spread/communicator.h": "#pragma once\n",
            "apps/mpi/main.cpp": '#include "bihive/spread/communicator.h"\n',
        }
        self.assertEqual(self.offences(files), [])
        for path in ("src/bihive/geometry/a.cpp", "src/bihive/io/a.cpp", "src/bihive/scene/a.cpp", "src/bihive/render/a.cpp",
                     "apps/viewer/a.cpp", "bindings/c/a.cpp"):
            found = self.offences({**files, path: '#include "bihive/spread/communicator.h"\n'})
            self.assertEqual([line.split(":")[0] for line in found], [path], found)

    def test_floors_of_the_wide_engine(self):
        files = {
            "src/bihive/wide/tree/radii.h": "#pragma once\n",
            "src/bihive/wide/trace/beams.h": '#pragma once\n#include "bihive/wide/tree/radii.h"\n',
            "src/bihive/wide/schedule/scheduler.cpp": '#include "bihive/wide/trace/beams.h"\n',
        }
        self.assertEqual(self.offences(files), [])
        files["src/bihive/wide/tree/radii.cpp"] = '#include "bihive/wide/tree/radii.h"\n#include "bihive/wide/trace/beams.h"\n'
        found = self.offences(files)
        self.assertEqual(len(found), 1)
        self.assertTrue(found[0].startswith("src/bihive/wide/tree/radii.cpp:2: wide/tree must not include wide/trace"), found)
        del files["src/bihive/wide/tree/radii.cpp"]
        files["src/bihive/wide/attic/a.cpp"] = "\n"
        self.assertEqual(len(self.offences(files)), 1)

    def test_public_header_stands_on_the_floor_of_its_source(self):
        files = {
            "cmake/public_headers.txt": "bihive/render/renderer.h\n",
            "src/bihive/render/renderer.h": "#pragma once\n",
            "src/bihive/render/picture/renderer.cpp": '#include "bihive/render/renderer.h"\n',
            "src/bihive/render/picture/tiles.cpp": '#include "bihive/render/renderer.h"\n',
        }
        self.assertEqual(self.offences(files), [])
        self.one_offence({**files, "src/bihive/render/query/tracer.cpp": '#include "bihive/render/renderer.h"\n'},
                         "render/query must not include render/picture")

    def test_header_that_is_not_there(self):
        self.assertEqual(len(self.offences({"src/bihive/base/a.cpp": '#include "bihive/base/a.h"\n'})), 1)

    def test_header_from_outside(self):
        self.assertEqual(len(self.offences({"src/bihive/base/a.cpp": '#include "support/oracle.h"\n'})), 1)

    def test_unknown_folder(self):
        self.assertEqual(len(self.offences({"src/bihive/misc/a.cpp": "\n"})), 1)

    def test_program_includes_its_own_headers_and_the_library(self):
        files = {
            "cmake/public_headers.txt": "bihive/base/check.h\n",
            "src/bihive/base/check.h": "#pragma once\n",
            "apps/cli/main.cpp": '#include "options.h"\n#include "bihive/base/check.h"\n',
            "apps/cli/options.h": "#pragma once\n",
        }
        self.assertEqual(self.offences(files), [])

    def test_program_includes_a_test(self):
        files = {
            "cmake/public_headers.txt": "bihive/base/check.h\n",
            "src/bihive/base/check.h": "#pragma once\n",
            "apps/cli/main.cpp": '#include "../../tests/oracle.h"\n',
            "tests/oracle.h": "#pragma once\n",
        }
        self.assertEqual(len(self.offences(files)), 1)

    def test_headers_of_front_ends(self):
        files = {"src/bihive/job/input.h": "#pragma once\n", "apps/cli/options.h": "#pragma once\n"}
        for folder in ("bindings/python/module", "bench/ranks"):
            self.assertEqual(self.offences({**files, f"{folder}/a.cpp": '#include "bihive/job/input.h"\n'}), [])
            self.one_offence({**files, f"{folder}/a.cpp": '#include "options.h"\n'}, "is not a header of")
            own = {f"{folder}/own.h": "#pragma once\n", f"{folder}/a.cpp": '#include "own.h"\n'}
            self.assertEqual(self.offences({**files, **own}), [])
        self.assertTrue(self.offences({**files, "src/bihive/render/a.cpp": '#include "bihive/job/input.h"\n'}))

    def one_offence(self, files, words):
        found = self.offences(files)
        self.assertEqual(len(found), 1, found)
        self.assertIn(words, found[0])

    def test_only_a_folder_itself_includes_its_private_headers(self):
        private = {"src/bihive/wide/trace/lists.h": "#pragma once\n"}
        include = '#include "bihive/wide/trace/lists.h"\n'
        self.assertEqual(self.offences({**private, "src/bihive/wide/schedule/queries.cpp": include}), [])
        self.one_offence({**private, "src/bihive/render/tracer.cpp": include}, "is private to src/bihive/wide")
        for outside in ("apps/cli/main.cpp", "bench/measure.cpp", "bindings/wasm/page.cpp"):
            self.one_offence({**private, outside: include}, "is private")
        self.assertEqual(self.offences({**private, "tests/unit/lists_test.cpp": include}), [])

    def test_private_header_that_some_may_include(self):
        header = {"src/bihive/simd/dispatch.h": "#pragma once\n"}
        include = '#include "bihive/simd/dispatch.h"\n'
        for folder in ("wide", "render"):
            self.assertEqual(self.offences({**header, f"src/bihive/{folder}/a.cpp": include}), [])
        self.assertTrue(self.offences({**header, "src/bihive/viewer/a.cpp": include}))

    def test_header_of_rays_includes_headers_of_rays_alone(self):
        self.one_offence({
            "cmake/public_headers.txt": "# A comment.\n[rays]\nbihive/wide/queries.h\nbihive/wide/ray_batch.h\n\n[pictures]\nbihive/bih/tree.h\n",
            "src/bihive/wide/queries.h": '#include "bihive/wide/ray_batch.h"\n#include "bihive/bih/tree.h"\n',
            "src/bihive/wide/ray_batch.h": "",
            "src/bihive/bih/tree.h": "",
        }, "src/bihive/wide/queries.h:2: a header of [rays] must include only headers of that section, not bihive/bih/tree.h")

    def test_headers_of_rays_are_few(self):
        headers = [f"bihive/wide/h{i}.h" for i in range(26)]
        self.one_offence({
            "cmake/public_headers.txt": "# A comment.\n[rays]\n" + "\n".join(headers) + "\n",
            **{f"src/{header}": "" for header in headers},
        }, "[rays] has 26 headers; 25 are the most")

    def test_public_header_includes_public_headers_alone(self):
        files = {
            "cmake/public_headers.txt": "# A comment.\nbihive/wide/queries.h\nbihive/wide/wide_tree.h\n",
            "src/bihive/wide/queries.h": '#include "bihive/wide/wide_tree.h"\n#include <vector>\n',
            "src/bihive/wide/wide_tree.h": "#include <cstdint>\n",
            "src/bihive/wide/tree/node.h": "#pragma once\n",
        }
        self.assertEqual(self.offences(files), [])
        header = "src/bihive/wide/wide_tree.h"
        self.one_offence({**files, header: '#include "bihive/wide/tree/node.h"\n'}, "must not include a private one")
        self.one_offence({**files, header: "#include <hwy/highway.h>\n"}, "the standard library, not hwy/highway.h")

    def test_public_header_that_is_not_there(self):
        self.one_offence({"cmake/public_headers.txt": "bihive/base/gone.h\n"}, "there is no src/bihive/base/gone.h")

    def test_long_file(self):
        self.assertEqual(self.offences({"src/bihive/base/a.cpp": "\n" * 800}), [])
        self.assertEqual(len(self.offences({"src/bihive/base/a.cpp": "\n" * 801})), 1)

    def test_json_is_parsed_by_one_function(self):
        for call in ("json::parse(text)", "ordered_json::parse(a, b)", "nlohmann::json::sax_parse(text, &sax)", "Json::accept(text)"):
            self.one_offence({"apps/cli/main.cpp": f"auto a = {call};\n"}, "json_from_text()")
        self.assertEqual(self.offences({"apps/cli/main.cpp": "auto a = StatedValues::parse(text);\n"}), [])
        self.assertEqual(self.offences({"src/bihive/base/json_text.h": "Json::parse(text);\n"}), [])

    def test_messages_of_the_library_name_no_options(self):
        path = "src/bihive/base/a.cpp"
        self.one_offence({path: 'return Error{"no cell", name, 0, 0, "give one with --cell-vectors"};\n'}, "setting_name()")
        self.one_offence({path: 'text += "; --recenter makes it finer";\n'}, "setting_name()")
        self.one_offence({path: 'return bad("--title: what it wants");\n'}, "setting_name()")
        for line in ("// with --frame 3\n", "if (line == \"a b\") --line_;\n", "\"try 'ase convert --frame 3'\"\n", '"a b{--paper:#fff}"\n'):
            self.assertEqual(self.offences({path: line}), [], line)
        self.assertEqual(self.offences({"apps/cli/main.cpp": '"see --help for more"\n'}), [])

    def test_this_project(self):
        self.assertEqual(check_includes.offences(SOURCE.resolve()), [])


if __name__ == "__main__":
    unittest.main()

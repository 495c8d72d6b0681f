"""Nothing that a terminal obeys, and nothing that nobody sees, is printed: whatever an argument or a file holds, wherever a
message quotes it. The commands and options come from the program's own description."""

# ctest: COST 690

import os
import subprocess
import unicodedata

from program import BIHIVE, PATIENCE_S, ProgramTest, main

MPI = os.environ.get("BIHIVE_MPI", "")
VIEW = os.environ.get("BIHIVE_VIEW", "")
# One of each kind: C0, DEL, C1, bytes that are no UTF-8, marks of direction, separators, invisible characters, tags.
HOSTILE = "a\x1b[31m\x07\x7f\u009b1m\x85\udc9b\udcff\u202eb\u2066\u061c\u200f\u2028\u200b\ufeff\u00ad\U000e0041z"
XYZ = "2\n\nO 0 0 0\nH 1 0 0\n"
SMALL = ["--size", "8x8", "--samples", "1"]
JOINERS = "\u200c\u200d"


class MessagesTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("in.xyz", XYZ)

    def assert_harmless(self, output, arguments):
        text = output.decode()  # fails where it is no UTF-8
        for character in text:
            bad = unicodedata.category(character) in ("Cc", "Cf", "Zl", "Zp") and character not in "\n\t" + JOINERS
            self.assertFalse(bad, (hex(ord(character)), arguments, text[:400]))

    def say(self, *arguments, program=BIHIVE, **options):
        done = subprocess.run([program, *arguments], cwd=self.folder, capture_output=True, timeout=PATIENCE_S,
                              stdin=subprocess.DEVNULL, **options)
        self.assert_harmless(done.stdout, arguments)
        self.assert_harmless(done.stderr, arguments)
        return done

    def options(self):
        return [line.split()[:3] for line in self.succeed("describe", "options").splitlines()]

    def words_of(self, command):
        return {"render": ["in.xyz", "-o", "a.png", *SMALL], "film": ["in.xyz", "-o", "a.y4m", *SMALL],
                "trace": ["in.xyz", "--rays", "r.npy", "--t", "t.npy", "--id", "i.npy"],
                "convert": ["in.xyz", "-o", "a.csv"], "scene": ["four-spheres", "-o", "a.json"],
                "thesis": ["figure-4.1", "--quick", "--out", "out"], "select": ["in.xyz", "all"],
                # A server on an address that is not this machine's ends at once.
                "web": ["in.xyz", "--bind", "203.0.113.1"], "view": ["in.xyz"], "styles": []}.get(command, ["in.xyz"])

    def test_every_option_with_a_hostile_value(self):
        # An option of several commands in one of them, of the others in turn.
        commands = {}
        for command, option, kind in self.options():
            commands.setdefault((option, kind) if option.startswith("-") else (command, option), []).append(command)
        for number, ((option, kind), having) in enumerate(commands.items()):
            command = having[number % len(having)]
            words = self.words_of(command)
            if option.startswith("-"):
                given = [option, HOSTILE] if kind != "-" else [option + "=" + HOSTILE]
                if "-o" in words and option == "--output" or option in words:
                    at = words.index("-o" if option == "--output" else option)
                    words = words[:at] + words[at + 2:]
            else:
                words, given = words[1:], [HOSTILE]
            with self.subTest(command=command, option=option):
                self.say(command, *given, *words)
            # An output of that name would be an input to others; bihive web would serve it.
            if os.path.isfile(os.fsencode(self.path(HOSTILE))):
                os.remove(os.fsencode(self.path(HOSTILE)))

    def test_every_command_with_a_hostile_word(self):
        commands = {command for command, _, _ in self.options()}
        for command in sorted(commands):
            with self.subTest(command=command):
                for words in [[HOSTILE], ["--" + HOSTILE], [*self.words_of(command), HOSTILE]]:
                    done = self.say(command, *words)
                    self.assertNotEqual(done.returncode, 0)
        for words in [[HOSTILE], ["--" + HOSTILE], ["describe", HOSTILE]]:
            self.assertNotEqual(self.say(*words).returncode, 0)

    def test_the_line_below_which_a_caret_stands(self):
        for expression in ["name ~ " + HOSTILE, HOSTILE + " and (", "index 0 " + HOSTILE, "'" + HOSTILE]:
            self.assertEqual(self.say("select", "in.xyz", expression).returncode, 2)
            self.say("render", "in.xyz", "-o", "a.png", *SMALL, "--select", expression, "--hide")

    def test_what_files_hold(self):
        """Titles, columns, texts of atoms, ids of assemblies, names of looks."""
        raw = os.fsencode(HOSTILE.replace("\n", ""))
        name = raw.replace(b",", b"").replace(b" ", b"")
        self.write("a.csv", b"x,y,z,r," + name + b",t\n0,0,0,1,2," + name + b"\n1,1,1,1,3,b\n")
        self.write("a.xyz", b"1\n" + raw + b"\n" + name + b" 0 0 0\n")
        self.write("a.pdb", b"HEADER    " + raw[:30] + b"\nHETATM    1  " + b"\x9b1m " + b"\x1b[A A   1       0.000   0.000   0.000"
                   b"  1.00  0.00           C\n")
        self.write("a.json", b'{"bihive_scene": 1, "name": "' + raw.replace(b"\x1b", b"").replace(b"\x07", b"")
                   + b'", "spheres": [{"centre": [0,0,0], "radius": 1}], "' + b"\xc2\x9b" + b'": 1}')
        self.write("a.dump", b"ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\n"
                   b"ITEM: ATOMS id type x y z " + name + b"\n1 1 0 0 0 0.5\n")
        self.write("values.csv", name + b"\n" + raw + b"\n")
        for file in ["a.csv", "a.xyz", "a.pdb", "a.json", "a.dump"]:
            for words in [["info"], ["info", "--json"], ["info", "--attributes"], ["info", "--attributes", "--json"],
                          ["info", "--frames"], ["info", "--frames", "--json"], ["stats"], ["stats", "--json"],
                          ["convert", "-o", "out.csv"], ["convert", "-o", "out.ply", "--json"], ["info", "--columns", "x=q"],
                          ["render", "-o", "out.png", *SMALL], ["render", "-o", "out.png", *SMALL, "--json"],
                          ["render", "-o", "out.png", *SMALL, "--colour-by", "nothing"],
                          ["render", "-o", "out.png", *SMALL, "--title", "{a}", "--title-values", "values.csv"]]:
                with self.subTest(file=file, words=words):
                    self.say(words[0], file, *words[1:])
            with self.subTest(file=file):
                self.say("select", file, "name nothing")
                self.say("select", file, "nothing = 1")

    def test_bihive_mpi(self):
        if not MPI:
            self.skipTest("bihive-mpi was not built")
        alone = dict(os.environ, OMPI_MCA_btl="self", OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
        for words in [[HOSTILE], ["render", HOSTILE], ["render", "in.xyz", "-o", HOSTILE], ["film", HOSTILE, "-o", "a.y4m"],
                      ["render", "in.xyz", "-o", "a.png", *SMALL, "--select", "name ~ " + HOSTILE]]:
            with self.subTest(words):
                self.say(*words, program=MPI, env=alone)

    def test_bihive_view(self):
        if not VIEW:
            self.skipTest("bihive-view was not built")
        for request in [HOSTILE, '{"input": "' + HOSTILE + '"}', '{"input": "in.xyz", "' + HOSTILE + '": 1}',
                        '{"input": "in.xyz", "look": {"style": "\\u009b"}}', '{"input": "\\u009b\\u202e"}']:
            with self.subTest(request):
                self.assertNotEqual(self.say(request, program=VIEW).returncode, 0)


if __name__ == "__main__":
    main()

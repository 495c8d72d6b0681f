"""Sticks between the pairs of a table: `bihive render --links`, and where it is refused."""

from program import ProgramTest, main

SIZE = ["--size", "80x60", "--samples", "1", "--threads", "1", "--fog", "0", "--eye", "3,0,20", "--look-at", "3,0,0"]
ENGINES = ("wide", "reference", "brute", "wide-brute")
SPHERES = "x,y,z,r\n0,0,0,0.5\n2,0,0,0.5\n4,1,0,0.8\n6,0,0,0.5\n"
LINKS = "first,second,force\n0,1,1\n1,2,3\n2,3,0\n"


class Links(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("s.csv", SPHERES)
        self.write("l.csv", LINKS)

    def picture(self, *options, links="l.csv", spheres="s.csv"):
        words = ["--links", links] if links else []
        return self.succeed_json("render", spheres, "-o", "a.png", *SIZE, *words, *options)["picture_hash"]

    def refused(self, text, *options):
        self.write("bad.csv", text)
        return self.fail_usage("render", "s.csv", *SIZE, "-o", "a.png", "--links", "bad.csv", *options)

    def unreadable(self, text):
        self.write("bad.csv", text)
        return self.fail_input("render", "s.csv", *SIZE, "-o", "a.png", "--links", "bad.csv")

    def test_every_engine_draws_the_same_bits(self):
        for options in ([], ["--link-radius", "force:0.1", "--link-colour", "force:magma", "--ao"], ["--clip", "plane:0,0,1,0"]):
            hashes = {self.picture(*options, "--engine", engine) for engine in ENGINES}
            self.assertEqual(len(hashes), 1, options)
            self.assertNotIn(self.picture(*[option for option in options if "link" not in option and "force" not in option], links=""), hashes)

    def test_each_option_changes_the_picture(self):
        seen = {self.picture(), self.picture(links="")}
        self.assertEqual(len(seen), 2)
        for options in (["--link-radius", "0.2"], ["--link-radius", "force"], ["--link-radius", "force:0.1"], ["--link-colour", "red"],
                        ["--link-colour", "force"], ["--link-colour", "force:viridis:0,9"]):
            picture = self.picture(*options)
            self.assertNotIn(picture, seen, options)
            seen.add(picture)
        self.write("two.csv", "first,second,force\n0,1,1\n1,2,3\n")
        self.assertEqual(self.picture("--link-radius", "force:0.1"), self.picture("--link-radius", "force:0.1", links="two.csv"))

    def test_a_legend_of_links_alone(self):
        links = ["--link-colour", "force:magma", "--colour", "grey"]
        self.assertNotEqual(self.picture(*links, "--legend"), self.picture(*links))

    def test_columns_may_stand_in_any_order(self):
        self.write("other.csv", "# made by hand\nforce,second,first\n1,1,0\n3,2,1\n,3,2\n")
        self.assertEqual(self.picture(links="other.csv"), self.picture())
        self.write("plain.csv", "i,j\n0,1\n1,2\n2,3\n")
        self.assertEqual(self.picture(links="plain.csv"), self.picture())

    def test_hidden_spheres_have_none(self):
        self.write("two.csv", "first,second\n1,2\n")
        hide = ["--select", "index 0 3", "--hide"]
        self.assertEqual(self.picture(*hide), self.picture(*hide, links="two.csv"))
        self.assertNotEqual(self.picture(*hide), self.picture(*hide, links=""))

    def test_cells(self):
        cell = ["--cell-vectors", "7,0,0,0,9,0,0,0,9", "--cell"]
        self.write("across.csv", "first,second\n0,3\n")
        self.write("stated.csv", "first,second,image_a,image_b,image_c\n0,3,-1,0,0\n")
        self.write("inside.csv", "first,second,image_a,image_b,image_c\n0,3,0,0,0\n")
        across = self.picture(*cell, links="across.csv")
        self.assertEqual(across, self.picture(*cell, links="stated.csv"))
        self.assertNotEqual(across, self.picture(*cell, links="inside.csv"))
        copies = [self.picture(*cell, "--replicate", "2x1x1", "--engine", engine, links="across.csv") for engine in ENGINES]
        self.assertEqual(len(set(copies)), 1)

    def test_contacts_that_were_measured(self):
        self.write("near.csv", "x,y,z,r\n0,0,0,1\n1.5,0,0,1\n3.5,0,0,1.2\n")
        self.succeed("measure", "near.csv", "--contacts", "c.csv")
        drawn = self.picture("--link-radius", "area:0.1", "--link-colour", "area:magma", "--legend", links="c.csv", spheres="near.csv")
        self.assertNotEqual(drawn, self.picture("--legend", links="", spheres="near.csv"))

    def test_what_is_refused(self):
        self.assertIn("bad.csv:2", self.unreadable("first,second\n0,1,2\n"))
        self.assertIn("expected a whole number", self.unreadable("first,second\n0,1.5\n"))
        self.assertIn("expected a whole number", self.unreadable("first,second\n-1,1\n"))
        self.assertIn("expected a number", self.unreadable("first,second,f\n0,1,strong\n"))
        self.assertIn("names of two columns", self.unreadable("first\n0\n"))
        self.assertIn("expected the names", self.unreadable("0,1\n1,2\n"))
        self.assertIn("two columns have the name", self.unreadable("a,a\n0,1\n"))
        self.assertIn("image_b", self.unreadable("first,second,image_a\n0,1,0\n"))
        self.assertIn("no line", self.unreadable(""))
        self.assertIn("row 1 names sphere 4", self.refused("first,second\n0,1\n0,4\n"))
        self.assertIn("with itself", self.refused("first,second\n2,2\n"))
        self.assertIn("no periodic cell", self.refused("first,second,image_a,image_b,image_c\n0,1,1,0,0\n"))
        self.assertIn("below 0", self.refused("first,second,f\n0,1,-1\n", "--link-radius", "f"))
        self.assertIn("there are f", self.refused("first,second,f\n0,1,1\n", "--link-radius", "g"))
        self.assertIn("factor", self.refused("first,second,f\n0,1,1\n", "--link-radius", "f:x"))
        self.assertIn("above 0", self.refused("first,second\n0,1\n", "--link-radius", "0"))
        self.assertIn("no colour", self.refused("first,second,f\n0,1,1\n", "--link-colour", "reed"))
        self.assertIn("--links FILE", self.fail_usage("render", "s.csv", "-o", "a.png", "--link-radius", "2"))
        self.assertIn("no links.csv", self.fail_input("render", "s.csv", "-o", "a.png", "--links", "no links.csv"))

    def test_what_is_warned_of(self):
        for text, warning in (("first,second,f\n", "no rows"), ("first,second,f\n0,1,1\n1,2,\n", "1 link is not drawn"), ("first,second,f\n0,1,\n", "radii are unknown")):
            self.write("w.csv", text)
            done = self.run_bihive("render", "s.csv", "-o", "a.png", *SIZE, "--links", "w.csv", "--link-radius", "f")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn(warning, done.stderr)


if __name__ == "__main__":
    main()

"""A film takes no more memory with many frames than with few, but for the list of frames: a few bytes each."""

from program import ProgramTest, is_sanitized, main

# What a frame may add, besides the program's own pages, which differ by a megabyte from run to run.
MOST_BYTES = 10
ROOM = 1_000_000


class FilmMemory(ProgramTest):
    def setUp(self):
        super().setUp()
        if is_sanitized():
            self.skipTest("the address sanitizer keeps freed memory")

    def peak_of_film(self, frames, *more):
        self.write("frames.xyz", "".join(f"3\nframe\nO {0.001 * k} 0 0\nH 1 0 0\nH 0 1 0\n" for k in range(frames)))
        done = self.succeed_json("film", "frames.xyz", "--size", "16x16", "--samples", "1", "--style", "plain", *more)
        return done["peak_memory_bytes"]

    def test_pictures(self):
        few, many = 300, 1500
        growth = min(self.peak_of_film(many, "-o", f"{k}_many.y4m") - self.peak_of_film(few, "-o", f"{k}_few.y4m") for k in range(2))
        self.assertLess(growth, MOST_BYTES * many + ROOM)

    def test_frames(self):
        """Of each a shard draws one."""
        few, many = 1000, 200_000
        growth = min(self.peak_of_film(many, "-o", f"{k}_many/%d.png", "--shard", f"0/{many}") -
                     self.peak_of_film(few, "-o", f"{k}_few/%d.png", "--shard", f"0/{few}") for k in range(2))
        self.assertLess(growth, MOST_BYTES * many + ROOM)


if __name__ == "__main__":
    main()

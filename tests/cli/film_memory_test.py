"""A film takes no more memory with many frames than with few, but for the list of frames: 24 bytes each."""

from program import ProgramTest, is_sanitized, main

# What a frame may add: its place in the file, and some room.
MOST_BYTES = 300


class FilmMemory(ProgramTest):
    def peak(self, frames, *more):
        text = "".join(f"3\nframe\nO {0.001 * k} 0 0\nH 1 0 0\nH 0 1 0\n" for k in range(frames))
        self.write("frames.xyz", text)
        done = self.succeed_json("film", "frames.xyz", "-o", f"film_{frames}.y4m", "--size", "16x16", "--samples", "1",
                                 "--style", "plain", *more)
        return done["peak_memory_bytes"]

    def test_small_frames(self):
        if is_sanitized():
            self.skipTest("the address sanitizer keeps freed memory")
        few, many = 300, 1500
        # The program's own pages differ by a megabyte from run to run, so the smaller growth of two counts.
        growth = min(self.peak(many) - self.peak(few) for _ in range(2))
        self.assertLess(growth, MOST_BYTES * (many - few) + 1_000_000)


if __name__ == "__main__":
    main()

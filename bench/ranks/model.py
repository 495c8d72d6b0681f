"""A model of distributed spheres on many ranks, from measurements of `scripts/bench ranks`. Ranks have one core each.

memory    a base, and bytes for each sphere of a rank: the line through the peaks of real ranks
set-up    read, exchange and tree: core seconds for each sphere of a rank, and the exchanged bytes at the network's rate
picture   that of simulated ranks with CLOUD spheres, times the work of a ray in a larger tree over that in the smaller
"""

import math


def line_through(points):
    """(base, slope) of the line with the least squares."""
    count = len(points)
    mean_x, mean_y = sum(x for x, _ in points) / count, sum(y for _, y in points) / count
    over = sum((x - mean_x) ** 2 for x, _ in points)
    slope = sum((x - mean_x) * (y - mean_y) for x, y in points) / over if over else 0
    return mean_y - slope * mean_x, slope


def on_logarithms(points, x):
    """Interpolates on logarithmic axes, and extrapolates by the nearest two points."""
    points = sorted(points)
    if len(points) == 1:
        return points[0][1]
    after = next((i for i in range(1, len(points)) if points[i][0] >= x), len(points) - 1)
    (x0, y0), (x1, y1) = points[after - 1], points[after]
    share = math.log(x / x0) / math.log(x1 / x0)
    return math.exp(math.log(y0) + share * math.log(y1 / y0))


class Model:
    def __init__(self, report):
        self.runs = report["runs"]
        memory = self.of("memory")
        self.spheres = memory[0]["result"]["spheres"]
        self.memory_base, self.memory_of_sphere = line_through(
            [(self.spheres / run["ranks"], max(run["peak_bytes"])) for run in memory]
        )
        one = memory[0]
        self.setup_of_sphere_s = (one["seconds"] - one["result"]["render_ms"] / 1000) / self.spheres
        cloud = self.of("simulated", scene="cloud")[0]["result"]["simulated"]
        most = max(cloud, key=lambda one: one["ranks"])
        self.sent_of_sphere = most["sent_bytes_of_rank"]["mean"] / most["spheres_of_rank"]["mean"]

    def of(self, what, **marks):
        return [run for run in self.runs if run["what"] == what and all(run.get(key) == value for key, value in marks.items())]

    def memory(self, spheres, ranks):
        """Bytes of the largest rank."""
        return self.memory_base + self.memory_of_sphere * spheres / ranks

    def setup_s(self, spheres, ranks, gbit_per_s=10):
        """Until the picture begins."""
        of_rank = spheres / ranks
        return of_rank * self.setup_of_sphere_s + of_rank * self.sent_of_sphere * 8e-9 / gbit_per_s

    def simulated(self, scene, look, gbit_per_s=10):
        """(ranks, ms) of simulated ranks with this network."""
        runs = [run for run in self.of("simulated", scene=scene, look=look) if run["result"]["gbit_per_s"] == gbit_per_s]
        return [(one["ranks"], one["simulated_ms"]) for run in runs for one in run["result"]["simulated"]]

    def work(self, look, spheres_of_rank):
        """Milliseconds of a picture by one core, by the spheres of its tree."""
        points = [(run["result"]["spheres"], run["result"]["render_ms"]) for run in self.of("tree", look=look)]
        return on_logarithms(points, spheres_of_rank)

    def picture_ms(self, look, spheres, ranks):
        small = on_logarithms(self.simulated("cloud", look), ranks)
        return small * self.work(look, spheres / ranks) / self.work(look, self.spheres / ranks)

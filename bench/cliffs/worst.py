"""The worst sets of the part cliffs of scripts/bench, for each kind of rays."""

import statistics
import sys

SHOWN = 5
FLOOR, SHARE = 1.3, 0.25  # times Embree's speed; of the median of all sets
FEWEST = 4096  # rays: with fewer, calls and timers are measured


def cliffs(results):
    """Sets and kinds of rays below a floor: (kind, set, Mray/s, ratio to Embree or None, share of the median), by share."""
    found = []
    for kind in results[0]["mray_per_s"]:
        rates = {one["set"]: one["mray_per_s"][kind] for one in results if one["mray_per_s"].get(kind) and one["rays"][kind] >= FEWEST}
        median = statistics.median(rates.values()) if rates else 0
        for one in results:
            if one["set"] not in rates:
                continue
            ratio = (one["ratio"] or {}).get(kind)
            share = rates[one["set"]] / median
            found.append((kind, one["set"], rates[one["set"]], ratio, share))
    return sorted(found, key=lambda row: row[4])


def show(results, to=sys.stderr):
    """For each kind of rays the slowest sets, and those nearest to Embree's speed; an asterisk where a floor is missed."""
    rows = cliffs(results)
    for kind in dict.fromkeys(row[0] for row in rows):
        of_kind = [row for row in rows if row[0] == kind]
        by_ratio = sorted((row for row in of_kind if row[3] is not None), key=lambda row: row[3])
        for title, some in (("slowest", of_kind[:SHOWN]), ("beside Embree", by_ratio[:SHOWN])):
            print(f"{kind}, {title}:", file=to)
            for _, name, rate, ratio, share in some:
                mark = "*" if share < SHARE or (ratio is not None and ratio < FLOOR) else " "
                beside = "" if ratio is None else f"  {ratio:6.2f}x Embree"
                print(f"  {mark} {name:32} {rate:9.3f} Mray/s  {share:6.2f} of the median{beside}", file=to)
    builds = sorted(results, key=lambda one: -(one["build_ms"] or 0) / one["spheres"])[:SHOWN]
    print("build, slowest:", file=to)
    for one in builds:
        print(f"    {one['set']:32} {1e6 * (one['build_ms'] or 0) / one['spheres']:9.1f} ns per sphere, {one['bytes_per_sphere']:.1f} bytes", file=to)

#!/usr/bin/env python3
"""How rs-farm grows: measured with items that sleep, by 1, 2, 4, ... ranks on this machine, and what a model says of more.

    tests/bench/farm_growth.py [BIN] [--most-ranks 16]

A rank takes w + o for an item: the work, and what the farm adds to it (o is fitted, least squares). The coordinator takes m
for an item, whatever it is (from empty items), so that R ranks do min(R / (w + o), 1 / m) items a second. A run of N
items ends at last when the last ones do: with the largest first, by at most one item's time, of the largest left over
(R. Graham 1969); with equal items at ceil(N / R) (w + o).
"""
import argparse
import json
import math
import os
import statistics
import subprocess

ENVIRONMENT = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                   OMPI_MCA_rmaps_base_oversubscribe="1", OMPI_MCA_btl_vader_single_copy_mechanism="none")


def run(farm, ranks, items, sleep_ms):
    """Seconds of a run, from the first item to the last."""
    command = ["mpirun", "-n", str(ranks), farm, "bench", "--items", str(items), "--sleep", str(sleep_ms), "--json", "-q"]
    out = subprocess.run(command, env=ENVIRONMENT, check=True, capture_output=True, text=True).stdout
    return json.loads(out)["seconds"]


def median_of(runs, *arguments):
    return statistics.median(run(*arguments) for _ in range(runs))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin", nargs="?", default="build/release/bin")
    parser.add_argument("--most-ranks", type=int, default=16)
    parser.add_argument("--runs", type=int, default=3)
    given = parser.parse_args()
    farm = os.path.join(given.bin, "rs-farm")
    ranks = [r for r in (1, 2, 4, 8, 16, 32, 64) if r <= given.most_ranks]

    print("empty items: ranks, items a second")
    empty = {}
    for r in ranks[:3]:
        empty[r] = 5000 / median_of(given.runs, farm, r, 5000, 0)
        print(f"{r:6d} {empty[r]:8.0f}")
    coordinator_s = 1 / min(empty.values())

    print("sleeping items: ranks, milliseconds each, seconds, ratio to one rank, overhead of an item in ms")
    overheads = []
    for sleep_ms in (50, 200):
        one = None
        for r in ranks:
            rounds = max(4, 2000 // sleep_ms)
            seconds = median_of(given.runs, farm, r, rounds * r, sleep_ms)
            one = one or seconds
            overhead = seconds / rounds - sleep_ms / 1000
            overheads.append(overhead)
            print(f"{r:6d} {sleep_ms:6d} {seconds:8.3f} {r * one / seconds:8.2f} {1000 * overhead:8.2f}")
    overhead_s = statistics.fmean(overheads)  # the least-squares fit of a constant
    print(f"fitted: coordinator {1e6 * coordinator_s:.0f} us an item, overhead {1000 * overhead_s:.2f} ms an item")

    print("model: ranks, seconds of work an item, items a second, efficiency, most ranks before the coordinator is full")
    for work_s in (0.5, 5, 60):
        for r in (4, 64, 1024, 8192):
            rate = min(r / (work_s + overhead_s), 1 / coordinator_s)
            print(f"{r:6d} {work_s:6.1f} {rate:8.1f} {rate * work_s / r:8.3f} {work_s / coordinator_s:10.0f}")
    print("model: the end of a run of N items of 60 s, one in a hundred ten times as long; efficiency with the largest"
          " first, and in the worst order")
    for r in (64, 1024):
        for count in (1000, 10000):
            long_s, total_s = 600.0, count * 60 * 1.09
            best = max(total_s / r, long_s if count >= 100 else 0)
            if count / 100 < r:  # long ones begin together; the others fill up
                best = max(best, long_s)
            worst = total_s / r + long_s
            print(f"{r:6d} {count:6d} {total_s / r / best:6.2f} {total_s / r / worst:6.2f}"
                  f"  (of {math.ceil(best)} s)")


if __name__ == "__main__":
    main()

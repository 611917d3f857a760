"""Counts instructions an update under callgrind and holds them against the limits of instructions.csv.

    instructions.py PROBE LIMITS

The kernels run in their AVX2 build, since valgrind 3.19 knows no AVX-512.
"""
import csv
import os
import re
import subprocess
import sys

FEW, MANY = 20, 120


def count(probe, work, rounds):
    run = subprocess.run(
        ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", probe, work, str(rounds)],
        capture_output=True, text=True,
        env={**os.environ, "CDFP_ISA": "avx2"})
    collected = re.search(r"Collected\s*:\s*(\d+)", run.stderr)
    updates = re.search(r"updates a round: (\d+)", run.stdout)
    if run.returncode != 0 or not collected or not updates:
        sys.exit(f"{work}: callgrind failed\n{run.stdout}{run.stderr}")
    return int(collected.group(1)), int(updates.group(1))


def main():
    probe, limits = sys.argv[1:]
    slower = []
    with open(limits, newline="") as table:
        for row in csv.DictReader(table):
            few, updates = count(probe, row["work"], FEW)
            many, _ = count(probe, row["work"], MANY)
            per_update = (many - few) / (MANY - FEW) / updates
            print(f"{row['work']:22s} {per_update:9.1f} instructions an update, limit {row['limit']}", flush=True)
            if per_update > float(row["limit"]):
                slower.append(row["work"])
    if slower:
        sys.exit("slower than its limit: " + ", ".join(slower))


if __name__ == "__main__":
    main()

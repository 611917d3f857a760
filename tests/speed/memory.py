"""Guards against growth of memory: bytes an element of the laminated plate, peak of a whole run.

    memory.py CDFP CASE LIMIT

Two meshes, so that the program, its libraries and its pictures do not count.
"""
import os
import re
import subprocess
import sys
import tempfile


def peak_bytes(cdfp, case, columns, folder):
    changes = {"columns": columns, "layout": '"regular"', "end": "1e-6", "fixed_step": "0.0", "snapshot_times": "[]"}
    for name, value in changes.items():
        case, count = re.subn(rf"^{name} = .*$", f"{name} = {value}", case, flags=re.MULTILINE)
        assert count == 1, f"the case does not set {name}"
    path = f"{folder}/{columns}.toml"
    with open(path, "w") as file:
        file.write(case)
    arguments = [cdfp, "run", path, "--out", f"{folder}/{columns}", "--threads", "2"]
    run = subprocess.Popen(arguments, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(run.pid, 0)
    assert status == 0, f"the run of {columns} columns failed"
    return 1024 * usage.ru_maxrss


def main():
    cdfp, case_file, limit = sys.argv[1], sys.argv[2], float(sys.argv[3])
    with open(case_file) as file:
        case = file.read()
    small, large, layers = 20, 52, 10
    with tempfile.TemporaryDirectory() as folder:
        growth = peak_bytes(cdfp, case, large, folder) - peak_bytes(cdfp, case, small, folder)
    bytes_an_element = growth / (layers * (large**2 - small**2))
    print(f"{bytes_an_element:.0f} B an element, limit {limit:.0f}")
    return bytes_an_element > limit


sys.exit(main())

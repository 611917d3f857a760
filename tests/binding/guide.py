#!/usr/bin/env python3
"""Compiles and runs every program of fortran_api/guide.md and compares what it prints with the text that follows it.

    guide.py GUIDE FOLDER FORTRAN_COMPILER FLAGS...
"""
import pathlib
import re
import subprocess
import sys


def main():
    guide, folder, compiler, *flags = sys.argv[1:]
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    text = pathlib.Path(guide).read_text()
    programs = re.findall(r"```fortran\n(.*?)```\n\s*```text\n(.*?)```", text, flags=re.S)
    if len(programs) < 5 or len(programs) != text.count("```fortran"):
        print(f"{len(programs)} programs with their output, of {text.count('```fortran')}")
        return 1
    faults = 0
    for program, wanted in programs:
        name = re.search(r"^program (\w+)", program, flags=re.M).group(1)
        source = folder / f"{name}.f90"
        source.write_text(program)
        subprocess.run([compiler, "-std=f2018", "-Wall", "-Werror", "-g", "-fcheck=all", f"-J{folder}", str(source),
                        "-o", str(folder / name), *flags], check=True)
        ran = subprocess.run([str(folder / name)], capture_output=True, text=True, timeout=60)
        if ran.returncode != 0 or ran.stdout != wanted:
            faults += 1
            print(f"{name}: status {ran.returncode}\n{ran.stderr}prints\n{ran.stdout}instead of\n{wanted}")
    print(f"{len(programs) - faults} of {len(programs)} programs print what the guide says")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())

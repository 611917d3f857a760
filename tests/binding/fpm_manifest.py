#!/usr/bin/env python3
"""Reads the fpm manifest and holds it against the module sources: their folder, one module a file, no use of anything
that is neither theirs nor intrinsic, and the library's version.

    fpm_manifest.py MANIFEST VERSION SOURCES...
"""
import pathlib
import re
import sys
import tomllib


def main():
    path, version, *sources = sys.argv[1:]
    manifest = tomllib.loads(pathlib.Path(path).read_text())
    faults = []
    if manifest["name"] != "cdfp" or manifest["version"] != version:
        faults.append(f"name and version are {manifest['name']} {manifest['version']}, not cdfp {version}")
    if manifest["build"]["link"] != ["cdfp"]:
        faults.append("the manifest does not link cdfp")
    folder = (pathlib.Path(path).parent / manifest["library"]["source-dir"]).resolve()
    names = {pathlib.Path(s).stem for s in sources}
    if {p.stem for p in folder.glob("*.f90")} != names:
        faults.append(f"{folder} holds other sources than the library is made of")
    for source in sources:
        text = pathlib.Path(source).read_text()
        if re.findall(r"^module (\w+)", text, flags=re.M) != [pathlib.Path(source).stem]:
            faults.append(f"{source} is not one module of its name")
        faults += [f"{source} uses {used}" for used in re.findall(r"^ *use (\w+)", text, flags=re.M) if used not in names]
    print("\n".join(faults) or f"{len(names)} modules")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())

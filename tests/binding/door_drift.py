#!/usr/bin/env python3
"""Holds the modules fortran_api/cdfp_c*.f90 against the headers include/cdfp/c/*.h: functions, arguments by name, order, kind,
`const` and `value`, structs by member, constants; and every function against the symbols of the library.

    door_drift.py HEADERS FORTRAN_COMPILER NM LIBRARY INTERFACES...
"""
import pathlib
import re
import subprocess
import sys
import tempfile

NUMBERS = {"int": "int32_t", "long": "int64_t", "long int": "int64_t", "long long": "int64_t"}


def declarations(text):
    """Structs and functions of C text: {name: [(type, name), ...]}."""
    text = re.sub(r"/\*.*?\*/|//[^\n]*", " ", text, flags=re.S)
    text = re.sub(r"int \(\*(\w+)\)\(\)", r"void \1", text)  # how the compiler writes a c_funptr
    structs = {}
    for name, body in re.findall(r"typedef struct (\w+) \{(.*?)\}", text, flags=re.S):
        structs[name] = [member(m) for m in body.split(";") if m.strip()]
    functions = {}
    for result, name, arguments in re.findall(r"\b(int|int32_t) (cdfp_\w+) ?\((.*?)\);", text, flags=re.S):
        functions[name] = [(NUMBERS.get(result, result), "status")] + [member(a) for a in arguments.split(",")]
    return structs, functions


def member(text):
    """One declaration as (type, name), numbers by their width and arrays with their length."""
    kind, name, length = re.fullmatch(r"(.*?)(\w+)(\[\d+\])?", " ".join(text.split())).groups()
    stars = kind.count("*")
    const = kind.lstrip().startswith("const ")
    word = kind.replace("*", " ").replace("const ", " ").strip()
    word = NUMBERS.get(word, word)
    return (("const " if const else "") + word + "*" * stars + (length or ""), name)


def as_fortran_sees_it(kind, structs):
    """Handles and views are c_ptr in Fortran: one star by value, two by reference; callbacks are c_funptr."""
    bare = kind.replace("const ", "").replace("*", "")
    opaque = bare == "void" or (bare.startswith("cdfp_") and bare not in structs)
    if opaque or kind.count("*") == 2:
        return "void" + "*" * kind.count("*")
    return kind


def pointers_by_reference(source):
    """(function, argument) of every c_ptr that is passed by reference. The compiler's prototypes do not tell."""
    source = re.sub(r"&\s*\n\s*", "", source)
    found = set()
    for name, body in re.findall(r"\bfunction (cdfp_\w+)\(.*?\n(.*?)end function", source, flags=re.S):
        for attributes, arguments in re.findall(r"type\(c_ptr\)(.*?)::(.*)", body):
            if "value" not in attributes:
                found |= {(name, a.strip()) for a in arguments.split(",")}
    return found


def constants(text, pattern):
    return {name: int(value) for name, value in re.findall(pattern, text)}


def differences(header, source, compiler):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "cdfp_c.f90"
        path.write_text(source)
        made = subprocess.run([compiler, "-fc-prototypes", "-fsyntax-only", "-std=f2018", path.name], cwd=folder,
                              capture_output=True, text=True)
    if made.returncode != 0:
        return ["the interfaces do not compile: " + made.stderr]
    structs, functions = declarations(header)
    fortran_structs, fortran_functions = declarations(made.stdout)
    by_reference = pointers_by_reference(source)
    faults = []

    for name in sorted(structs.keys() | fortran_structs.keys()):
        views = [("void*" if "*" in kind else kind, member) for kind, member in structs.get(name, [])]
        if views != fortran_structs.get(name):
            faults.append(f"struct {name}: C {structs.get(name)}, Fortran {fortran_structs.get(name)}")
    for name in sorted(functions.keys() | fortran_functions.keys()):
        if name not in functions or name not in fortran_functions:
            faults.append(f"{name} is only in " + ("C" if name in functions else "Fortran"))
            continue
        wanted = [(as_fortran_sees_it(kind, structs), a) for kind, a in functions[name]]
        given = [("void**" if (name, a) in by_reference else kind, a) for kind, a in fortran_functions[name]]
        if wanted != given:
            faults.append(f"{name}:\n    C       {wanted}\n    Fortran {given}")
    c = constants(header, r"\b(CDFP_[A-Z_]+) = (\d+)")
    f = constants(source, r"\b(CDFP_[A-Z_]+) = (\d+)")
    if c != f:
        faults.append(f"constants: {sorted(c.items() ^ f.items())}")
    if len(functions) < 50 or len(structs) < 5 or len(c) < 20:
        faults.append(f"only {len(functions)} functions, {len(structs)} structs, {len(c)} constants were found")
    return faults


# Each must be noticed: what the drift may look like.
DRIFT = [
    ("argument renamed", "density, youngs_modulus", "rho, youngs_modulus"),
    ("order of arguments", "cdfp_simulation_advance(simulation, steps, done)",
     "cdfp_simulation_advance(simulation, done, steps)"),
    ("kind of a number", "integer(c_int64_t), value :: steps", "integer(c_int32_t), value :: steps"),
    ("number by reference", "real(c_double), value :: end", "real(c_double) :: end"),
    ("handle by reference", "type(c_ptr), value :: model\n      character(kind=c_char), intent(in) :: title(*)",
     "type(c_ptr) :: model\n      character(kind=c_char), intent(in) :: title(*)"),
    ("handle by value", "type(c_ptr), intent(inout) :: model", "type(c_ptr), value :: model"),
    ("intent", "real(c_double), intent(in) :: gravity(3)", "real(c_double), intent(inout) :: gravity(3)"),
    ("member of a struct", "real(c_double) :: position(3), velocity(3),", "real(c_double) :: velocity(3), position(3),"),
    ("function missing", "cdfp_simulation_masses", "cdfp_simulation_weights"),
    ("constant", "CDFP_IO = 6", "CDFP_IO = 7"),
]


def main():
    folder, compiler, nm, library, *source_paths = sys.argv[1:]
    paths = [*sorted(pathlib.Path(folder, "c").glob("*.h")), pathlib.Path(folder, "material.h")]
    header = "".join(path.read_text() for path in paths)
    source = "".join(pathlib.Path(path).read_text() for path in source_paths)
    faults = differences(header, source, compiler)

    for what, old, new in DRIFT:
        if old not in source:
            faults.append(f"the example of drift '{what}' is out of date")
        elif not differences(header, source.replace(old, new), compiler):
            faults.append(f"drift is not noticed: {what}")

    listing = subprocess.run([nm, "-g", "--defined-only", library], capture_output=True, text=True, check=True)
    symbols = {line.split()[-1] for line in listing.stdout.splitlines() if " T " in line}
    wanted = set(declarations(header)[1])
    faults += [f"{name} is not in the library" for name in sorted(wanted - symbols)]
    faults += [f"{name} is in the library but in no header"
               for name in sorted(symbols - wanted) if name.startswith("cdfp_")]

    print("\n".join(faults) or f"{len(wanted)} functions agree")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())

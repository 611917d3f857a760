"""Prints every array that VTK finds in the given files: "FILE:NAME COUNT" and the values, a line each.
Ends with 77 where VTK is not installed."""

import sys

try:
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
except ImportError:
    sys.exit(77)


def show(name, values):
    print(name, len(values))
    print("\n".join(repr(value) for value in values))


def flat(array):
    width = array.GetNumberOfComponents()
    return [array.GetComponent(i, j) for i in range(array.GetNumberOfTuples()) for j in range(width)]


for number, path in enumerate(sys.argv[1:]):
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    if reader.GetErrorCode():
        sys.exit(1)
    grid = reader.GetOutput()
    show(f"{number}:points", flat(grid.GetPoints().GetData()))
    cells = range(grid.GetNumberOfCells())
    show(f"{number}:cell_types", [grid.GetCellType(i) for i in cells])
    show(f"{number}:corners", [grid.GetCell(i).GetPointId(k) for i in cells
                               for k in range(grid.GetCell(i).GetNumberOfPoints())])
    for data in (grid.GetPointData(), grid.GetCellData(), grid.GetFieldData()):
        for i in range(data.GetNumberOfArrays()):
            show(f"{number}:{data.GetArrayName(i)}", flat(data.GetArray(i)))

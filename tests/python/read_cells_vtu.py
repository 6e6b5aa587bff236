"""Reads the cells of a tessellation with VTK and compares them with what was written.

Usage: read_cells_vtu.py FILE DIMENSION INCLUSIONS MEASURE_OF_BOX
"""
import math
import sys

try:
    import numpy as np
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonDataModel import VTK_POLYGON, VTK_POLYHEDRON
    from vtkmodules.vtkFiltersCore import vtkFeatureEdges, vtkMassProperties, vtkTriangleFilter
    from vtkmodules.vtkFiltersExtraction import vtkExtractCells
    from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter
    from vtkmodules.vtkCommonCore import vtkIdList
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
except ImportError:
    sys.exit(77)

path = sys.argv[1]
dimension, inclusions = int(sys.argv[2]), int(sys.argv[3])
box = float(sys.argv[4])

reader = vtkXMLUnstructuredGridReader()
reader.SetFileName(path)
reader.Update()
grid = reader.GetOutput()
cells = grid.GetNumberOfCells()
kind = VTK_POLYGON if dimension == 2 else VTK_POLYHEDRON
assert all(grid.GetCellType(i) == kind for i in range(cells))

data = grid.GetCellData()
names = {data.GetArrayName(i) for i in range(data.GetNumberOfArrays())}
assert names == {"inclusion", "group", "part", "part_measure", "measure", "ordered_measure", "aspect",
                 "neighbors", "semi_axes", "axis"}, names
values = {name: vtk_to_numpy(data.GetArray(name)) for name in names}
assert set(values["inclusion"]) == set(range(inclusions))
whole = {i: (m, o) for i, m, o in
         zip(values["inclusion"], values["measure"], values["ordered_measure"])}
assert math.isclose(sum(m for m, _ in whole.values()), box, rel_tol=1e-9)
assert math.isclose(sum(o for _, o in whole.values()), box, rel_tol=1e-9)
parts = np.bincount(values["inclusion"], values["part_measure"])
for i, (measure, _) in whole.items():
    assert math.isclose(parts[i], measure, rel_tol=1e-9)

points = vtk_to_numpy(grid.GetPoints().GetData())


def polygon_area(corners):
    x, y = corners[:, 0], corners[:, 1]
    return 0.5 * (x * np.roll(y, -1) - np.roll(x, -1) * y).sum()


def polygons_of(cell):
    ids = vtkIdList()
    grid.GetFaceStream(cell, ids)
    stream = [ids.GetId(i) for i in range(ids.GetNumberOfIds())]
    polygons, at = [], 1
    for _ in range(stream[0]):
        count = stream[at]
        polygons.append(stream[at + 1:at + 1 + count])
        at += 1 + count
    return polygons


def check_polyhedron(cell):
    polygons = polygons_of(cell)
    directed = [(a, b) for p in polygons for a, b in zip(p, p[1:] + p[:1])]
    assert sorted(directed) == sorted((b, a) for a, b in directed), "an open face"
    volume = 0.0
    origin = points[polygons[0][0]]
    for p in polygons:
        c = points[p] - origin
        volume += sum(np.dot(c[0], np.cross(c[k - 1], c[k])) for k in range(2, len(p))) / 6
    assert math.isclose(volume, values["part_measure"][cell], rel_tol=1e-8)


def check_by_vtk(cell):
    ids = vtkIdList()
    ids.InsertNextId(cell)
    one = vtkExtractCells()
    one.SetInputData(grid)
    one.SetCellList(ids)
    surface = vtkGeometryFilter()
    surface.SetInputConnection(one.GetOutputPort())
    edges = vtkFeatureEdges()
    edges.SetInputConnection(surface.GetOutputPort())
    edges.FeatureEdgesOff()
    edges.ManifoldEdgesOff()
    edges.NonManifoldEdgesOff()
    edges.Update()
    assert edges.GetOutput().GetNumberOfCells() == 0, "VTK finds an open edge"
    triangles = vtkTriangleFilter()
    triangles.SetInputConnection(surface.GetOutputPort())
    mass = vtkMassProperties()
    mass.SetInputConnection(triangles.GetOutputPort())
    mass.Update()
    assert math.isclose(mass.GetVolume(), values["part_measure"][cell], rel_tol=1e-6)


for cell in range(cells):
    if dimension == 2:
        corners = vtk_to_numpy(grid.GetCell(cell).GetPoints().GetData())
        assert math.isclose(polygon_area(corners), values["part_measure"][cell], rel_tol=1e-8)
    else:
        check_polyhedron(cell)
        if cell < 20:
            check_by_vtk(cell)

"""Reads a .vtu export with VTK and compares it with what was written.

Usage: read_vtu.py FILE DIMENSION POINTS CELLS INCLUSIONS VOLUME
"""
import math
import sys

try:
    import numpy as np
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonDataModel import VTK_POLYGON, VTK_TRIANGLE
    from vtkmodules.vtkFiltersCore import vtkCleanPolyData, vtkFeatureEdges, vtkMassProperties
    from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
except ImportError:
    sys.exit(77)

path = sys.argv[1]
dimension, points, cells, inclusions = (int(text) for text in sys.argv[2:6])
volume = float(sys.argv[6])

reader = vtkXMLUnstructuredGridReader()
reader.SetFileName(path)
reader.Update()
grid = reader.GetOutput()
assert grid.GetNumberOfPoints() == points, grid.GetNumberOfPoints()
assert grid.GetNumberOfCells() == cells, grid.GetNumberOfCells()
kind = VTK_TRIANGLE if dimension == 3 else VTK_POLYGON
assert all(grid.GetCellType(i) == kind for i in range(cells))

data = grid.GetCellData()
names = {data.GetArrayName(i) for i in range(data.GetNumberOfArrays())}
assert names == {"inclusion", "group", "shape", "image", "volume", "semi_axes", "axis"}, names
inclusion = vtk_to_numpy(data.GetArray("inclusion"))
image = vtk_to_numpy(data.GetArray("image"))
assert set(inclusion) == set(range(inclusions))
bodies = {(i, *shift): v for i, shift, v in
          zip(inclusion, image.tolist(), vtk_to_numpy(data.GetArray("volume")))}
assert math.isclose(sum(bodies.values()), volume, rel_tol=1e-12)

surface = vtkGeometryFilter()
surface.SetInputData(grid)
surface.Update()
if dimension == 3:
    normals = vtk_to_numpy(grid.GetPointData().GetArray("normal"))
    assert abs((normals ** 2).sum(axis=1) - 1).max() < 1e-9
    clean = vtkCleanPolyData()  # the rims of a cylinder stand twice
    clean.SetInputConnection(surface.GetOutputPort())
    clean.SetTolerance(0.0)
    edges = vtkFeatureEdges()
    edges.SetInputConnection(clean.GetOutputPort())
    edges.FeatureEdgesOff()
    edges.ManifoldEdgesOff()
    edges.Update()
    assert edges.GetOutput().GetNumberOfCells() == 0, "the surface is not closed"
    mass = vtkMassProperties()
    mass.SetInputConnection(surface.GetOutputPort())
    mass.Update()
    assert 0.95 * volume < mass.GetVolume() < volume, (mass.GetVolume(), volume)
else:
    area = 0.0
    for i in range(cells):
        corners = vtk_to_numpy(grid.GetCell(i).GetPoints().GetData())
        x, y = corners[:, 0], corners[:, 1]
        area += 0.5 * (x * np.roll(y, -1) - np.roll(x, -1) * y).sum()
    assert 0.99 * volume < area < volume, (area, volume)

#!/usr/bin/python3
# SPDX-FileCopyrightText: The scarp developers
# SPDX-License-Identifier: GPL-3.0-or-later
"""Opens every frame of an output folder the way other programs do: with VTK's reader and with h5py.

Usage: /usr/bin/python3 frames_test.py FOLDER

FOLDER is an output folder (frames.hdf.series beside frames/) or the folder of the frames itself. Exit status 1
and a sentence on standard error when something is wrong.
"""
import json
import pathlib
import sys

import h5py
import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOHDF import vtkHDFReader


class Wrong(Exception):
    """What is wrong with a file, as a sentence."""


def need(condition, sentence):
    if not condition:
        raise Wrong(sentence)


def check_with_h5py(path):
    """Returns the points, the fields by name and the time."""
    with h5py.File(path, "r") as file:
        for name, shape in (("time", ()), ("step", ()), ("origin", (3,)), ("crs", ())):
            need(name in file, f"{path}: has no {name}")
            need(file[name].shape == shape, f"{path}: {name} has the shape {file[name].shape}, not {shape}")
        time = float(file["time"][()])
        need(numpy.isfinite(time), f"{path}: its time is {time}")
        need(numpy.isfinite(file["origin"][()]).all(), f"{path}: its origin is not finite")
        points = file["VTKHDF/Points"][()]
        need(points.dtype == numpy.float64, f"{path}: Points are {points.dtype}, not float64")
        shape_is_right = points.ndim == 2 and points.shape[1] == 3 and len(points) > 0
        need(shape_is_right, f"{path}: Points have the shape {points.shape}")
        need(numpy.isfinite(points).all(), f"{path}: a point is not finite")
        fields = {}
        for name, data in file["VTKHDF/PointData"].items():
            need("unit" in data.attrs, f"{path}: {name} has no unit")
            values = data[()]
            need(len(values) == len(points), f"{path}: {name} has {len(values)} rows for {len(points)} points")
            need(numpy.isfinite(values).all(), f"{path}: a value of {name} is not finite")
            fields[name] = values
    return points, fields, time


def check_with_vtk(path, points, fields):
    reader = vtkHDFReader()
    need(reader.CanReadFile(str(path)), f"{path}: VTK does not take it for a VTKHDF file")
    reader.SetFileName(str(path))
    reader.Update()
    grid = reader.GetOutput()
    count = len(points)
    need(grid.GetNumberOfPoints() == count, f"{path}: VTK reads {grid.GetNumberOfPoints()} points, h5py {count}")
    need(grid.GetNumberOfCells() == count, f"{path}: VTK reads {grid.GetNumberOfCells()} cells for {count} points")
    need((vtk_to_numpy(grid.GetPoints().GetData()) == points).all(), f"{path}: VTK reads other points than h5py")
    data = grid.GetPointData()
    names = {data.GetArrayName(i) for i in range(data.GetNumberOfArrays())}
    need(names == set(fields), f"{path}: VTK reads the arrays {sorted(names)}, h5py {sorted(fields)}")
    for name, values in fields.items():
        array = vtk_to_numpy(data.GetArray(name))
        need(array.shape == values.shape, f"{path}: VTK reads {name} as {array.shape}, h5py as {values.shape}")
        need((array == values).all(), f"{path}: VTK reads other values of {name} than h5py")


def check_series(path, times):
    """`times` by frame; the series must name each of them once, in the order of time."""
    series = json.loads(path.read_text(encoding="utf-8"))
    need(series.get("file-series-version") == "1.0", f"{path}: is not a series of version 1.0")
    named = {}
    for entry in series["files"]:
        frame = (path.parent / entry["name"]).resolve()
        need(frame in times, f"{path}: names {entry['name']}, which is not there")
        need(frame not in named, f"{path}: names {entry['name']} twice")
        need(entry["time"] == times[frame],
             f"{path}: says {entry['time']} for {entry['name']}, which says {times[frame]}")
        named[frame] = entry["time"]
    need(len(named) == len(times), f"{path}: names {len(named)} of {len(times)} frames")
    need(list(named.values()) == sorted(named.values()), f"{path}: its times do not rise")


def main(arguments):
    if len(arguments) != 1:
        raise Wrong("give the folder that holds the frames")
    folder = pathlib.Path(arguments[0]).resolve()
    frames_folder = folder / "frames" if (folder / "frames").is_dir() else folder
    frames = sorted(frames_folder.glob("*.hdf"))
    need(frames, f"{frames_folder}: holds no frame (*.hdf)")
    times, layouts = {}, {}
    for path in frames:
        try:
            points, fields, times[path] = check_with_h5py(path)
        except (OSError, KeyError) as error:
            raise Wrong(f"{path}: h5py cannot read it: {error}") from error
        check_with_vtk(path, points, fields)
        layouts[path] = {name: (str(values.dtype), values.shape[1:]) for name, values in fields.items()}
        need(layouts[path] == layouts[frames[0]], f"{path}: has other arrays than {frames[0].name}")
    series = [p for p in (folder / "frames.hdf.series", folder.parent / "frames.hdf.series") if p.is_file()]
    need(series, f"{folder}: has no frames.hdf.series")
    check_series(series[0], times)
    print(f"{len(frames)} frames, {len(layouts[frames[0]])} arrays: as VTK and h5py read them, all is well")


if __name__ == "__main__":
    try:
        main(sys.argv[1:])
    except Wrong as wrong:
        print(f"frames_test: {wrong}", file=sys.stderr)
        sys.exit(1)

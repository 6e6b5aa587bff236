"""Compares an HDF5 packing file, read with h5py, with the JSON file of the same packing, bit by bit.

Usage: compare_h5.py FILE.h5 FILE.json
"""
import json
import math
import sys

try:
    import h5py
    import numpy as np
except ImportError:
    sys.exit(77)

with open(sys.argv[2], encoding="utf-8") as text:
    expected = json.load(text)

with h5py.File(sys.argv[1], "r") as file:
    assert file.attrs["format"].decode() == expected["format"] == "packstone-packing"
    assert file.attrs["version"] == expected["version"] == 1
    assert file["cell/size"][()].tolist() == expected["cell"]["size"]
    assert file["cell/periodic"].dtype == bool
    assert file["cell/periodic"][()].tolist() == expected["cell"]["periodic"]
    groups = [name.decode() for name in file["groups"][()]]
    assert groups == expected["groups"]

    columns = {name: file["inclusions"][name][()] for name in file["inclusions"]}
    shapes = {code: word for word, code in
              h5py.check_enum_dtype(file["inclusions/shape"].dtype).items()}
    for i, inclusion in enumerate(expected["inclusions"]):
        assert groups[columns["group"][i]] == inclusion.pop("group")
        assert shapes[columns["shape"][i]] == inclusion.pop("shape")
        for name in columns.keys() - {"group", "shape"}:
            found = columns[name][i].tolist()
            if name in inclusion:
                assert found == inclusion[name], (i, name)
            else:
                assert np.isnan(found).all(), (i, name)
        assert inclusion.keys() <= columns.keys()

    for name, value in expected["certificate"].items():
        if name == "groups":
            census = file["certificate/groups"]
            rows = zip(census["name"][()], census["count"][()], census["fraction"][()])
            assert [{"name": n.decode(), "count": c, "fraction": f} for n, c, f in rows] == value
            continue
        found = file["certificate"][name][()].tolist()
        assert found == (math.inf if value is None else value), name
    for name, value in expected["provenance"].items():
        found = file["provenance"][name][()]
        if name == "recipe":
            assert json.loads(found) == value
        else:
            assert (found.decode() if isinstance(found, bytes) else found) == value, name

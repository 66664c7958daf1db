"""Reads a.vtp, a.swc and the other files of a folder and compares them with a.skel. Run by readers.py."""
import collections
import json
import math
import pathlib
import struct
import sys

import networkx
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOGeometry import vtkOBJReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

folder = pathlib.Path(sys.argv[1])


def read_skel():
    lines = (folder / "a.skel").read_text().splitlines()[2:]
    nodes, edges = [], set()
    for line in lines:
        words = line.split()
        nodes.append([float(w) for w in words[1:5]])
        edges |= {tuple(sorted((int(words[0]), int(w)))) for w in words[6:]}
    return np.array(nodes), edges


def check_vtp(nodes, edges, degree):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(folder / "a.vtp"))
    reader.Update()
    data = reader.GetOutput()
    points, cells = data.GetPointData(), data.GetCellData()
    array = lambda of, name: vtk_to_numpy(of.GetArray(name))
    assert np.array_equal(vtk_to_numpy(data.GetPoints().GetData()), nodes[:, :3])
    for name in ("MaximumInscribedSphereRadius", "Radius"):
        assert np.array_equal(array(points, name), nodes[:, 3])
    lines = []
    for i in range(data.GetNumberOfCells()):
        ids = data.GetCell(i).GetPointIds()
        lines.append([ids.GetId(k) for k in range(ids.GetNumberOfIds())])
    assert {tuple(sorted(e)) for line in lines for e in zip(line, line[1:])} == edges
    assert sum(len(line) - 1 for line in lines) == len(edges)
    abscissas = array(points, "Abscissas")
    root = int(np.argmin(abscissas))
    assert abscissas[root] == 0 and nodes[root, 3] == nodes[:, 3].max()
    assert all(abscissas[line[0]] <= abscissas[line[-1]] for line in lines)
    place = nodes[:, :3]
    lengths = [sum(np.linalg.norm(place[a] - place[b]) for a, b in zip(line, line[1:])) for line in lines]
    assert np.allclose(array(cells, "Length"), lengths)
    for line, tortuosity, length in zip(lines, array(cells, "Tortuosity"), lengths):
        chord = np.linalg.norm(place[line[0]] - place[line[-1]])
        assert chord == 0 or math.isclose(tortuosity, length / chord - 1, abs_tol=1e-9)
    tangent, normal, binormal = (array(points, f"Frenet{n}") for n in ("Tangent", "Normal", "Binormal"))
    for a, b in ((tangent, normal), (tangent, binormal), (tangent, array(points, "ParallelTransportNormals"))):
        assert np.abs((a * b).sum(1)).max() < 1e-6
    assert (array(points, "Curvature") >= 0).all() and np.isfinite(array(points, "Torsion")).all()
    assert np.array_equal(array(points, "Marks"), (degree > 2).astype(int))
    assert sorted(array(cells, "GroupIds")) == list(range(len(lines)))
    assert set(array(cells, "Blanking")) <= {0, 1}
    # Every way from the root to a tip begins with tract 0 of its own or of an earlier way.
    assert 0 in array(cells, "TractIds") and len(array(cells, "CenterlineIds")) == len(lines)
    for line, ends in zip(lines, array(cells, "Topology")):
        assert list(ends) == [v if degree[v] > 2 else -1 for v in (line[0], line[-1])]


def check_swc(nodes, edges, degree):
    cut, rows = [], []
    for line in (folder / "a.swc").read_text().splitlines():
        words = line.split()
        if words[:3] == ["#", "cut", "edge"]:
            cut.append((int(words[3]), int(words[4])))
        if not line.startswith("#"):
            assert len(words) == 7
            rows.append((int(words[0]), int(words[1]), tuple(map(float, words[2:5])), float(words[5]), int(words[6])))
    assert [row[0] for row in rows] == list(range(1, len(rows) + 1))
    assert all(row[4] == -1 or 1 <= row[4] < row[0] for row in rows)
    node_at = {tuple(p[:3]): v for v, p in enumerate(nodes)}
    node = {row[0]: node_at[row[2]] for row in rows}
    assert all(nodes[node[row[0]], 3] == row[3] for row in rows)
    tree = {tuple(sorted((node[row[0]], node[row[4]]))) for row in rows if row[4] != -1}
    cuts = {tuple(sorted((node[a], node[b]))) for a, b in cut}
    assert tree | cuts == edges and len(tree) + len(cuts) == len(edges)
    ways = collections.Counter(v for e in tree for v in e)
    for number, kind, _, radius, parent in rows:
        if parent == -1:
            assert radius == nodes[:, 3].max()
        assert kind == (5 if ways[node[number]] > 2 else 6 if ways[node[number]] == 1 else 0) or (parent == -1 and kind == 1)


def check_networkx(nodes, edges):
    for graph in (networkx.read_graphml(folder / "a.graphml", node_type=int),
                  networkx.node_link_graph(json.loads((folder / "a.json").read_text()), edges="edges")):
        assert {tuple(sorted(e)) for e in graph.edges} == edges
        for v, facts in graph.nodes(data=True):
            place = facts.get("position") or [facts[k] for k in "xyz"]
            assert np.array_equal([*place, facts["radius"]], nodes[v])


def check_obj(nodes, edges):
    """Which has no radius."""
    reader = vtkOBJReader()
    reader.SetFileName(str(folder / "a.obj"))
    reader.Update()
    data = reader.GetOutput()
    assert np.allclose(vtk_to_numpy(data.GetPoints().GetData()), nodes[:, :3], rtol=1e-6)  # VTK keeps them as floats
    lines = vtk_to_numpy(data.GetLines().GetConnectivityArray()).reshape(-1, 2).tolist()
    assert {tuple(sorted(line)) for line in lines} == edges and len(lines) == len(edges)


def check_glb(nodes, edges):
    """By the letter of glTF 2.0: a header, a chunk of JSON, a chunk of bytes."""
    data = (folder / "a.glb").read_bytes()
    magic, version, length, size, kind = struct.unpack("<4sII I4s", data[:20])
    assert (magic, version, length, kind) == (b"glTF", 2, len(data), b"JSON")
    scene, binary = json.loads(data[20 : 20 + size]), data[28 + size :]
    types, widths = {5125: np.uint32, 5126: np.float32, 5123: np.uint16}, {"SCALAR": 1, "VEC3": 3}

    def array(index):
        accessor = scene["accessors"][index]
        begin = scene["bufferViews"][accessor["bufferView"]].get("byteOffset", 0) + accessor.get("byteOffset", 0)
        width = widths[accessor["type"]]
        return np.frombuffer(binary, types[accessor["componentType"]], accessor["count"] * width, begin).reshape(-1, width)

    node = next(node for node in scene["nodes"] if scene["meshes"][node.get("mesh", 0)]["name"] == "skeleton")
    (lines,) = scene["meshes"][node["mesh"]]["primitives"]
    assert lines["mode"] == 1
    assert np.array_equal(array(lines["attributes"]["POSITION"]) + np.float32(node.get("translation", [0, 0, 0])), np.float32(nodes[:, :3]))
    assert np.array_equal(array(lines["attributes"]["_RADIUS"])[:, 0], np.float32(nodes[:, 3]))
    assert {tuple(sorted(e)) for e in array(lines["indices"]).reshape(-1, 2).tolist()} == edges


def check_polylines(name, nodes, edges):
    """Which have no radius: a line each, the number of points first."""
    node_at, read = {tuple(p[:3]): v for v, p in enumerate(nodes)}, []
    for line in (folder / name).read_text().splitlines():
        words = line.split()
        assert len(words) == 1 + 3 * int(words[0])
        way = [node_at[tuple(map(float, words[i : i + 3]))] for i in range(1, len(words), 3)]
        read += [tuple(sorted(e)) for e in zip(way, way[1:])]
    assert set(read) == edges and len(read) == len(edges)


nodes, edges = read_skel()
counted = collections.Counter(v for e in edges for v in e)
degree = np.array([counted[v] for v in range(len(nodes))])
check_vtp(nodes, edges, degree)
check_swc(nodes, edges, degree)
check_networkx(nodes, edges)
check_obj(nodes, edges)
check_glb(nodes, edges)
for name in ("a.cgal", "a.polylines.txt"):
    check_polylines(name, nodes, edges)

"""One call from a mesh to a skeleton: input, options, errors, progress, threads."""

import signal
import subprocess
import sys
import threading
import time
import types

import numpy as np
import pytest

import mspskel


def same(a, b):
    return np.array_equal(a.vertices, b.vertices) and np.array_equal(a.edges, b.edges)


def test_first_example_of_the_docs(tmp_path):
    skeleton = mspskel.skeletonize(mspskel.sample("quadruped"))
    skeleton.to(tmp_path / "quadruped.swc")
    assert (tmp_path / "quadruped.swc").read_text().startswith("# index type x y z radius parent")
    assert skeleton.certificate["topology"] == "proved"


def test_shapes_of_the_result(animal, quadruped):
    count = len(animal)
    assert animal.vertices.shape == (count, 3) and animal.vertices.dtype == np.float64
    assert animal.radius.shape == (count,) and (animal.radius > 0).all()
    assert animal.edges.shape == (count - 1, 2)
    assert animal.mesh_map.shape == (len(quadruped[0]),)
    assert set(animal.mesh_map) <= set(range(count))


@pytest.mark.parametrize("vertex_type", [np.float32, np.float64, list])
@pytest.mark.parametrize("face_type", [np.int32, np.uint32, np.int64, list])
def test_arrays_of_any_kind(vertex_type, face_type):
    vertices, faces = mspskel.sample("torus", resolution=100)
    vertices = vertices.astype(np.float32).astype(float)
    expected = mspskel.skeletonize((vertices, faces))
    given = vertices.tolist() if vertex_type is list else vertices.astype(vertex_type)
    corners = faces.tolist() if face_type is list else faces.astype(face_type)
    assert same(mspskel.skeletonize((given, corners)), expected)


def test_arrays_in_any_layout(torus, ring):
    vertices, faces = torus
    assert same(mspskel.skeletonize((np.asfortranarray(vertices), np.asfortranarray(faces))), ring)
    assert same(mspskel.skeletonize((np.repeat(vertices, 2, axis=1)[:, ::2], faces.ravel())), ring)


def test_objects_of_other_packages(torus, ring):
    vertices, faces = torus
    trimesh_like = types.SimpleNamespace(vertices=vertices, faces=faces)
    open3d_like = types.SimpleNamespace(vertices=vertices, triangles=faces)
    block = types.SimpleNamespace(type="triangle", data=faces)
    meshio_like = types.SimpleNamespace(points=vertices, cells=[types.SimpleNamespace(type="line", data=[[0, 1]]), block])
    for mesh in (trimesh_like, open3d_like, meshio_like):
        assert same(mspskel.skeletonize(mesh), ring)


def test_paths(tmp_path, torus, ring):
    lines = ["OFF", f"{len(torus[0])} {len(torus[1])} 0"]
    lines += [" ".join(map(repr, map(float, point))) for point in torus[0]]
    lines += ["3 " + " ".join(map(str, face)) for face in torus[1]]
    path = tmp_path / "ring.off"
    path.write_text("\n".join(lines))
    assert same(mspskel.skeletonize(path), ring)
    assert same(mspskel.skeletonize(str(path)), ring)


def test_pyvista(torus, ring):
    pyvista = pytest.importorskip("pyvista")
    assert same(mspskel.skeletonize(pyvista.PolyData.from_regular_faces(*torus)), ring)


@pytest.mark.parametrize(
    "mesh, error, word",
    [
        (42, mspskel.UsageError, "int: expected a path"),
        ((np.zeros((3, 2)), [[0, 1, 2]]), mspskel.UsageError, "vertices: expected an array of shape"),
        ((np.zeros((3, 3)), [[0.0, 1, 2]]), mspskel.UsageError, "whole numbers"),
        ((np.zeros((3, 3)), np.zeros((1, 2, 3), int)), mspskel.UsageError, "faces"),
        ((np.eye(3), [[0, 1, 7]]), mspskel.MeshError, "face"),
        ((np.zeros((3, 3)), [[0, 1, 2**40]]), mspskel.MeshError, str(2**40)),
        ((np.zeros((0, 3)), np.zeros((0, 3), int)), mspskel.MeshError, "face"),
        ("nothing.off", mspskel.ReadError, "nothing.off"),
    ],
)
def test_what_is_no_mesh(mesh, error, word):
    with pytest.raises(error, match=word):
        mspskel.skeletonize(mesh)


def test_options_have_the_names_and_messages_of_the_command_line(torus):
    with pytest.raises(mspskel.UsageError, match="smallest: 2 is not in the range 0 to 1"):
        mspskel.Options(smallest=2)
    with pytest.raises(mspskel.UsageError, match="unknown option --smalest; did you mean --smallest"):
        mspskel.skeletonize(torus, smalest=0.1)
    with pytest.raises(mspskel.UsageError, match="did you mean thesis"):
        mspskel.Options(mode="thesi")
    for name in ("help", "version", "a=b", ""):
        with pytest.raises(mspskel.UsageError):
            mspskel.Options(**{name: True})


def test_options_reach_the_engine():
    options = mspskel.Options(mode="thesis", lambda_=2.5, cone=False, seed=7)
    values = options.values
    assert (values["mode"], values["lambda"], values["cone"], values["seed"]) == ("thesis", 2.5, False, 7)
    assert values["slice-method"] == "sampling"  # a default of the mode
    assert options.replace(cone=True).values["cone"] is True
    assert mspskel.Options(repair=False).values["repair"] == "off"


def test_options_for_a_kind_of_model():
    neurons = mspskel.Options.for_("neurons").values
    assert (neurons["for"], neurons["detail"]) == ("neurons", 2)
    given = mspskel.Options.for_("neurons", smallest=0.002)
    assert given.values == {**neurons, "smallest": 0.002}
    assert given.values == mspskel.Options(smallest=0.002, for_="neurons").values
    assert mspskel.Options.for_("general").values == mspskel.Options().values
    with pytest.raises(mspskel.UsageError, match="did you mean vessels"):
        mspskel.Options.for_("vesels")


def test_keywords_are_the_options():
    from mspskel.keywords import OptionKeywords
    from mspskel.options import describe

    names = [row["name"].replace("-", "_") for row in describe()]
    assert [name.rstrip("_") for name in OptionKeywords.__annotations__] == names


def test_open_meshes_are_mended_with_a_warning(torus):
    vertices, faces = torus
    with pytest.warns(mspskel.SkeletonWarning, match="mended"):
        skeleton = mspskel.skeletonize((vertices, faces[:-1]))
    assert any("mended" in warning for warning in skeleton.warnings)
    assert skeleton.mesh_map.shape == (len(vertices),)
    with pytest.raises(mspskel.MeshError):
        mspskel.skeletonize((vertices, faces[:-1]), repair=False)


def test_polygons_are_triangulated():
    corners = [[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 5)]
    quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    skeleton = mspskel.skeletonize((corners, quads))
    assert np.ptp(skeleton.vertices[:, 2]) > 2
    assert skeleton.mesh.faces.shape == (12, 3)


def test_progress_and_cancelling(quadruped):
    seen = []
    mspskel.skeletonize(quadruped, progress=lambda stage, fraction: seen.append((stage, fraction)))
    assert len({stage for stage, _ in seen}) > 2 and all(0 <= fraction <= 1 for _, fraction in seen)
    with pytest.raises(mspskel.Cancelled):
        mspskel.skeletonize(quadruped, progress=lambda stage, fraction: False)
    with pytest.raises(ZeroDivisionError):
        mspskel.skeletonize(quadruped, progress=lambda stage, fraction: 1 / 0)
    mspskel.skeletonize(quadruped, progress=True)


def test_progress_of_mending(quadruped):
    vertices, faces = quadruped
    stages = []
    with pytest.warns(mspskel.SkeletonWarning, match="mended"):
        mspskel.skeletonize((vertices, faces[:-1]), progress=lambda stage, fraction: stages.append(stage))
    assert stages[0] == "mending"


def test_time_limit():
    with pytest.raises(mspskel.Cancelled, match="the time limit is over"):
        mspskel.skeletonize(mspskel.sample("quadruped", resolution=20000), time_limit=0.01)


def test_control_c():
    code = (
        "import mspskel, sys\n"
        "mesh = mspskel.sample('quadruped', resolution=4000)\n"
        "print('ready', flush=True)\n"
        "try:\n"
        "    while True: mspskel.skeletonize(mesh, mode='thesis', slices=1000)\n"
        "except KeyboardInterrupt: print('stopped')\n"
    )
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout.readline() == "ready\n"
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        assert process.communicate(timeout=20)[0] == "stopped\n"


def test_other_threads_run_meanwhile(quadruped):
    ticks, done = [], threading.Event()

    def tick():
        while not done.wait(0.001):
            ticks.append(time.monotonic())

    thread = threading.Thread(target=tick)
    thread.start()
    start = time.monotonic()
    mspskel.skeletonize(quadruped, threads=1)
    end = time.monotonic()
    done.set()
    thread.join()
    assert sum(start < t < end for t in ticks) > 3


def test_threads_get_the_same_results(quadruped, animal):
    results = [None, None]

    def work(i):
        results[i] = mspskel.skeletonize(quadruped, threads=1)

    threads = [threading.Thread(target=work, args=(i,)) for i in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert same(results[0], animal) and same(results[1], animal)


def test_the_environment_is_left_as_it_was():
    code = "import os; before = dict(os.environ); import mspskel; assert dict(os.environ) == before"
    subprocess.run([sys.executable, "-c", code], check=True)


def test_nothing_leaks():
    code = (
        "import mspskel\n"
        "s = mspskel.skeletonize(mspskel.sample('torus', resolution=200))\n"
        "s.stages.msp, s.check(), s.stages.slice(0), s.stages.faces, s.to_bytes('x.json'), s.copy()\n"
        "try: mspskel.skeletonize(42)\n"
        "except mspskel.Error: pass\n"
    )
    result = subprocess.run([sys.executable, "-X", "dev", "-c", code], capture_output=True, text=True, check=True)
    assert result.stderr == ""

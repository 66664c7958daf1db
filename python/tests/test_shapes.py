"""Parts and rigs are the command line's, and keep their laws."""

import numpy as np
import pytest

import mspskel


def test_every_face_has_a_part(animal):
    parts = animal.surface_segments()
    assert len(parts) == parts.count > 4
    assert len(parts.part_of_face) == len(animal.stages.faces)
    assert set(parts.part_of_face) == set(range(parts.count))
    assert len(parts.part_of_node) == len(animal)
    assert animal.surface_segments(parts=3).count == 3
    with pytest.raises(mspskel.UsageError):
        animal.surface_segments(parts=-1)


def test_weights_sum_to_one_and_follow_joints(animal):
    rig = animal.rig()
    assert rig.names[0] == "root" and rig.parents[0] == -1
    assert (rig.parents[1:] < np.arange(1, len(rig))).all()
    assert rig.influences.shape == rig.weights.shape == (len(animal.stages.vertices), 4)
    assert np.allclose(rig.weights.sum(axis=1), 1) and rig.influences.max() < len(rig)
    assert len(animal.rig(joints=9)) == 9


def test_a_turned_root_turns_everything(animal):
    rig = animal.rig()
    rest = animal.stages.vertices
    assert np.allclose(rig.bend({}), rest)
    turned = rig.bend({"root": ("z", 90)}) - rig.positions[0]
    x, y, z = (rest - rig.positions[0]).T
    assert np.allclose(turned, np.column_stack([-y, x, z]))
    assert np.allclose(rig.bend({"root": ((0, 0, 2), 90)}), rig.bend({"root": ("z", 90)}))


def test_wrong_poses_are_told(animal):
    rig = animal.rig()
    with pytest.raises(mspskel.UsageError, match="no joint"):
        rig.bend({"wing": ("x", 5)})
    with pytest.raises(mspskel.UsageError, match="axis"):
        rig.bend({"root": ("w", 5)})
    with pytest.raises(mspskel.UsageError):
        rig.bend({"root": ((0, 0, 0), 5)})


def test_files_of_a_rig(animal, tmp_path):
    rig = animal.rig()
    rig.to(tmp_path / "a.glb")
    assert (tmp_path / "a.glb").read_bytes()[:4] == b"glTF"
    rig.to(tmp_path / "b.glb", pose={"root": ("x", 30)})
    assert (tmp_path / "a.glb").read_bytes() != (tmp_path / "b.glb").read_bytes()
    rig.to(tmp_path / "a.rig.txt")
    words = [line.split() for line in (tmp_path / "a.rig.txt").read_text().splitlines()]
    assert sum(line[0] == "joints" for line in words) == len(rig)
    with pytest.raises(mspskel.UsageError, match=".glb"):
        rig.to(tmp_path / "a.fbx")


def test_a_skeleton_of_a_file_has_no_surface(animal, tmp_path):
    animal.to(tmp_path / "a.skel")
    with pytest.raises(mspskel.UsageError):
        mspskel.read_skeleton(tmp_path / "a.skel").rig()

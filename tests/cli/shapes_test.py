"""Parts and rigs as files."""
import unittest

from program import USAGE, ProgramTest


class Shapes(ProgramTest):
    def faces(self, mesh):
        return int((self.folder / mesh).read_text().split()[2])

    def test_every_face_has_a_part(self):
        mesh = self.sample("quadruped", 2500)
        self.succeed(mesh, "a.skel", "--segments", "a.seg", "-q")
        parts = [int(line) for line in (self.folder / "a.seg").read_text().splitlines()]
        self.assertEqual(len(parts), self.faces(mesh))
        self.assertEqual(set(parts), set(range(max(parts) + 1)))
        self.succeed(mesh, "a.skel", "--segments", "a.ply", "-q")
        header = (self.folder / "a.ply").read_text().split("end_header")[0]
        self.assertIn("property int part", header)
        self.succeed("render", "a.ply", "a.png")
        self.succeed("render", mesh, "--segments", "a.seg", "b.png")

    def test_parts_of_a_mesh_whose_edges_are_cut_before_it_is_coarsened(self):
        mesh = self.sample("capsule", 500)
        self.succeed(mesh, "a.skel", "--segments", "a.seg", "--coarse-vertices", 200, "-q")
        self.assertEqual(len((self.folder / "a.seg").read_text().split()), self.faces(mesh))

    def test_wanted_number_of_parts(self):
        mesh = self.sample("quadruped", 2500)
        self.succeed(mesh, "a.skel", "--segments", "a.seg", "--parts", 4, "-q")
        self.assertEqual(len(set((self.folder / "a.seg").read_text().split())), 4)

    def test_rig_files(self):
        mesh = self.sample("quadruped", 2500)
        self.succeed(mesh, "a.glb", "a.rig.txt", "--rig", "--joints", 12, "-q")
        self.assertEqual((self.folder / "a.glb").read_bytes()[:4], b"glTF")
        lines = [line.split() for line in (self.folder / "a.rig.txt").read_text().splitlines()]
        joints = [words[1] for words in lines if words[0] == "joints"]
        self.assertEqual(len(joints), 12)
        self.assertEqual([words[1] for words in lines if words[0] == "root"], ["root"])
        self.assertEqual(sorted(words[2] for words in lines if words[0] == "hier"), sorted(set(joints) - {"root"}))
        for words in lines:
            if words[0] == "skin":
                self.assertAlmostEqual(sum(map(float, words[3::2])), 1, places=6)  # weights have a 32-bit float's digits
                self.assertLessEqual(set(words[2::2]), set(joints))

    def test_pose_bends_the_surface(self):
        mesh = self.sample("quadruped", 2500)
        self.succeed(mesh, "a.skel", "--bent", "still.off", "-q")
        self.succeed(mesh, "a.skel", "--bent", "bent.off", "--pose", "root=z,30", "--pose", "root=0,1,0,20", "-q")
        still, bent = ((self.folder / name).read_text() for name in ("still.off", "bent.off"))
        self.assertNotEqual(still, bent)
        self.assertEqual(self.faces("still.off"), self.faces("bent.off"))

    def test_options_without_their_file_are_refused(self):
        mesh = self.sample()
        self.assertIn("--segments", self.fail_with(USAGE, mesh, "a.skel", "--parts", 3))
        self.assertIn(".glb", self.fail_with(USAGE, mesh, "a.skel", "--rig"))
        self.assertIn("--rig", self.fail_with(USAGE, mesh, "a.glb", "--joints", 5))
        self.assertIn("no joint", self.fail_with(USAGE, mesh, "a.rig.txt", "--pose", "tail=x,5"))
        self.assertIn(".seg", self.fail_with(USAGE, mesh, "a.skel", "--segments", "a.txt"))


if __name__ == "__main__":
    unittest.main()

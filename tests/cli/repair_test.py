"""Meshes that are not closed are mended, and the program says what it did."""
import json
import math
import unittest

from program import DONE, MESH, READ, TETRAHEDRON, USAGE, ProgramTest


def read_off(path):
    words = path.read_text().split()
    points, faces = int(words[1]), int(words[2])
    numbers = words[4:]
    place = [tuple(map(float, numbers[3 * i:3 * i + 3])) for i in range(points)]
    rest = numbers[3 * points:]
    return place, [tuple(map(int, rest[4 * i + 1:4 * i + 4])) for i in range(faces)]


def write_off(path, points, faces):
    lines = [f"OFF\n{len(points)} {len(faces)} 0"]
    lines += [" ".join(map(repr, p)) for p in points] + [" ".join(map(str, (3, *f))) for f in faces]
    path.write_text("\n".join(lines) + "\n")


class Repair(ProgramTest):
    def mended(self, *arguments):
        """The one line that sums up what was done."""
        result = self.run_program(*arguments)
        message = result.stderr.decode()
        self.assertEqual(result.returncode, DONE, message)
        lines = [line for line in message.splitlines() if line.startswith("mspskel: warning: mended: ")]
        self.assertEqual(len(lines), 1, message)
        return lines[0]

    def open_tube(self):
        points, faces = read_off(self.folder / self.sample("tube", 800))
        top, low = max(p[2] for p in points), min(p[2] for p in points)
        wall = [f for f in faces if not all(points[v][2] > top - 1e-9 or points[v][2] < low + 1e-9 for v in f)]
        write_off(self.folder / "open.off", points, wall)
        return len(points), top, low

    def test_hole_is_closed_and_the_surface_written(self):
        self.write("open.off", TETRAHEDRON.replace("4 4 0", "4 3 0").replace("3 2 0 3\n", ""))
        line = self.mended("open.off", "a.skel", "--write-mesh", "closed.off", "--report", "a.json")
        self.assertIn("1 hole closed", line)
        self.assertEqual(len(read_off(self.folder / "closed.off")[1]), 4)
        report = json.loads((self.folder / "a.json").read_text())
        self.assertEqual(report["repair"]["holes"], 1)
        self.succeed("check", "closed.off", "a.skel")

    def test_skeleton_ends_at_open_ends(self):
        count, top, low = self.open_tube()
        self.assertIn("2 open ends", self.mended("open.off", "a.json", "a.obj", "--report", "report.json"))
        openings = json.loads((self.folder / "report.json").read_text())["repair"]["openings"]
        self.assertEqual(len(openings), 2)
        ends = [tuple(map(float, line.split()[1:4]))
                for line in (self.folder / "a.obj").read_text().splitlines() if line.startswith("v ")]
        for opening in openings:
            self.assertAlmostEqual(opening["radius"], 1, delta=0.05)
            self.assertLess(min(math.dist(opening["centre"], end) for end in ends), 0.05)
        self.assertEqual({round(o["centre"][2], 3) for o in openings}, {round(top, 3), round(low, 3)})

    def refusal(self, status, *arguments):
        """The report of a run that leaves nothing else."""
        before = self.files()
        result = self.run_program(*arguments, "a.skel", "--report", "refusal.json")
        self.assertEqual(result.returncode, status, result.stderr)
        self.assertEqual(set(self.files()) - set(before), {"refusal.json"})
        report = json.loads((self.folder / "refusal.json").read_text())
        (self.folder / "refusal.json").unlink()
        self.assertEqual((report["input"]["file"], report["error"]["status"]), (arguments[0], status))
        self.assertIn(report["error"]["message"], result.stderr.decode())
        return report

    def test_refusals_are_reported_with_counts_and_reason(self):
        self.open_tube()
        self.write("sheet.off", "OFF\n5 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n1 0 0\n3 0 1 2\n3 0 2 3\n")
        self.write("bad.off", TETRAHEDRON.replace("3 1 2 3", "3 1 2 x"))
        self.assertIn("repair", self.refusal(MESH, "open.off", "--open", "fail"))
        self.assertEqual(self.refusal(MESH, "sheet.off")["repair"]["isolated_points"], 1)
        self.assertNotIn("repair", self.refusal(MESH, "open.off", "--repair", "off"))
        self.assertIn("line 9", self.refusal(READ, "bad.off")["error"]["message"])

    def test_check_mends_as_the_extraction_did(self):
        self.open_tube()
        self.mended("open.off", "a.skel")
        self.succeed("check", "open.off", "a.skel", "-q")
        self.assertIn("2 holes", self.fail_with(MESH, "check", "open.off", "a.skel", "--open", "fail"))

    def test_options(self):
        self.open_tube()
        self.assertIn("2 holes", self.fail_with(MESH, "open.off", "a.skel", "--open", "fail"))
        self.assertIn("2 holes closed", self.mended("open.off", "a.skel", "--open", "cap"))
        self.fail_with(MESH, "open.off", "b.skel", "--repair", "off")
        self.assertIn("--components", self.fail_with(USAGE, "open.off", "b.skel", "--components", "some"))

    def apart(self):
        """The faces of a capsule, each with corners of its own and drawn in by a tenth: nothing meets."""
        points, faces = read_off(self.folder / self.sample("capsule", 200))
        loose = []
        for face in faces:
            middle = [sum(points[v][k] for v in face) / 3 for k in range(3)]
            loose += [tuple(0.9 * points[v][k] + 0.1 * middle[k] for k in range(3)) for v in face]
        write_off(self.folder / "loose.off", loose, [(i, i + 1, i + 2) for i in range(0, len(loose), 3)])
        return len(loose)

    def test_what_does_not_meet_is_wrapped(self):
        count = self.apart()
        self.assertIn("--wrap", self.fail_with(MESH, "loose.off", "a.skel"))
        result = self.run_program("loose.off", "a.json", "a.skel", "--wrap", "0.05", "--report", "r.json", "--write-mesh",
                                  "w.off")
        self.assertEqual(result.returncode, DONE, result.stderr)
        self.assertIn(b"wrapped to 1 solid", result.stderr)
        report = json.loads((self.folder / "r.json").read_text())
        self.assertTrue(report["repair"]["wrapped"])
        self.assertEqual((report["input"]["components"], report["input"]["genus"]), (1, 0))
        nodes = json.loads((self.folder / "a.json").read_text())["node_of_vertex"]
        self.assertEqual(len(nodes), count)
        self.assertNotIn(-1, nodes)
        self.succeed("check", "w.off", "a.skel", "-q")
        self.assertIn("--wrap", self.fail_with(USAGE, "loose.off", "b.skel", "--wrap", "0.5"))

    def test_a_bowl_is_closed_though_its_lid_is_large(self):
        rings, around = 12, 24
        points = [(0, 0, -1)]
        for i in range(1, rings + 1):
            tilt = math.pi / 2 * i / rings
            points += [(math.sin(tilt) * math.cos(2 * math.pi * j / around), math.sin(tilt) * math.sin(2 * math.pi * j / around),
                        -math.cos(tilt)) for j in range(around)]
        ring = lambda i, j: 1 + (i - 1) * around + j % around
        faces = [(0, ring(1, j + 1), ring(1, j)) for j in range(around)]
        for i in range(1, rings):
            for j in range(around):
                faces += [(ring(i, j), ring(i, j + 1), ring(i + 1, j + 1)), (ring(i, j), ring(i + 1, j + 1), ring(i + 1, j))]
        write_off(self.folder / "bowl.off", points, faces)
        result = self.run_program("bowl.off", "a.skel", "--report", "r.json")
        self.assertEqual(result.returncode, DONE, result.stderr)
        repair = json.loads((self.folder / "r.json").read_text())["repair"]
        self.assertGreater(repair["hole_share"], 0.25)
        self.assertFalse(repair["wrapped"])
        self.assertEqual(repair["holes"], 1)

    def two_crossing_capsules(self):
        points, faces = read_off(self.folder / self.sample("capsule", 400))
        size = max(abs(c) for p in points for c in p)
        turned = [(p[1], p[2], p[0] + size / 4) for p in points]
        write_off(self.folder / "two.off", points + turned, faces + [tuple(v + len(points) for v in f) for f in faces])

    def test_shells_that_cross_are_one_solid_unless_each_is_wanted(self):
        self.two_crossing_capsules()
        message = self.run_program("two.off", "a.skel", "--report", "a.json").stderr.decode()
        self.assertIn("2 shells that cross each other or lie in one place are united to 1 solid, cut along", message)
        report = json.loads((self.folder / "a.json").read_text())
        self.assertEqual((report["skeleton"]["components"], report["repair"]["united_shells"]), (1, 2))
        self.assertEqual(self.run_program("check", "two.off", "a.skel", "-q").returncode, DONE)
        self.run_program("two.off", "a.skel", "--report", "a.json", "--shells", "each")
        self.assertEqual(json.loads((self.folder / "a.json").read_text())["skeleton"]["components"], 2)

    def test_a_part_that_is_there_twice_is_one(self):
        points, faces = read_off(self.folder / self.sample("torus", 600))
        write_off(self.folder / "twice.off", points + points, faces + [tuple(v + len(points) for v in f) for f in faces])
        self.assertIn(f"{len(faces)} repeated faces dropped", self.mended("twice.off", "a.skel", "--report", "a.json"))
        report = json.loads((self.folder / "a.json").read_text())
        self.assertEqual((report["skeleton"]["components"], report["skeleton"]["cycles"]), (1, 1))
        self.run_program("twice.off", "a.skel", "--report", "a.json", "--shells", "each")
        self.assertEqual(json.loads((self.folder / "a.json").read_text())["skeleton"]["components"], 2)

    def test_numbers_of_another_surface_are_told(self):
        """Files that number faces or vertices say so where those are not the mesh's."""
        self.two_crossing_capsules()
        self.open_tube()
        for mesh, surface in (("two.off", "united shells"), ("open.off", "mended surface")):
            message = self.run_program(mesh, "a.skel", "a.rig.txt", "--segments", "a.seg", "--stages", "stages",
                                       "--write-mesh", "surface.off").stderr.decode()
            for file in ("a.rig.txt", "a.seg", "stages"):
                self.assertEqual(message.count(f"{file}: vertices and faces are numbered as on the"), 1, message)
            self.assertIn(surface, message)
            self.assertEqual(len((self.folder / "a.seg").read_text().split()), len(read_off(self.folder / "surface.off")[1]))
        self.run_program("two.off", "a.skel", "--segments", "a.seg", "--shells", "each")
        self.assertEqual(len((self.folder / "a.seg").read_text().split()), len(read_off(self.folder / "two.off")[1]))
        self.assertNotIn("numbered", self.run_program(self.sample("capsule"), "--segments", "a.seg").stderr.decode())

    def room(self):
        """A room of six slabs that cross in its edges and corners."""
        points, faces = [], []
        corners = [(0, 2, 1), (1, 2, 3), (4, 5, 6), (5, 7, 6), (0, 1, 4), (1, 5, 4), (2, 6, 3), (3, 6, 7), (0, 4, 2), (2, 4, 6),
                   (1, 3, 5), (3, 7, 5)]
        half = (2.0, 1.5, 1.0)
        for axis in range(3):
            for side in (-1, 1):
                box = [[-1.05 * h, 1.05 * h] for h in half]
                box[axis] = sorted((side * half[axis], side * (half[axis] - 0.05)))
                first = len(points)
                points += [tuple(box[k][i >> k & 1] for k in range(3)) for i in range(8)]
                faces += [tuple(first + v for v in f) for f in corners]
        write_off(self.folder / "room.off", points, faces)

    def test_shells_round_a_room_are_wrapped(self):
        self.room()
        result = self.run_program("room.off", "a.skel", "--report", "r.json")
        self.assertEqual(result.returncode, DONE, result.stderr)
        report = json.loads((self.folder / "r.json").read_text())
        self.assertTrue(report["repair"]["wrapped"])
        self.assertEqual((report["input"]["components"], report["input"]["genus"]), (1, 0))
        self.succeed("room.off", "a.skel", "--report", "r.json", "--wrap", "never", "-q")
        self.assertEqual(json.loads((self.folder / "r.json").read_text())["repair"]["united_shells"], 6)

    def test_terrain_is_refused_though_a_lid_would_close_it(self):
        n = 40
        points = [(i / n, j / n, 0.1 * math.sin(20 * i / n) * math.sin(20 * j / n)) for j in range(n + 1) for i in range(n + 1)]
        faces = []
        for j in range(n):
            for i in range(n):
                a = j * (n + 1) + i
                faces += [(a, a + 1, a + n + 2), (a, a + n + 2, a + n + 1)]
        write_off(self.folder / "terrain.off", points, faces)
        self.assertIn("encloses no volume", self.fail_with(MESH, "terrain.off", "a.skel"))

    def test_flat_sheet_is_refused_with_a_remedy(self):
        self.write("sheet.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n")
        self.assertIn("thickness", self.fail_with(MESH, "sheet.off", "a.skel"))

    def test_closed_mesh_is_left_alone(self):
        mesh = self.sample("capsule")
        self.succeed(mesh, "a.skel", "--write-mesh", "same.off")
        self.assertEqual(read_off(self.folder / mesh), read_off(self.folder / "same.off"))

    def test_written_surface_has_no_two_vertices_in_one_place(self):
        """Most readers take such for one."""
        points, faces = read_off(self.folder / self.sample("capsule", 2000))
        rounded = [tuple(0.1 * round(10 * x) for x in p) for p in points]
        self.assertLess(len(set(rounded)), len(rounded))
        write_off(self.folder / "rounded.off", rounded, faces)
        result = self.run_program("rounded.off", "a.skel", "--write-mesh", "apart.off")
        self.assertEqual(result.returncode, DONE, result.stderr)
        written, same_faces = read_off(self.folder / "apart.off")
        self.assertEqual(len(set(written)), len(written))
        self.assertEqual(same_faces, faces)


if __name__ == "__main__":
    unittest.main()

"""The certificate decides about the exit status, and says what is wrong and where, in both commands."""
import json
import math
import random
import unittest

from program import DONE, NO_SKELETON, SOURCE, TETRAHEDRON, ProgramTest


def skel(points, edges):
    """A .skel file of small balls."""
    lines = ["ID Cx Cy Cz RADIUS #NEIGHBORS NEIGHBORS_LIST", str(len(points))]
    for i, point in enumerate(points):
        near = [b if a == i else a for a, b in edges if i in (a, b)]
        lines.append(" ".join(map(str, [i, *point, 0.1, len(near), *near])))
    return "\n".join(lines) + "\n"


class Check(ProgramTest):
    # A square in the torus of radii 1 and 0.4 that goes round its hole, and one that does not.
    ROUND = [(1, 0, 0), (0.75, 0.75, 0), (0, 1, 0), (-0.75, 0.75, 0), (-1, 0, 0), (-0.75, -0.75, 0), (0, -1, 0),
             (0.75, -0.75, 0)]
    LOCAL = [(1, 0, -0.1), (1, 0.2, -0.1), (1, 0.2, 0.1), (1, 0, 0.1)]

    def check(self, points, edges=None, *options):
        mesh = self.sample("torus", 600)
        n = len(points)
        self.write("k.skel", skel(points, edges if edges is not None else [(i, (i + 1) % n) for i in range(n)]))
        return self.run_program("check", mesh, "k.skel", *options)

    def test_cycle_round_the_handle(self):
        result = self.check(self.ROUND)
        self.assertEqual((result.returncode, result.stderr), (DONE, b""))
        self.assertIn(b"1 piece and 1 cycle on a surface of 1 component", result.stdout)

    def test_cycle_that_misses_the_handle(self):
        # Pieces and cycles are right in number, so that only the crossings tell.
        result = self.check(self.LOCAL)
        self.assertIn(b"certificate  failed", result.stdout)
        self.assertEqual(result.returncode, NO_SKELETON)
        self.assertIn(b"rank 0, not 1", result.stderr)

    def test_cycle_that_goes_outside_is_told_as_that(self):
        # Past the discs, crossings say nothing.
        outside = [*self.LOCAL, (1, -1, 3)]
        self.assertRegex(self.check(outside).stderr.decode(), "outside the solid, on 2 edges")
        result = self.check(outside, None, "--least-inside", 0)
        self.assertEqual(result.returncode, DONE, result.stderr)
        self.assertIn(b"certificate  kept: 2 edges", result.stdout)
        # Of a skeleton that is meant to be inside, the handle still wants its cycle.
        result = self.check(outside, None, "--least-inside", 0.01)
        self.assertEqual(result.returncode, NO_SKELETON)
        self.assertIn(b"rank 0, not 1", result.stderr)

    def test_lost_cycle(self):
        result = self.check(self.ROUND, [(i, i + 1) for i in range(7)])
        self.assertEqual(result.returncode, NO_SKELETON)
        self.assertIn(b"b1 is 0, not 1", result.stderr)

    def test_outside_says_how_much_and_where(self):
        result = self.check(self.ROUND + [(1, 0, 3)], [(i, (i + 1) % 8) for i in range(8)] + [(0, 8)])
        self.assertEqual(result.returncode, NO_SKELETON)
        self.assertRegex(result.stderr.decode(), r"28\.\d % of the skeleton's length .* outside the solid, on 1 edge, .* at 1 0 0\.\d")
        self.assertEqual(self.check(self.ROUND + [(1, 0, 3)], [(i, (i + 1) % 8) for i in range(8)] + [(0, 8)],
                                    "--least-inside", 0.5).returncode, DONE)


class Shells(ProgramTest):
    def test_both_commands_measure_a_piece_in_the_solid_of_its_component(self):
        # A ball with a hollow. The .skel file does not say which piece is whose.
        mesh = self.sample("shell", 1200)
        result = self.run_program(mesh, "k.skel", "--report", "r.json")
        self.assertEqual(result.returncode, DONE, result.stderr)
        with open(self.folder / "r.json", encoding="utf-8") as file:
            made = json.load(file)["checks"]
        result = self.run_program("check", mesh, "k.skel", "--json", "-")
        self.assertEqual(result.returncode, DONE, result.stderr)
        found = json.loads(result.stdout)
        for key in ("topology", "nested_components", "inside", "edges_not_inside", "crossing_rank"):
            self.assertEqual(found["certificate"][key], made[key], key)
        self.assertEqual((found["inside"], found["contained"]), (1, True))


class SmallHandles(ProgramTest):
    def test_skeleton_without_them_is_right_by_the_same_option(self):
        self.run_program("sample", "plate", "plate.off", "--count", 4, "--resolution", 1500)
        result = self.run_program("plate.off", "k.skel", "--smallest-handle", 1, "--report", "r.json")
        self.assertEqual(result.returncode, DONE, result.stderr)
        self.assertIn(b"4 handles too small for a cycle left out; the shortest loop", result.stderr)
        with open(self.folder / "r.json", encoding="utf-8") as file:
            checks = json.load(file)["checks"]
        self.assertEqual((checks["genus"], checks["small_handles"], checks["b1"], checks["topology"]), ([4], 4, 0, "proved"))
        self.assertEqual(self.run_program("check", "plate.off", "k.skel").returncode, NO_SKELETON)
        result = self.run_program("check", "plate.off", "k.skel", "--smallest-handle", 1)
        self.assertEqual(result.returncode, DONE, result.stderr)
        self.assertIn(b"without 4 handles too small for a cycle", result.stdout)


class Extract(ProgramTest):
    # Without its topology kept, the collapse of a torus of 14 faces loses the handle.
    LITERAL = ["-q", "--mode", "thesis", "--no-keep-topology"]

    def test_failed_skeleton_is_not_written(self):
        mesh = self.sample("csaszar-torus", 0)
        message = self.fail_with(NO_SKELETON, mesh, "a.skel", "--stages", "s", *self.LITERAL)
        self.assertIn("b1 is 0, not 1", message)
        self.assertIn("--keep-failed", message)
        result = self.run_program(mesh, "a.skel", "--report", "r.json", "--stages", "s", *self.LITERAL)
        self.assertEqual(result.returncode, NO_SKELETON)
        self.assertEqual(self.files(), ["csaszar-torus.off", "r.json"])
        report = json.loads((self.folder / "r.json").read_text())
        self.assertIn("b1 is 0, not 1", report["error"]["message"])
        self.fail_with(NO_SKELETON, mesh, "-", *self.LITERAL)

    def test_keep_failed_writes_and_still_fails(self):
        mesh = self.sample("csaszar-torus", 0)
        result = self.run_program(mesh, "a.skel", "--report", "r.json", "--keep-failed", *self.LITERAL)
        self.assertEqual(result.returncode, NO_SKELETON)
        self.assertIn(b"b1 is 0, not 1", result.stderr)
        self.assertEqual(self.files(), ["a.skel", "csaszar-torus.off", "r.json"])
        self.assertEqual(json.loads((self.folder / "r.json").read_text())["checks"]["topology"], "failed")
        self.assertEqual(self.run_program("check", mesh, "a.skel", "--least-inside", 0).returncode, NO_SKELETON)

    def test_keep_failed_changes_nothing_else(self):
        mesh = self.sample()
        self.assertEqual(self.succeed(mesh, "-"), self.succeed(mesh, "-", "--keep-failed"))


class Folded(ProgramTest):
    """Two linked rings, folded so that they cross themselves and each other."""

    def folded(self):
        lines = (self.folder / self.sample("hopf-link", 1200)).read_text().split("\n")
        count = int(lines[1].split()[0])
        points = [[float(x) for x in line.split()] for line in lines[2:2 + count]]
        extent = max(p[0] for p in points) - min(p[0] for p in points)
        folded = [f"{0.3 * extent * math.sin(6 * x / extent):.9g} {y:.9g} {z:.9g}" for x, y, z in points]
        return self.write("folded.off", "\n".join([*lines[:2], *folded, *lines[2 + count:]]))

    def test_is_wrapped_whether_or_not_anyone_asks_for_a_report(self):
        mesh = self.folded()
        made = self.run_program(mesh, "a.skel", "--report", "r.json")
        self.assertEqual(made.returncode, DONE, made.stderr)
        self.assertIn(b"of the mesh's own surface, the skeleton's topology is not the solid's", made.stderr)
        plain = self.run_program(mesh, "b.skel")
        self.assertEqual(plain.returncode, DONE, plain.stderr)
        self.assertEqual((self.folder / "a.skel").read_bytes(), (self.folder / "b.skel").read_bytes())
        self.assertEqual(self.run_program(mesh, "c.skel", "--wrap", "never").returncode, NO_SKELETON)


class Crushed(ProgramTest):
    """Coordinates rounded to a twentieth of the extent press thin arms flat: there is no solid in them."""

    def crushed(self):
        return self.rounded(self.sample("octoped", 3000), 16)

    def rounded(self, mesh, steps):
        lines = (self.folder / mesh).read_text().split("\n")
        count = int(lines[1].split()[0])
        points = [[float(x) for x in line.split()] for line in lines[2:2 + count]]
        step = max(max(axis) - min(axis) for axis in zip(*points)) / steps
        rounded = [" ".join(repr(round(x / step) * step) for x in point) for point in points]
        return self.write("crushed.off", "\n".join([*lines[:2], *rounded, *lines[2 + count:]]))

    def test_is_wrapped_where_its_skeleton_is_outside(self):
        result = self.run_program(self.crushed(), "a.skel", "--report", "r.json", "--write-mesh", "w.off")
        self.assertEqual(result.returncode, DONE, result.stderr)
        self.assertRegex(result.stderr.decode(), "of the mesh's own surface, .* outside the solid")
        report = json.loads((self.folder / "r.json").read_text())
        self.assertEqual((report["repair"]["wrapped"], report["checks"]["inside"]), (True, 1))
        self.assertIn(b"100 % of the length", self.run_program("check", "w.off", "a.skel").stdout)
        result = self.run_program("check", "crushed.off", "a.skel", "--json", "-")
        self.assertEqual((result.returncode, json.loads(result.stdout)["wrapped"]), (DONE, True), result.stderr)
        self.assertEqual(self.run_program("check", "crushed.off", "a.skel", "-q", "--wrap", "never").returncode, NO_SKELETON)

    def test_check_extracts_as_the_command_line_does(self):
        # A box that is pressed flat in its middle: other options wrap nothing, or have another wrap.
        self.succeed("sample", "box", "box.off", "--resolution", 350, "--side-x", 6, "--side-y", 2, "--side-z", 2)
        lines = (self.folder / "box.off").read_text().split("\n")
        count = int(lines[1].split()[0])
        points = [[float(x) for x in line.split()] for line in lines[2:2 + count]]
        flat = [" ".join(map(repr, (x, y, 0 if abs(x) < 0.8 else z))) for x, y, z in points]
        self.write("flat.off", "\n".join([*lines[:2], *flat, *lines[2 + count:]]))
        result = self.run_program("flat.off", "a.skel", "--report", "r.json")
        self.assertEqual(result.returncode, DONE, result.stderr)
        self.assertTrue(json.loads((self.folder / "r.json").read_text())["repair"]["wrapped"])
        result = self.run_program("check", "flat.off", "a.skel", "--json", "-")
        self.assertEqual((result.returncode, json.loads(result.stdout)["wrapped"]), (DONE, True), result.stderr)

    def test_is_wrapped_with_its_open_ends_closed(self):
        # A crumpled torus, and beside it a tube that is open at one end.
        lines = (self.folder / self.sample("torus", 1500)).read_text().split("\n")
        count = int(lines[1].split()[0])
        noise = random.Random(1)
        points = [[float(x) + noise.gauss(0, 0.15) for x in line.split()] for line in lines[2:2 + count]]
        faces = [[int(v) for v in line.split()[1:]] for line in lines[2 + count:] if line]
        corners, rings = 12, 20
        for i in range(rings * corners):
            angle = 2 * math.pi * i / corners
            points.append([5 + 0.5 * math.cos(angle), 0.5 * math.sin(angle), 0.3 * (i // corners)])
        for i in range((rings - 1) * corners):
            a, b = count + i, count + i // corners * corners + (i + 1) % corners
            faces += [[a, b, b + corners], [a, b + corners, a + corners]]
        points.append([5, 0, 0])
        faces += [[count + (i + 1) % corners, count + i, len(points) - 1] for i in range(corners)]
        text = [f"OFF\n{len(points)} {len(faces)} 0", *(" ".join(map(repr, x)) for x in points), *(f"3 {a} {b} {c}" for a, b, c in faces)]
        self.write("open.off", "\n".join(text) + "\n")
        self.fail_with(NO_SKELETON, "open.off", "a.skel", "-q", "--wrap", "never")
        result = self.run_program("open.off", "a.skel", "--report", "r.json")
        self.assertEqual(result.returncode, DONE, result.stderr)
        self.assertRegex(result.stderr.decode(), "1 open end of it is covered by the wrap")
        report = json.loads((self.folder / "r.json").read_text())
        self.assertEqual((report["repair"]["wrapped"], report["repair"]["openings"], report["checks"]["inside"]), (True, [], 1))
        result = self.run_program("check", "open.off", "a.skel", "--json", "-")
        self.assertEqual((result.returncode, json.loads(result.stdout)["wrapped"]), (DONE, True), result.stderr)

    def test_is_wrapped_where_no_loop_fits_a_surface_that_crosses_itself(self):
        self.assertEqual(self.run_program("sample", "vase", "vase.off", "--count", 3).returncode, DONE)
        mesh = self.rounded("vase.off", 10)
        self.assertIn("topology", self.fail_with(NO_SKELETON, mesh, "a.skel", "-q", "--wrap", "never"))
        result = self.run_program(mesh, "a.skel", "--report", "r.json")
        self.assertEqual(result.returncode, DONE, result.stderr)
        self.assertRegex(result.stderr.decode(), "of the mesh's own surface, .* topology is not the solid's")
        self.assertEqual(json.loads((self.folder / "r.json").read_text())["checks"]["topology"], "proved")

    def test_is_refused_where_it_may_not_be_wrapped(self):
        mesh = self.crushed()
        self.assertIn("outside the solid", self.fail_with(NO_SKELETON, mesh, "a.skel", "-q", "--wrap", "never"))
        self.assertEqual(self.run_program(mesh, "a.skel", "-q", "--wrap", "never", "--least-inside", 0).returncode, DONE)


class Page(ProgramTest):
    """What is warned of has its places on the page."""

    def places(self, mesh, *options):
        result = self.run_program(mesh, "a.html", "--report", "r.json", *options)
        self.assertEqual(result.returncode, DONE, result.stderr)
        page = (self.folder / "a.html").read_text(encoding="utf-8")
        description = json.loads(page.split('id="mspskel-description">')[1].split("</script>")[0])
        return {place["text"]: place for place in description["places"]}, json.loads((self.folder / "r.json").read_text())["checks"]

    def test_crossing_surface(self):
        # Two tetrahedra; the second one's apex is in the first one.
        other = [(0.2, 0.2, 0.2), (2, 0, 0.1), (0, 2, 0.1), (0, 0, 2)]
        lines = TETRAHEDRON.splitlines()
        faces = [f"3 {4 + int(a)} {4 + int(b)} {4 + int(c)}" for a, b, c in (line.split()[1:] for line in lines[6:])]
        self.write("two.off", "\n".join(["OFF", "8 8 0", *lines[2:6], *(" ".join(map(str, p)) for p in other), *lines[6:], *faces]) + "\n")
        places, checks = self.places("two.off", "--shells", "each")
        self.assertTrue(checks["self_intersecting"])
        self.assertIn("the surface crosses itself", places)
        self.assertNotIn("the surface crosses itself", self.places(self.sample())[0])

    def test_parts_without_arc(self):
        # Features as large as limbs are called noise.
        places, checks = self.places(SOURCE / "data" / "quadruped.off", "--smallest", 0.5)
        self.assertGreater(len(checks["coverage"]["uncovered"]), 0)
        self.assertEqual(places["a part has no arc"]["count"], len(checks["coverage"]["uncovered"]))


if __name__ == "__main__":
    unittest.main()

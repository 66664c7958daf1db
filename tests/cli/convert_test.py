"""Skeletons in other formats, roots of trees, and facts about files."""
import json
import unittest

from program import USAGE, ProgramTest


class Convert(ProgramTest):
    def tree(self, *options):
        """Rows of the SWC file: id, type, x, y, z, radius, parent."""
        self.succeed("convert", "a.skel", "a.swc", "-q", *options)
        lines = (self.folder / "a.swc").read_text().splitlines()
        return [list(map(float, line.split())) for line in lines if not line.startswith("#")]

    def test_same_bytes_as_the_extraction_writes(self):
        mesh = self.sample("y-tube", 800)
        self.succeed(mesh, "a.skel", "a.swc", "a.vtp", "a.graphml")
        before = {name: (self.folder / name).read_bytes() for name in ("a.swc", "a.vtp", "a.graphml")}
        self.succeed("convert", "a.skel", *before)
        self.assertEqual(before, {name: (self.folder / name).read_bytes() for name in before})

    def test_roots(self):
        self.succeed(self.sample("y-tube", 800), "a.skel")
        rows = self.tree()
        self.assertEqual(rows[0][5], max(row[5] for row in rows))
        tip = self.tree("--root", "tip")[0]
        self.assertEqual(tip[1], 6)
        for row in (rows[-1], rows[len(rows) // 2]):
            place = ",".join(map(repr, row[2:5]))
            self.assertEqual(self.tree("--root", f"point:{place}")[0][2:6], row[2:6])
        for wrong in ("thick", "point:1,2", "point:1,2,nan", "open:x", "open:-1", "open:0"):
            self.assertIn("--root", self.fail_with(USAGE, "convert", "a.skel", "b.swc", "--root", wrong))

    def test_loops_are_cut_where_they_are_thinnest(self):
        self.succeed(self.sample("torus", 600), "a.skel")
        lines = (self.folder / "a.skel").read_text().splitlines()[2:]
        nodes = [line.split() for line in lines]
        radius = {int(words[0]): float(words[4]) for words in nodes}
        thinnest = min(min(radius[int(words[0])], radius[int(w)]) for words in nodes for w in words[6:])
        result = self.run_program("convert", "a.skel", "a.swc")
        self.assertIn("1 loop was cut", result.stderr.decode())
        text = (self.folder / "a.swc").read_text().splitlines()
        cut = [line.split()[3:] for line in text if line.startswith("# cut edge")]
        rows = {line.split()[0]: float(line.split()[5]) for line in text if not line.startswith("#")}
        self.assertEqual([min(rows[a], rows[b]) for a, b in cut], [thinnest])

    def test_usage(self):
        self.succeed(self.sample(), "a.skel")
        self.assertIn("files to write", self.fail_with(USAGE, "convert", "a.skel"))
        self.assertIn("the skeleton", self.fail_with(USAGE, "convert", "a.skel", "a.skel"))


class Info(ProgramTest):
    def facts(self, *arguments):
        return json.loads(self.succeed("info", *arguments, "--json"))

    def test_mesh(self):
        facts = self.facts(self.sample("torus", 600))
        self.assertEqual((facts["kind"], facts["genus"], len(facts["components"])), ("mesh", 1, 1))
        self.assertGreater(facts["volume"], 0)
        self.assertIn("genus 1", self.succeed("info", "torus.off").decode())

    def test_skeleton_and_its_branches(self):
        self.succeed(self.sample("y-tube", 800), "a.skel", "a.obj", "a.ply", "a.json")
        for name in ("a.skel", "a.obj", "a.ply", "a.json"):
            facts = self.facts(name)
            self.assertEqual((facts["kind"], facts["leaves"], facts["joints"], len(facts["branches"])), ("skeleton", 3, 1, 3))
            self.assertAlmostEqual(sum(b["length"] for b in facts["branches"]), facts["length"], places=9)
        self.assertIn("3 leaves", self.succeed("info", "a.skel").decode())
        self.succeed("y-tube.off", "a.swc", "a.cgal", "a.polylines.txt")
        for name in ("a.swc", "a.cgal", "a.polylines.txt"):
            facts = self.facts(name)
            self.assertEqual((facts["kind"], facts["leaves"], len(facts["branches"])), ("skeleton", 3, 3))

    def test_open_ends_are_listed(self):
        self.sample("tube", 400)
        lines = (self.folder / "tube.off").read_text().splitlines()
        count = int(lines[1].split()[0])
        top = max(float(line.split()[2]) for line in lines[2:2 + count])
        high = {i for i, line in enumerate(lines[2:2 + count]) if float(line.split()[2]) > top - 1e-9}
        wall = [line for line in lines[2 + count:] if line.strip() and not set(map(int, line.split()[1:4])) <= high]
        self.write("open.off", "\n".join([lines[0], f"{count} {len(wall)} 0", *lines[2:2 + count], *wall]) + "\n")
        self.assertEqual(len(self.facts("open.off", "-q")["repair"]["openings"]), 1)
        self.assertIn("open end 0", self.run_program("info", "open.off").stdout.decode())
        self.run_program("open.off", "a.swc", "--root", "open:0", "-q")
        root = [line for line in (self.folder / "a.swc").read_text().splitlines() if line.endswith(" -1")][0]
        self.assertAlmostEqual(float(root.split()[4]), top, delta=0.05)
        first = (self.folder / "a.swc").read_bytes()
        self.run_program("open.off", "a.swc", "--root", "open", "-q")
        self.assertEqual((self.folder / "a.swc").read_bytes(), first)

    def test_the_root_at_an_opening_is_the_thickest_end_where_nothing_is_open(self):
        self.succeed(self.sample("y-tube", 800), "a.skel")
        self.succeed("convert", "a.skel", "open.swc", "--root", "open", "-q")
        self.succeed("convert", "a.skel", "tip.swc", "--root", "tip", "-q")
        self.assertEqual((self.folder / "open.swc").read_bytes(), (self.folder / "tip.swc").read_bytes())


if __name__ == "__main__":
    unittest.main()

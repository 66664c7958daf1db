"""From mesh to files: outputs, streams, the report, the stages."""
import csv
import json
import os
import pty
import re
import subprocess
import unittest

from program import PROGRAM, SOURCE, ProgramTest

# What a sanitizer needs to be told.
SANITIZERS = {name: value for name, value in os.environ.items() if name.endswith("SAN_OPTIONS")}


class Environment(ProgramTest):
    def shown(self, **environment):
        """What OpenMP says of its settings, nothing where it does not say."""
        mesh = self.sample()
        result = subprocess.run([PROGRAM, mesh, "-", "-t", "2"], capture_output=True, cwd=self.folder,
                                env={"OMP_DISPLAY_ENV": "true", **SANITIZERS, **environment})
        self.assertEqual(result.returncode, 0)
        return re.findall(rb"OMP_WAIT_POLICY\s*=\s*'(\w+)'", result.stderr)

    def test_waiting_threads_sleep_unless_told_otherwise(self):
        if not self.shown(OMP_WAIT_POLICY="active"):
            self.skipTest("this OpenMP does not show its settings")
        self.assertEqual(self.shown(OMP_WAIT_POLICY="active"), [b"ACTIVE"])
        self.assertEqual(self.shown(LANG="C"), [b"PASSIVE"])

    def test_empty_environment(self):
        mesh = self.sample()
        result = subprocess.run([PROGRAM, mesh, "a.skel"], capture_output=True, cwd=self.folder, env=SANITIZERS)
        self.assertEqual((result.returncode, result.stderr), (0, b""))


class Outputs(ProgramTest):
    def test_default_output_lies_beside_the_mesh(self):
        (self.folder / "sub").mkdir()
        self.succeed("sample", "capsule", "sub/a.b.off", "--resolution", 200)
        self.succeed("sub/a.b.off")
        self.assertEqual(self.files(), ["sub", "sub/a.b.off", "sub/a.b.skel"])

    def test_several_outputs_at_once(self):
        self.succeed(self.sample(), "a.skel", "a.obj")
        self.assertEqual(self.files(), ["a.obj", "a.skel", "capsule.off"])

    def test_streams(self):
        mesh = self.sample()
        self.succeed(mesh, "a.skel")
        skeleton = (self.folder / "a.skel").read_bytes()
        data = (self.folder / mesh).read_bytes()
        self.assertEqual(self.succeed(mesh, "-"), skeleton)
        self.assertEqual(self.succeed("-", "-", stdin=data), skeleton)
        self.assertEqual(self.succeed("-", stdin=data), skeleton)
        self.assertEqual(self.succeed("sample", "capsule", "-", "--resolution", 200), data)

    def test_same_bytes_with_one_and_two_threads(self):
        mesh = self.sample("torus", 600)
        for mode in ["default", "thesis"]:
            results = [self.succeed(mesh, "-", "--mode", mode, "--threads", n, "--stages", f"{mode}{n}") for n in (1, 2)]
            self.assertEqual(results[0], results[1])
            for name in ["msp.csv", "skeleton_mesh.ply"]:
                self.assertEqual(*((self.folder / f"{mode}{n}" / name).read_bytes() for n in (1, 2)))

    def test_options_reach_their_stage(self):
        mesh = self.sample("torus", 600)

        def slices(*options):
            self.succeed(mesh, "a.skel", "--report", "r.json", *options)
            return json.loads((self.folder / "r.json").read_text())["counts"]["slices"]

        thesis = ["--mode", "thesis", "--no-cone"]
        self.assertEqual(5 * slices("--slices", 5, *thesis), slices("--slices", 25, *thesis))
        self.assertEqual(slices(*thesis), slices("--slices=25", *thesis))

    def test_bundled_sample_is_what_the_program_makes(self):
        made = self.succeed("sample", "quadruped", "-", "--resolution", 2500)
        self.assertEqual(made, (SOURCE / "data" / "quadruped.off").read_bytes())


class Report(ProgramTest):
    def report(self, *arguments):
        self.succeed(*arguments, "--report", "r.json")
        return json.loads((self.folder / "r.json").read_text())

    def test_fields(self):
        report = self.report(self.sample("torus", 600), "a.skel", "--mode", "thesis")
        self.assertEqual(list(report), ["input", "repair", "options", "counts", "seconds", "peak_memory_bytes", "skeleton",
                                        "checks", "warnings"])
        self.assertEqual((report["input"]["components"], report["input"]["genus"]), (1, 1))
        self.assertEqual(report["input"]["faces"], 2 * report["input"]["vertices"])
        self.assertEqual(report["options"]["mode"], "thesis")
        self.assertEqual(report["options"]["slices"], 25)
        counts = report["counts"]
        self.assertGreaterEqual(counts["slices"], 25 * report["input"]["vertices"])
        self.assertGreater(counts["steps"], counts["slices"])
        self.assertTrue(0 <= counts["refined_share"] <= 1)
        self.assertGreater(counts["collapses"], 0)
        self.assertTrue(all(isinstance(n, int) for n in counts["refusals"].values()))
        seconds = dict(report["seconds"])
        total = seconds.pop("total")
        self.assertIn("slices", seconds)
        self.assertLessEqual(sum(seconds.values()), total * 1.001)
        self.assertGreater(report["peak_memory_bytes"], 1_000_000)
        self.assertLessEqual({"nodes", "edges", "components", "cycles", "leaves", "length"}, set(report["skeleton"]))
        self.assertEqual((report["checks"]["b0"], report["checks"]["b1"]), (1, 1))
        self.assertIn(report["checks"]["topology"], ["proved", "kept"])
        self.assertIsInstance(report["warnings"], list)

    def test_peak_memory_is_not_that_of_the_parent(self):
        mesh = self.sample()
        own = self.report(mesh, "a.skel")["peak_memory_bytes"]
        ballast = b"\1" * (own + 300_000_000)  # a child is said to have had what its parent has
        self.assertLess(self.report(mesh, "a.skel")["peak_memory_bytes"], len(ballast) - 100_000_000)

    def test_spacing_of_the_nodes_changes_nothing_else(self):
        (self.folder / "q.off").write_bytes((SOURCE / "data" / "quadruped.off").read_bytes())
        reports = {}
        for step in [0.0005, 0.001, 0.008, 0.1, 0.26, 0.5]:
            reports[step] = self.report("q.off", "a.skel", "--step", step)
            # Short cuts stay off the walls.
            self.assertEqual(reports[step]["checks"]["topology"], "proved")
        shapes = {(r["skeleton"]["leaves"], r["skeleton"]["cycles"], r["counts"]["slices"]) for r in reports.values()}
        self.assertEqual(len(shapes), 1)
        for one, other in [(0.0005, 0.001), (0.001, 0.008)]:
            lengths = [reports[step]["skeleton"]["length"] for step in (one, other)]
            self.assertAlmostEqual(lengths[0] / lengths[1], 1, delta=0.01)
            self.assertGreater(reports[one]["skeleton"]["nodes"], 1.8 * reports[other]["skeleton"]["nodes"])

    def test_every_option_of_the_help_is_reported(self):
        options = self.report(self.sample(), "a.skel")["options"]
        text = self.succeed("--help-all").decode()
        listed = {word for line in text.splitlines() if line.startswith("  -") for word in line.split()
                  if "--" in word}
        names = {word.split("--")[-1].replace("[no-]", "") for word in listed} - {"help", "help-all"}
        self.assertEqual(names, set(options))

    def test_path_that_is_not_utf8(self):
        name = b"caf\xe9.off"
        os.rename(self.folder / self.sample(), os.path.join(os.fsencode(self.folder), name))
        subprocess.run([PROGRAM, name, "a.skel", "--report", "r.json"], cwd=self.folder, check=True)
        report = json.loads((self.folder / "r.json").read_bytes().decode("utf-8"))
        self.assertEqual(report["input"]["file"], "caf\ufffd.off")


class Stages(ProgramTest):
    def test_files(self):
        mesh = self.sample("torus", 600)
        self.succeed(mesh, "a.skel", "--mode", "thesis", "--stages", "made/here")
        folder = self.folder / "made" / "here"
        self.assertEqual(sorted(p.name for p in folder.iterdir()),
                         ["error.ply", "error_initial.ply", "msp.csv", "msp.ply", "msp_initial.ply",
                          "skeleton_mesh.ply"])
        vertices = int((self.folder / mesh).read_text().split()[1])
        with open(folder / "msp.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(list(rows[0]), (
            "vertex,msp_initial,msp,error_initial,error,normal_x,normal_y,normal_z,contour_points,refined,"
            "center_x,center_y,center_z").split(","))
        self.assertEqual([int(row["vertex"]) for row in rows], list(range(vertices)))
        for row in rows:
            self.assertLessEqual(float(row["msp"]), float(row["msp_initial"]) * (1 + 1e-12))
            self.assertTrue(0 <= float(row["error"]) <= 1 and 0 <= float(row["error_initial"]) <= 1)
            normal = [float(row[f"normal_{axis}"]) for axis in "xyz"]
            self.assertAlmostEqual(sum(x * x for x in normal), 1, places=12)
            self.assertGreaterEqual(int(row["contour_points"]), 3)
            self.assertIn(row["refined"], "01")

    def test_meshes_can_be_read_back(self):
        self.succeed(self.sample(), "a.skel", "--stages", "s")
        for name in ["msp", "error_initial", "skeleton_mesh"]:
            self.succeed("render", f"s/{name}.ply", f"{name}.png", "--width", 64, "--height", 64)


class Pictures(ProgramTest):
    def test_png(self):
        mesh = self.sample()
        self.succeed(mesh, "a.skel")
        self.succeed("render", mesh, "a.skel", "a.png", "--width", 64, "--height", 48, "--views", 2)
        self.assertEqual((self.folder / "a.png").read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual(self.succeed("render", mesh, "a.skel", "-", "--width=64", "--height=48", "--views=2"),
                         (self.folder / "a.png").read_bytes())


class Checks(ProgramTest):
    def test_own_skeleton_fits_its_mesh(self):
        mesh = self.sample("torus", 600)
        self.succeed(mesh, "a.skel")
        self.assertIn("right", self.succeed("check", mesh, "a.skel").decode())
        checks = json.loads(self.succeed("check", mesh, "a.skel", "--json", "-"))
        self.assertEqual((checks["topology"], checks["contained"], checks["b1"]), (True, True, 1))

    def test_another_skeleton_does_not(self):
        torus, capsule = self.sample("torus", 600), self.sample("capsule")
        self.succeed(capsule, "capsule.skel")
        result = self.run_program("check", torus, "capsule.skel", "--json", "checks.json", "-q")
        self.assertEqual((result.returncode, result.stdout), (5, b""))
        self.assertIn(b"topology", result.stderr)
        self.assertIs(json.loads((self.folder / "checks.json").read_text())["topology"], False)


class Terminals(ProgramTest):
    """What a person sees who runs the program on a terminal."""

    def seen(self, *arguments, **environment):
        try:
            main, terminal = pty.openpty()
        except OSError as error:
            self.skipTest(f"no terminals here: {error}")
        usual = {name: value for name, value in os.environ.items() if name != "NO_COLOR"}
        process = subprocess.Popen([PROGRAM, *map(str, arguments)], cwd=self.folder, stderr=terminal,
                                   env={**usual, "TERM": "xterm", **environment})
        os.close(terminal)
        text = b""
        while True:
            try:
                chunk = os.read(main, 4096)
            except OSError:  # Linux ends a terminal that way
                break
            if not chunk:
                break
            text += chunk
        os.close(main)
        process.wait()
        return text

    def test_progress(self):
        mesh = self.sample("torus", 600)
        self.assertIn(b" %", self.seen(mesh, "a.skel"))
        self.assertEqual(self.seen(mesh, "a.skel", "--quiet"), b"")

    # Long enough that the limit ends it.
    LONG = ["--mode", "thesis", "--slices", "100", "--time-limit", "4"]

    def shares(self, lines):
        found = [re.fullmatch(r"(\d+) %, [a-z ]+(?:, (about \d+ (?:s|min|h) left))?", line) for line in lines]
        self.assertNotIn(None, found, lines)
        self.assertEqual(lines, sorted(lines, key=lambda line: int(line.split()[0])))
        if int(found[-1][1]) >= 10:  # on a slow machine it may be too early to tell
            self.assertTrue(any(match[2] for match in found), lines)

    def test_progress_is_a_line_that_is_written_over(self):
        mesh = self.sample("torus", 20000)
        progress, message = self.seen(mesh, "a.skel", *self.LONG).decode().rsplit("\r\x1b[K", 1)
        self.shares([line for line in progress.replace("\x1b[K", "").split("\r") if line])
        self.assertIn("time limit", message)
        self.assertNotIn("\n", progress)
        without_colour = self.seen(self.sample("torus", 600), "a.skel", NO_COLOR="1")
        self.assertIn(b"\r", without_colour)
        self.assertNotIn(b"\x1b[1;", without_colour)

    def test_progress_elsewhere_is_plain_lines(self):
        mesh = self.sample("torus", 20000)
        dumb = self.seen(mesh, "a.skel", *self.LONG, TERM="dumb").decode().replace("\r\n", "\n")
        for text in [dumb, self.run_program(mesh, "a.skel", *self.LONG).stderr.decode()]:
            self.assertNotIn("\x1b", text)
            self.assertNotIn("\r", text)
            self.shares([line.removeprefix("mspskel: ") for line in text.splitlines()[:-1]])

    def test_progress_of_several_components_never_falls(self):
        self.sample("torus", 6000)
        self.sample("sphere", 300)
        parts = []
        for k, name in enumerate(["torus.off", "sphere.off", "torus.off"]):
            lines = (self.folder / name).read_text().split("\n")
            count, faces = map(int, lines[1].split()[:2])
            points = [[float(x) + 5 * k for x in line.split()] for line in lines[2 : 2 + count]]
            parts.append((points, [[int(i) for i in line.split()[1:4]] for line in lines[2 + count : 2 + count + faces]]))
        points, faces = [], []
        for own, triangles in parts:
            faces += [[i + len(points) for i in triangle] for triangle in triangles]
            points += own
        text = f"OFF\n{len(points)} {len(faces)} 0\n" + "".join(f"{x} {y} {z}\n" for x, y, z in points)
        mesh = self.write("three.off", text + "".join(f"3 {a} {b} {c}\n" for a, b, c in faces))
        seen = self.seen(mesh, "a.skel", "--mode", "thesis").decode()
        shares = [int(share) for share in re.findall(r"\r(\d+) %", seen)]
        self.assertTrue(shares)  # how many of them, and how far they come, is a matter of speed
        self.assertEqual(shares, sorted(shares))

    def test_colour(self):
        self.assertIn(b"\x1b[1;31m", self.seen("absent.off"))
        for environment in [{"NO_COLOR": "1"}, {"TERM": "dumb"}]:
            self.assertNotIn(b"\x1b[", self.seen("absent.off", **environment))


if __name__ == "__main__":
    unittest.main()

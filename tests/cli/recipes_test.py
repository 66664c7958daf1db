"""The docs' shell examples run, their links lead somewhere, and the gallery shows every sample."""
import json
import os
import re
import shutil
import subprocess
import sys
import types
import unittest
import unittest.mock

from program import PROGRAM, SOURCE, ProgramTest

DOCS = SOURCE / "docs"


class Recipes(ProgramTest):
    def examples(self, page):
        text = (DOCS / page).read_text(encoding="utf-8")
        blocks = re.findall(r"^```sh\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
        return [line for block in blocks for line in block.splitlines() if line.startswith("build/mspskel ")]

    def setUp(self):
        super().setUp()
        shutil.copytree(SOURCE / "data", self.folder / "data")
        for name in ["out", "build"]:
            (self.folder / name).mkdir()
        os.symlink(PROGRAM, self.folder / "build" / "mspskel")

    def run_examples(self, page, least):
        self.succeed("data/quadruped.off", "out/quadruped.skel")
        examples = self.examples(page)
        self.assertGreaterEqual(len(examples), least)
        for example in examples:
            result = subprocess.run(["bash", "-c", example], cwd=self.folder, capture_output=True, text=True, timeout=120)
            self.assertEqual(result.returncode, 0, f"{example}\n{result.stderr}")

    def test_examples_of_the_recipes_run(self):
        self.run_examples("recipes.md", 10)

    def test_examples_of_is_my_skeleton_right_run(self):
        self.run_examples("is_my_skeleton_right.md", 4)

    def test_the_script_for_blender_draws_every_edge(self):
        self.succeed("data/quadruped.off", "out/lines.json", "out/lines.skel")
        text = (DOCS / "recipes.md").read_text(encoding="utf-8")
        script = next(s for s in re.findall(r"^```python\n(.*?)^```", text, re.MULTILINE | re.DOTALL) if "import bpy" in s)
        drawn = []

        class Points(list):
            def add(self, count):
                self.extend(types.SimpleNamespace() for _ in range(count))

        def new_spline(_):
            drawn.append(types.SimpleNamespace(points=Points([types.SimpleNamespace()])))
            return drawn[-1]

        curve = types.SimpleNamespace(splines=types.SimpleNamespace(new=new_spline))
        blender = unittest.mock.MagicMock()
        blender.data.curves.new.return_value = curve
        with unittest.mock.patch.dict(sys.modules, bpy=blender):
            exec(script.replace("/path/to", str(self.folder)), {})
        info = json.loads(self.succeed("info", "out/lines.skel", "--json"))
        self.assertEqual(len(drawn), info["edges"])
        for line in drawn:
            for point in line.points:
                self.assertEqual((len(point.co), point.co[3]), (4, 1))
                self.assertGreater(point.radius, 0)

    def test_links_lead_somewhere(self):
        for page in DOCS.glob("*.md"):
            for link in re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", page.read_text(encoding="utf-8")):
                self.assertTrue((DOCS / link).is_file(), f"{page.name}: {link}")

    def test_the_gallery_has_every_sample(self):
        text = (DOCS / "gallery.md").read_text(encoding="utf-8")
        listed = self.succeed("sample", "--help").decode().split("\nSamples:\n")[1]
        names = [name for name in re.findall(r"^  (\S+) ", listed, re.MULTILINE) if not name.startswith("--")]
        self.assertGreater(len(names), 20)
        for name in names:
            self.assertIn(f"(images/samples/{name}.png)", text)

    def test_the_gallery_is_made_anew(self):
        (self.folder / "docs").mkdir()
        script = [sys.executable, SOURCE / "scripts" / "gallery.py", "--program", PROGRAM, "--docs", "docs", "--only", "tube"]
        subprocess.run(script, cwd=self.folder, check=True, timeout=120)
        self.assertIn("1 piece, 2 ends", (self.folder / "docs" / "gallery.md").read_text(encoding="utf-8"))
        picture = (self.folder / "docs" / "images" / "samples" / "tube.png").read_bytes()
        self.assertEqual(picture[:8], b"\x89PNG\r\n\x1a\n")


if __name__ == "__main__":
    unittest.main()

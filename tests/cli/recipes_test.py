"""The docs' shell examples run, their links lead somewhere, and the gallery shows every sample."""
import os
import re
import shutil
import subprocess
import sys
import unittest

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

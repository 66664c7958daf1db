"""mspskel-experiments, in the environment variable MSPSKEL_EXPERIMENTS, makes a whole page."""
import html.parser
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["MSPSKEL_EXPERIMENTS"]
SOURCE = pathlib.Path(__file__).resolve().parents[2]


class Page(html.parser.HTMLParser):
    """Pictures, rows of cells, and whether every element is closed."""

    def __init__(self, text):
        super().__init__()
        self.pictures, self.rows, self.open = [], [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        if tag == "img":
            self.pictures.append(dict(attributes)["src"])
        elif tag != "meta":
            self.open.append(tag)
        if tag == "tr":
            self.rows.append([])

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if self.open and self.open[-1] in ("td", "th"):
            self.rows[-1].append(data)


class Experiments(unittest.TestCase):
    def run_program(self, *arguments):
        return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=300)

    def test_page_is_whole(self):
        with tempfile.TemporaryDirectory() as folder:
            result = self.run_program(folder, "capsule", "torus", "--resolution", 200)
            self.assertEqual(result.returncode, 0, result.stderr)
            root = pathlib.Path(folder)
            page = Page((root / "index.html").read_text(encoding="utf-8"))
            self.assertEqual(page.open, [])
            self.assertEqual({p.name for p in root.glob("*.png")}, set(page.pictures))
            for picture in page.pictures:
                self.assertEqual((root / picture).read_bytes()[:8], b"\x89PNG\r\n\x1a\n", picture)
            for name, genus in (("capsule", "0"), ("torus", "1")):
                rows = [row for row in page.rows if row[0] == name]
                self.assertEqual(rows[0][3], genus)
                cycles = [row[6] for row in rows if len(row) == 11 and row[1].endswith("mode")]
                self.assertEqual(cycles, [f"1, {genus}"] * 2)
            self.assertIn("](torus-skeletons.png)", (root / "index.md").read_text(encoding="utf-8"))

    def test_wrong_models_are_named(self):
        with tempfile.TemporaryDirectory() as folder:
            for models, status, word in ((["toros"], 1, "torus"), (["torus", "torus"], 1, "torus"),
                                         (["absent.off"], 2, "absent.off")):
                result = self.run_program(folder, *models, "--resolution", 200)
                self.assertEqual(result.returncode, status, result.stderr)
                self.assertIn(word, result.stderr)

    def test_pictures_of_the_documentation_exist(self):
        text = (SOURCE / "docs" / "experiments.md").read_text(encoding="utf-8")
        pictures = re.findall(r"\]\(([^)#:]+\.png)\)", text)
        self.assertGreater(len(pictures), 4)
        for picture in pictures:
            self.assertTrue((SOURCE / "docs" / picture).is_file(), picture)


if __name__ == "__main__":
    unittest.main()

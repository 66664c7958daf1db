"""scripts/sheet.py makes a page of pictures, and says which meshes failed."""
import re
import subprocess
import sys
import unittest

from program import PROGRAM, SOURCE, ProgramTest

# The program under another name is as good as another tool.
PEER = f"'{PROGRAM}' --quiet"


class Sheet(ProgramTest):
    def setUp(self):
        super().setUp()
        self.meshes = [self.sample("capsule"), self.sample("torus")]

    def sheet(self, *arguments):
        """Exit status, stderr and the page, if there is one."""
        result = subprocess.run([sys.executable, SOURCE / "scripts" / "sheet.py", "sheet", *arguments,
                                 "--program", PROGRAM], capture_output=True, text=True, cwd=self.folder, timeout=300)
        page = self.folder / "sheet" / "index.html"
        return result.returncode, result.stderr, page.read_text(encoding="utf-8") if page.is_file() else ""

    def assert_pictures_exist(self, page, names):
        self.assertEqual(re.findall(r'<img src="([^"]*)"', page), names)
        for name in names:
            self.assertEqual((self.folder / "sheet" / name).read_bytes()[:8], b"\x89PNG\r\n\x1a\n")

    def test_ours_beside_another_tool(self):
        status, errors, page = self.sheet(*self.meshes, "--peer", PEER)
        self.assertEqual((status, errors), (0, ""))
        self.assert_pictures_exist(page, ["capsule.png", "capsule.peer.png", "torus.png", "torus.peer.png"])
        self.assertEqual(len(re.findall(r"\d+ nodes, 2 leaves, 0 cycles", page)), 2)
        self.assertEqual(len(re.findall(r"\d+ nodes, 0 leaves, 1 cycles", page)), 2)

    def test_failure_is_reported_and_the_others_are_shown(self):
        bad = self.write("bad<1>.off", "OFF\n1 0 0\n0 0 0\n")
        status, errors, page = self.sheet(self.meshes[0], bad)
        self.assertEqual(status, 1)
        self.assertIn("bad<1>.off: mspskel: error: ", errors)
        self.assert_pictures_exist(page, ["capsule.png"])
        self.assertIn("bad&lt;1&gt;</td><td class=\"failure\">mspskel: error: ", page)

    def test_failure_of_the_other_tool_is_only_shown(self):
        status, errors, page = self.sheet(self.meshes[0], "--peer", "false")
        self.assertEqual((status, errors), (0, ""))
        self.assert_pictures_exist(page, ["capsule.png"])
        self.assertIn("exit status 1", page)

    def test_usage(self):
        self.assertEqual(self.sheet(self.meshes[0], "other/capsule.obj")[0], 2)
        self.assertEqual(self.sheet("sheet/mine.obj")[0], 2)
        self.assertEqual(self.sheet(self.meshes[0], "--peer", "./absent")[0], 2)


if __name__ == "__main__":
    unittest.main()

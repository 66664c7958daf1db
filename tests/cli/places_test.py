"""Where files go: never over an input or another output; replaced files keep their mode and their links."""
import os
import stat
import subprocess
import unittest

from program import DONE, MESH, PROGRAM, TETRAHEDRON, USAGE, WRITE, ProgramTest


class Refused(ProgramTest):
    """The name says which file is meant, by whatever path it is reached."""

    def setUp(self):
        super().setUp()
        # Never read: a mesh that were read would be refused with another status.
        self.mesh = self.write("s.obj", "no mesh")
        (self.folder / "sub").mkdir()
        os.symlink("../s.obj", self.folder / "sub" / "link.obj")
        os.link(self.folder / "s.obj", self.folder / "hard.obj")
        os.symlink("made.skel", self.folder / "dangling.skel")

    def refused(self, *arguments, stdin=b""):
        message = self.fail_with(USAGE, *arguments, stdin=stdin)
        self.assertEqual((self.folder / "s.obj").read_text(), "no mesh")
        return message

    def test_output_that_is_the_input(self):
        for name in ["s.obj", "./s.obj", "sub/../s.obj", "sub/link.obj", "hard.obj", self.folder / "s.obj"]:
            self.assertIn("the mesh", self.refused("s.obj", name))
            self.assertIn("the mesh", self.refused(name, "a.skel", "s.obj"))
            self.assertIn("the mesh", self.refused("s.obj", "a.skel", "--report", name))
        self.refused("s.obj", "a.skel", "--stages", "s.obj")

    def test_default_output_that_is_the_input(self):
        self.write("s.skel", "no mesh")
        self.refused("s.skel")

    def test_file_of_the_stages_that_is_the_input(self):
        (self.folder / "msp.ply").write_text("no mesh")
        self.refused("msp.ply", "a.skel", "--stages", ".")

    def test_streams_that_the_shell_leads_to_the_input(self):
        for words, streams in [(["s.obj", "-"], {"stdout": "ab"}), (["-", "s.obj"], {"stdin": "rb"})]:
            files = {name: open(self.folder / "s.obj", mode) for name, mode in streams.items()}
            result = subprocess.run([PROGRAM, *words], cwd=self.folder, stderr=subprocess.PIPE, **files)
            for file in files.values():
                file.close()
            self.assertEqual(result.returncode, USAGE, result.stderr)
            self.assertEqual((self.folder / "s.obj").read_text(), "no mesh")

    def test_two_outputs_at_one_place(self):
        for one, other in [("a.skel", "./a.skel"), ("a.skel", "sub/../a.skel"), ("made.skel", "dangling.skel"),
                           ("-", "-")]:
            self.assertIn("is given twice as an output", self.refused("s.obj", one, other))
            self.assertIn("the report", self.refused("s.obj", one, "--report", other))
        self.refused("s.obj", "p/msp.csv.json", "--report", "p/../p/msp.csv.json")
        self.refused("s.obj", "a.ply", "s/msp.ply", "--stages", "s")
        self.refused("s.obj", "a.skel", "--stages", "a.skel")

    def test_other_commands(self):
        self.write("k.skel", "no skeleton")
        os.link(self.folder / "k.skel", self.folder / "k.png")
        self.assertIn("the skeleton", self.refused("render", "s.obj", "k.skel", "k.png"))
        os.link(self.folder / "s.obj", self.folder / "s.png")
        self.assertIn("the mesh", self.refused("render", "s.obj", "s.png"))
        self.assertIn("the mesh", self.refused("check", "s.obj", "k.skel", "--json", "hard.obj"))
        self.assertIn("the skeleton", self.refused("check", "s.obj", "k.skel", "--json", "k.skel"))
        self.assertIn("standard input", self.refused("check", "-", "-"))


class Kept(ProgramTest):
    def test_mode_bits_and_links_of_a_replaced_file(self):
        mesh = self.sample()
        for mode in (0o600, 0o664, 0o755):
            self.write("a.skel", "older")
            os.chmod(self.folder / "a.skel", mode)
            self.succeed(mesh, "a.skel")
            self.assertEqual(stat.S_IMODE(os.stat(self.folder / "a.skel").st_mode), mode)
            self.assertNotEqual((self.folder / "a.skel").read_text(), "older")
        (self.folder / "sub").mkdir()
        os.symlink("../target.skel", self.folder / "sub" / "link.skel")
        self.succeed(mesh, "sub/link.skel")
        self.assertTrue(os.path.islink(self.folder / "sub" / "link.skel"))
        self.assertTrue((self.folder / "target.skel").is_file())

    def test_write_protected_files(self):
        # The mesh is none: that the file is protected shows before the work.
        self.write("no.off", "no mesh")
        for name in ("kept.skel", "kept.off"):
            self.write(name, "older")
            os.chmod(self.folder / name, 0o444)
        os.symlink("kept.skel", self.folder / "link.skel")
        for arguments in (["kept.skel"], ["a.skel", "kept.skel"], ["link.skel"], ["a.skel", "--report", "kept.skel"]):
            self.assertIn("write-protected", self.fail_with(WRITE, "no.off", *arguments))
        self.assertIn("write-protected", self.fail_with(WRITE, "sample", "tee", "kept.off"))
        for name in ("kept.skel", "kept.off"):
            self.assertEqual((self.folder / name).read_text(), "older")

    def test_devices_may_be_named_twice(self):
        self.succeed(self.sample(), "a.skel", "--report", "/dev/null")
        os.symlink("/dev/null", self.folder / "n.skel")
        os.symlink("/dev/null", self.folder / "n.obj")
        self.succeed("capsule.off", "n.skel", "n.obj", "--report", "/dev/null")


class LeftBehind(ProgramTest):
    def test_folder_of_the_stages_goes_with_a_failure(self):
        self.write("open.off", TETRAHEDRON.replace("4 4 0", "4 3 0").replace("3 2 0 3\n", ""))
        self.fail_with(MESH, "open.off", "a.skel", "--stages", "s/t", "--repair", "off")

    def test_folder_that_cannot_be_made_shows_before_the_work(self):
        self.write("t.off", "no mesh")
        self.fail_with(WRITE, "t.off", "a.skel", "--stages", "t.off/s")

    def test_stages_that_cannot_be_written_leave_nothing(self):
        mesh = self.sample()
        (self.folder / "s").mkdir()
        (self.folder / "s" / "error.ply").mkdir()
        before = self.files()
        result = self.run_program(mesh, "a.skel", "--stages", "s")
        self.assertEqual(result.returncode, WRITE, result.stderr)
        self.assertEqual(self.files(), before)


@unittest.skipUnless(os.path.exists("/dev/full"), "no /dev/full here")
class FullDisk(ProgramTest):
    def status(self, *arguments):
        with open("/dev/full", "wb") as full:
            result = subprocess.run([PROGRAM, *arguments], stdout=full, stderr=subprocess.PIPE, cwd=self.folder)
        return result.returncode

    def test_everything_that_prints(self):
        mesh = self.sample()
        self.succeed(mesh, "a.skel")
        for words in [["check", mesh, "a.skel"], ["check", mesh, "a.skel", "--json", "-"], ["--help"], ["--version"],
                      ["check", "--help"], ["sample", "--help"], [mesh, "-"], [mesh, "b.skel", "--report", "-"],
                      ["render", mesh, "-", "--width=16", "--height=16"]]:
            self.assertEqual(self.status(*words), WRITE, words)
        self.assertEqual(self.status("check", mesh, "a.skel", "-q"), DONE)


if __name__ == "__main__":
    unittest.main()

"""Every way to fail has its exit status, names the culprit, and leaves no file."""
import os
import signal
import subprocess
import time
import unittest

from program import CANCELLED, MESH, PROGRAM, READ, TETRAHEDRON, USAGE, WRITE, ProgramTest


class Reading(ProgramTest):
    def test_absent_file(self):
        self.assertIn("absent.off", self.fail_with(READ, "absent.off", "a.skel"))

    def test_folder(self):
        (self.folder / "folder.off").mkdir()
        self.fail_with(READ, "folder.off", "a.skel")

    def test_empty_file(self):
        self.fail_with(READ, self.write("empty.off", ""), "a.skel")

    def test_garbage_names_file_and_line(self):
        message = self.fail_with(READ, self.write("bad.off", TETRAHEDRON.replace("3 1 2 3", "3 1 2 x")), "a.skel")
        self.assertIn("bad.off", message)
        self.assertIn("9", message)

    def test_index_out_of_range(self):
        self.fail_with(READ, self.write("bad.off", TETRAHEDRON.replace("3 1 2 3", "3 1 2 4")), "a.skel")

    def test_more_announced_than_there_is(self):
        self.fail_with(READ, self.write("bad.off", TETRAHEDRON.replace("4 4 0", "4 2000000000 0")), "a.skel")

    def test_absent_mesh_or_skeleton_of_the_other_commands(self):
        self.write("t.off", TETRAHEDRON)
        self.fail_with(READ, "render", "absent.off", "a.png")
        self.fail_with(READ, "render", "t.off", "absent.skel", "a.png")
        self.fail_with(READ, "check", "absent.off", "absent.skel")
        self.fail_with(READ, "check", "t.off", "absent.skel")


class Meshes(ProgramTest):
    def test_open_mesh(self):
        text = TETRAHEDRON.replace("4 4 0", "4 3 0").replace("3 2 0 3\n", "")
        message = self.fail_with(MESH, self.write("open.off", text), "a.skel", "--repair", "off")
        self.assertRegex(message, r"closed|open|boundary")

    def test_edge_with_three_faces(self):
        text = TETRAHEDRON.replace("4 4 0", "5 5 0").replace("0 0 1\n", "0 0 1\n1 1 1\n") + "3 0 1 4\n"
        self.fail_with(MESH, self.write("fin.off", text), "a.skel", "--repair", "off")

    def test_no_faces(self):
        self.fail_with(MESH, self.write("points.off", "OFF\n1 0 0\n0 0 0\n"), "a.skel")


class Writing(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("t.off", TETRAHEDRON)

    def test_absent_folder(self):
        self.assertIn("absent", self.fail_with(WRITE, "t.off", "absent/a.skel"))

    def test_folder_in_place_of_the_file(self):
        (self.folder / "a.skel").mkdir()
        self.fail_with(WRITE, "t.off", "a.skel")

    def test_picture_report_and_stages(self):
        self.fail_with(WRITE, "render", "t.off", "absent/a.png")
        self.fail_with(WRITE, "sample", "sphere", "absent/a.off")
        self.fail_with(WRITE, "t.off", "-q", "a.skel", "--report", "absent/a.json")
        self.fail_with(WRITE, "t.off", "-q", "a.skel", "--stages", "t.off/stages")

    @unittest.skipUnless(os.path.exists("/dev/full"), "no /dev/full here")
    def test_full_disk(self):
        with open("/dev/full", "wb") as full:
            result = subprocess.run([PROGRAM, "sample", "sphere", "-"], stdout=full, stderr=subprocess.PIPE,
                                    cwd=self.folder)
        self.assertEqual(result.returncode, WRITE, result.stderr)


class Ending(ProgramTest):
    # Large enough for seconds of work.
    SLOW = ["--mode", "thesis", "--slices", "400", "--cone-directions", "200", "--threads", "1"]

    def test_time_limit(self):
        mesh = self.sample("torus", 20000)
        start = time.monotonic()
        message = self.fail_with(CANCELLED, mesh, "a.skel", *self.SLOW, "--time-limit", "0.3", "--report", "r.json",
                                 "--stages", "s")
        self.assertIn("time limit", message)
        self.assertLess(time.monotonic() - start, 30)

    def test_memory_limit(self):
        mesh = self.sample("torus", 100000)
        message = self.run_program(mesh, "a.skel", "--max-memory", "60")
        if b"the program alone takes" in message.stderr:
            self.skipTest("built with a sanitizer, which takes memory of its own")
        self.assertIn("60 MB of --max-memory", self.fail_with(CANCELLED, mesh, "a.skel", "--max-memory", "60"))
        self.assertIn("the program alone", self.fail_with(USAGE, mesh, "a.skel", "--max-memory", "0.001"))
        # No thread is asked for that cannot be had.
        for limit in ["1", "5", "15", "25"]:
            result = self.run_program(mesh, "a.skel", "--max-memory", limit, "--threads", "2")
            self.assertIn(result.returncode, (USAGE, CANCELLED))
            self.assertRegex(result.stderr.decode(), "the program alone takes|MB of --max-memory")

    def test_interrupt_leaves_an_older_result_as_it_was(self):
        mesh = self.sample("torus", 20000)
        self.write("a.skel", "older")
        before = self.files()
        for number in [signal.SIGINT, signal.SIGTERM, signal.SIGHUP]:
            process = subprocess.Popen([PROGRAM, mesh, "a.skel", *self.SLOW, "--report", "r.json", "--stages", "s"],
                                       cwd=self.folder, stderr=subprocess.PIPE)
            time.sleep(0.5)
            process.send_signal(number)
            _, message = process.communicate(timeout=60)
            self.assertEqual(process.returncode, CANCELLED, message)
            self.assertIn(b"interrupted", message)
            self.assertEqual(self.files(), before)
            self.assertEqual((self.folder / "a.skel").read_text(), "older")

    def test_standard_output_that_nobody_reads(self):
        mesh = self.sample("torus", 500)
        before = self.files()
        process = subprocess.Popen([PROGRAM, mesh, "-", "b.swc"], cwd=self.folder, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE)
        process.stdout.close()
        message = process.stderr.read()
        process.stderr.close()
        self.assertEqual(process.wait(timeout=60), WRITE, message)
        self.assertIn(b"standard output", message)
        self.assertEqual(self.files(), before)

    def test_interrupt_while_files_are_written(self):
        """Nobody reads what goes to standard output, so the writing does not end by itself."""
        mesh = self.sample("torus", 20000)
        self.write("a.skel", "older")
        before = self.files()
        process = subprocess.Popen([PROGRAM, mesh, "a.skel", "a.html", "--write-mesh", "b.off", "--stages", "s",
                                    "--report", "r.json", "--segments", "-"], cwd=self.folder,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.stderr.close)
        end = time.monotonic() + 60
        while not (self.folder / "r.json.part0").exists() and time.monotonic() < end:
            time.sleep(0.02)
        time.sleep(0.2)
        self.assertIsNone(process.poll())
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(timeout=60), CANCELLED)
        self.assertIn(b"interrupted", process.stderr.read())
        self.assertEqual(self.files(), before)
        self.assertEqual((self.folder / "a.skel").read_text(), "older")

    def test_outputs_appear_together_or_not_at_all(self):
        if not os.path.exists("/dev/full"):
            self.skipTest("no /dev/full here")
        mesh = self.sample()
        self.fail_with(WRITE, mesh, "a.skel", "a.html", "--stages", "s", "--report", "/dev/full")


if __name__ == "__main__":
    unittest.main()

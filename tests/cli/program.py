"""Runs the program under test. The tests are given its path in the environment variable MSPSKEL_PROGRAM."""
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["MSPSKEL_PROGRAM"]
SOURCE = pathlib.Path(__file__).resolve().parents[2]

DONE, USAGE, READ, MESH, WRITE, NO_SKELETON, CANCELLED = range(7)


def messages(stderr):
    """What the program says but for the lines of progress, which show where a run lasts."""
    return re.sub(r"^mspskel: \d+ %, .*\n", "", stderr.decode(), flags=re.MULTILINE)


TETRAHEDRON = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n"


class ProgramTest(unittest.TestCase):
    """Every test has a folder of its own, which is the program's working directory."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="mspskel-cli-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def run_program(self, *arguments, stdin=b""):
        if isinstance(stdin, str):
            stdin = stdin.encode()
        return subprocess.run([PROGRAM, *map(str, arguments)], input=stdin, capture_output=True, cwd=self.folder,
                              timeout=120)

    def succeed(self, *arguments, stdin=b""):
        result = self.run_program(*arguments, stdin=stdin)
        self.assertEqual((result.returncode, messages(result.stderr)), (DONE, ""))
        return result.stdout

    def fail_with(self, status, *arguments, stdin=b""):
        """The message. Nothing may have gone to stdout, and no file may have been left behind."""
        before = self.files()
        result = self.run_program(*arguments, stdin=stdin)
        message = messages(result.stderr)
        self.assertEqual(result.returncode, status, message)
        self.assertEqual(result.stdout, b"")
        self.assertTrue(message.startswith("mspskel: error: "), message)
        self.assertEqual(self.files(), before)
        return message

    def files(self):
        return sorted(p.relative_to(self.folder).as_posix() for p in self.folder.rglob("*"))

    def write(self, name, text):
        (self.folder / name).write_text(text)
        return name

    def sample(self, name="capsule", resolution=200):
        """A small mesh file."""
        file = f"{name}.off"
        self.succeed("sample", name, file, "--resolution", resolution)
        return file

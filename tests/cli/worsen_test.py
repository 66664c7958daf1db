"""scripts/worsen.py: samples made worse keep their pieces, loops and leaves."""
import subprocess
import sys
import unittest

from program import PROGRAM, SOURCE, ProgramTest


class Worsen(ProgramTest):
    def test_torn_turned_doubled_split_and_pinched_samples_have_the_skeleton_of_the_clean_one(self):
        result = subprocess.run([sys.executable, "-B", SOURCE / "scripts" / "worsen.py", "--program", PROGRAM, "--short",
                                 "--resolution", "2500"], capture_output=True, text=True, timeout=300)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        self.assertIn("pieces and loops 28 of 28", result.stdout)


if __name__ == "__main__":
    unittest.main()

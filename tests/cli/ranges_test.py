"""Ranges in --help are true: both ends of every number give a right skeleton, in both modes.

The options are read from --help, so that none is forgotten.
"""
import re
import unittest

from program import DONE, ProgramTest

# What an option of a method that is not the default needs to have an effect.
COMPANIONS = {
    "--moving-samples": ["--point", "sampled-force"],
    "--force-samples": ["--point", "sampled-force"],
    "--displacement": ["--point", "sampled-force"],
    "--force-step": ["--point", "sampled-force"],
    "--merge-radius": ["--point", "sampled-force"],
    "--starts": ["--point", "force"],
    "--cone-threshold": ["--slice-method", "sampling"],
    "--cone-directions": ["--slice-method", "sampling"],
    "--cone-min-angle": ["--slice-method", "sampling", "--cone-threshold", "0", "--cone-max-angle", "89"],
    "--cone-max-angle": ["--slice-method", "sampling", "--cone-threshold", "0", "--cone-min-angle", "0"],
    "--saturation": ["--bare-edges", "saturation"],
    "--filter-ball": ["--filter"],
    "--limb-vertices": ["--coarse-vertices", "60"],
    "--parts": ["--segments", "parts.seg"],
    "--parts": ["--segments", "a.seg"],
    "--joints": ["--bent", "bent.off"],
}
# An end that is only a longer computation is tried at this value: the range's end would take minutes.
SHORTER = {"--slices": "100", "--force-samples": "1000", "--moving-samples": "200", "--starts": "100",
           "--cone-directions": "60", "--search-spread": "100", "--threads": "8"}
NOT_OF_THE_SKELETON = {"--time-limit"}
SAMPLES = [("torus", 120), ("y-tube", 200), ("hopf-link", 210)]


def numbers(text):
    """(option, [low, high]) of every number in a --help."""
    for entry in re.split(r"\n(?=  -)", text):
        words = " ".join(entry.split())
        name = re.match(r"(?:-\w,)?(--[\w-]+) N ", words)
        span = re.search(r"; (?:(\S+) to (\S+)|at least (\S+)) \[", words)
        if name and span:
            yield name[1], [span[1] or span[3], span[2] or "1e300"]


class Ranges(ProgramTest):
    def test_help_is_understood(self):
        text = self.succeed("--help-all").decode()
        self.assertEqual(len(list(numbers(text))), len(re.findall(r"^  (?:-\w,)?--[\w-]+ N\b", text, re.M)))
        self.assertGreater(len(list(numbers(text))), 25)

    def one(self, mesh, mode, options):
        """What is wrong with the skeleton that these options give; empty if nothing."""
        words = [mesh, "a.skel", "--mode", mode, *options]
        if "--threads" not in options:
            words += ["--threads", "1"]
        result = self.run_program(*words)
        problem = result.stderr.decode()
        if result.returncode == DONE:
            # The thesis does not promise to stay inside.
            share = "0" if mode == "thesis" else "1"
            result = self.run_program("check", mesh, "a.skel", "--threads", "1", "--least-inside", share, "-q")
            problem = result.stderr.decode()
        return f"{' '.join(words)}\n  {problem}" if result.returncode != DONE else ""

    def test_both_ends_of_every_range(self):
        wrong = []
        options = dict(numbers(self.succeed("--help-all").decode()))
        for sample, vertices in SAMPLES:
            mesh = self.sample(sample, vertices)
            for mode in ["default", "thesis"]:
                for name, ends in options.items():
                    if name in NOT_OF_THE_SKELETON:
                        continue
                    for end, value in zip(("low", "high"), ends):
                        if end == "high":
                            value = SHORTER.get(name, value)
                        wrong.append(self.one(mesh, mode, [*COMPANIONS.get(name, []), name, value]))
        wrong = [text for text in wrong if text]
        if wrong:
            self.fail("\n".join(wrong))


if __name__ == "__main__":
    unittest.main()

"""README.md and docs/command_line.md say what the program does.

--update writes docs/command_line.md from the program's --help.
"""
import re
import shlex
import shutil
import subprocess
import sys
import unittest

from program import PROGRAM, SOURCE, ProgramTest

PAGE = SOURCE / "docs" / "command_line.md"
COMMANDS = ["sample", "render", "check", "convert", "info", "completion", "man"]


def page():
    """What docs/command_line.md must be."""
    text = "# The command line\n\nWhat `--help` prints, command by command; of the first one `--help-all`.\n"
    for command in ["", *COMMANDS]:
        words = [command, "--help"] if command else ["--help-all"]
        printed = subprocess.run([PROGRAM, *words], capture_output=True, text=True, check=True).stdout
        text += f"\n## mspskel {command}".rstrip() + f"\n\n```text\n{printed.strip()}\n```\n"
    return text


class Documentation(ProgramTest):
    def test_page_is_what_help_prints(self):
        self.maxDiff = None
        self.assertEqual(PAGE.read_text(encoding="utf-8"), page())

    def test_examples_of_the_readme_run(self):
        readme = (SOURCE / "README.md").read_text(encoding="utf-8")
        examples = re.findall(r"^build/mspskel (.*)$", readme, re.MULTILINE)
        self.assertGreater(len(examples), 4)
        shutil.copytree(SOURCE / "data", self.folder / "data")
        (self.folder / "out").mkdir()
        for example in examples:
            result = self.run_program(*shlex.split(example, comments=True))
            self.assertEqual(result.returncode, 0, f"{example}\n{result.stderr.decode()}")

    def test_files_that_the_readme_names_exist(self):
        readme = (SOURCE / "README.md").read_text(encoding="utf-8")
        for name in re.findall(r"`((?:base|mesh|slice|center|collapse|graph|io)/\w+\.h)`", readme):
            self.assertTrue((SOURCE / "include" / "mspskel" / name).is_file(), name)
        for name in re.findall(r"\]\(([^)#:]+)\)", readme):
            self.assertTrue((SOURCE / name).is_file(), name)
        for name in re.findall(r"^(scripts/\S+)", readme, re.MULTILINE):
            self.assertTrue((SOURCE / name).is_file(), name)


if __name__ == "__main__":
    if sys.argv[1:] == ["--update"]:
        PAGE.write_text(page(), encoding="utf-8")
    else:
        unittest.main()

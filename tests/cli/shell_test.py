"""What shells and man are told of the program agrees with --help."""
import re
import shutil
import subprocess
import unittest

from program import PROGRAM, ProgramTest

COMMANDS = ["", "sample", "render", "check", "convert", "info", "completion", "man"]


class Shell(ProgramTest):
    def printed(self, *words):
        return self.succeed(*words).decode()

    def options(self, command):
        """Every option that --help shows of a command, both ways of a toggle."""
        words = [command] if command else []
        text = self.printed(*words, "--help" if command else "--help-all")
        found = set()
        for line in re.findall(r"^  (-.*)$", text, re.MULTILINE):
            spelling = line.split(" ")[0]
            for name in spelling.split(","):
                found |= {name.replace("[no-]", ""), name.replace("[no-]", "no-")}
        self.assertIn("--help", found)
        return found

    def test_man_page_has_every_option(self):
        page = self.printed("man").replace("\\-", "-")
        sections = re.split(r'^\.S[HS] "?(?:mspskel )?', page, flags=re.MULTILINE)
        for command in filter(None, COMMANDS):
            section = next(s for s in sections if s.startswith(f'{command}"'))
            for option in self.options(command):
                self.assertRegex(section, rf"\\fB{option}\\fR", f"{command} {option}")
        for option in self.options(""):
            self.assertRegex(page.split(".SH COMMANDS")[0], rf"\\fB{option}\\fR", option)
        for sample in ["torus", "trefoil", "quadruped"]:
            self.assertIn(sample, page)

    @unittest.skipUnless(shutil.which("man"), "man is not installed")
    def test_man_shows_the_page_without_warnings(self):
        (self.folder / "mspskel.1").write_bytes(self.succeed("man"))
        result = subprocess.run(["man", "--warnings", "-E", "ascii", "-l", "-Tascii", "mspskel.1"], cwd=self.folder,
                                capture_output=True, text=True, timeout=60)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("--smallest", re.sub(r".\x08|\x1b\[\d*m", "", result.stdout))

    def test_scripts_parse(self):
        for shell in ["bash", "zsh", "fish"]:
            with self.subTest(shell):
                if not shutil.which(shell):
                    self.skipTest(f"{shell} is not installed")
                result = subprocess.run([shell, "-n"], input=self.succeed("completion", shell), capture_output=True,
                                        timeout=60)
                self.assertEqual((result.returncode, result.stderr), (0, b""))

    def in_bash(self, *words):
        """What bash offers in place of the last of the words."""
        (self.folder / "script").write_bytes(self.succeed("completion", "bash"))
        driver = """source ./script
            function=$(complete -p mspskel | sed 's/.*-F \\([^ ]*\\).*/\\1/')
            COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
            $function mspskel "${COMP_WORDS[COMP_CWORD]}" "${COMP_WORDS[COMP_CWORD-1]}" && printf '%s\\n' "${COMPREPLY[@]}"
        """
        result = subprocess.run(["bash", "-c", driver, "bash", "mspskel", *words], cwd=self.folder, text=True,
                                capture_output=True, timeout=60)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return set(result.stdout.split())

    def test_bash_completes(self):
        self.write("mesh.off", "")
        self.write("with space.off", "")
        (self.folder / "folder").mkdir()
        self.assertEqual(self.in_bash("che"), {"check"})
        self.assertEqual(self.in_bash("mesh"), {"mesh.off"})
        self.assertEqual(self.in_bash("a.off", "--for", "ne"), {"neurons"})
        self.assertEqual(self.in_bash("a.off", "--for", "=", "ne"), {"neurons"})
        self.assertEqual(self.in_bash("a.off", "--for", "="), self.in_bash("a.off", "--for", ""))
        self.assertEqual(self.in_bash("a.off", "--smal"), {"--smallest", "--smallest-handle"})
        self.assertEqual(self.in_bash("a.off", "--threads", ""), set())
        self.assertEqual(self.in_bash("a.off", "--report", "me"), {"mesh.off"})
        self.assertEqual(self.in_bash("a.off", "--stages", ""), {"folder"})
        self.assertEqual(self.in_bash("sample", "tor"), {"torus"})
        self.assertEqual(self.in_bash("sample", "torus", "mesh"), {"mesh.off"})
        self.assertEqual(self.in_bash("check", "a.off", "--js"), {"--json"})
        self.assertEqual(self.in_bash("completion", ""), {"bash", "zsh", "fish"})
        self.assertEqual(self.in_bash("wi"), {"with", "space.off"})  # one word, which the space splits here

    def test_bash_offers_every_option(self):
        for command in COMMANDS:
            words = [command] if command else ["a.off"]
            self.assertEqual(self.in_bash(*words, "-"), self.options(command), command)

    @unittest.skipUnless(shutil.which("fish"), "fish is not installed")
    def test_fish_completes(self):
        (self.folder / "script").write_bytes(self.succeed("completion", "fish"))
        for typed, wanted in [("che", "check"), ("a.off --for ne", "neurons"), ("a.off --smal", "--smallest"),
                              ("sample tor", "torus"), ("check a.off --js", "--json"), ("a.off --no-coa", "--no-coarsen")]:
            offered = subprocess.run(["fish", "-N", "-c", f"source script; complete -C 'mspskel {typed}'"],
                                     cwd=self.folder, text=True, capture_output=True, timeout=60).stdout
            self.assertIn(wanted, re.split(r"[\t\n]", offered), typed)

    @unittest.skipUnless(shutil.which("zsh"), "zsh is not installed")
    def test_zsh_completes(self):
        """In a shell of its own, at a prompt, as zsh completes nowhere else."""
        (self.folder / "_mspskel").write_bytes(self.succeed("completion", "zsh"))
        # Tab completes; then the line is made one that prints it.
        (self.folder / "drive").write_text(r"""
            zmodload zsh/zpty
            wait_for_prompt() {
              local all= seen=
              while [[ $all != *'[prompt]'* ]]; do zpty -r -t z seen && all+=$seen; sleep 0.02; done
              print -r -- $all
            }
            zpty -b z zsh -f -i
            zpty -w z 'PS1="[prompt""]"; fpath=($PWD $fpath); autoload -Uz compinit; compinit -u -D; bindkey "^I" complete-word'
            wait_for_prompt
            for typed in "che" "a.off --for ne" "a.off --smal" "sample trefo" "check a.off --js"; do
              sleep 0.1
              zpty -n -w z "mspskel $typed"$'\t\x01print -r SEEN \x05\n'
              wait_for_prompt
            done
            zpty -d z
        """)
        offered = subprocess.run(["zsh", "-f", "drive"], cwd=self.folder, text=True, capture_output=True,
                                 timeout=60).stdout
        for wanted in ["check", "a.off --for neurons", "a.off --smallest", "sample trefoil", "check a.off --json"]:
            self.assertRegex(offered, rf"SEEN mspskel {wanted} ?\s")

    def test_unknown_shell(self):
        self.assertIn("did you mean bash?", self.fail_with(1, "completion", "bsh"))


if __name__ == "__main__":
    unittest.main()

"""--for: what a preset sets, and that what is given comes before it, wherever it stands."""
import json
import re
import unittest

from program import SOURCE, USAGE, ProgramTest


class Presets(ProgramTest):
    def presets(self):
        """Words of each preset, from --help-all."""
        text = self.succeed("--help-all").decode()
        text = text[text.index("What --for sets"):]
        rows = re.findall(r"^  (\w+) +[^:\n]+: (.*)$", text.split("\n\n")[0], re.MULTILINE)
        return {kind: [] if words == "the defaults" else words.split() for kind, words in rows}

    def settings(self, *words):
        report = self.succeed(self.mesh, "-", "--report", "report.json", "-q", "-t", "1", *words)
        options = json.loads((self.folder / "report.json").read_text())["options"]
        options.pop("for")
        return options, report

    def setUp(self):
        super().setUp()
        self.mesh = self.sample("capsule", 300)

    def test_a_preset_is_the_options_that_help_names(self):
        presets = self.presets()
        self.assertEqual(set(presets), {"general", "vessels", "neurons", "plants", "cad", "characters"})
        for kind, words in presets.items():
            self.assertEqual(self.settings("--for", kind), self.settings(*words), kind)
            self.assertEqual(bool(words), kind != "general")

    def test_given_options_come_first_wherever_they_stand(self):
        for given in [["--smallest", "0.02", "--for", "neurons"], ["--for", "neurons", "--smallest=0.02"]]:
            options, _ = self.settings(*given)
            self.assertEqual((options["smallest"], options["detail"]), (0.02, 2))
        # A default that is given is given, too.
        for given in [["--coarsen", "--for", "vessels"], ["--for", "vessels", "--coarsen"]]:
            self.assertIs(self.settings(*given)[0]["coarsen"], True)

    def test_unknown_kind(self):
        self.assertIn("did you mean neurons?", self.fail_with(USAGE, self.mesh, "--for", "neuron"))

    def test_the_page_has_what_is_set(self):
        text = (SOURCE / "docs" / "presets.md").read_text(encoding="utf-8")
        for kind, words in self.presets().items():
            self.assertIn(f"| `{kind}` | {'`' + ' '.join(words) + '`' if words else 'the defaults'} |", text)


if __name__ == "__main__":
    unittest.main()

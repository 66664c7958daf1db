"""Arguments: what is wrong with them is said by name, with the nearest good one, and ends with status 1."""
import re
import unittest

from program import READ, USAGE, ProgramTest


class Usage(ProgramTest):
    def test_unknown_option_is_answered_with_the_nearest(self):
        message = self.fail_with(USAGE, "a.off", "--slises", "5")
        self.assertIn("--slises", message)
        self.assertIn("did you mean --slices?", message)

    def test_unknown_option_with_a_value_behind_an_equals_sign(self):
        self.assertIn("did you mean --threads?", self.fail_with(USAGE, "a.off", "--thread=2"))

    def test_unknown_option_far_from_all(self):
        message = self.fail_with(USAGE, "a.off", "--xylophone")
        self.assertIn("--xylophone", message)
        self.assertNotIn("did you mean", message)

    def test_no_arguments(self):
        self.assertIn("usage", self.fail_with(USAGE))

    def test_missing_value(self):
        self.assertIn("--slices", self.fail_with(USAGE, "a.off", "--slices"))

    def test_value_out_of_range_names_option_and_range(self):
        message = self.fail_with(USAGE, "a.off", "--slices", "0")
        self.assertIn("--slices", message)
        self.assertIn("1 to 1000", message)

    def test_value_that_is_no_number(self):
        for value in ["many", "nan", "1e", "0x10", ""]:
            self.assertIn("--slices", self.fail_with(USAGE, "a.off", f"--slices={value}"))

    def test_fraction_for_a_whole_number(self):
        self.assertIn("--slices", self.fail_with(USAGE, "a.off", "--slices", "2.5"))

    def test_unknown_mode_is_answered_with_the_nearest(self):
        self.assertIn("did you mean thesis?", self.fail_with(USAGE, "a.off", "--mode", "theses"))

    def test_unknown_output_extension_shows_before_the_mesh_is_read(self):
        self.assertIn("a.xyz", self.fail_with(USAGE, "absent.off", "a.xyz"))

    def test_a_mesh_may_be_named_like_a_command(self):
        self.write("check", "no mesh at all\n")
        self.assertIn("./check", self.fail_with(READ, "./check", "a.skel"))

    def test_words_after_two_dashes_are_arguments(self):
        self.write("-q", "no mesh at all\n")
        self.assertIn("-q", self.fail_with(READ, "--", "-q", "a.skel"))
        self.assertIn("-q", self.fail_with(READ, "--threads", "1", "--", "-q"))
        self.assertIn("check", self.fail_with(READ, "--", "check", "a.skel"))
        self.assertIn("absent", self.fail_with(READ, "check", "--", "absent.off", "a.skel"))
        self.assertIn("too many", self.fail_with(USAGE, "check", "--", "a", "b", "--json"))

    def test_an_empty_word_is_an_argument(self):
        self.assertIn("too many", self.fail_with(USAGE, "info", "a.off", ""))

    def test_unknown_sample(self):
        self.assertIn("did you mean torus?", self.fail_with(USAGE, "sample", "toros"))
        self.assertIn("--help", self.fail_with(USAGE, "sample", "xylophone"))

    def test_mistyped_command(self):
        self.assertIn("did you mean check?", self.fail_with(USAGE, "chekc", "a.off", "a.skel"))
        self.assertIn("did you mean render?", self.fail_with(USAGE, "rendr", "a.off", "a.png"))
        self.assertNotIn("did you mean", self.fail_with(READ, "xylophone", "a.skel"))
        self.write("chekc", "no mesh at all\n")
        self.assertNotIn("did you mean", self.fail_with(READ, "chekc", "a.skel"))

    def test_unknown_extensions_are_answered_with_the_nearest(self):
        for output, near in [("a.skl", ".skel"), ("a.htlm", ".html"), ("a.gbl", ".glb"), ("a.polyline.txt", ".polylines.txt"),
                             ("folder.skel/a.swcc", ".swc")]:
            message = self.fail_with(USAGE, "absent.off", output)
            self.assertIn(f"did you mean {near}?", message)
        self.assertNotIn("did you mean", self.fail_with(USAGE, "absent.off", "a.xyz"))
        self.assertIn("did you mean .off?", self.fail_with(USAGE, "sample", "torus", "a.of"))
        self.assertIn("did you mean .graphml?", self.fail_with(USAGE, "convert", "a.skel", "a.grapml"))
        self.assertIn("did you mean .seg?", self.fail_with(USAGE, "a.off", "--segments", "a.sge"))

    def test_render_wants_a_png(self):
        self.assertIn("b.jpg", self.fail_with(USAGE, "render", "a.off", "b.jpg"))
        self.fail_with(USAGE, "render", "a.off")
        self.fail_with(USAGE, "render", "a", "b", "c", "d.png")

    def test_check_wants_two_files(self):
        self.fail_with(USAGE, "check", "a.off")

    def test_help_of_every_command(self):
        for command in [[], ["sample"], ["render"], ["check"], ["convert"], ["info"], ["completion"], ["man"]]:
            text = self.succeed(*command, "--help").decode()
            self.assertIn("Usage: mspskel", text)
            self.assertLessEqual(max(map(len, text.splitlines())), 100)
            self.assertEqual(text, self.succeed(*command, "-h").decode())

    def test_short_help_has_what_people_need(self):
        def options(text):
            return re.findall(r"^  (-\S+)", text, re.MULTILINE)

        short, full = self.succeed("--help").decode(), self.succeed("--help-all").decode()
        self.assertLess(len(options(short)), 18)
        self.assertGreater(len(options(full)), 60)
        self.assertLessEqual(set(options(short)), set(options(full)))
        self.assertGreaterEqual(len(re.findall(r"^  mspskel \S+\.\w+ ", short, re.MULTILINE)), 2)  # examples

    def test_version_names_the_libraries(self):
        text = self.succeed("--version").decode()
        for word in ["mspskel 0.", "OpenMesh", "Eigen", "GLM", "CLI11", "nlohmann-json", "OpenMP", "CGAL"]:
            self.assertIn(word, text)


if __name__ == "__main__":
    unittest.main()

#include "mspskel/base/near_name.h"

#include <catch2/catch.hpp>

using namespace mspskel;

TEST_CASE("typing errors are a distance: letters left out, put in, mistaken or swapped") {
  const std::vector<std::string> words{"", "a", "check", "chekc", "chec", "cheeck", "render", "sample"};
  for (const std::string& a : words) {
    for (const std::string& b : words) {
      CHECK(typing_errors(a, b) == typing_errors(b, a));
      CHECK((typing_errors(a, b) == 0) == (a == b));
      CHECK(typing_errors(a, b) <= std::max(a.size(), b.size()));
    }
    CHECK(typing_errors(a, "") == a.size());
  }
  for (const char* once : {"chec", "chekc", "cheeck", "chexk"}) CHECK(typing_errors(once, "check") == 1);
}

TEST_CASE("the nearest name is one that was meant, or none") {
  const std::vector<std::string> known{"--saturation", "--slices", "--threads", "--root"};
  for (const std::string& name : known) CHECK(nearest_name(name, known) == name);
  CHECK(nearest_name("--slises", known) == "--slices");
  CHECK(nearest_name("--sat", known) == "--saturation");
  CHECK(nearest_name("--rot", known) == "--root");
  CHECK(nearest_name("--xylophone", known).empty());
  CHECK(nearest_name("--root", {}).empty());
  CHECK(did_you_mean("--slises", known) == "; did you mean --slices?");
  CHECK(did_you_mean("--xylophone", known).empty());
}

TEST_CASE("an unknown extension is answered with those that are known, and the nearest") {
  const std::vector<std::string> known{".skel", ".obj", ".polylines.txt"};
  const auto message = [&](const char* path) {
    return std::string(unknown_extension("format", path, known).what());
  };
  CHECK(
      message("a.skl") ==
      "cannot tell the format of a.skl: known extensions are .skel .obj .polylines.txt; did you mean .skel?");
  CHECK(message("folder.skel/a.polyline.txt").find("did you mean .polylines.txt?") != std::string::npos);
  for (const char* path : {"a", "a.xyz", "folder.skel/a", ""})
    CHECK(message(path).find("did you mean") == std::string::npos);
}

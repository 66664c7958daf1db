#include "root_option.h"

#include <algorithm>
#include <charconv>

#include "mspskel/base/counted.h"
#include "mspskel/base/error.h"

namespace mspskel::cli {
namespace {

// Numbers with commas between them.
bool parse_numbers(const std::string& text, std::size_t at, double* values, int count) {
  const char *from = text.data() + at, *end = text.data() + text.size();
  for (int k = 0; k < count; ++k) {
    const auto [stop, error] = std::from_chars(from, end, values[k]);
    if (error != std::errc() || (k + 1 < count ? stop == end || *stop != ',' : stop != end)) return false;
    from = stop + 1;
  }
  return true;
}

}  // namespace

void RootOption::add_to(CommandLine& line) {
  line.text(
      "--root", text, "thickest|tip|open|open:K|point:X,Y,Z",
      "where trees (.swc) and centrelines (.vtp) begin: the thickest node, the thickest end, the end at "
      "the widest opening (the thickest end where nothing is open), that at the K-th one (from 0, as "
      "the report lists them), the node nearest to a point");
}

RootChoice RootOption::resolve(const std::vector<Opening>& openings) const {
  RootChoice choice;
  if (text == "thickest") return choice;
  choice.kind = RootChoice::Kind::kTip;
  if (text == "tip") return choice;
  if (text == "open") {
    const auto widest =
        std::max_element(openings.begin(), openings.end(),
                         [](const Opening& a, const Opening& b) { return a.radius < b.radius; });
    if (widest == openings.end()) return choice;
    choice.kind = RootChoice::Kind::kPoint;
    choice.point = widest->centre;
    return choice;
  }
  choice.kind = RootChoice::Kind::kPoint;
  double numbers[3] = {0, 0, 0};
  if (text.rfind("point:", 0) == 0 && parse_numbers(text, 6, numbers, 3)) {
    choice.point = Vector3(numbers[0], numbers[1], numbers[2]);
    if (choice.point.allFinite()) return choice;
  }
  if (text.rfind("open:", 0) == 0 && parse_numbers(text, 5, numbers, 1) && numbers[0] >= 0 &&
      numbers[0] == static_cast<double>(static_cast<std::size_t>(std::min(numbers[0], 1e9)))) {
    const auto k = static_cast<std::size_t>(numbers[0]);
    if (k >= openings.size())
      throw UsageError("--root: the mesh has " +
                       counted(static_cast<long long>(openings.size()), "open end") + ", counted from 0");
    choice.point = openings[k].centre;
    return choice;
  }
  throw UsageError("--root: expected thickest, tip, open, open:K or point:X,Y,Z, not '" + text + "'");
}

}  // namespace mspskel::cli

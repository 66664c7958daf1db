#include <cmath>

#include "families.h"
#include "grow_tree.h"

namespace mspskel::detail {

namespace {

using Rule = TreeRule (*)(const SampleOptions&);

Family tree_family(const SampleInfo& info, Rule rule,
                   const std::function<void(SampleInfo&, const SampleOptions&)>& adapt) {
  return {
      info,
      [rule](const SampleOptions& o) { return skin_graph_by_width(grow_tree(rule(o)).graph, o.resolution); },
      adapt, [rule](const SampleOptions& o) { return grow_tree(rule(o)).truth; }};
}

// A tree of that many tips has twice as many branches.
void set_tips(SampleInfo& info, Index tips) {
  info.leaves = tips + 1;
  info.resolution = 400 * tips;
  info.least_resolution = 250 * tips;
}

Family tree() {
  const SampleInfo info = with_ratio(with_count(facts("tree", "a random tree of tubes", 0, 21, 8000, 5000),
                                                "tips, besides the root", 20, 4, 5000),
                                     "width of the root / width of a tip", 20, 2, 40);
  const auto rule = [](const SampleOptions& o) {
    TreeRule r;
    r.tips = o.count;
    r.exponent = std::log(o.ratio) / std::log(static_cast<double>(o.count));
    r.seed = o.seed;
    return r;
  };
  return tree_family(info, rule, [](SampleInfo& i, const SampleOptions& o) { set_tips(i, o.count); });
}

// Of bifurcating tubes, each 0.76 times as wide as the one before.
Family airway() {
  const SampleInfo info = with_count(facts("airway", "tubes that fork again and again", 0, 17, 6400, 4000),
                                     "generations of forks", 4, 1, 9);
  const auto rule = [](const SampleOptions& o) {
    TreeRule r;
    r.tips = Index{1} << o.count;
    r.exponent = 0.4;
    r.evenness = 0.5;
    r.seed = o.seed;
    return r;
  };
  return tree_family(info, rule,
                     [](SampleInfo& i, const SampleOptions& o) { set_tips(i, Index{1} << o.count); });
}

}  // namespace

std::vector<Family> tree_families() { return {tree(), airway()}; }

}  // namespace mspskel::detail

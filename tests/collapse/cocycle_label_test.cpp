// Labels form a group, and their rank is that of the integer matrix they make.
#include "mspskel/collapse/cocycle_label.h"

#include <catch2/catch.hpp>
#include <random>

#include "mspskel/collapse/label_rank.h"

using namespace mspskel;

namespace {
CocycleLabel random_label(std::mt19937& random, Index size, int range) {
  CocycleLabel label;
  for (Index i = 0; i < size; ++i)
    label +=
        CocycleLabel::unit(i, static_cast<int>(random() % (2 * static_cast<unsigned>(range) + 1)) - range);
  return label;
}
}  // namespace

TEST_CASE("labels are an abelian group") {
  std::mt19937 random(1);
  for (int round = 0; round < 200; ++round) {
    const CocycleLabel a = random_label(random, 5, 2), b = random_label(random, 5, 2),
                       c = random_label(random, 5, 2);
    CHECK((a + b) + c == a + (b + c));
    CHECK(a + b == b + a);
    CHECK((a - a).is_zero());
    CHECK(a + -b == a - b);
    CHECK(-(-a) == a);
    for (Index i = 0; i < 5; ++i) CHECK((a + b)[i] == a[i] + b[i]);
  }
}

TEST_CASE("a label keeps no zero components") {
  const CocycleLabel a = CocycleLabel::unit(3, 2) + CocycleLabel::unit(1, -1);
  REQUIRE(a.entries().size() == 2);
  CHECK(a.entries()[0] == CocycleLabel::Entry{1, -1});
  CHECK((a + CocycleLabel::unit(3, -2)).entries().size() == 1);
  CHECK(CocycleLabel::unit(7, 0).is_zero());
}

TEST_CASE("a label that leaves 32 bits is an error, not a wrong loop") {
  const CocycleLabel large = CocycleLabel::unit(0, std::numeric_limits<std::int32_t>::max());
  CHECK_THROWS_AS(large + large, UsageError);
}

TEST_CASE("the rank counts independent labels") {
  LabelRank rank;
  CHECK_FALSE(rank.insert({}));
  CHECK(rank.insert(CocycleLabel::unit(4, 2)));
  CHECK_FALSE(rank.insert(CocycleLabel::unit(4, -3)));
  CHECK(rank.insert(CocycleLabel::unit(0) + CocycleLabel::unit(4)));
  CHECK(rank.depends(CocycleLabel::unit(0, 7)));
  CHECK_FALSE(rank.depends(CocycleLabel::unit(9)));
  CHECK(rank.rank() == 2);
}

TEST_CASE("sums of independent labels are dependent") {
  std::mt19937 random(2);
  for (int round = 0; round < 50; ++round) {
    LabelRank rank;
    std::vector<CocycleLabel> kept;
    for (int i = 0; i < 6; ++i) {
      CocycleLabel label = random_label(random, 6, 3);
      if (rank.insert(label)) kept.push_back(label);
    }
    CocycleLabel sum;
    for (const CocycleLabel& label : kept)
      for (unsigned times = random() % 4; times > 0; --times) sum += label;
    CHECK(rank.depends(sum));
    CHECK(rank.rank() == static_cast<Index>(kept.size()));
  }
}

// Closed test models by name, with known answers, at any resolution.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mspskel/mesh/polygon_soup.h"
#include "mspskel/skeleton/curve_skeleton.h"

namespace mspskel {

enum class Section { kOwn, kSquare, kRound };

struct SampleOptions {
  Index resolution = 0;  // wanted number of vertices, met to about 20 %; 0: the sample's default
  bool sparse =
      false;          // long triangles where the surface is flat or bent one way; of those vertices few stay
  double jitter = 0;  // random displacement of every vertex, in mean edge lengths before `sparse`, [0, 0.3]
  std::uint64_t seed = 1;  // of jitter and of the vertices' places on the surface
  Index count = kNone;     // what it counts is the sample's affair (SampleInfo::count_of); kNone: its default
  double ratio = 0;        // of two of its lengths (SampleInfo::ratio_of); 0: the sample's default
  Vector3 sides = Vector3::Zero();  // lengths along x, y and z where SampleInfo::has_sides; 0: the default
  Section section = Section::kOwn;  // of the bars where SampleInfo::has_sections; kOwn: the sample's default
};

struct SampleInfo {
  std::string name;
  std::string description;  // one line
  Index genus = 0;          // summed over the components
  Index components = 1;
  Index leaves = kNone;     // ends of its skeleton, kNone where that is a matter of taste
  Index resolution = 2000;  // default and least number of vertices
  Index least_resolution = 20;
  std::string count_of;  // empty: --count has no meaning for this sample
  Index count = 0, least_count = 0, most_count = 0;
  std::string ratio_of;  // empty: --ratio has no meaning for this sample
  double ratio = 0, least_ratio = 0, most_ratio = 0;
  bool has_sides = false;  // whether sides are its own affair to choose
  Vector3 sides = Vector3::Zero();
  bool has_sections = false;  // whether its bars may be square or round
  Section section = Section::kOwn;
  bool has_truth = false;  // whether sample_truth knows its skeleton
};

// All samples in the order of their names, with the facts for default options.
std::vector<SampleInfo> list_samples();

// The facts of one sample for given options: genus, components, leaves and the default and least resolution
// follow from count and ratio. Throws UsageError for an unknown name (naming the nearest one) or a value out
// of range.
SampleInfo describe_sample(const std::string& name, const SampleOptions& options = {});

// Makes the sample: closed, manifold, oriented outward (cavities inward), without self-intersections while
// jitter is 0. The same arguments give the same bytes. Throws UsageError as describe_sample does, and where
// the resolution is too low for the shape.
PolygonSoup make_sample(const std::string& name, const SampleOptions& options = {});

// The skeleton that the sample was made round, in the sample's place; resolution and jitter do not change it.
// A leaf lies on the axis of its limb, a quarter of the limb's half width below the surface. A node's radius
// is half of the width of its part: at a joint that of the widest part that meets there, so that arcs are a
// matter of taste nearer to a joint than its radius. The surface map is empty. Throws UsageError as
// describe_sample does, and for a sample without a defined skeleton: a shell, a plate, a ball.
CurveSkeleton sample_truth(const std::string& name, const SampleOptions& options = {});

}  // namespace mspskel

// One input of a target with what has to hold for it.
#pragma once

#include <functional>
#include <utility>

#include "fuzz/mending_laws.h"

namespace mspskel::fuzz {

struct Trial {
  FuzzedMesh mesh;
  std::function<Outcome(Choices&)> check;  // throws Broken
};

// Closed meshes for the pipeline, or soups for mending and then the pipeline.
inline Trial make_trial(bool soups, Choices& choices) {
  if (!soups) {
    FuzzedInput input = make_input(choices);
    FuzzedMesh mesh = input.mesh;
    return {std::move(mesh), [input = std::move(input)](Choices& c) { return check_pipeline(input, c); }};
  }
  SoupInput input = make_soup_input(choices);
  FuzzedMesh mesh = input.mesh;
  return {std::move(mesh), [input = std::move(input)](Choices& c) { return check_soup_input(input, c); }};
}

}  // namespace mspskel::fuzz

// The known name that a mistyped one was meant to be, and messages that say so.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <string>
#include <vector>

#include "mspskel/base/error.h"

namespace mspskel {

// Typing errors between two words: letters left out, put in, mistaken or swapped with the next one. Cost: the
// product of their lengths.
inline std::size_t typing_errors(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before, last(b.size() + 1), row(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before = last;
    last = row;
  }
  return last[b.size()];
}

// The entry of `known` that is the fewest typing errors away, the first of several; empty if all are further
// than one error and than a third of the word.
inline std::string nearest_name(const std::string& word, const std::vector<std::string>& known) {
  std::string best;
  std::size_t fewest = std::max<std::size_t>(1, word.size() / 3) + 1;
  for (const std::string& candidate : known) {
    // A beginning of a name counts as one error: --sat means --saturation.
    const bool begins = word.size() > 3 && candidate.compare(0, word.size(), word) == 0;
    const std::size_t errors = begins ? 1 : typing_errors(word, candidate);
    if (errors >= fewest) continue;
    fewest = errors;
    best = candidate;
  }
  return best;
}

// "; did you mean NAME?", or nothing: what a message about an unknown name ends with.
inline std::string did_you_mean(const std::string& word, const std::vector<std::string>& known) {
  const std::string near = nearest_name(word, known);
  return near.empty() ? "" : "; did you mean " + near + "?";
}

// What to throw where a path's ending is none of `known`, each with its dot; `what` is what cannot be told.
inline UsageError unknown_extension(const std::string& what, const std::string& path,
                                    const std::vector<std::string>& known) {
  std::string message = "cannot tell the " + what + " of " + path + ": known extensions are", near;
  for (const std::string& extension : known) message += " " + extension;
  const std::size_t folders = path.find_last_of('/');
  std::size_t dot = path.find('.', folders == std::string::npos ? 0 : folders + 1);
  for (; dot != std::string::npos && near.empty(); dot = path.find('.', dot + 1))
    near = did_you_mean(path.substr(dot), known);
  return UsageError(message + near);
}

}  // namespace mspskel

// The figures of one study as PNG files.
#pragma once

#include <string>
#include <vector>

#include "study.h"

namespace mspskel::experiments {

// Which figure of a study; file names are NAME-<word>.png.
struct Picture {
  std::string word;
  std::string caption;
};

// All of them, in the order of chapter 5.
const std::vector<Picture>& pictures();

// NAME-<word>.png
std::string picture_file(const std::string& study, const std::string& word);

// Draws and writes all pictures of a study into a folder. Throws WriteError.
void write_pictures(const Study& study, const std::string& folder, const Execution& execution);

// Time over the number of planes, all studies in one chart (Table 5.1): time-over-planes.png.
void write_time_chart(const std::vector<Study>& studies, const std::string& folder);

}  // namespace mspskel::experiments

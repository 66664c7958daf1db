// The commands of the program. Each takes the words after its name and returns the exit status.
#pragma once

#include <string>
#include <vector>

namespace mspskel::cli {

int extract_command(const std::vector<std::string>& arguments);
int sample_command(const std::vector<std::string>& arguments);
int render_command(const std::vector<std::string>& arguments);
int check_command(const std::vector<std::string>& arguments);
int convert_command(const std::vector<std::string>& arguments);
int info_command(const std::vector<std::string>& arguments);

// The version of the program and of the libraries that it was built with.
std::string version_text();

}  // namespace mspskel::cli

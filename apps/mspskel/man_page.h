// The manual page, from the tables of the commands.
#pragma once

#include <string>

namespace mspskel::cli {

// mspskel(1) in roff: every command with all its options.
std::string man_page();

}  // namespace mspskel::cli

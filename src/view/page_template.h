#pragma once

#include <string_view>

namespace mspskel::detail {

// viewer/dist/page.html, which the build turns into a source file; see src/view/embed_page.cmake.
std::string_view page_template();

}  // namespace mspskel::detail

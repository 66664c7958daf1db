// mspskel IN OUT.html: what a run found, as a page.
#pragma once

#include "mspskel/extract_skeleton.h"
#include "report.h"

namespace mspskel::cli {

// By extension, in any case.
bool is_page(const std::string& path);

// `report` is that of make_report or with_costs.
void write_page(const std::string& path, const std::string& input, const ExtractResult& result,
                const Json& report);

}  // namespace mspskel::cli

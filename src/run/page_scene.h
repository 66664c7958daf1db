// What a run found, as a page to look at.
#pragma once

#include "checked_extraction.h"
#include "mspskel/rig/rig.h"
#include "mspskel/segment/segment_surface.h"
#include "mspskel/view/viewer_page.h"
#include "report.h"

namespace mspskel::cli {

// Whether the path is that of a page: by extension, in any case.
bool is_page(const std::string& path);

// `input` is the mesh's file, or - for standard input; `made` has its full certificate (CertificateDepth);
// `report` is that of make_report or with_costs.
// Parts and rig are those given, or else made as the options' defaults have them; without a skeleton there
// are none. Throws Cancelled.
ViewerScene make_page_scene(const std::string& input, const CheckedExtraction& made, const Json& report,
                            const Segmentation* parts = nullptr, const Rig* rig = nullptr,
                            const Execution& execution = {});

}  // namespace mspskel::cli

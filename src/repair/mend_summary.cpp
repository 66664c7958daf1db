#include "mspskel/repair/mend_soup.h"

namespace mspskel {

std::string summary(const MendedSoup& mended) {
  std::string text;
  const auto add = [&](Index count, const char* one, const char* many) {
    if (count > 0)
      text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + (count == 1 ? one : many);
  };
  const MendCounts& c = mended.counts;
  const auto openings = static_cast<Index>(mended.openings.size());
  add(c.welded_points, "point welded", "points welded");
  add(c.degenerate_faces, "degenerate face dropped", "degenerate faces dropped");
  add(c.repeated_faces, "repeated face dropped", "repeated faces dropped");
  add(c.two_sided_faces, "face cancelled by its opposite", "faces cancelled by their opposites");
  add(c.thickened_faces, "of them thickened", "of them thickened");
  add(c.flap_faces, "triangle of flaps dropped", "triangles of flaps dropped");
  add(c.turned_faces, "triangle turned over", "triangles turned over");
  add(c.paired_edges, "edge of more than two faces resolved", "edges of more than two faces resolved");
  add(c.one_sided_edges, "edge of a one-sided surface cut", "edges of a one-sided surface cut");
  add(c.split_vertices, "vertex split", "vertices split");
  add(c.split_edges, "edge that touched itself split", "edges that touched each other split");
  add(c.holes - openings, "hole closed", "holes closed");
  add(openings, "open end capped", "open ends capped");
  add(c.joined_pieces, "piece joined to the one it touches", "pieces joined to those they touch");
  add(c.flat_components, "piece without volume dropped", "pieces without volume dropped");
  add(c.small_components, "crumb dropped", "crumbs dropped");
  return text;
}

}  // namespace mspskel

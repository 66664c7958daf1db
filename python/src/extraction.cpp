#include "extraction.h"

#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/vector.h>

#include <filesystem>
#include <limits>
#include <memory>

#include "arrays.h"
#include "bindings.h"
#include "mspskel/base/stopwatch.h"
#include "mspskel/io/read_mesh.h"
#include "mspskel/render/render.h"
#include "mspskel/skeleton/check_skeleton.h"
#include "options.h"
#include "page_scene.h"
#include "watched_run.h"

namespace mspskel::python {
namespace {

Index checked_index(std::int64_t i) {
  if (i < std::numeric_limits<Index>::min() || i > std::numeric_limits<Index>::max())
    throw MeshError("faces: vertex " + std::to_string(i) + " is beyond what a mesh can have");
  return static_cast<Index>(i);
}

template <class Integer>
PolygonSoup soup_of_rows(const Points& points, const Rows<Integer>& faces) {
  PolygonSoup soup;
  soup.points = copied(points);
  const std::size_t corners = faces.shape(1);
  soup.corners.reserve(faces.size());
  soup.begin.reserve(faces.shape(0) + 1);
  for (std::size_t f = 0; f < faces.shape(0); ++f) {
    for (std::size_t k = 0; k < corners; ++k) soup.corners.push_back(checked_index(faces(f, k)));
    soup.begin.push_back(checked_index(static_cast<std::int64_t>(soup.corners.size())));
  }
  return soup;
}

// Polygons as VTK keeps them: offsets into one list of corners.
PolygonSoup soup_of_polygons(const Points& points, const List<std::int64_t>& offsets,
                             const List<std::int64_t>& corners) {
  PolygonSoup soup;
  soup.points = copied(points);
  soup.begin.clear();
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    if (offsets(i) < (i == 0 ? 0 : offsets(i - 1)) || offsets(i) > static_cast<std::int64_t>(corners.size()))
      throw MeshError("offsets: entry " + std::to_string(i) + " is no place in the list of corners");
    soup.begin.push_back(checked_index(offsets(i)));
  }
  if (soup.begin.empty() || soup.begin.front() != 0) throw MeshError("offsets: expected to begin with 0");
  for (std::size_t i = 0; i < corners.size(); ++i) soup.corners.push_back(checked_index(corners(i)));
  return soup;
}

std::unique_ptr<Extraction> extract(const PolygonSoup& soup, const std::string& name, Options options,
                                    nb::object progress) {
  WatchedRun watched(std::move(progress), options.run.time_limit);
  options.run.extract.execution.progress = watched.progress();
  return watched.run([&] {
    auto extraction = std::make_unique<Extraction>();
    const Stopwatch total;
    cli::MeshInput input = cli::prepare_mesh(soup, options.run.repair, options.run.extract.execution);
    extraction->seconds.read = total.seconds();
    extraction->made =
        cli::extract_checked(soup, std::move(input), options.run, cli::CertificateDepth::kVerdict);
    if (!extraction->made.failure.empty() && !options.keep_failed)
      throw NoSkeletonError(extraction->made.failure + " (keep_failed=True returns it all the same)");
    extraction->skeleton = extraction->made.input.of_file(extraction->made.result.skeleton);
    extraction->name = name;
    extraction->options = options.values;
    extraction->seconds.total = total.seconds();
    return extraction;
  });
}

std::vector<double> in_model_units(const Extraction& self, const std::vector<double>& lengths) {
  std::vector<double> values = lengths;
  for (double& value : values) value *= self.made.result.surface.frame.scale;
  return values;
}

std::vector<Vector3> to_model(const Extraction& self, const std::vector<Vector3>& points) {
  std::vector<Vector3> values;
  values.reserve(points.size());
  for (const Vector3& x : points) values.push_back(self.made.result.surface.frame.to_model(x));
  return values;
}

View<double> surface_points(const Extraction& self) {
  const DefaultMesh& mesh = self.made.input.built.mesh;
  return View<double>(mesh.points()->data(), {mesh.n_vertices(), 3}, nb::find(self));
}

View<Index> surface_faces(const Extraction& self) {
  const std::vector<Index>& corners = self.made.result.surface.origin;
  return View<Index>(corners.data(), {corners.size() / 3, 3}, nb::find(self));
}

View<double> contour_of(const Extraction& self, Index vertex) {
  const ExtractResult& result = self.made.result;
  if (vertex < 0 || vertex >= result.surface.vertex_count())
    throw UsageError("vertex: expected 0 to " + std::to_string(result.surface.vertex_count() - 1) + ", not " +
                     std::to_string(vertex));
  Contour contour;
  slice_contour(SliceTracer(result.surface), result.slices, vertex, contour);
  return given_away(to_model(self, contour.point));
}

std::string checks_text(const Extraction& self, const CurveSkeleton& skeleton) {
  const nb::gil_scoped_release unlocked;
  const ExtractResult& result = self.made.result;
  const CurveSkeleton own = self.made.input.of_surface(skeleton);
  const SolidHierarchies solids(result.surface, *result.solid);
  const SkeletonChecks checks = check_skeleton(result.surface, solids, own);
  const TopologyCertificate certificate =
      cli::certify(result.surface, result.cocycles, solids, own, cli::CertificateDepth::kFull);
  return cli::report_text(
      cli::checks_json(checks, certificate, find_uncovered_parts(result.surface, solids, own)));
}

std::string facts_text(Extraction& self) {
  const nb::gil_scoped_release unlocked;
  return cli::report_text(self.facts());
}

// What --report writes.
std::string report_text(Extraction& self) {
  const nb::gil_scoped_release unlocked;
  return cli::report_text(cli::with_costs(self.facts(), self.options, self.made.result, self.seconds));
}

std::string certificate_of(Extraction& self) {
  const nb::gil_scoped_release unlocked;
  return cli::report_text(cli::certificate_json(self.full_certificate()));
}

nb::bytes page_of(Extraction& self) {
  std::string page;
  {
    const nb::gil_scoped_release unlocked;
    const cli::Json facts = self.facts();  // completes the certificate
    page = format_viewer_page(cli::make_page_scene(self.name, self.made, facts));
  }
  return nb::bytes(page.data(), page.size());
}

nb::bytes glb_of(const Extraction& self) {
  std::string bytes;
  {
    const nb::gil_scoped_release unlocked;
    bytes = format_glb(self.scene());
  }
  return nb::bytes(bytes.data(), bytes.size());
}

void bind_soup(nb::module_& module) {
  nb::class_<PolygonSoup>(module, "Soup", "Polygons that share points.")
      .def_prop_ro("points", [](const PolygonSoup& s) { return view(s.points, nb::find(s)); })
      .def_prop_ro("offsets", [](const PolygonSoup& s) { return view(s.begin, nb::find(s)); })
      .def_prop_ro("corners", [](const PolygonSoup& s) { return view(s.corners, nb::find(s)); });
  module.def(
      "read_soup",
      [](const std::string& path) {
        const nb::gil_scoped_release unlocked;
        return read_polygon_soup(path);
      },
      nb::arg("path"));
  module.def("soup_of_rows", &soup_of_rows<std::int32_t>, nb::arg("points"), nb::arg("faces").noconvert());
  module.def("soup_of_rows", &soup_of_rows<std::int64_t>, nb::arg("points"), nb::arg("faces"));
  module.def("soup_of_polygons", &soup_of_polygons, nb::arg("points"), nb::arg("offsets"),
             nb::arg("corners"));
}

}  // namespace

const TopologyCertificate& Extraction::full_certificate() {
  std::call_once(certified_, [this] {
    const ExtractResult& result = made.result;
    made.certificate =
        cli::certify(result.surface, result.cocycles, SolidHierarchies(result.surface, *result.solid),
                     result.skeleton, cli::CertificateDepth::kFull);
  });
  return made.certificate;
}

cli::Json Extraction::facts() {
  full_certificate();
  return cli::facts_of(name, made);
}

GlbScene Extraction::scene() const {
  return {std::filesystem::path(name).filename().string(), to_polygon_soup(made.result.surface),
          made.result.skeleton};
}

void bind_extraction(nb::module_& module) {
  bind_soup(module);
  module.def("extract", &extract, nb::arg("soup"), nb::arg("name"), nb::arg("options"),
             nb::arg("progress") = nb::none());
  using Self = const Extraction&;
  nb::class_<Extraction>(module, "Extraction",
                         "What a run made; arrays are per vertex of the closed surface.")
      .def_prop_ro(
          "skeleton", [](Self self) -> const CurveSkeleton& { return self.skeleton; },
          nb::rv_policy::reference_internal)
      .def_prop_ro("failure", [](Self self) { return self.made.failure; })
      .def_prop_ro("warnings", [](Self self) { return self.made.result.warnings; })
      .def_prop_ro("renumbered", [](Self self) { return self.made.input.renumbered(); })
      .def_prop_ro("vertex_of_point",
                   [](Self self) { return view(self.made.input.vertex_of_point, nb::find(self)); })
      .def("facts", &facts_text)
      .def("report", &report_text)
      .def("certificate", &certificate_of)
      .def("check", &checks_text, nb::arg("skeleton"))
      .def("glb", &glb_of)
      .def("page", &page_of)
      .def_prop_ro("seconds", [](Self self) { return self.made.result.seconds; })
      .def_prop_ro("vertices", &surface_points)
      .def_prop_ro("faces", &surface_faces)
      .def_prop_ro(
          "msp",
          [](Self self) { return given_away(in_model_units(self, self.made.result.slices.perimeter)); },
          nb::rv_policy::automatic)
      .def_prop_ro("slice_error",
                   [](Self self) { return view(self.made.result.slices.error, nb::find(self)); })
      .def_prop_ro("slice_normal",
                   [](Self self) { return view(self.made.result.slices.normal, nb::find(self)); })
      .def_prop_ro("slice_valid",
                   [](Self self) { return view(self.made.result.slices.valid, nb::find(self)); })
      .def_prop_ro(
          "skeletal_points",
          [](Self self) { return given_away(to_model(self, self.made.result.skeleton_mesh.position)); },
          nb::rv_policy::automatic)
      .def("contour", &contour_of, nb::arg("vertex"));
}

}  // namespace mspskel::python

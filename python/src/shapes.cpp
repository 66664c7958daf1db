// Parts and rigs of what a run made.
#include <nanobind/stl/array.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/vector.h>

#include <memory>
#include <tuple>

#include "arrays.h"
#include "bindings.h"
#include "extraction.h"
#include "mspskel/io/write_glb.h"
#include "mspskel/render/render.h"
#include "mspskel/rig/make_rig.h"
#include "mspskel/segment/segment_surface.h"

namespace mspskel::python {
namespace {

// A joint's name, the axis it turns round, and degrees.
using Turns = std::vector<std::tuple<std::string, std::array<double, 3>, double>>;

struct RiggedSurface {
  Rig rig;
  GlbScene scene;
  std::vector<Vector3> positions;  // of the joints
  std::vector<Index> parents, nodes, twins, joints_of_vertices;
  std::vector<double> weights;

  std::vector<JointTurn> turns(const Turns& given) const {
    std::vector<JointTurn> result;
    for (const auto& [name, axis, angle] : given) {
      // The parser knows what to say of a name that is none.
      JointTurn turn = parse_joint_turn(rig, name + "=x,0");
      turn.axis = {axis[0], axis[1], axis[2]};
      turn.angle = angle;
      result.push_back(turn);
    }
    return result;
  }
};

std::unique_ptr<RiggedSurface> rig_of(const Extraction& self, Index joints) {
  const nb::gil_scoped_release unlocked;
  const ExtractResult& result = self.made.result;
  RigOptions options;
  options.joints = joints;
  auto made = std::make_unique<RiggedSurface>();
  made->rig = make_rig(result.surface, result.skeleton, options);
  made->scene = self.scene();
  for (const RigJoint& joint : made->rig.joints) {
    made->positions.push_back(joint.position);
    made->parents.push_back(joint.parent);
    made->nodes.push_back(joint.node);
    made->twins.push_back(joint.twin);
  }
  for (const auto& influences : made->rig.influences)
    for (const Influence& influence : influences) {
      made->joints_of_vertices.push_back(influence.joint);
      made->weights.push_back(influence.weight);
    }
  return made;
}

nb::bytes glb_of(const RiggedSurface& self, const Turns& turns) {
  std::string bytes;
  {
    const nb::gil_scoped_release unlocked;
    bytes = format_rigged_glb(self.scene, self.rig, self.turns(turns));
  }
  return nb::bytes(bytes.data(), bytes.size());
}

Segmentation segment(const Extraction& self, Index parts) {
  const nb::gil_scoped_release unlocked;
  SegmentOptions options;
  options.parts.count = parts;
  const ExtractResult& result = self.made.result;
  return segment_surface(result.surface, result.skeleton, options, result.coarse ? &*result.coarse : nullptr);
}

template <class Value>
View<Value> fours(const std::vector<Value>& values, nb::handle owner) {
  return View<Value>(values.data(), {values.size() / 4, 4}, owner);
}

}  // namespace

void bind_shapes(nb::module_& module) {
  nb::class_<Segmentation>(module, "Segmentation", "Parts of a surface.")
      .def_ro("count", &Segmentation::count)
      .def_prop_ro("part_of_face",
                   [](const Segmentation& self) { return view(self.part_of_face, nb::find(self)); })
      .def_prop_ro("part_of_node",
                   [](const Segmentation& self) { return view(self.part_of_node, nb::find(self)); });
  nb::class_<RiggedSurface>(module, "RiggedSurface", "A surface with joints.")
      .def_prop_ro("names",
                   [](const RiggedSurface& self) {
                     std::vector<std::string> names;
                     for (const RigJoint& joint : self.rig.joints) names.push_back(joint.name);
                     return names;
                   })
      .def_prop_ro("positions",
                   [](const RiggedSurface& self) { return view(self.positions, nb::find(self)); })
      .def_prop_ro("parents", [](const RiggedSurface& self) { return view(self.parents, nb::find(self)); })
      .def_prop_ro("nodes", [](const RiggedSurface& self) { return view(self.nodes, nb::find(self)); })
      .def_prop_ro("twins", [](const RiggedSurface& self) { return view(self.twins, nb::find(self)); })
      .def_prop_ro("joints_of_vertices",
                   [](const RiggedSurface& self) { return fours(self.joints_of_vertices, nb::find(self)); })
      .def_prop_ro("weights", [](const RiggedSurface& self) { return fours(self.weights, nb::find(self)); })
      .def_prop_ro("cut", [](const RiggedSurface& self) { return view(self.rig.cut, nb::find(self)); })
      .def(
          "bend",
          [](const RiggedSurface& self, const Turns& turns) {
            std::vector<Vector3> points;
            {
              const nb::gil_scoped_release unlocked;
              points = bend(self.rig, self.scene.surface.points, self.turns(turns));
            }
            return given_away(std::move(points));
          },
          nb::arg("turns"))
      .def("glb", &glb_of, nb::arg("turns"))
      .def("text", [](const RiggedSurface& self) {
        const nb::gil_scoped_release unlocked;
        return format_rig_text(self.rig);
      });
  module.def("rig", &rig_of, nb::arg("extraction"), nb::arg("joints"));
  module.def("segment", &segment, nb::arg("extraction"), nb::arg("parts"));
}

}  // namespace mspskel::python

#include "app/python/binding/vessel.h"

#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <Eigen/Geometry>
#include <filesystem>
#include <map>

#include "app/python/binding/arrays.h"
#include "app/python/binding/bindings.h"
#include "core/base/field_numbers.h"
#include "data/catalogue/case/case.h"
#include "data/formats/load_error.h"
#include "vascular/geometry/mesh/length_unit.h"
#include "vascular/geometry/mesh_files/formats.h"

namespace ostium::python {

namespace {

using app::RunSetup;
using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
using Triangles = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;

std::string key_of(const RunSetup& setup) {
  std::uint64_t h = core::hash_bytes(setup.case_text.data(), setup.case_text.size(), 1);
  h = core::hash_bytes(setup.shape.data(), setup.shape.size(), h);
  h = core::hash_bytes(setup.mesh.vertices.data(), setup.mesh.vertices.size() * sizeof(Eigen::Vector3d), h);
  h = core::hash_bytes(setup.mesh.triangles.data(), setup.mesh.triangles.size() * sizeof(std::array<int, 3>), h);
  h = core::hash_bytes(setup.entry.p_P.data(), 3 * sizeof(double), h);
  h = core::hash_bytes(setup.entry.towards_P.data(), 3 * sizeof(double), h);
  return fmt::format("{} {:016x} {}", setup.vessel, h, setup.person ? std::to_string(*setup.person) : "own");
}

std::shared_ptr<const VesselHandle> of_case(const std::string& name, std::optional<std::uint64_t> person) {
  RunSetup setup;
  if (vascular::names_mesh(name))
    throw py::value_error(name + ": is a mesh; expected a case, or Vessel.from_mesh(path, unit, entry, towards)");
  set_vessel(name, vascular::LengthUnit::millimetre, setup);
  setup.person = person;
  return VesselHandle::of(std::move(setup));
}

std::shared_ptr<const VesselHandle> of_mesh(const std::filesystem::path& path, const std::string& unit,
                                            const Eigen::Vector3d& entry, const Eigen::Vector3d& towards) {
  if (!entry.allFinite() || !towards.allFinite()) throw py::value_error("entry and towards have to be finite");
  RunSetup setup;
  const vascular::LengthUnit length = vascular::unit_named(unit);
  set_vessel(path.string(), length, setup);
  if (!setup.is_mesh()) throw py::value_error(path.string() + ": is a case; expected a mesh, or Vessel(name)");
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : setup.mesh.vertices) box.extend(p);
  constexpr double shortest_m = 5e-3, longest_m = 3;
  if (const double long_m = box.sizes().maxCoeff(); long_m < shortest_m || long_m > longest_m)
    throw py::value_error(fmt::format("{}: is {:.3g} m long in {}; expected a vessel from 5 mm to 3 m, or another unit",
                                      path.string(), long_m, unit));
  setup.entry = {metres(length) * entry, metres(length) * towards};
  return VesselHandle::of(std::move(setup));
}

py::list branches(const VesselHandle& self) {
  py::list out;
  for (const vascular::TreeBranch& branch : self.vessel->way->branches()) {
    Points points(branch.spheres.size(), 3);
    Eigen::VectorXd radii(branch.spheres.size());
    for (std::size_t i = 0; i < branch.spheres.size(); ++i)
      points.row(i) = branch.spheres[i].p, radii[i] = branch.spheres[i].radius_m;
    out.append(py::dict(py::arg("name") = branch.name, py::arg("parent") = branch.parent,
                        py::arg("parent_sphere") = branch.parent_sphere, py::arg("points") = points,
                        py::arg("radii") = radii));
  }
  return out;
}

int sphere_at(const VesselHandle& self, const std::string& place) {
  const int sphere = self.vessel->way->place(place);
  if (sphere >= 0) return sphere;
  std::string known;
  for (const std::string& name : self.vessel->way->places()) known += (known.empty() ? "" : ", ") + name;
  throw py::value_error(
      fmt::format("there is no place \"{}\" in {}; expected one of {}, or one of these and "
                  "millimetres beyond, \"RCA+20\", or before, \"D1-4\"",
                  place, self.vessel->name, known));
}

int require_sphere(const VesselHandle& self, int sphere) {
  int count = 0;
  for (const vascular::TreeBranch& branch : self.vessel->way->branches())
    count += static_cast<int>(branch.spheres.size());
  if (sphere < 0 || sphere >= count)
    throw py::index_error(fmt::format("sphere {} is none; there are {}", sphere, count));
  return sphere;
}

double require_phase(double phase) {
  if (!(phase >= 0 && phase <= 1)) throw py::value_error("phase is outside [0, 1]");
  return phase;
}

std::pair<Points, Triangles> mesh(const VesselHandle& self, double phase) {
  require_phase(phase);
  const core::SurfaceDescription& wall = self.vessel->wall;
  Points points(wall.frames.front().size(), 3);
  for (Eigen::Index v = 0; v < points.rows(); ++v)
    points.row(v) = vertex_at(wall, static_cast<int>(v), vessel_frame(*self.vessel, phase));
  Triangles triangles(wall.triangles.size(), 3);
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k) triangles(t, k) = wall.triangles[static_cast<std::size_t>(t)][k];
  return {points, triangles};
}

// --- to other processes ----------------------------------------------------------------------------------------------

py::tuple recipe(const VesselHandle& self) {
  const RunSetup& s = self.setup;
  Points vertices(s.mesh.vertices.size(), 3);
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) vertices.row(v) = s.mesh.vertices[static_cast<std::size_t>(v)];
  Triangles triangles(s.mesh.triangles.size(), 3);
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k) triangles(t, k) = s.mesh.triangles[static_cast<std::size_t>(t)][k];
  return py::make_tuple(s.vessel, s.case_text, s.person, vertices, triangles, s.entry.p_P, s.entry.towards_P, s.shape);
}

std::shared_ptr<VesselHandle> from_recipe(const py::tuple& r) {
  RunSetup s;
  if (r.size() != 8) throw py::value_error("this is no vessel of this version");
  s.vessel = r[0].cast<std::string>(), s.case_text = r[1].cast<std::string>();
  s.person = r[2].cast<std::optional<std::uint64_t>>();
  const auto vertices = r[3].cast<Points>();
  const auto triangles = r[4].cast<Triangles>();
  constexpr double furthest_m = 1e3;
  if (!(vertices.array().abs() <= furthest_m).all())
    throw py::value_error("a vertex is not finite, or lies further away than a kilometre");
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) s.mesh.vertices.emplace_back(vertices.row(v));
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const std::array<int, 3> one = {triangles(t, 0), triangles(t, 1), triangles(t, 2)};
    for (int v : one)
      if (v < 0 || v >= vertices.rows()) throw py::value_error("a triangle names a vertex that is not there");
    s.mesh.triangles.push_back(one);
  }
  s.entry = {r[5].cast<Eigen::Vector3d>(), r[6].cast<Eigen::Vector3d>()};
  s.shape = r[7].cast<std::string>();
  const OthersRun others_run;
  return std::const_pointer_cast<VesselHandle>(VesselHandle::of(std::move(s)));
}

}  // namespace

VesselHandle::VesselHandle(RunSetup from)
    : setup(std::move(from)), vessel(make_vessel(setup, warnings)), key(key_of(setup)) {}

const app::PatientScene* VesselHandle::patient() const {
  std::call_once(contoured_, [&] {
    if (vessel->coronaries)
      patient_ = std::make_unique<const app::PatientScene>(*vessel->patient, vessel->coronaries->physiology);
  });
  return patient_.get();
}

std::shared_ptr<const VesselHandle> VesselHandle::of(RunSetup setup) {
  static std::mutex mutex;
  static std::map<std::string, std::weak_ptr<const VesselHandle>> known;
  const std::string key = key_of(setup);
  // Whoever asks for one that is being made waits for it; so do all others, as making one takes all cores.
  const std::lock_guard lock(mutex);
  auto& found = known[key];
  auto handle = found.lock();
  if (!handle) found = handle = std::make_shared<VesselHandle>(std::move(setup));
  return handle;
}

void bind_vessel(py::module_& module) {
  auto bound =
      py::class_<VesselHandle, std::shared_ptr<VesselHandle>>(module, "Vessel", R"(A vessel: a case's beating lumen.

Vessel(case, person=None): `case` is a name of `ostium cases`, or a case's file; `person` (0, 1, ...) another person with
the same disease. Takes some seconds, once for equal vessels. All in metres, in the patient's frame: x to the patient's
left, y to the head, z to the front. Raises OstiumError for a case that is not there.)")
          .def(py::init([](const std::filesystem::path& name, std::optional<std::uint64_t> person) {
                 const OthersRun others_run;
                 return std::const_pointer_cast<VesselHandle>(of_case(name.string(), person));
               }),
               py::arg("case"), py::arg("person") = py::none())
          .def_static(
              "from_mesh",
              [](const std::filesystem::path& path, const std::string& unit, const Eigen::Vector3d& entry,
                 const Eigen::Vector3d& towards) {
                const OthersRun others_run;
                return std::const_pointer_cast<VesselHandle>(of_mesh(path, unit, entry, towards));
              },
              py::arg("path"), py::arg("unit"), py::arg("entry"), py::arg("towards"),
              "A mesh at rest, in its file's unit (\"mm\", ...): `entry` (3) within the lumen, where instruments come "
              "in, "
              "and "
              "`towards` (3) a point they aim at, both in that unit and in the file's axes.")
          .def_property_readonly(
              "name", [](const VesselHandle& self) { return self.vessel->name; }, "Of its case, or its mesh's file.")
          .def_property_readonly(
              "person", [](const VesselHandle& self) { return self.setup.person; }, "As it was given.")
          .def_property_readonly(
              "beats", [](const VesselHandle& self) { return self.vessel->beats(); }, "Whether it moves with a heart.")
          .def_property_readonly(
              "heart_rate", [](const VesselHandle& self) { return self.vessel->rate_1_min; },
              "Beats a minute at the start.")
          .def_property_readonly(
              "warnings", [](const VesselHandle& self) { return self.warnings; },
              "What is wrong with a mesh; empty: nothing.")
          .def_property_readonly(
              "entry", [](const VesselHandle& self) { return self.vessel->entry.p_W; }, "(3) the introducer, m.")
          .def_property_readonly(
              "middle", [](const VesselHandle& self) { return self.vessel->p_middle; },
              "(3) where the C-arm looks at first, m.")
          .def_property_readonly(
              "branches", branches,
              "List of dict: name, parent (its index or -1), parent_sphere, points (n, 3) m, radii (n) m; "
              "the tree of centreline spheres at end-diastole.")
          .def_property_readonly(
              "places", [](const VesselHandle& self) { return self.vessel->way->places(); },
              "Names that `sphere` knows.")
          .def("sphere", sphere_at, py::arg("place"),
               "Number of the sphere at a place: a branch, a named place, or one of these and millimetres beyond, "
               "\"RCA+20\", or before the place where it leaves its vessel, \"D1-4\". Raises ValueError with the names "
               "there are.")
          .def(
              "locate",
              [](const VesselHandle& self, const Eigen::Vector3d& point, double phase) {
                if (!point.allFinite()) throw py::value_error("point has to be finite");
                return self.vessel->way->locate(point, require_phase(phase));
              },
              py::arg("point"), py::arg("phase") = 0.0,
              "Number of the sphere that holds a point (3), or is nearest to it.")
          .def(
              "point",
              [](const VesselHandle& self, int sphere, double phase) {
                return self.vessel->way->p(require_sphere(self, sphere), require_phase(phase));
              },
              py::arg("sphere"), py::arg("phase") = 0.0, "(3) the sphere's middle at a phase of the beat, [0, 1], m.")
          .def(
              "between",
              [](const VesselHandle& self, int a, int b) {
                return self.vessel->way->between_m(require_sphere(self, a), require_sphere(self, b));
              },
              py::arg("a"), py::arg("b"), "Way from sphere to sphere along the tree, m.")
          .def(
              "branch_of",
              [](const VesselHandle& self, int sphere) {
                return self.vessel->way->branch(require_sphere(self, sphere));
              },
              py::arg("sphere"), "Index in `branches` of a sphere.")
          .def("mesh", mesh, py::arg("phase") = 0.0,
               "(vertices (n, 3) m, triangles (m, 3)) of the wall at a phase of the beat, [0, 1].")
          .def_property_readonly(
              "key", [](const VesselHandle& self) { return self.key; }, "Equal for equal vessels.")
          .def("__copy__", [](const std::shared_ptr<VesselHandle>& self) { return self; })
          .def("__deepcopy__", [](const std::shared_ptr<VesselHandle>& self, const py::dict&) { return self; })
          .def("__repr__",
               [](const VesselHandle& self) {
                 return fmt::format("<ostium.Vessel {}{}>", self.vessel->name,
                                    self.setup.person ? fmt::format(", person {}", *self.setup.person) : "");
               })
          .def(py::pickle([](const VesselHandle& self) { return recipe(self); },
                          [](const py::tuple& r) { return from_recipe(r); }));
  pickle_in_every_protocol(bound);
}

}  // namespace ostium::python

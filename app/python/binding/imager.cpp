#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/python/binding/arrays.h"
#include "app/python/binding/bindings.h"
#include "app/python/binding/data.h"
#include "app/session/labelling/coco.h"
#include "app/session/scene/film.h"
#include "core/base/units.h"
#include "fluoro/projection/views.h"

namespace ostium::python {

namespace {

constexpr int fewest_pixels = 64, most_pixels = 1024;

struct ImagerHandle : MadeByInit {
  std::shared_ptr<ModelHandle> model;
  app::FilmOptions options;
  std::unique_ptr<app::Film> film;
  std::unique_ptr<app::Labeller> labeller;  ///< once labels were asked for
  std::atomic<bool> used{false};
};

app::Fill fill_of(const std::optional<std::string>& fill) {
  if (!fill) return app::Fill::none;
  if (*fill == "left") return app::Fill::left;
  if (*fill == "right") return app::Fill::right;
  throw py::value_error("fill is \"" + *fill + "\"; expected None, \"left\" or \"right\"");
}

double require_between(double number, double least, double most, const char* name) {
  if (!(number >= least && number <= most))
    throw py::value_error(fmt::format("{} is {}; expected a number from {} to {}", name, number, least, most));
  return number;
}

std::shared_ptr<ImagerHandle> make(std::shared_ptr<ModelHandle> model, const std::optional<std::string>& view,
                                   std::optional<double> lao_deg, std::optional<double> cran_deg, int pixels,
                                   std::optional<double> field_m, bool cine, const std::optional<std::string>& fill,
                                   bool overlay, std::uint64_t seed) {
  auto self = std::make_shared<ImagerHandle>();
  app::FilmOptions& o = self->options;
  if (view) {
    const auto found = fluoro::find_view(*view);
    if (!found) {
      std::string known;
      for (const fluoro::StandardView& one : fluoro::standard_views()) known += (known.empty() ? "" : ", ") + one.name;
      throw py::value_error("there is no view \"" + *view + "\"; expected one of " + known);
    }
    o.lao_rad = found->lao_deg * units::degree, o.cran_rad = found->cran_deg * units::degree;
  }
  if (lao_deg) o.lao_rad = require_between(*lao_deg, -180, 180, "lao") * units::degree;
  if (cran_deg) o.cran_rad = require_between(*cran_deg, -90, 90, "cran") * units::degree;
  fluoro::CArm arm;
  arm.lao_rad = o.lao_rad.value_or(0), arm.cran_rad = o.cran_rad.value_or(0);
  require_reachable(arm);
  o.pixels = static_cast<int>(require_between(pixels, fewest_pixels, most_pixels, "pixels"));
  if (field_m) o.field_m = require_between(*field_m, 0.05, 0.5, "field");
  o.mode = cine ? fluoro::Mode::cine : fluoro::Mode::fluoroscopy;
  o.fill = fill_of(fill);
  o.overlay = overlay;
  o.seed = seed;
  self->model = std::move(model);
  const OthersRun others_run;
  self->film = std::make_unique<app::Film>(self->model->model->session, o, self->model->recipe.vessel->patient());
  return self;
}

py::array_t<std::uint8_t> frame(ImagerHandle& self, DataHandle& data) {
  if (data.model->fingerprint != self.model->fingerprint) throw py::value_error("this Data is one of another model");
  const InUse used(self.used, "Imager"), data_used(data.used, "Data");
  const fluoro::Picture* picture = nullptr;
  {
    const OthersRun others_run;
    app::SessionInputs inputs = data.model->model->at_rest;
    app::take_inputs(data.run.row.data(), inputs);
    picture = &self.film->frame(data.model->model->session, data.run.state, inputs);
  }
  return py::array_t<std::uint8_t>({picture->height, picture->width}, picture->grey.data());
}

py::dict thing_of(const app::LabelledThing& thing, py::handle found) {
  py::dict out;
  out["name"] = thing.name;
  out["category"] = thing.category;
  out["class"] = app::label_class_names[static_cast<int>(thing.of_class)];
  const fluoro::Plane& depth_m = thing.covered.depth_m();
  py::array_t<bool> mask({depth_m.rows(), depth_m.cols()});
  std::transform(depth_m.data(), depth_m.data() + depth_m.size(), mask.mutable_data(),
                 [](float depth) { return depth > 0; });
  out["mask"] = mask;
  for (const char* key : {"area", "bbox", "keypoints", "centreline"})
    if (found.contains(key)) out[key] = found[key];
  return out;
}

py::dict labels(ImagerHandle& self, DataHandle& data) {
  if (data.model->fingerprint != self.model->fingerprint) throw py::value_error("this Data is one of another model");
  const InUse used(self.used, "Imager"), data_used(data.used, "Data");
  app::Labels labels;
  app::LabelledPixels pixels;
  std::string points, c_arm, annotations;
  {
    const OthersRun others_run;
    if (!self.labeller) self.labeller = std::make_unique<app::Labeller>(self.model->model->session);
    app::SessionInputs inputs = data.model->model->at_rest;
    app::take_inputs(data.run.row.data(), inputs);
    const fluoro::View view = self.film->view(inputs);
    labels = self.labeller->at(data.run.state, view);
    pixels = pixels_of(view, labels);
    points = points_of(view, labels).dump(), c_arm = app::c_arm_of(view).dump();
    annotations = nlohmann::ordered_json(annotations_of(view, labels)).dump();
  }
  const py::object from_json = py::module_::import("json").attr("loads");
  py::dict out;
  const int rows = pixels.mask.height, columns = pixels.mask.width;
  out["mask"] = py::array_t<std::uint8_t>({rows, columns}, pixels.mask.grey.data());
  py::array_t<float> depth_mm({rows, columns});
  std::transform(pixels.depth.begin(), pixels.depth.end(), depth_mm.mutable_data(),
                 [](std::uint16_t depth) { return static_cast<float>(1e3 * app::depth_unit_m * depth); });
  out["depth_mm"] = depth_mm;
  out["points"] = from_json(points), out["c_arm"] = from_json(c_arm);
  const py::object found = from_json(annotations);
  py::list things;
  for (std::size_t i = 0; i < labels.things.size(); ++i) things.append(thing_of(labels.things[i], found[py::int_(i)]));
  out["things"] = things;
  return out;
}

}  // namespace

void bind_imager(py::module_& module) {
  auto bound =
      py::class_<ImagerHandle, std::shared_ptr<ImagerHandle>>(module, "Imager",
                                                              R"(Takes X-ray pictures of sessions of a model.

Imager(model, view=None, lao=None, cran=None, pixels=256, field=None, cine=False, fill=None, overlay=False, seed=1)
  view     a name of `ostium views`; lao, cran: degrees instead. None: as Data.inputs have the C-arm
  pixels   on a side, 64 to 1024; field: width of the detector, m
  cine     with the dose of cine rather than fluoroscopy
  fill     "left" or "right": that coronary full of contrast, whatever was injected
The first one of a vessel takes a second.)")
          .def(py::init(&make), py::arg("model").none(false), py::arg("view") = py::none(), py::arg("lao") = py::none(),
               py::arg("cran") = py::none(), py::arg("pixels") = 256, py::arg("field") = py::none(),
               py::arg("cine") = false, py::arg("fill") = py::none(), py::arg("overlay") = false, py::arg("seed") = 1)
          .def(
              "reset",
              [](ImagerHandle& self, std::uint64_t seed) {
                const InUse used(self.used, "Imager");
                self.film->restart(seed);
              },
              py::arg("seed") = 1, "Begins noise and lag anew, as of a fresh Imager of that seed.")
          .def(
              "frame", frame, py::arg("data").none(false),
              "(pixels, pixels) uint8: this moment, as the display shows it; noise and lag go on from frame to frame.");
  bound.def("labels", labels, py::arg("data").none(false),
            R"(What is where in the picture that `frame` takes of this moment: a dict

mask      (pixels, pixels) uint8: index into ostium.dataset.CLASSES of the highest class that covers a pixel
depth_mm  (pixels, pixels) float32: of that, from the source along the beam's axis; 0: nothing is there
things    of each vessel and device in the picture: name, category, class, its own mask (bool), area, bbox (left, top,
          width, height), and where it has them keypoints (of its tip) and centreline (px, depth_mm, mm)
points    tips, markers, ostia, lesions: name, px, in_picture, depth_mm, mm
c_arm     angles, distances, and the matrix from mm to pixels)");
  refuse_to_pickle(bound);
}

}  // namespace ostium::python

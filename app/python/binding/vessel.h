#pragma once
/// A vessel with what it was made from, so that it can be made again in another process.
#include <pybind11/pybind11.h>

#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "app/angiography/patient_scene.h"
#include "app/python/binding/interpreter.h"
#include "app/session/operator/setup.h"

namespace ostium::python {

class VesselHandle : public MadeByInit {
 public:
  /// Made once for equal setups, as long as one of them lives. `setup`: its vessel's part. Without the interpreter's
  /// lock; throws LoadError or MeshError.
  static std::shared_ptr<const VesselHandle> of(app::RunSetup setup);

  explicit VesselHandle(app::RunSetup from);
  const app::RunSetup setup;
  std::string warnings;  ///< about a mesh; empty: none
  const std::shared_ptr<const app::Vessel> vessel;
  const std::string key;  ///< equal for equal vessels

  /// Its patient under X-rays, made at the first call; null for a mesh. Many threads may ask.
  const app::PatientScene* patient() const;

 private:
  mutable std::once_flag contoured_;
  mutable std::unique_ptr<const app::PatientScene> patient_;
};

}  // namespace ostium::python

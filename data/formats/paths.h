#pragma once
/// What lies where a path leads, under the names of this folder's readers and writers.
#include "vascular/geometry/mesh_files/paths.h"

namespace ostium::data {

using vascular::is_file;
using vascular::is_folder;
using vascular::is_there;
using vascular::why_no_file;

}  // namespace ostium::data

#pragma once
/// Boxes about the clusters of a surface and the nodes of its tree.
#include "core/wall/surface.h"

namespace ostium::core {

inline int wrapped(int frame, int frames) { return ((frame % frames) + frames) % frames; }

bool stands_still(const Surface& surface, const Surface::Cluster& cluster);
/// Writes the bounds of a cluster in all frames.
void bound_frames(int cluster, Surface& surface);
/// Box of a cluster's displacements: those of a sway of 1, or aside.
Box box_of_corners(const Surface& surface, const std::vector<float>& displacements, const Surface::Cluster& cluster);
/// Box of a node, from those of its children.
Box around_children(const Surface& surface, const Box* boxes, int node);
/// Box of a node over an interval between two frames; those of its children must exist.
Box box_of(const Surface& surface, const Box* boxes, int node, int interval);

}  // namespace ostium::core

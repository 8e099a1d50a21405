#pragma once
/// Advection of contrast along a row of cells, for any step size: each face passes the contents of the blood volume
/// that crosses it (a conservative semi-Lagrangian scheme with van Leer's 1977 limited slopes). Mass is conserved, and
/// a uniform concentration stays uniform.
#include <span>
#include <vector>

namespace ostium::vascular {

struct CarryScratch {
  std::vector<double> kg_m3, slope;
};

/// Mass that passes each face within a step, kg.
///   mass, volume   (#cells) kg and m3, > 0
///   passing_m3     (#cells + 1) volume that passes each cell's upstream face and, last, the outlet; >= 0
///   inlet_kg_m3    concentration entering the first cell
///   through_kg     (#cells + 1) the result; the first is the inlet
void carry(std::span<const double> mass, std::span<const double> volume, std::span<const double> passing_m3,
           double inlet_kg_m3, std::span<double> through_kg, CarryScratch& scratch);

}  // namespace ostium::vascular

#pragma once
/// What bench and film measure: curves. A run is one pass of the machine, with one or more measured numbers a sample.
#include <Eigen/Core>
#include <string>
#include <vector>

#include "data/formats/json/json_value.h"

namespace ostium::data::curves {

/// One measured quantity along a run, in the unit of its file.
struct Channel {
  std::string key;           ///< as in the file: "force_N"
  std::string label, unit;   ///< "force", "N"
  Eigen::VectorXd measured;  ///< one number a sample
  Eigen::VectorXd sigma;     ///< noise of each sample, > 0; empty: not declared
};

struct Run {
  std::string id, group;  ///< group: empty if none
  std::string place;      ///< "runs[3]", for messages
  std::string along_label, along_unit;
  Eigen::VectorXd along;          ///< what the page plots the channels against
  std::vector<Channel> channels;  ///< the same ones, in the same order, in every run of a set

  Eigen::Index samples() const { return along.size(); }
};

/// Misfits, or predictions, of one run: a vector for each channel.
using Curves = std::vector<Eigen::VectorXd>;

}  // namespace ostium::data::curves

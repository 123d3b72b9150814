#include "pliant/deformers/rigid_cells/options.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "pliant/core/message.h"

namespace pliant {
namespace {

Status invalid(std::string message) { return {ErrorCode::invalid_option, std::move(message)}; }

Status check_count(const char* name, int value, int least, int most) {
  if (value >= least && value <= most) return {};
  return invalid(message({name, " is ", value, "; expected ", least, " to ", most}));
}

Status check_stiffness(const CellStiffness& region, std::size_t i, const Shape& shape) {
  const std::string at = message({"stiffness[", i, "]"});
  if (!(std::isfinite(region.factor) && region.factor > 0.0)) {
    return invalid(message({at, ".factor is ", region.factor, "; expected a finite number above 0"}));
  }
  if (region.vertices.empty()) return invalid(message({at, " selects nothing; expected at least one vertex"}));
  for (Index vertex : region.vertices) {
    if (vertex >= 0 && vertex < shape.input_size()) continue;
    return invalid(message({at, " holds vertex ", vertex, "; expected 0 to ", shape.input_size() - 1}));
  }
  return {};
}

}  // namespace

Status RigidCellsOptions::validate(const Shape& shape) const {
  if (Status s = check_count("resolution", resolution, 1, 256); !s.ok()) return s;
  if (Status s = check_count("boundaryLevels", boundary_levels, 0, 4); !s.ok()) return s;
  for (std::size_t i = 0; i < stiffness.size(); ++i) {
    if (Status s = check_stiffness(stiffness[i], i, shape); !s.ok()) return s;
  }
  return {};
}

void exchange(NamedFields& fields, RigidCellsOptions& options) {
  fields("resolution", options.resolution);
  fields("align", options.align);
  fields("boundaryLevels", options.boundary_levels);
  fields("refine", options.refine);
  fields("interior", options.interior);
  fields("transfer", options.transfer, {"rbf", "blend"});
  fields("hold", options.hold, {"cells", "points"});
  std::vector<std::vector<Index>> regions;
  std::vector<double> factors;
  for (const CellStiffness& region : options.stiffness) {
    regions.push_back(region.vertices);
    factors.push_back(region.factor);
  }
  fields("stiffness", regions);
  fields("stiffness/factors", factors);
  options.stiffness.clear();
  for (std::size_t i = 0; i < std::min(regions.size(), factors.size()); ++i) {
    options.stiffness.push_back({regions[i], factors[i]});
  }
}

}  // namespace pliant

// Every registered method, for the laws that hold for all of them.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pliant/solve/deformer.h"

namespace pliant::test {

struct Method {
  std::string name;
  std::function<std::unique_ptr<Deformer>(std::shared_ptr<const Shape>)> make;
  /// How far results may differ when the scene is turned by any angle (law 5), over the diagonal.
  double isotropy = 1e-5;
  /// Targets are met, for which multipliers trade energy: law 3 does not hold.
  bool exact = false;
  /// Other options, each set on a living deformer.
  std::vector<std::function<void(Deformer&)>> live_options = {};
  /// Mean and one vertex of law 8's edit, as a native build found them.
  struct Recorded {
    Eigen::Vector3d mean, vertex;
  };
  std::optional<Recorded> recorded = {};
};

std::vector<Method> methods();
/// Those that meet targets by multipliers.
std::vector<Method> exact_methods();

}  // namespace pliant::test

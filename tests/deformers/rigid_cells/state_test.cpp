// The saved state, looked at by a program that shares nothing with the solver but the state.
#include <cmath>
#include <set>
#include <utility>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include "pliant/deformers/rigid_cells/deformer.h"
#include "support/edits.h"
#include "support/shapes.h"

using namespace pliant;

namespace {

struct Cells {
  std::vector<Eigen::Vector3d> center, translation;
  std::vector<Eigen::Matrix3d> rotation;
  std::vector<double> size, factor;
  std::vector<bool> held;
  struct Pair {
    std::size_t i, j;
    double weight;
  };
  std::vector<Pair> pairs;

  explicit Cells(const State& state) {
    const auto data = [&](const char* name) -> const std::vector<double>& { return state.find(name)->data; };
    size = data("cells[]/size");
    factor = data("cells[]/factor");
    for (std::size_t c = 0; c < size.size(); ++c) {
      center.emplace_back(&data("cells[]/center")[3 * c]);
      translation.emplace_back(&data("cells[]/translation")[3 * c]);
      rotation.emplace_back(
          Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(&data("cells[]/rotation")[9 * c]));
      held.push_back(data("cells[]/held")[c] != 0.0);
    }
    for (std::size_t p = 0; p < data("pairs[]/i").size(); ++p) {
      pairs.push_back({static_cast<std::size_t>(data("pairs[]/i")[p]), static_cast<std::size_t>(data("pairs[]/j")[p]),
                       data("pairs[]/weight")[p]});
    }
  }

  /// Eq. 1 and 2 by Gauss's rule with two points along an axis, which is exact. gradient: six numbers a cell, of a
  /// translation and of a turn about the origin.
  double energy(const Eigen::Matrix3d& axes, Eigen::VectorXd* gradient) const {
    if (gradient != nullptr) gradient->setZero(static_cast<Eigen::Index>(6 * size.size()));
    double sum = 0.0;
    for (const auto& [i, j, weight] : pairs) {
      const double volumes = std::pow(size[i], 3) + std::pow(size[j], 3);
      for (const std::size_t c : {i, j}) {
        const double share = weight * std::pow(size[c], 3) / volumes / 8.0;
        for (int corner = 0; corner < 8; ++corner) {
          const Eigen::Vector3d at(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
          const Eigen::Vector3d x = center[c] + size[c] / std::sqrt(12.0) * (axes.transpose() * at);
          const Eigen::Vector3d a = rotation[i] * x + translation[i], b = rotation[j] * x + translation[j];
          sum += share * (a - b).squaredNorm();
          if (gradient == nullptr) continue;
          const Eigen::Vector3d force = 2.0 * share * (a - b);
          gradient->segment<3>(static_cast<Eigen::Index>(6 * i)) += force;
          gradient->segment<3>(static_cast<Eigen::Index>(6 * i + 3)) += a.cross(force);
          gradient->segment<3>(static_cast<Eigen::Index>(6 * j)) -= force;
          gradient->segment<3>(static_cast<Eigen::Index>(6 * j + 3)) -= b.cross(force);
        }
      }
    }
    return sum;
  }

  void move(const Eigen::VectorXd& twists) {
    for (std::size_t c = 0; c < size.size(); ++c) {
      if (held[c]) continue;
      const Eigen::Vector3d v = twists.segment<3>(static_cast<Eigen::Index>(6 * c)),
                            w = twists.segment<3>(static_cast<Eigen::Index>(6 * c + 3));
      const Eigen::Matrix3d turn =
          w.norm() > 0.0 ? Eigen::AngleAxisd(w.norm(), w.normalized()).toRotationMatrix() : Eigen::Matrix3d::Identity();
      rotation[c] = turn * rotation[c];
      translation[c] = turn * translation[c] + v;
    }
  }

  void hold(Eigen::VectorXd& twists) const {
    for (std::size_t c = 0; c < size.size(); ++c) {
      if (held[c]) twists.segment<6>(static_cast<Eigen::Index>(6 * c)).setZero();
    }
  }
};

std::unique_ptr<RigidCells> bent(const test::Mesh& mesh, const RigidCellsOptions& options) {
  auto deformer = std::move(*RigidCells::create(test::shape_of(mesh), options));
  const HandleId handle = test::fix_bottom_grab_top(*deformer, mesh);
  REQUIRE(deformer->move_handle(handle, test::turn(80, {1, 0.2, 0}, {0, 0, 0.9}, {0.2, 0.5, -0.3})).ok());
  test::settle(*deformer, 300, 1e-9);
  return deformer;
}

Eigen::Matrix3d axes_of(const State& state) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(state.find("axes")->data.data());
}

}  // namespace

TEST_CASE("the energy of a state is that of eq. 1 and 2 over its cells, every pair of neighbours once") {
  const test::Mesh mesh = test::potato(3);
  const std::vector<Index> soft = test::pick(mesh, [](const auto& p) { return p.x() > 0.2; });
  const auto deformer = bent(mesh, {.resolution = 8, .boundary_levels = 2, .stiffness = {{soft, 0.2}}});
  const State state = deformer->save();
  const Cells cells(state);
  const Eigen::Matrix3d axes = axes_of(state);
  CHECK(cells.energy(axes, nullptr) == doctest::Approx(deformer->energy().total).epsilon(1e-9));
  std::set<std::pair<std::size_t, std::size_t>> seen;
  bool unequal = false;
  for (const auto& [i, j, weight] : cells.pairs) {
    CHECK(seen.emplace(i, j).second);
    CHECK(i < j);
    const double smaller = std::min(cells.size[i], cells.size[j]), reach = (cells.size[i] + cells.size[j]) / 2.0;
    const Eigen::Vector3d apart = (axes * (cells.center[i] - cells.center[j])).cwiseAbs();
    CHECK(apart.maxCoeff() == doctest::Approx(reach));
    CHECK((apart.array() < reach - smaller / 4.0).count() == 2);  // a face, not an edge
    CHECK(weight == doctest::Approx(smaller * smaller / reach * (cells.factor[i] + cells.factor[j]) / 2.0));
    unequal |= cells.size[i] != cells.size[j];
  }
  CHECK(unequal);
}

TEST_CASE("another minimiser, started from the state, finds next to nothing to gain") {
  const auto deformer = bent(test::tube(16, 12, 0.4, 2.0), {.resolution = 8});
  const State state = deformer->save();
  Cells cells(state);
  const Eigen::Matrix3d axes = axes_of(state);
  // Conjugate gradients (Polak, Ribiere) with steps that are halved or doubled.
  Eigen::VectorXd gradient, before, direction;
  const double found = cells.energy(axes, nullptr);
  double energy = found, step = 1e-2;
  for (int iteration = 0; iteration < 400; ++iteration) {
    cells.energy(axes, &gradient);
    cells.hold(gradient);
    const double turn = iteration == 0 ? 0.0 : std::max(0.0, gradient.dot(gradient - before) / before.squaredNorm());
    direction = iteration == 0 ? Eigen::VectorXd(-gradient) : Eigen::VectorXd(-gradient + turn * direction);
    if (direction.dot(gradient) > 0.0) direction = -gradient;
    before = gradient;
    const Cells start = cells;
    for (step *= 4.0; step > 1e-12; step *= 0.5) {
      cells = start;
      cells.move(step * direction);
      const double now = cells.energy(axes, nullptr);
      if (now <= energy) {
        energy = now;
        break;
      }
    }
    if (step <= 1e-12) break;
  }
  CHECK(energy <= found);
  CHECK(found - energy < 1e-4 * found);
}

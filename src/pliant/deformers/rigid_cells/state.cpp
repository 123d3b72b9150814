// Saving and restoring (contract, section 3).
#include <algorithm>
#include <cmath>
#include <utility>

#include "pliant/core/message.h"
#include "pliant/deformers/rigid_cells/impl.h"

namespace pliant {

using namespace cells;

namespace {

/// How a cell is held, in the table "cells[]/held".
enum class Held { no, whole, at_point };
/// Saved centres and sides fit to this part of the side.
constexpr double kFit = 1e-6;

Status misfit(const char* what) {
  return {ErrorCode::invalid_option, message({"state: ", what, "; expected a state of rigid-cells on this shape"})};
}

const StateTable* rows(const State& state, const char* name, std::size_t columns, std::size_t count) {
  const StateTable* table = state.find(name);
  return table != nullptr && table->data.size() == columns * count ? table : nullptr;
}

bool all_finite(const StateTable& table) {
  return std::all_of(table.data.begin(), table.data.end(), [](double value) { return std::isfinite(value); });
}

void add_vector(StateTable& table, const Eigen::Vector3d& v) {
  table.data.insert(table.data.end(), v.begin(), v.end());
}

void add_rotation(StateTable& table, const Eigen::Matrix3d& r) {
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) table.data.push_back(r(a, b));
  }
}

/// Points that were held.
Result<std::vector<Index>> pins_of(const State& state, const Shape& shape) {
  const StateTable* vertices = state.find("pins[]/vertex");
  std::vector<Index> points;
  if (vertices == nullptr) return points;
  const StateTable* targets = rows(state, "pins[]/target", 3, vertices->data.size());
  if (targets == nullptr) return misfit("its tables differ in length");
  if (!all_finite(*targets)) return misfit("it holds a number that is not finite");
  for (const double vertex : vertices->data) {
    if (!(vertex >= 0.0 && vertex < shape.input_size())) return misfit("it pins a vertex that is not there");
    points.push_back(shape.point_of_vertex()[static_cast<Index>(vertex)]);
  }
  return points;
}

/// Splits cells that were larger before a refinement.
Status refit(CellTree& tree, const StateTable& centers, const StateTable& sizes) {
  for (int round = 0; round <= tree.frame().depth; ++round) {
    std::vector<bool> wanted(tree.size(), false);
    bool any = false;
    for (std::size_t i = 0; i < sizes.data.size(); ++i) {
      const Index cell = tree.cell_at(Eigen::Vector3d(&centers.data[3 * i]));
      if (tree.side(cell) > 1.5 * sizes.data[i]) wanted[cell] = any = true;
    }
    if (!any) break;
    if (const auto split = tree.split(wanted); !split.ok()) return split.status();
  }
  if (tree.size() != static_cast<Index>(sizes.data.size())) return misfit("its cells are others");
  for (Index i = 0; i < tree.size(); ++i) {
    const Eigen::Vector3d center(&centers.data[3 * i]);
    if (!((tree.center(i) - center).norm() <= kFit * tree.side(i))) return misfit("its cells are others");
  }
  return {};
}

}  // namespace

State RigidCells::do_save() const {
  const Impl& impl = *impl_;
  State state;
  StateTable centers{"cells[]/center", 3, false, {}}, sizes{"cells[]/size", 1, false, {}},
      rotations{"cells[]/rotation", 9, false, {}}, translations{"cells[]/translation", 3, false, {}},
      factors{"cells[]/factor", 1, false, {}}, held{"cells[]/held", 1, true, {}}, points{"cells[]/point", 3, false, {}};
  const Index count = impl.model.size();
  held.data.assign(count, static_cast<double>(Held::no));
  points.data.assign(3 * count, 0.0);
  for (const Hold& hold : impl.find_holds(*this)) {
    const bool whole = hold.freedom == Freedom::held;
    held.data[hold.cell] = static_cast<double>(whole ? Held::whole : Held::at_point);
    const Eigen::Vector3d point = hold.point + impl.model.origin;
    if (!whole) std::copy(point.begin(), point.end(), points.data.begin() + 3 * hold.cell);
  }
  for (Index i = 0; i < count; ++i) {
    const CellMotion& motion = impl.motions[i];
    const Eigen::Vector3d center = impl.tree.center(i);
    add_vector(centers, center);
    sizes.data.push_back(impl.model.sides[i]);
    add_rotation(rotations, motion.rotation);
    add_vector(translations, motion.center + impl.model.origin - motion.rotation * center);
    factors.data.push_back(impl.model.factors[i]);
  }
  for (StateTable* table : {&centers, &sizes, &rotations, &translations, &factors, &held, &points}) {
    state.tables.push_back(std::move(*table));
  }
  StateTable first{"pairs[]/i", 1, true, {}}, second{"pairs[]/j", 1, true, {}}, weights{"pairs[]/weight", 1, false, {}};
  for (std::size_t p = 0; p < impl.model.pairs.size(); ++p) {
    first.data.push_back(impl.model.pairs[p][0]);
    second.data.push_back(impl.model.pairs[p][1]);
    weights.data.push_back(impl.model.weights[p]);
  }
  for (StateTable* table : {&first, &second, &weights}) state.tables.push_back(std::move(*table));
  add_rotation(state.add("axes", 1, false), impl.tree.frame().axes);
  StateTable vertices{"pins[]/vertex", 1, true, {}}, targets{"pins[]/target", 3, false, {}};
  for (const Index point : impl.carrier.held_points()) vertices.data.push_back(shape().vertex_of_point()[point]);
  for (const auto& target : impl.carrier.targets().colwise()) add_vector(targets, target);
  for (StateTable* table : {&vertices, &targets}) state.tables.push_back(std::move(*table));
  return state;
}

Status RigidCells::do_restore(const State& state) {
  Impl& impl = *impl_;
  const StateTable* sizes = state.find("cells[]/size");
  if (sizes == nullptr) return misfit("there are no cells");
  const std::size_t count = sizes->data.size();
  const StateTable* centers = rows(state, "cells[]/center", 3, count);
  const StateTable* rotations = rows(state, "cells[]/rotation", 9, count);
  const StateTable* translations = rows(state, "cells[]/translation", 3, count);
  if (centers == nullptr || rotations == nullptr || translations == nullptr)
    return misfit("its tables differ in length");
  for (const StateTable* table : {sizes, centers, rotations, translations}) {
    if (!all_finite(*table)) return misfit("it holds a number that is not finite");
  }
  const Result<std::vector<Index>> pins = pins_of(state, shape());
  if (!pins.ok()) return pins.status();
  CellTree tree = impl.tree;
  Status fits = refit(tree, *centers, *sizes);
  if (!fits.ok()) {  // what stands may be finer
    Result<CellTree> fresh = CellTree::create(shape(), impl.options);
    if (!fresh.ok()) return fresh.status();
    tree = std::move(*fresh);
    fits = refit(tree, *centers, *sizes);
  }
  if (!fits.ok()) return fits;
  if (tree.size() != impl.tree.size() || tree.centers() != impl.tree.centers()) {
    impl.tree = std::move(tree);
    impl.take_tree(shape());
    pattern_changed();
  }
  impl.motions = impl.model.rest();
  for (std::size_t i = 0; i < count; ++i) {
    CellMotion& motion = impl.motions[i];
    for (int k = 0; k < 9; ++k) motion.rotation(k / 3, k % 3) = rotations->data[9 * i + k];
    const Eigen::Vector3d center = impl.tree.center(static_cast<Index>(i));
    motion.center = motion.rotation * center + Eigen::Vector3d(&translations->data[3 * i]) - impl.model.origin;
  }
  Points targets(3, static_cast<Index>(pins->size()));
  if (!pins->empty()) std::copy_n(state.find("pins[]/target")->data.data(), targets.size(), targets.data());
  impl.carrier.hold(shape(), impl.tree, *pins, targets);
  return {};
}

}  // namespace pliant

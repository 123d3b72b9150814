#include "pliant/solve/constraints.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "pliant/core/message.h"

namespace pliant {
namespace {

Status invalid_handle(std::string message) { return {ErrorCode::invalid_handle, std::move(message)}; }

Status invalid_state(const std::string& what) { return {ErrorCode::invalid_option, "handles of the state " + what}; }

}  // namespace

Result<std::vector<Index>> Constraints::checked_points(std::span<const Index> vertices, const char* argument,
                                                       std::vector<Index>* kept) const {
  const Index size = shape_->input_size();
  std::vector<bool> seen_vertex(size, false), seen_point(shape_->points().cols(), false);
  std::vector<Index> points;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Index vertex = vertices[i];
    if (vertex < 0 || vertex >= size) {
      return invalid_handle(
          message({argument, "[", i, "] is ", vertex, "; expected a vertex id from 0 to ", size - 1}));
    }
    if (seen_vertex[vertex]) {
      return invalid_handle(
          message({argument, "[", i, "] is ", vertex, ", which is listed before; expected each vertex once"}));
    }
    seen_vertex[vertex] = true;
    const Index point = shape_->point_of_vertex()[vertex];
    if (seen_point[point]) continue;
    seen_point[point] = true;
    points.push_back(point);
    if (kept != nullptr) kept->push_back(static_cast<Index>(i));
  }
  return points;
}

Result<std::size_t> Constraints::find(HandleId id) const {
  const auto found = std::find_if(handles_.begin(), handles_.end(), [&](const Handle& h) { return h.id == id; });
  if (found == handles_.end()) return invalid_handle(message({"there is no handle ", id}));
  return static_cast<std::size_t>(found - handles_.begin());
}

std::vector<bool> Constraints::held() const {
  std::vector<bool> held(shape_->points().cols(), false);
  for (Index point : fixed_points_) held[point] = true;
  for (const Handle& handle : handles_) {
    for (Index point : handle.points) held[point] = true;
  }
  return held;
}

std::vector<Index> Constraints::moved_points() const {
  std::vector<Index> points;
  for (const Handle& handle : handles_) points.insert(points.end(), handle.points.begin(), handle.points.end());
  return points;
}

Points Constraints::targets() const {
  Index count = 0;
  for (const Handle& handle : handles_) count += static_cast<Index>(handle.targets.cols());
  Points targets(3, count);
  Index at = 0;
  for (const Handle& handle : handles_) {
    targets.middleCols(at, handle.targets.cols()) = handle.targets;
    at += static_cast<Index>(handle.targets.cols());
  }
  return targets;
}

Result<bool> Constraints::set_fixed(std::span<const Index> vertices) {
  auto points = checked_points(vertices, "fixed", nullptr);
  if (!points.ok()) return points.status();
  std::vector<bool> moved(shape_->points().cols(), false);
  for (const Handle& handle : handles_) {
    for (Index point : handle.points) moved[point] = true;
  }
  for (Index point : *points) {
    if (!moved[point]) continue;
    return invalid_handle(message({"fixed holds vertex ", shape_->vertex_of_point()[point],
                                   ", which belongs to a handle; expected a vertex to be fixed or moved"}));
  }
  std::sort(points->begin(), points->end());
  if (*points == fixed_points_) return false;
  fixed_points_ = std::move(*points);
  return true;
}

Result<HandleId> Constraints::add_handle(std::span<const Index> vertices) {
  if (vertices.empty()) return invalid_handle("vertices is empty; expected at least one vertex id");
  std::vector<Index> kept;
  auto points = checked_points(vertices, "vertices", &kept);
  if (!points.ok()) return points.status();
  const std::vector<bool> taken = held();
  for (Index point : *points) {
    if (!taken[point]) continue;
    return invalid_handle(message({"vertices holds vertex ", shape_->vertex_of_point()[point],
                                   ", which is fixed or belongs to another handle; expected a free vertex"}));
  }
  Handle handle;
  handle.id = next_id_++;
  handle.points = std::move(*points);
  handle.rest = shape_->points()(Eigen::all, handle.points);
  handle.targets = handle.rest;
  handles_.push_back(std::move(handle));
  private_.push_back({static_cast<Index>(vertices.size()), std::move(kept)});
  return handles_.back().id;
}

Status Constraints::remove_handle(HandleId id) {
  const auto at = find(id);
  if (!at.ok()) return at.status();
  handles_.erase(handles_.begin() + static_cast<std::ptrdiff_t>(*at));
  private_.erase(private_.begin() + static_cast<std::ptrdiff_t>(*at));
  return {};
}

Status Constraints::move_handle(HandleId id, const Motion& motion) {
  const auto at = find(id);
  if (!at.ok()) return at.status();
  if (!(motion.axis.norm() > 0.0)) {
    return invalid_handle("rotate.axis is the zero vector; expected a direction");
  }
  const Eigen::Affine3d map = motion.map();
  Handle& handle = handles_[*at];
  Points targets(3, handle.rest.cols());
  for (Index i = 0; i < targets.cols(); ++i) targets.col(i) = map * handle.rest.col(i);
  if (!targets.allFinite()) return invalid_handle("the motion takes vertices out of range; expected finite numbers");
  handle.targets = std::move(targets);
  handle.motion = motion;
  return {};
}

Status Constraints::set_targets(HandleId id, const Points& targets) {
  const auto at = find(id);
  if (!at.ok()) return at.status();
  const Private& columns = private_[*at];
  if (targets.cols() != columns.given) {
    return invalid_handle(message(
        {"targets has ", targets.cols(), " points; expected ", columns.given, ", one for each vertex of the handle"}));
  }
  for (Index i = 0; i < targets.cols(); ++i) {
    if (targets.col(i).allFinite()) continue;
    return invalid_handle(message({"targets[", i, "] is not finite; expected finite coordinates"}));
  }
  handles_[*at].targets = targets(Eigen::all, columns.kept);
  handles_[*at].motion.reset();
  return {};
}

void Constraints::reset() {
  for (Handle& handle : handles_) {
    handle.targets = handle.rest;
    handle.motion.reset();
  }
  for (Private& own : private_) own.taken = Motion{};
}

ToldTurns Constraints::take_turns() {
  ToldTurns turns;
  for (std::size_t h = 0; h < handles_.size(); ++h) {
    const Handle& handle = handles_[h];
    std::optional<Motion>& taken = private_[h].taken;
    turns.of_handle.push_back(handle.motion ? turn_between(taken, *handle.motion)
                                            : Eigen::Vector3d(Eigen::Vector3d::Zero()));
    turns.beyond_half_turn = turns.beyond_half_turn || turns.of_handle.back().norm() > std::numbers::pi;
    taken = handle.motion;
    if (!handle.motion && handle.targets == handle.rest) taken = Motion{};
  }
  return turns;
}

void Constraints::save(State& state) const {
  StateTable sizes{"handles[]", 1, true, {}}, vertices{"handles[]/vertices[]", 1, true, {}},
      targets{"handles[]/targets[]", 3, false, {}};
  for (const Handle& handle : handles_) {
    sizes.data.push_back(static_cast<double>(handle.points.size()));
    for (Index point : handle.points) vertices.data.push_back(shape_->vertex_of_point()[point]);
    targets.data.insert(targets.data.end(), handle.targets.data(), handle.targets.data() + handle.targets.size());
  }
  for (StateTable* table : {&sizes, &vertices, &targets}) state.tables.push_back(std::move(*table));
}

Status Constraints::check(const State& state) const {
  const StateTable* sizes = state.find("handles[]");
  const StateTable* vertices = state.find("handles[]/vertices[]");
  const StateTable* targets = state.find("handles[]/targets[]");
  if (sizes == nullptr || vertices == nullptr || targets == nullptr) return {};
  double sum = 0.0;
  for (double size : sizes->data) {
    if (!(size >= 0.0) || size != std::floor(size)) {
      return invalid_state(message({"holds a size of ", size, "; expected a count of vertices"}));
    }
    sum += size;
  }
  const double given = static_cast<double>(vertices->data.size());
  if (sum > given || 3.0 * sum > static_cast<double>(targets->data.size())) {
    return invalid_state("is cut short; expected one target a vertex");
  }
  if (!std::all_of(targets->data.begin(), targets->data.end(), [](double v) { return std::isfinite(v); })) {
    return invalid_state("holds a target that is not finite");
  }
  return {};
}

void Constraints::restore(const State& state) {
  for (Private& own : private_) own.taken.reset();
  const StateTable* sizes = state.find("handles[]");
  const StateTable* vertices = state.find("handles[]/vertices[]");
  const StateTable* targets = state.find("handles[]/targets[]");
  if (sizes == nullptr || vertices == nullptr || targets == nullptr) return;
  const auto same = [&](Index point, double vertex) { return shape_->vertex_of_point()[point] == vertex; };
  std::size_t first = 0;
  for (double count : sizes->data) {
    const std::size_t size = static_cast<std::size_t>(count);
    for (Handle& handle : handles_) {
      if (handle.points.size() != size ||
          !std::equal(handle.points.begin(), handle.points.end(), vertices->data.begin() + first, same)) {
        continue;
      }
      handle.targets = Eigen::Map<const Points>(targets->data.data() + 3 * first, 3, size);
      handle.motion.reset();
    }
    first += size;
  }
}

}  // namespace pliant

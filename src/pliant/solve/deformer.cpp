#include "pliant/solve/deformer.h"

#include <algorithm>
#include <utility>

namespace pliant {
namespace {

std::string at(const char* argument, std::size_t i) { return std::string(argument) + "[" + std::to_string(i) + "]"; }

Status invalid_handle(std::string message) { return {ErrorCode::invalid_handle, std::move(message)}; }

}  // namespace

Result<std::vector<Index>> Deformer::checked_points(std::span<const Index> vertices, const char* argument,
                                                    std::vector<Index>* kept) const {
  const Index size = shape().input_size();
  std::vector<bool> seen_vertex(size, false), seen_point(shape().points().cols(), false);
  std::vector<Index> points;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Index vertex = vertices[i];
    if (vertex < 0 || vertex >= size) {
      return invalid_handle(at(argument, i) + " is " + std::to_string(vertex) + "; expected a vertex id from 0 to " +
                            std::to_string(size - 1));
    }
    if (seen_vertex[vertex]) {
      return invalid_handle(at(argument, i) + " is " + std::to_string(vertex) +
                            ", which is listed before; expected each vertex once");
    }
    seen_vertex[vertex] = true;
    const Index point = shape().point_of_vertex()[vertex];
    if (seen_point[point]) continue;
    seen_point[point] = true;
    points.push_back(point);
    if (kept != nullptr) kept->push_back(static_cast<Index>(i));
  }
  return points;
}

Handle* Deformer::find(HandleId id) {
  const auto found = std::find_if(handles_.begin(), handles_.end(), [&](const Handle& h) { return h.id == id; });
  return found == handles_.end() ? nullptr : &*found;
}

Status Deformer::set_fixed(std::span<const Index> vertices) {
  auto points = checked_points(vertices, "fixed", nullptr);
  if (!points.ok()) return points.status();
  std::vector<bool> moved(shape().points().cols(), false);
  for (const Handle& handle : handles_) {
    for (Index point : handle.points) moved[point] = true;
  }
  for (Index point : *points) {
    if (!moved[point]) continue;
    return invalid_handle("fixed holds vertex " + std::to_string(shape().vertex_of_point()[point]) +
                          ", which belongs to a handle; expected a vertex to be fixed or moved");
  }
  std::sort(points->begin(), points->end());
  if (*points == fixed_points_) return {};
  fixed_points_ = std::move(*points);
  constraints_changed();
  return {};
}

Result<HandleId> Deformer::add_handle(std::span<const Index> vertices) {
  if (vertices.empty()) return invalid_handle("vertices is empty; expected at least one vertex id");
  std::vector<Index> kept;
  auto points = checked_points(vertices, "vertices", &kept);
  if (!points.ok()) return points.status();
  std::vector<bool> taken(shape().points().cols(), false);
  for (Index point : fixed_points_) taken[point] = true;
  for (const Handle& handle : handles_) {
    for (Index point : handle.points) taken[point] = true;
  }
  for (Index point : *points) {
    if (!taken[point]) continue;
    return invalid_handle("vertices holds vertex " + std::to_string(shape().vertex_of_point()[point]) +
                          ", which is fixed or belongs to another handle; expected a free vertex");
  }
  Handle handle;
  handle.id = next_id_++;
  handle.points = std::move(*points);
  handle.rest = shape().points()(Eigen::all, handle.points);
  handle.targets = handle.rest;
  handles_.push_back(std::move(handle));
  columns_.push_back({static_cast<Index>(vertices.size()), std::move(kept)});
  constraints_changed();
  return handles_.back().id;
}

Status Deformer::remove_handle(HandleId id) {
  Handle* handle = find(id);
  if (handle == nullptr) return invalid_handle("there is no handle " + std::to_string(id));
  columns_.erase(columns_.begin() + (handle - handles_.data()));
  handles_.erase(handles_.begin() + (handle - handles_.data()));
  constraints_changed();
  return {};
}

Status Deformer::move_handle(HandleId id, const Motion& motion) {
  Handle* handle = find(id);
  if (handle == nullptr) return invalid_handle("there is no handle " + std::to_string(id));
  if (!(motion.axis.norm() > 0.0)) {
    return invalid_handle("rotate.axis is the zero vector; expected a direction");
  }
  const Eigen::Affine3d map = motion.map();
  Points targets(3, handle->rest.cols());
  for (Index i = 0; i < targets.cols(); ++i) targets.col(i) = map * handle->rest.col(i);
  if (!targets.allFinite()) return invalid_handle("the motion takes vertices out of range; expected finite numbers");
  handle->targets = std::move(targets);
  handle->motion = motion;
  targets_changed();
  return {};
}

Status Deformer::set_targets(HandleId id, const Points& targets) {
  Handle* handle = find(id);
  if (handle == nullptr) return invalid_handle("there is no handle " + std::to_string(id));
  const Columns& columns = columns_[handle - handles_.data()];
  if (targets.cols() != columns.given) {
    return invalid_handle("targets has " + std::to_string(targets.cols()) + " points; expected " +
                          std::to_string(columns.given) + ", one for each vertex of the handle");
  }
  for (Index i = 0; i < targets.cols(); ++i) {
    if (targets.col(i).allFinite()) continue;
    return invalid_handle(at("targets", i) + " is not finite; expected finite coordinates");
  }
  handle->targets = targets(Eigen::all, columns.kept);
  handle->motion.reset();
  targets_changed();
  return {};
}

Result<StepReport> Deformer::step(double tolerance) {
  if (!(tolerance > 0.0)) {
    return Status(ErrorCode::invalid_option,
                  "tolerance is " + std::to_string(tolerance) + "; expected a number above 0");
  }
  return do_step(tolerance);
}

void Deformer::reset() {
  for (Handle& handle : handles_) {
    handle.targets = handle.rest;
    handle.motion.reset();
  }
  do_reset();
}

void Deformer::save_handles(State& state) const {
  StateTable sizes{"handles/sizes", 1, true, {}}, vertices{"handles/vertices", 1, true, {}},
      targets{"handles/targets", 3, false, {}};
  for (const Handle& handle : handles_) {
    sizes.data.push_back(static_cast<double>(handle.points.size()));
    for (Index point : handle.points) vertices.data.push_back(shape().vertex_of_point()[point]);
    targets.data.insert(targets.data.end(), handle.targets.data(), handle.targets.data() + handle.targets.size());
  }
  state.tables.push_back(std::move(sizes));
  state.tables.push_back(std::move(vertices));
  state.tables.push_back(std::move(targets));
}

Status Deformer::restore_handles(const State& state) {
  const StateTable* sizes = state.find("handles/sizes");
  const StateTable* vertices = state.find("handles/vertices");
  const StateTable* targets = state.find("handles/targets");
  if (sizes == nullptr || vertices == nullptr || targets == nullptr) return {};
  std::size_t at = 0;
  for (double count : sizes->data) {
    const std::size_t size = count > 0.0 && count < 1e9 ? static_cast<std::size_t>(count) : 0;
    if (at + size > vertices->data.size() || 3 * (at + size) > targets->data.size()) {
      return {ErrorCode::invalid_option, "handles of the state is cut short; expected one target a vertex"};
    }
    for (Handle& handle : handles_) {
      const auto same = [&](Index point, double vertex) {
        return shape().vertex_of_point()[point] == static_cast<Index>(vertex);
      };
      if (handle.points.size() != size ||
          !std::equal(handle.points.begin(), handle.points.end(), vertices->data.begin() + at, same)) {
        continue;
      }
      handle.targets = Eigen::Map<const Points>(targets->data.data() + 3 * at, 3, size);
      handle.motion.reset();
    }
    at += size;
  }
  targets_changed();
  return {};
}

}  // namespace pliant

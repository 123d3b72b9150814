// What a Sketch saves, and takes back.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <Eigen/Geometry>

#include "pliant/sketch/drawing.h"
#include "pliant/sketch/sketch_model.h"

namespace pliant {
namespace {

Status invalid(std::string message) { return {ErrorCode::invalid_option, std::move(message)}; }

void append(StateTable& table, const Points& points) {
  table.data.insert(table.data.end(), points.data(), points.data() + points.size());
}

/// `pose/heading` and so on, a table each.
void add_pose(State& state, const SketchPose& pose) {
  for (NamedValue& value : named_pose(pose)) {
    const int columns = value.name == "turns" ? 1 : value.name == "twist" || value.name == "scale" ? 2 : 0;
    state.add("pose/" + value.name, columns, false).data = std::move(value.numbers);
  }
}

Result<SketchPose> pose_of(const State& state) {
  NamedValues given;
  for (const StateTable& table : state.tables) {
    if (table.name.starts_with("pose/")) given.push_back({table.name.substr(5), {}, table.data});
  }
  return read_pose(given);
}

/// A state of this region and this stroke over it: poses are relative to both.
Status check_drawing(const Sketch& sketch, const State& state) {
  const StateTable* labels = state.find("labels");
  const std::vector<Index> own = sketch.labels();
  if (labels == nullptr || !std::equal(own.begin(), own.end(), labels->data.begin(), labels->data.end())) {
    return invalid("labels of the state are not those of this sketch; expected the same region");
  }
  const StateTable* reference = state.find("reference");
  const Points curve = sketch.reference();
  const auto same = [&](double a, double b) { return std::abs(a - b) <= 1e-9 * sketch.shape().diagonal(); };
  if (reference == nullptr || reference->data.size() < static_cast<std::size_t>(curve.size()) ||
      !std::equal(curve.data(), curve.data() + curve.size(), reference->data.begin(), same)) {
    return invalid("reference of the state is not that of this sketch; expected the same stroke");
  }
  return {};
}

std::vector<double> numbers_of(const std::optional<Refinement>& refinement) {
  std::vector<double> ids;
  if (!refinement) return ids;
  for (const auto& [a, b] : refinement->parents) ids.insert(ids.end(), {double(a), double(b)});
  return ids;
}

}  // namespace

/// Beside the tables of docs/state-and-report.md: `pose` and `morph`, all that `restore` needs; `normals`, the axes of
/// `angles`, one a side; with a mirror `sides` (of every vertex: 0 drawn, 1 mirrored), and the curves of the second
/// side follow those of the first. With twist or scale: `joints`, `twists` (right-handed about the joints' curve) and
/// `scales`, applied before the bend; where nothing bends `angles` are the twists.
State Sketch::save() const {
  const Impl& model = *impl_;
  const SketchPose pose = model.whole_pose();
  const bool with_joints = pose.twists() || pose.scales();
  StateTable labels{"labels", 1, true, {}}, s{"s", 1, false, {}}, angles{"angles", 1, false, {}},
      reference{"reference", 3, false, {}}, target{"target", 3, false, {}}, normals{"normals", 3, false, {}},
      sides{"sides", 1, true, {}}, joints{"joints", 3, false, {}}, twists{"twists", 1, false, {}},
      scales{"scales", 1, false, {}};
  for (const Index label : this->labels()) labels.data.push_back(label);
  s.data = parameters();
  for (Index v = 0; v < static_cast<Index>(s.data.size()); ++v) {
    const Index p = model.point_of(v);
    const Limb& limb = model.limb_of(p);
    const bool mirrored = &limb != &model.limbs.front();
    const double twist = model.morph * limb.twist()[p] * (mirrored ? -1.0 : 1.0);
    angles.data.push_back(pose.bends() ? model.morph * limb.bend()[p] : twist);
    twists.data.push_back(twist);
    scales.data.push_back(1.0 + model.morph * (limb.scale()[p] - 1.0));
    sides.data.push_back(mirrored);
  }
  for (const Limb& limb : model.limbs) {
    append(reference, SketchModel::in_space(limb, limb.reference()));
    append(target, SketchModel::in_space(limb, bent(limb.reference(), pose, model.morph)));
    const Eigen::Matrix3d& axes = limb.camera().axes();
    append(normals, axes.row(0).cross(axes.row(1)).transpose());
    Points places = limb.joints();
    for (auto place : places.colwise()) place = limb.camera().to_world(place);
    append(joints, places);
  }
  State state;
  for (StateTable* table : {&labels, &s, &angles, &reference, &target, &normals}) {
    state.tables.push_back(std::move(*table));
  }
  add_pose(state, pose);
  state.add("morph", 0, false).data = {model.morph};
  if (model.limbs.size() > 1) state.tables.push_back(std::move(sides));
  if (with_joints) {
    for (StateTable* table : {&joints, &twists, &scales}) state.tables.push_back(std::move(*table));
  }
  if (model.refinement) {
    append(state.add("rest", 3, false), rest().rightCols(model.point_of_added.size()));
    state.add("parents", 2, true).data = numbers_of(model.refinement);
  }
  return state;
}

Status Sketch::restore(const State& state) {
  if (Status status = check_drawing(*this, state); !status.ok()) return status;
  const StateTable* morph = state.find("morph");
  if (morph == nullptr || morph->data.size() != 1 || !(morph->data[0] >= 0.0 && morph->data[0] <= 1.0)) {
    return invalid("the state has no morph from 0 to 1; expected one of a sketch");
  }
  const StateTable* s = state.find("s");
  const StateTable* parents = state.find("parents");
  const std::size_t added = parents == nullptr ? 0 : parents->data.size() / 2;
  if (s == nullptr || s->data.size() != static_cast<std::size_t>(shape().input_size()) + added) {
    return invalid("s of the state does not fit the shape; expected one number a vertex");
  }
  if (added > 0 && parents->data != numbers_of(impl_->refinement)) {
    return invalid("parents of the state are not those of this sketch; expected the same refinement, or none");
  }
  const Result<SketchPose> pose = pose_of(state);
  if (!pose.ok()) return pose.status();
  const double before = std::exchange(impl_->morph, morph->data[0]);
  if (Status status = set_pose(*pose); !status.ok()) {
    impl_->morph = before;
    return status;
  }
  if (added == 0 && !impl_->point_of_added.empty()) unrefine();
  return {};
}

}  // namespace pliant

#include "pliant/solve/deformer.h"

#include "pliant/core/message.h"

namespace pliant {

Status Deformer::set_fixed(std::span<const Index> vertices) {
  const auto others = constraints_.set_fixed(vertices);
  if (!others.ok()) return others.status();
  if (*others) pattern_changed();
  return {};
}

Result<HandleId> Deformer::add_handle(std::span<const Index> vertices) {
  auto id = constraints_.add_handle(vertices);
  if (id.ok()) pattern_changed();
  return id;
}

Status Deformer::remove_handle(HandleId id) {
  Status status = constraints_.remove_handle(id);
  if (status.ok()) pattern_changed();
  return status;
}

Status Deformer::move_handle(HandleId id, const Motion& motion) {
  Status status = constraints_.move_handle(id, motion);
  if (status.ok()) stale_.targets = true;
  return status;
}

Status Deformer::set_targets(HandleId id, const Points& targets) {
  Status status = constraints_.set_targets(id, targets);
  if (status.ok()) stale_.targets = true;
  return status;
}

Status Deformer::take_changes() {
  if (stale_.pattern) {
    if (Status s = set_up(); !s.ok()) return s;
    iteration_ = 0;
    stale_ = {.pattern = false, .matrix = false, .targets = true};
  } else if (stale_.matrix) {
    if (Status s = refactorize(); !s.ok()) return s;
    stale_.matrix = false;
  }
  if (stale_.targets) predict(constraints_, take_targets());
  stale_.targets = false;
  return {};
}

Status Deformer::set_options(const NamedValues& given) {
  if (given.empty()) return {};
  return {ErrorCode::invalid_option,
          message({given.front().name, " cannot change while a deformer lives; expected none, or another deformer"})};
}

Result<Points> Deformer::field() const {
  return Status(ErrorCode::not_solvable, "this method has no directions; expected one whose material has");
}

Result<StepReport> Deformer::step(double tolerance) {
  if (!(tolerance > 0.0)) {
    return Status(ErrorCode::invalid_option, message({"tolerance is ", tolerance, "; expected a number above 0"}));
  }
  if (Status s = take_changes(); !s.ok()) return s;
  auto report = iterate(tolerance);
  if (!report.ok()) return report;
  if (report->accepted) ++iteration_;
  report->iteration = iteration_;
  return report;
}

void Deformer::reset() {
  constraints_.reset();
  do_reset();
  stale_.targets = true;
  iteration_ = 0;
}

State Deformer::save() const {
  State state = do_save();
  constraints_.save(state);
  return state;
}

Status Deformer::restore(const State& state) {
  if (Status s = constraints_.check(state); !s.ok()) return s;
  if (Status s = do_restore(state); !s.ok()) return s;
  constraints_.restore(state);
  stale_.targets = true;
  iteration_ = 0;
  return {};
}

}  // namespace pliant

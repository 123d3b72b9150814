#include "pliant/deformers/rigid_cells/deformer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "pliant/core/message.h"
#include "pliant/core/sort.h"
#include "pliant/deformers/rigid_cells/impl.h"
#include "pliant/geometry/normals.h"

namespace pliant {

using namespace cells;

namespace {

/// A part that nothing holds rides on what is beside it if it is smaller than this, of the diagonal.
constexpr double kSmallPart = 0.25;
/// Cells that differ by this part of their side lie together but for rounding.
constexpr double kRounding = 1e-12;
/// Cells whose strain is above this are split; those that were are joined again where it is below the other. Halves of
/// a cell strain half as much as the whole: joined cells are strained half as much as would split them again.
constexpr double kFine = 0.1, kCoarse = 0.025;
/// Refinement makes no more than so many times the cells there were.
constexpr Index kMostRefined = 2;

}  // namespace

void RigidCells::Impl::take_tree(const Shape& shape) {
  model = cell_model(tree, shape, point_factors);
  cell_of_point.clear();
  for (Index p = 0; p < shape.points().cols(); ++p) cell_of_point.push_back(tree.cell_at(shape.points().col(p)));
  carrier.forget_cells();
}

std::vector<Hold> RigidCells::Impl::find_holds(const RigidCells& self) const {
  return cells::find_holds(model, self.shape(), cell_of_point, self.fixed_points(), self.handles(), options.hold);
}

RigidCells::RigidCells(std::shared_ptr<const Shape> shape, std::unique_ptr<Impl> impl)
    : Deformer(std::move(shape)), impl_(std::move(impl)) {}
RigidCells::~RigidCells() = default;

Result<std::unique_ptr<RigidCells>> RigidCells::create(std::shared_ptr<const Shape> shape,
                                                       const RigidCellsOptions& options) {
  if (Status s = options.validate(*shape); !s.ok()) return s;
  Result<CellTree> tree = CellTree::create(*shape, options);
  if (!tree.ok()) return tree.status();
  auto impl = std::make_unique<Impl>(std::move(*tree));
  impl->options = options;
  impl->carrier.set_transfer(options.transfer);
  impl->point_factors = point_factors(*shape, options.stiffness);
  impl->take_tree(*shape);
  impl->motions = impl->model.rest();
  impl->cells_at_rest = impl->model.size();
  return std::unique_ptr<RigidCells>(new RigidCells(std::move(shape), std::move(impl)));
}

const RigidCellsOptions& RigidCells::options() const { return impl_->options; }

Status RigidCells::set_options(const RigidCellsOptions& options) {
  if (Status s = options.validate(shape()); !s.ok()) return s;
  Impl& impl = *impl_;
  const RigidCellsOptions& now = impl.options;
  const char* built_in = options.resolution != now.resolution             ? "resolution"
                         : options.align != now.align                     ? "align"
                         : options.boundary_levels != now.boundary_levels ? "boundaryLevels"
                         : options.interior != now.interior               ? "interior"
                                                                          : nullptr;
  if (built_in != nullptr) {
    return {ErrorCode::invalid_option,
            message({built_in, " cannot change while a deformer lives; expected another deformer"})};
  }
  if (options.transfer != now.transfer) impl.carrier.forget_cells();
  impl.carrier.set_transfer(options.transfer);
  impl.options = options;
  impl.point_factors = point_factors(shape(), options.stiffness);
  impl.model = cell_model(impl.tree, shape(), impl.point_factors);
  pattern_changed();
  return {};
}

Status RigidCells::set_options(const NamedValues& given) {
  RigidCellsOptions options = impl_->options;
  if (Status s = read(given, options); !s.ok()) return s;
  return set_options(options);
}

NamedValues RigidCells::options_by_name() const { return named(impl_->options); }

std::vector<Index> RigidCells::held_points() const {
  std::vector<Index> points = fixed_points();
  const std::vector<Index> moved = constraints().moved_points();
  points.insert(points.end(), moved.begin(), moved.end());
  return points;
}

Points RigidCells::held_targets() const {
  Points targets(3, static_cast<Index>(held_points().size()));
  targets << shape().points()(Eigen::all, fixed_points()), constraints().targets();
  return targets;
}

Status RigidCells::set_up() {
  Impl& impl = *impl_;
  std::vector<bool> held(impl.model.size(), false);
  std::vector<Freedom> freedom(impl.model.size(), Freedom::free);
  for (const Hold& hold : impl.find_holds(*this)) {
    freedom[hold.cell] = hold.freedom;
    held[hold.cell] = true;
  }
  const GridFrame& frame = impl.tree.frame();
  impl.riders = find_riders(impl.model, held, kSmallPart * 2.0 * frame.middle.norm() * frame.unit);
  for (const Rider& rider : impl.riders) freedom[rider.cell] = Freedom::held;
  const Index per_turn = frame.dimension == 2 ? 1 : 3;
  impl.unknowns = 0;
  for (const Freedom f : freedom) {
    if (f == Freedom::free) impl.unknowns += frame.dimension;
    if (f != Freedom::held) impl.unknowns += per_turn;
  }
  impl.solver.set_up(impl.model, freedom);
  impl.start.set_up(impl.model, impl.cell_of_point, impl.riders, fixed_points(), handles());
  ++impl.set_ups;
  return {};
}

Start& RigidCells::take_targets() {
  Impl& impl = *impl_;
  impl.holds = impl.find_holds(*this);
  const Points targets = held_targets();
  impl.may_join |= targets.cols() != impl.carrier.targets().cols() || targets != impl.carrier.targets();
  impl.carrier.hold(shape(), impl.tree, held_points(), targets);
  impl.solver.forget();
  impl.start.begin(impl.motions, impl.holds);
  impl.begins = true;
  return impl.start;
}

Result<StepReport> RigidCells::iterate(double tolerance) {
  Impl& impl = *impl_;
  if (std::exchange(impl.begins, false)) impl.motions = impl.start.motions();
  const CellSolver::Outcome outcome = impl.solver.step(impl.motions, impl.holds);
  ride(impl.riders, impl.model, impl.motions);
  double stiffness = 0.0;
  for (const double weight : impl.model.weights) stiffness += weight;
  const double rounding = kRounding * shape().diagonal();
  const bool settled = outcome.accepted
                           ? outcome.decrease <= tolerance && outcome.move <= tolerance * shape().diagonal()
                           : outcome.promised <= kRounding;
  const bool at_zero = outcome.energy <= stiffness * rounding * rounding;
  return StepReport{0, outcome.energy, outcome.accepted, settled || at_zero};
}

void RigidCells::do_reset() {
  impl_->motions = impl_->model.rest();
  impl_->carrier.hold(shape(), impl_->tree, {}, Points(3, 0));
}

void RigidCells::Impl::take_cells(const Shape& shape, const CellTree::Origins& origins) {
  const CellModel before = std::move(model);
  take_tree(shape);
  motions = inherited_motions(before, motions, model, origins);
}

std::vector<bool> RigidCells::Impl::cells_to_split() const {
  const std::vector<double> strains = model.strains(motions);
  const auto most_strained = order_by(model.size(), [&](Index i) { return key_of(-strains[i]); });
  const Index gain = tree.frame().dimension == 2 ? 3 : 7;
  Index room = (kMostRefined * cells_at_rest - model.size()) / gain;
  std::vector<bool> wanted(strains.size(), false);
  for (const Index i : most_strained) {
    if (!(strains[i] > kFine) || room <= 0) break;
    if (tree.level(i) == tree.frame().depth) continue;
    wanted[i] = true;
    --room;
  }
  return wanted;
}

Result<Index> RigidCells::refine() {
  Impl& impl = *impl_;
  if (!impl.options.refine || !up_to_date()) return Index{0};
  const Index before = impl.model.size();
  // Once after targets have moved, so that cells do not come and go.
  if (std::exchange(impl.may_join, false)) {
    const std::vector<double> strains = impl.model.strains(impl.motions);
    std::vector<bool> may_go(strains.size());
    for (std::size_t i = 0; i < strains.size(); ++i) may_go[i] = strains[i] < kCoarse;
    impl.take_cells(shape(), impl.tree.join(may_go));
  }
  const Index joined = before - impl.model.size();
  if (joined > 0) pattern_changed();
  const std::vector<bool> wanted = impl.cells_to_split();
  if (std::find(wanted.begin(), wanted.end(), true) != wanted.end()) {
    const auto origins = impl.tree.split(wanted);
    if (!origins.ok()) return origins.status();
    impl.take_cells(shape(), *origins);
    pattern_changed();
  }
  return 2 * joined + impl.model.size() - before;
}

Energy RigidCells::energy() const {
  const Impl& impl = *impl_;
  std::vector<CellMotion> motions = impl.motions;
  if (!up_to_date()) apply(impl.find_holds(*this), impl.model, motions);
  const double total = impl.model.energy(motions);
  return {total, {{"elastic", total, 1.0}}};
}

Counters RigidCells::counters() const { return {impl_->unknowns, impl_->set_ups, impl_->set_ups}; }

Points RigidCells::point_positions() const { return impl_->carrier.carry_shape(shape(), impl_->moved_cells()); }

Points RigidCells::point_normals() const { return pliant::point_normals(point_positions(), shape().triangles()); }

Result<Points> RigidCells::transform_points(const Points& points) const {
  return impl_->carrier.carry(shape(), points, impl_->moved_cells());
}

}  // namespace pliant

#include "pliant/deformers/rigid_cells/deformer.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "pliant/deformers/rigid_cells/impl.h"
#include "pliant/deformers/rigid_cells/pieces.h"
#include "pliant/geometry/normals.h"

namespace pliant {

using namespace cells;

namespace {

/// A part that nothing holds rides on what is beside it if it is smaller than this, of the diagonal.
constexpr double kSmallPart = 0.25;
/// Cells that differ by this part of their side lie together but for rounding.
constexpr double kRounding = 1e-12;
/// Cells whose strain is above this are split.
constexpr double kFine = 0.1;

}  // namespace

void RigidCells::Impl::take_tree(const Shape& shape) {
  model = cell_model(tree, shape, point_factors);
  cell_of_point.clear();
  for (Index p = 0; p < shape.points().cols(); ++p) cell_of_point.push_back(tree.cell_at(shape.points().col(p)));
  pieces = small_pieces(shape, tree.frame().unit * (1 << tree.frame().depth));
  map.reset();
  followed.clear();
}

std::vector<Hold> RigidCells::Impl::find_holds(const RigidCells& self) const {
  return cells::find_holds(model, self.shape(), cell_of_point, self.fixed_points(), self.handles(), options.hold);
}

void RigidCells::Impl::prepare_map(const Shape& shape) {
  if (options.transfer == CellTransfer::blend) {
    if (followed.empty()) followed = followed_cells(tree.centers(), shape.points());
  } else if (map == nullptr) {
    map = std::make_unique<SmoothMap>(tree);
    places = map->place(shape.points());
  }
}

Points RigidCells::Impl::carry_shape(const Shape& shape) {
  prepare_map(shape);
  Points out;
  if (options.transfer == CellTransfer::blend) {
    blend(followed, tree.centers(), motions, model.origin, shape.points(), out);
  } else {
    map->set_motions(motions, model.origin);
    map->carry(places, shape.points(), out);
  }
  keep_rigid(pieces, shape.points(), out);
  if (shape.dimension() == 2) out.row(2).setZero();
  return out;
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
  impl->point_factors = point_factors(*shape, options.stiffness);
  impl->take_tree(*shape);
  impl->motions = impl->model.rest();
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
            std::string(built_in) + " cannot change while a deformer lives; expected another deformer"};
  }
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
  pattern_changed();
}

Result<Index> RigidCells::refine() {
  Impl& impl = *impl_;
  if (!impl.options.refine || !up_to_date()) return Index{0};
  const std::vector<double> strains = impl.model.strains(impl.motions);
  std::vector<bool> wanted(strains.size());
  bool any = false;
  for (std::size_t i = 0; i < strains.size(); ++i) {
    wanted[i] = strains[i] > kFine && impl.tree.level(static_cast<Index>(i)) < impl.tree.frame().depth;
    any |= wanted[i];
  }
  if (!any) return Index{0};
  const Points before = impl.model.centers;
  const std::vector<CellMotion> parents = impl.motions;
  Result<std::vector<Index>> origin = impl.tree.split(wanted);
  if (!origin.ok()) return origin.status();
  impl.take_tree(shape());
  impl.motions = impl.model.rest();
  for (Index i = 0; i < impl.model.size(); ++i) {
    const CellMotion& parent = parents[(*origin)[i]];
    const Eigen::Vector3d arm = impl.model.centers.col(i) - before.col((*origin)[i]);
    impl.motions[i].rotation = parent.rotation;
    impl.motions[i].center = parent.center + parent.rotation * arm;
  }
  pattern_changed();
  return impl.model.size() - static_cast<Index>(parents.size());
}

Energy RigidCells::energy() const {
  const Impl& impl = *impl_;
  std::vector<CellMotion> motions = impl.motions;
  if (!up_to_date()) apply(impl.find_holds(*this), impl.model, motions);
  const double total = impl.model.energy(motions);
  return {total, {{"elastic", total, 1.0}}};
}

Counters RigidCells::counters() const { return {impl_->unknowns, impl_->set_ups, impl_->set_ups}; }

Points RigidCells::point_positions() const { return impl_->carry_shape(shape()); }

Points RigidCells::point_normals() const { return pliant::point_normals(point_positions(), shape().triangles()); }

Result<Points> RigidCells::transform_points(const Points& points) const {
  Impl& impl = *impl_;
  impl.prepare_map(shape());
  Points out;
  if (impl.options.transfer == CellTransfer::blend) {
    const Points centers = impl.tree.centers();
    blend(followed_cells(centers, points), centers, impl.motions, impl.model.origin, points, out);
  } else {
    const SmoothMap::Places places = impl.map->place(points);
    impl.map->set_motions(impl.motions, impl.model.origin);
    impl.map->carry(places, points, out);
  }
  if (shape().dimension() == 2) out.row(2) = points.row(2);
  return out;
}

}  // namespace pliant

// Embedded deformation (Sumner, Schmid, Pauly: Embedded Deformation for Shape Manipulation,
// SIGGRAPH 2007): affine transformations on the nodes of a graph, blended over the shape.
#pragma once

#include <memory>

#include "pliant/deformers/embedded_graph/options.h"
#include "pliant/solve/deformer.h"

namespace pliant {

class EmbeddedGraph final : public Deformer {
 public:
  /// Builds the graph. Errors: invalid_option; too_large (the system would not fit in memory).
  static Result<std::unique_ptr<EmbeddedGraph>> create(std::shared_ptr<const Shape> shape,
                                                       const EmbeddedGraphOptions& options);
  ~EmbeddedGraph() override;

  /// Adds up to `max_nodes` nodes where rotation and regularisation terms are high (the paper's
  /// future work); the deformation carries over, handles and fixed region stay. Returns how many
  /// were added: 0 where no node stands out. Errors: invalid_option (max_nodes < 1), too_large.
  Result<Index> refine(Index max_nodes);
  Result<Index> refine() override;

  NamedValues options_by_name() const override;
  /// Terms: `rotation`, `regularization`, `constraint` (eq. 5 to 8) and, where a node is near collapse,
  /// `barrier` (barrier.h), weighted as `rotation`.
  Energy energy() const override;
  Counters counters() const override;
  Points point_positions() const override;
  Points point_normals() const override;
  Result<Points> transform_points(const Points& points) const override;

 protected:
  Status set_up() override;
  Start& take_targets() override;
  Result<StepReport> iterate(double tolerance) override;
  void do_reset() override;
  State do_save() const override;
  Status do_restore(const State& state) override;

 private:
  struct Impl;
  EmbeddedGraph(std::shared_ptr<const Shape> shape, std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace pliant

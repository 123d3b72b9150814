// Material-aware edges (Material Aware Mesh Deformation; equation numbers are the paper's): every
// edge keeps its length and its distance from the line between the two points across it.
#pragma once

#include <memory>

#include "pliant/deformers/edge_material/options.h"
#include "pliant/solve/local_global_deformer.h"

namespace pliant {

/// Open, closed and non-manifold meshes. Handles are exact. Deforms the surface, not space:
/// transform_points is not_solvable.
class EdgeMaterial final : public LocalGlobalDeformer {
 public:
  /// Errors: invalid_option; invalid_shape (no triangles).
  static Result<std::unique_ptr<EdgeMaterial>> create(std::shared_ptr<const Shape> shape,
                                                      const EdgeMaterialOptions& options);
  ~EdgeMaterial() override;

  /// Replaces the options of a living deformer; handles, targets and the deformation stay, the next
  /// step goes on from there. Cost at that step: `p_stretch`, `p_bend` and `gravity`: nothing;
  /// `stretch`, `lambda`, `bend` and `field`: one factorisation, no analysis. Errors:
  /// invalid_option, not_solvable, too_large (from the field); then nothing changes.
  Status set_options(const EdgeMaterialOptions& options);
  Status set_options(const NamedValues& given) override;
  const EdgeMaterialOptions& options() const;
  NamedValues options_by_name() const override;
  /// The lambda in use (eq. 7).
  double lambda() const;
  Result<Points> field() const override;

  /// Terms: `stretch` (weight lambda p_stretch), `bend` (weight mu p_bend), `gravity`, and
  /// `constraint`, which is 0: handles are exact.
  Energy energy() const override;
  /// edges[]/i, j, l, m (-1: no bending term), alpha, beta, rho, sigma, kappa; weights/lambda, mu, pStretch, pBend,
  /// gravity (the force on a vertex); floating: vertices of parts that nothing holds, on which gravity does not act;
  /// folded[]/edge, normal: edges so folded that they have no normal of their own; result; handles.
  State do_save() const override;
  /// Needs `result`; takes the normals of `folded` where it is there.
  Status do_restore(const State& state) override;

 private:
  LocalModel& model() const override;
  struct Impl;
  EdgeMaterial(std::shared_ptr<const Shape> shape, std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace pliant

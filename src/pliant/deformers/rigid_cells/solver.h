// Newton's method on the energy of the cells (Botsch 2007, section 4).
#pragma once

#include <array>
#include <vector>

#include "pliant/core/status.h"
#include "pliant/deformers/rigid_cells/holds.h"
#include "pliant/deformers/rigid_cells/multigrid.h"
#include "pliant/solve/lbfgs.h"

namespace pliant::cells {

/// Finds the rigid motions of cells glued to each other. Coordinates: about the scene's centre.
///
/// Inexact Newton: the linearised system is solved to a part of its gradient. What the linearisation
/// leaves out (the stress that is in the cells already) an L-BFGS memory learns, in the metric of
/// that system.
class CellSolver {
 public:
  struct Outcome {
    bool accepted = false;
    double energy = 0.0;    ///< after the step
    double decrease = 0.0;  ///< of the energy, relative
    double move = 0.0;      ///< the farthest a corner of a cell has moved, at most
    double promised = 0.0;  ///< by the last direction: slope over the energy, relative
    int inner = 0;          ///< iterations of linear solves
  };

  /// The pattern. freedom: of each cell. Keeps a reference to the model.
  void set_up(const CellModel& model, const std::vector<Freedom>& freedom);
  /// What is held has moved: what was learnt no longer holds.
  void forget() { remembers_ = false; }

  /// One iteration. holds: of cells that are held, where `motions` has them already.
  Outcome step(std::vector<CellMotion>& motions, const std::vector<Hold>& holds);

 private:
  double linearize(const std::vector<CellMotion>& motions);
  void find_direction(Outcome& outcome);
  bool descend(const std::vector<CellMotion>& motions, const std::vector<Hold>& holds, double before, Outcome& outcome);

  const CellModel* model_ = nullptr;
  Multigrid system_;
  Lbfgs memory_{6};
  Eigen::VectorXd gradient_, direction_, last_gradient_, last_step_;
  bool remembers_ = false;  ///< last_gradient_ and last_step_ are those of the step before
  std::vector<CellMotion> next_;
};

}  // namespace pliant::cells

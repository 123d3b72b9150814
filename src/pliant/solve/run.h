// The outer loop of native code: criteria, progress and cancellation. (In JavaScript: bindings/js/edit.)
#pragma once

#include "pliant/solve/deformer.h"

namespace pliant {

struct StopCriteria {
  int max_iterations = 100;
  double tolerance = 1e-6;  ///< of the method's own test
};

/// Runs a deformer step by step, so that a caller can yield, report and cancel in between:
///   for (Run run(deformer, stop); !run.done();) if (auto s = run.advance(); !s.ok()) return
///   s.status();
class Run {
 public:
  Run(Deformer& deformer, StopCriteria stop) : deformer_(deformer), stop_(stop) {}

  bool done() const { return done_; }
  bool converged() const { return converged_; }
  int iterations() const { return iterations_; }
  Result<StepReport> advance();

 private:
  Deformer& deformer_;
  StopCriteria stop_;
  int iterations_ = 0;
  bool done_ = false;
  bool converged_ = false;
};

/// Runs to the end; the report of the last step.
Result<StepReport> run(Deformer& deformer, StopCriteria stop = {});

}  // namespace pliant

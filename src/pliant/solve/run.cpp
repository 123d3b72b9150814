#include "pliant/solve/run.h"

namespace pliant {

Result<StepReport> Run::advance() {
  Result<StepReport> report = deformer_.step(stop_.tolerance);
  if (!report.ok()) {
    done_ = true;
    return report;
  }
  if (report->accepted) ++iterations_;
  converged_ = report->converged;
  done_ = converged_ || !report->accepted || iterations_ >= stop_.max_iterations;
  return report;
}

Result<StepReport> run(Deformer& deformer, StopCriteria stop) {
  Run loop(deformer, stop);
  for (;;) {
    Result<StepReport> report = loop.advance();
    if (!report.ok() || loop.done()) return report;
  }
}

}  // namespace pliant

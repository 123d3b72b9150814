#include "pliant/solve/approach.h"

#include <algorithm>
#include <limits>

namespace pliant {
namespace {

/// The ratio of a single step to the next, which is not known yet.
constexpr double kFirstRatio = 0.9;

}  // namespace

void Approach::add(double length) { lengths_[count_++ % lengths_.size()] = length; }

double Approach::left() const {
  if (count_ == 0) return std::numeric_limits<double>::infinity();
  const auto way = [&](int first, int last) {
    double sum = 0.0;
    for (int i = first; i < last; ++i) sum += lengths_[i % lengths_.size()];
    return sum;
  };
  const int window = std::min(kWindow, count_ / 2);
  if (window == 0) return kFirstRatio / (1.0 - kFirstRatio) * way(0, 1);
  const double recent = way(count_ - window, count_), earlier = way(count_ - 2 * window, count_ - window);
  if (recent == 0.0) return 0.0;
  return recent < earlier ? recent * recent / (earlier - recent) : std::numeric_limits<double>::infinity();
}

}  // namespace pliant

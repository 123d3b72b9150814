// How far a descent still has to go. A small step is not a small distance from the minimum: steps that shrink by a
// factor q each add up to q / (1 - q) times the last one, a hundredfold where q is 0.99.
#pragma once

#include <array>

namespace pliant {

class Approach {
 public:
  /// Steps so far say nothing about those to come.
  void restart() { count_ = 0; }
  /// One more step of this length, of any unit.
  void add(double length);
  /// Estimate of the way left, in the same unit: that of a geometric series with the ratio of the last steps to those
  /// before them. Infinite where they do not shrink, and before the first step.
  double left() const;

 private:
  /// Steps of a quasi-Newton method go up and down: so many are compared with as many before.
  static constexpr int kWindow = 8;

  std::array<double, 2 * kWindow> lengths_{};  ///< a ring
  int count_ = 0;
};

}  // namespace pliant

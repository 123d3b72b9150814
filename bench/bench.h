// Measuring: warm medians, printed as JSON lines beside their yardstick.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace pliant::bench {

/// Milliseconds since some fixed moment.
double now();

/// Median of the durations of `runs` calls, in ms, after one that is not counted.
double median_ms(int runs, const std::function<void()>& call);
double median(std::vector<double> values);

/// The words of the command line: a bench runs when its name contains one of them, or there is
/// none.
class Reporter {
 public:
  explicit Reporter(std::vector<std::string> words) : words_(std::move(words)) {}
  bool wants(const std::string& name) const;
  /// {"name", "ms"}, and with a yardstick (ms, above 0) also {"yardstick", "ratio"}.
  void report(const std::string& name, double ms, double yardstick = 0.0, const std::string& note = "") const;

 private:
  std::vector<std::string> words_;
};

/// Announces benches, which run in the order of the sources in CMakeLists.txt:
///   const Bench bench(bench_arap);
class Bench {
 public:
  using Function = void (*)(const Reporter& reporter);
  explicit Bench(Function function) { all().push_back(function); }
  static std::vector<Function>& all();
};

}  // namespace pliant::bench

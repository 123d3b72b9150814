#include "bench.h"

#include <algorithm>
#include <chrono>
#include <cstdio>

namespace pliant::bench {

double now() {
  const auto since = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double, std::milli>(since).count();
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

double median_ms(int runs, const std::function<void()>& call) {
  std::vector<double> durations;
  for (int i = 0; i <= runs; ++i) {
    const double start = now();
    call();
    if (i > 0) durations.push_back(now() - start);
  }
  return median(std::move(durations));
}

std::vector<Bench::Function>& Bench::all() {
  static std::vector<Function> benches;
  return benches;
}

bool Reporter::wants(const std::string& name) const {
  return words_.empty() || std::any_of(words_.begin(), words_.end(),
                                       [&](const std::string& word) { return name.find(word) != std::string::npos; });
}

void Reporter::report(const std::string& name, double ms, double yardstick, const std::string& note) const {
  std::printf("{\"name\":\"%s\",\"ms\":%.6g", name.c_str(), ms);
  if (yardstick > 0.0) std::printf(",\"yardstick\":%.6g,\"ratio\":%.6g", yardstick, ms / yardstick);
  if (!note.empty()) std::printf(",\"note\":\"%s\"", note.c_str());
  std::printf("}\n");
  std::fflush(stdout);
}

}  // namespace pliant::bench

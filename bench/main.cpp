#include "bench.h"

int main(int argc, char** argv) {
  const pliant::bench::Reporter reporter(std::vector<std::string>(argv + 1, argv + argc));
  for (const pliant::bench::Bench::Function bench : pliant::bench::Bench::all()) bench(reporter);
}

#include "bench.h"

int main(int argc, char** argv) {
  const pliant::bench::Reporter reporter(std::vector<std::string>(argv + 1, argv + argc));
  pliant::bench::bench_embedded_graph(reporter);
}

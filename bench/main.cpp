#include "bench.h"

int main(int argc, char** argv) {
  const pliant::bench::Reporter reporter(std::vector<std::string>(argv + 1, argv + argc));
  pliant::bench::bench_embedded_graph(reporter);
  pliant::bench::bench_arap(reporter);
  pliant::bench::bench_edge_material(reporter);
  pliant::bench::bench_sketch(reporter);
#ifdef PLIANT_BENCH_CGAL
  pliant::bench::bench_cgal(reporter);
#endif
}

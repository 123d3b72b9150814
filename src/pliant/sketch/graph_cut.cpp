#include "pliant/sketch/graph_cut.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>

// Boost reports violated preconditions through these where there are no exceptions.
#define BOOST_NO_EXCEPTIONS
#include <boost/graph/boykov_kolmogorov_max_flow.hpp>
#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <boost/throw_exception.hpp>

#include "pliant/core/sort.h"

namespace boost {
void throw_exception(const std::exception&) { std::abort(); }
void throw_exception(const std::exception&, const source_location&) { std::abort(); }
}  // namespace boost

namespace pliant {
namespace {

// Whole numbers: with rounding, augmenting paths might never run dry.
using Flow = std::int64_t;
constexpr double kResolution = 1e9;

struct Arc {
  Index from, to;
  Flow capacity;
  std::size_t pair;  ///< both directions of an edge have one number
};

/// Both directions of every edge, sorted by where they start; the terminals are the last two nodes.
std::vector<Arc> arcs_of(std::span<const Terminal> nodes, std::span<const CutEdge> edges) {
  double largest = 0.0;
  for (const CutEdge& edge : edges) largest = std::max(largest, edge.capacity);
  const double scale = largest > 0.0 ? kResolution / largest : 0.0;

  std::vector<Arc> arcs;
  Flow sum = 1;
  std::size_t pair = 0;
  for (const CutEdge& edge : edges) {
    const Flow capacity = std::llround(edge.capacity * scale);
    sum += capacity;
    arcs.push_back({edge.a, edge.b, capacity, pair});
    arcs.push_back({edge.b, edge.a, capacity, pair++});
  }
  const auto source = static_cast<Index>(nodes.size());
  for (Index i = 0; i < source; ++i) {
    if (nodes[i] == Terminal::none) continue;
    const bool is_source = nodes[i] == Terminal::source;
    const Index from = is_source ? source : i;
    const Index to = is_source ? i : source + 1;
    arcs.push_back({from, to, sum, pair});  // more than any cut between the nodes
    arcs.push_back({to, from, 0, pair++});
  }
  return sorted_by(arcs, [](const Arc& arc) { return key_of(0, arc.from); });
}

}  // namespace

std::vector<bool> min_cut(std::span<const Terminal> nodes, std::span<const CutEdge> edges) {
  using Graph = boost::compressed_sparse_row_graph<boost::directedS, boost::no_property, boost::no_property,
                                                   boost::no_property, Index, Index>;
  using Arrow = boost::graph_traits<Graph>::edge_descriptor;
  const std::vector<Arc> arcs = arcs_of(nodes, edges);
  std::vector<std::pair<Index, Index>> ends;
  std::vector<Flow> capacity, residual(arcs.size());
  std::vector<Index> first_of_pair(arcs.size() / 2, -1);
  for (const Arc& arc : arcs) {
    ends.emplace_back(arc.from, arc.to);
    capacity.push_back(arc.capacity);
  }
  const auto count = static_cast<Index>(nodes.size()) + 2;
  const Graph graph(boost::edges_are_sorted, ends.begin(), ends.end(), count);

  std::vector<Arrow> arrows;
  for (auto [e, last] = boost::edges(graph); e != last; ++e) arrows.push_back(*e);
  std::vector<Arrow> reverse(arrows.size());
  for (Index i = 0; i < static_cast<Index>(arcs.size()); ++i) {
    Index& first = first_of_pair[arcs[i].pair];
    if (first < 0) {
      first = i;
    } else {
      reverse[i] = arrows[first];
      reverse[first] = arrows[i];
    }
  }
  const auto of_edge = boost::get(boost::edge_index, graph);
  const auto of_vertex = boost::get(boost::vertex_index, graph);
  std::vector<Arrow> predecessor(count);
  std::vector<boost::default_color_type> color(count);
  std::vector<Index> distance(count);
  boost::boykov_kolmogorov_max_flow(graph, boost::make_iterator_property_map(capacity.begin(), of_edge),
                                    boost::make_iterator_property_map(residual.begin(), of_edge),
                                    boost::make_iterator_property_map(reverse.begin(), of_edge),
                                    boost::make_iterator_property_map(predecessor.begin(), of_vertex),
                                    boost::make_iterator_property_map(color.begin(), of_vertex),
                                    boost::make_iterator_property_map(distance.begin(), of_vertex), of_vertex,
                                    count - 2, count - 1);
  std::vector<bool> beyond(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) beyond[i] = color[i] != boost::black_color;
  return beyond;
}

}  // namespace pliant

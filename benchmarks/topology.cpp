// TopS: cost per element of building, querying and cutting from 1e4 to 3e6 hexahedra, bytes per element by
// type, and the same questions put to CGAL's combinatorial map where it is installed (libcgal-dev).
//   benchmarks/run.sh topology [LARGEST]
// Times are processor seconds of one thread, the least of a few repetitions. "In order" asks element by
// element, as loops over a mesh do; "at random" jumps, and pays for the lines that it misses in cache
// ("line": one such miss). Builds reuse the memory of the one before; what fresh memory of the structure's
// size costs the first time, as the kernel hands out its pages, stands by itself ("pages", ns/element).
#include <malloc.h>
#include <sys/mman.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "cdfp/topology.hpp"
#include "support/stop_watch.hpp"

#if __has_include(<CGAL/Linear_cell_complex_for_combinatorial_map.h>)
#define CDFP_WITH_CGAL
#define CGAL_DISABLE_GMP 1
#include <CGAL/Linear_cell_complex_constructors.h>
#include <CGAL/Linear_cell_complex_for_combinatorial_map.h>
#include <CGAL/Simple_cartesian.h>
#endif

namespace {

using namespace cdfp;

/// The least processor time of a few repetitions, in ns for each of `count`.
template <class Work>
double ns_each(double count, Work&& work, int repetitions = 9) {
  return 1e9 * bench::least_seconds(repetitions, work) / count;
}

volatile std::int64_t sink = 0;  // keeps the compiler from dropping unused answers

struct Grid {
  int nx, ny, nz;
  std::vector<ElementType> types;
  std::vector<Index> connectivity;

  Index node(int i, int j, int k) const { return i + (nx + 1) * (j + (ny + 1) * k); }
  Index node_count() const { return (nx + 1) * (ny + 1) * (nz + 1); }
  Index cells() const { return nx * ny * nz; }
  std::array<Index, 8> corners(int i, int j, int k) const {
    return {node(i, j, k),     node(i + 1, j, k),     node(i + 1, j + 1, k),     node(i, j + 1, k),
            node(i, j, k + 1), node(i + 1, j, k + 1), node(i + 1, j + 1, k + 1), node(i, j + 1, k + 1)};
  }
};

/// Plates as thick as glass is in practice: a quarter as many layers as columns.
Grid make_grid(double cells, ElementType type) {
  const int n = std::max(4, static_cast<int>(std::lround(std::cbrt(4 * cells))));
  Grid grid{n, n, std::max(1, static_cast<int>(std::lround(cells / n / n))), {}, {}};
  const auto add = [&](std::initializer_list<Index> corners) {
    grid.types.push_back(type);
    grid.connectivity.insert(grid.connectivity.end(), corners);
  };
  for (int k = 0; k < grid.nz; ++k) {
    for (int j = 0; j < grid.ny; ++j) {
      for (int i = 0; i < grid.nx; ++i) {
        const auto c = grid.corners(i, j, k);
        const Index middle = grid.node_count() + static_cast<Index>(grid.types.size()) / 6;
        switch (type) {
          case ElementType::tetrahedron:
            for (const auto& [p, q] : {std::pair{1, 2}, {2, 3}, {3, 7}, {7, 4}, {4, 5}, {5, 1}}) {
              add({c[0], c[p], c[q], c[6]});
            }
            break;
          case ElementType::wedge:
            add({c[0], c[1], c[2], c[4], c[5], c[6]});
            add({c[0], c[2], c[3], c[4], c[6], c[7]});
            break;
          case ElementType::pyramid:
            for (const auto& f : {std::array{0, 1, 2, 3},
                                  {4, 7, 6, 5},
                                  {0, 4, 5, 1},
                                  {1, 5, 6, 2},
                                  {2, 6, 7, 3},
                                  {3, 7, 4, 0}}) {
              add({c[f[0]], c[f[1]], c[f[2]], c[f[3]], middle});
            }
            break;
          default:
            add({c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7]});
        }
      }
    }
  }
  return grid;
}

Topology make_topology(const Grid& grid) {
  const bool middles = grid.types[0] == ElementType::pyramid;
  return Topology(grid.node_count() + (middles ? grid.cells() : 0), grid.types, grid.connectivity);
}

std::vector<Index> random_order(Index count) {
  std::vector<Index> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(1));
  return order;
}

/// What one question costs in ns, for the elements in the order given.
struct Answers {
  double mate, edge, star;
};

Answers ask(const Topology& topology, const std::vector<Index>& order) {
  const std::size_t count = std::min<std::size_t>(order.size(), 300000);
  const auto each = [&](auto&& question) {
    return ns_each(static_cast<double>(count), [&] {
      std::int64_t sum = 0;
      for (std::size_t i = 0; i < count; ++i) sum += question(order[i]);
      sink = sink + sum;
    });
  };
  std::vector<EdgeUse> edge;
  std::vector<VertexUse> star;
  Answers a{};
  a.mate = each([&](Index e) {
             Index sum = 0;
             for (Index f = 0; f < 6; ++f) sum += topology.mate({e, f}).element;
             return sum;
           }) /
           6;
  a.edge = each([&](Index e) {
    topology.elements_around(EdgeUse{e, 8}, edge);
    return static_cast<Index>(edge.size());
  });
  a.star = each([&](Index e) {
    topology.elements_around_node(topology.nodes(e)[0], star);
    return static_cast<Index>(star.size());
  });
  return a;
}

/// One random line out of as much memory as the structure takes.
double line_miss(std::size_t bytes) {
  std::vector<std::uint32_t> lines(bytes / 4);
  const std::size_t count = lines.size() / 16;
  const std::vector<Index> order = random_order(static_cast<Index>(count));
  for (std::size_t i = 0; i < count; ++i) {
    lines[16 * static_cast<std::size_t>(order[i])] = static_cast<std::uint32_t>(order[(i + 1) % count]);
  }
  return ns_each(1e6, [&] {
    std::uint32_t at = 0;
    for (int i = 0; i < 1000000; ++i) at = lines[16 * static_cast<std::size_t>(at)];
    sink = sink + at;
  });
}

/// To write once to so much memory that nobody had before, ns.
double fresh_pages(std::size_t bytes) {
  return ns_each(
      1,
      [&] {
        void* const memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        if (memory == MAP_FAILED) return;
        for (std::size_t at = 0; at < bytes; at += 4096) static_cast<volatile char*>(memory)[at] = 1;
        munmap(memory, bytes);
      },
      3);
}

std::vector<FacetUse> inner_facets(const Topology& topology) {
  std::vector<FacetUse> facets;
  topology.for_each_facet([&](FacetUse use) {
    if (!topology.is_boundary(use)) facets.push_back(use);
  });
  return facets;
}

/// ns for each facet over the first, middle and last third of cutting all of them.
std::array<double, 3> cut_all(const Grid& grid, bool random) {
  std::array<double, 3> least{1e30, 1e30, 1e30};
  for (int repetition = 0; repetition < (grid.cells() > 500000 ? 1 : 3); ++repetition) {
    Topology topology = make_topology(grid);
    std::vector<FacetUse> facets = inner_facets(topology);
    if (random) std::shuffle(facets.begin(), facets.end(), std::mt19937(2));
    Insertion report;
    for (std::size_t t = 0; t < 3; ++t) {
      const std::size_t begin = facets.size() * t / 3;
      const std::size_t end = facets.size() * (t + 1) / 3;
      const double start = bench::processor_seconds();
      for (std::size_t i = begin; i < end; ++i) topology.insert_cohesive(facets[i], report);
      least[t] =
          std::min(least[t], 1e9 * (bench::processor_seconds() - start) / static_cast<double>(end - begin));
    }
    if (topology.node_count() != 8 * grid.cells()) std::printf("cutting everything left shared nodes\n");
  }
  return least;
}

#ifdef CDFP_WITH_CGAL
using Complex = CGAL::Linear_cell_complex_for_combinatorial_map<
    3, 3, CGAL::Linear_cell_complex_traits<3, CGAL::Simple_cartesian<double>>>;

void compare_with_cgal(double cells) {
  const Grid grid = make_grid(cells, ElementType::hexahedron);
  const auto count = static_cast<double>(grid.cells());
  const double build = ns_each(count, [&] { sink = sink + make_topology(grid).node_count(); });
  const Topology topology = make_topology(grid);
  std::vector<Index> order(static_cast<std::size_t>(grid.cells()));
  std::iota(order.begin(), order.end(), 0);
  const Answers ours = ask(topology, order);

  Complex complex;
  std::vector<Complex::Dart_handle> darts;
  const double cgal_build = ns_each(
      count,
      [&] {
        complex.clear();
        darts.clear();
        std::vector<Complex::Vertex_attribute_handle> nodes;
        for (int k = 0; k <= grid.nz; ++k) {
          for (int j = 0; j <= grid.ny; ++j) {
            for (int i = 0; i <= grid.nx; ++i) {
              nodes.push_back(complex.create_vertex_attribute(Complex::Point(i, j, k)));
            }
          }
        }
        for (std::size_t e = 0; e < grid.types.size(); ++e) {
          const auto at = [&](int c) {
            return nodes[static_cast<std::size_t>(grid.connectivity[8 * e + c])];
          };
          darts.push_back(complex.make_hexahedron(at(0), at(1), at(2), at(3), at(7), at(4), at(5), at(6)));
        }
        complex.sew3_same_facets();
      },
      1);
  const auto each = [&](auto&& question) {
    return ns_each(count, [&] {
      std::int64_t sum = 0;
      for (const auto dart : darts) sum += question(dart);
      sink = sink + sum;
    });
  };
  const double mate = each([&](auto dart) { return complex.is_free(dart, 3) ? 0 : 1; });
  const double edge = each([&](auto dart) {
    int sum = 0;
    for (auto it = complex.one_dart_per_incident_cell<3, 1>(dart).begin(),
              end = complex.one_dart_per_incident_cell<3, 1>(dart).end();
         it != end; ++it)
      ++sum;
    return sum;
  });
  const double star = each([&](auto dart) {
    int sum = 0;
    for (auto it = complex.one_dart_per_incident_cell<3, 0>(dart).begin(),
              end = complex.one_dart_per_incident_cell<3, 0>(dart).end();
         it != end; ++it)
      ++sum;
    return sum;
  });
  std::printf("\n%d hexahedra          TopS   CGAL linear cell complex\n", grid.cells());
  std::printf("bytes/element      %8.1f   %8.1f\n", static_cast<double>(topology.memory()) / count,
              static_cast<double>(complex.bytes()) / count);
  std::printf("build, ns/element  %8.1f   %8.1f\n", build, cgal_build);
  std::printf("mate, ns           %8.1f   %8.1f\n", ours.mate, mate);
  std::printf("edge cycle, ns     %8.1f   %8.1f\n", ours.edge, edge);
  std::printf("vertex star, ns    %8.1f   %8.1f\n", ours.star, star);
}
#endif

}  // namespace

int main(int argc, char** argv) {
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, -1);
  const double largest = argc > 1 ? std::atof(argv[1]) : 3e6;
  std::string misses;
  std::printf(
      "hexahedra  bytes/el  build  pages |  in order: mate  edge  star |  at random: mate  edge  star  line |"
      "  cut in order, at random (thirds), ns/facet\n");
  Answers first{};
  double first_build = 0;
  double first_cut = 0;
  for (const double cells : {1e4, 1e5, 1e6, 3e6}) {
    if (cells > largest) break;
    const Grid grid = make_grid(cells, ElementType::hexahedron);
    const double build = ns_each(
        static_cast<double>(grid.cells()), [&] { sink = sink + make_topology(grid).node_count(); }, 5);
    const Topology topology = make_topology(grid);
    const double bytes = static_cast<double>(topology.memory()) / grid.cells();
    std::vector<Index> order(static_cast<std::size_t>(grid.cells()));
    std::iota(order.begin(), order.end(), 0);
    const Answers ordered = ask(topology, order);
    const Answers random = ask(topology, random_order(grid.cells()));
    const double line = line_miss(topology.memory());
    const auto sweep = cut_all(grid, false);
    const auto scattered = cut_all(grid, true);
    std::printf(
        "%9d  %8.1f  %5.0f  %5.0f |            %4.1f  %4.0f  %4.0f |             %4.1f  %4.0f  %4.0f  %4.0f |"
        "  %4.0f %4.0f %4.0f   %4.0f %4.0f %4.0f\n",
        grid.cells(), bytes, build, fresh_pages(topology.memory()) / grid.cells(), ordered.mate, ordered.edge,
        ordered.star, random.mate, random.edge, random.star, line, sweep[0], sweep[1], sweep[2], scattered[0],
        scattered[1], scattered[2]);
    std::fflush(stdout);
    const double cut = (sweep[0] + sweep[1] + sweep[2]) / 3;
    if (bytes > 80) misses += " bytes";
    if (first_build == 0) {
      first = ordered;
      first_build = build;
      first_cut = cut;
    }
    const auto hold = [&](const char* what, double now, double then) {
      if (now > 1.3 * then) misses += std::string(" ") + what + "@" + std::to_string(grid.cells());
    };
    hold("build", build, first_build);
    hold("mate", ordered.mate, first.mate);
    hold("edge", ordered.edge, first.edge);
    hold("star", ordered.star, first.star);
    hold("cut", cut, first_cut);
  }

  std::printf("\nbytes/element: ");
  for (const auto& [type, name] : {std::pair{ElementType::hexahedron, "hexahedron"},
                                   {ElementType::tetrahedron, "tetrahedron"},
                                   {ElementType::wedge, "wedge"},
                                   {ElementType::pyramid, "pyramid"}}) {
    const Grid grid = make_grid(2e4, type);
    std::printf("%s %.1f  ", name,
                static_cast<double>(make_topology(grid).memory()) / static_cast<double>(grid.types.size()));
  }
  std::printf(" cohesive 40.0 and 4 for each new node\n");
#ifdef CDFP_WITH_CGAL
  compare_with_cgal(std::min(largest, 1e5));
#else
  std::printf("CGAL is not installed (libcgal-dev): no comparison\n");
#endif
  std::printf("topology: %s\n", misses.empty() ? "pass" : ("short:" + misses).c_str());
  return 0;
}

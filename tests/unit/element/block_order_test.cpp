// Blocks: compact runs, colours without shared nodes, and meshes of many blocks.
#include "element/block_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "element/element_blocks.hpp"
#include "fixtures.hpp"

namespace cdfp::test {
namespace {

constexpr unsigned kSeed = 99;

TEST(BlockOrder, RunsAreFullAscendingAndCompact) {
  std::mt19937 random(kSeed);
  std::vector<Centroid> elements;
  for (Index e = 0; e < 20 * 20 * 20 + 5; ++e) {
    elements.push_back({{double(e % 20), double(e / 20 % 20), double(e / 400)}, e});
  }
  std::shuffle(elements.begin(), elements.end(), random);
  order_in_runs(elements, 64);
  std::set<Index> seen;
  double extent = 0;
  for (std::size_t first = 0; first < elements.size(); first += 64) {
    const std::size_t last = std::min(first + 64, elements.size());
    std::array<double, 3> low = elements[first].x, high = low;
    for (std::size_t i = first; i < last; ++i) {
      EXPECT_TRUE(seen.insert(elements[i].element).second);
      if (i > first) {
        EXPECT_LT(elements[i - 1].element, elements[i].element);
      }
      for (int d = 0; d < 3; ++d) {
        low[d] = std::min(low[d], elements[i].x[d]);
        high[d] = std::max(high[d], elements[i].x[d]);
      }
    }
    for (int d = 0; d < 3; ++d) extent += high[d] - low[d];
  }
  EXPECT_EQ(seen.size(), elements.size());
  // A block of 4 x 4 x 4 extends over 9 in all.
  EXPECT_LT(extent / (double(elements.size()) / 64), 18);
}

TEST(BlockOrder, ItemsOfOneColourShareNoNode) {
  std::mt19937 random(kSeed);
  std::uniform_int_distribution<Index> node(0, 399);
  std::vector<std::size_t> first{0};
  std::vector<Index> nodes;
  const int items = 300;
  for (int i = 0; i < items; ++i) {
    if (i < 100) nodes.push_back(7);  // more items at one node than there are bits in a word
    for (int k = 0; k < 6; ++k) nodes.push_back(node(random));
    first.push_back(nodes.size());
  }
  std::vector<int> times(items, 0);
  for (const std::vector<std::int32_t>& of_colour : colour(first, nodes, 400)) {
    EXPECT_TRUE(std::is_sorted(of_colour.begin(), of_colour.end()));
    std::vector<int> owner(400, -1);
    for (const std::int32_t item : of_colour) {
      ++times[std::size_t(item)];
      for (std::size_t k = first[std::size_t(item)]; k < first[std::size_t(item) + 1]; ++k) {
        EXPECT_TRUE(owner[std::size_t(nodes[k])] == -1 || owner[std::size_t(nodes[k])] == item);
        owner[std::size_t(nodes[k])] = item;
      }
    }
  }
  EXPECT_EQ(std::count(times.begin(), times.end(), 1), items);
}

/// 2,310 elements in three parts: prisms, distorted hexahedra and fully integrated PVB.
Model many_blocks() {
  std::mt19937 random(kSeed);
  const Box box{22, 15, 7, 22e-3, 15e-3, 7e-3};
  Mesh mesh = box_mesh(box);
  mesh.part_names = {"prisms", "distorted", "pvb"};
  for (Index e = 0; e < mesh.element_count(); ++e) {
    const Index layer = e / (22 * 15);
    mesh.parts[std::size_t(e)] = layer < 3 ? 0 : layer < 5 ? 1 : 2;
  }
  distort_columns(mesh, box, 0.2e-3, random);
  std::uniform_real_distribution<double> shift(-0.1e-3, 0.1e-3);
  for (std::size_t n = 4 * 23 * 16; n < mesh.coordinates.size() / 3; ++n)
    mesh.coordinates[3 * n + 2] += shift(random);
  Model model = model_of(std::move(mesh), Formulation::one_point);
  model.materials.push_back({"pvb", RateDependentMaterial{1000, 0.49, 5.88e6, 29.21e6, 0.176, 1e-6}});
  model.parts[2].material = "pvb";
  model.parts[2].formulation = Formulation::full;
  return model;
}

TEST(ManyBlocks, TasksOfOneColourShareNoNode) {
  const Model model = many_blocks();
  const ElementBlocks blocks(model);
  ASSERT_GT(blocks.colours.size(), 1u);
  std::vector<int> times(std::size_t(model.mesh.element_count()), 0);
  for (const std::vector<ElementBlocks::Task>& tasks : blocks.colours) {
    std::vector<const ElementBlocks::Task*> owner(std::size_t(model.mesh.node_count()), nullptr);
    for (const ElementBlocks::Task& task : tasks) {
      const BlockGroup& group = blocks.groups[std::size_t(task.group)];
      const std::size_t end = std::min(std::size_t(task.last) * kBlock, group.elements.size());
      for (std::size_t slot = std::size_t(task.first) * kBlock; slot < end; ++slot) {
        const Index e = group.elements[slot];
        ++times[std::size_t(e)];
        for (std::size_t c = 0; c < 8; ++c) {
          const Index node = model.mesh.connectivity[8 * std::size_t(e) + c];
          EXPECT_EQ(group.corner_offsets(slot)[c * kLanes], 3 * node);
          EXPECT_TRUE(!owner[std::size_t(node)] || owner[std::size_t(node)] == &task);
          owner[std::size_t(node)] = &task;
        }
      }
    }
  }
  EXPECT_EQ(std::count(times.begin(), times.end(), 1), model.mesh.element_count());
}

TEST(ManyBlocks, ForceIsTheSumOfTheElementsAndTheSameForAnyNumberOfThreads) {
  const Model model = many_blocks();
  std::mt19937 random(kSeed);
  Positions x = model.mesh.coordinates;
  distort(x, 1e-5, random);
  ElementForce elements(model);
  const std::vector<double> force = force_of(elements, x, 1e-8);
  std::vector<double> sum(x.size(), 0.0), corner(24);
  for (Index e = 0; e < model.mesh.element_count(); ++e) {
    elements.corner_force(e, x, corner);
    for (std::size_t i = 0; i < 24; ++i) {
      sum[3 * std::size_t(model.mesh.connectivity[8 * std::size_t(e) + i / 3]) + i % 3] += corner[i];
    }
  }
  for (std::size_t i = 0; i < sum.size(); ++i) ASSERT_NEAR(sum[i], force[i], 1e-12 * largest(force));
  std::vector<std::vector<double>> on_one_thread;
  const auto stretched = [&](int i) { return mapped(x, (1 + 1e-4 * i) * Matrix3d::Identity()); };
  for (int i = 0; i < 6; ++i) on_one_thread.push_back(force_of(elements, stretched(i), 1e-8));
  for (const int threads : {2, 3}) {
    ElementForce again(model);
    ASSERT_EQ(force, force_of(again, x, 1e-8, Threads(threads))) << threads << " threads";
    for (int i = 0; i < 6; ++i) {
      ASSERT_EQ(on_one_thread[std::size_t(i)], force_of(again, stretched(i), 1e-8, Threads(threads)));
    }
  }
}

}  // namespace
}  // namespace cdfp::test

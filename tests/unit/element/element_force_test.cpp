// What every element must do: patch test, frame indifference, conservation, exact derivatives.
#include "element/element_force.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>

#include "cdfp/error.hpp"
#include "fixtures.hpp"

namespace cdfp::test {
namespace {

enum class Shape { prism, distorted, tetrahedra, wedges, distorted_wedges };
struct Case {
  Formulation formulation;
  Shape shape;
};

class EveryElement : public testing::TestWithParam<Case> {
 protected:
  EveryElement() {
    box_ = {5, 4, 3, 5e-3, 4e-3, 3e-3};
    Mesh mesh = box_mesh(box_);
    if (GetParam().shape == Shape::prism || GetParam().shape == Shape::wedges) {
      distort_columns(mesh, box_, 0.2e-3, random_);
    } else {
      distort(mesh.coordinates, 0.2e-3, random_);
    }
    mesh = cut(mesh);
    model_ = model_of(std::move(mesh), GetParam().formulation);
  }
  bool wedges() const {
    return GetParam().shape == Shape::wedges || GetParam().shape == Shape::distorted_wedges;
  }
  Index corners() const { return GetParam().shape == Shape::tetrahedra ? 4 : wedges() ? 6 : 8; }
  Mesh cut(const Mesh& hexahedra) const {
    if (GetParam().shape == Shape::tetrahedra) return cut_into_tetrahedra(hexahedra);
    if (wedges())
      return cut_into_wedges(hexahedra, [&](Index e) { return e % (box_.nx * box_.ny) % 3 == 1; });
    return hexahedra;
  }
  Positions deformed(double size) {
    Positions x = mapped(model_.mesh.coordinates, Matrix3d::Identity() + random_matrix(size, random_));
    distort(x, size * 1e-3, random_);
    return x;
  }

  static constexpr unsigned kSeed = 20150315;
  std::mt19937 random_{kSeed};
  Box box_;
  Model model_;
};

std::string name_of(const testing::TestParamInfo<Case>& info) {
  if (info.param.shape == Shape::tetrahedra) return "tetrahedra";
  if (info.param.shape == Shape::wedges) return "wedges";
  if (info.param.shape == Shape::distorted_wedges) return "distorted_wedges";
  return std::string(info.param.formulation == Formulation::full ? "full" : "one_point") +
         (info.param.shape == Shape::prism ? "_prism" : "_distorted");
}

INSTANTIATE_TEST_SUITE_P(Elements, EveryElement,
                         testing::Values(Case{Formulation::one_point, Shape::prism},
                                         Case{Formulation::one_point, Shape::distorted},
                                         Case{Formulation::full, Shape::prism},
                                         Case{Formulation::full, Shape::distorted},
                                         Case{Formulation::one_point, Shape::tetrahedra},
                                         Case{Formulation::full, Shape::wedges},
                                         Case{Formulation::full, Shape::distorted_wedges}),
                         name_of);

TEST_P(EveryElement, IsAtRestInItsReference) {
  ElementForce elements(model_);
  const Positions& x = model_.mesh.coordinates;
  EXPECT_LT(largest(force_of(elements, x)), 1e-12 * 74e9 * 1e-6);
  const PartEnergy energy = energy_of(elements, x);
  EXPECT_LT(energy.strain + energy.hourglass, 1e-24 * 74e9 * 60e-9);
}

TEST_P(EveryElement, PassesThePatchTest) {
  ElementForce elements(model_);
  for (const double size : {1e-8, 1e-4, 0.1}) {
    const Matrix3d f = Matrix3d::Identity() + random_matrix(size, random_);
    const Positions x = mapped(model_.mesh.coordinates, f, Vector3d(0.01, -0.02, 0.005));
    const std::vector<double> force = force_of(elements, x);
    const Matrix3d strain = 0.5 * (f.transpose() * f - Matrix3d::Identity());
    const double mu = 74e9 / 2.4, lambda = 74e9 * 0.2 / (1.2 * 0.6);
    const Matrix3d s = lambda * strain.trace() * Matrix3d::Identity() + 2 * mu * strain;
    const Matrix3d sigma = f * s * f.transpose() / f.determinant();
    const double scale = sigma.norm();
    const double noise = 3e-13 * 74e9;  // stored positions are rounded, strains by about 1e-14
    for (Index k = 1; k < box_.nz; ++k) {
      for (Index j = 1; j < box_.ny; ++j) {
        for (Index i = 1; i < box_.nx; ++i) {
          EXPECT_LT(at(force, box_.node(i, j, k)).norm(), (1e-12 * scale + noise) * 1e-6)
              << "strain " << size;
        }
      }
    }
    for (Index e = 0; e < model_.mesh.element_count(); ++e) {
      EXPECT_LT((to_eigen(elements.stress(e, x)) - sigma).norm(), 1e-12 * scale + noise) << "strain " << size;
    }
    const PartEnergy energy = energy_of(elements, x);
    EXPECT_LT(energy.hourglass, 1e-20 * energy.strain + noise * noise / 74e9 * 60e-9);
    double mass = 0;
    for (Index e = 0; e < model_.mesh.element_count(); ++e) mass += corners() * elements.corner_mass(e);
    EXPECT_NEAR(energy.strain / (0.5 * s.cwiseProduct(strain).sum() * mass / 2500), 1,
                size < 1e-6 ? 1e-4 : 1e-9);
  }
}

TEST_P(EveryElement, TurnsOnceAroundWithoutStress) {
  ElementForce elements(model_);
  const Vector3d axis = Vector3d(1, 2, -3).normalized();
  for (int degrees = 0; degrees <= 360; degrees += 15) {
    const Matrix3d r = Eigen::AngleAxisd(degrees * std::numbers::pi / 180, axis).toRotationMatrix();
    const Positions x = mapped(model_.mesh.coordinates, r);
    EXPECT_LT(largest(force_of(elements, x)), 1e-12 * 74e9 * 1e-6) << degrees;
    EXPECT_LT(elements.stress(7, x)(0, 0), 1e-12 * 74e9);
    const PartEnergy energy = energy_of(elements, x);
    EXPECT_LT(energy.strain + energy.hourglass, 1e-24 * 74e9 * 60e-9);
  }
}

TEST_P(EveryElement, ForceTurnsWithTheBody) {
  ElementForce elements(model_);
  const Positions x = deformed(0.05);
  const Matrix3d r = Eigen::AngleAxisd(2.1, Vector3d(0.3, -1, 0.5).normalized()).toRotationMatrix();
  const std::vector<double> force = force_of(elements, x), turned = force_of(elements, mapped(x, r));
  const double scale = largest(force);
  for (Index n = 0; n < model_.mesh.node_count(); ++n) {
    EXPECT_LT((r * at(force, n) - at(turned, n)).norm(), 1e-11 * scale);
  }
}

TEST_P(EveryElement, ForceIsMinusTheSlopeOfTheEnergy) {
  ElementForce elements(model_);
  const Positions x = deformed(0.05);
  const std::vector<double> force = force_of(elements, x);
  std::uniform_real_distribution<double> entry(-1, 1);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<double> direction(x.size());
    double expected = 0, scale = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      direction[i] = entry(random_);
      expected -= direction[i] * force[i];
      scale += std::abs(direction[i] * force[i]);
    }
    const auto energy_at = [&](double h) {
      Positions y = x;
      for (std::size_t i = 0; i < x.size(); ++i) y[i] += h * direction[i];
      const PartEnergy energy = energy_of(elements, y);
      return energy.strain + energy.hourglass;
    };
    const double h = 2e-7;  // fourth-order differences of a quartic energy: only round-off is left
    const double slope =
        (8 * (energy_at(h) - energy_at(-h)) - (energy_at(2 * h) - energy_at(-2 * h))) / (12 * h);
    EXPECT_NEAR(slope, expected, 1e-8 * scale) << "seed " << kSeed;
  }
}

TEST_P(EveryElement, GivesNoNetForceOrMoment) {
  ElementForce elements(model_);
  const Positions x = deformed(0.1);
  const std::vector<double> force = force_of(elements, x);
  Vector3d sum = Vector3d::Zero(), moment = Vector3d::Zero();
  double scale = 0;
  for (Index n = 0; n < model_.mesh.node_count(); ++n) {
    sum += at(force, n);
    moment += at(x, n).cross(at(force, n));
    scale += at(force, n).norm();
  }
  EXPECT_LT(sum.norm(), 1e-14 * scale);
  EXPECT_LT(moment.norm(), 1e-14 * scale * 7e-3);
}

TEST_P(EveryElement, MassIsThatOfTheVolume) {
  Model model = model_;
  model.mesh = cut(box_mesh(box_));
  for (double& c : model.mesh.coordinates) c = c + 0.1 * c * c / 5e-3;
  ElementForce elements(model);
  std::vector<double> mass(std::size_t(model.mesh.node_count()), 0.0);
  elements.add_mass(mass);
  double sum = 0;
  for (const double m : mass) sum += m;
  EXPECT_NEAR(sum / (2500 * 5.5e-3 * (4e-3 + 0.1 * 16e-6 / 5e-3) * (3e-3 + 0.1 * 9e-6 / 5e-3)), 1, 1e-12);
}

TEST_P(EveryElement, SameBitsForAnyNumberOfThreads) {
  ElementForce elements(model_);
  const Positions x = deformed(0.05);
  const std::vector<double> one = force_of(elements, x);
  for (const int threads : {2, 3, 5}) EXPECT_EQ(one, force_of(elements, x, 0, Threads(threads)));
  const double strain = energy_of(elements, x).strain;
  EXPECT_EQ(strain, elements.energies(x, Threads(3))[0].strain);
  EXPECT_EQ(elements.stable_step(x, Threads(1)).step, elements.stable_step(x, Threads(3)).step);
}

TEST_P(EveryElement, InstructionSetsAgree) {
  const Positions x = deformed(0.05);
  const auto force_with = [&](const char* isa) {
    setenv("CDFP_ISA", isa, 1);
    ElementForce elements(model_);
    unsetenv("CDFP_ISA");
    return std::pair{force_of(elements, x), elements.stable_step(x, Threads(1)).step};
  };
  const auto [base, base_step] = force_with("baseline");
  for (const char* isa : {"avx2", "avx512"}) {
    try {
      const auto [force, step] = force_with(isa);
      for (std::size_t i = 0; i < base.size(); ++i)
        EXPECT_NEAR(force[i], base[i], 1e-12 * largest(base)) << isa;
      EXPECT_NEAR(step / base_step, 1, 1e-12);
    } catch (const Error& error) {
      unsetenv("CDFP_ISA");
      EXPECT_EQ(error.status(), Status::bad_argument);  // this processor lacks it
    }
  }
}

TEST_P(EveryElement, CornerForcesAddUpToTheForce) {
  for (const Index count : {1, 3, 7, 8, 9, 60}) {
    Model model = model_;
    model.mesh.types.resize(std::size_t(count));
    model.mesh.parts.resize(std::size_t(count));
    model.mesh.connectivity.resize(std::size_t(corners() * count));
    ElementForce elements(model);
    const Positions x = deformed(0.05);
    const std::vector<double> force = force_of(elements, x);
    std::vector<double> sum(x.size(), 0.0), corner(3 * std::size_t(corners()));
    for (Index e = 0; e < count; ++e) {
      elements.corner_force(e, x, corner);
      for (int i = 0; i < 3 * corners(); ++i) {
        sum[3 * std::size_t(model.mesh.connectivity[corners() * e + i / 3]) + i % 3] += corner[i];
      }
    }
    for (std::size_t i = 0; i < sum.size(); ++i) EXPECT_NEAR(sum[i], force[i], 1e-12 * largest(force));
  }
}

TEST_P(EveryElement, SplitsItsNodes) {
  ElementForce elements(model_);
  const Positions before = deformed(0.05);
  const std::vector<double> force = force_of(elements, before);
  // Element 0 gets a copy of a corner for its own.
  const Index own = corners() == 4 ? 3 : corners() == 6 ? 5 : 6;
  const Index node = model_.mesh.connectivity[own], copy = model_.mesh.node_count();
  Positions x = before;
  for (int d = 0; d < 3; ++d) x.push_back(before[3 * std::size_t(node) + d]);
  elements.replace_node(0, own, copy);
  const std::vector<double> split = force_of(elements, x);
  std::vector<double> corner(24);
  elements.corner_force(0, x, corner);
  for (int d = 0; d < 3; ++d) {
    EXPECT_NEAR(split[3 * std::size_t(copy) + d], corner[3 * own + d], 1e-12 * largest(force));
    EXPECT_NEAR(split[3 * std::size_t(copy) + d] + split[3 * std::size_t(node) + d],
                force[3 * std::size_t(node) + d], 1e-12 * largest(force));
  }
  std::vector<double> mass(x.size() / 3, 0.0);
  elements.add_mass(mass);
  EXPECT_DOUBLE_EQ(mass[copy], elements.corner_mass(0));
  // On its own now, the copy's motion concerns element 0 alone.
  put(x, copy, at(x, copy) + Vector3d(1e-5, 0, 0));
  const std::vector<double> moved = force_of(elements, x);
  for (Index e = 1; e < model_.mesh.element_count(); ++e) {
    for (int c = 0; c < corners(); ++c) {
      const Index n = model_.mesh.connectivity[corners() * e + c];
      bool of_first = false;
      for (int k = 0; k < corners(); ++k) of_first = of_first || model_.mesh.connectivity[k] == n;
      if (!of_first) {
        EXPECT_EQ(at(moved, n), at(split, n));
      }
    }
  }
}

TEST_P(EveryElement, ListsAllElementsThatCouldCrack) {
  model_.cohesive_laws.push_back({"glass", 60e6, 10, 5, 0.8, 0, 1});
  model_.parts[0].cohesive_law = "glass";
  ElementForce elements(model_);
  Positions x = model_.mesh.coordinates;
  distort(x, 1e-6, random_);
  force_of(elements, x);
  const std::span<const Index> listed = elements.critical_elements();
  EXPECT_TRUE(std::is_sorted(listed.begin(), listed.end()));
  Index critical = 0;
  for (Index e = 0; e < model_.mesh.element_count(); ++e) {
    const double norm = to_eigen(elements.stress(e, x)).norm();
    const bool is_listed = std::binary_search(listed.begin(), listed.end(), e);
    if (norm >= 48e6) {
      ++critical;
      EXPECT_TRUE(is_listed);
    }
    if (GetParam().formulation == Formulation::one_point && norm < 0.99 * 48e6) {
      EXPECT_FALSE(is_listed);
    }
  }
  EXPECT_GT(critical, 0);
  EXPECT_LT(critical, model_.mesh.element_count());
  force_of(elements, model_.mesh.coordinates);
  EXPECT_TRUE(elements.critical_elements().empty());
}

TEST(ElementForce, KeepsPartsApartAndLeavesRigidOnesOut) {
  const Box box{6, 1, 1, 6, 1, 1};
  Mesh mesh = box_mesh(box);
  mesh.part_names = {"one", "block", "two"};
  mesh.parts = {0, 0, 1, 1, 2, 2};
  Model model = model_of(std::move(mesh), Formulation::one_point);
  model.materials.push_back({"rigid", RigidMaterial{2500, 74e9, 0.2}});
  model.parts[1].material = "rigid";
  ElementForce elements(model);
  std::vector<double> mass(std::size_t(model.mesh.node_count()), 0.0);
  elements.add_mass(mass);
  EXPECT_EQ(mass[box.node(3, 0, 0)], 0);
  EXPECT_EQ(elements.corner_mass(2), 0);
  EXPECT_DOUBLE_EQ(mass[box.node(6, 0, 0)], 2500.0 / 8);
  const Positions x = mapped(model.mesh.coordinates, Vector3d(1.001, 1, 1).asDiagonal());
  EXPECT_EQ(at(force_of(elements, x), box.node(3, 0, 0)), Vector3d::Zero());
  const std::vector<PartEnergy> energy = elements.energies(x, Threads(1));
  ASSERT_EQ(energy.size(), 3u);
  EXPECT_EQ(energy[1].strain, 0);
  EXPECT_NEAR(energy[0].strain / energy[2].strain, 1, 1e-9);
}

TEST(ElementForce, TetrahedraAndHexahedraHoldTogether) {
  // Half of the bar in each: under uniform strain they carry the same stress and no node between is pulled.
  const Box box{4, 2, 2, 4e-3, 2e-3, 2e-3};
  Mesh mesh = box_mesh(box);
  const Mesh cut = cut_into_tetrahedra(mesh);
  Mesh mixed;
  mixed.coordinates = mesh.coordinates;
  mixed.part_names = mesh.part_names;
  for (Index e = 0; e < mesh.element_count(); ++e) {
    const bool whole = e % 4 < 2;
    const Mesh& from = whole ? mesh : cut;
    const Index first = whole ? e : 6 * e, count = whole ? 1 : 6, corners = whole ? 8 : 4;
    for (Index k = first; k < first + count; ++k) {
      mixed.types.push_back(from.types[k]);
      mixed.parts.push_back(0);
      mixed.connectivity.insert(mixed.connectivity.end(), from.connectivity.begin() + corners * k,
                                from.connectivity.begin() + corners * (k + 1));
    }
  }
  ElementForce elements(model_of(mixed, Formulation::full));
  std::mt19937 random(3);
  const Positions x = mapped(mesh.coordinates, Matrix3d(Matrix3d::Identity() + random_matrix(0.01, random)));
  const std::vector<double> force = force_of(elements, x);
  for (Index i = 1; i < box.nx; ++i) {
    if (i == 2) continue;  // the diagonals of a facet cut in two halve its force otherwise
    EXPECT_LT(at(force, box.node(i, 1, 1)).norm(), 1e-10 * largest(force));
  }
  double mass = 0;
  for (std::size_t e = 0; e < mixed.types.size(); ++e) {
    mass += (mixed.types[e] == ElementType::tetrahedron ? 4 : 8) * elements.corner_mass(Index(e));
  }
  EXPECT_NEAR(mass, 2500 * 16e-9, 1e-12 * 2500 * 16e-9);
  EXPECT_EQ(elements.first_inverted(x), kNone);
}

/// Elements of a distorted box by `mesh_of(i, k)`: whole hexahedra, or those of another mesh cut from it.
void holds_together(const Box& box, unsigned seed, const std::function<ElementType(Index, Index)>& type_of) {
  std::mt19937 random(seed);
  Mesh whole = box_mesh(box);
  distort(whole.coordinates, 0.15e-3, random);
  const Mesh tetrahedra = cut_into_tetrahedra(whole), wedges = cut_into_wedges(whole);
  Mesh mixed;
  mixed.coordinates = whole.coordinates;
  mixed.part_names = whole.part_names;
  for (Index e = 0; e < whole.element_count(); ++e) {
    const ElementType type = type_of(e % box.nx, e / (box.nx * box.ny));
    const Mesh& from = type == ElementType::hexahedron ? whole
                       : type == ElementType::wedge    ? wedges
                                                       : tetrahedra;
    const Index count = type == ElementType::hexahedron ? 1 : type == ElementType::wedge ? 2 : 6;
    const auto first = from.connectivity.begin() + e * count * corners_of(type);
    mixed.types.insert(mixed.types.end(), std::size_t(count), type);
    mixed.parts.insert(mixed.parts.end(), std::size_t(count), 0);
    mixed.connectivity.insert(mixed.connectivity.end(), first, first + count * corners_of(type));
  }
  for (const Formulation formulation : {Formulation::one_point, Formulation::full}) {
    ElementForce elements(model_of(mixed, formulation));
    const Matrix3d f = Matrix3d::Identity() + random_matrix(0.05, random);
    const Positions x = mapped(mixed.coordinates, f);
    const std::vector<double> force = force_of(elements, x);
    const Matrix3d stress = to_eigen(elements.stress(0, x));
    for (Index e = 1; e < mixed.element_count(); ++e) {
      EXPECT_LT((to_eigen(elements.stress(e, x)) - stress).norm(), 1e-11 * stress.norm()) << "seed " << seed;
    }
    for (Index k = 1; k < box.nz; ++k) {
      for (Index j = 1; j < box.ny; ++j) {
        for (Index i = 1; i < box.nx; ++i) {
          EXPECT_LT(at(force, box.node(i, j, k)).norm(), 1e-11 * largest(force)) << "seed " << seed;
        }
      }
    }
    EXPECT_EQ(elements.first_inverted(x), kNone);
  }
}

TEST(ElementForce, PatchOfWedgesBesideHexahedra) {
  holds_together({6, 4, 3, 6e-3, 4e-3, 3e-3}, 21,
                 [](Index i, Index) { return i % 3 == 0 ? ElementType::hexahedron : ElementType::wedge; });
}

TEST(ElementForce, PatchOfTetrahedraOnWedges) {
  holds_together({4, 4, 4, 4e-3, 4e-3, 4e-3}, 22,
                 [](Index, Index k) { return k < 2 ? ElementType::wedge : ElementType::tetrahedron; });
}

TEST(ElementForce, RefusesAPyramidWithTheCure) {
  Mesh mesh = box_mesh({});
  mesh.types = {ElementType::pyramid};
  mesh.connectivity = {0, 1, 2, 3, 4};
  try {
    ElementForce elements(model_of(mesh, Formulation::one_point));
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("two tetrahedra"), std::string::npos);
  }
}

TEST(ElementForce, NamesTheInvertedWedge) {
  Mesh mesh = cut_into_wedges(box_mesh({2, 1, 1, 2, 1, 1}));
  std::swap(mesh.connectivity[6 * 2], mesh.connectivity[6 * 2 + 1]);
  std::swap(mesh.connectivity[6 * 2 + 3], mesh.connectivity[6 * 2 + 4]);
  try {
    ElementForce elements(model_of(mesh, Formulation::one_point));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Status::bad_mesh);
    EXPECT_NE(std::string(error.what()).find("element 2 "), std::string::npos);
  }
}

TEST(ElementForce, LeavesOutBlocksThatHaveNotMoved) {
  const Box box{16, 16, 4, 16e-3, 16e-3, 4e-3};
  for (const Formulation formulation : {Formulation::one_point, Formulation::full}) {
    const Model model = model_of(box_mesh(box), formulation);
    const Positions& at_rest = model.mesh.coordinates;
    ElementForce all(model), moved(model);
    const auto forces = [&](ElementForce& elements, const Positions& x, bool may_rest) {
      Positions f(x.size(), 0.0);
      elements.add_force(x, f, 0, Threads(2),
                         may_rest ? std::span<const double>(at_rest) : std::span<const double>());
      return f;
    };
    EXPECT_EQ(forces(moved, at_rest, true), Positions(at_rest.size(), 0.0)) << "to the bit";
    Positions x = at_rest;
    x[2] += 1e-6;
    const Positions expected = forces(all, x, false), found = forces(moved, x, true);
    const double size = *std::max_element(expected.begin(), expected.end());
    EXPECT_GT(size, 1e-3);
    Index still = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      EXPECT_NEAR(found[i], expected[i], 1e-9 * size);
      still += found[i] == 0;
    }
    EXPECT_GT(still, static_cast<Index>(x.size() / 2)) << "far away nothing was done";
    for (double& value : x) value *= 1.0001;
    EXPECT_EQ(forces(moved, x, true), forces(all, x, false)) << "to the bit";
    EXPECT_EQ(forces(moved, at_rest, true), forces(all, at_rest, false)) << "who is awake stays so";
  }
}

TEST(ElementForce, NamesTheInvertedTetrahedron) {
  Mesh mesh = cut_into_tetrahedra(box_mesh({2, 1, 1, 2, 1, 1}));
  std::swap(mesh.connectivity[4 * 7], mesh.connectivity[4 * 7 + 1]);
  try {
    ElementForce elements(model_of(mesh, Formulation::one_point));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Status::bad_mesh);
    EXPECT_NE(std::string(error.what()).find("element 7 "), std::string::npos);
  }
}

TEST(ElementForce, NamesTheInvertedElement) {
  Mesh mesh = box_mesh({3, 1, 1, 3, 1, 1});
  for (int c = 0; c < 4; ++c) std::swap(mesh.connectivity[8 + c], mesh.connectivity[12 + c]);
  try {
    ElementForce elements(model_of(mesh, Formulation::one_point));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Status::bad_mesh);
    EXPECT_NE(std::string(error.what()).find("element 1 "), std::string::npos);
  }
}

TEST(ElementForce, FindsTheElementThatTurnedInsideOut) {
  const Box box{3, 1, 1, 3, 1, 1};
  ElementForce elements(model_of(box_mesh(box), Formulation::one_point));
  Positions x = box_mesh(box).coordinates;
  EXPECT_EQ(elements.first_inverted(x), kNone);
  for (Index j = 0; j < 2; ++j) {
    for (Index k = 0; k < 2; ++k) x[3 * std::size_t(box.node(3, j, k))] = 1.5;
  }
  EXPECT_EQ(elements.first_inverted(x), 2);
  x[0] = std::nan("");
  EXPECT_EQ(elements.first_inverted(x), 0);
}

TEST(ElementForce, RefusesAnUnknownInstructionSet) {
  setenv("CDFP_ISA", "sse9", 1);
  EXPECT_THROW(ElementForce elements(model_of(box_mesh({}), Formulation::one_point)), Error);
  unsetenv("CDFP_ISA");
}

}  // namespace
}  // namespace cdfp::test

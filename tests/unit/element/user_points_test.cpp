// Users' laws: what they are told, and that their stress acts as a built-in law's does.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <mutex>
#include <set>

#include "cdfp/error.hpp"
#include "fixtures.hpp"

namespace cdfp::test {
namespace {

constexpr double kModulus = 74e9, kNu = 0.2, kDensity = 2500;

Matrix3d symmetric_at(const double* array, std::int64_t n, std::int64_t i) {
  Matrix3d m;
  m << array[i], array[3 * n + i], array[5 * n + i], array[3 * n + i], array[n + i], array[4 * n + i],
      array[5 * n + i], array[4 * n + i], array[2 * n + i];
  return m;
}

Matrix3d full_at(const double* array, std::int64_t n, std::int64_t i) {
  Matrix3d m;
  m << array[i], array[3 * n + i], array[8 * n + i], array[6 * n + i], array[n + i], array[4 * n + i],
      array[5 * n + i], array[7 * n + i], array[2 * n + i];
  return m;
}

void put_symmetric(double* array, std::int64_t n, std::int64_t i, const Matrix3d& m) {
  const double values[] = {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(1, 2), m(2, 0)};
  for (std::int64_t k = 0; k < 6; ++k) array[k * n + i] = values[k];
}

/// The built-in elastic law, by the stretch: s = U S U / J.
void saint_venant(const MaterialPoints& p) {
  const double lambda = kModulus * kNu / ((1 + kNu) * (1 - 2 * kNu)), mu = kModulus / (2 * (1 + kNu));
  for (std::int64_t i = 0; i < p.count; ++i) {
    const Matrix3d u = symmetric_at(p.stretch, p.count, i);
    const Matrix3d e = 0.5 * (u * u - Matrix3d::Identity());
    const Matrix3d s = lambda * e.trace() * Matrix3d::Identity() + 2 * mu * e;
    put_symmetric(p.stress, p.count, i, u * s * u / u.determinant());
  }
}

UserMaterial user_material(std::function<void(const MaterialPoints&)> callback, int states = 0) {
  UserMaterial m;
  m.density = kDensity;
  m.states = states;
  m.callback = std::move(callback);
  return m;
}

Model user_model(Mesh mesh, Formulation formulation, UserMaterial material) {
  Model model = model_of(std::move(mesh), formulation, kModulus, kNu, kDensity);
  model.materials[0].law = std::move(material);
  return model;
}

struct Kind {
  const char* name;
  Mesh mesh;
  Formulation formulation;
};

std::vector<Kind> all_kinds(std::mt19937& random) {
  const Box box{4, 3, 6, 1.0, 0.8, 1.5};  // more than one block of hexahedra
  Mesh columns = box_mesh(box), any = box_mesh(box);
  distort_columns(columns, box, 0.03, random);
  distort(any.coordinates, 0.02, random);
  return {{"prism", columns, Formulation::one_point},
          {"hexahedron", any, Formulation::one_point},
          {"full prism", columns, Formulation::full},
          {"full", any, Formulation::full},
          {"tetrahedron", cut_into_tetrahedra(any), Formulation::one_point},
          {"wedge", cut_into_wedges(columns), Formulation::one_point},
          {"distorted wedge", cut_into_wedges(any), Formulation::one_point}};
}

std::vector<double> user_force(ElementForce& elements, const Positions& x, double time, double step,
                               const Threads& threads = Threads(1)) {
  elements.advance_user_laws(x, time, step, threads);
  return force_of(elements, x, step, threads);
}

TEST(UserLaw, ForcesEnergyStressAndStepOfTheBuiltInLaw) {
  std::mt19937 random(7);
  for (const Kind& kind : all_kinds(random)) {
    SCOPED_TRACE(kind.name);
    ElementForce built_in(model_of(kind.mesh, kind.formulation, kModulus, kNu, kDensity));
    UserMaterial material = user_material(saint_venant);
    material.youngs_modulus = kModulus;
    material.poissons_ratio = kNu;
    ElementForce user(user_model(kind.mesh, kind.formulation, material));
    Positions x = mapped(kind.mesh.coordinates, Matrix3d::Identity() + random_matrix(0.1, random));
    distort(x, 0.005, random);
    const std::vector<double> wanted = force_of(built_in, x), got = user_force(user, x, 1e-6, 1e-6);
    for (std::size_t i = 0; i < x.size(); ++i) ASSERT_NEAR(got[i], wanted[i], 2e-9 * largest(wanted)) << i;
    const PartEnergy energy = energy_of(built_in, x), mine = energy_of(user, x);
    EXPECT_NEAR(mine.strain, energy.strain, 1e-9 * energy.strain);
    EXPECT_NEAR(mine.hourglass, energy.hourglass, 1e-4 * energy.hourglass);
    for (Index e = 0; e < kind.mesh.element_count(); e += 17) {
      const Matrix3d difference = to_eigen(user.stress(e, x)) - to_eigen(built_in.stress(e, x));
      EXPECT_LT(difference.norm(), 1e-9 * to_eigen(built_in.stress(e, x)).norm());
    }
    const double step = built_in.stable_step(x, Threads(1)).step;
    EXPECT_NEAR(user.stable_step(x, Threads(1)).step, step, 1e-4 * step);
  }
}

/// F, its polar parts, density, place and the increments, for a path through two known states.
TEST(UserLaw, IsToldTheDeformation) {
  std::mt19937 random(11);
  for (const Kind& kind : all_kinds(random)) {
    SCOPED_TRACE(kind.name);
    const Matrix3d first = Matrix3d::Identity() + random_matrix(0.15, random);
    const Matrix3d second =
        Eigen::AngleAxisd(2.5, Vector3d(1, 2, -1).normalized()) * first + random_matrix(1e-4, random);
    const Vector3d shift(3, -2, 1);
    const auto root = [](const Matrix3d& f) {
      return Matrix3d(Eigen::SelfAdjointEigenSolver<Matrix3d>(f.transpose() * f).operatorSqrt());
    };
    int calls = 0;
    std::set<Index> seen;
    const auto law = [&](const MaterialPoints& p) {
      saint_venant(p);
      if (p.start) {
        EXPECT_EQ(p.time, 0);
        EXPECT_GT(p.step, 0);
        return;
      }
      if (p.time != 2e-6) return;
      ++calls;
      for (std::int64_t i = 0; i < p.count; ++i) {
        seen.insert(p.elements[i]);
        const Matrix3d f = full_at(p.gradient, p.count, i), u = symmetric_at(p.stretch, p.count, i);
        const Matrix3d u0 = symmetric_at(p.stretch_old, p.count, i);
        ASSERT_LT((f - second).norm(), 1e-12);
        ASSERT_LT((full_at(p.gradient_old, p.count, i) - first).norm(), 1e-12);
        ASSERT_LT((u - root(second)).norm(), 1e-12);
        ASSERT_LT((u0 - root(first)).norm(), 1e-12);
        ASSERT_LT((full_at(p.rotation, p.count, i) * u - f).norm(), 1e-12);
        ASSERT_NEAR(p.density[i], kDensity / second.determinant(), 1e-9 * kDensity);
        const Matrix3d l = (u - u0) * (0.5 * (u + u0)).inverse();
        ASSERT_LT((symmetric_at(p.strain_increment, p.count, i) - 0.5 * (l + l.transpose())).norm(), 1e-13);
        ASSERT_NEAR(p.spin_increment[i], 0.5 * (l(1, 0) - l(0, 1)), 1e-13);
        ASSERT_NEAR(p.spin_increment[p.count + i], 0.5 * (l(2, 1) - l(1, 2)), 1e-13);
        ASSERT_NEAR(p.spin_increment[2 * p.count + i], 0.5 * (l(0, 2) - l(2, 0)), 1e-13);
      }
    };
    ElementForce elements(user_model(kind.mesh, kind.formulation, user_material(law)));
    user_force(elements, mapped(kind.mesh.coordinates, first), 1e-6, 1e-6);
    user_force(elements, mapped(kind.mesh.coordinates, second, shift), 2e-6, 1e-6);
    EXPECT_GT(calls, 0);
    EXPECT_EQ(seen.size(), std::size_t(kind.mesh.element_count()));
  }
}

TEST(UserLaw, MeanPlaceOfThePointsIsTheCentre) {
  std::mt19937 random(3);
  for (const Kind& kind : all_kinds(random)) {
    std::vector<Vector3d> sum(kind.mesh.types.size(), Vector3d::Zero());
    std::vector<int> points(kind.mesh.types.size(), 0);
    const auto law = [&](const MaterialPoints& p) {
      saint_venant(p);
      if (p.start) return;
      for (std::int64_t i = 0; i < p.count; ++i) {
        const auto e = std::size_t(p.elements[i]);
        sum[e] += Vector3d(p.position[i], p.position[p.count + i], p.position[2 * p.count + i]);
        ++points[e];
      }
    };
    ElementForce elements(user_model(kind.mesh, kind.formulation, user_material(law)));
    user_force(elements, kind.mesh.coordinates, 1e-6, 1e-6);
    const auto corners = static_cast<std::size_t>(corners_of(kind.mesh.types[0]));
    for (std::size_t e = 0; e < sum.size(); ++e) {
      ASSERT_EQ(points[e], corners == 6 ? 2 : kind.formulation == Formulation::full ? 8 : 1);
      Vector3d centre = Vector3d::Zero();
      for (std::size_t c = 0; c < corners; ++c) {
        centre += at(kind.mesh.coordinates, kind.mesh.connectivity[corners * e + c]) / double(corners);
      }
      EXPECT_LT((sum[e] / points[e] - centre).norm(), 1e-12) << kind.name;
    }
  }
}

/// A hypoelastic law: nothing in the step but the increments.
void hypoelastic(const MaterialPoints& p) {
  const double lambda = kModulus * kNu / ((1 + kNu) * (1 - 2 * kNu)), mu = kModulus / (2 * (1 + kNu));
  const std::int64_t n = p.count;
  for (std::int64_t i = 0; i < n; ++i) {
    const double trace = p.strain_increment[i] + p.strain_increment[n + i] + p.strain_increment[2 * n + i];
    for (std::int64_t k = 0; k < 6; ++k) {
      p.stress[k * n + i] =
          p.stress_old[k * n + i] + 2 * mu * p.strain_increment[k * n + i] + (k < 3 ? lambda * trace : 0);
    }
    if (p.state_count > 0) p.state[i] = p.state_old[i] + 1;
  }
}

TEST(UserLaw, TurningLeavesTheCorotatedStress) {
  std::mt19937 random(5);
  for (const Kind& kind : all_kinds(random)) {
    SCOPED_TRACE(kind.name);
    ElementForce elements(user_model(kind.mesh, kind.formulation, user_material(hypoelastic)));
    const Matrix3d f = Matrix3d::Identity() + random_matrix(0.05, random);
    user_force(elements, mapped(kind.mesh.coordinates, f), 1e-6, 1e-6);
    const Matrix3d before = to_eigen(elements.stress(0, mapped(kind.mesh.coordinates, f)));
    Positions x;
    Matrix3d turn;
    for (int step = 1; step <= 100; ++step) {
      turn = Eigen::AngleAxisd(0.07 * step, Vector3d(2, -1, 3).normalized());
      x = mapped(kind.mesh.coordinates, turn * f);
      user_force(elements, x, 1e-6 * (step + 1), 1e-6);
    }
    EXPECT_LT((to_eigen(elements.stress(0, x)) - turn * before * turn.transpose()).norm(),
              1e-11 * before.norm());
  }
}

/// Dienes (1979): the Green-Naghdi rate in simple shear, tan b = shear / 2.
TEST(UserLaw, SimpleShearOfGreenNaghdi) {
  const double mu = kModulus / (2 * (1 + kNu));
  const Mesh mesh = box_mesh({});
  ElementForce elements(user_model(mesh, Formulation::one_point, user_material(hypoelastic)));
  const int steps = 2000;
  const double most = 4;
  Positions x;
  for (int step = 1; step <= steps; ++step) {
    Matrix3d f = Matrix3d::Identity();
    f(0, 1) = most * step / steps;
    x = mapped(mesh.coordinates, f);
    user_force(elements, x, 1e-6 * step, 1e-6);
  }
  const double b = std::atan(most / 2), c = std::cos(2 * b), s = std::sin(2 * b);
  const Matrix3d stress = to_eigen(elements.stress(0, x));
  EXPECT_NEAR(stress(0, 1), 2 * mu * c * (2 * b - 2 * std::tan(2 * b) * std::log(std::cos(b)) - std::tan(b)),
              1e-5 * mu);
  EXPECT_NEAR(stress(0, 0), 4 * mu * (c * std::log(std::cos(b)) + b * s - std::sin(b) * std::sin(b)),
              1e-5 * mu);
  EXPECT_NEAR(stress(1, 1), -stress(0, 0), 1e-5 * mu);
}

TEST(UserLaw, FirstCallShowsTheConstantsAndKeepsTheState) {
  std::vector<double> states;
  const auto law = [&](const MaterialPoints& p) {
    hypoelastic(p);
    EXPECT_EQ(p.property_count, 2);
    EXPECT_EQ(p.properties[1], 8.0);
    if (!p.start && p.time == 1e-6) {
      EXPECT_EQ(p.stress_old[0], 0) << "the first stress is dropped";
    }
    states.push_back(p.state_old[0]);
  };
  UserMaterial material = user_material(law, 1);
  material.properties = {7, 8};
  ElementForce elements(user_model(box_mesh({}), Formulation::one_point, material));
  const ElementForce::Elasticity shown = elements.shown_elasticity(0);
  EXPECT_NEAR(shown.youngs_modulus, kModulus, 1e-9 * kModulus);
  EXPECT_NEAR(shown.poissons_ratio, kNu, 1e-9);
  user_force(elements, box_mesh({}).coordinates, 1e-6, 1e-6);
  user_force(elements, box_mesh({}).coordinates, 2e-6, 1e-6);
  EXPECT_EQ(states, (std::vector<double>{0, 1, 2}));
  EXPECT_EQ(elements.mean_state(0, 0), 3);
  EXPECT_TRUE(std::isnan(elements.mean_state(0, 1)));
}

TEST(UserLaw, SameBitsForAnyThreadsSafeOrNot) {
  std::mt19937 random(19);
  for (const Kind& kind : all_kinds(random)) {
    std::vector<double> first;
    Positions x = kind.mesh.coordinates;
    distort(x, 0.01, random);
    for (const bool safe : {false, true}) {
      for (const int count : {1, 2, 5}) {
        UserMaterial material = user_material(hypoelastic, 1);
        material.thread_safe = safe;
        Model model = user_model(kind.mesh, kind.formulation, material);
        model.threads = count;
        ElementForce elements(model);
        const std::vector<double> force = user_force(elements, x, 1e-6, 1e-6, Threads(count));
        if (first.empty()) first = force;
        EXPECT_EQ(force, first) << kind.name << ' ' << safe << ' ' << count;
      }
    }
  }
}

std::string message_of(const std::function<void(const MaterialPoints&)>& bad, int states) {
  const Mesh mesh = box_mesh({3, 1, 1, 3, 1, 1});
  ElementForce elements(user_model(mesh, Formulation::one_point,
                                   user_material(
                                       [&](const MaterialPoints& p) {
                                         hypoelastic(p);
                                         if (!p.start) bad(p);
                                       },
                                       states)));
  try {
    elements.advance_user_laws(mesh.coordinates, 3e-6, 1e-6, Threads(1));
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Status::diverged);
    return error.what();
  }
  return "";
}

TEST(UserLaw, FailuresNameElementPointMaterialAndTime) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::string where = "material 'elastic', element 1 (part 'body'), point 0 at time 3 us: ";
  const auto lane_of_1 = [](const MaterialPoints& p) {
    return std::find(p.elements, p.elements + 3, 1) - p.elements;
  };
  std::string text =
      message_of([&](const MaterialPoints& p) { p.stress[3 * p.count + lane_of_1(p)] = nan; }, 1);
  EXPECT_EQ(text.find(where + "the law gave a number that is not finite: stress 12"), 0U) << text;
  text = message_of([&](const MaterialPoints& p) { p.state[lane_of_1(p)] = nan; }, 1);
  EXPECT_EQ(text.find(where + "the law gave a number that is not finite: state 1"), 0U) << text;
  text = message_of(
      [&](const MaterialPoints& p) {
        *p.failed = lane_of_1(p);
        std::snprintf(p.message, std::size_t(p.message_capacity), "no root within %d iterations", 50);
      },
      1);
  EXPECT_EQ(text, where + "no root within 50 iterations");
  text = message_of([&](const MaterialPoints&) { throw std::runtime_error("a table ends"); }, 1);
  EXPECT_NE(text.find("a table ends"), std::string::npos) << text;
  for (const int states : {0, 1, 4}) {
    text = message_of([&](const MaterialPoints& p) { p.state[states * p.count + 2] = 1; }, states);
    EXPECT_NE(text.find("wrote past its " + std::to_string(states) + " state variables"), std::string::npos)
        << text;
  }
  text = message_of([](const MaterialPoints& p) { p.stress[6 * p.count] = 0; }, 1);
  EXPECT_NE(text.find("past the end of its stresses"), std::string::npos) << text;
  EXPECT_EQ(message_of([](const MaterialPoints&) {}, 2), "");
}

TEST(UserLaw, AnInvertedElementIsNamed) {
  const Mesh mesh = box_mesh({});
  for (const Formulation formulation : {Formulation::one_point, Formulation::full}) {
    ElementForce elements(user_model(mesh, formulation, user_material(hypoelastic)));
    Matrix3d mirror = Matrix3d::Identity();
    mirror(2, 2) = -1;
    try {
      elements.advance_user_laws(mapped(mesh.coordinates, mirror), 1e-6, 1e-6, Threads(1));
      ADD_FAILURE();
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what())
                    .find("element 0 (part 'body'), point 0 at time 1 us: the element is inverted"),
                std::string::npos)
          << error.what();
    }
  }
}

/// Elements whose points all fail carry nothing from then on, not even hourglass forces; one failed point of
/// eight leaves the rest.
TEST(UserLaw, DeletedElementsCarryNoForce) {
  std::mt19937 random(23);
  for (const Kind& kind : all_kinds(random)) {
    SCOPED_TRACE(kind.name);
    const auto law = [](const MaterialPoints& p) {
      hypoelastic(p);
      for (std::int64_t i = 0; i < p.count; ++i) {
        const bool all = p.elements[i] % 3 == 0, some = p.elements[i] % 3 == 1 && p.point == 7;
        if (p.time > 1.5e-6 && (all || some)) p.state[p.count + i] = 0;
      }
    };
    UserMaterial material = user_material(law, 2);
    material.deletion_state = 1;
    ElementForce elements(user_model(kind.mesh, kind.formulation, material));
    Positions x = kind.mesh.coordinates;
    distort(x, 0.02, random);
    EXPECT_TRUE(elements.advance_user_laws(x, 1e-6, 1e-6, Threads(1)).empty());
    const auto gone = elements.advance_user_laws(x, 2e-6, 1e-6, Threads(1));
    EXPECT_EQ(gone.size(), (kind.mesh.types.size() + 2) / 3);
    EXPECT_EQ(gone[1], 3);
    distort(x, 0.02, random);
    EXPECT_TRUE(elements.advance_user_laws(x, 3e-6, 1e-6, Threads(1)).empty());
    std::vector<double> corner(24), all(x.size(), 0.0);
    for (Index e = 0; e < kind.mesh.element_count(); ++e) {
      const auto corners = static_cast<std::size_t>(corners_of(kind.mesh.types[0]));
      elements.corner_force(e, x, std::span(corner).first(3 * corners));
      EXPECT_EQ(largest({corner.begin(), corner.begin() + std::ptrdiff_t(3 * corners)}) == 0, e % 3 == 0)
          << e;
      const double some = kind.formulation == Formulation::full ? 4 - 1.0 / 8 : 4;
      EXPECT_EQ(elements.mean_state(e, 0), e % 3 == 0 ? 3 : e % 3 == 1 ? some : 4);
    }
    const StepBound bound = elements.stable_step(x, Threads(1));
    EXPECT_NE(bound.element % 3, 0);
    EXPECT_TRUE(std::isfinite(bound.step));
  }
}

}  // namespace
}  // namespace cdfp::test

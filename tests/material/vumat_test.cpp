// VUMATs of several makes against closed forms, and what goes wrong in them.
#include "outside_law.hpp"

#include <cmath>

namespace cdfp::test {
namespace {

const Matrix3d kUnit = Matrix3d::Identity();

/// exp(t e) for a strain in principal axes.
Matrix3d stretched(double a, double b, double c) {
  return Eigen::Vector3d(std::exp(a), std::exp(b), std::exp(c)).asDiagonal();
}

Matrix3d turn(double angle) {
  return Eigen::AngleAxisd(angle, Eigen::Vector3d(1, 2, -2).normalized()).toRotationMatrix();
}

VumatCase old_habits(const std::string& name) {
  VumatCase c{"tests/material/vumat/old_habits.f", {200e9, 0.3}, 4};
  c.options.name = name;
  c.options.temperature = 300;
  c.options.fields = {5, 7};
  return c;
}
constexpr double kMu = 200e9 / 2.6, kLambda = 200e9 * 0.3 / (1.3 * 0.4);

TEST(Vumat, OldFixedFormUniaxialStrain) {
  for (const Formulation formulation : {Formulation::one_point, Formulation::full}) {
    Cubes cubes(vumat_material(old_habits("hard steel")), formulation);
    cubes.follow([](double t) { return stretched(t, 0, 0); }, 0.2, 200);
    const Matrix3d s = cubes.stress();
    EXPECT_NEAR(s(0, 0), (kLambda + 2 * kMu) * 0.2, 1e-6 * kMu);
    EXPECT_NEAR(s(1, 1), kLambda * 0.2, 1e-6 * kMu);
    EXPECT_NEAR(s(0, 1), 0, 1e-9 * kMu);
    EXPECT_EQ(cubes.state(3), 307) << "tempNew and the second field";
    // work of a hypoelastic solid in one direction, over the mass: second order in the step
    const double work = 0.5 * (kLambda + 2 * kMu) * 0.2 * 0.2;
    EXPECT_GT(cubes.state(4) * 2000, 0.9 * work);
    const std::vector<PartEnergy> energy = cubes.elements().energies(cubes.position(), Threads(1));
    // integral of (lambda + 2 mu) e exp(e) de from 0 to 0.2
    const double exact = (kLambda + 2 * kMu) * (std::exp(0.2) * (0.2 - 1) + 1);
    EXPECT_NEAR(energy[0].strain, exact, 1e-5 * exact);
  }
}

TEST(Vumat, NameChoosesTheMaterial) {
  Cubes hard(vumat_material(old_habits("hard"))), soft(vumat_material(old_habits("Soft rubber")));
  hard.move(stretched(1e-3, 0, 0), 1e-6);
  soft.move(stretched(1e-3, 0, 0), 1e-6);
  EXPECT_NEAR(soft.stress()(0, 0), 0.5 * hard.stress()(0, 0), 1e-9 * kMu);
  try {
    Cubes other(vumat_material(old_habits("wood")));
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("No material is called WOOD; have 2 kinds"), std::string::npos)
        << error.what();
  }
}

/// Dienes (1979), in each plane of shear and direction, also while the whole turns.
TEST(Vumat, OldFixedFormSimpleShear) {
  const double most = 3, b = std::atan(most / 2);
  const double shear =
      2 * kMu * std::cos(2 * b) * (2 * b - 2 * std::tan(2 * b) * std::log(std::cos(b)) - std::tan(b));
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (i == j) continue;
      for (const double spin : {0.0, 2.0}) {
        Cubes cubes(vumat_material(old_habits("hard")));
        const auto path = [&](double t) {
          Matrix3d f = kUnit;
          f(i, j) = t;
          return Matrix3d(turn(spin * t) * f);
        };
        cubes.follow(path, most, 1000);
        const Matrix3d s = turn(spin * most).transpose() * cubes.stress() * turn(spin * most);
        EXPECT_NEAR(s(i, j), shear, 1e-5 * kMu) << i << j;
        EXPECT_NEAR(s(j, i), shear, 1e-5 * kMu);
        EXPECT_NEAR(s(i, i) + s(j, j), 0, 1e-5 * kMu);
      }
    }
  }
}

TEST(Vumat, HypoelasticErrorFallsWithTheSquareOfTheStep) {
  const auto error = [](int steps) {
    Cubes cubes(vumat_material(old_habits("hard")));
    cubes.follow([](double t) { return stretched(t, 0, 0); }, 0.5, steps);
    return std::abs(cubes.stress()(0, 0) - (kLambda + 2 * kMu) * 0.5);
  };
  EXPECT_NEAR(error(20) / error(40), 4, 0.1);
}

TEST(Vumat, NeoHookeanIsAFunctionOfF) {
  const double lambda = 3e6, mu = 1e6;
  std::srand(4);
  for (int sample = 0; sample < 20; ++sample) {
    Cubes cubes(vumat_material({"tests/material/vumat/neo_hookean.f90", {lambda, mu}, 1}));
    const Matrix3d f = turn(0.3 * sample) * (kUnit + 0.3 * Matrix3d::Random());
    if (f.determinant() < 0.2) continue;
    cubes.move(f, 1e-6);
    const double j = f.determinant();
    const Matrix3d exact = mu / j * (f * f.transpose() - kUnit) + lambda * std::log(j) / j * kUnit;
    EXPECT_LT((cubes.stress() - exact).norm(), 1e-12 * (mu + exact.norm()));
    EXPECT_NEAR(cubes.state(1), j, 1e-12);
  }
}

VumatCase viscoelastic() {
  return {"tests/material/vumat/viscoelastic.for", {2e9, 1e6, 4e6, 1e-4}, 6};
}

TEST(Vumat, ViscoelasticAtConstantRateAndAtRest) {
  const double g0 = 1e6, g1 = 4e6, tau = 1e-4, rate = 1000, end = 2e-4;
  for (const double spin : {0.0, 1e4}) {
    Cubes cubes(vumat_material(viscoelastic()));
    const auto path = [&](double t) {
      const double e = rate * std::min(t, end);
      return Matrix3d(turn(spin * t) * stretched(e, -e / 2, -e / 2));
    };
    const auto axial = [&](double t) {
      return (turn(spin * t).transpose() * cubes.stress() * turn(spin * t))(0, 0);
    };
    // the first call strains the branch by about 1e-5
    const double slack = 2 * g1 * 2e-5;
    cubes.follow(path, end, 400);
    const double e = rate * end;
    const double branch = 2 * g1 * tau * rate * -std::expm1(-end / tau);
    EXPECT_NEAR(axial(end), 2 * g0 * e + branch, slack);
    for (int i = 1; i <= 200; ++i) cubes.move(path(end + 1e-6 * i), 1e-6);
    EXPECT_NEAR(axial(end + 2e-4), 2 * g0 * e + branch * std::exp(-2e-4 / tau), slack);
    const PartEnergy energy = cubes.elements().energies(cubes.position(), Threads(1))[0];
    EXPECT_GT(energy.dissipated, 0);
  }
}

VumatCase johnson_cook() {
  VumatCase c{"examples/user_material/johnson_cook.f",
              {200e9, 0.3, 350e6, 275e6, 0.36, 0.022, 1, 1.0, 293, 1800, 450, 0.9, 1e9},
              4};
  c.density = 7850;
  c.deletion_state = 3;
  return c;
}

/// dep/ds of 3 mu (s - ep) = yield(ep, rate, T) with dT = 0.9 yield dep / (rho cp), by small steps.
struct Hardening {
  double ep = 0, temperature = 293;

  double yield(double rate) const {
    const double hard = 350e6 + (ep > 0 ? 275e6 * std::pow(ep, 0.36) : 0);
    return hard * (1 + 0.022 * std::log(std::max(1.0, rate))) * (1 - (temperature - 293) / (1800 - 293));
  }
  void strain_to(double total, int steps, double strain_rate) {
    constexpr double mu = 200e9 / 2.6;
    const double ds = total / steps;
    for (int i = 0; i < steps; ++i) {
      double low = 0, high = ds;
      const Hardening before = *this;
      for (int k = 0; k < 60; ++k) {
        const double dep = 0.5 * (low + high);
        ep = before.ep + dep;
        const double stress = 3 * mu * ((i + 1) * ds - ep);
        temperature = before.temperature + 0.9 * stress * dep / (7850 * 450);
        (stress > yield(dep / ds * strain_rate) ? low : high) = dep;
      }
    }
  }
};

TEST(Vumat, JohnsonCookHardensRatesAndHeats) {
  const double rate = 1e4, strain = 0.3;
  for (const double spin : {0.0, 3e4}) {
    Cubes cubes(vumat_material(johnson_cook()));
    const auto path = [&](double t) {
      return Matrix3d(turn(spin * t) * stretched(rate * t, -rate * t / 2, -rate * t / 2));
    };
    cubes.follow(path, strain / rate, 3000);
    Hardening exact;
    exact.strain_to(strain, 30000, rate);
    const Matrix3d s = cubes.stress();
    const Matrix3d deviator = s - s.trace() / 3 * kUnit;
    EXPECT_NEAR(std::sqrt(1.5) * deviator.norm(), exact.yield(rate), 2e-4 * exact.yield(rate));
    EXPECT_NEAR(cubes.state(1), exact.ep, 1e-5);
    EXPECT_NEAR(cubes.state(2), exact.temperature, 2e-2);
    EXPECT_GT(cubes.state(2), 330);
    EXPECT_NEAR(cubes.state(3), exact.yield(rate), 2e-4 * exact.yield(rate));
    EXPECT_NEAR(s.trace(), 0, 1e-5 * kMu);
    // what is lost is the heat over its share
    const PartEnergy energy = cubes.elements().energies(cubes.position(), Threads(1))[0];
    EXPECT_NEAR(energy.dissipated, (cubes.state(2) - 293) * 7850 * 450 / 0.9, 1e-3 * energy.dissipated);
    const double elastic = std::pow(exact.yield(rate), 2) / (6 * kMu);
    EXPECT_NEAR(energy.strain, elastic, 0.05 * elastic);
  }
}

TEST(Vumat, JohnsonCookDeletesWhereItFails) {
  VumatCase c = johnson_cook();
  c.properties.back() = 0.05;
  Cubes cubes(vumat_material(c));
  const double rate = 1e4;
  int deleted_at = 0;
  for (int i = 1; i <= 100; ++i) {
    const double e = 1e-3 * i;
    if (!cubes.move(stretched(e, -e / 2, -e / 2), 1e-3 / rate).empty()) deleted_at = i;
  }
  EXPECT_NEAR(deleted_at, 53, 2);
  EXPECT_EQ(cubes.stress().norm(), 0);
}

TEST(Vumat, SinglePrecisionWithElementNumbersFromJblock) {
  VumatCase c{"tests/material/vumat/single.f", {200e9, 0.3}, 3};
  c.options.single_precision = true;
  Cubes single(vumat_material(c), Formulation::full, 3);
  EXPECT_NEAR(single.elements().shown_elasticity(0).youngs_modulus, 200e9, 1e6);
  single.follow([](double t) { return stretched(t, 0, 0); }, 0.1, 100);
  EXPECT_NEAR(single.stress()(0, 0), (kLambda + 2 * kMu) * 0.1, 1e-4 * kMu);
  EXPECT_EQ(single.state(1, 2), 3);
  EXPECT_EQ(single.state(2), 4.5) << "points 1 to 8";
  EXPECT_EQ(single.state(3), 4);
  c.options.single_precision = false;
  Cubes twice(vumat_material(c));
  twice.move(kUnit, 1e-6);
  EXPECT_EQ(twice.state(3), 8);
}

TEST(Vumat, NewerFormWithDeletion) {
  VumatCase c{"tests/material/vumat/newer.f", {200e9, 0.3, 1e9}, 4};
  c.deletion_state = 0;
  Cubes cubes(vumat_material(c), Formulation::full, 70);  // two blocks
  EXPECT_TRUE(cubes.move(stretched(1e-3, 0, 0), 2e-6).empty());
  EXPECT_NEAR(cubes.stress(69)(0, 0), (kLambda + 2 * kMu) * 1e-3, 1e-6 * kMu);
  EXPECT_EQ(cubes.state(2, 69), 70);
  EXPECT_EQ(cubes.state(3, 69), 4.5);
  EXPECT_NEAR(cubes.state(4, 69), 2e-6, 1e-18);
  EXPECT_EQ(cubes.move(stretched(6e-3, 0, 0), 1e-6).size(), 70U);
  EXPECT_EQ(cubes.stress(69).norm(), 0);
  EXPECT_TRUE(cubes.move(kUnit, 1e-6).empty());
}

VumatCase utilities(double mode) {
  VumatCase c{"tests/material/vumat/utilities.f", {200e9, 0.3, mode}, 10};
  c.options.job = "plate";
  c.options.folder = "/tmp";
  return c;
}

TEST(Vumat, UtilityRoutines) {
  const UserMaterial material = vumat_material(utilities(0));
  Cubes cubes(material);
  for (int i = 1; i <= 3; ++i) cubes.move(stretched(1e-4 * i, 0, 0), 1e-6);
  EXPECT_EQ(cubes.state(1), 5) << "length of 'plate'";
  EXPECT_EQ(cubes.state(2), -2.5 + 4) << "kept between calls, the first one included";
  EXPECT_EQ(cubes.state(3), -2.5);
  EXPECT_EQ(cubes.state(4), 50);
  EXPECT_EQ(cubes.state(5), 104) << "made by vexternaldb";
  EXPECT_EQ(cubes.state(6), 0);
  EXPECT_EQ(cubes.state(7), 1);
  EXPECT_EQ(cubes.state(8), 8);
  EXPECT_EQ(cubes.state(9), 1);
  EXPECT_EQ(cubes.state(10), 'p' - '/');
  EXPECT_EQ(material.warnings(), std::vector<std::string>{"block 42 of soft at 2.5"});
}

TEST(Vumat, StopsAndErrorsEndTheStepAndNotTheProcess) {
  const std::pair<int, const char*> expected[] = {{1, "the law called xplb_exit"},
                                                  {2, "the law reached a STOP: the table ends"},
                                                  {3, "wrong moduli"},
                                                  {4, "bad value 2e+11"},
                                                  {5, "wrote past its 10 state variables"},
                                                  {6, "not finite: stress 12"},
                                                  {7, "past the end of its stresses"},
                                                  {8, "the law reached a STOP with the code 3"}};
  for (const auto& [mode, text] : expected) {
    for (const bool single : {false, true}) {
      VumatCase c = utilities(mode);
      c.options.single_precision = single;
      Cubes cubes(vumat_material(c));
      for (int attempt = 0; attempt < 2; ++attempt) {
        try {
          cubes.move(stretched(1e-4, 0, 0), 1e-6);
          ADD_FAILURE() << mode;
        } catch (const Error& error) {
          EXPECT_EQ(error.status(), Status::diverged);
          EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << mode << ": " << error.what();
          EXPECT_NE(std::string(error.what()).find("material 'law', element 0"), std::string::npos)
              << error.what();
        }
      }
    }
  }
}

TEST(Vumat, MissingPiecesAreNamed) {
  const auto message = [](const std::function<void()>& work) {
    try {
      work();
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  const auto write = [](const std::string& name, const std::string& text) {
    const std::string path = scratch_folder() + "/" + name;
    FILE* file = std::fopen(path.c_str(), "w");
    std::fputs(text.c_str(), file);
    std::fclose(file);
    return path;
  };
  UserMaterial material;
  std::string text = message([&] { load_vumat("/nowhere/law.so", {}, material); });
  EXPECT_NE(text.find("there is no library '/nowhere/law.so'"), std::string::npos) << text;
  text = message([&] { load_vumat(write("text.so", "no library"), {}, material); });
  EXPECT_NE(text.find("cannot be loaded"), std::string::npos) << text;

  const std::string wrong =
      write("wrong.f", "      subroutine vumat(\n      this is no Fortran\n      end\n");
  text = message([&] { build_material(wrong, scratch_folder() + "/wrong.so"); });
  EXPECT_NE(text.find("wrong.f' does not compile:"), std::string::npos) << text;
  EXPECT_NE(text.find("wrong.f:1:"), std::string::npos) << text;
  EXPECT_FALSE(std::filesystem::exists(scratch_folder() + "/wrong.so"));

  const std::string other = write("other.f", "      subroutine umat(x)\n      x = 1\n      end\n");
  build_material(other, scratch_folder() + "/other.so");
  text = message([&] { load_vumat(scratch_folder() + "/other.so", {}, material); });
  EXPECT_NE(text.find("has no subroutine VUMAT"), std::string::npos) << text;

  const std::string calls =
      write("calls.f", "      subroutine vumat(n)\n      call kmissing(n)\n      end\n");
  build_material(calls, scratch_folder() + "/calls.so");
  text = message([&] { load_vumat(scratch_folder() + "/calls.so", {}, material); });
  EXPECT_NE(text.find("kmissing_"), std::string::npos) << text;
  EXPECT_NE(text.find("compile that routine into it"), std::string::npos) << text;

  text = message([&] { load_material(scratch_folder() + "/other.so", "my_law", material); });
  EXPECT_NE(text.find("has no function 'my_law'"), std::string::npos) << text;
  text = message([&] { build_material(write("law.txt", ""), scratch_folder() + "/law.so"); });
  EXPECT_NE(text.find("has an ending that tells no language"), std::string::npos) << text;
}

TEST(Vumat, CompiledOnceUntilTheSourceChanges) {
  const std::string path = scratch_folder() + "/cached.f";
  const auto write = [&](const char* line, const char* included) {
    FILE* file = std::fopen(path.c_str(), "w");
    std::fprintf(file, "      subroutine vumat(n)\n      include 'part.inc'\n      %s\n      end\n", line);
    std::fclose(file);
    file = std::fopen((scratch_folder() + "/part.inc").c_str(), "w");
    std::fprintf(file, "      %s\n", included);
    std::fclose(file);
  };
  write("n = 1", "integer k");
  const std::string first = built_material(path);
  const auto time = std::filesystem::last_write_time(first);
  EXPECT_EQ(built_material(path), first);
  EXPECT_EQ(std::filesystem::last_write_time(first), time);
  EXPECT_NE(built_material(path, {true}), first);
  write("n = 2", "integer k");
  const std::string second = built_material(path);
  EXPECT_NE(second, first);
  write("n = 2", "integer j");
  EXPECT_NE(built_material(path), second);
}

/// Numbers of cards behind column 72, as from a deck.
TEST(Vumat, SourcesWithNumbersBehindColumn72) {
  const std::string path = scratch_folder() + "/cards.f";
  FILE* file = std::fopen(path.c_str(), "w");
  for (const char* line : {"      subroutine vumat(n)", "      n = 1", "      end"}) {
    std::fprintf(file, "%-72sCARD0010\n", line);
  }
  std::fclose(file);
  EXPECT_NO_THROW(build_material(path, scratch_folder() + "/cards.so"));
}

}  // namespace
}  // namespace cdfp::test

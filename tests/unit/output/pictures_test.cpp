#include "output/pictures.hpp"

#include <cairo.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "output/chart.hpp"
#include "output/files.hpp"
#include "output/history_pictures.hpp"
#include "output/scale.hpp"
#include "sample_run.hpp"
#include "scratch_folder.hpp"
#include "vtu_reader.hpp"

/// The leak checker's hook: what fontconfig keeps to the end is not ours.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libfontconfig\n";
}

namespace cdfp {
namespace {

/// Brightness of a PNG's pixels, 0 to 255.
struct Picture {
  int width, height;
  std::vector<int> brightness;
  explicit Picture(const std::filesystem::path& path) {
    cairo_surface_t* surface = cairo_image_surface_create_from_png(path.c_str());
    EXPECT_EQ(cairo_surface_status(surface), CAIRO_STATUS_SUCCESS) << path;
    width = cairo_image_surface_get_width(surface);
    height = cairo_image_surface_get_height(surface);
    const unsigned char* data = cairo_image_surface_get_data(surface);
    const int stride = cairo_image_surface_get_stride(surface);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const unsigned char* pixel = data + y * stride + 4 * x;
        brightness.push_back((pixel[0] + 2 * pixel[1] + pixel[2]) / 4);
      }
    cairo_surface_destroy(surface);
  }
  int at(double x, double y) const {
    return brightness[static_cast<std::size_t>(std::lround(y)) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(std::lround(x))];
  }
  /// Darkest within two pixels.
  int darkest_near(double x, double y) const {
    int darkest = 255;
    for (int dx = -2; dx <= 2; ++dx)
      for (int dy = -2; dy <= 2; ++dy) darkest = std::min(darkest, at(x + dx, y + dy));
    return darkest;
  }
};

CrackPicture quarter_plate() {
  CrackPicture picture;
  picture.part = "upper glass";
  picture.outline = {{-0.05, -0.05}, {0.05, -0.05}, {0.05, 0.05}, {-0.05, 0.05}};
  picture.copies = copies({{0, 0.0}, {1, 0.0}}, from_above);
  return picture;
}

// One panel of 1920 pixels for 100 mm, below 120 + 62 pixels of titles and 40 from the left.
Point pixel(Point metres) {
  return {40 + (metres.x + 0.05) * 19200, 182 + (0.05 - metres.y) * 19200};
}

TEST(CrackPicture, a_broken_face_is_dark_in_all_four_quarters) {
  const sample::ScratchFolder folder("quarters");
  make_folder(folder.path());
  CrackPicture picture = quarter_plate();
  SeenFacet facet;
  facet.count = 2;
  facet.damage = 1;
  facet.corners = {Point{0.01, 0.02}, Point{0.03, 0.025}};
  picture.panels = {{1e-4, {facet}}};
  draw_crack_picture(folder / "a.png", picture);
  const Picture drawn(folder / "a.png");
  EXPECT_EQ(drawn.width, 2000);
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0}) {
      const Point middle = pixel({x * 0.02, y * 0.0225}), beside = pixel({x * 0.02, y * 0.0265});
      EXPECT_LT(drawn.darkest_near(middle.x, middle.y), 60);
      EXPECT_GT(drawn.darkest_near(beside.x, beside.y), 230);
    }
  const Point across = pixel({0, 0.0225});
  EXPECT_GT(drawn.darkest_near(across.x, across.y), 230);
}

TEST(CrackPicture, few_cracks_are_shown_from_near) {
  const sample::ScratchFolder folder("near");
  make_folder(folder.path());
  CrackPicture picture = quarter_plate();
  SeenFacet facet;
  facet.count = 2;
  facet.damage = 1;
  facet.corners = {Point{0.002, 0.0}, Point{0.01, 0.008}};
  picture.panels = {{1e-4, {facet}}};
  draw_crack_picture(folder / "a.png", picture);
  const Picture drawn(folder / "a.png");
  // Cracks reach 10 mm to all sides: 26 mm over 1920 pixels.
  const auto near_pixel = [](Point metres) {
    return Point{1000 + metres.x * 1920 / 0.026, 182 + 960 - metres.y * 1920 / 0.026};
  };
  for (const double x : {-1.0, 1.0}) {
    const Point middle = near_pixel({x * 0.006, 0.004});
    EXPECT_LT(drawn.darkest_near(middle.x, middle.y), 60);
  }
  const Point beside = near_pixel({0.006, 0.006});
  EXPECT_GT(drawn.darkest_near(beside.x, beside.y), 230);
}

TEST(CrackPicture, broken_lines_lie_above_fresh_ones_and_above_faces_in_the_plane) {
  const sample::ScratchFolder folder("order");
  make_folder(folder.path());
  SeenFacet broken{{Point{0.01, 0.02}, Point{0.03, 0.02}}, 2, 1.0f};
  SeenFacet fresh{{Point{0.02, 0.01}, Point{0.02, 0.03}}, 2, 0.0f};
  SeenFacet flat{
      {Point{0.015, 0.015}, Point{0.025, 0.015}, Point{0.025, 0.025}, Point{0.015, 0.025}}, 4, 1.0f};
  std::vector<SeenFacet> facets = {broken, fresh, flat};
  std::vector<std::string> files;
  for (int turn = 0; turn < 3; ++turn) {
    CrackPicture picture = quarter_plate();
    picture.panels = {{1e-4, facets}};
    draw_crack_picture(folder / "a.png", picture);
    files.push_back(sample::read_text(folder / "a.png"));
    const Picture drawn(folder / "a.png");
    const Point crossing = pixel({0.02, 0.02}), inside = pixel({0.017, 0.017});
    EXPECT_LT(drawn.at(crossing.x, crossing.y), 60);
    EXPECT_GT(drawn.at(inside.x, inside.y), 120);
    EXPECT_LT(drawn.at(inside.x, inside.y), 235);
    std::rotate(facets.begin(), facets.begin() + 1, facets.end());
  }
  EXPECT_EQ(files[0], files[1]);
  EXPECT_EQ(files[0], files[2]);
}

TEST(Pictures, a_run_leaves_pictures_in_which_the_cracks_grow) {
  const sample::ScratchFolder folder("pictures");
  make_folder(folder.path());
  Pictures pictures(folder.path(), {"upper_glass", "lower_glass", "mirror"});
  for (const double time : {0.0, 33e-6, 60e-6, 120e-6}) pictures.keep(sample::state({}, time).frame);
  pictures.draw(sample::history(200, 600e-6), sample::summary());
  for (const char* name : {"cracks_upper.png", "cracks_lower.png", "section.png", "force.png", "energy.png"})
    EXPECT_EQ(Picture(folder / name).width, 2000) << name;
  EXPECT_FALSE(std::filesystem::exists(folder / "cracks_mirror.png"));
  for (const char* name : {"force.svg", "energy.svg"}) {
    const std::string text = sample::read_text(folder / name);
    EXPECT_NE(text.find("</svg>"), std::string::npos) << name;
  }
  // Three panels of 616 pixels: the one at 33 us has fewer dark pixels than the one at 60 us beside it.
  const Picture cracks(folder / "cracks_upper.png");
  long left = 0, right = 0, unlike = 0;
  for (int y = 200; y < 780; ++y)
    for (int x = 60; x < 640; ++x) {
      left += cracks.at(x, y) < 100;
      right += cracks.at(x + 652, y) < 100;
      // The left panel spans 40 to 656.
      unlike += std::abs(cracks.at(x, y) - cracks.at(695 - x, y)) > 128;
    }
  EXPECT_GT(left, 300);
  EXPECT_GT(right, 2 * left);
  EXPECT_LT(unlike, left / 20);
}

TEST(Pictures, an_empty_or_foreign_history_draws_nothing_and_does_no_harm) {
  const sample::ScratchFolder folder("none");
  make_folder(folder.path());
  draw_history(folder.path(), {}, {});
  draw_history(folder.path(), {{"time_s", "temperature_k"}, {0, 1, 2, 3}}, {});
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  draw_history(folder.path(), {{"time_s", "kinetic_j"}, {0, 1, 1e-6, NAN}}, {});
  EXPECT_TRUE(std::filesystem::exists(folder / "energy.png"));
}

TEST(Pictures, the_chosen_panels_end_with_the_last_and_are_spread) {
  std::vector<CrackPanel> panels;
  for (int i = 1; i <= 24; ++i) panels.push_back({i * 1e-5, {}});
  const auto chosen = choose_panels(panels, 6);
  ASSERT_EQ(chosen.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_DOUBLE_EQ(chosen[i].time, static_cast<double>(4 * (i + 1)) * 1e-5);
  EXPECT_EQ(choose_panels({panels[0], panels[1]}, 6).size(), 2u);
}

// Insertion hands corners to copies, and copies of copies: whatever the chain, the place is the mother's.
TEST(PlaneView, upright_faces_are_lines_and_flat_ones_areas) {
  const std::vector<double> positions = {0, 0, 0, 2, 1, 0, 2, 1, 1, 0, 0, 1, 3, 0, 0, 3, 3, 0.1, 0, 3, 0};
  CrackFacet upright, flat;
  upright.upper = upright.lower = {0, 1, 2, 3};
  upright.damage = 0.25;
  flat.upper = flat.lower = {0, 4, 5, 6};
  const SeenFacet line = see(upright, positions, from_above);
  ASSERT_TRUE(line.edge_on());
  EXPECT_EQ(line.damage, 0.25f);
  EXPECT_NEAR(std::hypot(line.corners[1].x - line.corners[0].x, line.corners[1].y - line.corners[0].y),
              std::sqrt(5.0), 1e-12);
  EXPECT_EQ(see(flat, positions, from_above).count, 4);
  EXPECT_EQ(see(upright, positions, from_the_front).count, 4);
  EXPECT_TRUE(see(flat, positions, from_the_front).edge_on());
}

// Against the section computed edge by edge of the plane z = a x + b y through the unit square, cut at y = d.
TEST(PlaneView, a_section_meets_faces_where_the_plane_does) {
  const std::vector<double> positions = {0, 0, 0, 1, 0, 0.5, 1, 1, 0.7, 0, 1, 0.2};
  CrackFacet facet;
  facet.upper = facet.lower = {0, 1, 2, 3};
  facet.damage = 0.5;
  for (const double depth : {0.0, 0.25, 1.0}) {
    const auto line = cut(facet, positions, from_the_front, depth);
    ASSERT_TRUE(line.has_value()) << depth;
    ASSERT_TRUE(line->edge_on());
    EXPECT_EQ(line->damage, 0.5f);
    Point a = line->corners[0], b = line->corners[1];
    if (a.x > b.x) std::swap(a, b);
    EXPECT_NEAR(a.x, 0, 1e-14);
    EXPECT_NEAR(b.x, 1, 1e-14);
    EXPECT_NEAR(a.y, 0.2 * depth, 1e-14);
    EXPECT_NEAR(b.y, 0.5 + 0.2 * depth, 1e-14);
  }
  EXPECT_FALSE(cut(facet, positions, from_the_front, -0.01).has_value());
  EXPECT_FALSE(cut(facet, positions, from_the_front, 1.01).has_value());
  const std::vector<double> upright = {0, 0.5, 0, 1, 0.5, 0, 1, 0.5, 1, 0, 0.5, 1};
  EXPECT_EQ(cut(facet, upright, from_the_front, 0.5)->count, 4);
  const std::vector<double> touching = {0, 0, 0, 1, 1, 0, 0, 2, 0, -1, 1, 0};
  EXPECT_FALSE(cut(facet, touching, from_the_front, 0).has_value());
}

TEST(PlaneView, mirror_images_fill_the_whole) {
  const auto four = copies({{0, 1.0}, {1, -2.0}, {2, 7.0}}, from_above);
  ASSERT_EQ(four.size(), 4u);
  std::vector<std::pair<double, double>> places;
  for (const Copy& copy : four) places.emplace_back(copy.place({3, 4}).x, copy.place({3, 4}).y);
  std::sort(places.begin(), places.end());
  EXPECT_EQ(places, (std::vector<std::pair<double, double>>{{-1, -8}, {-1, 4}, {3, -8}, {3, 4}}));
  EXPECT_EQ(copies({{2, 0.0}}, from_above).size(), 1u);
}

TEST(PlaneView, the_outline_holds_every_point_and_turns_left_at_each_corner) {
  const auto seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  std::vector<Point> points;
  for (int i = 0; i < 300; ++i)
    points.push_back({static_cast<double>(random() % 40), static_cast<double>(random() % 40)});
  const auto outline = convex_outline(points);
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Point a = outline[i], b = outline[(i + 1) % outline.size()], c = outline[(i + 2) % outline.size()];
    EXPECT_GT((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x), 0);
    for (const Point& p : points) EXPECT_GE((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x), 0);
  }
}

TEST(Colours, damage_darkens_evenly) {
  const auto lightness = [](Colour c) {
    const auto linear = [](double v) {
      return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    };
    const double luminance = 0.2126 * linear(c.red) + 0.7152 * linear(c.green) + 0.0722 * linear(c.blue);
    return luminance > 0.008856 ? 116 * std::cbrt(luminance) - 16 : 903.3 * luminance;  // CIE L*
  };
  EXPECT_GT(lightness(damage_colour(0)), 75);
  EXPECT_LT(lightness(damage_colour(1)), 12);
  for (int i = 0; i < 20; ++i) {
    const double fall = lightness(damage_colour(i / 20.0)) - lightness(damage_colour((i + 1) / 20.0));
    EXPECT_GT(fall, 1.8) << i;
    EXPECT_LT(fall, 5.5) << i;
  }
}

TEST(Scale, ticks_are_round_few_and_inside) {
  const auto seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  for (int i = 0; i < 1000; ++i) {
    const double low = std::uniform_real_distribution<>(-3, 3)(random);
    const double size = std::pow(10, std::uniform_real_distribution<>(-9, 9)(random));
    const double high = low * size + size;
    const Ticks ticks = round_ticks(low * size, high, 6);
    ASSERT_GE(ticks.values.size(), 3u);
    ASSERT_LE(ticks.values.size(), 11u);
    const double step = ticks.values[1] - ticks.values[0];
    EXPECT_GE(ticks.values.front(), low * size - 1e-6 * step);
    EXPECT_LE(ticks.values.back(), high + 1e-6 * step);
    const double digit = step / std::pow(10, std::floor(std::log10(step) + 1e-6));
    EXPECT_NEAR(std::min({std::abs(digit - 1), std::abs(digit - 2), std::abs(digit - 5)}), 0, 1e-6);
    for (std::size_t k = 0; k + 1 < ticks.values.size(); ++k)
      EXPECT_NE(label(ticks.values[k], ticks.decimals), label(ticks.values[k + 1], ticks.decimals));
  }
  EXPECT_TRUE(round_ticks(1, 1, 5).values.empty());
}

TEST(Scale, units_and_labels) {
  EXPECT_DOUBLE_EQ(rounded_down(0.078), 0.05);
  EXPECT_DOUBLE_EQ(rounded_down(0.02), 0.02);
  EXPECT_DOUBLE_EQ(rounded_down(999), 500);
  EXPECT_DOUBLE_EQ(rounded_down(1000), 1000);
  EXPECT_EQ(readable_unit(600e-6, "s").name, "µs");
  EXPECT_DOUBLE_EQ(readable_unit(600e-6, "s").size, 1e-6);
  EXPECT_EQ(readable_unit(1000, "N").name, "kN");
  EXPECT_EQ(readable_unit(999, "N").name, "N");
  EXPECT_EQ(readable_unit(0, "J").name, "J");
  EXPECT_EQ(label(-0.001, 1), "0.0");
  EXPECT_EQ(label(-2.5, 1), "−2.5");
  EXPECT_EQ(short_label(33.0), "33");
  EXPECT_EQ(short_label(20.44), "20.4");
  EXPECT_EQ(short_label(1234.5), "1234");
  EXPECT_EQ(short_label(0.05), "0.05");
}

TEST(Chart, thinning_keeps_peaks_and_gaps) {
  std::vector<Point> points;
  for (int i = 0; i < 100000; ++i) points.push_back({i / 100.0, std::sin(i)});
  points[43210].y = 77;
  points[60000].y = NAN;
  const auto runs = visible_runs(points);
  ASSERT_EQ(runs.size(), 2u);
  double highest = 0;
  std::size_t count = 0;
  for (const auto& run : runs)
    for (const Point& p : run) highest = std::max(highest, p.y), ++count;
  EXPECT_EQ(highest, 77);
  EXPECT_LE(count, 4 * 1001u);
  EXPECT_EQ(runs.front().front().x, 0);
  EXPECT_EQ(runs.back().back().x, points.back().x);
}

}  // namespace
}  // namespace cdfp

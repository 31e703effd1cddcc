// Pictures of sketches: every element is drawn, ghosts too, within the sheet.
#include "plots/sketch_picture.h"

#include <gtest/gtest.h>

#include <functional>

#include "plots/sketch_view.h"
#include "svg_text.h"

namespace whirl_twin {
namespace sketch_picture_test {

std::size_t elements(const SketchPicture& picture) {
  const std::string text = sketchImage(picture, ImageFormat::kSvg);
  EXPECT_TRUE(wellFormed(text));
  return countOf(text, "<path");
}

/// A frame that fixes the size of the picture, so that nothing else in it changes.
Sketch frame() {
  Sketch sketch;
  sketch.size = 2.0;
  sketch.lines = {{{{-1.0, 0.0, -1.0}, {1.0, 0.0, 1.0}}, SketchRole::kSupport}};
  return sketch;
}

struct Part {
  const char* name;
  std::function<void(Sketch&)> add;
};

class Parts : public testing::TestWithParam<Part> {};

TEST_P(Parts, AreDrawnEachByItsOwnElements) {
  SketchPicture picture{"", frame(), {}, {}};
  const std::size_t none = elements(picture);
  GetParam().add(picture.sketch);
  const std::size_t each = elements(picture) - none;
  EXPECT_GT(each, 0u);
  GetParam().add(picture.sketch);
  GetParam().add(picture.sketch);
  EXPECT_EQ(elements(picture), none + 3 * each);
}

INSTANTIATE_TEST_SUITE_P(
    Sketch, Parts,
    testing::Values(Part{"rod",
                         [](Sketch& s) {
                           s.rods.push_back({{}, {0.5, 0, 0.5}, 0.02, SketchRole::kBody});
                         }},
                    Part{"ball",
                         [](Sketch& s) {
                           s.balls.push_back({{}, 0.1, SketchRole::kMass});
                         }},
                    Part{"disc",
                         [](Sketch& s) {
                           s.discs.push_back({{}, {0, 1, 0}, 0.3, 0.05, 0.4, SketchRole::kBody});
                         }},
                    Part{"box",
                         [](Sketch& s) {
                           s.boxes.push_back({{}, {0.3, 0.2, 0.1}, 0.2, SketchRole::kMass});
                         }},
                    Part{"spring",
                         [](Sketch& s) {
                           s.springs.push_back({{}, {0.5, 0, 0}, 0.05});
                         }},
                    Part{"damper",
                         [](Sketch& s) {
                           s.dampers.push_back({{}, {0.5, 0, 0}, 0.02});
                         }},
                    Part{"arrow",
                         [](Sketch& s) {
                           s.arrows.push_back({{}, {0.5, 0, 0}});
                         }},
                    Part{"line",
                         [](Sketch& s) {
                           s.lines.push_back({{{}, {0, 0, 1}}, SketchRole::kMark});
                         }}),
    [](const auto& part) { return part.param.name; });

TEST(Picture, DrawsEveryGhost) {
  Sketch body = frame();
  body.balls.push_back({{}, 0.1, SketchRole::kMass});
  const std::size_t alone = elements({"", body, {}, {}});
  const std::size_t one = elements({"", body, {body}, {}}) - alone;
  EXPECT_EQ(elements({"", body, {body, body, body}, {}}), alone + 3 * one);
}

TEST(Picture, ShowsNoArrowWithoutLength) {
  Sketch sketch = frame();
  const std::size_t none = elements({"", sketch, {}, {}});
  sketch.arrows.push_back({{0.2, 0.0, 0.2}, {0.2, 0.0, 0.2}});
  EXPECT_EQ(elements({"", sketch, {}, {}}), none);
}

TEST(Picture, OfASinglePointIsDrawn) {
  Sketch sketch;
  sketch.balls = {{{}, 0.0, SketchRole::kMass}};
  EXPECT_GT(elements({"", sketch, {}, {}}), 0u);
}

TEST(View, FromTheFrontShowsXAndZ) {
  SketchView view;
  view.scale = 100.0;
  view.origin = {50.0, 60.0};
  const Spot spot = view.at({0.1, 7.0, 0.2});
  EXPECT_DOUBLE_EQ(spot.x, 60.0);
  EXPECT_DOUBLE_EQ(spot.y, 40.0);
}

TEST(View, FromAboveShowsWhatIsFartherAwayHigher) {
  SketchView view;
  view.raised = 0.3;
  EXPECT_LT(view.at({0.0, 1.0, 0.0}).y, view.at({}).y);
  EXPECT_GT(view.depth({0.0, 1.0, 0.0}), view.depth({}));
  EXPECT_LT(view.depth({0.0, 0.0, 1.0}), view.depth({}));
}

TEST(View, HoldsADiscSeenFromItsEdge) {
  Sketch sketch;
  sketch.discs = {{{}, {1.0, 0.0, 0.0}, 0.5, 0.1, 0.0, SketchRole::kBody}};
  const SketchBounds bounds = boundsOf(sketch, SketchView{});
  // 60 corners approximate the circle: it is 1 - cos(pi / 60) = 0.14 % smaller at most.
  EXPECT_NEAR(bounds.right - bounds.left, 0.1, 1e-12);
  EXPECT_NEAR(bounds.bottom - bounds.top, 1.0, 0.0014);
}

}  // namespace sketch_picture_test
}  // namespace whirl_twin

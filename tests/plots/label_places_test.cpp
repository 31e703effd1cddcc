// Labels on a chart: without overlap with curves or other labels, as long as there is space.
#include "plots/label_places.h"

#include <gtest/gtest.h>

#include <cmath>

namespace whirl_twin {
namespace label_places_test {

const Rectangle kSheet{0.0, 0.0, 100.0, 100.0};

TEST(LabelPlaces, StandWhereTheyAreWantedFirst) {
  LabelPlaces places(kSheet);
  EXPECT_EQ(places.take({{10.0, 10.0, 20.0, 8.0}, {50.0, 50.0, 20.0, 8.0}}).left, 10.0);
}

TEST(LabelPlaces, CoverNoCurveThatCrossesThemBetweenItsPoints) {
  LabelPlaces places(kSheet);
  places.avoid({{0.0, 14.0}, {100.0, 14.0}});  // no point of it lies within
  EXPECT_EQ(places.take({{10.0, 10.0, 20.0, 8.0}, {50.0, 50.0, 20.0, 8.0}}).left, 50.0);
}

TEST(LabelPlaces, CoverNoOtherWords) {
  LabelPlaces places(kSheet);
  const Rectangle wanted{10.0, 10.0, 20.0, 8.0};
  const Rectangle other{50.0, 50.0, 20.0, 8.0};
  EXPECT_EQ(places.take({wanted, other}).left, 10.0);
  EXPECT_EQ(places.take({wanted, other}).left, 50.0);
}

TEST(LabelPlaces, StayOnTheSheet) {
  LabelPlaces places(kSheet);
  EXPECT_EQ(places.take({{90.0, 10.0, 20.0, 8.0}, {70.0, 10.0, 20.0, 8.0}}).left, 70.0);
}

TEST(LabelPlaces, OfNoFreePlaceTheOneThatCoversLeast) {
  LabelPlaces places(kSheet);
  places.avoid({{0.0, 14.0}, {100.0, 14.0}});
  places.avoid({{0.0, 16.0}, {100.0, 16.0}});
  places.avoid({{0.0, 54.0}, {100.0, 54.0}});
  EXPECT_EQ(places.take({{10.0, 10.0, 20.0, 8.0}, {50.0, 50.0, 20.0, 8.0}}).left, 50.0);
}

TEST(LabelPlaces, PassOverABrokenLine) {
  LabelPlaces places(kSheet);
  places.avoid({{0.0, 14.0}, {NAN, NAN}, {100.0, 14.0}});
  EXPECT_EQ(places.take({{10.0, 10.0, 20.0, 8.0}, {50.0, 50.0, 20.0, 8.0}}).left, 10.0);
}

}  // namespace label_places_test
}  // namespace whirl_twin

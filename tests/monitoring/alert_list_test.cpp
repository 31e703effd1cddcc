// The list that is published: order, identity, and when it counts as changed.
#include "monitoring/alert_list.h"

#include <gtest/gtest.h>

#include <string>

namespace whirl_twin {
namespace alert_list_test {

state::Alert alertOf(const std::string& system, const std::string& type, state::Severity severity,
                     double time = 0.0) {
  state::Alert alert;
  alert.system = system;
  alert.type = type;
  alert.severity = severity;
  alert.time = time;
  return alert;
}

TEST(AlertList, TheMostSevereStandsFirstAndAmongEqualsTheOldest) {
  AlertList list;
  list.raise(alertOf("a", "X", state::Severity::kWarning, 1.0), "");
  list.raise(alertOf("b", "X", state::Severity::kDanger, 2.0), "");
  list.raise(alertOf("c", "X", state::Severity::kInfo, 3.0), "");
  list.raise(alertOf("d", "X", state::Severity::kWarning, 4.0), "");
  list.raise(alertOf("e", "X", state::Severity::kDanger, 5.0), "");
  std::string order;
  for (const state::Alert& alert : list.active()) {
    order += alert.system;
  }
  EXPECT_EQ(order, "beadc");
}

TEST(AlertList, AnUpgradeMovesAnAlertUp) {
  AlertList list;
  list.raise(alertOf("a", "X", state::Severity::kWarning), "");
  list.raise(alertOf("b", "X", state::Severity::kWarning), "");
  list.raise(alertOf("b", "X", state::Severity::kDanger), "");
  ASSERT_EQ(list.active().size(), 2u);
  EXPECT_EQ(list.active()[0].system, "b");
}

TEST(AlertList, AnAlertKeepsItsIdAndRaisedTimeAndTheNextOneCountsUp) {
  AlertList list;
  list.raise(alertOf("a", "X", state::Severity::kWarning, 1.0), "");
  list.raise(alertOf("a", "Y", state::Severity::kWarning, 1.5), "");
  list.raise(alertOf("a", "X", state::Severity::kWarning, 2.0), "");
  EXPECT_EQ(list.find("a", "X")->id, 1u);
  EXPECT_EQ(list.find("a", "X")->raised_time, 1.0);
  EXPECT_EQ(list.find("a", "X")->time, 2.0);
  EXPECT_EQ(list.find("a", "Y")->id, 2u);
  list.clear("a", "X", 3.0, "gone");
  EXPECT_EQ(list.find("a", "X"), nullptr);
  list.raise(alertOf("a", "X", state::Severity::kWarning, 4.0), "");
  EXPECT_EQ(list.find("a", "X")->id, 3u);
  EXPECT_EQ(list.find("a", "X")->raised_time, 4.0);
}

TEST(AlertList, IsChangedByWhatWasDecidedAndNotByEveryDigit) {
  AlertList list;
  EXPECT_FALSE(list.takeChanged());
  list.raise(alertOf("a", "X", state::Severity::kWarning), "critical 0");
  EXPECT_TRUE(list.takeChanged());
  EXPECT_FALSE(list.takeChanged());
  state::Alert faster = alertOf("a", "X", state::Severity::kWarning);
  faster.speed = 123.0;
  faster.text = "other digits";
  list.raise(faster, "critical 0");
  EXPECT_FALSE(list.takeChanged());
  EXPECT_EQ(list.find("a", "X")->speed, 123.0) << "the numbers are kept up to date all the same";
  list.raise(faster, "critical 1");
  EXPECT_TRUE(list.takeChanged());
  faster.severity = state::Severity::kDanger;
  list.raise(faster, "critical 1");
  EXPECT_TRUE(list.takeChanged());
  list.clear("a", "X", 1.0, "gone");
  EXPECT_TRUE(list.takeChanged());
  list.clear("a", "X", 2.0, "gone");
  EXPECT_FALSE(list.takeChanged()) << "nothing was there to clear";
}

TEST(AlertList, TellsEachEventOnceWithTheIdItBeganWith) {
  AlertList list;
  list.raise(alertOf("a", "X", state::Severity::kWarning, 1.0), "");
  list.raise(alertOf("a", "X", state::Severity::kWarning, 2.0), "");
  list.raise(alertOf("a", "X", state::Severity::kDanger, 3.0), "");
  list.clear("a", "X", 4.0, "gone");
  const std::vector<state::Alert> events = list.takeEvents();
  ASSERT_EQ(events.size(), 3u);
  EXPECT_TRUE(events[0].raised);
  EXPECT_EQ(events[0].severity, state::Severity::kWarning);
  EXPECT_TRUE(events[1].raised);
  EXPECT_EQ(events[1].severity, state::Severity::kDanger);
  EXPECT_FALSE(events[2].raised);
  EXPECT_EQ(events[2].time, 4.0);
  EXPECT_EQ(events[2].raised_time, 1.0);
  EXPECT_EQ(events[2].text, "gone");
  for (const state::Alert& event : events) {
    EXPECT_EQ(event.id, 1u);
  }
  EXPECT_TRUE(list.takeEvents().empty());
}

TEST(AlertList, LatchedStaysUntilResetAndIsTheSameAlertWhenItsCauseIsBack) {
  AlertList list(Latch::kDanger);
  list.raise(alertOf("a", "X", state::Severity::kDanger, 1.0), "");
  list.raise(alertOf("a", "Y", state::Severity::kWarning, 1.5), "");
  list.clear("a", "X", 2.0, "gone");
  list.clear("a", "Y", 2.0, "gone");
  ASSERT_EQ(list.active().size(), 1u) << "a warning does not latch here";
  EXPECT_TRUE(list.active()[0].latched);
  EXPECT_EQ(list.active()[0].text, "gone");
  list.acknowledge("", "");
  list.raise(alertOf("a", "X", state::Severity::kDanger, 3.0), "");
  EXPECT_FALSE(list.active()[0].latched);
  EXPECT_FALSE(list.active()[0].acknowledged) << "nobody has seen that it is back";
  EXPECT_EQ(list.active()[0].id, 1u);
  EXPECT_EQ(list.active()[0].repeats, 1u);
  EXPECT_EQ(list.reset(4.0), 0u) << "its cause is there";
  ASSERT_EQ(list.active().size(), 1u);
  EXPECT_TRUE(list.active()[0].acknowledged);
  list.clear("a", "X", 5.0, "gone");
  list.takeEvents();
  EXPECT_EQ(list.reset(6.0), 1u);
  EXPECT_TRUE(list.active().empty());
  const auto events = list.takeEvents();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_FALSE(events[0].raised);
  EXPECT_EQ(events[0].id, 1u);
}

// Who has seen an alert, and since when, is part of it wherever it is shown or kept.
TEST(AlertList, SaysWhoHasAcknowledgedAnAlertUntilItIsWorse) {
  constexpr const char* kSeen = "is (acknowledged by the desk since noon)";
  AlertList list(Latch::kDanger);
  const auto raise = [&](state::Severity severity) {
    state::Alert alert = alertOf("a", "X", severity);
    alert.text = "is";
    list.raise(alert, "");
  };
  raise(state::Severity::kWarning);
  list.acknowledge("a", "", "the desk since noon");
  EXPECT_EQ(list.active()[0].text, kSeen);
  raise(state::Severity::kWarning);
  EXPECT_EQ(list.active()[0].text, kSeen) << "brought up to date";
  AlertList restored;
  restored.restore(list.active(), 1, {});
  restored.raise(alertOf("a", "X", state::Severity::kWarning), "");
  EXPECT_NE(restored.active()[0].text.find("(acknowledged by the desk since noon)"),
            std::string::npos);
  raise(state::Severity::kDanger);
  EXPECT_EQ(list.active()[0].text, "is") << "nobody has seen that";
  list.reset(2.0, "the desk since noon");
  list.clear("a", "X", 3.0, "is");
  EXPECT_EQ(list.active()[0].text, kSeen) << "latched";
}

TEST(AlertList, WorseIsToBeAcknowledgedAgain) {
  AlertList list;
  list.raise(alertOf("a", "X", state::Severity::kWarning), "");
  list.raise(alertOf("b", "X", state::Severity::kWarning), "");
  list.takeEvents();
  EXPECT_EQ(list.acknowledge("a", "X"), 1u);
  EXPECT_EQ(list.acknowledge("a", ""), 0u);
  EXPECT_EQ(list.takeEvents().size(), 1u);
  EXPECT_TRUE(list.find("a", "X")->acknowledged);
  EXPECT_FALSE(list.find("b", "X")->acknowledged);
  list.raise(alertOf("a", "X", state::Severity::kDanger), "");
  EXPECT_FALSE(list.find("a", "X")->acknowledged);
}

TEST(AlertList, InhibitedNothingIsRaisedAndWhatIsThereStays) {
  AlertList list;
  list.raise(alertOf("a", "X", state::Severity::kWarning), "");
  list.setInhibited("a", true);
  list.raise(alertOf("a", "X", state::Severity::kDanger), "");
  list.raise(alertOf("a", "Y", state::Severity::kDanger), "");
  list.raise(alertOf("b", "Y", state::Severity::kDanger), "");
  EXPECT_EQ(list.find("a", "X")->severity, state::Severity::kDanger);
  EXPECT_EQ(list.find("a", "Y"), nullptr);
  EXPECT_NE(list.find("b", "Y"), nullptr);
  list.setInhibited("a", false);
  list.raise(alertOf("a", "Y", state::Severity::kDanger), "");
  EXPECT_NE(list.find("a", "Y"), nullptr) << "its cause is still there";
}

TEST(AlertList, TheFirstOfASystemIsFirstOutAndRepeatsCount) {
  AlertList list;
  list.raise(alertOf("a", "X", state::Severity::kWarning), "");
  list.raise(alertOf("a", "Y", state::Severity::kDanger), "");
  list.raise(alertOf("b", "Y", state::Severity::kDanger), "");
  EXPECT_TRUE(list.find("a", "X")->first_out);
  EXPECT_FALSE(list.find("a", "Y")->first_out);
  EXPECT_TRUE(list.find("b", "Y")->first_out);
  list.clear("a", "X", 1.0, "gone");
  EXPECT_FALSE(list.find("a", "Y")->first_out) << "it came second";
  list.raise(alertOf("a", "X", state::Severity::kWarning), "");
  EXPECT_FALSE(list.find("a", "X")->first_out);
  EXPECT_EQ(list.find("a", "X")->repeats, 1u);
  EXPECT_EQ(list.find("a", "Y")->repeats, 0u);
  list.clear("a", "X", 2.0, "gone");
  list.reset(3.0);
  list.raise(alertOf("a", "X", state::Severity::kWarning), "");
  EXPECT_EQ(list.find("a", "X")->repeats, 0u);
}

}  // namespace alert_list_test
}  // namespace whirl_twin

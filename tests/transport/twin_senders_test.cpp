// Duplicate publishers: two twins that alternate on the same channels are detected; a twin that
// replaces another is not one.
#include "transport/twin_senders.h"

#include <gtest/gtest.h>

namespace whirl_twin {
namespace twin_senders_test {

state::LoopStatistics beatOf(std::int64_t started, const std::string& sender) {
  state::LoopStatistics loop;
  loop.started = started;
  loop.sender = sender;
  return loop;
}

TwinSenders senders() {
  return {"the LCM channels TWIN_*", "end one"};
}

TEST(TwinSenders, TwoAreNamedWhileTheyTakeTurns) {
  TwinSenders heard = senders();
  for (int second = 0; second < 4; ++second) {
    heard.take(beatOf(1, "/first"), second);
    heard.take(beatOf(2, "/second"), second + 0.3);
  }
  EXPECT_EQ(heard.trouble(3.5), "2 twins on the LCM channels TWIN_*: /first and /second; end one");
  for (int second = 4; second < 9; ++second) {
    heard.take(beatOf(1, "/first"), second);
  }
  EXPECT_EQ(heard.trouble(9.0), "") << "the second is gone";
}

TEST(TwinSenders, SilenceOfAllIsNoTrouble) {
  TwinSenders heard = senders();
  for (int second = 0; second < 4; ++second) {
    heard.take(beatOf(1, "/first"), second);
    heard.take(beatOf(2, "/second"), second);
  }
  EXPECT_EQ(heard.trouble(20.0), "");
}

TEST(TwinSenders, ALogOfTheSameNodeIsAnother) {
  TwinSenders heard = senders();
  for (int second = 0; second < 4; ++second) {
    heard.take(beatOf(1000, "/simulation_node"), second);
    heard.take(beatOf(1, ""), second + 0.5);
  }
  EXPECT_EQ(heard.trouble(3.5).find("2 twins"), 0u) << heard.trouble(3.5);
  EXPECT_NE(heard.trouble(3.5).find("without a name"), std::string::npos);
}

TEST(TwinSenders, OneThatIsStartedAgainIsOne) {
  TwinSenders heard = senders();
  heard.take(beatOf(1, "/twin"), 0.0);
  heard.take(beatOf(1, "/twin"), 1.0);
  heard.take(beatOf(2, "/twin"), 1.5);
  heard.take(beatOf(1, "/twin"), 2.0);  // its last, while it ends
  for (int second = 2; second < 8; ++second) {
    heard.take(beatOf(2, "/twin"), second + 0.5);
    EXPECT_EQ(heard.trouble(second + 0.5), "") << second;
  }
}

TEST(TwinSenders, MessagesOfBeforeRunsWereToldApartAreLeft) {
  TwinSenders heard = senders();
  for (int second = 0; second < 4; ++second) {
    heard.take(beatOf(0, ""), second);
    heard.take(beatOf(2, "/second"), second + 0.3);
  }
  EXPECT_EQ(heard.trouble(3.5), "");
}

}  // namespace twin_senders_test
}  // namespace whirl_twin

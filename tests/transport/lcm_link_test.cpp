// Publisher and receiver connected by memq://, LCM's link within a process: without a network.
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <lcm/lcm-cpp.hpp>
#include <memory>

#include "event_log_sample.h"
#include "state_samples.h"
#include "transport/lcm_connection.h"
#include "transport/lcm_publisher.h"
#include "transport/lcm_receiver.h"
#include "transport/lcm_recorder.h"

namespace whirl_twin {
namespace lcm_link_test {

constexpr std::chrono::milliseconds kNow{0};

class LcmLink : public testing::Test {
 protected:
  LcmReceiver receiverOf(const Kinds& kinds, const std::string& prefix = kDefaultLcmPrefix) {
    return {lcm_, kinds, [this](const Message& message) { arrived_.push_back(message); }, prefix};
  }

  std::shared_ptr<lcm::LCM> lcm_ = openLcm("memq://");
  LcmPublisher publisher_{lcm_};
  std::vector<Message> arrived_;
};

TEST_F(LcmLink, CarriesEveryKindInOrder) {
  auto receiver = receiverOf(allKinds());
  StateSamples samples(1);
  std::vector<std::string> sent;
  samples.each([&](const auto& state) {
    publisher_.publish(state);
    sent.push_back(bitsOf(state));
  });
  EXPECT_EQ(receiver.receive(kNow), static_cast<int>(sent.size()));
  std::vector<std::string> arrived;
  for (const Message& message : arrived_) {
    arrived.push_back(std::visit([](const auto& state) { return bitsOf(state); }, message));
  }
  EXPECT_EQ(arrived, sent);
  EXPECT_EQ(publisher_.sent(), sent.size());
  EXPECT_EQ(publisher_.failed(), 0u);
  EXPECT_EQ(receiver.received(), sent.size());
  EXPECT_EQ(receiver.lost() + receiver.rejected(), 0u);
}

// Whatever the routing table, now or later (liblcm itself uses it).
TEST_F(LcmLink, WithATtlOf0MulticastIsSentByTheLoopbackInterface) {
  std::shared_ptr<lcm::LCM> multicast;
  try {
    multicast = openLcm("udpm://239.255.76.67:7667?ttl=0");
  } catch (const LcmNotAvailable&) {
    GTEST_SKIP() << "no route for multicast";
  }
  int senders = 0;
  for (int socket = 3; socket < 256; ++socket) {
    unsigned char ttl = 1;
    in_addr interface {};
    socklen_t size = sizeof ttl;
    int type = 0;
    socklen_t type_size = sizeof type;
    socklen_t interface_size = sizeof interface;
    if (::getsockopt(socket, SOL_SOCKET, SO_TYPE, &type, &type_size) == 0 && type == SOCK_DGRAM &&
        ::getsockopt(socket, IPPROTO_IP, IP_MULTICAST_TTL, &ttl, &size) == 0 && ttl == 0) {
      ASSERT_EQ(::getsockopt(socket, IPPROTO_IP, IP_MULTICAST_IF, &interface, &interface_size), 0);
      EXPECT_EQ(interface.s_addr, htonl(INADDR_LOOPBACK));
      ++senders;
    }
  }
  EXPECT_GE(senders, 1);
}

TEST_F(LcmLink, TwinsWithOtherPrefixesDoNotHearEachOther) {
  LcmPublisher machine(lcm_, "MACHINE_");
  auto of_machine = receiverOf(allKinds(), "MACHINE_");
  const LcmReceiver of_twin = receiverOf(allKinds());
  machine.publish(whirlAt(1));
  machine.publish(alertAt(1));
  publisher_.publish(whirlAt(2));
  of_machine.receive(kNow);  // dispatches to all subscribers of this LCM
  EXPECT_EQ(of_machine.received(), 2u);
  EXPECT_EQ(of_machine.channels().count("MACHINE_ROTOR_WHIRL"), 1u);
  EXPECT_EQ(of_twin.received(), 1u);
  EXPECT_EQ(of_machine.rejected() + of_twin.rejected(), 0u);
}

TEST_F(LcmLink, KeepsAllOfALongQueue) {
  // liblcm queues 30 messages of a subscription by default.
  auto receiver = receiverOf(kindsOf<state::WhirlState>());
  state::WhirlState whirl;
  whirl.system = "rotor";
  for (int step = 0; step < 5000; ++step) {
    whirl.at = {step, step * 1e-3, 0};
    publisher_.publish(whirl);
  }
  int handled = 0;
  while (handled < 5000) {
    const int more = receiver.receive(kNow);
    ASSERT_GT(more, 0);
    handled += more;
  }
  ASSERT_EQ(arrived_.size(), 5000u);
  for (int step = 0; step < 5000; ++step) {
    EXPECT_EQ(std::get<state::WhirlState>(arrived_[step]).at.step, step);
  }
  EXPECT_EQ(receiver.lost(), 0u);
}

TEST_F(LcmLink, TakesOnlyTheWantedKinds) {
  auto receiver = receiverOf(kindsOf<state::DriveState, state::PendulumState>());
  StateSamples samples(2);
  publisher_.publish(samples.whirl());
  publisher_.publish(samples.drive());
  publisher_.publish(samples.alert());
  receiver.receive(kNow);
  ASSERT_EQ(arrived_.size(), 1u);
  EXPECT_TRUE(std::holds_alternative<state::DriveState>(arrived_[0]));
}

TEST_F(LcmLink, CountsWhatWasLostAndWhatIsRejected) {
  auto receiver = receiverOf(kindsOf<state::WhirlState>());
  state::WhirlState whirl;
  whirl.system = "rotor";
  for (const int step : {0, 1, 2, 6, 7}) {
    whirl.at = {step, step * 1e-3, 0};
    publisher_.publish(whirl);
  }
  const char garbage[] = "no state";
  lcm_->publish("TWIN_ROTOR_WHIRL", garbage, sizeof(garbage));
  lcm_->publish("TWIN_ROTOR_WHIRL", garbage, 0);
  receiver.receive(kNow);
  EXPECT_EQ(receiver.received(), 5u);
  EXPECT_EQ(receiver.lost(), 3u);
  EXPECT_EQ(receiver.rejected(), 2u);
  EXPECT_EQ(arrived_.size(), 5u);
  EXPECT_EQ(receiver.refused().last().find("TWIN_ROTOR_WHIRL: "), 0u) << receiver.refused().last();
}

TEST_F(LcmLink, RecordsEveryEventOfTheWantedChannels) {
  const TemporaryLog log;
  {
    LcmRecorder recorder(lcm_, "TWIN_.*", log.path());
    for (int step = 0; step < 2000; ++step) {
      publisher_.publish(whirlAt(step));
      publisher_.publish(driveAt(step));
    }
    const char other[] = "not the twin's";
    lcm_->publish("CAMERA", other, sizeof(other));
    recorder.record(kNow, 10000);
    EXPECT_EQ(recorder.recorded(), 4000u);
    // Recorded data are in the file even if the recorder is not closed properly.
    EXPECT_EQ(readEventLog(log.path()).events, 4000u);
  }
  const auto summary = readEventLog(log.path());
  EXPECT_TRUE(summary.intact() && summary.continuous());
  EXPECT_EQ(summary.channels.size(), 2u);
}

TEST_F(LcmLink, ARecorderNoticesAFullDisk) {
  LcmRecorder recorder(lcm_, "TWIN_.*", "/dev/full");
  publisher_.publish(whirlAt(0));
  EXPECT_THROW(recorder.record(kNow), std::runtime_error);
}

TEST_F(LcmLink, ARecorderSaysWhichFileCannotBeWritten) {
  EXPECT_THROW(LcmRecorder(lcm_, "TWIN_.*", "/tmp/whirl_twin_no_such_directory/run.lcmlog"),
               std::runtime_error);
}

TEST(LcmPublisher, IsOffWithoutAUrl) {
  LcmPublisher publisher("");
  EXPECT_FALSE(publisher.on());
  EXPECT_EQ(publisher.warning(), "");
  publisher.publish(state::DriveState{});
  EXPECT_EQ(publisher.sent() + publisher.failed(), 0u);
}

TEST(LcmPublisher, StaysOffAndSaysWhyIfLcmDoesNotOpen) {
  LcmPublisher publisher("no_such_link://");
  EXPECT_FALSE(publisher.on());
  EXPECT_NE(publisher.warning().find("'no_such_link://'"), std::string::npos);
  EXPECT_NE(publisher.warning().find("nothing is sent on LCM"), std::string::npos);
  publisher.publish(state::WhirlState{});
  EXPECT_EQ(publisher.sent() + publisher.failed(), 0u);
}

}  // namespace lcm_link_test
}  // namespace whirl_twin

#include "transport/lcm_event_log.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <lcm/lcm-cpp.hpp>
#include <stdexcept>

#include "event_log_sample.h"
#include "state_samples.h"
#include "transport/file_window.h"
#include "transport/lcm_decode.h"

namespace whirl_twin {
namespace lcm_event_log_test {

const ChannelSummary& channelIn(const LogSummary& summary, const std::string& name) {
  for (const auto& channel : summary.channels) {
    if (channel.channel == name) {
      return channel;
    }
  }
  throw std::out_of_range(name);
}

TEST(EventLog, OfAWholeRunIsIntactAndContinuous) {
  const auto bytes = sampleLog(100);
  const auto summary = summaryOf(bytes);
  EXPECT_TRUE(summary.intact());
  EXPECT_TRUE(summary.continuous());
  EXPECT_EQ(summary.size, bytes.size());
  EXPECT_EQ(summary.events, 302u);
  EXPECT_EQ(summary.first_timestamp, 0);
  EXPECT_EQ(summary.last_timestamp, 99000);
  ASSERT_EQ(summary.channels.size(), 5u);
  const auto& whirl = channelIn(summary, "TWIN_ROTOR_WHIRL");
  EXPECT_EQ(whirl.kind, "whirl");
  EXPECT_EQ(whirl.events, 100u);
  EXPECT_EQ(whirl.stride, 1);
  EXPECT_EQ(whirl.first_time, 0.0);
  EXPECT_EQ(whirl.last_time, 0.099);
  const auto& alerts = channelIn(summary, "TWIN_ALERTS");
  EXPECT_EQ(alerts.events, 1u);
  EXPECT_EQ(alerts.first_time, 1e-3);
  EXPECT_EQ(channelIn(summary, "TWIN_ROTOR_STABILITY").kind, "stability");
}

TEST(EventLog, OfTheSameStatesHasTheSameBytes) {
  EXPECT_EQ(sampleLog(20), sampleLog(20));
}

TEST(EventLog, CanBeReadByLcmItself) {
  const TemporaryLog log;
  log.write(sampleLog(3));
  lcm::LogFile reader(log.path(), "r");
  ASSERT_TRUE(reader.good());
  int events = 0;
  while (const lcm::LogEvent* event = reader.readNextEvent()) {
    EXPECT_EQ(event->eventnum, events++);
    const auto state =
        decodeEvent(event->channel, event->data, static_cast<std::size_t>(event->datalen));
    if (const auto* whirl = std::get_if<state::WhirlState>(&state)) {
      EXPECT_EQ(bitsOf(*whirl), bitsOf(whirlAt(whirl->at.step)));
      EXPECT_EQ(event->timestamp, whirl->at.step * 1000);
    }
  }
  EXPECT_EQ(events, 11);
}

TEST(EventLog, SaysWhereStatesAreMissing) {
  const TemporaryLog log;
  EventLogWriter writer(log.path());
  for (const std::int64_t step : {0, 1, 2, 5, 6, 6, 7}) {
    writer.write(whirlAt(step));
    writer.write(driveAt(10 * step));
  }
  writer.finish();
  const auto summary = readEventLog(log.path());
  EXPECT_TRUE(summary.intact());  // nothing is corrupt, but
  EXPECT_FALSE(summary.continuous());
  const auto& whirl = channelIn(summary, "TWIN_ROTOR_WHIRL");
  EXPECT_EQ(whirl.gaps, 1u);
  EXPECT_EQ(whirl.lost, 2u);
  EXPECT_EQ(whirl.repeated, 1u);
  EXPECT_EQ(channelIn(summary, "TWIN_SHAFT_DRIVE").stride, 10);
}

TEST(EventLog, HoldsChangesOfParametersWhichComeWhenThereAreSome) {
  const TemporaryLog log;
  EventLogWriter writer(log.path());
  state::ParameterChange change;
  change.system = "rotor";
  change.names = {"mass", "damping"};
  change.values = {1.0, 2.0};
  writer.write(change);
  writer.write(whirlAt(0));
  change.at = {7, 0.007, 0};
  change.changed = {"damping"};
  change.previous = {2.0};
  change.values[1] = 3.0;
  writer.write(change);
  writer.finish();
  const auto summary = readEventLog(log.path());
  EXPECT_TRUE(summary.intact());
  EXPECT_TRUE(summary.continuous());
  const auto& changes = channelIn(summary, "TWIN_ROTOR_PARAMETER");
  EXPECT_EQ(changes.kind, "parameter");
  EXPECT_EQ(changes.events, 2u);
  EXPECT_EQ(changes.last_time, 0.007);
}

TEST(EventLog, SaysWhereStatesOfAMotorAreMissing) {
  const TemporaryLog log;
  EventLogWriter writer(log.path());
  state::MotorState motor;
  motor.drive = "shaft";
  motor.system = "rotor";
  for (const std::int64_t step : {0, 1, 2, 4}) {
    motor.at = {step, static_cast<double>(step) * 1.0e-3, 0};
    writer.write(motor);
  }
  writer.finish();
  const auto summary = readEventLog(log.path());
  EXPECT_TRUE(summary.intact());
  EXPECT_EQ(channelIn(summary, "TWIN_SHAFT_MOTOR").kind, "motor");
  EXPECT_EQ(channelIn(summary, "TWIN_SHAFT_MOTOR").gaps, 1u);
}

TEST(EventLog, HoldsStatisticsOfAnEnsembleOfWhichSomeMayBeLeftOut) {
  const TemporaryLog log;
  EventLogWriter writer(log.path());
  auto ensemble = StateSamples(1).ensemble();
  ensemble.system = "rotor";
  for (const std::int64_t step : {0, 20, 60, 80}) {
    ensemble.at = {step, static_cast<double>(step) * 1.0e-3, 0};
    writer.write(ensemble);
  }
  ++ensemble.count;  // another ensemble
  writer.write(ensemble);
  writer.finish();
  const auto summary = readEventLog(log.path());
  EXPECT_TRUE(summary.continuous());
  EXPECT_EQ(summary.defect_count, 1u);
  const auto& channel = channelIn(summary, "TWIN_ROTOR_ENSEMBLE");
  EXPECT_EQ(channel.kind, "ensemble");
  EXPECT_EQ(channel.events, 4u);
  EXPECT_EQ(channel.rejected, 1u);
  EXPECT_EQ(channel.last_time, 0.08);
}

TEST(EventLog, CountsBlocksOfMeasurementsThatAreMissing) {
  const TemporaryLog log;
  EventLogWriter writer(log.path());
  auto block = StateSamples(2).measurement();
  block.source = "sensors";
  for (const std::int64_t number : {0, 1, 2, 5}) {
    block.at = {number, static_cast<double>(number) * 0.1, 0};
    writer.write(block);
  }
  writer.finish();
  const auto summary = readEventLog(log.path());
  EXPECT_TRUE(summary.intact());
  const auto& channel = channelIn(summary, "TWIN_SENSORS_MEASUREMENT");
  EXPECT_EQ(channel.kind, "measurement");
  EXPECT_EQ(channel.events, 4u);
  EXPECT_EQ(channel.lost, 2u);
}

TEST(EventLog, MayHoldOtherChannels) {
  const TemporaryLog log;
  {
    lcm::LogFile file(log.path(), "w");
    char data[] = "anything";
    lcm::LogEvent event{0, 1500000000000000, "CAMERA", sizeof(data), data};
    ASSERT_EQ(file.writeEvent(&event), 0);
  }
  const auto summary = readEventLog(log.path());
  EXPECT_TRUE(summary.intact());
  ASSERT_EQ(summary.channels.size(), 1u);
  EXPECT_EQ(summary.channels[0].kind, "other");
  EXPECT_EQ(summary.channels[0].bytes, 9u);
  EXPECT_TRUE(std::isnan(summary.channels[0].first_time));
}

TEST(EventLog, RejectsPayloadsThatAreNoStatesOfTheirChannel) {
  const TemporaryLog log;
  {
    lcm::LogFile file(log.path(), "w");
    char data[] = "anything";
    lcm::LogEvent event{0, 0, "TWIN_ROTOR_WHIRL", sizeof(data), data};
    ASSERT_EQ(file.writeEvent(&event), 0);
  }
  const auto summary = readEventLog(log.path());
  EXPECT_FALSE(summary.intact());
  EXPECT_EQ(summary.events, 0u);
  EXPECT_EQ(summary.channels.at(0).rejected, 1u);
  ASSERT_EQ(summary.defects.size(), 1u);
  EXPECT_EQ(summary.defects[0].offset, 0u);
  EXPECT_NE(summary.defects[0].what.find("whirl_state_t"), std::string::npos);
}

TEST(EventLog, LongerThanTheReadersWindowIsReadWhole) {
  const auto bytes = sampleLog(9000);
  ASSERT_GT(bytes.size(), 2 * FileWindow::kMaxLength);
  const auto summary = summaryOf(bytes);
  EXPECT_TRUE(summary.intact() && summary.continuous());
  EXPECT_EQ(summary.events, 27002u);
}

TEST(EventLog, IsNotIntactWhenEmpty) {
  const auto summary = summaryOf({});
  EXPECT_FALSE(summary.intact());
  EXPECT_EQ(summary.events, 0u);
}

TEST(EventLog, MustBeAFileThatCanBeRead) {
  EXPECT_THROW(readEventLog("/tmp/whirl_twin_no_such_file.lcmlog"), std::runtime_error);
  EXPECT_THROW(readEventLog("/tmp"), std::runtime_error);
  EXPECT_THROW(readEventLog("/dev/zero"), std::runtime_error);
  const TemporaryLog pipe;  // opening a pipe without a writer must not wait
  ASSERT_EQ(::mkfifo(pipe.path().c_str(), 0600), 0);
  EXPECT_THROW(readEventLog(pipe.path()), std::runtime_error);
}

TEST(EventLogWriter, SaysWhichFileCannotBeWritten) {
  try {
    EventLogWriter writer("/tmp/whirl_twin_no_such_directory/run.lcmlog");
    FAIL() << "opened a file in a directory that does not exist";
  } catch (const std::runtime_error& problem) {
    EXPECT_EQ(std::string(problem.what()),
              "/tmp/whirl_twin_no_such_directory/run.lcmlog: cannot be written: No such file or "
              "directory");
  }
}

TEST(EventLogWriter, NoticesAFullDisk) {
  EventLogWriter writer("/dev/full");
  EXPECT_THROW(
      {
        for (int step = 0; step < 1000; ++step) {
          writer.write(whirlAt(step));
        }
        writer.finish();
      },
      std::runtime_error);
}

}  // namespace lcm_event_log_test
}  // namespace whirl_twin

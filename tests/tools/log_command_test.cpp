// `twin log`: the contents of an LCM log, and its defects.
#include <gtest/gtest.h>

#include "twin_program.h"

namespace whirl_twin {
namespace log_command_test {

using Json = nlohmann::json;

/// A second of the demo, a state every step.
class DemoLog : public testing::Test {
 protected:
  DemoLog() {
    const Ending end = twin({"simulate", kDemo, "--duration", "1", "--output", path_});
    EXPECT_EQ(end.status, 0) << end.err;
  }
  const TemporaryDirectory directory_;
  const std::string path_ = directory_.file("demo.lcmlog");
};

TEST_F(DemoLog, IsCompleteAndIntact) {
  const Ending end = twin({"log", path_, "--json"});
  ASSERT_EQ(end.status, 0) << end.err;
  const Json log = end.json();
  EXPECT_EQ(log["events"], 3 * 1001 + 20 + 2 + 1);
  EXPECT_DOUBLE_EQ(log["span"], 1.0);
  EXPECT_EQ(log["corrupt"], 0);
  EXPECT_EQ(log["continuous"], true);
  EXPECT_EQ(log["channels"].size(), 7u);
  for (const char* channel : {"TWIN_ROTOR_WHIRL", "TWIN_PENDULUM_PENDULUM", "TWIN_SHAFT_DRIVE"}) {
    const Json& c = log["channels"][channel];
    EXPECT_EQ(c["events"], 1001) << channel;
    EXPECT_EQ(c["first_time"], 0.0);
    EXPECT_EQ(c["last_time"], 1.0);
    EXPECT_EQ(c["stride"], 1);
    EXPECT_EQ(c["gaps"], 0);
  }
  // At the start; parameters again every 10 s.
  for (const char* channel : {"TWIN_ROTOR_PARAMETER", "TWIN_PENDULUM_PARAMETER", "TWIN_SCENE"}) {
    EXPECT_EQ(log["channels"][channel]["events"], 1) << channel;
  }
  EXPECT_EQ(directory_.files(), std::vector<std::string>{"demo.lcmlog"});
}

/// Parameters are published again with the instant of their change, long ago; the log goes forward.
TEST(Log, LongerThanParametersAreToldOnceForIsIntact) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("long.lcmlog");
  ASSERT_EQ(
      twin({"simulate", kDemo, "--duration", "21", "--sample", "0.1", "--output", path}).status, 0);
  const Ending end = twin({"log", path, "--json"});
  ASSERT_EQ(end.status, 0) << end.err << end.out;
  const Json log = end.json();
  EXPECT_EQ(log["corrupt"], 0);
  EXPECT_DOUBLE_EQ(log["span"], 21.0);
  EXPECT_EQ(log["channels"]["TWIN_ROTOR_PARAMETER"]["events"], 3);
}

TEST_F(DemoLog, IsTheSameBytesEachTime) {
  const std::string again = directory_.file("again.lcmlog");
  twin({"simulate", kDemo, "--duration", "1", "--output", again});
  EXPECT_EQ(contentsOf(path_), contentsOf(again));
}

TEST_F(DemoLog, OfOneSystemHoldsItAndItsDrive) {
  const std::string one = directory_.file("one.lcmlog");
  twin({"simulate", kDemo, "--duration", "1", "--sample", "0.01", "--system", "rotor", "--output",
        one});
  const Json log = twin({"log", one, "--json"}).json();
  EXPECT_EQ(log["channels"].size(), 5u);
  EXPECT_EQ(log["channels"]["TWIN_ROTOR_WHIRL"]["events"], 101);
  EXPECT_EQ(log["channels"]["TWIN_ROTOR_WHIRL"]["stride"], 10);
  EXPECT_TRUE(log["channels"].contains("TWIN_SHAFT_DRIVE"));
}

TEST_F(DemoLog, OfATwinWithAnotherPrefixIsToldByIt) {
  std::string bytes = contentsOf(path_);
  for (std::size_t at = bytes.find("TWIN_"); at != std::string::npos;
       at = bytes.find("TWIN_", at)) {
    bytes.replace(at, 5, "UNIT_");
  }
  const std::string renamed = directory_.write("unit.lcmlog", bytes);
  EXPECT_EQ(twin({"log", renamed}).status, 2) << "the messages of a twin on channels of another";
  const Ending end = twin({"log", renamed, "--lcm-prefix", "UNIT_", "--json"});
  EXPECT_EQ(end.status, 0) << end.err;
  EXPECT_EQ(end.json()["channels"]["UNIT_ROTOR_WHIRL"]["kind"], "whirl");
  EXPECT_EQ(twin({"log", renamed, "--lcm-prefix", "UN.*"}).status, 2);
}

TEST_F(DemoLog, DamageIsFoundAndToldByTheExitStatus) {
  std::string bytes = contentsOf(path_);
  bytes.resize(bytes.size() - 10);
  // Longer than an event: the header of at least one is lost.
  for (std::size_t i = 0; i < 250; ++i) {
    bytes[bytes.size() / 2 + i] = 'x';
  }
  const std::string damaged = directory_.write("damaged.lcmlog", bytes);
  const Ending end = twin({"log", damaged, "--json"});
  EXPECT_EQ(end.status, 1);
  const Json log = end.json();
  EXPECT_GE(log["corrupt"], 2);
  EXPECT_EQ(log["truncated"], true);
  EXPECT_FALSE(log["defects"].empty());
  EXPECT_GE(log["events"], 3 * 1001 - 10);
  const Ending report = twin({"log", damaged});
  EXPECT_EQ(report.status, 1);
  EXPECT_NE(report.out.find("corrupt"), std::string::npos);
  EXPECT_NE(report.out.find("at byte "), std::string::npos);
}

TEST_F(DemoLog, ReportForReaders) {
  const Ending end = twin({"log", path_});
  EXPECT_EQ(end.status, 0);
  EXPECT_EQ(linesOf(end.out).front().find(path_ + ": 3026 events in 1 s"), 0u) << end.out;
  EXPECT_NE(end.out.find("TWIN_ROTOR_WHIRL"), std::string::npos);
  EXPECT_NE(end.out.find("no corrupt events"), std::string::npos);
}

TEST(Log, RefusesWhatIsNoLog) {
  const TemporaryDirectory directory;
  for (const std::string& path :
       {directory.file("none.lcmlog"), directory.file(""), directory.write("empty.lcmlog", ""),
        directory.write("text.lcmlog", "this is no log\n")}) {
    const Ending end = twin({"log", path});
    EXPECT_EQ(end.status, 2) << path;
    EXPECT_EQ(end.out, "");
    EXPECT_EQ(end.err.find("twin: " + path), 0u) << end.err;
  }
}

}  // namespace log_command_test
}  // namespace whirl_twin

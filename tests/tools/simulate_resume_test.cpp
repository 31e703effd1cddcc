// `twin simulate --checkpoint` and `--resume`: the remainder of a run is byte-identical to that of
// an uninterrupted one; an unsuitable checkpoint is rejected.
#include <gtest/gtest.h>

#include <fstream>

#include "twin_program.h"

namespace whirl_twin {
namespace simulate_resume_test {

Lines rest(const Lines& all, std::size_t from) {
  return Lines(all.begin() + static_cast<std::ptrdiff_t>(from), all.end());
}

TEST(Resume, TheRestOfARunIsThatOfOneThatWasNeverBrokenOff) {
  TemporaryDirectory files;
  const std::string checkpoint = files.file("run.checkpoint");
  for (const char* sample : {"0.001", "0.05"}) {
    const Ending whole = twin({"simulate", kDemo, "--duration", "6", "--sample", sample});
    ASSERT_EQ(whole.status, 0) << whole.err;
    ASSERT_EQ(
        twin({"simulate", kDemo, "--duration", "4", "--sample", sample, "--checkpoint", checkpoint})
            .status,
        0);
    const Ending resumed =
        twin({"simulate", kDemo, "--duration", "6", "--sample", sample, "--resume", checkpoint});
    ASSERT_EQ(resumed.status, 0) << resumed.err;
    const Lines all = linesOf(whole.out);
    const Lines found = linesOf(resumed.out);
    ASSERT_LT(found.size(), all.size());
    EXPECT_EQ(found.front(), all.front());
    EXPECT_EQ(rest(found, 1), rest(all, all.size() - found.size() + 1));
  }
}

TEST(Resume, RefusesWhatItCannotGoOnFrom) {
  TemporaryDirectory files;
  const std::string checkpoint = files.file("run.checkpoint");
  ASSERT_EQ(
      twin({"simulate", kDemo, "--duration", "1", "--checkpoint", checkpoint, "--json"}).status, 0);
  const auto whyNot = [&](std::vector<std::string> options) {
    std::vector<std::string> arguments{"simulate", kDemo, "--resume", checkpoint};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Ending end = twin(arguments);
    EXPECT_EQ(end.status, 2);
    EXPECT_EQ(end.out, "");
    return end.err;
  };
  EXPECT_EQ(whyNot({"--duration", "1"}), "twin: --duration: must be more than the 1000 steps of " +
                                             checkpoint + ", found 1000 steps\n");
  EXPECT_EQ(whyNot({"--step", "0.002"})
                .find("twin: " + checkpoint +
                      ": must be saved from the same scene\n"
                      "  step: expected 2000000 ns, found 1000000 ns\n"),
            0U);
  const std::string bytes = contentsOf(checkpoint);
  std::ofstream(checkpoint, std::ios::binary) << bytes.substr(0, bytes.size() - 20);
  EXPECT_NE(whyNot({}).find("run.checkpoint: truncated: must have "), std::string::npos);
}

}  // namespace simulate_resume_test
}  // namespace whirl_twin

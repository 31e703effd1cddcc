#include "twin/durable_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "messages/input_error.h"

namespace whirl_twin {
namespace durable_file_test {

class DurableFileTest : public testing::Test {
 protected:
  DurableFileTest() {
    std::string name = (std::filesystem::temp_directory_path() / "durable_XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
    path_ = folder_ + "/file";
  }
  ~DurableFileTest() override { std::filesystem::remove_all(folder_); }
  std::string contents() const {
    std::ifstream file(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }
  std::size_t files() const {
    const auto all = std::filesystem::directory_iterator(folder_);
    return static_cast<std::size_t>(std::distance(begin(all), end(all)));
  }

  std::string folder_;
  std::string path_;
};

TEST_F(DurableFileTest, IsThereWhenItIsWholeAndLeavesNothingElse) {
  const std::string text(3000000, 'x');  // more than its buffer
  {
    DurableFile dropped(path_);
    dropped.add(text);
  }
  EXPECT_EQ(files(), 0U);
  {
    DurableFile file(path_);
    file.add(text);
    EXPECT_FALSE(std::filesystem::exists(path_));
    file.finish();
  }
  EXPECT_EQ(contents(), text);
  EXPECT_EQ(files(), 1U);
}

// Of two writers of the same file.
TEST_F(DurableFileTest, TheFirstStaysWhereThatIsAskedFor) {
  {
    DurableFile first(path_);
    first.add("first");
    EXPECT_TRUE(first.finishUnlessThere());
  }
  {
    DurableFile second(path_);
    second.add("second");
    EXPECT_FALSE(second.finishUnlessThere());
  }
  EXPECT_EQ(contents(), "first");
  EXPECT_EQ(files(), 1U);
  DurableFile third(path_);
  third.add("third");
  third.finish();
  EXPECT_EQ(contents(), "third");
}

TEST_F(DurableFileTest, SaysWhyItCannotBeWritten) {
  try {
    DurableFile file(folder_ + "/none/file");
    FAIL();
  } catch (const RunFailure& error) {
    EXPECT_EQ(error.what(), folder_ + "/none/file: cannot be written: No such file or directory; " +
                                "the previous file is kept");
  }
}

}  // namespace durable_file_test
}  // namespace whirl_twin

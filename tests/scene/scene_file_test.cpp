// A file that is not a scene, not YAML, or missing is reported like any other error.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "scenes.h"

namespace whirl_twin {
namespace scene_file_test {

class SceneFile : public testing::Test {
 protected:
  SceneFile()
      : directory_(std::filesystem::temp_directory_path() /
                   ("whirl_twin_scene_" + std::to_string(getpid()))) {
    std::filesystem::create_directory(directory_);
  }
  ~SceneFile() override { std::filesystem::remove_all(directory_); }

  std::string path() const { return (directory_ / "scene.yaml").string(); }
  /// The error text for a file with this content, without its path.
  std::string complaint(const std::string& content) const {
    std::ofstream(path(), std::ios::binary) << content;
    return complaintOf(path());
  }
  static std::string complaintOf(const std::string& path) {
    try {
      readSceneFile(path);
    } catch (const SceneError& error) {
      const std::string what = error.what();
      EXPECT_EQ(what.compare(0, path.size() + 2, path + ": "), 0) << what;
      return what.substr(path.size() + 2);
    }
    return "";
  }

  std::filesystem::path directory_;
};

TEST_F(SceneFile, IsRead) {
  EXPECT_EQ(complaint(kThreeSystems), "");
  EXPECT_EQ(readSceneFile(path()).source, path());
  EXPECT_EQ(complaint("\xEF\xBB\xBF" + std::string(kThreeSystems)), "") << "with a byte order mark";
}

// 10 levels of 9 aliases each are 9^10 entries; what names itself has no end.
TEST_F(SceneFile, BeyondItsBoundsIsRefusedBeforeAnythingIsMadeOfIt) {
  std::string laughs = "a0: &a0 [x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 10; ++i) {
    laughs += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [";
    for (int k = 0; k < 9; ++k) {
      laughs += (k == 0 ? "*a" : ", *a") + std::to_string(i - 1);
    }
    laughs += "]\n";
  }
  EXPECT_NE(complaint(laughs).find("aliases expand to more than 100000 entries"), std::string::npos)
      << complaint(laughs);
  EXPECT_NE(complaint("step: &a [*a]\n").find("an alias refers to a node that contains it"),
            std::string::npos);
  const std::string deep = "step: " + std::string(65, '[') + std::string(65, ']');
  EXPECT_NE(complaint(deep).find("nested more than 64 deep"), std::string::npos) << complaint(deep);
  const std::string flat = "step: [" + std::string(2'000'000, ',') + "]";
  EXPECT_NE(complaint(flat).find("not YAML"), std::string::npos) << complaint(flat);
  EXPECT_NE(complaint("step: " + std::string(1'000'000, '[')).find("nested more than 64 deep"),
            std::string::npos);
  std::string shared =
      "step: 0.001\nsystems:\n  a: {model: pendulum, parameters: &p {mass: 1, length: 1}}\n";
  for (int i = 0; i < 100; ++i) {
    shared += "  b" + std::to_string(i) + ": {model: pendulum, parameters: *p}\n";
  }
  EXPECT_EQ(complaint(shared), "");
}

TEST_F(SceneFile, ThatIsNotOneIsRefused) {
  EXPECT_EQ(complaintOf(path()), "no such file");
  EXPECT_EQ(complaintOf(directory_.string()), "not a file");
  EXPECT_EQ(complaint(""), "empty: a scene has a step and at least one system");
  EXPECT_EQ(complaint("# nothing but a comment\n"),
            "empty: a scene has a step and at least one system");
  EXPECT_EQ(complaint(std::string("\x7f"
                                  "ELF\0\1\2",
                                  7)),
            "a binary file, not a scene in YAML");
  EXPECT_EQ(complaint(std::string(5 << 20, ' ')), "larger than 4 MiB, the limit of a scene");
  EXPECT_EQ(complaint("only words"), "must be a map of keys and values, found 'only words'");
}

TEST_F(SceneFile, ThatIsNotYamlIsRefusedWithLineAndColumn) {
  EXPECT_EQ(complaint("step: 0.001\nsystems: [1, 2\n").substr(0, 25), "line 3, column 1: not YAM");
  EXPECT_EQ(complaint("step: 0.001\n\tsystems: {}\n").substr(0, 28),
            "line 2, column 1: not YAML: ");
  EXPECT_EQ(complaint("a: b: c\n").substr(0, 17), "line 1, column 5:");
}

TEST_F(SceneFile, NestedWithoutEndIsRefusedAndDoesNotCrash) {
  for (const char open : {'[', '{'}) {
    EXPECT_NE(complaint("step: " + std::string(1000000, open)), "");
  }
  std::string block;
  for (int i = 0; i < 2000; ++i) {
    block += std::string(static_cast<std::size_t>(i), ' ') + "a:\n";
  }
  EXPECT_NE(complaint(block), "");
}

TEST_F(SceneFile, WithAliasesOfAliasesIsRefusedInGoodTime) {
  // Nine levels of nine aliases each: a file of a few lines that would unfold to 4e8 nodes.
  std::string bomb = "a0: &a0 [1,1,1,1,1,1,1,1,1]\n";
  for (int i = 1; i < 9; ++i) {
    bomb += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [";
    for (int j = 0; j < 9; ++j) {
      bomb += (j == 0 ? "*a" : ",*a") + std::to_string(i - 1);
    }
    bomb += "]\n";
  }
  EXPECT_NE(complaint(bomb), "");
}

}  // namespace scene_file_test
}  // namespace whirl_twin

// Files of figures: drawn by Python, all of them or none.
#include "reports/drawings.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "messages/input_error.h"

namespace whirl_twin {
namespace drawings_test {

namespace fs = std::filesystem;

class Files : public testing::Test {
 protected:
  Files() : folder_(fs::temp_directory_path() / ("drawings_test." + std::to_string(::getpid()))) {
    fs::create_directory(folder_);
  }
  ~Files() override {
    ::unsetenv("WHIRL_TWIN_PYTHON");
    fs::remove_all(folder_);
  }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  std::string contents(const std::string& name) const {
    std::ifstream in(file(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  std::size_t count() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }
  static Json parabola() {
    Figure figure;
    figure.title = "a < b & \"c\"";
    Chart chart;
    chart.x.label = "time (s)";
    chart.series = {{"square", {0.0, 1.0, 2.0}, {0.0, 1.0, 4.0}}};
    figure.charts = {chart};
    return figureJson(figure);
  }

  fs::path folder_;
};

TEST_F(Files, AreDrawnInTheFormatOfTheirNames) {
  Drawings drawings;
  drawings.add(file("a.svg"), parabola());
  drawings.add(file("b.png"), parabola());
  drawings.add(file("c.pdf"), parabola());
  drawings.add(file("d.json"), parabola());
  EXPECT_EQ(drawings.write(), (std::vector<std::string>{file("a.svg"), file("b.png"), file("c.pdf"),
                                                        file("d.json")}));
  EXPECT_EQ(count(), 4U);
  EXPECT_NE(contents("a.svg").find("time (s)"), std::string::npos);
  EXPECT_NE(contents("a.svg").find("a &lt; b &amp; \"c\""), std::string::npos);
  EXPECT_EQ(contents("b.png").substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_EQ(contents("c.pdf").substr(0, 5), "%PDF-");
  EXPECT_EQ(Json::parse(contents("d.json")), parabola());
}

TEST_F(Files, OfDataNeedNoPython) {
  ::setenv("WHIRL_TWIN_PYTHON", "/no/such/python", 1);
  Drawings drawings;
  drawings.add(file("d.json"), parabola());
  drawings.write();
  EXPECT_EQ(count(), 1U);
}

TEST_F(Files, AllStayAwayWhereOneCannotBeDrawn) {
  for (const char* python : {"/no/such/python", "/bin/false"}) {
    ::setenv("WHIRL_TWIN_PYTHON", python, 1);
    Drawings drawings;
    drawings.add(file("d.json"), parabola());
    drawings.add(file("a.svg"), parabola());
    EXPECT_THROW(drawings.write(), RunFailure);
  }
  ::unsetenv("WHIRL_TWIN_PYTHON");
  {
    Drawings drawings;
    drawings.add(file("a.svg"), parabola());
    drawings.add(file("b.svg"), Json{{"kind", "no such kind"}});
    EXPECT_THROW(drawings.write(), RunFailure);
  }
  EXPECT_EQ(count(), 0U);
}

TEST_F(Files, WithoutPythonTheMessageNamesThePackage) {
  ::setenv("WHIRL_TWIN_PYTHON", "/no/such/python", 1);
  Drawings drawings;
  drawings.add(file("a.svg"), parabola());
  try {
    drawings.write();
    ADD_FAILURE() << "it was drawn";
  } catch (const RunFailure& failure) {
    EXPECT_NE(std::string(failure.what()).find("sudo apt-get install python3-matplotlib"),
              std::string::npos)
        << failure.what();
  }
}

TEST_F(Files, OfAPageEscapeEveryText) {
  Drawings drawings;
  const std::string script = "<script>alert(1)</script>";
  drawings.addPage(file("a.html"), Json{{"title", script},
                                        {"facts", Json::array()},
                                        {"summary", {script}},
                                        {"parts", {{{"text", script}}, {{"figure", parabola()}}}}});
  drawings.write();
  const std::string page = contents("a.html");
  EXPECT_EQ(page.find("<script"), std::string::npos);
  EXPECT_NE(page.find("<svg"), std::string::npos);
}

TEST_F(Files, OfTheCurrentFolderAreNoModulesForPython) {
  const fs::path before = fs::current_path();
  std::ofstream(file("json.py")) << "raise SystemExit(7)\n";
  fs::current_path(folder_);
  Drawings drawings;
  drawings.add(file("a.svg"), parabola());
  EXPECT_NO_THROW(drawings.write());
  fs::current_path(before);
}

TEST(FigureFormat, IsThatOfTheExtension) {
  EXPECT_EQ(figureFormat("a.b/c.svg"), "svg");
  EXPECT_EQ(figureFormat("c.PNG"), "");
  EXPECT_EQ(figureFormat("svg"), "");
}

}  // namespace drawings_test
}  // namespace whirl_twin

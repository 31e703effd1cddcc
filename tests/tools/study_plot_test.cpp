// `twin plot` of a study's results: the pictures and their texts.
#include <gtest/gtest.h>

#include "swept_study.h"

namespace whirl_twin {
namespace study_plot_test {

using Names = std::vector<std::string>;

struct Files : StudyFiles {
  explicit Files(const std::string& rest)
      : StudyFiles("study: {scene: scene.yaml, seed: 3}\n" + rest) {
    const Ending run = sweep("results");
    EXPECT_EQ(run.status, 0) << run.err;
  }
  Ending plot(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"plot",          study,      "--results",
                                       file("results"), "--output", file("pictures"),
                                       "--format",      "json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return twin(arguments);
  }
  Names pictures() const {
    Names names;
    for (const auto& entry : std::filesystem::directory_iterator(file("pictures"))) {
      names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }
  std::string picture(const std::string& name) const {
    return contentsOf(file("pictures/") + name);
  }
};

const std::string kTwo =
    "vary: {rotor.stiffness: {uniform: [0.9e4, 1.1e4]}, rotor.damping: {uniform: [8, 12]}}\n";
const std::string kAnalyzed =
    "run: analyze\nmeasure: {frequency: \"natural_frequencies[0]\"}\n"
    "require: {frequency: \"> 97\"}\n";

TEST(StudyPlot, OfDrawsIsAHistogramAndAScatter) {
  const Files files(kTwo + "design: {latin_hypercube: 200}\n" + kAnalyzed);
  const Ending end = files.plot();
  EXPECT_EQ(end.status, 0) << end.err;
  EXPECT_EQ(files.pictures(), (Names{"frequency_histogram.json", "frequency_scatter.json"}));
  EXPECT_EQ(linesOf(end.out).size(), 2U);
  const std::string histogram = files.picture("frequency_histogram.json");
  EXPECT_NE(histogram.find("% of 200 points meet frequency > 97"), std::string::npos);
  EXPECT_NE(histogram.find("points over frequency (rad/s)"), std::string::npos);
  EXPECT_NE(histogram.find("required: frequency > 97"), std::string::npos);
  const std::string scatter = files.picture("frequency_scatter.json");
  EXPECT_NE(scatter.find("frequency (rad/s) over rotor.stiffness (N/m)"), std::string::npos);
  EXPECT_NE(scatter.find("frequency (rad/s) over rotor.damping (N s/m)"), std::string::npos);
}

TEST(StudyPlot, OfASensitivityIsATornadoWithTheHeaviestAtTheTop) {
  for (const std::string design : {"{sobol_indices: 32}", "{morris: 8}", "{one_at_a_time: 5}"}) {
    const Files files(
        "vary: {rotor.damping: {uniform: [8, 12]}, rotor.stiffness: {uniform: [0.9e4, 1.1e4]}}\n"
        "design: " +
        design + "\n" + kAnalyzed);
    EXPECT_EQ(files.plot().status, 0);
    EXPECT_EQ(files.pictures(), (Names{"frequency_histogram.json", "frequency_scatter.json",
                                       "frequency_tornado.json"}));
    const std::string picture = files.picture("frequency_tornado.json");
    const std::size_t stiffness = picture.find("rotor.stiffness");
    EXPECT_LT(stiffness, picture.find("rotor.damping")) << design;
    EXPECT_NE(stiffness, std::string::npos);
  }
}

TEST(StudyPlot, OfAGridOfTwoIsAMap) {
  const Files files(kTwo + "design: {grid: 6}\n" + kAnalyzed);
  EXPECT_EQ(files.plot().status, 0);
  EXPECT_EQ(files.pictures(),
            (Names{"frequency_histogram.json", "frequency_map.json", "frequency_scatter.json"}));
  EXPECT_EQ(nlohmann::json::parse(files.picture("frequency_map.json"))["values"].size(), 6U);
}

TEST(StudyPlot, WhatCannotBeMeantIsRefused) {
  const Files files(kTwo + "design: {grid: 2}\n" + kAnalyzed);
  const Ending without = twin({"plot", files.study, "--output", files.file("pictures")});
  EXPECT_EQ(without.status, 2);
  EXPECT_NE(without.err.find("--results: missing"), std::string::npos) << without.err;
  EXPECT_EQ(files.plot({"--duration", "1"}).status, 2);
  EXPECT_EQ(files.plot({"--system", "rotor"}).status, 2);
  EXPECT_EQ(twin({"plot", files.study, "--results", files.file("none")}).status, 2);
  EXPECT_FALSE(std::filesystem::exists(files.file("pictures")));
  std::filesystem::remove(files.file("results/blocks/000000001.csv"));
  const Ending part = files.plot();
  EXPECT_EQ(part.status, 1);
  EXPECT_NE(part.err.find("3 of 4 points are done"), std::string::npos) << part.err;
}

/// With its scene where it is, and few points.
std::string shipped(const TemporaryDirectory& files, const std::string& name,
                    const std::string& design, const std::string& few) {
  const std::string folder = WHIRL_TWIN_SOURCE "/config/studies/";
  std::string text = contentsOf(folder + name);
  const auto replace = [&](const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << name << ": " << from;
    text.replace(std::min(at, text.size()), from.size(), to);
  };
  replace("{scene: ", "{scene: " + folder);
  if (!design.empty()) {
    replace(design, few);
  }
  return files.write(name, text);
}

TEST(StudyPlot, ShippedStudiesSayWhatTheyAreSaidToSay) {
  const TemporaryDirectory files;
  const auto run = [&](const std::string& study) {
    const std::string results = files.file("results") + study.substr(study.rfind('/') + 1);
    const Ending end = twin({"sweep", study, "--output", results, "--json"});
    EXPECT_EQ(end.status, 0) << end.err;
    const Ending drawn =
        twin({"plot", study, "--results", results, "--output", files.file("pictures")});
    EXPECT_EQ(drawn.status, 0) << drawn.err;
    return end.json();
  };
  const nlohmann::json margin =
      run(shipped(files, "separation_margin.yaml", "latin_hypercube: 300", "latin_hypercube: 12"));
  EXPECT_EQ(margin["failed"], 0);
  EXPECT_LT(margin["measures"]["first"]["largest"], 1010.0);  // below the operating speed
  const nlohmann::json threshold =
      run(shipped(files, "threshold_speed.yaml", "sobol_indices: 512", "sobol_indices: 256"));
  const nlohmann::json sobol = threshold["measures"]["threshold"]["sobol"];
  EXPECT_GT(sobol["rotor.internal_damping"]["total"]["value"], 0.3);
  EXPECT_LT(sobol["rotor.stiffness"]["total"]["value"], 0.15);
  EXPECT_EQ(sobol["rotor.eccentricity"]["total"]["value"], 0.0);
  const nlohmann::json map = run(shipped(files, "run_up_map.yaml", "{grid: 16}", "{grid: 3}"));
  EXPECT_EQ(map["points"], 9);
  const nlohmann::json tolerances =
      run(shipped(files, "run_up_tolerances.yaml", "latin_hypercube: 2000", "latin_hypercube: 10"));
  EXPECT_EQ(tolerances["failed"], 0);
}

}  // namespace study_plot_test
}  // namespace whirl_twin

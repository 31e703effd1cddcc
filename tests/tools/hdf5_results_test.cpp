#include <gtest/gtest.h>
#include <hdf5.h>

#include <cmath>
#include <csignal>
#include <map>
#include <thread>

#include "swept_study.h"

namespace whirl_twin {
namespace hdf5_results_test {

/// Likewise with measures of all kinds.
const std::string kStudy = R"yaml(
study: {scene: scene.yaml, seed: 3, block: 10}
vary:
  rotor.stiffness: {uniform: [0.9e4, 1.1e4]}
  rotor.damping: {normal: [10.0, 7.8]}
design: {latin_hypercube: 300}
run: {duration: 0.3}
measure:
  peak: max(rotor.whirl.radius)
  frequency: "natural_frequencies[0]"
  first: critical_speeds[0]
  settled: "settling(rotor.whirl.radius, 0.3)"
  unknown: log(rotor.damping - 5)
  ratio: max(rotor.whirl.radius) / (1.0e-4)
require: {peak: "< 4.0e-4", frequency: "> 95"}
)yaml";

struct Files : StudyFiles {
  explicit Files(const std::string& text = kStudy) : StudyFiles(text) {}
  std::string image(const std::string& folder) const {
    return contentsOf(file(folder) + "/results.h5");
  }
};

/// Of a file, by the library's own calls.
class Hdf5 {
 public:
  explicit Hdf5(const std::string& path)
      : file_(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT)) {}
  ~Hdf5() { H5Fclose(file_); }
  Hdf5(const Hdf5&) = delete;
  Hdf5& operator=(const Hdf5&) = delete;

  bool has(const std::string& path) const {
    return H5Lexists(file_, path.c_str(), H5P_DEFAULT) > 0;
  }
  /// Integers as numbers.
  std::vector<double> numbers(const std::string& path) const {
    const hid_t data = H5Dopen2(file_, path.c_str(), H5P_DEFAULT);
    const hid_t space = H5Dget_space(data);
    std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    if (!values.empty()) {
      EXPECT_GE(H5Dread(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0)
          << path;
    }
    H5Sclose(space);
    H5Dclose(data);
    return values;
  }
  Lines texts(const std::string& path) const {
    const hid_t data = H5Dopen2(file_, path.c_str(), H5P_DEFAULT);
    const hid_t type = H5Dget_type(data);
    const std::size_t count = numbersOf(data);
    const std::size_t size = H5Tget_size(type);
    std::string all(count * size, '\0');
    EXPECT_GE(H5Dread(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, all.data()), 0) << path;
    Lines lines;
    for (std::size_t i = 0; i < count; ++i) {
      lines.push_back(cut(all.substr(i * size, size)));
    }
    H5Tclose(type);
    H5Dclose(data);
    return lines;
  }
  std::vector<double> attribute(const std::string& of, const char* name) const {
    const hid_t attribute = opened(of, name);
    const hid_t space = H5Aget_space(attribute);
    std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    EXPECT_GE(H5Aread(attribute, H5T_NATIVE_DOUBLE, values.data()), 0) << of << " " << name;
    H5Sclose(space);
    H5Aclose(attribute);
    return values;
  }
  std::string text(const std::string& of, const char* name) const {
    const hid_t attribute = opened(of, name);
    const hid_t type = H5Aget_type(attribute);
    std::string text(H5Tget_size(type), '\0');
    EXPECT_GE(H5Aread(attribute, type, text.data()), 0) << of << " " << name;
    H5Tclose(type);
    H5Aclose(attribute);
    return cut(text);
  }

 private:
  hid_t opened(const std::string& of, const char* name) const {
    return H5Aopen_by_name(file_, of.c_str(), name, H5P_DEFAULT, H5P_DEFAULT);
  }
  static std::size_t numbersOf(hid_t data) {
    const hid_t space = H5Dget_space(data);
    const auto count = static_cast<std::size_t>(H5Sget_simple_extent_npoints(space));
    H5Sclose(space);
    return count;
  }
  static std::string cut(const std::string& text) { return text.substr(0, text.find('\0')); }

  hid_t file_;
};

/// The cells of a line; those in quotation marks without them.
Lines cellsOf(const std::string& line) {
  Lines cells{""};
  bool inQuotes = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (inQuotes && line.compare(i, 2, "\"\"") == 0) {
      cells.back() += line[i++];
    } else if (line[i] == '"') {
      inQuotes = !inQuotes;
    } else if (line[i] == ',' && !inQuotes) {
      cells.emplace_back();
    } else {
      cells.back() += line[i];
    }
  }
  return cells;
}

/// By the names in its first line.
std::map<std::string, Lines> columnsOf(const std::string& table) {
  std::map<std::string, Lines> columns;
  const Lines lines = linesOf(table);
  const Lines names = cellsOf(lines.front());
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const Lines cells = cellsOf(lines[i]);
    for (std::size_t k = 0; k < names.size(); ++k) {
      columns[names[k]].push_back(cells.at(k));
    }
  }
  return columns;
}

/// Number for number, to the last bit.
void expectSame(const std::vector<double>& numbers, const Lines& cells, const std::string& what) {
  ASSERT_EQ(numbers.size(), cells.size()) << what;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const double cell = std::stod(cells[i]);
    EXPECT_TRUE(numbers[i] == cell || (std::isnan(numbers[i]) && std::isnan(cell)))
        << what << " " << i << ": " << numbers[i] << " and " << cell;
  }
}

TEST(Hdf5Results, AreTheTablesAndWhatTheySay) {
  const Files files;
  const Ending ending = twin(files.command("r", {"--json"}));
  ASSERT_EQ(ending.status, 0) << ending.err;
  const nlohmann::json said = ending.json();
  const Hdf5 results(files.file("r") + "/results.h5");
  auto good = columnsOf(contentsOf(files.file("r") + "/results.csv"));
  auto failed = columnsOf(contentsOf(files.file("r") + "/failed.csv"));
  ASSERT_GT(good["point"].size(), 200U);
  ASSERT_GT(failed["point"].size(), 10U);
  EXPECT_GT(said["measures"]["unknown"]["undefined"].get<int>(), 10);
  expectSame(results.numbers("point"), good["point"], "point");
  expectSame(results.numbers("failed/point"), failed["point"], "failed/point");
  EXPECT_EQ(results.texts("failed/reason"), failed["reason"]);
  for (const std::string number : {"rotor.stiffness", "rotor.damping"}) {
    expectSame(results.numbers("vary/" + number), good[number], number);
    expectSame(results.numbers("failed/vary/" + number), failed[number], number);
  }
  for (const auto& [name, measure] : said["measures"].items()) {
    const std::string path = "measure/" + name;
    expectSame(results.numbers(path), good[name], name);
    EXPECT_EQ(results.attribute(path, "count"), std::vector<double>{measure["count"]});
    EXPECT_EQ(results.attribute(path, "undefined"), std::vector<double>{measure["undefined"]});
    for (const char* what : {"mean", "standard_deviation", "smallest", "largest"}) {
      EXPECT_EQ(results.attribute(path, what), std::vector<double>{measure[what]}) << name;
    }
    const std::vector<double> at = results.attribute(path, "percentiles_at");
    const std::vector<double> percentiles = results.attribute(path, "percentiles");
    ASSERT_EQ(at, (std::vector<double>{1, 5, 25, 50, 75, 95, 99}));
    for (std::size_t k = 0; k < at.size(); ++k) {
      EXPECT_EQ(percentiles[k],
                measure["percentiles"][std::to_string(static_cast<int>(at[k]))].get<double>());
    }
  }
  EXPECT_EQ(results.texts("require/requirement"),
            (Lines{"peak < 0.0004", "frequency > 95", "all"}));
  EXPECT_EQ(results.numbers("require/passed")[2], said["yield"]["passed"].get<double>());
  EXPECT_EQ(results.numbers("require/low")[0], said["requirements"][0]["low"].get<double>());
  EXPECT_EQ(results.text("/", "study"), kStudy);
  EXPECT_EQ(results.text("/", "scene"), kStudiedRotor);
  EXPECT_EQ(results.text("/", "design"), "latin_hypercube");
  EXPECT_EQ(results.text("vary/rotor.stiffness", "unit"), "N/m");
  EXPECT_EQ(results.attribute("vary/rotor.stiffness", "nominal"), std::vector<double>{1.0e4});
  EXPECT_EQ(results.text("measure/peak", "unit"), "m");
  EXPECT_EQ(results.text("measure/peak", "expression"), "max(rotor.whirl.radius)");
  EXPECT_EQ(results.text("measure/first", "unit"), "rad/s");
  EXPECT_EQ(results.text("measure/settled", "unit"), "s");
  EXPECT_EQ(results.text("measure/ratio", "unit"), "-");
}

TEST(Hdf5Results, WorkersPartsAndKillsChangeNoByte) {
  const Files files;
  ASSERT_EQ(files.sweep("one", {"--workers", "1"}).status, 0);
  const std::string image = files.image("one");
  ASSERT_EQ(image.substr(1, 3), "HDF");
  EXPECT_LT(image.size(), 100000U);                              // of 300 points
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // HDF5's times are in seconds
  for (const std::string workers : {"2", "4"}) {
    ASSERT_EQ(files.sweep(workers, {"--workers", workers}).status, 0);
    EXPECT_EQ(files.image(workers), image);
  }
  for (const std::string part : {"2/2", "1/2"}) {
    ASSERT_EQ(files.sweep("parts", {"--part", part}).status, 0);
  }
  EXPECT_EQ(files.image("parts"), image);
  for (int k = 0; k < 5; ++k) {
    const pid_t child = startTwin(files.command("killed"), files.file("out"), files.file("err"));
    std::this_thread::sleep_for(std::chrono::milliseconds(40 + 40 * k));
    ::kill(child, SIGKILL);
    statusOf(child);
  }
  ASSERT_EQ(files.sweep("killed").status, 0);
  EXPECT_EQ(files.image("killed"), image);
}

TEST(Hdf5Results, SensitivitiesAreInIt) {
  const std::string study = kStudy.substr(0, kStudy.find("design:")) +
                            "design: {sobol_indices: 32}\nrun: analyze\n"
                            "measure: {frequency: \"natural_frequencies[0]\"}\n";
  const Files files(study);
  const nlohmann::json sobol =
      files.sweep("s", {"--json"}).json()["measures"]["frequency"]["sobol"];
  const Hdf5 results(files.file("s") + "/results.h5");
  const nlohmann::json first = sobol["rotor.stiffness"]["first"];
  EXPECT_EQ(results.attribute("sobol/frequency/rotor.stiffness", "first"),
            (std::vector<double>{first["value"], first["low"], first["high"]}));
  EXPECT_FALSE(results.has("morris"));
  Files other(std::string(study).replace(study.find("sobol_indices"), 13, "morris"));
  const nlohmann::json morris =
      twin(other.command("m", {"--json"})).json()["measures"]["frequency"]["morris"];
  const nlohmann::json mean = morris["rotor.damping"]["mean_magnitude"];
  EXPECT_EQ(Hdf5(other.file("m") + "/results.h5")
                .attribute("morris/frequency/rotor.damping", "mean_magnitude"),
            (std::vector<double>{mean["value"], mean["low"], mean["high"]}));
}

TEST(Hdf5Results, LongTextsAndNoPointThatIsGoodAreNoTrouble) {
  const std::string comment = "# " + std::string(200000, 'x') + "\n";
  const Files files(R"yaml(
study: {scene: scene.yaml}
vary: {rotor.damping: {normal: [-100.0, 1.0]}}
design: {monte_carlo: 20}
run: analyze
measure: {frequency: "natural_frequencies[0]"}
)yaml" + comment);
  EXPECT_EQ(files.sweep("r").status, 1);
  const Hdf5 results(files.file("r") + "/results.h5");
  EXPECT_EQ(results.text("/", "study"), contentsOf(files.study));
  EXPECT_TRUE(results.numbers("measure/frequency").empty());
  EXPECT_TRUE(std::isnan(results.attribute("measure/frequency", "mean").at(0)));
  EXPECT_EQ(results.numbers("failed/vary/rotor.damping").size(), 20U);
  EXPECT_NE(results.texts("failed/reason")[19].find("must be >= 0"), std::string::npos);
}

}  // namespace hdf5_results_test
}  // namespace whirl_twin

#include "studies/result_folder.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>

#include "algebra/constants.h"
#include "messages/checksum.h"
#include "messages/input_error.h"
#include "scene/yaml_file.h"
#include "twin/durable_file.h"

namespace whirl_twin {

namespace {

const std::string kEnd = "# end, checksum ";  // CRC-32C of all before, and a line feed
const std::string kFailed = "!";              // prefix of the line of a failed point

/// Empty if it cannot be read.
std::optional<std::string> fileContents(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    return std::nullopt;
  }
  return std::string{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::string endOf(std::string_view rows) {
  return fmt::format("{}{:08x}\n", kEnd, crc32c(rows.data(), rows.size()));
}

/// A cell quoted by RFC 4180.
std::string quotedCell(const std::string& text) {
  std::string cell = "\"";
  for (const char c : text) {
    cell += c;
    if (c == '"') {
      cell += c;
    }
  }
  return cell + "\"";
}

/// The inverse.
std::string unquoted(std::string_view cell) {
  std::string text;
  for (std::size_t i = 1; i + 1 < cell.size(); ++i) {
    text += cell[i];
    i += cell[i] == '"' ? 1 : 0;
  }
  return text;
}

/// Removes the last cells of a row and returns their numbers.
std::vector<double> takeNumbers(std::string_view& row, std::size_t count) {
  std::vector<double> numbers(count, kNaN);
  for (std::size_t k = count; k-- > 0;) {
    const std::size_t comma = row.rfind(',');
    const std::string_view cell = row.substr(comma + 1);
    std::from_chars(cell.data(), cell.data() + cell.size(), numbers[k]);
    row = row.substr(0, comma);
  }
  return numbers;
}

/// True if the folder is missing, empty, or left by a run that was killed before it had written its
/// manifest (or is writing it now).
bool isOurs(const std::string& folder) {
  static const std::vector<std::string> known{"blocks", "study.yaml", "scene.yaml",
                                              "manifest.yaml"};
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename();
    if (entry.path().extension() != ".tmp" &&
        std::find(known.begin(), known.end(), name) == known.end()) {
      return false;
    }
  }
  return true;
}

}  // namespace

Origin presentOrigin() {
  Origin origin{WHIRL_TWIN_VERSION, "", ""};
#if defined(__clang__)
  origin.compiler = "clang " __clang_version__;
#else
  origin.compiler = "g++ " __VERSION__;
#endif
#if defined(__x86_64__)
  __builtin_cpu_init();
  origin.processor = fmt::format("x86_64{}{}{}", __builtin_cpu_supports("fma") ? " fma" : "",
                                 __builtin_cpu_supports("avx2") ? " avx2" : "",
                                 __builtin_cpu_supports("avx512f") ? " avx512f" : "");
#elif defined(__aarch64__)
  origin.processor = "aarch64";
#else
  origin.processor = "unknown";
#endif
  return origin;
}

ResultFolder::ResultFolder(const std::string& path, const Study& study, bool mixed)
    : path_(path), study_(study) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (fs::exists(path_, error) && !fs::is_directory(path_, error)) {
    throw RunFailure(fmt::format("{}: cannot be written: not a folder", path_));
  }
  if (fs::exists(path_ + "/manifest.yaml", error)) {
    compare(mixed);
  } else {
    if (!isOurs(path_)) {
      throw InputError(fmt::format(
          "{}: must be an empty folder or one with results of a study, found other files", path_));
    }
    steps_ = chooseSteps(study_);
    if (!make()) {
      steps_ = {};
      compare(mixed);
    }
  }
}

bool ResultFolder::make() {
  std::error_code error;
  std::filesystem::create_directories(path_ + "/blocks", error);
  if (error) {
    throw RunFailure(fmt::format("{}: cannot be created: {}", path_, error.message()));
  }
  write("study.yaml", study_.text);
  write("scene.yaml", study_.scene_text);
  const Origin origin = presentOrigin();
  YAML::Node manifest;
  manifest["study"] = fmt::format("{:016x}", study_.hash);
  manifest["points"] = study_.points();
  manifest["block"] = study_.block;
  manifest["version"] = origin.version;
  manifest["compiler"] = origin.compiler;
  manifest["processor"] = origin.processor;
  for (const StepsChosen::Choice& choice : steps_.choices) {
    YAML::Node entry;
    entry["integrator"] = choice.integrator;
    entry["substeps"] = choice.substeps;
    manifest["steps"].push_back(entry);
  }
  YAML::Emitter text;
  text << manifest;
  DurableFile last(path_ + "/manifest.yaml");  // written last: the folder is complete
  last.add(std::string(text.c_str()) + "\n");
  return last.finishUnlessThere();
}

void ResultFolder::compare(bool mixed) {
  const std::string file = path_ + "/manifest.yaml";
  try {
    const YAML::Node manifest = readYamlFile(file, "a manifest", "a study");
    if (manifest["study"].as<std::string>() != fmt::format("{:016x}", study_.hash) ||
        manifest["block"].as<std::uint64_t>() != study_.block) {
      throw InputError(
          fmt::format("{}: has the results of another study, or of another version of this study "
                      "or its scene: use another folder",
                      path_));
    }
    const Origin origin = presentOrigin();
    std::string differences;
    const auto compareOne = [&](const char* key, const std::string& now) {
      const auto then = manifest[key].as<std::string>();
      if (then != now) {
        differences +=
            fmt::format("{}{} '{}', now '{}'", differences.empty() ? "" : "; ", key, then, now);
      }
    };
    compareOne("version", origin.version);
    compareOne("compiler", origin.compiler);
    compareOne("processor", origin.processor);
    if (!differences.empty() && !mixed) {
      throw InputError(
          fmt::format("{}: its results come from {}, and may differ in their last digits from new "
                      "ones: use another folder, or --mixed",
                      path_, differences));
    }
    for (const YAML::Node& entry : manifest["steps"]) {
      steps_.choices.push_back(
          {entry["integrator"].as<std::string>(), entry["substeps"].as<int>()});
    }
  } catch (const YAML::Exception&) {
    throw InputError(fmt::format("{}: must be the manifest of a study", file));
  }
}

std::string ResultFolder::fileOf(std::uint64_t block) const {
  return fmt::format("{}/blocks/{:09}.csv", path_, block);
}

std::string ResultFolder::headOf(std::uint64_t block) const {
  return fmt::format("# study {:016x}, block {}, {} points from {}\n", study_.hash, block,
                     study_.sizeOf(block), study_.firstOf(block));
}

std::vector<bool> ResultFolder::finished() const {
  std::vector<bool> all(study_.blocks());
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(path_ + "/blocks", error)) {
    const std::string name = entry.path().filename();
    std::uint64_t block = 0;
    std::from_chars(name.data(), name.data() + name.size(), block);
    if (block < all.size() && entry.path() == fileOf(block)) {
      all[block] = rowsOf(block).has_value();
    }
  }
  return all;
}

std::optional<std::string> ResultFolder::rowsOf(std::uint64_t block) const {
  std::optional<std::string> text = fileContents(fileOf(block));
  const std::string head = headOf(block);
  if (!text || text->compare(0, head.size(), head) != 0) {
    return std::nullopt;
  }
  const std::size_t end = text->rfind(kEnd);
  if (end == std::string::npos || text->substr(end) != endOf(text->substr(0, end))) {
    return std::nullopt;
  }
  return text->substr(head.size(), end - head.size());
}

void ResultFolder::write(const std::string& name, const std::string& text) const {
  DurableFile file(path_ + "/" + name);
  file.add(text);
  file.finish();
}

void ResultFolder::write(std::uint64_t block, const std::vector<Outcome>& outcomes) const {
  std::string text = headOf(block);
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const std::uint64_t point = study_.firstOf(block) + i;
    const bool failed = !outcomes[i].failure.empty();
    std::string row = (failed ? kFailed : "") + std::to_string(point);
    if (failed) {
      row += "," + quotedCell(outcomes[i].failure);
    }
    for (const double value : study_.valuesAt(point)) {
      row += fmt::format(",{}", value);
    }
    for (const double value : outcomes[i].measures) {
      row += fmt::format(",{}", value);
    }
    text += row + "\n";
  }
  DurableFile file(fileOf(block));
  file.add(text + endOf(text));
  file.finish();
}

void ResultFolder::forEachRow(
    const std::function<void(std::uint64_t, bool, std::string_view)>& take) const {
  for (std::uint64_t block = 0; block < study_.blocks(); ++block) {
    const std::optional<std::string> text = rowsOf(block);
    const auto wrong = [&] {
      return RunFailure(
          fmt::format("{}: missing or corrupt: remove it and run the study again", fileOf(block)));
    };
    if (!text) {
      throw wrong();
    }
    std::uint64_t point = study_.firstOf(block);
    const std::uint64_t end = point + study_.sizeOf(block);
    std::size_t at = 0;
    for (; point < end; ++point) {
      const std::size_t line_end = text->find('\n', at);
      if (line_end == std::string::npos) {
        throw wrong();
      }
      std::string_view row = std::string_view(*text).substr(at, line_end - at + 1);
      at = line_end + 1;
      const bool failed = row.compare(0, kFailed.size(), kFailed) == 0;
      row.remove_prefix(failed ? kFailed.size() : 0);
      const std::string number = std::to_string(point) + ",";
      if (row.compare(0, number.size(), number) != 0) {
        throw wrong();
      }
      take(point, failed, row);
    }
    if (at != text->size()) {
      throw wrong();
    }
  }
}

void ResultFolder::forEachPoint(const std::function<void(const PointResult&)>& take) const {
  forEachRow([&](std::uint64_t point, bool failed, std::string_view row) {
    row.remove_suffix(1);
    PointResult result;
    result.point = point;
    if (!failed) {
      result.outcome.measures = takeNumbers(row, study_.measures.size());
    }
    result.values = takeNumbers(row, study_.vary.size());
    if (failed) {
      result.outcome.failure = unquoted(row.substr(row.find(',') + 1));
    }
    take(result);
  });
}

StudyTable ResultFolder::merge() const {
  StudyTable table;
  table.measures.assign(study_.measures.size(), std::vector<double>(study_.points(), kNaN));
  table.failed.assign(study_.points(), false);
  DurableFile results(path_ + "/results.csv");
  DurableFile failures(path_ + "/failed.csv");
  std::string paths;
  for (const Variation& variation : study_.vary) {
    paths += "," + variation.path;
  }
  std::string names;
  for (const Measure& measure : study_.measures) {
    names += "," + measure.name;
  }
  results.add("point" + paths + names + "\n");
  failures.add("point,reason" + paths + "\n");
  forEachRow([&](std::uint64_t point, bool failed, std::string_view row) {
    (failed ? failures : results).add(row);
    if (failed) {
      table.failed[point] = true;
      ++table.failures;
      return;
    }
    row.remove_suffix(1);
    const std::vector<double> measured = takeNumbers(row, table.measures.size());
    for (std::size_t k = 0; k < measured.size(); ++k) {
      table.measures[k][point] = measured[k];
    }
  });
  results.finish();
  failures.finish();
  removeUnfinished();
  return table;
}

/// Removes temporary files of a killed run.
void ResultFolder::removeUnfinished() const {
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(path_ + "/blocks", error)) {
    if (entry.path().extension() == ".tmp") {
      std::filesystem::remove(entry.path(), error);
    }
  }
}

ResultFolder::Pace ResultFolder::pace() const {
  double first = std::numeric_limits<double>::infinity();
  double last = -first;
  Pace pace;
  for (std::uint64_t block = 0; block < study_.blocks(); ++block) {
    struct stat status {};
    if (::stat(fileOf(block).c_str(), &status) == 0) {
      const double time = static_cast<double>(status.st_mtim.tv_sec) +
                          1.0e-9 * static_cast<double>(status.st_mtim.tv_nsec);
      first = std::min(first, time);
      last = std::max(last, time);
      ++pace.blocks;
    }
  }
  pace.seconds = pace.blocks > 1 ? last - first : 0.0;
  return pace;
}

}  // namespace whirl_twin

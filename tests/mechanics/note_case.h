// The lecture notes' reference numbers (tests/reference/note_cases.json), and the models' results
// for each of them.
#pragma once

#include <cctype>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace whirl_twin {

struct NoteCase {
  std::string id;
  std::string system;
  std::string what;
  std::map<std::string, double> given;
  double expected = 0.0;
  double tolerance = 0.0;  ///< absolute
  double time = 0.0;       ///< [s], of a trajectory
  std::string state;       ///< of a trajectory

  double at(const std::string& name) const { return given.at(name); }
  double at(const std::string& name, double fallback) const {
    const auto found = given.find(name);
    return found == given.end() ? fallback : found->second;
  }
  bool startsWith(const std::string& prefix) const {
    return id.compare(0, prefix.size(), prefix) == 0;
  }
  bool contains(const std::string& part) const { return id.find(part) != std::string::npos; }
};

inline void PrintTo(const NoteCase& c, std::ostream* out) {
  *out << c.id << ": " << c.what;
}

/// The id as a test name.
inline std::string testName(const NoteCase& c) {
  std::string name;
  for (const char letter : c.id) {
    name += letter == '-' ? 'm' : std::isalnum(static_cast<unsigned char>(letter)) ? letter : '_';
  }
  return name;
}

/// All cases, or those of one system.
inline std::vector<NoteCase> noteCases(const std::string& system = "") {
  std::ifstream file(WHIRL_TWIN_REFERENCE "/note_cases.json");
  if (!file) {
    throw std::runtime_error("cannot read note_cases.json");
  }
  std::vector<NoteCase> cases;
  for (const auto& entry : nlohmann::json::parse(file)) {
    NoteCase c;
    c.id = entry.at("id");
    c.system = entry.at("system");
    if (!system.empty() && c.system != system) {
      continue;
    }
    c.what = entry.at("what");
    for (const auto& [name, value] : entry.at("params").items()) {
      if (value.is_number()) {
        c.given[name] = value;
      }
    }
    c.expected = entry.at("expected").is_number() ? entry.at("expected").get<double>() : 0.0;
    c.tolerance = entry.value("tolerance", 0.0);
    c.time = entry.contains("t") ? entry.at("t").get<double>() : 0.0;
    c.state = entry.value("state", "");
    cases.push_back(c);
  }
  return cases;
}

/// The model's results, one value per applicable method; empty: not covered.
std::vector<double> spinningPendulumAnswers(const NoteCase& c);
std::vector<double> doublePendulumAnswers(const NoteCase& c);
std::vector<double> relativeDoublePendulumAnswers(const NoteCase& c);
std::vector<double> rotorAnswers(const NoteCase& c);
std::vector<double> freeRotorAnswers(const NoteCase& c);
std::vector<double> fluidWhirlAnswers(const NoteCase& c);
std::vector<double> hystereticWhirlAnswers(const NoteCase& c);
std::vector<double> gyroscopicTiltAnswers(const NoteCase& c);
std::vector<double> twoBarAnswers(const NoteCase& c);
std::vector<double> rollingDiscAnswers(const NoteCase& c);
std::vector<double> eccentricDiscAnswers(const NoteCase& c);
std::vector<double> rodSliderAnswers(const NoteCase& c);
std::vector<double> cartAnswers(const NoteCase& c);
std::vector<double> invertedSpringAnswers(const NoteCase& c);
std::vector<double> rotatingPendulumAnswers(const NoteCase& c);
std::vector<double> rigidBeamAnswers(const NoteCase& c);
std::vector<double> frictionAnswers(const NoteCase& c);
std::vector<double> symmetricFlywheelAnswers(const NoteCase& c);
std::vector<double> flywheelAnswers(const NoteCase& c);
std::vector<double> governorAnswers(const NoteCase& c);
std::vector<double> leverAnswers(const NoteCase& c);
std::vector<double> submarineAnswers(const NoteCase& c);
std::vector<double> cantileverAnswers(const NoteCase& c);

}  // namespace whirl_twin

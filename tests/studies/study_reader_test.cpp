#include "studies/study_reader.h"

#include <gtest/gtest.h>

#include "messages/input_error.h"
#include "study_files.h"

namespace whirl_twin {
namespace study_reader_test {

std::string inputErrorOf(const StudyFiles& files, const std::string& rest) {
  try {
    static_cast<void>(readStudy(files.study(rest)));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// With one number that varies so.
std::string varied(const std::string& path, const std::string& distribution,
                   const std::string& design = "{monte_carlo: 10}") {
  return "vary: {\"" + path + "\": " + distribution + "}\ndesign: " + design +
         "\nrun: analyze\nmeasure: {critical: \"critical_speeds[0]\"}\n";
}

#define EXPECT_SAYS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

TEST(StudyReader, ReadsWhatIsAsked) {
  const StudyFiles files;
  const Study study = readStudy(files.study(R"(
vary:
  rotor.stiffness: {relative_half_width: 0.1}
  rotor.initial.x: {normal: [0.0, 1.0e-5]}
  shaft.max_acceleration: {list: [50, 100]}
design: {latin_hypercube: 5000}
run: {duration: 2.0, analyze: [critical_speeds]}
measure: {peak: max(rotor.whirl.radius), critical: "critical_speeds[0]"}
require: {peak: "< 2.0e-4", critical: ["> 80", "<= 120"]}
)"));
  EXPECT_EQ(study.points(), 5000U);
  EXPECT_EQ(study.seed, 7U);
  ASSERT_EQ(study.vary.size(), 3U);
  EXPECT_EQ(study.vary[0].unit, "N/m");
  EXPECT_DOUBLE_EQ(study.vary[0].distribution.low, 0.9e4);
  EXPECT_EQ(study.vary[2].places.size(), 2U);  // both moves
  EXPECT_EQ(study.measures[0].name, "peak");
  EXPECT_EQ(study.requirements.size(), 3U);
  EXPECT_EQ(study.valuesAt(4999), study.valuesAt(4999));
  EXPECT_NE(study.valuesAt(4999), study.valuesAt(0));
}

TEST(StudyReader, NumbersHaveUnits) {
  const StudyFiles files;
  const Study study = readStudy(files.study(R"(
vary:
  rotor.stiffness: {uniform: [8 N/mm, 12000]}
  rotor.initial.x: {normal: [0 m, 10 um]}
  shaft.profile[0].speed: {list: [1200 rpm, 20 Hz]}
  step: {list: [0.5 ms, 1000 us]}
design: {latin_hypercube: 50}
run: {duration: 0.01 min, analyze: [critical_speeds]}
measure: {peak: max(rotor.whirl.radius), critical: "critical_speeds[0]"}
require: {peak: "< 5 mil", critical: ["> 800 rpm", "<= 20Hz"]}
)"));
  EXPECT_DOUBLE_EQ(study.vary[0].distribution.low, 8000.0);
  EXPECT_DOUBLE_EQ(study.vary[0].distribution.high, 12000.0);
  EXPECT_DOUBLE_EQ(study.vary[1].distribution.deviation, 1e-5);
  EXPECT_DOUBLE_EQ(study.vary[2].distribution.list[0], 125.66370614359172);
  EXPECT_DOUBLE_EQ(study.vary[2].distribution.list[1], 125.66370614359172);
  EXPECT_EQ(study.vary[2].written_unit, "");
  // Only the scene's reader knows the unit of this one: it gets the number with its unit.
  EXPECT_EQ(study.vary[3].written_unit, "ms");
  EXPECT_DOUBLE_EQ(study.vary[3].distribution.list[1], 1.0);
  EXPECT_DOUBLE_EQ(*study.duration, 0.6);
  EXPECT_DOUBLE_EQ(study.requirements[0].limit, 5 * 2.54e-5);
  EXPECT_DOUBLE_EQ(study.requirements[1].limit, 83.77580409572782);
  EXPECT_DOUBLE_EQ(study.requirements[2].limit, 125.66370614359172);
  EXPECT_SAYS(inputErrorOf(files, varied("rotor.stiffness", "{uniform: [1 kg, 2]}")),
              "vary.rotor.stiffness.uniform[0]: must be a finite number in N/m, found '1 kg': 'kg' "
              "cannot be converted to N/m");
  EXPECT_SAYS(inputErrorOf(files, varied("step", "{list: [1 ms, 0.002]}")), "vary.step.list[1]");
  EXPECT_SAYS(inputErrorOf(files, varied("step", "{list: [1 ms, 2 m]}")), "vary.step.list[1]");
  EXPECT_SAYS(inputErrorOf(files, varied("rotor.stiffness", "{uniform: [1, 2]}") +
                                      "require: {critical: \"< 5 m\"}\n"),
              "found '< 5 m': 'm' cannot be converted to rad/s");
}

TEST(StudyReader, TellsAllErrorsAtOnceEachAtItsPlace) {
  const StudyFiles files;
  const std::string said = inputErrorOf(files, R"(
vary:
  rotor.stifness: {uniform: [1, 2]}
  rotor.mass: {uniform: [-1.0, 1.0]}
  rotor.damping: {unifrom: [1, 2]}
design: {latin_hypercub: 10}
run: {duration: -1, analyse: true}
measure: {peak: max(rotor.whirl.radus), low: rotor.x, other: "critical_speed[0]"}
require: {peek: "< 1"}
)");
  EXPECT_SAYS(said,
              "vary.rotor.stifness: must be a number of the scene; did you mean "
              "'rotor.stiffness'?");
  EXPECT_SAYS(said, "vary.rotor.mass: must be > 0 kg, found -1");
  EXPECT_SAYS(said, "vary.rotor.damping.unifrom: unknown distribution; did you mean 'uniform'?");
  EXPECT_SAYS(said, "design.latin_hypercub: unknown design; did you mean 'latin_hypercube'?");
  EXPECT_SAYS(said, "run.duration: must be from 0 to 1e+09 s, found -1");
  EXPECT_SAYS(said, "run.analyse: unknown key of run; did you mean 'analyze'?");
  EXPECT_SAYS(said, "did you mean 'rotor.whirl.radius'?");
  EXPECT_SAYS(said, "measure.low: rotor.x changes during a run");
  EXPECT_SAYS(said, "did you mean 'critical_speeds[0]'?");
  EXPECT_SAYS(said, "require.peek: unknown measure");
}

TEST(StudyReader, RefusesPathsThatAreNoNumber) {
  const StudyFiles files;
  EXPECT_SAYS(inputErrorOf(files, varied("shaft.profile[2].speed", "{uniform: [1, 2]}")),
              "there are 2 rows, counted from 0");
  EXPECT_SAYS(inputErrorOf(files, varied("shaft.profile", "{uniform: [1, 2]}")),
              "is not a single number: name one of its parts");
  EXPECT_SAYS(inputErrorOf(files, varied("rotor", "{uniform: [1, 2]}")), "is not a single number");
  EXPECT_SAYS(inputErrorOf(files, varied("nothing", "{uniform: [1, 2]}")),
              "must be a number of the scene");
  EXPECT_SAYS(inputErrorOf(files, varied("rotor.model", "{uniform: [1, 2]}")),
              "must be a number of the scene");
  EXPECT_SAYS(inputErrorOf(files, varied("", "{uniform: [1, 2]}")),
              "must be a number of the scene");
  EXPECT_EQ(inputErrorOf(files, varied("shaft.profile[1].speed", "{uniform: [180, 220]}")), "");
  EXPECT_EQ(inputErrorOf(files, varied("systems.rotor.parameters.mass", "{uniform: [1, 2]}")), "");
  EXPECT_EQ(inputErrorOf(files, varied("rotor.stiffness_y", "{uniform: [1, 2]}")),
            "");  // a default
  EXPECT_EQ(inputErrorOf(files, varied("gravity", "{list: [9.8, 1.6]}")), "");
}

TEST(StudyReader, RefusesANumberThatVariesTwice) {
  const StudyFiles files;
  EXPECT_SAYS(inputErrorOf(files, R"(
vary:
  shaft.max_acceleration: {list: [50, 100]}
  shaft.profile[1].max_acceleration: {list: [50, 100]}
design: grid
run: analyze
measure: {critical: "critical_speeds[0]"}
)"),
              "duplicate: drives.shaft.profile[1].max_acceleration is already varied by "
              "shaft.max_acceleration");
}

TEST(StudyReader, RefusesDistributionsThatAreNone) {
  const StudyFiles files;
  EXPECT_SAYS(inputErrorOf(files, varied("rotor.mass", "{uniform: [2, 1]}")), "[lowest, highest]");
  EXPECT_SAYS(inputErrorOf(files, varied("rotor.mass", "{uniform: [1]}")), "found 1 entries");
  EXPECT_SAYS(inputErrorOf(files, varied("rotor.mass", "{uniform: [1, x]}")), "finite number");
  EXPECT_SAYS(inputErrorOf(files, varied("rotor.mass", "{uniform: [1, inf]}")), "finite number");
  EXPECT_SAYS(inputErrorOf(files, varied("rotor.damping", "{log_uniform: [0, 1]}")), "logarithm");
  EXPECT_SAYS(inputErrorOf(files, varied("rotor.mass", "{normal: [1, 0]}")), "must be > 0");
  EXPECT_SAYS(inputErrorOf(files, varied("rotor.mass", "{list: []}")), "found 0 entries");
  EXPECT_SAYS(inputErrorOf(files, varied("rotor.mass", "1.0")), "must be a map");
  EXPECT_SAYS(inputErrorOf(files, varied("rotor.bow", "{relative_half_width: 0.1}")),
              "must not be relative to 0");
  EXPECT_SAYS(inputErrorOf(files, varied("rotor.mass", "{uniform: [1, 2], list: [1]}")),
              "must be one of");
}

TEST(StudyReader, RefusesDesignsThatDoNotFit) {
  const StudyFiles files;
  const std::string uniform = "{uniform: [1, 2]}";
  EXPECT_SAYS(inputErrorOf(files, varied("rotor.mass", uniform, "grid")), "{grid: LEVELS}");
  EXPECT_SAYS(inputErrorOf(files, varied("rotor.mass", uniform, "list")), "must be a list");
  EXPECT_SAYS(inputErrorOf(files, varied("rotor.mass", uniform, "{sobol: 0}")), "from 1 to 1e+09");
  EXPECT_SAYS(inputErrorOf(files, varied("rotor.mass", uniform, "{sobol: 1.5}")), "whole number");
  EXPECT_SAYS(inputErrorOf(files, varied("rotor.mass", uniform, "sobol")), "found nothing");
  EXPECT_SAYS(inputErrorOf(files, varied("rotor.mass", "{list: [1, 2]}", "{morris: 5}")), "list");
  EXPECT_SAYS(
      inputErrorOf(files, varied("rotor.mass", uniform, "{morris: {trajectories: 5, levels: 3}}")),
      "must be even");
  EXPECT_SAYS(inputErrorOf(files, varied("rotor.mass", uniform, "{grid: 3, sobol: 3}")),
              "one design");
  EXPECT_SAYS(
      inputErrorOf(files, varied("shaft.max_acceleration", "{list: [20]}", "one_at_a_time")),
      "differs from move to move");
  EXPECT_EQ(inputErrorOf(files, varied("rotor.mass", "{list: [1]}", "grid")), "");  // of one point
  EXPECT_EQ(inputErrorOf(files, varied("rotor.mass", uniform, "{grid: 1}")), "");
}

TEST(StudyReader, RefusesOptimaThatCannotBeLookedFor) {
  const StudyFiles files;
  const auto optimized = [&](const std::string& optimize, const std::string& more = "") {
    return inputErrorOf(files,
                        "vary: {rotor.stiffness: {uniform: [1.0e4, 2.0e4]}, rotor.damping: "
                        "{normal: [10, 1]}}\nrun: analyze\nmeasure: {critical: "
                        "\"critical_speeds[0]\"}\noptimize: " +
                            optimize + "\n" + more);
  };
  EXPECT_EQ(optimized("{minimize: critical, over: [rotor.stiffness]}"), "");
  EXPECT_SAYS(optimized("{minimize: critical}"),
              "vary.rotor.damping: must have two different bounds");
  EXPECT_SAYS(optimized("{minimise: critical}"),
              "optimize.minimise: unknown key of optimize; did you mean 'minimize'?");
  EXPECT_SAYS(optimized("{minimize: critical, maximize: critical}"),
              "one of minimize and maximize");
  EXPECT_SAYS(optimized("{minimize: critcal}"), "did you mean 'critical'?");
  EXPECT_SAYS(optimized("{minimize: critical, over: [rotor.stifness]}"),
              "optimize.over[0]: must be a varied parameter, found 'rotor.stifness'; did you mean "
              "'rotor.stiffness'?");
  EXPECT_SAYS(optimized("{minimize: critical, over: [rotor.stiffness], method: bobyqa}"),
              "bobyqa needs at least two parameters");
  EXPECT_SAYS(optimized("{minimize: critical, over: [rotor.stiffness], method: crs}",
                        "require: {critical: \"> 1\"}"),
              "crs has no requirements");
  EXPECT_SAYS(optimized("{minimize: critical, evaluations: 0, tolerance: 0}"),
              "optimize.evaluations: must be");
  EXPECT_SAYS(optimized("{minimize: critical}", "design: {monte_carlo: 3}"),
              "must not be given with a design");
}

TEST(StudyReader, RefusesAlarmsThatThereAreNot) {
  const StudyFiles files;
  const auto alarms = [&](const std::string& measure, const std::string& run) {
    return inputErrorOf(files,
                        "vary: {rotor.stiffness: {uniform: [1.0e4, 2.0e4]}}\ndesign: "
                        "{monte_carlo: 3}\nrun: {" +
                            run + "}\nmeasure: {n: " + measure + "}\n");
  };
  EXPECT_EQ(alarms("alarms", "duration: 1"), "");
  EXPECT_EQ(alarms("alarms.IN_CRITICAL_BAND", "duration: 1"), "");
  EXPECT_SAYS(alarms("alarms.IN_CRITICAL_BAN", "duration: 1"),
              "did you mean 'alarms.IN_CRITICAL_BAND'?");
  EXPECT_SAYS(alarms("alarms", "analyze: true"), "run.duration: missing");
  EXPECT_SAYS(alarms("alarms", "duration: 1, alarms: none.yaml"), "none.yaml");
  files.write("monitor.yaml", "clear_delay: -1\n");
  EXPECT_SAYS(alarms("alarms", "duration: 1, alarms: monitor.yaml"), "clear_delay");
}

TEST(StudyReader, TellsTheErrorsOfTheScene) {
  const StudyFiles files;
  files.write("scene.yaml", "step: 0.001\nsystems: {rotor: {model: jefcott_rotor}}\n");
  EXPECT_SAYS(inputErrorOf(files, varied("rotor.mass", "{uniform: [1, 2]}")),
              "did you mean 'jeffcott_rotor'?");
  EXPECT_SAYS(inputErrorOf(files, ""), "run: missing");
}

TEST(StudyReader, AGridHasEveryCombinationAndOneAtATimeTheScene) {
  const StudyFiles files;
  const std::string rest = R"(
vary: {rotor.mass: {uniform: [1, 2]}, rotor.damping: {list: [5, 10, 20]}}
run: analyze
measure: {critical: "critical_speeds[0]"}
)";
  const Study grid = readStudy(files.study(rest + "design: {grid: 2}"));
  ASSERT_EQ(grid.points(), 6U);
  EXPECT_EQ(grid.valuesAt(0), (std::vector<double>{1.0, 5.0}));
  EXPECT_EQ(grid.valuesAt(5), (std::vector<double>{2.0, 20.0}));
  const Study one = readStudy(files.study(rest + "design: {one_at_a_time: 2}"));
  ASSERT_EQ(one.points(), 6U);
  EXPECT_EQ(one.valuesAt(0), (std::vector<double>{1.0, 10.0}));
  EXPECT_EQ(one.valuesAt(2), (std::vector<double>{2.0, 10.0}));
  EXPECT_EQ(one.valuesAt(5), (std::vector<double>{1.0, 20.0}));
}

}  // namespace study_reader_test
}  // namespace whirl_twin
